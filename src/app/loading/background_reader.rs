//! Reads files off the interface thread, with progress and a button that stops it.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::open_error;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::notices::error_bar::ErrorBar;
use crate::app::notices::loading_bar::LoadingBar;
use crate::document::{Document, OpenError, OpenErrorKind, OpenOptions};
use crate::formats::SCENE_READERS;
use crate::message::SourceName;
use crate::progress::Progress;
use crate::tr;
use crate::view::{self, Opened};

/// Reading that is done within this time shows no progress.
const PROGRESS_DELAY: Duration = Duration::from_millis(150);
/// How often the progress is shown anew.
const PULSE: Duration = Duration::from_millis(60);

/// A reading that is under way; a newer one takes its place.
type Reading = RefCell<Option<Arc<Progress>>>;

/// The readings of a window.
pub(crate) struct BackgroundReader {
    session: SessionHandle,
    loading: LoadingBar,
    error_bar: Rc<ErrorBar>,
    /// What is to be shown.
    scene: Reading,
    /// What is read beside it, to be compared with what is open.
    beside: Reading,
}

impl BackgroundReader {
    /// A reader that reads nothing yet.
    pub(crate) fn new(session: &SessionHandle, loading: LoadingBar, error_bar: &Rc<ErrorBar>) -> Rc<Self> {
        let reader = Rc::new(Self {
            session: session.clone(),
            loading,
            error_bar: error_bar.clone(),
            scene: RefCell::default(),
            beside: RefCell::default(),
        });
        reader.loading.cancel_button().connect_clicked(glib::clone!(
            #[weak]
            reader,
            move |_| {
                reader.stop();
                reader.scene.replace(None);
                reader.loading.hide();
                reader.session.update(|session| session.touch());
            }
        ));
        reader
    }

    /// Whether something is being read.
    pub(crate) fn is_loading(&self) -> bool {
        self.is_reading_scene() || self.beside.borrow().is_some()
    }

    /// Whether files are being read that are to be shown.
    pub(crate) fn is_reading_scene(&self) -> bool {
        self.scene.borrow().is_some()
    }

    /// Stops reading, whatever it is.
    pub(crate) fn stop(&self) {
        [&self.scene, &self.beside].into_iter().for_each(cancel);
    }

    /// Stops reading and forgets that anything was being read.
    pub(crate) fn forget(&self) {
        self.stop();
        self.scene.replace(None);
        self.beside.replace(None);
        self.loading.hide();
    }

    /// Reads files side by side into one scene and passes on what came of it; an earlier reading is given up. One that is cancelled passes on nothing.
    pub(crate) fn read_scene(self: &Rc<Self>, paths: Vec<PathBuf>, then: impl FnOnce(Result<Opened, OpenError>, Vec<PathBuf>) + 'static) {
        let progress = self.begin(&self.scene, &paths);
        let reader = self.clone();
        glib::spawn_future_local(async move {
            let (wanted, hand) = (paths.clone(), progress.clone());
            let read = gio::spawn_blocking(move || view::open(&wanted, OpenOptions::new(SCENE_READERS), &hand)).await;
            if !reader.end(&reader.scene, &progress) {
                return;
            }
            match read {
                _ if progress.is_cancelled() => reader.session.update(|session| session.touch()),
                Ok(read) => then(read, paths),
                // The reader is made not to panic; should it, what is open is still worth more than the program's life.
                Err(_) => then(Err(unexpected(&paths)), paths),
            }
        });
    }

    /// Reads a file and passes the document on; what is open stays as it is, and what is being opened goes on.
    pub(crate) fn read_beside(self: &Rc<Self>, path: PathBuf, then: impl FnOnce(Document) + 'static) {
        cancel(&self.beside);
        let paths = vec![path];
        let progress = self.begin(&self.beside, &paths);
        let reader = self.clone();
        glib::spawn_future_local(async move {
            let (wanted, hand) = (paths.clone(), progress.clone());
            let read = gio::spawn_blocking(move || Document::open(&wanted, SCENE_READERS, &hand)).await;
            if !reader.end(&reader.beside, &progress) {
                return;
            }
            match read {
                _ if progress.is_cancelled() => reader.session.update(|session| session.touch()),
                Ok(Ok(document)) => {
                    reader.error_bar.hide();
                    then(document);
                }
                Ok(Err(error)) => open_error::show(&reader.error_bar, &reader.session, &error, None),
                Err(_) => open_error::show(&reader.error_bar, &reader.session, &unexpected(&paths), None),
            }
        });
    }

    fn begin(self: &Rc<Self>, reading: &Reading, paths: &[PathBuf]) -> Arc<Progress> {
        let progress = Arc::new(Progress::default());
        reading.replace(Some(progress.clone()));
        self.show_progress(paths, &progress);
        progress
    }

    /// A reading is over; whether it was the newest of its kind.
    fn end(&self, reading: &Reading, progress: &Arc<Progress>) -> bool {
        let is_newest = is_newest(reading, progress);
        if is_newest {
            reading.replace(None);
            self.loading.hide();
        }
        is_newest
    }

    fn show_progress(self: &Rc<Self>, paths: &[PathBuf], progress: &Arc<Progress>) {
        let names = paths.iter().filter_map(|path| path.file_name()).map(|name| name.to_string_lossy()).collect::<Vec<_>>().join(", ");
        let text = tr!("app-loading", file = names);
        let (weak, mine) = (Rc::downgrade(self), progress.clone());
        glib::timeout_add_local_once(PROGRESS_DELAY, move || {
            glib::timeout_add_local(PULSE, move || {
                let Some(reader) = weak.upgrade() else { return glib::ControlFlow::Break };
                if is_newest(&reader.scene, &mine) || is_newest(&reader.beside, &mine) {
                    reader.loading.show(&text, f64::from(mine.share()));
                    glib::ControlFlow::Continue
                } else {
                    glib::ControlFlow::Break
                }
            });
        });
    }
}

fn cancel(reading: &Reading) {
    if let Some(progress) = &*reading.borrow() {
        progress.cancel();
    }
}

fn is_newest(reading: &Reading, progress: &Arc<Progress>) -> bool {
    reading.borrow().as_ref().is_some_and(|reading| Arc::ptr_eq(reading, progress))
}

fn unexpected(paths: &[PathBuf]) -> OpenError {
    let file = paths.first().map_or(SourceName::Unknown, |path| SourceName::of_argument(path));
    OpenError::whole(&file, OpenErrorKind::ReaderFailed)
}
