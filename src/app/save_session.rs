//! Asks where to and saves the session.

use std::cell::RefCell;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::error_bar::Trouble;
use super::recent;
use super::window::Window;
use crate::export::atomic::write_whole;
use crate::tr;

/// Asks where to and saves what is open and how it is looked at.
pub fn save(window: &Rc<Window>) {
    let dialog = gtk::FileChooserNative::new(
        Some(&tr!("app-session-title")),
        Some(&window.widget),
        gtk::FileChooserAction::Save,
        Some(&tr!("app-save")),
        Some(&tr!("app-cancel")),
    );
    let name = window.look(|session| session.files()).first().and_then(|path| Some(path.file_stem()?.to_string_lossy().into_owned()));
    dialog.set_current_name(&format!("{}.session.yaml", name.unwrap_or_else(|| "sinew".into())));
    let keep = RefCell::new(Some(dialog.clone()));
    dialog.connect_response(glib::clone!(
        #[weak]
        window,
        move |dialog, response| {
            keep.take();
            if let (gtk::ResponseType::Accept, Some(path)) = (response, dialog.file().and_then(|file| file.path())) {
                write(&window, &with_ending(path));
            }
        }
    ));
    dialog.show();
}

/// A session is found again by its ending.
fn with_ending(path: PathBuf) -> PathBuf {
    let known = path.extension().is_some_and(|ending| ["yaml", "yml"].iter().any(|ours| ending.eq_ignore_ascii_case(ours)));
    if known {
        return path;
    }
    let mut name = path.into_os_string();
    name.push(".yaml");
    name.into()
}

fn write(window: &Rc<Window>, path: &Path) {
    let folder = path.parent().unwrap_or(Path::new(""));
    let text = window.look(|session| session.to_saved(folder).text());
    let written = text
        .map_err(|error| error.to_string())
        .and_then(|text| write_whole(path, |file| file.write_all(text.as_bytes())).map_err(|error| error.to_string()));
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    match written {
        Ok(()) => {
            recent::remember(path);
            window.viewport.toast(&tr!("app-session-saved", file = name), Some(path.to_owned()));
        }
        Err(reason) => window.error_bar.show(Trouble {
            headline: tr!("app-unsaved", file = name),
            message: reason,
            details: path.display().to_string(),
            again: None,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_session_gets_an_ending_that_is_opened() {
        assert_eq!(with_ending("a/b".into()), PathBuf::from("a/b.yaml"));
        assert_eq!(with_ending("a/b.YML".into()), PathBuf::from("a/b.YML"));
    }
}
