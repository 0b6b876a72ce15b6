//! Watches the open files: when one is written again by another program, it is to be read again.

use std::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::Duration;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::open_files::OpenFiles;
use crate::app::handles::session_handle::SessionHandle;

/// How long a file must rest after a change before it is read again.
const SETTLED: Duration = Duration::from_millis(300);

/// Hears of a file that another program wrote.
type Changed = Rc<dyn Fn(&Path)>;

/// The watcher of a window.
pub(crate) struct FileWatcher {
    session: SessionHandle,
    files: Rc<OpenFiles>,
    monitors: RefCell<Vec<gio::FileMonitor>>,
    /// For the open files, and for the one that is compared with.
    changed: RefCell<Option<[Changed; 2]>>,
}

impl FileWatcher {
    /// A watcher of nothing yet.
    pub(crate) fn new(session: &SessionHandle, files: &Rc<OpenFiles>) -> Self {
        Self { session: session.clone(), files: files.clone(), monitors: RefCell::default(), changed: RefCell::default() }
    }

    /// Calls `open` when an open file was written, `compared` when the one that is compared with was.
    pub(crate) fn connect_changed(&self, open: impl Fn(&Path) + 'static, compared: impl Fn(&Path) + 'static) {
        self.changed.replace(Some([Rc::new(open), Rc::new(compared)]));
    }

    /// Watches what is open now.
    pub(crate) fn watch(self: &Rc<Self>) {
        let (paths, compared) = self.session.read(|session| (session.files(), session.compared_file()));
        let Some([open, other]) = self.changed.borrow().clone() else { return };
        let own = paths.into_iter().filter_map(|path| self.monitor(path, &open));
        let other = compared.and_then(|path| self.monitor(path, &other));
        self.monitors.replace(own.chain(other).collect());
    }

    /// Watches nothing any more.
    pub(crate) fn stop(&self) {
        self.monitors.replace(Vec::new());
    }

    fn monitor(self: &Rc<Self>, path: PathBuf, changed: &Changed) -> Option<gio::FileMonitor> {
        let monitor = gio::File::for_path(&path).monitor_file(gio::FileMonitorFlags::WATCH_MOVES, gio::Cancellable::NONE).ok()?;
        let (weak, changes, changed) = (Rc::downgrade(self), Rc::new(Cell::new(0_u32)), changed.clone());
        monitor.connect_changed(move |_, _, _, event| {
            use gio::FileMonitorEvent as E;
            if !matches!(event, E::Changed | E::ChangesDoneHint | E::Created | E::Renamed | E::MovedIn) {
                return;
            }
            let number = changes.get().wrapping_add(1);
            changes.set(number);
            let (weak, path, changes, changed) = (weak.clone(), path.clone(), changes.clone(), changed.clone());
            glib::timeout_add_local_once(SETTLED, move || {
                if let Some(watcher) = weak.upgrade()
                    && changes.get() == number
                    && !watcher.files.is_ours_still(&path)
                {
                    changed(&path);
                }
            });
        });
        Some(monitor)
    }
}
