//! Buttons that open recent files and demos, for the start page and the menu of recent files.

use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::document_loader::DocumentLoader;
use super::recent;
use super::samples::{self, DEMOS, Demo};
use crate::app::notices::error_bar::ErrorMessage;
use crate::app::widgets::ui;
use crate::i18n::{Sentence, shown};
use crate::session::LoadMode;
use crate::tr;

/// Lets the start page open demos and list recent files.
pub(crate) fn connect(loader: &Rc<DocumentLoader>) {
    let open = glib::clone!(
        #[weak]
        loader,
        move |demo| open_demo(&loader, demo)
    );
    let list = glib::clone!(
        #[weak]
        loader,
        move |slot: &gtk::Box| list_recent(&loader, slot, || ())
    );
    loader.app.start_page.connect(open, list);
}

/// Fills a box with a button a file; `done` runs before one opens.
pub(crate) fn list_recent(loader: &Rc<DocumentLoader>, slot: &gtk::Box, done: impl Fn() + Clone + 'static) {
    while let Some(child) = slot.first_child() {
        slot.remove(&child);
    }
    let files = recent::list();
    let heading = gtk::Label::builder().label(tr!("app-recent")).xalign(0.0).css_classes(["heading"]).build();
    slot.append(&heading);
    if files.is_empty() {
        slot.append(&gtk::Label::builder().label(tr!("app-recent-none")).xalign(0.0).css_classes(["dim-label"]).build());
    }
    for path in files {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let folder = path.parent().map(|folder| folder.display().to_string()).unwrap_or_default();
        let words = gtk::Box::new(gtk::Orientation::Vertical, 0);
        let line = |text: &str| {
            gtk::Label::builder().label(&*shown(text)).xalign(0.0).ellipsize(gtk::pango::EllipsizeMode::Middle).max_width_chars(36).build()
        };
        words.append(&line(&name));
        let place = line(&folder);
        place.add_css_class("dim-label");
        place.add_css_class("small");
        words.append(&place);
        let button: gtk::Button = ui::named("GtkButton", &name);
        button.set_child(Some(&words));
        button.set_has_frame(false);
        button.set_tooltip_text(Some(&shown(&path.display().to_string())));
        let done = done.clone();
        button.connect_clicked(glib::clone!(
            #[weak]
            loader,
            move |_| {
                done();
                loader.open(vec![path.clone()], LoadMode::New);
            }
        ));
        slot.append(&button);
    }
}

/// Adds a button a demo below; `done` runs before one opens.
pub(crate) fn add_demos(loader: &Rc<DocumentLoader>, slot: &gtk::Box, done: impl Fn() + Clone + 'static) {
    slot.append(&gtk::Label::builder().label(tr!("app-start-demos")).xalign(0.0).css_classes(["heading"]).build());
    for demo in DEMOS {
        let label = gtk::Label::builder().label(tr!(demo.name)).xalign(0.0).build();
        let button: gtk::Button = ui::named("GtkButton", &label.text());
        button.set_child(Some(&label));
        button.set_has_frame(false);
        let done = done.clone();
        button.connect_clicked(glib::clone!(
            #[weak]
            loader,
            move |_| {
                done();
                open_demo(&loader, demo);
            }
        ));
        slot.append(&button);
    }
}

/// Opens a demo.
fn open_demo(loader: &Rc<DocumentLoader>, demo: Demo) {
    match demo.unpack(&samples::folder()) {
        Ok(Some(path)) => loader.open(vec![path], LoadMode::New),
        Ok(None) => loader.open_built_in(),
        Err(error) => loader.app.error_bar.show(ErrorMessage {
            headline: tr!("app-demo-unwritten", folder = samples::folder().display().to_string()),
            message: error.sentence(),
            details: String::new(),
            again: None,
        }),
    }
}
