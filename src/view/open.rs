//! Opens files, or a session file that names them.

use std::path::{Path, PathBuf};

use super::Saved;
use crate::collada::Progress;
use crate::document::{Document, OpenError, OpenOptions};
use crate::export::guard::Guard;
use crate::input;

/// What was opened.
#[derive(Debug)]
pub struct Opened {
    /// The files in one scene.
    pub document: Document,
    /// How a session file says that it is to be looked at, where it was one. Nodes it hides are hidden and joints it turns are turned.
    pub saved: Option<Box<Saved>>,
    /// The file that a session compares with, where it names one that can be opened.
    pub compared: Option<(PathBuf, Document)>,
}

impl Opened {
    /// Holds everything that was opened, and what a session names besides, whether that could be opened or not; `folder` is that of the session file.
    pub fn guard(&self, folder: &Path) -> Guard {
        let named = self.saved.iter().flat_map(|saved| saved.every_file(folder));
        held(&self.document, self.compared.as_ref().map(|(file, other)| (file.as_path(), other))).and(named)
    }
}

/// Holds every file that a document and the one that it is compared with were made from: clips that muscles name and images too.
pub fn held(document: &Document, compared: Option<(&Path, &Document)>) -> Guard {
    let with = compared.into_iter().flat_map(|(file, other)| std::iter::once(file.to_owned()).chain(other.files()));
    Guard::of_document(document).and(with)
}

/// Opens files, or the files that a session file names.
///
/// # Errors
/// [`OpenError`] for the first file that cannot be used. A file that is only compared with is left out instead.
pub fn open<P: AsRef<Path>>(paths: &[P], options: OpenOptions, progress: &Progress) -> Result<Opened, OpenError> {
    let plain = || Ok(Opened { document: Document::open_with(paths, options, progress)?, saved: None, compared: None });
    let [path] = paths else { return plain() };
    let path = path.as_ref();
    let saved = match Saved::read(path) {
        None => return plain(),
        Some(Ok(saved)) => saved,
        Some(Err(error)) => {
            return Err(OpenError { file: path.display().to_string(), line: error.line, column: None, message: error.message });
        }
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let files = saved.paths(folder);
    let mut document = if files.is_empty() { Document::built_in() } else { Document::open_with(&files, options, progress)? };
    saved.prepare(&mut document);
    let other = saved.compared.as_ref().and_then(|compared| compared.file.as_ref()).map(|file| input::named_in(folder, file));
    let compared = other.and_then(|file| Some((file.clone(), Document::open_with(&[file], options, progress).ok()?)));
    Ok(Opened { document, saved: Some(Box::new(saved)), compared })
}
