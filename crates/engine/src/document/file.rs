//! Bytes of a file, within the limits.

use std::path::Path;

use super::{OpenError, OpenErrorKind};
use crate::input::{self, Refused};
use sinew_scene::message::SourceName;

/// Reads a regular file, or standard input for `-`, of at most `limit` bytes.
pub(super) fn read(path: &Path, name: &SourceName, limit: u64) -> Result<Vec<u8>, OpenError> {
    let refuse = |refused: Refused| OpenError::whole(name, OpenErrorKind::Refused(Box::new(refused)));
    let bytes = input::read_argument(path, limit).map_err(refuse)?;
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(OpenError::whole(name, OpenErrorKind::Empty));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

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
