//! The session as the widgets know it: a handle to read it, to change it, and to hear of changes.
//!
//! Changes flow in one direction: a widget calls [`SessionHandle::update`]; the session records what changed; the subscribers refresh the widgets that show
//! it. While they do, signals of widgets are echoes and change nothing.

use std::cell::{Cell, RefCell};
use std::rc::{Rc, Weak};

use gtk::glib;
use gtk4 as gtk;

use crate::session::{ChangeSet, Session};

/// Refreshes widgets from a session that changed.
type Refresh = Box<dyn Fn(&mut Session, ChangeSet)>;
/// Hears of a change once all widgets show it.
type Observer = Box<dyn Fn(ChangeSet)>;

/// One session, shared by all widgets of a window. Their signal handlers hold it weakly: after the window nothing happens to the session.
#[derive(Clone)]
pub(crate) struct SessionHandle(Rc<SharedSession>);

/// A handle that does not keep its session alive.
#[derive(Clone)]
pub(crate) struct WeakSession(Weak<SharedSession>);

/// What all handles of a session share.
struct SharedSession {
    session: RefCell<Session>,
    refreshing: Cell<bool>,
    subscribers: RefCell<Vec<Refresh>>,
    observers: RefCell<Vec<Observer>>,
}

impl SessionHandle {
    /// A handle of a session that nothing shows yet.
    pub(crate) fn new(session: Session) -> Self {
        Self(Rc::new(SharedSession {
            session: RefCell::new(session),
            refreshing: Cell::default(),
            subscribers: RefCell::default(),
            observers: RefCell::default(),
        }))
    }

    /// A handle that does not keep the session alive.
    pub(crate) fn downgrade(&self) -> WeakSession {
        WeakSession(Rc::downgrade(&self.0))
    }

    /// Lets `refresh` show each change. Subscribers are called in the order in which they came; they hold their widgets weakly, or these would never end.
    pub(crate) fn subscribe(&self, refresh: impl Fn(&mut Session, ChangeSet) + 'static) {
        self.0.subscribers.borrow_mut().push(Box::new(refresh));
    }

    /// Calls `observer` after each change, once all subscribers have shown it and the session may be changed again.
    pub(crate) fn observe(&self, observer: impl Fn(ChangeSet) + 'static) {
        self.0.observers.borrow_mut().push(Box::new(observer));
    }

    /// Changes the session and shows the result. Nothing happens while widgets are being refreshed: their signals are echoes.
    pub(crate) fn update(&self, change: impl FnOnce(&mut Session)) {
        if self.0.refreshing.get() {
            return;
        }
        change(&mut self.0.session.borrow_mut());
        self.refresh();
    }

    /// Shows what changed since the last time.
    pub(crate) fn refresh(&self) {
        let changes = self.0.session.borrow_mut().take_changes();
        if changes == ChangeSet::default() {
            return;
        }
        self.0.refreshing.set(true);
        {
            let session = &mut *self.0.session.borrow_mut();
            self.0.subscribers.borrow().iter().for_each(|refresh| refresh(session, changes));
        }
        self.0.refreshing.set(false);
        self.0.observers.borrow().iter().for_each(|observer| observer(changes));
    }

    /// Reads the session. It is mutable because poses are computed when they are asked for.
    pub(crate) fn read<T>(&self, read: impl FnOnce(&mut Session) -> T) -> T {
        read(&mut self.0.session.borrow_mut())
    }

    /// Reads the session, unless widgets are being refreshed: what a widget that goes away meanwhile still reports is about what is no longer open.
    pub(crate) fn try_read<T>(&self, read: impl FnOnce(&mut Session) -> T) -> Option<T> {
        self.0.session.try_borrow_mut().ok().map(|mut session| read(&mut session))
    }

    /// Asks the session something, unless widgets are being refreshed: then the answer is no.
    pub(crate) fn read_if_free(&self, ask: impl FnOnce(&Session) -> bool) -> bool {
        !self.0.refreshing.get() && ask(&self.0.session.borrow())
    }

    /// Shows something of the session that is not in it, unless it is being changed just now.
    pub(crate) fn show(&self, show: impl FnOnce(&Session)) {
        if let Ok(session) = self.0.session.try_borrow() {
            show(&session);
        }
    }

    /// Sets widgets without a change of the session, so that their signals are taken for echoes; nothing happens while widgets are being refreshed.
    pub(crate) fn set_widgets(&self, work: impl FnOnce(&Session)) {
        if !self.0.refreshing.replace(true) {
            work(&self.0.session.borrow());
            self.0.refreshing.set(false);
        }
    }
}

impl WeakSession {
    /// The handle, while the window is there.
    pub(crate) fn upgrade(&self) -> Option<SessionHandle> {
        self.0.upgrade().map(SessionHandle)
    }
}

// So that `glib::clone!` can hold a session weakly.
impl glib::clone::Downgrade for SessionHandle {
    type Weak = WeakSession;

    fn downgrade(&self) -> WeakSession {
        self.downgrade()
    }
}

impl glib::clone::Upgrade for WeakSession {
    type Strong = SessionHandle;

    fn upgrade(&self) -> Option<SessionHandle> {
        self.upgrade()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;

    #[test]
    fn subscribers_see_a_change_and_their_echoes_change_nothing() {
        let session = SessionHandle::new(Session::new(Document::built_in()));
        session.refresh();
        let seen = Rc::new(RefCell::new(Vec::new()));
        let (own, weak) = (seen.clone(), session.downgrade());
        session.subscribe(move |read, changes| {
            let Some(session) = weak.upgrade() else { return };
            assert!(session.try_read(|_| ()).is_none() && !session.read_if_free(|_| true));
            session.update(|_| panic!("a signal of a widget that is refreshed is an echo"));
            session.set_widgets(|_| panic!("and so is this one"));
            own.borrow_mut().push((read.bone_names(), changes));
        });
        session.update(|session| session.set_bone_names(true));
        session.update(|_| ());
        let seen = seen.borrow();
        assert!(seen.len() == 1 && seen[0].0 && seen[0].1 != ChangeSet::default(), "one change is shown once");
    }

    #[test]
    fn an_observer_may_change_the_session_again() {
        let session = SessionHandle::new(Session::new(Document::built_in()));
        session.refresh();
        let weak = session.downgrade();
        session.observe(move |_| {
            if let Some(session) = weak.upgrade()
                && session.read(|session| session.bone_names())
            {
                session.update(|session| session.set_bone_names(false));
            }
        });
        session.update(|session| session.set_bone_names(true));
        assert!(!session.read(|session| session.bone_names()));
    }
}
