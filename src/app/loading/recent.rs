//! Recently opened files, from the list that the desktop keeps.

use std::path::{Path, PathBuf};

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use crate::formats::SCENE_READERS;

/// Most files that are listed.
const MOST: usize = 8;

/// Remembers a file that was opened.
pub(crate) fn remember(path: &Path) {
    gtk::RecentManager::default().add_item(&gio::File::for_path(path).uri());
}

/// The files that this program opened and that are still there, the last one first.
pub(crate) fn list() -> Vec<PathBuf> {
    let ours = |path: &Path| {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        ending.is_some_and(|ending| SCENE_READERS.extensions().any(|known| known == ending))
    };
    let name = glib::application_name();
    let mut found: Vec<(i64, PathBuf)> = gtk::RecentManager::default()
        .items()
        .iter()
        .filter(|info| name.as_deref().is_some_and(|name| info.has_application(name)))
        .filter_map(|info| Some((info.visited().to_unix(), gio::File::for_uri(&info.uri()).path()?)))
        .filter(|(_, path)| ours(path) && path.is_file())
        .collect();
    found.sort_by_key(|(visited, _)| std::cmp::Reverse(*visited));
    found.into_iter().map(|(_, path)| path).take(MOST).collect()
}
