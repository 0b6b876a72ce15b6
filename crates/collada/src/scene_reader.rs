//! COLLADA among the formats of a program.

use super::read;
use sinew_scene::import::{AnyFinding, ImportError, ImportedScene, SceneReader, starts_as_xml};
use sinew_scene::progress::Progress;

/// The reader of COLLADA as a [`SceneReader`]; [`read`] gives findings and errors as enums.
#[derive(Debug, Clone, Copy, Default)]
pub struct ColladaReader;

impl SceneReader for ColladaReader {
    fn format(&self) -> &'static str {
        super::FORMAT
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["dae", "zae"]
    }

    fn sniff(&self, bytes: &[u8]) -> bool {
        starts_as_xml(bytes) || bytes.starts_with(b"PK")
    }

    fn read(&self, bytes: &[u8], name: &str, progress: &Progress) -> Result<ImportedScene<AnyFinding>, ImportError> {
        let imported = read(bytes, name, progress).map_err(|error| ImportError::new(error.line, error.kind))?;
        Ok(imported.with_any_finding())
    }
}
