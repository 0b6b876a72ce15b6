//! Opens files, or a session file that names them.

use std::path::{Path, PathBuf};

use super::SessionState;
use crate::document::{Document, OpenError, OpenOptions};
use crate::input;
use crate::output::OverwriteGuard;
use sinew_scene::message::{Location, SourceName};
use sinew_scene::progress::Progress;

/// What was opened.
#[derive(Debug)]
pub struct Opened {
    /// The files in one scene.
    pub document: Document,
    /// The session, where the file was one. Its hidden nodes are hidden in the document already; joints are rotated by [`SessionState::pose_state`].
    pub session: Option<Box<SessionState>>,
    /// The file that a session compares with, where it names one that can be opened.
    pub compared: Option<(PathBuf, Document)>,
}

impl Opened {
    /// Protects from overwriting: every file that was opened, and those that a session names, opened or not. `folder` is that of the session file.
    pub fn guard(&self, folder: &Path) -> OverwriteGuard {
        let named = self.session.iter().flat_map(|session| session.all_files(folder));
        guard_of(&self.document, self.compared.as_ref().map(|(file, other)| (file.as_path(), other))).and(named)
    }
}

/// Protects every file that a document and its comparison were read from: also clips that muscles name, and images.
pub fn guard_of(document: &Document, compared: Option<(&Path, &Document)>) -> OverwriteGuard {
    let with = compared.into_iter().flat_map(|(file, other)| std::iter::once(file.to_owned()).chain(other.files()));
    OverwriteGuard::of_document(document).and(with)
}

/// Opens files, or the files that a session file names.
///
/// # Errors
/// [`OpenError`] for the first file that cannot be used. A file that is only compared with is ignored instead.
pub fn open<P: AsRef<Path>>(paths: &[P], options: OpenOptions, progress: &Progress) -> Result<Opened, OpenError> {
    let plain = || Ok(Opened { document: Document::open_with(paths, options, progress)?, session: None, compared: None });
    let [path] = paths else { return plain() };
    let path = path.as_ref();
    let session = match SessionState::read(path) {
        None => return plain(),
        Some(Ok(session)) => session,
        Some(Err(error)) => {
            return Err(OpenError {
                location: Location { file: SourceName::of_argument(path), line: error.line, column: None },
                kind: error.kind,
            });
        }
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let files = session.paths(folder);
    let mut document = if files.is_empty() { Document::built_in() } else { Document::open_with(&files, options, progress)? };
    session.apply_to_document(&mut document);
    let other = session.compared.as_ref().and_then(|compared| compared.file.as_ref()).map(|file| input::named_in(folder, file));
    let compared = other.and_then(|file| Some((file.clone(), Document::open_with(&[file], options, progress).ok()?)));
    Ok(Opened { document, session: Some(Box::new(session)), compared })
}
