//! The settings as the widgets know them, and the user's own view settings while those of a session file are shown.

use std::cell::{Ref, RefCell, RefMut};
use std::rc::Rc;

use super::session_handle::SessionHandle;
use crate::app::settings::{SavedViewSettings, Settings};
use crate::session::Session;

/// What is remembered from one start to the next, shared by all parts of a window.
#[derive(Clone)]
pub(crate) struct SettingsHandle(Rc<SharedSettings>);

/// What all handles of the settings share.
struct SharedSettings {
    settings: RefCell<Settings>,
    /// The user's view settings while those of a session file are shown.
    own_view: RefCell<Option<SavedViewSettings>>,
}

impl SettingsHandle {
    /// A handle of settings that were loaded.
    pub(crate) fn new(settings: Settings) -> Self {
        Self(Rc::new(SharedSettings { settings: RefCell::new(settings), own_view: RefCell::default() }))
    }

    /// The settings, to read.
    pub(crate) fn borrow(&self) -> Ref<'_, Settings> {
        self.0.settings.borrow()
    }

    /// The settings, to change.
    pub(crate) fn borrow_mut(&self) -> RefMut<'_, Settings> {
        self.0.settings.borrow_mut()
    }

    /// `settings` with the user's view settings instead of those of a session file.
    pub(crate) fn with_user_view(&self, settings: &Settings, session: &SessionHandle) -> Settings {
        let mut now = settings.clone();
        session.read(|session| now.capture(session));
        self.0.own_view.borrow().as_ref().map_or(now.clone(), |held| held.merged_into(&now))
    }

    /// Restores the user's view settings before another document is shown.
    pub(crate) fn restore_view(&self, session: &SessionHandle) {
        let own = self.with_user_view(&self.borrow(), session);
        if self.0.own_view.take().is_some() {
            session.update(|session| own.apply(session));
        }
    }

    /// Applies the view settings of a session file, as `show` does it, and keeps the user's for later.
    pub(crate) fn use_view_of_file(&self, session: &SessionHandle, show: impl FnOnce(&mut Session)) {
        let own = self.with_user_view(&self.borrow(), session);
        session.update(show);
        let mut file = own.clone();
        session.read(|session| file.capture(session));
        self.0.own_view.replace(Some(SavedViewSettings::new(own, file)));
    }
}
