//! Temporary files beside their targets, which are cleaned up however the program ends.
//!
//! In each folder where a program writes lies one file more, empty and locked as long as the program lives. The names of its temporary files begin
//! with that file's. A later run that can lock the file knows that its owner has ended, and deletes all of them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::OutputError;

/// What the names begin and end with. Between them stand letters and digits, and behind a point the number of a temporary file.
const NAME: (&str, &str) = (".sinew-", ".tmp");

/// Temporary files of this program.
static TEMP_REGISTRY: Mutex<TempRegistry> = Mutex::new(TempRegistry { folders: BTreeMap::new(), closed: false });

struct TempRegistry {
    /// By folder.
    folders: BTreeMap<PathBuf, FolderTemps>,
    closed: bool,
}

/// The temporary files of a folder.
struct FolderTemps {
    /// The empty file whose lock shows that this program is running; kept open.
    lock_file: (PathBuf, File),
    files: BTreeSet<PathBuf>,
    next: u64,
}

impl TempRegistry {
    fn lock() -> MutexGuard<'static, Self> {
        TEMP_REGISTRY.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Removes a file that was renamed or deleted.
    fn forget(&mut self, folder: &Path, file: &Path) {
        let Some(temps) = self.folders.get_mut(folder) else { return };
        temps.files.remove(file);
        if temps.files.is_empty()
            && let Some(temps) = self.folders.remove(folder)
        {
            temps.clear();
        }
    }
}

impl FolderTemps {
    fn begin(folder: &Path) -> io::Result<Self> {
        remove_stale_files(folder);
        Ok(Self { lock_file: create_lock_file(folder)?, files: BTreeSet::new(), next: 0 })
    }

    /// Another temporary file.
    fn add(&mut self, folder: &Path) -> io::Result<(File, PathBuf)> {
        let stem = self.lock_file.0.file_name().and_then(|name| name.to_str()).and_then(stem_of).unwrap_or_default();
        loop {
            let path = folder.join(format!("{}{stem}.{}{}", NAME.0, self.next, NAME.1));
            self.next += 1;
            match File::options().write(true).create_new(true).open(&path) {
                Ok(file) => {
                    self.files.insert(path.clone());
                    return Ok((file, path));
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Deletes everything; files that cannot be deleted stay.
    fn clear(self) {
        self.files.iter().for_each(|file| drop(fs::remove_file(file)));
        let _ = fs::remove_file(&self.lock_file.0);
    }
}

/// Deletes all temporary files, of all threads, and prevents new ones: for a program that ends at once while other
/// threads still write.
pub fn cleanup_temp_files() {
    let mut registry = TempRegistry::lock();
    registry.closed = true;
    std::mem::take(&mut registry.folders).into_values().for_each(FolderTemps::clear);
}

/// A temporary file; gone when it is dropped.
#[derive(Debug)]
pub(super) struct TempFile {
    folder: PathBuf,
    /// None once it is in its place.
    path: Option<PathBuf>,
}

impl TempFile {
    /// An empty file in `folder`.
    pub(super) fn begin(folder: &Path) -> io::Result<(File, Self)> {
        // Held until the file is known: one that is made at the same moment as the sweep is swept or never made.
        let mut registry = TempRegistry::lock();
        if registry.closed {
            return Err(io::Error::other(OutputError::Cancelled));
        }
        if !registry.folders.contains_key(folder) {
            let temps = FolderTemps::begin(folder)?;
            registry.folders.insert(folder.to_owned(), temps);
        }
        let made = registry.folders.get_mut(folder).map(|temps| temps.add(folder));
        match made {
            Some(Ok((file, path))) => Ok((file, Self { folder: folder.to_owned(), path: Some(path) })),
            Some(Err(error)) => {
                registry.forget(folder, Path::new(""));
                Err(error)
            }
            None => Err(io::ErrorKind::NotFound.into()),
        }
    }

    /// The file.
    pub(super) fn path(&self) -> &Path {
        self.path.as_deref().unwrap_or(Path::new(""))
    }

    /// Gives it the name `place`.
    pub(super) fn persist(mut self, place: &Path) -> io::Result<()> {
        fs::rename(self.path(), place)?;
        if let Some(path) = self.path.take() {
            TempRegistry::lock().forget(&self.folder, &path);
        }
        Ok(())
    }
}

impl Drop for TempFile {
    fn drop(&mut self) {
        if let Some(path) = &self.path {
            let _ = fs::remove_file(path);
            TempRegistry::lock().forget(&self.folder, path);
        }
    }
}

/// A new empty file with a name of its own, locked by this program.
fn create_lock_file(folder: &Path) -> io::Result<(PathBuf, File)> {
    loop {
        let made = tempfile::Builder::new().prefix(NAME.0).suffix(NAME.1).rand_bytes(8).tempfile_in(folder);
        let (file, path) = made.map(tempfile::NamedTempFile::into_parts).map_err(|error| {
            // `tempfile` adds the path of its own file to the message; only the kind concerns the user.
            error.raw_os_error().map_or_else(|| io::Error::from(error.kind()), io::Error::from_raw_os_error)
        })?;
        // A file system without locks has none to take either: there nothing is ever taken away.
        let _ = file.lock();
        // Before it was locked, another program may have taken it for one that was left.
        let path = path.keep().map_err(|error| error.error)?;
        if path.symlink_metadata().is_ok() {
            return Ok((path, file));
        }
    }
}

/// Deletes what programs that have ended left in a folder. Files whose owner may live stay, and so does everything that is no file of
/// this kind.
fn remove_stale_files(folder: &Path) {
    // A folder of very many files is not searched to its end.
    let Ok(entries) = fs::read_dir(folder).map(|entries| entries.take(100_000)) else { return };
    let mut left: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
    for entry in entries.flatten() {
        let name = entry.file_name();
        let Some(stem) = name.to_str().and_then(stem_of) else { continue };
        if entry.file_type().is_ok_and(|kind| kind.is_file()) {
            left.entry(stem.to_owned()).or_default().push(entry.path());
        }
    }
    for (stem, files) in left {
        let mark = folder.join(format!("{}{stem}{}", NAME.0, NAME.1));
        let gone = match File::open(&mark) {
            // Kept locked until all is gone: it is the last to go.
            Ok(file) => file.try_lock().is_ok().then_some(Some(file)),
            // A living program has one, from before its first file to after its last.
            Err(error) => (error.kind() == io::ErrorKind::NotFound).then_some(None),
        };
        let Some(_held) = gone else { continue };
        for file in files.iter().filter(|file| **file != mark).chain(std::iter::once(&mark)) {
            // What cannot be taken away stays.
            let _ = fs::remove_file(file);
        }
    }
}

/// What the names of a program's files have in common, by one of them; `None` for another file.
fn stem_of(name: &str) -> Option<&str> {
    let stem = name.strip_prefix(NAME.0)?.strip_suffix(NAME.1)?;
    let (stem, number) = stem.split_once('.').map_or((stem, None), |(stem, number)| (stem, Some(number)));
    let is_valid = !stem.is_empty() && stem.chars().all(|c| c.is_ascii_alphanumeric());
    let numbered = number.is_none_or(|number| !number.is_empty() && number.chars().all(|c| c.is_ascii_digit()));
    (is_valid && numbered).then_some(stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).expect("readable").flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn only_own_names_are_known() {
        assert_eq!(stem_of(".sinew-aB3.tmp"), Some("aB3"));
        assert_eq!(stem_of(".sinew-aB3.17.tmp"), Some("aB3"));
        for other in [".sinew-.tmp", "sinew-a.tmp", ".sinew-a", ".sinew-a.b.tmp", ".sinew-a.1.2.tmp", ".sinew-ä.tmp", ".sinew-a-b.tmp"] {
            assert_eq!(stem_of(other), None, "{other}");
        }
    }

    #[test]
    fn what_a_dead_program_left_goes_and_all_else_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        for name in [".sinew-dead.tmp", ".sinew-dead.0.tmp", ".sinew-dead.1.tmp", ".sinew-older.tmp", ".sinew-orphan.3.tmp"] {
            fs::write(at(name), "half").expect("written");
        }
        for name in [".sinew-alive.tmp", ".sinew-alive.0.tmp", ".sinew-my notes.tmp", "sinew.tmp", ".other.tmp"] {
            fs::write(at(name), "mine").expect("written");
        }
        fs::create_dir(at(".sinew-folder.tmp")).expect("made");
        let alive = File::open(at(".sinew-alive.tmp")).expect("there");
        alive.lock().expect("locked");
        let (_, temporary) = TempFile::begin(folder.path()).expect("writable");
        let stay = [".other.tmp", ".sinew-alive.0.tmp", ".sinew-alive.tmp", ".sinew-folder.tmp", ".sinew-my notes.tmp", "sinew.tmp"];
        let own = names(folder.path()).into_iter().filter(|name| !stay.contains(&name.as_str())).count();
        assert_eq!((own, names(folder.path()).len()), (2, stay.len() + 2), "{:?}", names(folder.path()));
        // A second one in the same program neither takes the first away nor makes another mark.
        let (_, second) = TempFile::begin(folder.path()).expect("writable");
        assert_eq!(names(folder.path()).len(), stay.len() + 3);
        assert!(temporary.path().is_file() && second.path().is_file());
        second.persist(&at("result")).expect("renamed");
        drop(temporary);
        let mut expected: Vec<String> = stay.iter().map(|name| (*name).to_owned()).collect();
        expected.push("result".to_owned());
        expected.sort();
        assert_eq!(names(folder.path()), expected);
    }

    #[test]
    fn what_cannot_be_put_in_place_goes() {
        let folder = tempfile::tempdir().expect("a folder");
        let (_, temporary) = TempFile::begin(folder.path()).expect("writable");
        fs::create_dir_all(folder.path().join("full/x")).expect("made");
        assert!(temporary.persist(&folder.path().join("full")).is_err());
        assert_eq!(names(folder.path()), ["full"]);
    }
}
