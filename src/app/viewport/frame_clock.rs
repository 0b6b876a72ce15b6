//! The clock of what moves by itself: playback, flight, eased cameras. The display's frame clock drives it while anything does.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::handles::session_handle::{SessionHandle, WeakSession};

/// Moves something on by so many seconds; whether it goes on moving.
type TickHandler = Box<dyn Fn(f64) -> bool>;

/// The clock of a window.
#[derive(Clone)]
pub(crate) struct FrameClock(Rc<Clock>);

/// What it drives, and whether it runs.
struct Clock {
    widget: glib::WeakRef<gtk::ApplicationWindow>,
    session: WeakSession,
    motion: RefCell<Option<TickHandler>>,
    ticking: Cell<bool>,
}

impl FrameClock {
    /// A clock that runs while the session moves.
    pub(crate) fn new(widget: &gtk::ApplicationWindow, session: &SessionHandle) -> Self {
        let clock = Rc::new(Clock {
            widget: widget.downgrade(),
            session: session.downgrade(),
            motion: RefCell::default(),
            ticking: Cell::default(),
        });
        let weak = Rc::downgrade(&clock);
        session.observe(move |_| {
            if let Some(clock) = weak.upgrade().filter(|clock| clock.is_session_moving()) {
                Self(clock).request();
            }
        });
        Self(clock)
    }

    /// Drives something that the session does not know of, before the session at each tick.
    pub(crate) fn drive(&self, motion: impl Fn(f64) -> bool + 'static) {
        self.0.motion.replace(Some(Box::new(motion)));
    }

    /// Starts the clock, where it does not run.
    pub(crate) fn request(&self) {
        let Some(widget) = self.0.widget.upgrade().filter(|_| !self.0.ticking.replace(true)) else { return };
        let last = Cell::new(None::<i64>);
        let weak = Rc::downgrade(&self.0);
        widget.add_tick_callback(move |_, frames| {
            let Some(clock) = weak.upgrade() else { return glib::ControlFlow::Break };
            let now = frames.frame_time();
            let seconds = last.replace(Some(now)).map_or(0.0, |before| (now - before) as f64 * 1e-6);
            if clock.tick(seconds) {
                glib::ControlFlow::Continue
            } else {
                clock.ticking.set(false);
                glib::ControlFlow::Break
            }
        });
    }
}

impl Clock {
    fn is_session_moving(&self) -> bool {
        self.session.upgrade().is_some_and(|session| session.read(|session| session.is_moving()))
    }

    /// Moves everything on; whether anything goes on moving.
    fn tick(&self, seconds: f64) -> bool {
        let moving = self.motion.borrow().as_ref().is_some_and(|motion| motion(seconds));
        if let Some(session) = self.session.upgrade() {
            session.update(|session| session.advance(seconds));
        }
        moving || self.is_session_moving()
    }
}
