//! Saving a session, with a file dialog.

use std::io::Write;
use std::path::Path;
use std::rc::Rc;

use super::save_as::{self, SaveRequest};
use crate::app::handles::app_context::AppContext;
use crate::app::loading::recent;
use crate::i18n::Sentence;
use crate::output::Output;
use crate::output::write_atomic;
use crate::tr;

/// Asks where to and saves what is open and how it is looked at. Of the files that are open, only the session file itself may be replaced.
pub(crate) fn save(app: &Rc<AppContext>) {
    let own = app.open_files.session_file();
    let name = own.as_deref().map_or_else(|| save_as::name_like_open(app, "session.yaml"), save_as::name_of);
    let folder = own.as_deref().and_then(Path::parent).map(Path::to_path_buf);
    let wanted = SaveRequest { title: tr!("app-session-title"), name, folder, endings: &["yaml", "yml"], own };
    save_as::ask(app, wanted, write);
}

fn write(app: &Rc<AppContext>, output: &Output) {
    let path = output.file();
    let folder = path.parent().unwrap_or(Path::new(""));
    let text = app.session.read(|session| session.session_state(folder).to_yaml());
    let written = text
        .map_err(|error| error.sentence())
        .and_then(|text| write_atomic(output, |file| file.write_all(text.as_bytes())).map_err(|error| error.sentence()));
    match written {
        Ok(()) => {
            app.error_bar.hide();
            app.open_files.saved_session(path.to_owned());
            recent::remember(path);
            app.toasts.toast(&tr!("app-session-saved", file = save_as::name_of(path)), Some(path.to_owned()));
        }
        Err(reason) => save_as::failed(app, path, reason),
    }
}
