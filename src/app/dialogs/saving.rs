//! Saving muscles, and the question before unsaved changes would be lost.

use std::cell::RefCell;
use std::io::Write;
use std::path::Path;
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::save_as::{self, SaveRequest};
use crate::app::handles::app_context::AppContext;
use crate::app::loading::samples;
use crate::i18n::Sentence;
use crate::output::Output;
use crate::output::write_atomic;
use crate::{input, limits, tr};

/// Saves the muscle files that changed, each over the file it came from; one that has none asks for a name. `then` runs once all are saved.
pub(crate) fn save(app: &Rc<AppContext>, then: impl FnOnce() + 'static) {
    let (unsaved, first) =
        app.session.read(|session| (session.unsaved_files(), session.document().muscle_file_path(0).map(Path::to_path_buf)));
    // With nothing changed there is still something to save where no file has it yet.
    let wanted = if unsaved.is_empty() && first.is_none() { vec![0] } else { unsaved };
    save_each(app, wanted, Box::new(then));
}

fn save_each(app: &Rc<AppContext>, mut wanted: Vec<usize>, then: Box<dyn FnOnce()>) {
    let Some(index) = wanted.pop() else { return then() };
    let path = app.session.read(|session| session.document().muscle_file_path(index).map(Path::to_path_buf));
    match path {
        // A demo is written anew when it is opened again.
        Some(path) if !path.starts_with(samples::folder()) => match app.open_files.guard(&app.session).without(Some(&path)).output(&path) {
            Ok(output) => {
                if write(app, index, &output) {
                    save_each(app, wanted, then);
                }
            }
            Err(error) => save_as::failed(app, &path, error.sentence()),
        },
        _ => {
            let again = app.clone();
            choose(app, index, move || save_each(&again, wanted, then));
        }
    }
}

/// Asks where to and saves the first file that changed, else the first.
pub(crate) fn save_as(app: &Rc<AppContext>) {
    let index = app.session.read(|session| session.unsaved_files().first().copied().unwrap_or(0));
    choose(app, index, || ());
}

fn choose(app: &Rc<AppContext>, index: usize, then: impl FnOnce() + 'static) {
    let path = app.session.read(|session| session.document().muscle_file_path(index).map(Path::to_path_buf));
    let name = path.as_deref().map_or_else(|| "muscle.yaml".into(), save_as::name_of);
    let own = path.filter(|path| !path.starts_with(samples::folder()));
    let folder = own.as_deref().and_then(Path::parent).map(Path::to_path_buf);
    let wanted = SaveRequest { title: tr!("app-save-title"), name, folder, endings: &["yaml", "yml"], own };
    save_as::ask(app, wanted, move |app, output| {
        if write(app, index, output) {
            then();
        }
    });
}

/// Writes muscle file `index` whole or not at all, keeping the comments of the text that is there; says what came of it.
fn write(app: &Rc<AppContext>, index: usize, output: &Output) -> bool {
    let path = output.file().to_owned();
    let Some((file, source)) = app
        .session
        .read(|session| Some((session.file_for(index, &path)?, session.document().muscle_file_path(index).map(Path::to_path_buf))))
    else {
        return false;
    };
    let original = source.and_then(|source| input::read_text(&source, limits::YAML_BYTES).ok()).unwrap_or_default();
    let saved = file.to_yaml_keeping(&original);
    app.open_files.note_own_write(path.clone(), saved.text.clone());
    match write_atomic(output, |out| out.write_all(saved.text.as_bytes())) {
        Ok(()) => {
            app.error_bar.hide();
            app.session.update(|session| session.mark_saved(index, path.clone(), file));
            app.watcher.watch();
            let key = if saved.comments_lost { "app-saved-without-comments" } else { "app-saved" };
            app.toasts.toast(&tr!(key, file = save_as::name_of(&path)), Some(path));
            true
        }
        Err(error) => {
            save_as::failed(app, &path, error.sentence());
            false
        }
    }
}

/// Asks which of two versions of a muscle file is to be: the one in the window (`Some(true)`), or the one that another program wrote. `None` where no
/// answer is given.
pub(crate) fn confirm_conflict(app: &Rc<AppContext>, then: impl FnOnce(Option<bool>) + 'static) {
    let dialog = gtk::MessageDialog::builder()
        .transient_for(&app.widget)
        .modal(true)
        .message_type(gtk::MessageType::Question)
        .text(tr!("app-ask-which"))
        .secondary_text(tr!("app-ask-which-why"))
        .build();
    dialog.add_button(&tr!("app-ask-theirs"), gtk::ResponseType::Reject);
    dialog.add_button(&tr!("app-ask-mine"), gtk::ResponseType::Accept);
    dialog.set_default_response(gtk::ResponseType::Accept);
    let then = RefCell::new(Some(then));
    dialog.connect_response(move |dialog, response| {
        dialog.destroy();
        let keep = match response {
            gtk::ResponseType::Accept => Some(true),
            gtk::ResponseType::Reject => Some(false),
            _ => None,
        };
        if let Some(then) = then.take() {
            then(keep);
        }
    });
    dialog.present();
}

/// Does `then`; where something is not saved, asks first whether to save it, to let it go, or to stay.
pub(crate) fn confirm_unsaved(app: &Rc<AppContext>, then: impl FnOnce() + 'static) {
    if !app.session.read(|session| session.is_unsaved()) {
        return then();
    }
    let dialog = gtk::MessageDialog::builder()
        .transient_for(&app.widget)
        .modal(true)
        .message_type(gtk::MessageType::Question)
        .text(tr!("app-ask-save"))
        .secondary_text(tr!("app-ask-save-why"))
        .build();
    dialog.add_button(&tr!("app-ask-discard"), gtk::ResponseType::Reject);
    dialog.add_button(&tr!("app-cancel"), gtk::ResponseType::Cancel);
    dialog.add_button(&tr!("app-save"), gtk::ResponseType::Accept);
    dialog.set_default_response(gtk::ResponseType::Accept);
    let then = RefCell::new(Some(then));
    dialog.connect_response(glib::clone!(
        #[weak]
        app,
        move |dialog, response| {
            dialog.destroy();
            let Some(then) = then.take() else { return };
            match response {
                gtk::ResponseType::Accept => save(&app, then),
                gtk::ResponseType::Reject => then(),
                _ => {}
            }
        }
    ));
    dialog.present();
}
