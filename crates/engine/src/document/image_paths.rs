//! Where the images of a file lie, and which of them are one and the same.

use std::collections::HashMap;
use std::fs::{self, File};
use std::hash::{BuildHasher, Hasher};
use std::io::{BufRead, BufReader};
use std::ops::Range;
use std::path::{Component, Path, PathBuf};

use super::image_decoder::{ImageReadError, ImageStream, in_memory};
use sinew_scene::limits;
use sinew_scene::message;
use sinew_scene::message::SourceName;

/// A folder of many thousands of files is not searched to its end.
const ENTRIES: usize = 10_000;

/// The images of one file.
#[derive(Debug)]
pub(super) struct FileImages {
    /// The file.
    pub name: SourceName,
    /// Where it lies.
    pub folder: PathBuf,
    /// Image files in it, by their path.
    pub archived: Vec<(PathBuf, Vec<u8>)>,
    /// Its images in the scene.
    pub images: Range<usize>,
}

/// Where an image lies.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ImageLocation<'f> {
    /// In an archive or in the document itself.
    Archived {
        /// The path there.
        path: &'f Path,
        /// The file.
        bytes: &'f [u8],
    },
    /// A file beside the document.
    Disk(PathBuf),
}

impl ImageLocation<'_> {
    /// Its path, in the archive or on the disk.
    pub(super) fn path(&self) -> &Path {
        match self {
            Self::Archived { path, .. } => path,
            Self::Disk(path) => path,
        }
    }

    /// Whether it lies in an archive or in the document itself.
    pub(super) fn is_archived(&self) -> bool {
        matches!(self, Self::Archived { .. })
    }

    fn length(&self) -> u64 {
        match self {
            Self::Archived { bytes, .. } => bytes.len() as u64,
            Self::Disk(path) => fs::metadata(path).map_or(0, |about| about.len()),
        }
    }

    /// Its bytes.
    pub(super) fn stream(&self) -> Result<Box<dyn ImageStream + '_>, ImageReadError> {
        match self {
            Self::Archived { bytes, .. } => Ok(in_memory(bytes)),
            Self::Disk(path) => {
                if self.length() > limits::IMAGE_BYTES {
                    return Err(ImageReadError::Broken(message!("document-too-large", limit = limits::IMAGE_BYTES >> 20)));
                }
                Ok(Box::new(BufReader::with_capacity(1 << 16, File::open(path)?)))
            }
        }
    }
}

/// How the images of a file are found.
pub(super) struct ImageLocator<'f> {
    folder: PathBuf,
    /// Files in the archive by path, and the first of each name.
    archived: HashMap<&'f Path, &'f [u8]>,
    named: HashMap<&'f std::ffi::OsStr, (&'f Path, &'f [u8])>,
    /// Files in the folder by their name in small letters; listed when a name is first looked for.
    listed: Option<HashMap<String, Vec<PathBuf>>>,
    found: HashMap<String, Option<ImageLocation<'f>>>,
}

impl<'f> ImageLocator<'f> {
    pub(super) fn of(file: &'f FileImages) -> Self {
        let (mut archived, mut named) = (HashMap::new(), HashMap::new());
        for (path, bytes) in &file.archived {
            archived.entry(path.as_path()).or_insert(bytes.as_slice());
            if let Some(name) = path.file_name() {
                named.entry(name).or_insert((path.as_path(), bytes.as_slice()));
            }
        }
        let folder = if file.folder.as_os_str().is_empty() { PathBuf::from(".") } else { file.folder.clone() };
        Self { folder, archived, named, listed: None, found: HashMap::new() }
    }

    /// The image that a reference means; `None` where there is none.
    pub(super) fn find(&mut self, uri: &str) -> Option<ImageLocation<'f>> {
        if let Some(known) = self.found.get(uri) {
            return known.clone();
        }
        let location = self.in_archive(uri).or_else(|| self.on_disk(uri).map(ImageLocation::Disk));
        self.found.insert(uri.to_owned(), location.clone());
        location
    }

    fn in_archive(&self, uri: &str) -> Option<ImageLocation<'f>> {
        let wanted = Path::new(uri).components().filter(|part| matches!(part, Component::Normal(_))).collect::<PathBuf>();
        let same = self.archived.get_key_value(wanted.as_path()).map(|(path, bytes)| (*path, *bytes));
        let (path, bytes) = same.or_else(|| self.named.get(wanted.file_name()?).copied())?;
        Some(ImageLocation::Archived { path, bytes })
    }

    /// The file that `uri` means: relative to the folder, else by its file name in the folder, whatever its case.
    fn on_disk(&mut self, uri: &str) -> Option<PathBuf> {
        let uri = Path::new(uri);
        let name = uri.file_name()?;
        let relative = uri.is_relative().then(|| self.folder.join(uri));
        let there = [relative, Some(self.folder.join(name))].into_iter().flatten().find(|path| is_image_file(path));
        there.or_else(|| {
            let listed = self.listed.get_or_insert_with(|| list(&self.folder));
            listed.get(&name.to_string_lossy().to_lowercase())?.iter().find(|path| is_image_file(path)).cloned()
        })
    }
}

fn list(folder: &Path) -> HashMap<String, Vec<PathBuf>> {
    let mut listed: HashMap<String, Vec<PathBuf>> = HashMap::new();
    for entry in fs::read_dir(folder).into_iter().flatten().take(ENTRIES).flatten() {
        listed.entry(entry.file_name().to_string_lossy().to_lowercase()).or_default().push(entry.path());
    }
    listed
}

fn is_image_file(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|about| about.is_file())
}

/// Image files with what they are the images of, those that are one and the same put together.
pub(super) struct SharedImages<'f, T> {
    locations: Vec<(ImageLocation<'f>, Vec<T>)>,
    by_path: HashMap<PathBuf, usize>,
    by_address: HashMap<*const u8, usize>,
}

impl<T> Default for SharedImages<'_, T> {
    fn default() -> Self {
        Self { locations: Vec::new(), by_path: HashMap::new(), by_address: HashMap::new() }
    }
}

impl<'f, T> SharedImages<'f, T> {
    /// Adds a user of a place.
    pub(super) fn add(&mut self, location: ImageLocation<'f>, user: T) {
        let next = self.locations.len();
        let known = match &location {
            ImageLocation::Archived { bytes, .. } => *self.by_address.entry(bytes.as_ptr()).or_insert(next),
            ImageLocation::Disk(path) => *self.by_path.entry(path.canonicalize().unwrap_or_else(|_| path.clone())).or_insert(next),
        };
        match self.locations.get_mut(known) {
            Some((_, users)) => users.push(user),
            None => self.locations.push((location, vec![user])),
        }
    }

    /// All places with their users; places with the same bytes and the same ending are one. Only files of one length are read for it.
    pub(super) fn shared(self) -> Vec<(ImageLocation<'f>, Vec<T>)> {
        let ending = |location: &ImageLocation<'_>| location.path().extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let mut lengths: HashMap<u64, usize> = HashMap::new();
        self.locations.iter().for_each(|(location, _)| *lengths.entry(location.length()).or_default() += 1);
        let random = std::hash::RandomState::new();
        let mut alike: HashMap<_, Vec<usize>> = HashMap::new();
        let mut shared: Vec<(ImageLocation<'f>, Vec<T>)> = Vec::new();
        for (location, users) in self.locations {
            let length = location.length();
            if lengths.get(&length).is_some_and(|count| *count > 1)
                && let Ok(hash) = hash(&location, random.build_hasher())
            {
                let group = alike.entry((length, ending(&location), hash)).or_default();
                let duplicate =
                    group.iter().find(|other| shared.get(**other).is_some_and(|(other, _)| same(other, &location).unwrap_or(false)));
                if let Some((_, known)) = duplicate.and_then(|duplicate| shared.get_mut(*duplicate)) {
                    known.extend(users);
                    continue;
                }
                group.push(shared.len());
            }
            shared.push((location, users));
        }
        shared
    }
}

fn hash(location: &ImageLocation<'_>, mut hasher: impl Hasher) -> Result<u64, ImageReadError> {
    let mut stream = location.stream()?;
    loop {
        let piece = stream.fill_buf()?;
        if piece.is_empty() {
            return Ok(hasher.finish());
        }
        hasher.write(piece);
        let length = piece.len();
        stream.consume(length);
    }
}

fn same(a: &ImageLocation<'_>, b: &ImageLocation<'_>) -> Result<bool, ImageReadError> {
    let (mut a, mut b) = (a.stream()?, b.stream()?);
    loop {
        let (one, other) = (a.fill_buf()?, b.fill_buf()?);
        let length = one.len().min(other.len());
        if length == 0 {
            return Ok(one.len() == other.len());
        }
        if one.get(..length) != other.get(..length) {
            return Ok(false);
        }
        a.consume(length);
        b.consume(length);
    }
}
