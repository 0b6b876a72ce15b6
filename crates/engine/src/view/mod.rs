//! How a document is shown, without a window: the movable light and the model's own transform, display options, overlays (onion skins, motion path,
//! comparison), and the files that keep it: sessions, settings, recovery of unsaved muscles. Used by the window's session and the subcommands.

mod background_preset;
mod camera_controller;
mod camera_follow;
mod cameras;
mod comparison;
mod display_flags;
mod display_options;
mod frames;
mod light;
mod lines_of_action;
mod model;
mod motion_path;
mod onion_skin;
mod onion_skin_settings;
mod open;
mod overlays;
mod pose_context;
mod recovery_file;
mod save_error;
mod session_file;
mod settings;
mod view_state;

pub use background_preset::BackgroundPreset;
pub use camera_controller::{CameraController, FlyCamera, Viewpoint};
pub use camera_follow::CameraFollow;
pub use cameras::{file_camera, file_cameras};
pub use comparison::{CompareTarget, PoseComparison, TINT as COMPARED_TINT};
pub use display_flags::{DISPLAY_FLAGS, DisplayFlag, SHADINGS};
pub use display_options::DisplayOptions;
pub use frames::{DEFAULT_FRAME_RATE, infer_frame_rate};
pub use light::LightDirection;
pub use model::ModelTransform;
pub use onion_skin_settings::OnionSkinSettings;
pub use open::{Opened, guard_of, open};
pub use overlays::SceneOverlays;
pub use pose_context::PoseContext;
pub use recovery_file::RecoveryFile;
pub use save_error::SaveError;
pub use session_file::{SavedCamera, SavedComparison, SavedModel, SavedNode, SavedRotation, SessionError, SessionState, saved_node};
pub use settings::{ColorScheme, Settings, SheetPage};
pub use view_state::ViewState;
