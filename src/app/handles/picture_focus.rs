//! The keyboard focus of the picture, for widgets that give the keyboard back to it.

use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::widgets::drawing_area::PaintWidget;

/// Marks the picture that the keyboard has come to by itself.
const REACHED: &str = "reached";

/// Gives the keyboard to the picture.
#[derive(Clone, Default)]
pub(crate) struct PictureFocus(Rc<glib::WeakRef<PaintWidget>>);

impl PictureFocus {
    /// Makes `canvas` the picture. It is framed while the keyboard is there, once it has come by Tab; a key such as Space alone is no reason to.
    pub(crate) fn set_picture(&self, canvas: &PaintWidget) {
        self.0.set(Some(canvas));
        let focus = gtk::EventControllerFocus::new();
        let weak = canvas.downgrade();
        focus.connect_enter(move |_| {
            if let Some(canvas) = weak.upgrade() {
                canvas.add_css_class(REACHED);
            }
        });
        canvas.add_controller(focus);
    }

    /// Gives the keyboard to the picture. Who did so by a click knows where it is: nothing frames the picture then.
    pub(crate) fn take(&self) {
        if let Some(canvas) = self.0.upgrade() {
            canvas.grab_focus();
            canvas.remove_css_class(REACHED);
        }
    }
}
