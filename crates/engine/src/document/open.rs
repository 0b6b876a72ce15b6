//! Opens files into one document.

use std::path::{Path, PathBuf};

use super::file;
use super::foreign::UnsupportedFormat;
use super::formats::Format;
use super::images::PendingImages;
use super::{Document, Finding, OpenError, OpenErrorKind, SceneReaders, Source, SourceKind, merge};
use crate::input;
use sinew_muscle::MuscleFile;
use sinew_scene::diagnostics::Diagnostic;
use sinew_scene::import::SceneReader;
use sinew_scene::limits;
use sinew_scene::message::{Location, SourceName};
use sinew_scene::progress::Progress;

/// What to do about the images that a file names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ImageLoading {
    /// Find and decode them.
    #[default]
    Decode,
    /// Find them and look at their heads only: enough to tell what is in a file, and quicker.
    Locate,
    /// As [`ImageLoading::Locate`], and read through those that fit into the memory for reading, to find broken ones; no picture is kept.
    Test,
}

/// How to open.
#[derive(Debug, Clone, Copy)]
pub struct OpenOptions {
    /// What reads scene files.
    pub readers: SceneReaders,
    /// Images: decoded or only located.
    pub images: ImageLoading,
}

impl OpenOptions {
    /// Everything is read by these readers, images are decoded.
    pub fn new(readers: SceneReaders) -> Self {
        Self { readers, images: ImageLoading::default() }
    }
}

impl Document {
    /// Opens files into one document: muscles, and scenes that one of `readers` reads, told apart by content where the ending says nothing. `-` is standard input.
    ///
    /// # Errors
    /// [`OpenError`] for the first file that cannot be used.
    pub fn open<P: AsRef<Path>>(files: &[P], readers: SceneReaders, progress: &Progress) -> Result<Self, OpenError> {
        Self::open_with(files, OpenOptions::new(readers), progress)
    }

    /// [`Document::open`] with a choice of what is loaded.
    ///
    /// # Errors
    /// [`OpenError`] for the first file that cannot be used.
    pub fn open_with<P: AsRef<Path>>(files: &[P], options: OpenOptions, progress: &Progress) -> Result<Self, OpenError> {
        let mut document = Self::default();
        // Images have one budget, whatever file they belong to, so they wait for the last of these.
        let mut images = PendingImages::default();
        for path in files {
            document.add_file(path.as_ref(), options.readers, &mut images, progress)?;
        }
        document.add_named_clips(options.readers, &mut images, progress);
        images.load(&mut document, options.images, progress);
        if progress.is_cancelled() {
            let name = files.last().map_or(SourceName::Unknown, |path| SourceName::of_argument(path.as_ref()));
            return Err(OpenError::whole(&name, OpenErrorKind::Cancelled));
        }
        document.place_muscles();
        Ok(document)
    }

    /// Opens the clips that muscle files name and that are not open yet. One that cannot be opened is a finding: the muscles are shown without it.
    fn add_named_clips(&mut self, readers: SceneReaders, images: &mut PendingImages, progress: &Progress) {
        for index in 0..self.sources.len() {
            let source = &self.sources[index];
            let SourceKind::Muscles(file, _) = &source.kind else { continue };
            let Some(path) = named_clip(source, file) else { continue };
            if self.sources.iter().any(|source| source.path.as_deref().is_some_and(|other| is_same(other, &path))) {
                continue;
            }
            let name = source.name.clone();
            if let Err(error) = self.add_file(&path, readers, images, progress) {
                let finding = Finding::ClipNotOpened(Box::new(error));
                self.diagnostics.push(Diagnostic::new(finding, None, path.display().to_string()).in_file(name));
            }
        }
    }

    /// Every file that it was made from: those that were opened, the clips that muscle files name, whether they could be opened or not, and images.
    pub fn files(&self) -> Vec<PathBuf> {
        let opened = self.sources.iter().filter_map(|source| source.path.clone());
        let clips = self.sources.iter().filter_map(|source| match &source.kind {
            SourceKind::Muscles(file, _) => named_clip(source, file),
            SourceKind::Scene(_) => None,
        });
        let images = self.scene.images.iter().filter_map(|image| image.path.clone());
        opened.chain(clips).chain(images).collect()
    }

    /// `file`, made of muscle file `index`, as it is to be written to `target`: its clip is named from there. That is the one that the muscle file names;
    /// where only another one is open, or it names none and stands on bones, the first that is open.
    pub fn muscle_file_for(&self, index: usize, file: &MuscleFile, target: &Path) -> MuscleFile {
        let is_muscles = |source: &&Source| matches!(source.kind, SourceKind::Muscles(..));
        let named = self.sources.iter().filter(is_muscles).nth(index).and_then(|source| named_clip(source, file));
        let open =
            || self.sources.iter().filter(|source| matches!(source.kind, SourceKind::Scene(_))).filter_map(|source| source.path.clone());
        let is_open = named.as_ref().is_some_and(|named| open().any(|clip| is_same(&clip, named)));
        let on_clip = file.arm.is_none() && file.muscles.iter().any(|muscle| muscle.origin.is_some());
        let stands_in = open().next().filter(|_| !is_open && (named.is_some() || on_clip));
        let clip = stands_in.or(named).map(|clip| input::named_from(target.parent().unwrap_or(Path::new("")), &clip));
        MuscleFile { clip: clip.or_else(|| file.clip.clone()), ..file.clone() }
    }

    fn add_file(&mut self, path: &Path, readers: SceneReaders, images: &mut PendingImages, progress: &Progress) -> Result<(), OpenError> {
        let name = SourceName::of_argument(path);
        let bytes = file::read(path, &name, limits::FILE_BYTES)?;
        if let Some(foreign) = UnsupportedFormat::of(path, &bytes, readers) {
            return Err(OpenError::whole(&name, OpenErrorKind::UnsupportedFormat(foreign)));
        }
        let format = Format::of(path, &bytes, readers);
        if bytes.len() as u64 > format.limit() {
            return Err(OpenError::whole(&name, OpenErrorKind::TooLarge(format.limit())));
        }
        match format {
            Format::Scene(reader) => self.add_scene(reader, bytes, &name, path, images, progress),
            Format::Muscles => add_muscles(self, &bytes, &name, path),
        }
    }

    fn add_scene(
        &mut self,
        reader: &dyn SceneReader,
        bytes: Vec<u8>,
        name: &SourceName,
        path: &Path,
        images: &mut PendingImages,
        progress: &Progress,
    ) -> Result<(), OpenError> {
        let mut imported = reader.read(&bytes, name.path().unwrap_or_default(), progress).map_err(|error| OpenError {
            location: Location { file: name.clone(), line: error.line, column: None },
            kind: OpenErrorKind::Reader(error),
        })?;
        drop(bytes);
        let asset = imported.asset.clone();
        let (first, archived) = (self.scene.images.len(), std::mem::take(&mut imported.archived));
        let root = merge::append(self, imported, name);
        images.add(name, path.parent().unwrap_or(Path::new("")), archived, first..self.scene.images.len());
        self.sources.push(Source { name: name.clone(), path: real_path(path), root, kind: SourceKind::Scene(asset) });
        Ok(())
    }
}

/// Adds a muscle file to the document; [`Document::place_muscles`] puts it into the scene.
pub(super) fn add_muscles(document: &mut Document, bytes: &[u8], name: &SourceName, path: &Path) -> Result<(), OpenError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = bytes.get(..error.valid_up_to()).map(input::line_after);
        OpenError { location: Location { file: name.clone(), line, column: None }, kind: OpenErrorKind::NotText }
    })?;
    let file = MuscleFile::parse(text).map_err(|error| OpenError {
        location: Location { file: name.clone(), line: error.line, column: error.column },
        kind: OpenErrorKind::Muscles(Box::new(error.kind)),
    })?;
    if !MuscleFile::can_be_drawn(document.muscle_files().chain([&file])) {
        return Err(OpenError::whole(name, OpenErrorKind::TooMuchSurface));
    }
    document.sources.push(Source {
        name: name.clone(),
        path: real_path(path),
        root: None,
        kind: SourceKind::Muscles(Box::new(file), Box::default()),
    });
    Ok(())
}

/// The file of the clip that a muscle file names: relative to the muscle file; of an absolute path the name alone.
fn named_clip(source: &Source, file: &MuscleFile) -> Option<PathBuf> {
    let clip = Path::new(file.clip.as_ref()?);
    let relative = if clip.is_relative() { clip } else { Path::new(clip.file_name()?) };
    Some(input::named_in(source.path.as_deref().and_then(Path::parent).unwrap_or(Path::new("")), relative))
}

fn is_same(one: &Path, other: &Path) -> bool {
    match (one.canonicalize(), other.canonicalize()) {
        (Ok(one), Ok(other)) => one == other,
        _ => one == other,
    }
}

fn real_path(path: &Path) -> Option<PathBuf> {
    (!path.as_os_str().is_empty() && path.as_os_str() != "-").then(|| path.to_owned())
}
