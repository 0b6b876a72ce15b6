//! What the dialogs and the flows of opening and saving need of a window: handles, none of which knows the window or a panel.

use std::rc::Rc;

use gtk4 as gtk;

use super::picture_focus::PictureFocus;
use super::session_handle::SessionHandle;
use super::settings_handle::SettingsHandle;
use crate::app::loading::background_reader::BackgroundReader;
use crate::app::loading::file_watcher::FileWatcher;
use crate::app::loading::open_files::OpenFiles;
use crate::app::notices::error_bar::ErrorBar;
use crate::app::notices::loading_bar::LoadingBar;
use crate::app::notices::toasts::Toasts;
use crate::app::window::start_page::StartPage;

/// The handles of a window.
pub(crate) struct AppContext {
    /// The parent of dialogs.
    pub widget: gtk::ApplicationWindow,
    /// The session.
    pub session: SessionHandle,
    /// What is remembered.
    pub settings: SettingsHandle,
    /// Errors, until they are closed.
    pub error_bar: Rc<ErrorBar>,
    /// What is said in passing.
    pub toasts: Toasts,
    /// Gives the keyboard to the picture.
    pub focus: PictureFocus,
    /// The files that no result replaces.
    pub open_files: Rc<OpenFiles>,
    /// Hears when they are written by others.
    pub watcher: Rc<FileWatcher>,
    /// Reads files.
    pub reader: Rc<BackgroundReader>,
    /// What stands over the picture while nothing is open.
    pub start_page: Rc<StartPage>,
}

impl AppContext {
    /// The context of a window; `picture` is the builder of the viewport.
    pub(crate) fn new(widget: gtk::ApplicationWindow, session: SessionHandle, settings: SettingsHandle, picture: &gtk::Builder) -> Self {
        let (error_bar, focus, open_files) = (ErrorBar::new(), PictureFocus::default(), Rc::<OpenFiles>::default());
        Self {
            reader: BackgroundReader::new(&session, LoadingBar::new(picture), &error_bar),
            watcher: Rc::new(FileWatcher::new(&session, &open_files)),
            start_page: StartPage::new(&session, &focus),
            toasts: Toasts::new(picture),
            widget,
            session,
            settings,
            error_bar,
            focus,
            open_files,
        }
    }
}
