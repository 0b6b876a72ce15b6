//! Protection of input files: no result may replace a file that it is made from, or one that is open.
//!
//! Every writer takes an [`Output`], and only an [`OverwriteGuard`] makes one, so the check cannot be forgotten.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::OutputError;
use crate::document::Document;

/// How many symbolic links are followed to a file that is not there yet; systems give up at about as many.
const LINKS: usize = 40;

/// How many numbers are tried for a free name.
const NUMBERS: usize = 10_000;

/// Files that no result may replace, by whatever name: through symbolic and hard links, `./a/../b`, another mount or, where the file system does not
/// tell them apart, capital letters.
#[derive(Debug, Clone, Default)]
pub struct OverwriteGuard {
    protected: Arc<Vec<PathBuf>>,
    /// Where they lie, so that one that has gone since does not come back as a result.
    places: Arc<HashSet<PathBuf>>,
}

/// A file that may be written.
#[derive(Debug, Clone)]
pub struct Output {
    file: PathBuf,
    guard: OverwriteGuard,
}

impl OverwriteGuard {
    /// Holds these files; `-` is what standard input reads.
    pub fn of_files<P: Into<PathBuf>>(files: impl IntoIterator<Item = P>) -> Self {
        Self::default().and(files)
    }

    /// Holds every file that a document was made from.
    pub fn of_document(document: &Document) -> Self {
        Self::of_files(document.files())
    }

    /// Holds these files too.
    #[must_use]
    pub fn and<P: Into<PathBuf>>(&self, files: impl IntoIterator<Item = P>) -> Self {
        let named = |file: PathBuf| if file.as_os_str() == "-" { PathBuf::from("/dev/stdin") } else { file };
        let protected = self.protected.iter().cloned().chain(files.into_iter().map(|file| named(file.into()))).collect();
        Self::protecting(protected)
    }

    /// Protects the files of another guard too.
    #[must_use]
    pub fn and_of(&self, other: &Self) -> Self {
        self.and(other.protected.iter().cloned())
    }

    /// Holds all but this file: what is saved where it came from replaces itself.
    #[must_use]
    pub fn without(&self, own: Option<&Path>) -> Self {
        let Some(own) = own else { return self.clone() };
        Self::protecting(self.protected.iter().filter(|protected| !is_same(protected, own)).cloned().collect())
    }

    fn protecting(protected: Vec<PathBuf>) -> Self {
        let places = protected.iter().map(|file| place(file)).collect();
        Self { protected: Arc::new(protected), places: Arc::new(places) }
    }

    /// `file` as one that may be written.
    ///
    /// # Errors
    /// [`OutputError::Held`] where it is one of the files that are held.
    pub fn output(&self, file: &Path) -> Result<Output, OutputError> {
        let output = Output { file: file.to_owned(), guard: self.clone() };
        output.check()?;
        Ok(output)
    }

    /// A name for a result in `folder` under which nothing lies there yet and nothing that is held would be replaced: `name` itself, else with a number
    /// before its ending. `written` tells which files a result of a name consists of.
    pub fn free_name(&self, folder: &Path, name: &str, written: impl Fn(&Path) -> Vec<PathBuf>) -> String {
        let (stem, ending) = name.rsplit_once('.').map_or((name, String::new()), |(stem, ending)| (stem, format!(".{ending}")));
        let is_free =
            |name: &String| written(&folder.join(name)).iter().all(|file| fs::symlink_metadata(file).is_err() && !self.protects(file));
        let numbered = (1..NUMBERS).map(|number| format!("{stem}-{number}{ending}"));
        std::iter::once(name.to_owned()).chain(numbered).find(is_free).unwrap_or_else(|| name.to_owned())
    }

    fn protects(&self, file: &Path) -> bool {
        if self.places.contains(&place(file)) {
            return true;
        }
        // What is not there is no other name of anything.
        identity(file).is_some_and(|there| self.protected.iter().any(|protected| identity(protected).as_ref() == Some(&there)))
    }
}

impl Output {
    /// A file of the program's own, such as its settings, which no person chooses and nothing is made from.
    pub fn of_program(file: &Path) -> Self {
        Self { file: file.to_owned(), guard: OverwriteGuard::default() }
    }

    /// The file.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// Another file that belongs to the same result.
    ///
    /// # Errors
    /// As [`OverwriteGuard::output`].
    pub fn with(&self, file: &Path) -> Result<Self, OutputError> {
        self.guard.output(file)
    }

    /// Whether it may be written still: a link may have been laid since.
    ///
    /// # Errors
    /// As [`OverwriteGuard::output`].
    pub(super) fn check(&self) -> Result<(), OutputError> {
        if self.guard.protects(&self.file) { Err(OutputError::Held { file: self.file.clone() }) } else { Ok(()) }
    }
}

/// Whether two names mean one file.
pub fn is_same(one: &Path, other: &Path) -> bool {
    place(one) == place(other) || identity(one).is_some_and(|one| Some(one) == identity(other))
}

/// What tells a file that is there from every other one.
#[cfg(unix)]
fn identity(file: &Path) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    fs::metadata(file).ok().map(|found| (found.dev(), found.ino()))
}

/// What tells a file that is there from every other one.
#[cfg(not(unix))]
fn identity(file: &Path) -> Option<PathBuf> {
    file.canonicalize().ok()
}

/// Where a file lies, or would lie: symbolic links are followed, also to a file that is not there.
pub(super) fn place(file: &Path) -> PathBuf {
    let mut file = file.to_owned();
    for _ in 0..LINKS {
        if let Ok(place) = fs::canonicalize(&file) {
            return place;
        }
        let folder = match file.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        match fs::read_link(&file) {
            Ok(target) => file = folder.join(target),
            Err(_) => {
                let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
                return file.file_name().map_or_else(|| file.clone(), |name| folder.join(name));
            }
        }
    }
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_held_by_every_name() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("sub")).expect("made");
        fs::write(at("clip.dae"), "x").expect("written");
        let mut names = vec![at("clip.dae"), at("./sub/../clip.dae")];
        #[cfg(unix)]
        {
            use std::os::unix::fs::symlink;
            symlink(at("clip.dae"), at("soft.png")).expect("links work");
            symlink("soft.png", at("soft-of-soft.png")).expect("links work");
            symlink(folder.path(), at("sub/back")).expect("links work");
            fs::hard_link(at("clip.dae"), at("hard.png")).expect("links work");
            names.extend(["soft.png", "soft-of-soft.png", "sub/back/clip.dae", "hard.png"].map(at));
        }
        let guard = OverwriteGuard::of_files([at("sub/../clip.dae")]);
        for name in &names {
            assert!(matches!(guard.output(name), Err(OutputError::Held { .. })), "{}", name.display());
            assert!(guard.without(Some(name)).output(&at("clip.dae")).is_ok(), "{}", name.display());
        }
        for other in ["clip.png", "sub/clip.dae", "new/clip.dae"] {
            assert!(guard.output(&at(other)).is_ok(), "{other}");
        }
    }

    #[test]
    fn a_free_name_is_one_that_may_be_written_and_replaces_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        let guard = OverwriteGuard::of_files([at("walk.png"), at("gone-2.png")]);
        for name in ["walk.png", "walk-1.png", "walk-2.obj", "arm.mtl", "gone.png", "gone-1.png"] {
            fs::write(at(name), "x").expect("written");
        }
        let one = |file: &Path| vec![file.to_owned()];
        let with_library = |file: &Path| vec![file.to_owned(), file.with_extension("mtl")];
        for (name, expected) in [("walk.png", "walk-2.png"), ("new.png", "new.png"), ("gone.png", "gone-3.png"), ("walk", "walk")] {
            let free = guard.free_name(folder.path(), name, one);
            assert_eq!(free, expected);
            assert!(guard.output(&at(&free)).is_ok() && !at(&free).exists());
        }
        assert_eq!(guard.free_name(folder.path(), "arm.obj", with_library), "arm-1.obj");
    }

    #[test]
    fn a_file_that_has_gone_is_held_still() {
        let folder = tempfile::tempdir().expect("a folder");
        let clip = folder.path().join("clip.dae");
        let guard = OverwriteGuard::of_files([&clip]);
        assert!(guard.output(&clip).is_err());
        #[cfg(unix)]
        {
            let link = folder.path().join("link.png");
            std::os::unix::fs::symlink("clip.dae", &link).expect("links work");
            assert!(guard.output(&link).is_err());
        }
        assert!(guard.output(&folder.path().join("other.dae")).is_ok());
    }
}
