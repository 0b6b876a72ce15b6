//! Writing a file whole or not at all.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::TempPath;

use super::ExportError;

/// The temporary files of this program that are not in their places yet.
static UNFINISHED: Mutex<Unfinished> = Mutex::new(Unfinished { files: BTreeSet::new(), over: false });

struct Unfinished {
    files: BTreeSet<PathBuf>,
    over: bool,
}

impl Unfinished {
    fn lock() -> MutexGuard<'static, Self> {
        UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Takes away every file that is not in its place yet, whoever writes it, and lets none begin any more: for a program that ends at once while other
/// threads still write.
pub fn sweep() {
    let mut unfinished = Unfinished::lock();
    unfinished.over = true;
    for file in std::mem::take(&mut unfinished.files) {
        // Nothing more can be done about one that stays.
        let _ = fs::remove_file(file);
    }
}

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
    temporary: Temporary,
    target: PathBuf,
    place: PathBuf,
}

/// A temporary file that [`sweep`] knows of.
#[derive(Debug)]
struct Temporary(Option<TempPath>);

impl Temporary {
    /// An empty file in `folder`.
    fn begin(folder: &Path) -> io::Result<(File, Self)> {
        // Held until the file is known: one that is made at the same moment as the sweep is swept or never made.
        let mut unfinished = Unfinished::lock();
        if unfinished.over {
            return Err(io::Error::other(ExportError::Cancelled));
        }
        let (file, path) = begin(folder)?;
        unfinished.files.insert(path.to_path_buf());
        Ok((file, Self(Some(path))))
    }

    fn path(&self) -> &Path {
        self.0.as_deref().unwrap_or(Path::new(""))
    }

    fn persist(mut self, place: &Path) -> io::Result<()> {
        let Some(path) = self.0.take() else { return Ok(()) };
        Unfinished::lock().files.remove::<Path>(&path);
        path.persist(place).map_err(|error| error.error)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = &self.0 {
            Unfinished::lock().files.remove::<Path>(path);
        }
    }
}

impl Pending {
    /// An empty temporary file beside `target`, for a program that writes it by its name: [`Pending::file`].
    ///
    /// # Errors
    /// As [`write_whole`].
    pub fn begin(target: &Path) -> Result<Self, ExportError> {
        let (_, temporary, place) = start(target)?;
        Ok(Self { temporary, target: target.to_owned(), place })
    }

    /// The temporary file.
    pub fn file(&self) -> &Path {
        self.temporary.path()
    }

    /// Renames the file to its target.
    ///
    /// # Errors
    /// [`ExportError`] where the folder refuses.
    pub fn put_in_place(self) -> Result<(), ExportError> {
        let Self { temporary, target, place } = self;
        if let Ok(found) = fs::metadata(&place) {
            // Some file systems know no permissions; the content matters more.
            let _ = fs::set_permissions(temporary.path(), found.permissions());
        }
        temporary.persist(&place).map_err(|error| ExportError::io(&target, error))
    }
}

/// Writes a temporary file beside `target`; see [`write_whole`], which also puts it in its place.
///
/// # Errors
/// As [`write_whole`].
pub fn prepare(target: &Path, write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>) -> Result<Pending, ExportError> {
    let failed = |error| ExportError::io(target, error);
    let (mut file, temporary, place) = start(target)?;
    let mut buffered = BufWriter::with_capacity(1 << 16, &mut file);
    write(&mut buffered).and_then(|()| buffered.flush()).map_err(failed)?;
    drop(buffered);
    Ok(Pending { temporary, target: target.to_owned(), place })
}

/// The temporary file for `target`, and where it goes in the end.
fn start(target: &Path) -> Result<(File, Temporary, PathBuf), ExportError> {
    let place = fs::canonicalize(target).unwrap_or_else(|_| target.to_owned());
    if fs::metadata(&place).is_ok_and(|found| !found.is_file()) {
        return Err(ExportError::NotAFile { file: target.to_owned() });
    }
    let (file, temporary) = Temporary::begin(&folder_of(&place)).map_err(|error| ExportError::io(target, error))?;
    Ok((file, temporary, place))
}

fn folder_of(file: &Path) -> PathBuf {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

fn begin(folder: &Path) -> io::Result<(File, TempPath)> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".sinew-").suffix(".tmp");
    // Temporary files are private by default; a picture is to have what the user's mask allows.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder).map(tempfile::NamedTempFile::into_parts).map_err(|error| {
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
