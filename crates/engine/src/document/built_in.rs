//! The scene of a start without files.

use std::path::Path;

use super::Document;
use super::open::add_muscles;
use sinew_muscle::presets::Preset;
use sinew_scene::message::SourceName;

/// The preset that is shown: the report's measured biceps.
const PRESET: &str = "measured";

pub(super) fn document() -> Document {
    let mut document = Document::default();
    let biceps = Preset::by_id(PRESET).map_or("", |preset| preset.yaml);
    // The shipped file is read by the same code as any other, and a test opens it, so this cannot fail in a released program.
    if add_muscles(&mut document, biceps.as_bytes(), &SourceName::BuiltIn, Path::new("")).is_err() {
        document = Document::default();
    }
    document.place_muscles();
    document
}
