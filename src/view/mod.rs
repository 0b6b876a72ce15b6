//! How a document is looked at, without a window: the light and the model that hands move, the switches of the display by their names, what
//! accompanies it in the picture, and the files that keep all of it: sessions, settings, and muscles that are not saved yet. The window's session and the subcommands stand on it.

mod camera_follow;
mod cameras;
mod comparison;
mod display_presets;
mod frames;
mod light;
mod model;
mod motion_path;
mod onion_skin;
mod onion_skin_settings;
mod open;
mod overlays;
mod session_file;
mod settings;
mod unsaved;

pub use camera_follow::Along;
pub use cameras::{file_camera, file_cameras};
pub use comparison::{Comparison, TINT as COMPARED_TINT, With};
pub use display_presets::{Backdrop, SHADINGS, SWITCHES, Switch};
pub use frames::{DEFAULT_RATE, guess_rate};
pub use light::LightAim;
pub use model::ModelTransform;
pub use onion_skin_settings::Ghosts;
pub use open::{Opened, held, open};
pub use overlays::{PoseContext, SceneOverlays};
pub use session_file::{Saved, SavedCamera, SavedComparison, SavedModel, SavedNode, SavedTurn, SessionError, name_of};
pub use settings::{Colours, Settings, SheetPage};
pub use unsaved::Unsaved;
