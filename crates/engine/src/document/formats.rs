//! The formats that are read: a new one is its reader and one line here.

use std::path::Path;

use sinew_collada::ColladaReader;
use sinew_scene::import::SceneReader;
use sinew_scene::limits;

/// The readers of scene files. Where the ending of a file says nothing, the first one that knows the beginning reads it.
const SCENE_READERS: &[&dyn SceneReader] = &[&ColladaReader];

/// The endings of muscle files and session files.
const MUSCLE_EXTENSIONS: &[&str] = &["yaml", "yml"];

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
    pub(super) fn of(path: &Path, bytes: &[u8]) -> Self {
        let extension = path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase).unwrap_or_default();
        let by_extension = SCENE_READERS.iter().find(|reader| reader.extensions().contains(&extension.as_str()));
        if MUSCLE_EXTENSIONS.contains(&extension.as_str()) {
            return Self::Muscles;
        }
        let by_content = || SCENE_READERS.iter().find(|reader| reader.sniff(bytes));
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

/// Whether a reader of scene files knows this beginning of a file.
pub(super) fn is_known(bytes: &[u8]) -> bool {
    SCENE_READERS.iter().any(|reader| reader.sniff(bytes))
}

/// The endings of all files that can be opened, in small letters, without the dot.
pub fn extensions() -> impl Iterator<Item = &'static str> {
    SCENE_READERS.iter().flat_map(|reader| reader.extensions()).chain(MUSCLE_EXTENSIONS).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_decides_and_the_content_helps_out() {
        let name = |path: &str, bytes: &[u8]| match Format::of(Path::new(path), bytes) {
            Format::Scene(reader) => reader.format(),
            Format::Muscles => "muscles",
        };
        assert_eq!(name("a.DAE", b"x: 1"), "COLLADA");
        assert_eq!(name("a.yml", b"<x/>"), "muscles");
        assert_eq!(name("-", b"\xEF\xBB\xBF <?xml"), "COLLADA");
        assert_eq!(name("-", b"\xFF\xFE<\0"), "COLLADA");
        assert_eq!(name("-", b"---\nmuscle_config:"), "muscles");
    }

    #[test]
    fn no_two_readers_want_the_same_ending() {
        let mut all: Vec<&str> = extensions().collect();
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), count);
    }
}
