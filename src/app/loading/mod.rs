//! Opening files off the interface thread, watching them, and what can be opened: dropped, recent and sample files, muscles kept from a crash.

pub(crate) mod autosave;
pub(crate) mod background_reader;
pub(crate) mod document_loader;
pub(crate) mod drop_target;
pub(crate) mod file_watcher;
pub(crate) mod named_sources;
pub(crate) mod open_buttons;
mod open_error;
pub(crate) mod open_files;
pub(crate) mod recent;
pub(crate) mod reload_summary;
pub(crate) mod samples;
