//! The scene of a start without files.

use std::path::Path;

use super::Document;
use super::open::add_muscles;
use sinew_scene::message::SourceName;

/// The report's measured biceps, compiled in.
const BICEPS: &str = include_str!("../../../../configs/biceps-measured.yaml");

pub(super) fn document() -> Document {
    let mut document = Document::default();
    // The shipped file is read by the same code as any other, and a test opens it, so this cannot fail in a released program.
    if add_muscles(&mut document, BICEPS.as_bytes(), &SourceName::BuiltIn, Path::new("")).is_err() {
        document = Document::default();
    }
    document.place_muscles();
    document
}
