//! How a document is looked at, without a window: the light and the model that hands move, the switches of the display by their names, and the
//! session files that keep all of it. The window's session and the subcommands stand on it.

mod cameras;
mod ghosts;
mod light;
mod looks;
mod model;
mod open;
mod saved;

pub use cameras::{file_camera, file_cameras};
pub use ghosts::Ghosts;
pub use light::LightAim;
pub use looks::{Backdrop, SHADINGS, SWITCHES, Switch};
pub use model::ModelTransform;
pub use open::{Opened, open};
pub use saved::{Saved, SavedCamera, SavedComparison, SavedModel, SavedNode, SavedTurn, SessionError, name_of};
