//! Opens a file beside what is open, to compare the two.

use std::path::PathBuf;
use std::rc::Rc;

use super::files;
use super::session::With;
use super::window::Window;

/// Asks for a file and compares what is open with it.
pub fn choose(window: &Rc<Window>) {
    files::ask_for_files(window, false, |window, mut paths| {
        if let Some(path) = paths.pop() {
            open(window, path);
        }
    });
}

/// Compares what is open with a file.
pub fn open(window: &Rc<Window>, path: PathBuf) {
    let name = path.display().to_string();
    files::read_apart(window, path, move |window, document| {
        window.act(|session| session.compare(Some(With::File(Box::new(document), name))));
    });
}
