//! The files that belong to what is open: no result of the program may replace one of them unasked.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use crate::app::handles::session_handle::SessionHandle;
use crate::output::OverwriteGuard;
use crate::{input, limits};

/// What is open beside the files that the session knows of.
#[derive(Default)]
pub(crate) struct OpenFiles {
    /// What this program wrote last, and where: that it changed is no news.
    written: RefCell<Option<(PathBuf, String)>>,
    /// The session file that what is open came from, or was saved to.
    session_file: RefCell<Option<PathBuf>>,
    /// What that session names, whether it could be opened or not.
    session_names: RefCell<Vec<PathBuf>>,
    /// The measured radii that muscles are compared with.
    table: RefCell<Option<PathBuf>>,
}

impl OpenFiles {
    /// Holds every file that is open, with what belongs to it: no result replaces one of them.
    pub(crate) fn guard(&self, session: &SessionHandle) -> OverwriteGuard {
        let (names, table) = (self.session_names.borrow().clone(), self.table.borrow().clone());
        session.read(|session| session.guard()).and(names).and(self.session_file()).and(table)
    }

    /// Says what was written to a file that may be watched.
    pub(crate) fn note_own_write(&self, path: PathBuf, text: String) {
        self.written.replace(Some((path, text)));
    }

    /// Whether a file holds what this program wrote there.
    pub(crate) fn is_ours_still(&self, path: &Path) -> bool {
        let written = self.written.borrow();
        written
            .as_ref()
            .is_some_and(|(ours, text)| ours == path && input::read_text(path, limits::YAML_BYTES).is_ok_and(|now| now == *text))
    }

    /// The session file that what is open came from, or was saved to last.
    pub(crate) fn session_file(&self) -> Option<PathBuf> {
        self.session_file.borrow().clone()
    }

    /// What is open was saved as this session file.
    pub(crate) fn saved_session(&self, path: PathBuf) {
        self.session_file.replace(Some(path));
    }

    /// What is open comes from this session file, which names these files; or from none.
    pub(crate) fn came_from(&self, session: Option<(PathBuf, Vec<PathBuf>)>) {
        let (file, names) = session.map_or_else(Default::default, |(file, names)| (Some(file), names));
        self.session_file.replace(file);
        self.session_names.replace(names);
    }

    /// Muscles are compared with the measured radii of this file, or no longer of any.
    pub(crate) fn compares_table(&self, path: Option<PathBuf>) {
        self.table.replace(path);
    }
}
