//! Opens a second file for comparison with the open one.

use std::path::{Path, PathBuf};
use std::rc::Rc;

use gtk::{gio, glib};
use gtk4 as gtk;

use super::window::Window;
use super::{document_loader, onion_skin_panel, reload_summary};
use crate::document::Document;
use crate::progress::Progress;
use crate::session::CompareTarget;
use crate::tr;

/// Asks for a file and compares what is open with it.
pub(super) fn choose(window: &Rc<Window>) {
    document_loader::ask_for_files(window, &tr!("app-choose-compared"), false, |window, mut paths| {
        if let Some(path) = paths.pop() {
            open(window, path);
        }
    });
}

/// Compares what is open with a file.
pub(super) fn open(window: &Rc<Window>, path: PathBuf) {
    let name = path.display().to_string();
    document_loader::read_in_background(window, path, move |window, document| {
        window.update(|session| session.compare(Some(CompareTarget::File(Box::new(document), name))));
        document_loader::watch(window);
    });
}

/// Reads the file that is compared with again, where it is that one still. One that cannot be read now, as while it is being written, leaves what is shown.
pub(super) fn read_again(window: &Rc<Window>, path: &Path) {
    let (window, path) = (window.clone(), path.to_path_buf());
    glib::spawn_future_local(async move {
        let wanted = path.clone();
        let read = gio::spawn_blocking(move || Document::open(&[wanted], &Progress::default())).await;
        if let Ok(Ok(document)) = read
            && window.read(|session| session.compared_file()).as_ref() == Some(&path)
        {
            let summary = window.read(|session| match session.compare_target() {
                Some(CompareTarget::File(old, _)) => reload_summary::what_changed(old, &document),
                _ => String::new(),
            });
            window.update(|session| session.replace_compared_file(document));
            let file = onion_skin_panel::file_name(&path.display().to_string());
            window.viewport.toast(&tr!("app-compared-again", file = file, news = summary), None);
        }
    });
}
