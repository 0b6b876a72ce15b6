//! Small handles that widgets are given, so that none of them knows the window: the session, the settings, the focus of the picture, and all of them together.

pub(crate) mod app_context;
pub(crate) mod picture_focus;
pub(crate) mod session_handle;
pub(crate) mod settings_handle;
