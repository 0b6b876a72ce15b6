//! Says why a file cannot be opened.

use std::path::{Path, PathBuf};

use crate::app::handles::session_handle::SessionHandle;
use crate::app::notices::error_bar::{ErrorBar, ErrorMessage};
use crate::document::OpenError;
use crate::i18n::{self, Sentence};
use crate::message::Location;
use crate::session::LoadMode;
use crate::tr;

/// Says why a file cannot be opened; with the files, offers to try again.
pub(crate) fn show(error_bar: &ErrorBar, session: &SessionHandle, error: &OpenError, again: Option<(Vec<PathBuf>, LoadMode)>) {
    let Location { file, line, column } = &error.location;
    let file = i18n::source_name(file);
    let name = Path::new(&file).file_name().map_or_else(|| file.clone(), |name| name.to_string_lossy().into_owned());
    let place = match (line, column) {
        (Some(line), Some(column)) => tr!("app-at-line-column", line = line.to_string(), column = column.to_string()),
        (Some(line), None) => tr!("app-at-line", line = line.to_string()),
        _ => String::new(),
    };
    let what = error.kind.sentence();
    let message = if place.is_empty() { what } else { format!("{place}: {what}") };
    let kept = if session.read(|session| session.is_empty()) { String::new() } else { format!("\n{}", tr!("app-kept")) };
    error_bar.show(ErrorMessage {
        headline: tr!("app-refused", file = name),
        message,
        details: format!("{}{kept}", error.sentence()),
        again,
    });
    session.update(|session| session.touch());
}
