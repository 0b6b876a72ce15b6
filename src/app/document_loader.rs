//! Opening files off the interface thread, reloading when they change, closing, and files dropped on the window.

use std::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use gtk::prelude::*;
use gtk::{gdk, gio, glib};
use gtk4 as gtk;

use super::error_bar::ErrorMessage;
use super::window::Window;
use super::{compare_file, muscle_panel, recent, reload_summary, saving, title_bar};
use crate::document::{Document, OpenError, OpenErrorKind, OpenOptions};
use crate::export::guard::OverwriteGuard;
use crate::i18n::{self, Sentence};
use crate::message::{Location, SourceName};
use crate::muscle::MuscleFile;
use crate::progress::Progress;
use crate::session::{CompareTarget, LoadMode};
use crate::view::{self, Opened};
use crate::{input, limits, tr};

/// Extensions of files that can be opened.
const EXTENSIONS: [&str; 4] = ["dae", "zae", "yaml", "yml"];
/// Reading that is done within this time shows no progress.
const PROGRESS_DELAY: Duration = Duration::from_millis(150);
/// How long a file must rest after a change before it is read again.
const SETTLED: Duration = Duration::from_millis(300);

/// What is being read and watched.
#[derive(Default)]
pub(super) struct DocumentLoader {
    reading: RefCell<Option<Arc<Progress>>>,
    /// What is being read is to take the place of what is open, not the same files again.
    replaces: Cell<bool>,
    /// What is read beside it, to be compared with what is open.
    apart: RefCell<Option<Arc<Progress>>>,
    monitors: RefCell<Vec<gio::FileMonitor>>,
    /// What this program wrote last, and where: no news.
    written: RefCell<Option<(PathBuf, String)>>,
    failed: Cell<bool>,
    /// Muscles that are put into what is being read, and what is done then.
    carried: RefCell<Option<CarriedState>>,
    asking: Cell<bool>,
    /// The session file that what is open came from, or was saved to.
    session_file: RefCell<Option<PathBuf>>,
    /// What that session names, whether it could be opened or not.
    session_names: RefCell<Vec<PathBuf>>,
    /// The measured radii that muscles are compared with.
    table: RefCell<Option<PathBuf>>,
    /// Whether muscles on an arm of their own are hung on the clip that they come with.
    attach_after_load: Cell<bool>,
}

/// Muscle files that go over to the scene that is being read.
struct CarriedState {
    muscles: Vec<MuscleFile>,
    then: Box<dyn FnOnce()>,
}

fn cancel(reading: &RefCell<Option<Arc<Progress>>>) {
    if let Some(progress) = &*reading.borrow() {
        progress.cancel();
    }
}

fn is_newest(reading: &RefCell<Option<Arc<Progress>>>, progress: &Arc<Progress>) -> bool {
    reading.borrow().as_ref().is_some_and(|reading| Arc::ptr_eq(reading, progress))
}

impl DocumentLoader {
    /// Whether something is being read.
    pub(super) fn is_loading(&self) -> bool {
        self.reading.borrow().is_some() || self.apart.borrow().is_some()
    }

    /// Stops reading, whatever it is.
    pub(super) fn stop(&self) {
        [&self.reading, &self.apart].into_iter().for_each(cancel);
    }

    /// Says what was written to a file that may be watched.
    pub(super) fn note_own_write(&self, path: PathBuf, text: String) {
        self.written.replace(Some((path, text)));
    }

    /// Whether a file holds what this program wrote there.
    fn is_ours_still(&self, path: &Path) -> bool {
        let written = self.written.borrow();
        written
            .as_ref()
            .is_some_and(|(ours, text)| ours == path && input::read_text(path, limits::YAML_BYTES).is_ok_and(|now| now == *text))
    }

    /// The session file that what is open came from, or was saved to last.
    pub(super) fn session_file(&self) -> Option<PathBuf> {
        self.session_file.borrow().clone()
    }

    /// What is open was saved as this session file.
    pub(super) fn saved_session(&self, path: PathBuf) {
        self.session_file.replace(Some(path));
    }

    /// What is open comes from this session file, which names these files; or from none.
    fn came_from(&self, session: Option<(PathBuf, Vec<PathBuf>)>) {
        let (file, names) = session.map_or_else(Default::default, |(file, names)| (Some(file), names));
        self.session_file.replace(file);
        self.session_names.replace(names);
    }

    /// Muscles are compared with the measured radii of this file, or no longer of any.
    pub(super) fn compares_table(&self, path: Option<PathBuf>) {
        self.table.replace(path);
    }

    /// Whether there is a file that could not be opened.
    pub(super) fn can_retry(&self) -> bool {
        self.failed.get()
    }
}

/// Holds every file that is open in a window, with what belongs to it: no result replaces one of them.
pub(super) fn guard(window: &Rc<Window>) -> OverwriteGuard {
    let files = &window.files;
    let (names, table) = (files.session_names.borrow().clone(), files.table.borrow().clone());
    window.read(|session| session.guard()).and(names).and(files.session_file()).and(table)
}

/// Opens files side by side into one scene. What is open stays until they are read; whatever was being read is given up.
pub(super) fn open(window: &Rc<Window>, paths: Vec<PathBuf>, load_mode: LoadMode) {
    if paths.is_empty() {
        return;
    }
    saving::confirm_unsaved(window, move |window| open_now(window, paths, load_mode, None));
}

/// Tries once more to open files that could not be; what was to be done with them then is still to be done.
pub(super) fn retry(window: &Rc<Window>, paths: Vec<PathBuf>, load_mode: LoadMode) {
    saving::confirm_unsaved(window, move |window| {
        let (attach_after_load, carried) = (window.files.attach_after_load.get(), window.files.carried.take());
        open_now(window, paths, load_mode, carried);
        window.files.attach_after_load.set(attach_after_load);
    });
}

/// Opens files (none: the built-in scene) and puts muscles that are not saved into them; `then` runs once they are there.
pub(super) fn open_with_state(window: &Rc<Window>, paths: Vec<PathBuf>, muscles: Vec<MuscleFile>, then: impl FnOnce() + 'static) {
    saving::confirm_unsaved(window, move |window| {
        let carried = CarriedState { muscles, then: Box::new(then) };
        if paths.is_empty() {
            window.files.stop();
            window.start_page(false);
            window.settings.restore_view(&window.session);
            window.files.came_from(None);
            window.viewport.hide_notice();
            window.update(|session| {
                session.show(Document::built_in(), LoadMode::New);
                session.set_carried_files(carried.muscles);
            });
            return (carried.then)();
        }
        open_now(window, paths, LoadMode::New, Some(carried));
    });
}

/// Opens files that were dropped. Muscles that are dropped on a clip, or with one, come to it and are hung on its bones.
fn open_dropped(window: &Rc<Window>, dropped: Vec<PathBuf>) {
    if dropped.is_empty() {
        return;
    }
    let clips = if dropped.iter().all(|path| brings_no_clip(path)) { window.read(|session| session.clip_files()) } else { Vec::new() };
    let paths: Vec<PathBuf> = clips.into_iter().chain(dropped).collect();
    saving::confirm_unsaved(window, move |window| {
        open_now(window, paths, LoadMode::New, None);
        window.files.attach_after_load.set(true);
    });
}

/// Whether a file is one of muscles that names no clip of its own.
fn brings_no_clip(path: &Path) -> bool {
    let is_muscles = path.extension().is_some_and(|ending| ["yaml", "yml"].iter().any(|ours| ending.eq_ignore_ascii_case(ours)));
    let parse = || MuscleFile::parse(&input::read_text(path, limits::YAML_BYTES).ok()?).ok();
    is_muscles && parse().is_some_and(|file| file.clip.is_none())
}

fn open_now(window: &Rc<Window>, paths: Vec<PathBuf>, load_mode: LoadMode, carried: Option<CarriedState>) {
    window.files.stop();
    window.files.attach_after_load.set(false);
    window.files.carried.replace(carried);
    let progress = Arc::new(Progress::default());
    window.files.reading.replace(Some(progress.clone()));
    window.files.replaces.set(load_mode == LoadMode::New);
    show_progress(window, &paths, &progress);
    let window = window.clone();
    glib::spawn_future_local(async move {
        let (wanted, hand) = (paths.clone(), progress.clone());
        let read = gio::spawn_blocking(move || view::open(&wanted, OpenOptions::default(), &hand)).await;
        if !is_newest(&window.files.reading, &progress) {
            return;
        }
        window.files.reading.replace(None);
        window.viewport.loading(None);
        match read {
            _ if progress.is_cancelled() => window.update(|session| session.touch()),
            Ok(Ok(opened)) => show_loaded(&window, opened, &paths, load_mode),
            Ok(Err(error)) => refused(&window, &error, paths, load_mode),
            // The reader is made not to panic; should it, what is open is still worth more than the program's life.
            Err(_) => refused(&window, &unexpected(&paths), paths, load_mode),
        }
    });
}

/// Reads a file off the interface thread, with progress and Cancel, and passes the document on; what is open stays as it is, and what is being opened
/// goes on.
pub(super) fn read_in_background(window: &Rc<Window>, path: PathBuf, then: impl FnOnce(&Rc<Window>, Document) + 'static) {
    cancel(&window.files.apart);
    let progress = Arc::new(Progress::default());
    window.files.apart.replace(Some(progress.clone()));
    let paths = vec![path];
    show_progress(window, &paths, &progress);
    let window = window.clone();
    glib::spawn_future_local(async move {
        let (wanted, hand) = (paths.clone(), progress.clone());
        let read = gio::spawn_blocking(move || Document::open(&wanted, &hand)).await;
        if !is_newest(&window.files.apart, &progress) {
            return;
        }
        window.files.apart.replace(None);
        window.viewport.loading(None);
        match read {
            _ if progress.is_cancelled() => window.update(|session| session.touch()),
            Ok(Ok(document)) => {
                window.error_bar.hide();
                then(&window, document);
            }
            Ok(Err(error)) => show_open_error(&window, &error, None),
            Err(_) => show_open_error(&window, &unexpected(&paths), None),
        }
    });
}

fn unexpected(paths: &[PathBuf]) -> OpenError {
    let file = paths.first().map_or(SourceName::Unknown, |path| SourceName::of_argument(path));
    OpenError::whole(&file, OpenErrorKind::ReaderFailed)
}

fn show_progress(window: &Rc<Window>, paths: &[PathBuf], progress: &Arc<Progress>) {
    let names = paths.iter().filter_map(|path| path.file_name()).map(|name| name.to_string_lossy()).collect::<Vec<_>>().join(", ");
    let text = tr!("app-loading", file = names);
    let (weak, mine) = (Rc::downgrade(window), progress.clone());
    glib::timeout_add_local_once(PROGRESS_DELAY, move || {
        glib::timeout_add_local(Duration::from_millis(60), move || {
            let Some(window) = weak.upgrade() else { return glib::ControlFlow::Break };
            let files = &window.files;
            if is_newest(&files.reading, &mine) || is_newest(&files.apart, &mine) {
                let part = f64::from(mine.share());
                window.viewport.loading(Some((&text, part)));
                glib::ControlFlow::Continue
            } else {
                glib::ControlFlow::Break
            }
        });
    });
}

fn show_loaded(window: &Rc<Window>, opened: Opened, paths: &[PathBuf], load_mode: LoadMode) {
    let Opened { document, session: saved, compared } = opened;
    window.error_bar.hide();
    window.start_page(false);
    window.viewport.hide_notice();
    window.files.failed.set(false);
    let summary =
        (load_mode == LoadMode::Again).then(|| window.read(|session| reload_summary::what_changed(session.document(), &document)));
    let warnings = document.diagnostics.len();
    let wanted = saved.as_ref().and_then(|saved| saved.compared.as_ref()?.file.clone()).filter(|_| compared.is_none());
    if load_mode == LoadMode::New {
        window.settings.restore_view(&window.session);
        let session = saved.as_ref().zip(paths.first());
        window.files.came_from(session.map(|(saved, file)| (file.clone(), saved.all_files(file.parent().unwrap_or(Path::new(""))))));
    }
    match &saved {
        Some(saved) => window.settings.use_view_of_file(&window.session, |session| {
            session.show_session(document, saved);
            if let (Some((path, other)), Some(shift)) = (compared, &saved.compared) {
                session.compare(Some(CompareTarget::File(Box::new(other), path.display().to_string())));
                session.apply_saved_comparison(shift);
                if saved.camera.is_none() && saved.file_camera.is_none() {
                    session.fit();
                }
            }
        }),
        None => window.update(|session| session.show(document, load_mode)),
    }
    if let Some(carried) = window.files.carried.take() {
        window.update(|session| session.set_carried_files(carried.muscles));
        (carried.then)();
    }
    watch(window);
    let demos = super::samples::folder();
    let paths: Vec<&PathBuf> = paths.iter().filter(|path| path.as_os_str() != "-" && !path.starts_with(&demos)).collect();
    if let Some(folder) =
        paths.first().and_then(|path| std::path::absolute(path).ok()).and_then(|path| path.parent().map(Path::to_path_buf))
    {
        window.settings.borrow_mut().folder = Some(folder);
    }
    let attached = window.files.attach_after_load.take() && saved.is_none() && muscle_panel::attach_all_to_skeleton(window);
    match summary {
        Some(summary) => window.viewport.toast(&summary, None),
        None => {
            paths.iter().for_each(|path| recent::remember(path));
            if let Some(lost) = wanted {
                window.viewport.toast(&tr!("app-compared-lost", file = lost.display().to_string()), None);
            } else if warnings > 0 && !attached {
                window.viewport.toast(&tr!("app-diagnostics-found", count = warnings), None);
            }
        }
    }
}

fn refused(window: &Rc<Window>, error: &OpenError, paths: Vec<PathBuf>, load_mode: LoadMode) {
    window.files.failed.set(true);
    show_open_error(window, error, Some((paths, load_mode)));
}

/// Says why a file cannot be opened; with the files, offers to try again.
fn show_open_error(window: &Rc<Window>, error: &OpenError, again: Option<(Vec<PathBuf>, LoadMode)>) {
    let Location { file, line, column } = &error.location;
    let file = i18n::source_name(file);
    let name = Path::new(&file).file_name().map_or_else(|| file.clone(), |name| name.to_string_lossy().into_owned());
    let place = match (line, column) {
        (Some(line), Some(column)) => tr!("app-at-line-column", line = line.to_string(), column = column.to_string()),
        (Some(line), None) => tr!("app-at-line", line = line.to_string()),
        _ => String::new(),
    };
    let what = error.kind.sentence();
    let message = if place.is_empty() { what } else { format!("{place}: {what}") };
    let kept = if window.read(|session| session.is_empty()) { String::new() } else { format!("\n{}", tr!("app-kept")) };
    window.error_bar.show(ErrorMessage {
        headline: tr!("app-refused", file = name),
        message,
        details: format!("{}{kept}", error.sentence()),
        again,
    });
    window.update(|session| session.touch());
}

/// Watches the files: when one is written again, all are read again; the one that is compared with, for itself.
pub(super) fn watch(window: &Rc<Window>) {
    let (paths, compared) = window.read(|session| (session.files(), session.compared_file()));
    let make = |path: PathBuf, again: fn(&Rc<Window>, &Path)| {
        let monitor = gio::File::for_path(&path).monitor_file(gio::FileMonitorFlags::WATCH_MOVES, gio::Cancellable::NONE).ok()?;
        let (weak, changes) = (Rc::downgrade(window), Rc::new(Cell::new(0_u32)));
        monitor.connect_changed(move |_, _, _, event| {
            use gio::FileMonitorEvent as E;
            if !matches!(event, E::Changed | E::ChangesDoneHint | E::Created | E::Renamed | E::MovedIn) {
                return;
            }
            let number = changes.get().wrapping_add(1);
            changes.set(number);
            let (weak, path, changes) = (weak.clone(), path.clone(), changes.clone());
            glib::timeout_add_local_once(SETTLED, move || {
                if let Some(window) = weak.upgrade()
                    && changes.get() == number
                    && !window.files.is_ours_still(&path)
                {
                    again(&window, &path);
                }
            });
        });
        Some(monitor)
    };
    let own = paths.into_iter().filter_map(|path| make(path, |window, _| reload_own(window)));
    let other = compared.and_then(|path| make(path, compare_file::read_again));
    window.files.monitors.replace(own.chain(other).collect());
}

/// Reads the open files again, and the one that is compared with.
pub(super) fn reload(window: &Rc<Window>) {
    if let Some(path) = window.read(|session| session.compared_file()) {
        compare_file::read_again(window, &path);
    }
    reload_own(window);
}

/// Reads the open files again. Muscles that are not saved stay as they are; where their file has changed too, a person says which of both is to be.
fn reload_own(window: &Rc<Window>) {
    let (paths, unsaved, both) = window.read(|session| {
        let unsaved = session.is_unsaved();
        (session.files(), unsaved, unsaved && session.is_changed_outside())
    });
    // What is being opened takes their place: to read them again would only keep it from coming.
    if paths.is_empty() || window.files.asking.get() || window.files.reading.borrow().is_some() && window.files.replaces.get() {
        return;
    }
    if !unsaved {
        return open_now(window, paths, LoadMode::Again, None);
    }
    let mine = move |window: &Rc<Window>| {
        let muscles = window.read(|session| session.document().muscle_files().cloned().collect());
        Some(CarriedState { muscles, then: Box::new(|| ()) })
    };
    if !both {
        return open_now(window, paths, LoadMode::Again, mine(window));
    }
    window.files.asking.set(true);
    saving::confirm_conflict(window, move |window, keep| {
        window.files.asking.set(false);
        match keep {
            Some(true) => open_now(window, paths, LoadMode::Again, mine(window)),
            Some(false) => open_now(window, paths, LoadMode::Again, None),
            None => {}
        }
    });
}

/// Closes the files; the start page comes up. With nothing open the window closes.
pub(super) fn close(window: &Rc<Window>) {
    saving::confirm_unsaved(window, close_now);
}

fn close_now(window: &Rc<Window>) {
    if window.read(|session| session.is_empty()) && !window.files.is_loading() {
        window.widget.close();
        return;
    }
    forget(window);
    window.settings.restore_view(&window.session);
    window.update(|session| session.show(Document::default(), LoadMode::New));
}

/// Stops reading and watching, and takes the message away.
pub(super) fn forget(window: &Rc<Window>) {
    window.files.stop();
    window.files.reading.replace(None);
    window.files.apart.replace(None);
    window.files.carried.replace(None);
    window.files.attach_after_load.set(false);
    window.files.monitors.replace(Vec::new());
    window.files.came_from(None);
    window.viewport.loading(None);
    window.viewport.hide_notice();
    window.error_bar.hide();
}

/// Opens the next (or previous) file of the folder, by name.
pub(super) fn neighbour(window: &Rc<Window>, by: isize) {
    let main = window.read(|session| title_bar::sources(session.document()).first().and_then(|source| source.path.clone()));
    let Some(open_now) = main.and_then(|path| std::path::absolute(path).ok()) else { return };
    let Some(entries) = open_now.parent().and_then(|folder| std::fs::read_dir(folder).ok()) else { return };
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).filter(|path| is_ours(path) && path.is_file()).collect();
    files.sort();
    if let Some(place) = files.iter().position(|path| *path == open_now) {
        let next = (place as isize + by).rem_euclid(files.len() as isize) as usize;
        if next != place {
            open(window, vec![files.swap_remove(next)], LoadMode::New);
        }
    }
}

fn is_ours(path: &Path) -> bool {
    path.extension().is_some_and(|ending| EXTENSIONS.iter().any(|ours| ending.eq_ignore_ascii_case(ours)))
}

/// Lets the user choose files to open.
pub(super) fn choose(window: &Rc<Window>) {
    ask_for_files(window, &tr!("app-choose-title"), true, |window, paths| open(window, paths, LoadMode::New));
}

/// Lets the user choose files, one or several, and opens them.
pub(super) fn ask_for_files(window: &Rc<Window>, title: &str, several: bool, then: impl Fn(&Rc<Window>, Vec<PathBuf>) + 'static) {
    let dialog = gtk::FileChooserNative::new(
        Some(title),
        Some(&window.widget),
        gtk::FileChooserAction::Open,
        Some(&tr!("app-choose-open")),
        Some(&tr!("app-cancel")),
    );
    dialog.set_select_multiple(several);
    let ours = gtk::FileFilter::new();
    ours.set_name(Some(&tr!("app-choose-ours")));
    for ending in EXTENSIONS {
        ours.add_pattern(&format!("*.{ending}"));
        ours.add_pattern(&format!("*.{}", ending.to_uppercase()));
    }
    let all = gtk::FileFilter::new();
    all.set_name(Some(&tr!("app-choose-all")));
    all.add_pattern("*");
    dialog.add_filter(&ours);
    dialog.add_filter(&all);
    if let Some(folder) = window.settings.borrow().folder.as_deref().filter(|folder| folder.is_dir()) {
        // Where the folder cannot be shown, the dialog starts where it likes.
        let _ = dialog.set_current_folder(Some(&gio::File::for_path(folder)));
    }
    let keep = RefCell::new(Some(dialog.clone()));
    dialog.connect_response(glib::clone!(
        #[weak]
        window,
        move |dialog, response| {
            keep.take();
            if response == gtk::ResponseType::Accept {
                let files = dialog.files();
                let paths = (0..files.n_items()).filter_map(|i| files.item(i).and_downcast::<gio::File>()?.path()).collect();
                then(&window, paths);
            }
        }
    ));
    dialog.show();
}

/// Files can be dropped on the picture; the place is marked while they hang over it. The Cancel button stops reading.
pub(super) fn accept_drops(window: &Rc<Window>) {
    let target = gtk::DropTarget::new(gdk::FileList::static_type(), gdk::DragAction::COPY);
    target.connect_enter(glib::clone!(
        #[weak]
        window,
        #[upgrade_or]
        gdk::DragAction::empty(),
        move |_, _, _| {
            window.viewport.drop_here(true);
            gdk::DragAction::COPY
        }
    ));
    target.connect_leave(glib::clone!(
        #[weak]
        window,
        move |_| window.viewport.drop_here(false)
    ));
    target.connect_drop(glib::clone!(
        #[weak]
        window,
        #[upgrade_or]
        false,
        move |_, value, _, _| {
            window.viewport.drop_here(false);
            let Ok(files) = value.get::<gdk::FileList>() else { return false };
            let paths: Vec<PathBuf> = files.files().iter().filter_map(FileExt::path).collect();
            let any = !paths.is_empty();
            open_dropped(&window, paths);
            any
        }
    ));
    window.viewport.add_controller(&target);
    window.viewport.cancel_button().connect_clicked(glib::clone!(
        #[weak]
        window,
        move |_| {
            window.files.stop();
            window.files.reading.replace(None);
            window.viewport.loading(None);
            window.update(|session| session.touch());
        }
    ));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_are_known_in_any_case() {
        assert!(is_ours(Path::new("a.DAE")) && is_ours(Path::new("b.yml")) && !is_ours(Path::new("dae")) && !is_ours(Path::new("c.obj")));
    }
}
