//! Location of the settings.

use std::path::PathBuf;

pub use crate::session::SavedViewSettings;
pub use crate::view::{ColorScheme, DISPLAY_FLAGS, Settings, SheetPage};

impl Settings {
    /// The file: `sinew/settings.yaml` in the user's config folder.
    pub fn path() -> PathBuf {
        gtk4::glib::user_config_dir().join("sinew").join("settings.yaml")
    }
}
