//! Recently opened files, from the list that the desktop keeps.

use std::path::{Path, PathBuf};
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::samples::DEMOS;
use super::window::Window;
use super::{document_loader, start_page, ui};
use crate::i18n::shown;
use crate::session::LoadMode;
use crate::tr;

/// Most files that are listed.
const MOST: usize = 8;

/// Remembers a file that was opened.
pub(super) fn remember(path: &Path) {
    gtk::RecentManager::default().add_item(&gio::File::for_path(path).uri());
}

/// The files that this program opened and that are still there, the last one first.
pub(super) fn list() -> Vec<PathBuf> {
    let ours = |path: &Path| {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        matches!(ending.as_deref(), Some("dae" | "zae" | "yaml" | "yml"))
    };
    let name = glib::application_name();
    let mut found: Vec<(i64, PathBuf)> = gtk::RecentManager::default()
        .items()
        .iter()
        .filter(|info| name.as_deref().is_some_and(|name| info.has_application(name)))
        .filter_map(|info| Some((info.visited().to_unix(), gio::File::for_uri(&info.uri()).path()?)))
        .filter(|(_, path)| ours(path) && path.is_file())
        .collect();
    found.sort_by_key(|(visited, _)| std::cmp::Reverse(*visited));
    found.into_iter().map(|(_, path)| path).take(MOST).collect()
}

/// Fills a box with a button a file; `done` runs before one opens.
pub(super) fn fill(window: &Rc<Window>, slot: &gtk::Box, done: impl Fn() + Clone + 'static) {
    while let Some(child) = slot.first_child() {
        slot.remove(&child);
    }
    let files = list();
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
            window,
            move |_| {
                done();
                document_loader::open(&window, vec![path.clone()], LoadMode::New);
            }
        ));
        slot.append(&button);
    }
}

/// Adds a button a demo below; `done` runs before one opens.
pub(super) fn add_demos(window: &Rc<Window>, slot: &gtk::Box, done: impl Fn() + Clone + 'static) {
    slot.append(&gtk::Label::builder().label(tr!("app-start-demos")).xalign(0.0).css_classes(["heading"]).build());
    for demo in DEMOS {
        let label = gtk::Label::builder().label(tr!(demo.name)).xalign(0.0).build();
        let button: gtk::Button = ui::named("GtkButton", &label.text());
        button.set_child(Some(&label));
        button.set_has_frame(false);
        let done = done.clone();
        button.connect_clicked(glib::clone!(
            #[weak]
            window,
            move |_| {
                done();
                start_page::open_demo(&window, demo);
            }
        ));
        slot.append(&button);
    }
}
