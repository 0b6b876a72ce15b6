//! The time axis that the track and what lies below it share: its visible range, and how the wheel and drags change it.

use std::cell::RefCell;
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gdk, glib};
use gtk4 as gtk;

use super::timeline_ruler::Track;
use crate::app::handles::session_handle::SessionHandle;

/// Zoom factor of one wheel notch.
const ZOOM_STEP: f64 = 1.25;

/// Draws something anew.
type Redraw = Box<dyn Fn()>;

/// The axis.
#[derive(Clone)]
pub(crate) struct TimeAxis {
    /// What shows it.
    pub track: Rc<RefCell<Track>>,
    redraw: Rc<RefCell<Vec<Redraw>>>,
}

impl TimeAxis {
    /// The axis of a track.
    pub(crate) fn new(track: Track) -> Self {
        Self { track: Rc::new(RefCell::new(track)), redraw: Rc::default() }
    }

    /// Calls `redraw` when the visible range changes.
    pub(crate) fn connect_changed(&self, redraw: impl Fn() + 'static) {
        self.redraw.borrow_mut().push(Box::new(redraw));
    }

    /// Shows another part of the clip.
    pub(crate) fn change(&self, change: impl FnOnce(&mut Track)) {
        change(&mut self.track.borrow_mut());
        self.redraw.borrow().iter().for_each(|redraw| redraw());
    }

    /// The wheel over the axis: with Ctrl it zooms around the pointer, with Shift it scrolls.
    pub(crate) fn wheel(&self, held: gdk::ModifierType, notches: f64, about: Option<f64>) -> glib::Propagation {
        if held.contains(gdk::ModifierType::CONTROL_MASK) {
            self.change(|track| track.zoom(ZOOM_STEP.powf(-notches), about.unwrap_or(track.time)));
        } else if held.contains(gdk::ModifierType::SHIFT_MASK) {
            self.change(|track| track.slide(0.1 * notches));
        } else {
            return glib::Propagation::Proceed;
        }
        glib::Propagation::Stop
    }
}

/// While the user drags the cursor, playback does not move it; after the release playback continues from there.
pub(crate) fn hold_while(drag: &gtk::GestureDrag, session: &SessionHandle) {
    let hold = |held: bool| {
        glib::clone!(
            #[weak]
            session,
            move || {
                // A widget that is destroyed with its document releases too; the session has already ended the drag then.
                session.try_read(|session| session.hold_time(held));
            }
        )
    };
    let (taken, left, lost) = (hold(true), hold(false), hold(false));
    drag.connect_drag_begin(move |_, _, _| taken());
    drag.connect_drag_end(move |_, _, _| left());
    drag.connect_cancel(move |_, _| lost());
}
