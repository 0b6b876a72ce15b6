//! Bytes of a file, within the limits, and what kind of file they are.

use std::path::Path;

use super::{OpenError, OpenErrorKind};
use crate::input::{self, Refused};
use sinew_scene::limits;
use sinew_scene::message::SourceName;

/// What a file holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    /// COLLADA, plain or zipped.
    Collada,
    /// YAML.
    Muscles,
}

impl Format {
    /// Largest file of this format, bytes.
    pub(super) fn limit(self) -> u64 {
        match self {
            Self::Collada => limits::FILE_BYTES,
            Self::Muscles => limits::YAML_BYTES,
        }
    }
}

/// Reads a regular file, or standard input for `-`, of at most `limit` bytes.
pub(super) fn read(path: &Path, name: &SourceName, limit: u64) -> Result<Vec<u8>, OpenError> {
    let refuse = |refused: Refused| OpenError::whole(name, OpenErrorKind::Refused(Box::new(refused)));
    let bytes = input::read_argument(path, limit).map_err(refuse)?;
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(OpenError::whole(name, OpenErrorKind::Empty));
    }
    Ok(bytes)
}

/// The format by the file's ending; where that says nothing, by its first bytes.
pub(super) fn format(path: &Path, bytes: &[u8]) -> Format {
    let extension = path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase);
    match extension.as_deref() {
        Some("dae" | "zae" | "xml") => return Format::Collada,
        Some("yaml" | "yml") => return Format::Muscles,
        _ => {}
    }
    let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let first = start.iter().find(|byte| !byte.is_ascii_whitespace());
    if first == Some(&b'<') || is_utf16(bytes) || bytes.starts_with(b"PK") { Format::Collada } else { Format::Muscles }
}

/// Whether these are the first bytes of XML in UTF-16.
pub(super) fn is_utf16(bytes: &[u8]) -> bool {
    [&b"\xFF\xFE"[..], b"\xFE\xFF", b"\0<", b"<\0"].iter().any(|mark| bytes.starts_with(mark))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_decides_and_the_content_helps_out() {
        assert_eq!(format(Path::new("a.DAE"), b"x: 1"), Format::Collada);
        assert_eq!(format(Path::new("a.yml"), b"<x/>"), Format::Muscles);
        assert_eq!(format(Path::new("-"), b"\xEF\xBB\xBF <?xml"), Format::Collada);
        assert_eq!(format(Path::new("-"), b"\xFF\xFE<\0"), Format::Collada);
        assert_eq!(format(Path::new("-"), b"---\nmuscle_config:"), Format::Muscles);
    }

    #[test]
    fn what_is_no_regular_file_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        assert!(read(folder.path(), &"folder".into(), 10).is_err());
        assert!(read(&folder.path().join("none"), &"none".into(), 10).is_err());
        let file = folder.path().join("long");
        std::fs::write(&file, "0123456789abc").expect("written");
        assert!(read(&file, &"long".into(), 10).is_err());
        assert_eq!(read(&file, &"long".into(), 13).expect("fits"), b"0123456789abc");
        std::fs::write(&file, " \n").expect("written");
        assert!(read(&file, &"blank".into(), 10).is_err());
        #[cfg(unix)]
        assert!(read(Path::new("/dev/zero"), &"zero".into(), 10).is_err());
    }
}
