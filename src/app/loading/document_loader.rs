//! Opening, reading again and closing: what is asked first, what happens to what is open, and what is said about the result.

use std::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::{named_sources, open_error, recent, reload_summary, samples};
use crate::app::dialogs::{compare_file, file_chooser, saving};
use crate::app::handles::app_context::AppContext;
use crate::app::panels::muscle::attach_muscles;
use crate::document::Document;
use crate::muscle::MuscleFile;
use crate::session::{CompareTarget, LoadMode};
use crate::tr;
use crate::view::Opened;

/// Opens files in a window.
pub(crate) struct DocumentLoader {
    /// The handles of the window.
    pub app: Rc<AppContext>,
    /// What is being read is to take the place of what is open, not the same files again.
    replaces: Cell<bool>,
    failed: Cell<bool>,
    /// Muscles that are put into what is being read, and what is done then.
    carried: RefCell<Option<CarriedState>>,
    asking: Cell<bool>,
    /// Whether muscles on an arm of their own are hung on the clip that they come with.
    attach_after_load: Cell<bool>,
}

/// Muscle files that go over to the scene that is being read.
struct CarriedState {
    muscles: Vec<MuscleFile>,
    then: Box<dyn FnOnce()>,
}

impl DocumentLoader {
    /// The loader of a window; it reads again what other programs write, and what could not be read and is tried once more.
    pub(crate) fn new(app: &Rc<AppContext>) -> Rc<Self> {
        let loader = Rc::new(Self {
            app: app.clone(),
            replaces: Cell::default(),
            failed: Cell::default(),
            carried: RefCell::default(),
            asking: Cell::default(),
            attach_after_load: Cell::default(),
        });
        app.error_bar.connect_retry(glib::clone!(
            #[weak]
            loader,
            move |paths, load_mode| loader.retry(paths, load_mode)
        ));
        app.watcher.connect_changed(
            glib::clone!(
                #[weak]
                loader,
                move |_| loader.reload_own()
            ),
            glib::clone!(
                #[weak]
                app,
                move |path| compare_file::read_again(&app, path)
            ),
        );
        loader
    }

    /// Whether there is a file that could not be opened.
    pub(crate) fn can_retry(&self) -> bool {
        self.failed.get()
    }

    /// Does `then` once nothing that is not saved would be lost by it.
    fn once_saved(self: &Rc<Self>, then: impl FnOnce(&Rc<Self>) + 'static) {
        let weak = Rc::downgrade(self);
        saving::confirm_unsaved(&self.app, move || {
            if let Some(loader) = weak.upgrade() {
                then(&loader);
            }
        });
    }

    /// Lets the user choose files to open.
    pub(crate) fn choose(self: &Rc<Self>) {
        let open = glib::clone!(
            #[weak(rename_to = loader)]
            self,
            move |paths| loader.open(paths, LoadMode::New)
        );
        file_chooser::ask_for_files(&self.app, &tr!("app-choose-title"), true, open);
    }

    /// Opens files side by side into one scene. What is open stays until they are read; whatever was being read is given up.
    pub(crate) fn open(self: &Rc<Self>, paths: Vec<PathBuf>, load_mode: LoadMode) {
        if paths.is_empty() {
            return;
        }
        self.once_saved(move |loader| loader.open_now(paths, load_mode, None));
    }

    /// Tries once more to open files that could not be; what was to be done with them then is still to be done.
    fn retry(self: &Rc<Self>, paths: Vec<PathBuf>, load_mode: LoadMode) {
        self.once_saved(move |loader| {
            let (attach_after_load, carried) = (loader.attach_after_load.get(), loader.carried.take());
            loader.open_now(paths, load_mode, carried);
            loader.attach_after_load.set(attach_after_load);
        });
    }

    /// Opens the built-in scene.
    pub(crate) fn open_built_in(self: &Rc<Self>) {
        self.once_saved(|loader| {
            loader.app.start_page.want(false);
            loader.forget();
            loader.app.settings.restore_view(&loader.app.session);
            loader.app.session.update(|session| session.show(Document::built_in(), LoadMode::New));
        });
    }

    /// Opens files (none: the built-in scene) and puts muscles that are not saved into them; `then` runs once they are there.
    pub(crate) fn open_with_state(self: &Rc<Self>, paths: Vec<PathBuf>, muscles: Vec<MuscleFile>, then: impl FnOnce() + 'static) {
        self.once_saved(move |loader| {
            let carried = CarriedState { muscles, then: Box::new(then) };
            if paths.is_empty() {
                let app = &loader.app;
                app.reader.stop();
                app.start_page.want(false);
                app.settings.restore_view(&app.session);
                app.open_files.came_from(None);
                app.toasts.hide_notice();
                app.session.update(|session| {
                    session.show(Document::built_in(), LoadMode::New);
                    session.set_carried_files(carried.muscles);
                });
                return (carried.then)();
            }
            loader.open_now(paths, LoadMode::New, Some(carried));
        });
    }

    /// Opens files and hangs the muscles among them that are on an arm of their own on the clip.
    pub(crate) fn open_attached(self: &Rc<Self>, paths: Vec<PathBuf>) {
        self.once_saved(move |loader| {
            loader.open_now(paths, LoadMode::New, None);
            loader.attach_after_load.set(true);
        });
    }

    fn open_now(self: &Rc<Self>, paths: Vec<PathBuf>, load_mode: LoadMode, carried: Option<CarriedState>) {
        self.app.reader.stop();
        self.attach_after_load.set(false);
        self.carried.replace(carried);
        self.replaces.set(load_mode == LoadMode::New);
        let loader = self.clone();
        self.app.reader.read_scene(paths, move |read, paths| match read {
            Ok(opened) => loader.show_loaded(opened, &paths, load_mode),
            Err(error) => {
                loader.failed.set(true);
                open_error::show(&loader.app.error_bar, &loader.app.session, &error, Some((paths, load_mode)));
            }
        });
    }

    fn show_loaded(&self, opened: Opened, paths: &[PathBuf], load_mode: LoadMode) {
        let app = &self.app;
        let Opened { document, session: saved, compared } = opened;
        app.error_bar.hide();
        app.start_page.want(false);
        app.toasts.hide_notice();
        self.failed.set(false);
        let summary =
            (load_mode == LoadMode::Again).then(|| app.session.read(|session| reload_summary::what_changed(session.document(), &document)));
        let warnings = document.diagnostics.len();
        let wanted = saved.as_ref().and_then(|saved| saved.compared.as_ref()?.file.clone()).filter(|_| compared.is_none());
        if load_mode == LoadMode::New {
            app.settings.restore_view(&app.session);
            let session = saved.as_ref().zip(paths.first());
            app.open_files.came_from(session.map(|(saved, file)| (file.clone(), saved.all_files(file.parent().unwrap_or(Path::new(""))))));
        }
        match &saved {
            Some(saved) => app.settings.use_view_of_file(&app.session, |session| {
                session.show_session(document, saved);
                if let (Some((path, other)), Some(shift)) = (compared, &saved.compared) {
                    session.compare(Some(CompareTarget::File(Box::new(other), path.display().to_string())));
                    session.apply_saved_comparison(shift);
                    if saved.camera.is_none() && saved.file_camera.is_none() {
                        session.fit();
                    }
                }
            }),
            None => app.session.update(|session| session.show(document, load_mode)),
        }
        if let Some(carried) = self.carried.take() {
            app.session.update(|session| session.set_carried_files(carried.muscles));
            (carried.then)();
        }
        app.watcher.watch();
        let demos = samples::folder();
        let paths: Vec<&PathBuf> = paths.iter().filter(|path| path.as_os_str() != "-" && !path.starts_with(&demos)).collect();
        if let Some(folder) =
            paths.first().and_then(|path| std::path::absolute(path).ok()).and_then(|path| path.parent().map(Path::to_path_buf))
        {
            app.settings.borrow_mut().folder = Some(folder);
        }
        let attached = self.attach_after_load.take() && saved.is_none() && attach_muscles::attach_all(&app.session, &app.toasts);
        match summary {
            Some(summary) => app.toasts.toast(&summary, None),
            None => {
                paths.iter().for_each(|path| recent::remember(path));
                if let Some(lost) = wanted {
                    app.toasts.toast(&tr!("app-compared-lost", file = lost.display().to_string()), None);
                } else if warnings > 0 && !attached {
                    app.toasts.toast(&tr!("app-diagnostics-found", count = warnings), None);
                }
            }
        }
    }

    /// Reads the open files again, and the one that is compared with.
    pub(crate) fn reload(self: &Rc<Self>) {
        if let Some(path) = self.app.session.read(|session| session.compared_file()) {
            compare_file::read_again(&self.app, &path);
        }
        self.reload_own();
    }

    /// Reads the open files again. Muscles that are not saved stay as they are; where their file has changed too, a person says which of both is to be.
    fn reload_own(self: &Rc<Self>) {
        let (paths, unsaved, both) = self.app.session.read(|session| {
            let unsaved = session.is_unsaved();
            (session.files(), unsaved, unsaved && session.is_changed_outside())
        });
        // What is being opened takes their place: to read them again would only keep it from coming.
        if paths.is_empty() || self.asking.get() || self.app.reader.is_reading_scene() && self.replaces.get() {
            return;
        }
        if !unsaved {
            return self.open_now(paths, LoadMode::Again, None);
        }
        if !both {
            return self.open_now(paths, LoadMode::Again, Some(self.unsaved_muscles()));
        }
        self.asking.set(true);
        let loader = Rc::downgrade(self);
        saving::confirm_conflict(&self.app, move |keep| {
            let Some(loader) = loader.upgrade() else { return };
            loader.asking.set(false);
            match keep {
                Some(true) => loader.open_now(paths, LoadMode::Again, Some(loader.unsaved_muscles())),
                Some(false) => loader.open_now(paths, LoadMode::Again, None),
                None => {}
            }
        });
    }

    /// The muscles as they are, to be put into the files that are read again.
    fn unsaved_muscles(&self) -> CarriedState {
        let muscles = self.app.session.read(|session| session.document().muscle_files().cloned().collect());
        CarriedState { muscles, then: Box::new(|| ()) }
    }

    /// Closes the files; the start page comes up. With nothing open the window closes.
    pub(crate) fn close(self: &Rc<Self>) {
        self.once_saved(|loader| {
            let app = &loader.app;
            if app.session.read(|session| session.is_empty()) && !app.reader.is_loading() {
                app.widget.close();
                return;
            }
            loader.forget();
            app.settings.restore_view(&app.session);
            app.session.update(|session| session.show(Document::default(), LoadMode::New));
        });
    }

    /// Stops reading and watching, and takes the message away.
    fn forget(&self) {
        self.app.reader.forget();
        self.carried.replace(None);
        self.attach_after_load.set(false);
        self.app.watcher.stop();
        self.app.open_files.came_from(None);
        self.app.toasts.hide_notice();
        self.app.error_bar.hide();
    }

    /// Opens the next (or previous) file of the folder, by name.
    pub(crate) fn open_neighbour(self: &Rc<Self>, by: isize) {
        let main =
            self.app.session.read(|session| named_sources::sources(session.document()).first().and_then(|source| source.path.clone()));
        if let Some(next) = main.and_then(|path| file_chooser::neighbour(&path, by)) {
            self.open(vec![next], LoadMode::New);
        }
    }
}
