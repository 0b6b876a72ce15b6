//! Asks where to and saves the session.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::window::Window;
use super::{recent, save_as};
use crate::export::atomic::write_whole;
use crate::tr;

/// Asks where to and saves what is open and how it is looked at.
pub fn save(window: &Rc<Window>) {
    let name = save_as::name_like_open(window, "session.yaml");
    save_as::ask(window, &tr!("app-session-title"), &name, None, |window, path| write(window, &with_ending(path)));
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
    match written {
        Ok(()) => {
            recent::remember(path);
            window.viewport.toast(&tr!("app-session-saved", file = save_as::name_of(path)), Some(path.to_owned()));
        }
        Err(reason) => save_as::failed(window, path, reason),
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
