//! What is there when nothing is open: what to do, and the files opened lately.

use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::session::Arrival;
use super::window::{Window, part};
use super::{recent, ui};
use crate::document::Document;

/// The page, over the empty picture.
pub struct StartPage {
    /// The whole.
    pub root: gtk::Box,
    built_in: gtk::Button,
    recent: gtk::Box,
}

impl StartPage {
    /// A page that is not connected yet.
    pub fn new() -> Self {
        let builder = ui::builder(ui::START);
        Self { root: part(&builder, "root"), built_in: part(&builder, "built_in"), recent: part(&builder, "recent_slot") }
    }

    /// Lets the buttons work; the list is made anew whenever the page appears.
    pub fn connect(&self, window: &Rc<Window>) {
        self.root.set_visible(false);
        self.built_in.connect_clicked(glib::clone!(
            #[weak]
            window,
            move |_| window.act(|session| session.show(Document::built_in(), Arrival::New))
        ));
        self.root.connect_map(glib::clone!(
            #[weak]
            window,
            #[weak(rename_to = slot)]
            self.recent,
            move |_| recent::fill(&window, &slot, || ())
        ));
    }
}
