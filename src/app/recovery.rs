//! Muscles that are not saved, kept where a crash cannot take them: in a file of the user's state folder, which the next start offers to bring back.

use std::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::session::Session;
use super::window::{Window, part};
use super::{files, ui};
use crate::muscle::MuscleFile;
use crate::stage::Unsaved;
use crate::tr;

/// How long changes are gathered before they are written.
const GATHER: Duration = Duration::from_millis(1500);
/// What the names of these files begin with; the number of the process follows.
const NAME: &str = "unsaved-";

impl Unsaved {
    /// What of a session is not saved; `None` where all is.
    pub fn of(session: &Session) -> Option<Self> {
        session.is_unsaved().then(|| Self {
            files: session.files().into_iter().map(|path| std::path::absolute(&path).unwrap_or(path)).collect(),
            muscles: session.document().muscle_files().map(MuscleFile::to_yaml).collect(),
        })
    }
}

/// The recovery file of a window, and the bar that offers those of others.
pub struct Recovery {
    /// The bar.
    pub root: gtk::InfoBar,
    message: gtk::Label,
    path: PathBuf,
    gathering: Cell<bool>,
    written: Cell<bool>,
    told: Cell<bool>,
    offered: RefCell<Option<(PathBuf, Unsaved)>>,
}

impl Recovery {
    /// Nothing written, nothing offered.
    pub fn new() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let builder = ui::builder(ui::RECOVERY_BAR);
        let name = format!("{NAME}{}-{}.yaml", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        Self {
            root: part(&builder, "root"),
            message: part(&builder, "message"),
            path: folder().join(name),
            gathering: Cell::default(),
            written: Cell::default(),
            told: Cell::default(),
            offered: RefCell::default(),
        }
    }

    /// Lets the bar's buttons work.
    pub fn connect(&self, window: &Rc<Window>) {
        self.root.set_visible(false);
        self.root.connect_response(glib::clone!(
            #[weak]
            window,
            move |_, response| {
                // Else the keyboard goes from the button that is hidden to the next widget, the search, and Ctrl+Z with it.
                window.viewport.take_focus();
                window.recovery.fold();
                let Some((path, unsaved)) = window.recovery.offered.take() else { return };
                match response {
                    gtk::ResponseType::Accept => restore(&window, unsaved, path),
                    gtk::ResponseType::Reject => forget_file(&path),
                    _ => {}
                }
            }
        ));
    }

    /// Offers what a program that ended without saving has left.
    pub fn offer(&self) {
        let Some((path, unsaved)) = left_behind(&folder()) else { return };
        let names = unsaved.files.iter().filter_map(|path| path.file_name()).map(|name| name.to_string_lossy()).collect::<Vec<_>>();
        let what = if names.is_empty() { tr!("document-built-in") } else { names.join(" + ") };
        self.message.set_text(&tr!("app-recovery", what = what));
        self.offered.replace(Some((path, unsaved)));
        self.root.set_visible(true);
        self.root.set_revealed(true);
    }

    fn fold(&self) {
        self.root.set_revealed(false);
        self.root.set_visible(false);
    }

    /// The muscles, or whether they are saved, changed: soon they are written down, or the file goes.
    pub fn note(&self, window: &Rc<Window>, session: &Session) {
        if !session.is_unsaved() {
            return self.clear();
        }
        if self.gathering.replace(true) {
            return;
        }
        let weak = Rc::downgrade(window);
        glib::timeout_add_local_once(GATHER, move || {
            let Some(window) = weak.upgrade() else { return };
            window.recovery.gathering.set(false);
            match window.look(|session| Unsaved::of(session)) {
                Some(unsaved) => window.recovery.write(&unsaved),
                None => window.recovery.clear(),
            }
        });
    }

    fn write(&self, unsaved: &Unsaved) {
        match unsaved.write(&self.path) {
            Ok(()) => self.written.set(true),
            // Once is enough: the folder will not get writable by being complained about.
            Err(reason) if !self.told.replace(true) => eprintln!("{}", tr!("app-recovery-unwritten", reason = reason)),
            Err(_) => {}
        }
    }

    /// All is saved, or was let go by a hand.
    pub fn clear(&self) {
        if self.written.replace(false) {
            forget_file(&self.path);
        }
    }
}

/// Opens the files that were open, and puts the muscles that were not saved into them. The file is kept until they are there.
fn restore(window: &Rc<Window>, unsaved: Unsaved, path: PathBuf) {
    let Some(muscles) = unsaved.muscle_files() else { return };
    files::open_carrying(window, unsaved.files, muscles, move || forget_file(&path));
}

/// A file that cannot be removed is offered again; nothing is lost by that.
fn forget_file(path: &Path) {
    let _ = std::fs::remove_file(path);
}

/// Where these files are.
fn folder() -> PathBuf {
    let state = std::env::var_os("XDG_STATE_HOME").map(PathBuf::from).filter(|path| path.is_absolute());
    state.unwrap_or_else(|| glib::home_dir().join(".local").join("state")).join("sinew")
}

/// The newest file of a program that no longer runs.
fn left_behind(folder: &Path) -> Option<(PathBuf, Unsaved)> {
    let entries = std::fs::read_dir(folder).ok()?.flatten();
    let mut left: Vec<(std::time::SystemTime, PathBuf)> = entries
        .filter(|entry| entry.file_name().to_str().and_then(process_of).is_some_and(|process| !is_running(process)))
        .filter_map(|entry| Some((entry.metadata().ok()?.modified().ok()?, entry.path())))
        .collect();
    left.sort();
    left.into_iter().rev().find_map(|(_, path)| Some((path.clone(), Unsaved::read(&path)?)))
}

/// The process whose file this is, by its name.
fn process_of(name: &str) -> Option<u32> {
    name.strip_prefix(NAME)?.strip_suffix(".yaml")?.split('-').next()?.parse().ok()
}

/// Whether a process of this program has this number. Where the system does not tell, none has.
fn is_running(process: u32) -> bool {
    let named = std::fs::read_to_string(format!("/proc/{process}/comm"));
    process == std::process::id() || named.is_ok_and(|name| name.starts_with("sinew"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::session::Step;
    use crate::document::Document;
    use crate::muscle::Edit;
    use crate::scene::MuscleId;

    #[test]
    fn what_is_not_saved_is_found_again() {
        let folder = tempfile::tempdir().unwrap();
        let mut session = Session::new(Document::built_in());
        assert_eq!(Unsaved::of(&session), None);
        session.edit_muscle(MuscleId(0), &Edit::Radius(2, 33.25), Step::New).unwrap();
        let unsaved = Unsaved::of(&session).unwrap();
        // No process has the greatest number there is.
        let path = folder.path().join(format!("{NAME}{}-0.yaml", u32::MAX));
        unsaved.write(&path).unwrap();
        std::fs::write(folder.path().join(format!("{NAME}{}-1.yaml", u32::MAX)), "files: [").unwrap();
        std::fs::write(folder.path().join(format!("{NAME}{}-0.yaml", std::process::id())), "").unwrap();
        assert_eq!(left_behind(folder.path()), Some((path, unsaved.clone())));

        let mut other = Session::new(Document::built_in());
        other.carry(unsaved.muscle_files().unwrap());
        assert!(other.is_unsaved() && other.document().muscle_files().eq(session.document().muscle_files()));
        other.undo();
        assert!(!other.is_unsaved());
    }

    #[test]
    fn only_own_files_are_looked_at() {
        assert_eq!(process_of("unsaved-42-0.yaml"), Some(42));
        assert_eq!((process_of("unsaved-x.yaml"), process_of("settings.yaml"), process_of("unsaved-42-0.txt")), (None, None, None));
        assert!(is_running(std::process::id()));
    }
}
