//! Choosing files to open: in a file dialog, or the next one of a folder.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use gtk::gio;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::handles::app_context::AppContext;
use crate::formats::SCENE_READERS;
use crate::tr;

/// Lets the user choose files, one or several; `then` gets them.
pub(crate) fn ask_for_files(app: &Rc<AppContext>, title: &str, several: bool, then: impl Fn(Vec<PathBuf>) + 'static) {
    let dialog = gtk::FileChooserNative::new(
        Some(title),
        Some(&app.widget),
        gtk::FileChooserAction::Open,
        Some(&tr!("app-choose-open")),
        Some(&tr!("app-cancel")),
    );
    dialog.set_select_multiple(several);
    let ours = gtk::FileFilter::new();
    ours.set_name(Some(&tr!("app-choose-ours")));
    for ending in SCENE_READERS.extensions() {
        ours.add_pattern(&format!("*.{ending}"));
        ours.add_pattern(&format!("*.{}", ending.to_uppercase()));
    }
    let all = gtk::FileFilter::new();
    all.set_name(Some(&tr!("app-choose-all")));
    all.add_pattern("*");
    dialog.add_filter(&ours);
    dialog.add_filter(&all);
    if let Some(folder) = app.settings.borrow().folder.as_deref().filter(|folder| folder.is_dir()) {
        // Where the folder cannot be shown, the dialog starts where it likes.
        let _ = dialog.set_current_folder(Some(&gio::File::for_path(folder)));
    }
    let keep = RefCell::new(Some(dialog.clone()));
    dialog.connect_response(move |dialog, response| {
        keep.take();
        if response == gtk::ResponseType::Accept {
            let files = dialog.files();
            then((0..files.n_items()).filter_map(|i| files.item(i).and_downcast::<gio::File>()?.path()).collect());
        }
    });
    dialog.show();
}

/// The next (or previous) file after `open` in its folder, by name, that can be opened.
pub(crate) fn neighbour(open: &Path, by: isize) -> Option<PathBuf> {
    let open = std::path::absolute(open).ok()?;
    let entries = std::fs::read_dir(open.parent()?).ok()?;
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).filter(|path| is_ours(path) && path.is_file()).collect();
    files.sort();
    let place = files.iter().position(|path| *path == open)?;
    let next = (place as isize + by).rem_euclid(files.len() as isize) as usize;
    (next != place).then(|| files.swap_remove(next))
}

fn is_ours(path: &Path) -> bool {
    path.extension().is_some_and(|ending| SCENE_READERS.extensions().any(|ours| ending.eq_ignore_ascii_case(ours)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_are_known_in_any_case() {
        assert!(is_ours(Path::new("a.DAE")) && is_ours(Path::new("b.yml")) && !is_ours(Path::new("dae")) && !is_ours(Path::new("c.obj")));
    }

    #[test]
    fn the_files_of_a_folder_follow_one_another_in_a_ring() {
        let folder = tempfile::tempdir().expect("a folder");
        let [a, b, c] = ["a.dae", "b.yaml", "c.DAE"].map(|name| folder.path().join(name));
        for path in [&a, &b, &c, &folder.path().join("b.txt")] {
            std::fs::write(path, "").expect("written");
        }
        assert_eq!((neighbour(&a, 1), neighbour(&c, 1), neighbour(&a, -1)), (Some(b), Some(a), Some(c)));
        assert_eq!(neighbour(&folder.path().join("gone.dae"), 1), None);
    }
}
