//! Dialogs and what they carry out: choosing, comparing, saving and exporting files, screenshots, help.

pub(crate) mod about;
pub(crate) mod compare_file;
pub(crate) mod export_dialog;
mod export_job;
pub(crate) mod file_chooser;
pub(crate) mod help;
pub(crate) mod measurement_comparison;
pub(crate) mod save_as;
pub(crate) mod save_session;
pub(crate) mod saving;
pub(crate) mod screenshot;
