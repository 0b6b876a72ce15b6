//! Asking where to save, and saying what came of it: pictures, sessions and muscles are saved through here.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::error_bar::Trouble;
use super::files;
use super::window::Window;
use crate::export::ending::completed;
use crate::export::guard::{Output, is_same};
use crate::i18n::shown;
use crate::tr;

/// What is to be saved.
pub struct Wanted {
    /// The title of the dialog.
    pub title: String,
    /// The name to start from.
    pub name: String,
    /// Where to start; none = the folder that was opened from last.
    pub folder: Option<PathBuf>,
    /// The endings that such a file may have; a name that has none of them gets the first.
    pub endings: &'static [&'static str],
    /// The open file that it came from and may replace.
    pub own: Option<PathBuf>,
}

/// Asks for a place; `then` gets it unless the person thinks better of it. A file that is open, or belongs to one that is, is refused, whatever the
/// file dialog was answered.
pub fn ask(window: &Rc<Window>, wanted: Wanted, then: impl FnOnce(&Rc<Window>, &Output) + 'static) {
    let Wanted { title, name, folder, endings, own } = wanted;
    let dialog = gtk::FileChooserNative::new(
        Some(&title),
        Some(&window.widget),
        gtk::FileChooserAction::Save,
        Some(&tr!("app-save")),
        Some(&tr!("app-cancel")),
    );
    dialog.set_current_name(&shown(&name));
    let folder = folder.or_else(|| window.settings.borrow().folder.clone());
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
            let (Some(chosen), Some(then)) = (path, then.take()) else { return };
            let is_own = own.as_deref().is_some_and(|own| is_same(own, &chosen));
            let path = if is_own { chosen.clone() } else { completed(&chosen, endings) };
            let output = match files::guard(&window).but(own.as_deref()).output(&path) {
                Ok(output) => output,
                Err(error) => return failed(&window, &path, error.to_string()),
            };
            // The dialog asked about the name that was typed.
            let unasked = if path == chosen { Vec::new() } else { vec![path] };
            let again = window.clone();
            ask_to_replace(window.widget.upcast_ref(), unasked, move || then(&again, &output));
        }
    ));
    dialog.show();
}

/// Does `then`; asks first where one of these files is there, which the file dialog has not asked about.
pub fn ask_to_replace(parent: &gtk::Window, files: Vec<PathBuf>, then: impl FnOnce() + 'static) {
    let there: Vec<PathBuf> = files.into_iter().filter(|file| file.exists()).collect();
    let Some(first) = there.first() else { return then() };
    let dialog = gtk::MessageDialog::builder()
        .transient_for(parent)
        .modal(true)
        .message_type(gtk::MessageType::Question)
        .text(tr!("app-ask-replace", file = name_of(first), more = there.len() - 1))
        .secondary_text(tr!("app-ask-replace-why"))
        .build();
    dialog.add_button(&tr!("app-cancel"), gtk::ResponseType::Cancel);
    dialog.add_button(&tr!("app-replace"), gtk::ResponseType::Accept);
    dialog.set_default_response(gtk::ResponseType::Cancel);
    let then = RefCell::new(Some(then));
    dialog.connect_response(move |dialog, response| {
        dialog.destroy();
        if let (gtk::ResponseType::Accept, Some(then)) = (response, then.take()) {
            then();
        }
    });
    dialog.present();
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

/// Says that a file was saved, by the name that it has now.
pub fn done(window: &Rc<Window>, path: &Path) {
    window.error_bar.hide();
    window.viewport.toast(&tr!("app-saved", file = name_of(path)), Some(path.to_owned()));
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
