//! Location of the settings.

use std::path::PathBuf;

pub use crate::session::SavedViewSettings;
pub use crate::view::{ColorScheme, DISPLAY_FLAGS, Settings, SheetPage};

/// The file of the settings: `sinew/settings.yaml` in the user's config folder.
pub(crate) fn path() -> PathBuf {
    gtk4::glib::user_config_dir().join("sinew").join("settings.yaml")
}
