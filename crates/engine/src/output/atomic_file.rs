//! Atomic writing of files, never over one of the inputs.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use super::OutputError;
use super::guard::{self, Output};
use super::temporary::TempFile;

/// Calls `write` with a buffered temporary file beside `target` and renames it to `target` once everything is on it.
///
/// A symbolic link stays one: the file that it leads to is replaced. An existing file's permissions are kept; a new one gets the usual ones.
///
/// # Errors
/// [`OutputError`] where the folder or the disk refuses, or `target` is a folder or a device.
pub fn write_atomic(target: &Output, write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>) -> Result<(), OutputError> {
    prepare(target, write)?.commit()
}

/// A complete file under its temporary name; deleted when it is dropped before [`PendingFile::commit`].
#[derive(Debug)]
pub struct PendingFile {
    temporary: TempFile,
    target: Output,
    place: PathBuf,
}

impl PendingFile {
    /// An empty temporary file beside `target`, for a program that writes it by its name: [`PendingFile::file`].
    ///
    /// # Errors
    /// As [`write_atomic`].
    pub fn begin(target: &Output) -> Result<Self, OutputError> {
        let (_, temporary, place) = start(target)?;
        Ok(Self { temporary, target: target.clone(), place })
    }

    /// The temporary file.
    pub fn file(&self) -> &Path {
        self.temporary.path()
    }

    /// Renames the file to its target.
    ///
    /// # Errors
    /// [`OutputError`] where the folder refuses, or what is there now is one of the files that the result is made from.
    pub fn commit(self) -> Result<(), OutputError> {
        let Self { temporary, target, place } = self;
        target.check()?;
        if let Ok(found) = fs::metadata(&place) {
            // Some file systems know no permissions; the content matters more.
            let _ = fs::set_permissions(temporary.path(), found.permissions());
        }
        temporary.persist(&place).map_err(|error| OutputError::io(target.file(), error))
    }
}

/// Writes a temporary file beside `target`; see [`write_atomic`], which also puts it in its place.
///
/// # Errors
/// As [`write_atomic`].
pub fn prepare(target: &Output, write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>) -> Result<PendingFile, OutputError> {
    let failed = |error| OutputError::io(target.file(), error);
    let (mut file, temporary, place) = start(target)?;
    let mut buffered = BufWriter::with_capacity(1 << 16, &mut file);
    write(&mut buffered).and_then(|()| buffered.flush()).map_err(failed)?;
    drop(buffered);
    Ok(PendingFile { temporary, target: target.clone(), place })
}

/// The temporary file for `target`, and where it goes in the end.
fn start(target: &Output) -> Result<(File, TempFile, PathBuf), OutputError> {
    target.check()?;
    let place = guard::place(target.file());
    let names_folder = target.file().as_os_str().as_encoded_bytes().ends_with(b"/");
    if names_folder || fs::metadata(&place).is_ok_and(|found| !found.is_file()) {
        return Err(OutputError::NotAFile { file: target.file().to_owned() });
    }
    let (file, temporary) = TempFile::begin(&folder_of(&place)).map_err(|error| OutputError::io(target.file(), error))?;
    Ok((file, temporary, place))
}

fn folder_of(file: &Path) -> PathBuf {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::OverwriteGuard;

    fn output(file: &Path) -> Output {
        OverwriteGuard::default().output(file).expect("nothing is held")
    }

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let target = folder.path().join("kept.txt");
        fs::write(&target, "old").expect("writable");
        let result = write_atomic(&output(&target), |out| out.write_all(b"half").and(Err(io::ErrorKind::StorageFull.into())));
        assert!(matches!(result, Err(OutputError::Io { .. })));
        assert_eq!(fs::read_to_string(&target).expect("still there"), "old");
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn links_and_permissions_are_kept() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (target, link) = (folder.path().join("real.txt"), folder.path().join("link.txt"));
        symlink(&target, &link).expect("links work");
        // Also where the link leads to nothing yet.
        write_atomic(&output(&link), |out| out.write_all(b"old")).expect("writes");
        assert_eq!(fs::read_to_string(&target).expect("there"), "old");
        fs::set_permissions(&target, fs::Permissions::from_mode(0o640)).expect("ours");
        write_atomic(&output(&link), |out| out.write_all(b"new")).expect("writes");
        assert_eq!(fs::read_to_string(&target).expect("there"), "new");
        assert_eq!(fs::metadata(&target).expect("there").permissions().mode() & 0o777, 0o640);
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_is_laid_while_a_result_is_made_is_seen() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (source, target) = (folder.path().join("source"), folder.path().join("target"));
        fs::write(&source, "source").expect("writable");
        let target = OverwriteGuard::of_files([&source]).output(&target).expect("not there yet");
        let result = write_atomic(&target, |out| {
            std::os::unix::fs::symlink("source", target.file())?;
            out.write_all(b"result")
        });
        assert!(matches!(result, Err(OutputError::Held { .. })));
        assert_eq!(fs::read_to_string(&source).expect("there"), "source");
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 2);
    }

    #[test]
    fn a_folder_is_no_file() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let slashed = folder.path().join("result.png/");
        for path in [folder.path(), &slashed] {
            assert!(matches!(write_atomic(&output(path), |_| Ok(())), Err(OutputError::NotAFile { .. })), "{}", path.display());
        }
    }
}
