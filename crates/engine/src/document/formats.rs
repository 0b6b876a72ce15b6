//! The formats that are read: those of the scene readers that a program has, and YAML of muscles.

use std::fmt;
use std::path::Path;

use sinew_scene::import::SceneReader;
use sinew_scene::limits;

/// The endings of muscle files and session files.
const MUSCLE_EXTENSIONS: &[&str] = &["yaml", "yml"];

/// The readers of scene files that a program has. The engine knows none of them by name, so that a change in a reader builds the reader and the program only.
#[derive(Clone, Copy)]
pub struct SceneReaders(&'static [&'static dyn SceneReader]);

impl SceneReaders {
    /// These readers. Where the ending of a file says nothing, the first one that knows the beginning reads it.
    pub const fn new(readers: &'static [&'static dyn SceneReader]) -> Self {
        Self(readers)
    }

    /// The endings of all files that can be opened with them, those of muscle files among them, in small letters, without the dot.
    pub fn extensions(self) -> impl Iterator<Item = &'static str> {
        self.0.iter().flat_map(|reader| reader.extensions()).chain(MUSCLE_EXTENSIONS).copied()
    }

    /// Whether one of them knows this beginning of a file.
    pub(super) fn know(self, bytes: &[u8]) -> bool {
        self.0.iter().any(|reader| reader.sniff(bytes))
    }
}

impl fmt::Debug for SceneReaders {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.0.iter().map(|reader| reader.format())).finish()
    }
}

/// How a file is read.
#[derive(Clone, Copy)]
pub(super) enum Format {
    /// By the reader of a scene format.
    Scene(&'static dyn SceneReader),
    /// As YAML of muscles.
    Muscles,
}

impl Format {
    /// The format of a file by its ending; where that says nothing, by its first bytes.
    pub(super) fn of(path: &Path, bytes: &[u8], readers: SceneReaders) -> Self {
        let extension = path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase).unwrap_or_default();
        let by_extension = readers.0.iter().find(|reader| reader.extensions().contains(&extension.as_str()));
        if MUSCLE_EXTENSIONS.contains(&extension.as_str()) {
            return Self::Muscles;
        }
        let by_content = || readers.0.iter().find(|reader| reader.sniff(bytes));
        by_extension.or_else(by_content).map_or(Self::Muscles, |reader| Self::Scene(*reader))
    }

    /// Largest file of this format, bytes.
    pub(super) fn limit(self) -> u64 {
        match self {
            Self::Scene(reader) => reader.limit(),
            Self::Muscles => limits::YAML_BYTES,
        }
    }
}

#[cfg(test)]
impl SceneReaders {
    /// The readers that tests of the engine open files with.
    pub(crate) const TESTED: Self = Self::new(&[&sinew_collada::ColladaReader]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_decides_and_the_content_helps_out() {
        let name = |path: &str, bytes: &[u8]| match Format::of(Path::new(path), bytes, SceneReaders::TESTED) {
            Format::Scene(reader) => reader.format(),
            Format::Muscles => "muscles",
        };
        assert_eq!(name("a.DAE", b"x: 1"), "COLLADA");
        assert_eq!(name("a.yml", b"<x/>"), "muscles");
        assert_eq!(name("-", b"\xEF\xBB\xBF <?xml"), "COLLADA");
        assert_eq!(name("-", b"\xFF\xFE<\0"), "COLLADA");
        assert_eq!(name("-", b"---\nmuscle_config:"), "muscles");
    }
}
