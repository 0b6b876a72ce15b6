//! Asking where to save, and saying what came of it: pictures, sessions and muscles are saved through here.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::error_bar::Trouble;
use super::window::Window;
use crate::tr;

/// Asks for a place, with a name to start from, in `folder` or the one that was opened from last; `then` gets it unless the person thinks better of it.
pub fn ask(window: &Rc<Window>, title: &str, name: &str, folder: Option<&Path>, then: impl FnOnce(&Rc<Window>, PathBuf) + 'static) {
    let dialog = gtk::FileChooserNative::new(
        Some(title),
        Some(&window.widget),
        gtk::FileChooserAction::Save,
        Some(&tr!("app-save")),
        Some(&tr!("app-cancel")),
    );
    dialog.set_current_name(name);
    let folder = folder.map(Path::to_path_buf).or_else(|| window.settings.borrow().folder.clone());
    if let Some(folder) = folder.filter(|folder| folder.is_dir()) {
        // Where the folder cannot be shown, the dialog starts where it likes.
        let _ = dialog.set_current_folder(Some(&gio::File::for_path(folder)));
    }
    let (keep, then) = (RefCell::new(Some(dialog.clone())), RefCell::new(Some(then)));
    dialog.connect_response(glib::clone!(
        #[weak]
        window,
        move |dialog, response| {
            keep.take();
            let path = dialog.file().and_then(|file| file.path()).filter(|_| response == gtk::ResponseType::Accept);
            if let (Some(path), Some(then)) = (path, then.take()) {
                then(&window, path);
            }
        }
    ));
    dialog.show();
}

/// The name of the first open file with another ending, else the program's.
pub fn name_like_open(window: &Rc<Window>, ending: &str) -> String {
    let stem = window.look(|session| session.files().first().and_then(|path| Some(path.file_stem()?.to_string_lossy().into_owned())));
    format!("{}.{ending}", stem.unwrap_or_else(|| "sinew".into()))
}

/// A file's name as messages give it.
pub fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Says that something could not be saved, and why.
pub fn failed(window: &Rc<Window>, path: &Path, reason: String) {
    window.error_bar.show(Trouble {
        headline: tr!("app-unsaved", file = name_of(path)),
        message: reason,
        details: path.display().to_string(),
        again: None,
    });
}
