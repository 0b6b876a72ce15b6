//! Muscles that are not saved, kept where a crash cannot take them: in a file of the user's state folder, which the next start offers to bring back.

use std::cell::{Cell, RefCell};
use std::fs::TryLockError;
use std::path::{Path, PathBuf};
use std::rc::{Rc, Weak};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::document_loader::DocumentLoader;
use crate::app::widgets::ui;
use crate::i18n::Sentence;
use crate::session::Session;
use crate::tr;
use crate::view::RecoveryFile;

/// The first change is written down at once; those that follow are gathered for so long.
const WRITE_DELAY: Duration = Duration::from_millis(500);
/// A program that is ending may hold its file for a moment still, as while it writes down what it was: so often is looked again, and so far apart.
const MAX_CHECKS: u32 = 20;
const CHECK_INTERVAL: Duration = Duration::from_millis(500);
/// What the names of these files begin with; the number of the process follows.
const NAME: &str = "unsaved-";

ui::widgets! {
    /// The widgets of the bar.
    struct RecoveryBarWidgets from "recovery_bar.ui" {
        root: gtk::InfoBar,
        message: gtk::Label,
    }
}

/// The recovery file of a window, and the bar that offers those of others.
pub(crate) struct Autosave {
    /// The bar.
    pub root: gtk::InfoBar,
    widgets: RecoveryBarWidgets,
    path: PathBuf,
    gathering: Cell<bool>,
    /// Something changed since it was written down last.
    changed: Cell<bool>,
    /// Held while there is a file of this window's.
    lock: RefCell<Option<Lock>>,
    told: Cell<bool>,
    offered: RefCell<Option<LeftoverFile>>,
    loader: Rc<DocumentLoader>,
}

/// A recovery file of a program that has ended, locked against others.
struct LeftoverFile {
    path: PathBuf,
    unsaved: RecoveryFile,
    lock: Lock,
}

/// Lock that shows other programs that this recovery file is in use. The system releases it with the program, however that ends.
struct Lock {
    path: PathBuf,
    /// Never read; the lock lives as long as it does.
    _file: std::fs::File,
}

impl Lock {
    /// Takes the lock of a file; `None` where another has it.
    fn of(path: &Path) -> Option<Self> {
        let path = path.with_extension("lock");
        let file = std::fs::OpenOptions::new().create(true).append(true).open(&path).ok()?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => None,
            // On a file system without locks the first program takes it.
            Ok(()) | Err(TryLockError::Error(_)) => Some(Self { path, _file: file }),
        }
    }
}

impl Autosave {
    /// Nothing written, nothing offered; what is brought back is opened by `loader`.
    pub(crate) fn new(loader: &Rc<DocumentLoader>) -> Rc<Self> {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let widgets = RecoveryBarWidgets::build();
        let name = format!("{NAME}{}-{}.yaml", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        let autosave = Rc::new(Self {
            root: widgets.root.clone(),
            widgets,
            path: folder().join(name),
            gathering: Cell::default(),
            changed: Cell::default(),
            lock: RefCell::default(),
            told: Cell::default(),
            offered: RefCell::default(),
            loader: loader.clone(),
        });
        autosave.root.set_visible(false);
        autosave.root.connect_response(glib::clone!(
            #[weak]
            autosave,
            move |_, response| autosave.answer(response)
        ));
        autosave
    }

    /// Does what the user answered to the offer.
    fn answer(&self, response: gtk::ResponseType) {
        // Else the keyboard goes from the button that is hidden to the next widget, the search, and Ctrl+Z with it.
        self.loader.app.focus.take();
        self.fold();
        let Some(left) = self.offered.take() else { return };
        match response {
            gtk::ResponseType::Accept => restore(&self.loader, left),
            gtk::ResponseType::Reject => left.forget(),
            _ => {}
        }
    }

    /// Offers what a program that ended without saving has left.
    pub(crate) fn offer(self: &Rc<Self>) {
        self.look(MAX_CHECKS);
    }

    fn look(self: &Rc<Self>, checks: u32) {
        let Some(left) = left_behind(&folder()) else {
            if checks > 1 && has_others(&folder(), &self.path) {
                let weak = Rc::downgrade(self);
                glib::timeout_add_local_once(CHECK_INTERVAL, move || {
                    if let Some(autosave) = weak.upgrade() {
                        autosave.look(checks - 1);
                    }
                });
            }
            return;
        };
        let files = &left.unsaved.files;
        let names = files.iter().filter_map(|path| path.file_name()).map(|name| name.to_string_lossy()).collect::<Vec<_>>();
        let what = if names.is_empty() { tr!("document-built-in") } else { names.join(" + ") };
        self.widgets.message.set_text(&tr!("app-recovery", what = what));
        self.offered.replace(Some(left));
        self.root.set_visible(true);
        self.root.set_revealed(true);
    }

    fn fold(&self) {
        self.root.set_revealed(false);
        self.root.set_visible(false);
    }

    /// The muscles, or whether they are saved, changed: at once they are written down, or the file goes.
    pub(crate) fn note(self: &Rc<Self>, session: &Session) {
        if !session.is_unsaved() {
            return self.clear();
        }
        self.changed.set(true);
        if self.gathering.replace(true) {
            return;
        }
        let weak = Rc::downgrade(self);
        glib::idle_add_local_once(move || write_recovery_file(&weak));
    }

    fn write(&self, unsaved: &RecoveryFile) {
        self.changed.set(false);
        // The lock comes first: a file without one is anybody's.
        if self.lock.borrow().is_none() {
            let folder = self.path.parent().map_or(Ok(()), std::fs::create_dir_all);
            self.lock.replace(folder.ok().and_then(|()| Lock::of(&self.path)));
        }
        match unsaved.write(&self.path) {
            Ok(()) => {}
            // Once is enough: the folder will not get writable by being complained about.
            Err(error) if !self.told.replace(true) => eprintln!("{}", tr!("app-recovery-unwritten", reason = error.sentence())),
            Err(_) => {}
        }
    }

    /// Everything is saved, or was discarded by the user.
    pub(crate) fn clear(&self) {
        self.changed.set(false);
        if let Some(lock) = self.lock.take() {
            forget_files(&self.path, &lock);
        }
    }
}

/// Writes down what is not saved, and again a moment later where it changed meanwhile.
fn write_recovery_file(weak: &Weak<Autosave>) {
    let Some(autosave) = weak.upgrade() else { return };
    match autosave.loader.app.session.read(|session| session.recovery_file()) {
        Some(unsaved) => autosave.write(&unsaved),
        None => autosave.clear(),
    }
    let weak = weak.clone();
    glib::timeout_add_local_once(WRITE_DELAY, move || {
        let Some(autosave) = weak.upgrade() else { return };
        if autosave.changed.get() {
            return write_recovery_file(&weak);
        }
        autosave.gathering.set(false);
    });
}

impl LeftoverFile {
    /// It was brought back, or is not wanted.
    fn forget(self) {
        forget_files(&self.path, &self.lock);
    }
}

/// Opens the files that were open, and puts the muscles that were not saved into them. What was left is kept until they are there.
fn restore(loader: &Rc<DocumentLoader>, left: LeftoverFile) {
    let Some(muscles) = left.unsaved.muscle_files() else { return };
    loader.open_with_state(left.unsaved.files.clone(), muscles, move || left.forget());
}

/// A file that cannot be removed is offered again; nothing is lost by that.
fn forget_files(path: &Path, lock: &Lock) {
    let _ = std::fs::remove_file(path);
    let _ = std::fs::remove_file(&lock.path);
}

/// Where these files are.
fn folder() -> PathBuf {
    let state = std::env::var_os("XDG_STATE_HOME").map(PathBuf::from).filter(|path| path.is_absolute());
    state.unwrap_or_else(|| glib::home_dir().join(".local").join("state")).join("sinew")
}

/// The files of all programs, whether they run or not.
fn all(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter(|entry| entry.file_name().to_str().is_some_and(is_ours)).map(|entry| entry.path()).collect()
}

/// Whether there are files of others than this window.
fn has_others(folder: &Path, own: &Path) -> bool {
    all(folder).iter().any(|path| path != own)
}

/// The newest file of a program that no longer runs.
fn left_behind(folder: &Path) -> Option<LeftoverFile> {
    let dated = |path: PathBuf| Some((std::fs::metadata(&path).ok()?.modified().ok()?, path));
    let mut left: Vec<_> = all(folder).into_iter().filter_map(dated).collect();
    left.sort();
    left.into_iter().rev().find_map(|(_, path)| {
        let unsaved = RecoveryFile::read(&path)?;
        let lock = Lock::of(&path)?;
        // Another window may have brought it back meanwhile.
        path.exists().then_some(LeftoverFile { path, unsaved, lock })
    })
}

/// Whether a file is one of these, by its name.
fn is_ours(name: &str) -> bool {
    let numbers = name.strip_prefix(NAME).and_then(|name| name.strip_suffix(".yaml"));
    numbers.is_some_and(|numbers| numbers.split('-').all(|number| number.parse::<u32>().is_ok()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use crate::muscle::Edit;
    use crate::scene::MuscleId;
    use crate::session::UndoStep;

    #[test]
    fn what_is_not_saved_is_found_again() {
        let folder = tempfile::tempdir().unwrap();
        let mut session = Session::new(Document::built_in());
        assert_eq!(session.recovery_file(), None);
        session.edit_muscle(MuscleId(0), &Edit::Radius(2, 33.25), UndoStep::New).unwrap();
        let unsaved = session.recovery_file().unwrap();
        let path = folder.path().join(format!("{NAME}7-0.yaml"));
        unsaved.write(&path).unwrap();
        std::fs::write(folder.path().join(format!("{NAME}7-1.yaml")), "files: [").unwrap();
        // Newer than it, of a program that runs still; and a number is no sign of it, for numbers come again.
        let kept = folder.path().join(format!("{NAME}{}-0.yaml", std::process::id()));
        unsaved.write(&kept).unwrap();
        let lock = Lock::of(&kept).unwrap();
        let left = left_behind(folder.path()).unwrap();
        assert_eq!((&left.path, &left.unsaved), (&path, &unsaved));
        assert!(left_behind(folder.path()).is_none(), "one window offers it, and no other");
        left.forget();
        assert!(!path.exists() && has_others(folder.path(), &path));
        drop(lock);
        assert_eq!(left_behind(folder.path()).map(|left| left.path), Some(kept), "its program is gone now");

        let mut other = Session::new(Document::built_in());
        other.set_carried_files(unsaved.muscle_files().unwrap());
        assert!(other.is_unsaved() && other.document().muscle_files().eq(session.document().muscle_files()));
        other.undo();
        assert!(!other.is_unsaved());
    }

    #[test]
    fn only_own_files_are_looked_at() {
        assert!(is_ours("unsaved-42-0.yaml"));
        for name in ["unsaved-x.yaml", "settings.yaml", "unsaved-42-0.txt", "unsaved-42-0.lock", "unsaved-.yaml"] {
            assert!(!is_ours(name), "{name}");
        }
    }
}
