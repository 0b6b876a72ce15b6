//! Opens a second file for comparison with the open one.

use std::path::{Path, PathBuf};
use std::rc::Rc;

use gtk::{gio, glib};
use gtk4 as gtk;

use super::file_chooser;
use crate::app::handles::app_context::AppContext;
use crate::app::loading::reload_summary;
use crate::app::panels::onion_skin_panel;
use crate::document::Document;
use crate::formats::SCENE_READERS;
use crate::progress::Progress;
use crate::session::CompareTarget;
use crate::tr;

/// Asks for a file and compares what is open with it.
pub(crate) fn choose(app: &Rc<AppContext>) {
    let compare = glib::clone!(
        #[weak]
        app,
        move |mut paths: Vec<PathBuf>| {
            if let Some(path) = paths.pop() {
                open(&app, path);
            }
        }
    );
    file_chooser::ask_for_files(app, &tr!("app-choose-compared"), false, compare);
}

/// Compares what is open with a file.
fn open(app: &Rc<AppContext>, path: PathBuf) {
    let name = path.display().to_string();
    let (reader, app) = (app.reader.clone(), app.clone());
    reader.read_beside(path, move |document| {
        app.session.update(|session| session.compare(Some(CompareTarget::File(Box::new(document), name))));
        app.watcher.watch();
    });
}

/// Reads the file that is compared with again, where it is that one still. One that cannot be read now, as while it is being written, leaves what is shown.
pub(crate) fn read_again(app: &Rc<AppContext>, path: &Path) {
    let (app, path) = (app.clone(), path.to_path_buf());
    glib::spawn_future_local(async move {
        let wanted = path.clone();
        let read = gio::spawn_blocking(move || Document::open(&[wanted], SCENE_READERS, &Progress::default())).await;
        if let Ok(Ok(document)) = read
            && app.session.read(|session| session.compared_file()).as_ref() == Some(&path)
        {
            let summary = app.session.read(|session| match session.compare_target() {
                Some(CompareTarget::File(old, _)) => reload_summary::what_changed(old, &document),
                _ => String::new(),
            });
            app.session.update(|session| session.replace_compared_file(document));
            let file = onion_skin_panel::file_name(&path.display().to_string());
            app.toasts.toast(&tr!("app-compared-again", file = file, news = summary), None);
        }
    });
}
