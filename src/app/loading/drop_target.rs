//! Files that are dropped on the picture.

use std::path::{Path, PathBuf};
use std::rc::Rc;

use gtk::prelude::*;
use gtk::{gdk, glib};
use gtk4 as gtk;

use super::document_loader::DocumentLoader;
use crate::muscle::MuscleFile;
use crate::{input, limits};

/// Lets files be dropped on `picture`; `mark` is shown while they hang over it.
pub(crate) fn connect(loader: &Rc<DocumentLoader>, picture: &gtk::Overlay, mark: &gtk::Label) {
    let target = gtk::DropTarget::new(gdk::FileList::static_type(), gdk::DragAction::COPY);
    target.connect_enter(glib::clone!(
        #[weak]
        mark,
        #[upgrade_or]
        gdk::DragAction::empty(),
        move |_, _, _| {
            mark.set_visible(true);
            gdk::DragAction::COPY
        }
    ));
    target.connect_leave(glib::clone!(
        #[weak]
        mark,
        move |_| mark.set_visible(false)
    ));
    target.connect_drop(glib::clone!(
        #[weak]
        loader,
        #[weak]
        mark,
        #[upgrade_or]
        false,
        move |_, value, _, _| {
            mark.set_visible(false);
            let Ok(files) = value.get::<gdk::FileList>() else { return false };
            let paths: Vec<PathBuf> = files.files().iter().filter_map(FileExt::path).collect();
            let any = !paths.is_empty();
            open_dropped(&loader, paths);
            any
        }
    ));
    picture.add_controller(target);
}

/// Opens files that were dropped. Muscles that are dropped on a clip, or with one, come to it and are hung on its bones.
fn open_dropped(loader: &Rc<DocumentLoader>, dropped: Vec<PathBuf>) {
    if dropped.is_empty() {
        return;
    }
    let only_muscles = dropped.iter().all(|path| brings_no_clip(path));
    let clips = if only_muscles { loader.app.session.read(|session| session.clip_files()) } else { Vec::new() };
    loader.open_attached(clips.into_iter().chain(dropped).collect());
}

/// Whether a file is one of muscles that names no clip of its own.
fn brings_no_clip(path: &Path) -> bool {
    let is_muscles = path.extension().is_some_and(|ending| ["yaml", "yml"].iter().any(|ours| ending.eq_ignore_ascii_case(ours)));
    let parse = || MuscleFile::parse(&input::read_text(path, limits::YAML_BYTES).ok()?).ok();
    is_muscles && parse().is_some_and(|file| file.clip.is_none())
}
