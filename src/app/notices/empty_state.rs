//! Message in the middle of the viewport where a file has nothing to draw.

use gtk::prelude::*;
use gtk4 as gtk;

use crate::session::Session;
use crate::tr;

/// A few words over an empty picture.
pub(crate) struct EmptyState {
    /// The words.
    pub root: gtk::Label,
}

impl EmptyState {
    /// Hidden until they are true.
    pub(crate) fn new() -> Self {
        let root = gtk::Label::builder()
            .label(tr!("app-nothing-drawn"))
            .halign(gtk::Align::Center)
            .valign(gtk::Align::Center)
            .margin_start(60)
            .margin_end(60)
            .wrap(true)
            .justify(gtk::Justification::Center)
            .can_target(false)
            .visible(false)
            .css_classes(["floating"])
            .build();
        Self { root }
    }

    /// Shows them where they are true of what is open.
    pub(crate) fn refresh(&self, session: &mut Session) {
        self.root.set_visible(session.has_nothing_to_draw());
    }
}
