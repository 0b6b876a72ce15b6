//! File dialogs for saving, and messages about the result, for pictures, sessions and muscles.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use crate::app::handles::app_context::AppContext;
use crate::app::notices::error_bar::ErrorMessage;
use crate::export::file_extension::with_extension;
use crate::i18n::{Sentence, shown};
use crate::output::{Output, is_same};
use crate::tr;

/// A file to be saved.
pub(crate) struct SaveRequest {
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
pub(crate) fn ask(app: &Rc<AppContext>, wanted: SaveRequest, then: impl FnOnce(&Rc<AppContext>, &Output) + 'static) {
    let SaveRequest { title, name, folder, endings, own } = wanted;
    let folder = folder.or_else(|| usual_folder(app));
    let its = own.clone();
    let is_own = move |file: &Path| its.as_deref().is_some_and(|own| is_same(own, file));
    let there = folder.clone().unwrap_or_default();
    let name = if is_own(&there.join(&name)) {
        name
    } else {
        app.open_files.guard(&app.session).free_name(&there, &name, |file| vec![file.to_owned()])
    };
    let complete = move |chosen: &Path| if is_own(chosen) { chosen.to_owned() } else { with_extension(chosen, endings) };
    let asked = FileDialogOptions { title, name, folder };
    choose(
        app.widget.upcast_ref(),
        asked,
        complete.clone(),
        glib::clone!(
            #[weak]
            app,
            move |chosen: PathBuf| {
                let path = complete(&chosen);
                let output = match app.open_files.guard(&app.session).without(own.as_deref()).output(&path) {
                    Ok(output) => output,
                    Err(error) => return failed(&app, &path, error.sentence()),
                };
                // The dialog asked about the name that it showed.
                let unasked = if path == chosen { Vec::new() } else { vec![path] };
                let again = app.clone();
                ask_to_replace(app.widget.upcast_ref(), unasked, move || then(&again, &output));
            }
        ),
    );
}

/// The folder that was opened from last.
pub(crate) fn usual_folder(app: &Rc<AppContext>) -> Option<PathBuf> {
    app.settings.borrow().folder.clone().filter(|folder| folder.is_dir())
}

/// Initial state of a file dialog.
pub(crate) struct FileDialogOptions {
    /// The title of the dialog.
    pub title: String,
    /// The name to start from.
    pub name: String,
    /// Where to start; none = where the dialog likes.
    pub folder: Option<PathBuf>,
}

/// Asks for a file to write; `then` gets it unless the dialog is cancelled. What is typed is completed before the dialog looks whether such a
/// file is there: it asks about what will be written. For that the dialog is GTK's own; another one would ask before anybody could complete the name.
pub(crate) fn choose(
    parent: &gtk::Window,
    asked: FileDialogOptions,
    complete: impl Fn(&Path) -> PathBuf + 'static,
    then: impl FnOnce(PathBuf) + 'static,
) {
    let dialog = gtk::FileChooserDialog::builder()
        .title(asked.title)
        .transient_for(parent)
        .modal(true)
        .action(gtk::FileChooserAction::Save)
        .use_header_bar(1)
        .build();
    dialog.add_button(&tr!("app-cancel"), gtk::ResponseType::Cancel);
    let save = gtk::Button::with_label(&tr!("app-save"));
    save.add_css_class("suggested-action");
    // Connected before the dialog's own handler, so that it runs first.
    save.connect_clicked(glib::clone!(
        #[weak]
        dialog,
        move |_| complete_name(&dialog, &complete)
    ));
    dialog.add_action_widget(&save, gtk::ResponseType::Accept);
    dialog.set_default_response(gtk::ResponseType::Accept);
    dialog.set_current_name(&shown(&asked.name));
    if let Some(folder) = asked.folder.filter(|folder| folder.is_dir()) {
        // Where the folder cannot be shown, the dialog starts where it likes.
        let _ = dialog.set_current_folder(Some(&gio::File::for_path(folder)));
    }
    let then = RefCell::new(Some(then));
    dialog.connect_response(move |dialog, response| {
        let path = dialog.file().and_then(|file| file.path()).filter(|_| response == gtk::ResponseType::Accept);
        dialog.destroy();
        if let (Some(path), Some(then)) = (path, then.take()) {
            then(path);
        }
    });
    dialog.present();
}

/// Puts the completed name into the dialog; the folder before it stays as it was typed, and the name of a folder stays what leads there.
fn complete_name(dialog: &gtk::FileChooserDialog, complete: &dyn Fn(&Path) -> PathBuf) {
    let (Some(typed), Some(file)) = (dialog.current_name(), dialog.file().and_then(|file| file.path())) else { return };
    let whole = complete(&file);
    let name = |file: &Path| file.file_name().map(|name| name.to_string_lossy().into_owned());
    let (Some(before), Some(after)) = (name(&file), name(&whole)) else { return };
    if let Some(folder) = typed.strip_suffix(before.as_str()).filter(|_| before != after && !file.is_dir()) {
        dialog.set_current_name(&format!("{folder}{after}"));
    }
}

/// Does `then`; asks first where one of these files is there, which the file dialog has not asked about.
pub(crate) fn ask_to_replace(parent: &gtk::Window, files: Vec<PathBuf>, then: impl FnOnce() + 'static) {
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
pub(crate) fn name_like_open(app: &Rc<AppContext>, ending: &str) -> String {
    let stem = app.session.read(|session| session.files().first().and_then(|path| Some(path.file_stem()?.to_string_lossy().into_owned())));
    format!("{}.{ending}", stem.unwrap_or_else(|| "sinew".into()))
}

/// A file's name as messages give it.
pub(crate) fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Says that a file was saved, by the name that it has now.
pub(crate) fn done(app: &Rc<AppContext>, path: &Path) {
    app.error_bar.hide();
    app.toasts.toast(&tr!("app-saved", file = name_of(path)), Some(path.to_owned()));
}

/// Says that something could not be saved, and why.
pub(crate) fn failed(app: &Rc<AppContext>, path: &Path, reason: String) {
    app.error_bar.show(ErrorMessage {
        headline: tr!("app-unsaved", file = name_of(path)),
        message: reason,
        details: path.display().to_string(),
        again: None,
    });
}
