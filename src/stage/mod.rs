//! How a document is looked at, without a window: the light and the model that hands move, the switches of the display by their names, what
//! accompanies it in the picture, and the files that keep all of it: sessions, settings, and muscles that are not saved yet. The window's session and the subcommands stand on it.

mod along;
mod cameras;
mod company;
mod comparison;
mod frames;
mod ghosts;
mod light;
mod looks;
mod model;
mod onion;
mod open;
mod saved;
mod settings;
mod trail;
mod unsaved;

pub use along::Along;
pub use cameras::{file_camera, file_cameras};
pub use company::{Company, Host};
pub use comparison::{Comparison, TINT as COMPARED_TINT, With};
pub use frames::{DEFAULT_RATE, guess_rate};
pub use ghosts::Ghosts;
pub use light::LightAim;
pub use looks::{Backdrop, SHADINGS, SWITCHES, Switch};
pub use model::ModelTransform;
pub use open::{Opened, held, open};
pub use saved::{Saved, SavedCamera, SavedComparison, SavedModel, SavedNode, SavedTurn, SessionError, name_of};
pub use settings::{Colours, Settings, SheetPage};
pub use unsaved::Unsaved;
