//! Writing a file whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::{NamedTempFile, TempPath};

use super::ExportError;

/// Calls `write` with a buffered temporary file beside `target` and renames it to `target` once everything is on it.
///
/// A symbolic link stays one: the file that it leads to is replaced. An existing file's permissions are kept; a new one gets the usual ones.
///
/// # Errors
/// [`ExportError`] where the folder or the disk refuses, or `target` is a folder or a device.
pub fn write_whole(target: &Path, write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>) -> Result<(), ExportError> {
    prepare(target, write)?.put_in_place()
}

/// A file that is complete but not yet where it belongs; gone when it is dropped.
#[derive(Debug)]
pub struct Pending {
    temporary: TempPath,
    target: PathBuf,
    place: PathBuf,
}

impl Pending {
    /// An empty temporary file beside `target`, for a program that writes it by its name: [`Pending::file`].
    ///
    /// # Errors
    /// As [`write_whole`].
    pub fn begin(target: &Path) -> Result<Self, ExportError> {
        let (temporary, place) = start(target)?;
        Ok(Self { temporary: temporary.into_temp_path(), target: target.to_owned(), place })
    }

    /// The temporary file.
    pub fn file(&self) -> &Path {
        &self.temporary
    }

    /// Renames the file to its target.
    ///
    /// # Errors
    /// [`ExportError`] where the folder refuses.
    pub fn put_in_place(self) -> Result<(), ExportError> {
        let Self { temporary, target, place } = self;
        if let Ok(found) = fs::metadata(&place) {
            // Some file systems know no permissions; the content matters more.
            let _ = fs::set_permissions(&temporary, found.permissions());
        }
        temporary.persist(&place).map_err(|error| ExportError::io(&target, error.error))
    }
}

/// Writes a temporary file beside `target`; see [`write_whole`], which also puts it in its place.
///
/// # Errors
/// As [`write_whole`].
pub fn prepare(target: &Path, write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>) -> Result<Pending, ExportError> {
    let failed = |error| ExportError::io(target, error);
    let (mut temporary, place) = start(target)?;
    let mut buffered = BufWriter::with_capacity(1 << 16, temporary.as_file_mut());
    write(&mut buffered).and_then(|()| buffered.flush()).map_err(failed)?;
    drop(buffered);
    Ok(Pending { temporary: temporary.into_temp_path(), target: target.to_owned(), place })
}

/// The temporary file for `target`, and where it goes in the end.
fn start(target: &Path) -> Result<(NamedTempFile, PathBuf), ExportError> {
    let place = fs::canonicalize(target).unwrap_or_else(|_| target.to_owned());
    if fs::metadata(&place).is_ok_and(|found| !found.is_file()) {
        return Err(ExportError::NotAFile { file: target.to_owned() });
    }
    let temporary = begin(&folder_of(&place)).map_err(|error| ExportError::io(target, error))?;
    Ok((temporary, place))
}

fn folder_of(file: &Path) -> PathBuf {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

fn begin(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".sinew-").suffix(".tmp");
    // Temporary files are private by default; a picture is to have what the user's mask allows.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder).map_err(|error| {
        // `tempfile` adds the path of its own file to the message; only the kind concerns the user.
        error.raw_os_error().map_or_else(|| io::Error::from(error.kind()), io::Error::from_raw_os_error)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let target = folder.path().join("kept.txt");
        fs::write(&target, "old").expect("writable");
        let result = write_whole(&target, |out| out.write_all(b"half").and(Err(io::ErrorKind::StorageFull.into())));
        assert!(matches!(result, Err(ExportError::Io { .. })));
        assert_eq!(fs::read_to_string(&target).expect("still there"), "old");
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn links_and_permissions_are_kept() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (target, link) = (folder.path().join("real.txt"), folder.path().join("link.txt"));
        fs::write(&target, "old").expect("writable");
        fs::set_permissions(&target, fs::Permissions::from_mode(0o640)).expect("ours");
        symlink(&target, &link).expect("links work");
        write_whole(&link, |out| out.write_all(b"new")).expect("writes");
        assert_eq!(fs::read_to_string(&target).expect("there"), "new");
        assert_eq!(fs::metadata(&target).expect("there").permissions().mode() & 0o777, 0o640);
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink());
    }

    #[test]
    fn a_folder_is_no_file() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        assert!(matches!(write_whole(folder.path(), |_| Ok(())), Err(ExportError::NotAFile { .. })));
    }
}
