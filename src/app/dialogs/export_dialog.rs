//! The export dialog: format, size and length; then progress with a button that cancels.

use std::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use gtk::prelude::*;
use gtk::{gio, glib};
use gtk4 as gtk;

use super::export_job::{ExportJob, ExportKind, ExportOptions, MotionSource};
use super::save_as;
use crate::app::format;
use crate::app::handles::app_context::AppContext;
use crate::app::viewport::Viewport;
use crate::app::widgets::ui;
use crate::export::{gltf, video};
use crate::i18n::Sentence;
use crate::progress::Progress;
use crate::tr;

/// How often the bar moves.
const PULSE: Duration = Duration::from_millis(80);

ui::widgets! {
    /// The widgets of the dialog.
    struct ExportWidgets from "export_dialog.ui" {
        root: gtk::Window,
        choices: gtk::Grid,
        kind: gtk::DropDown,
        size_label: gtk::Label,
        size_box: gtk::Box,
        width: gtk::SpinButton,
        height: gtk::SpinButton,
        course_label: gtk::Label,
        course: gtk::DropDown,
        sweep_label: gtk::Label,
        sweep_box: gtk::Box,
        from: gtk::SpinButton,
        to: gtk::SpinButton,
        duration_label: gtk::Label,
        duration: gtk::SpinButton,
        fps_label: gtk::Label,
        fps: gtk::SpinButton,
        helps: gtk::CheckButton,
        transparent: gtk::CheckButton,
        summary: gtk::Label,
        losses_box: gtk::ScrolledWindow,
        losses: gtk::Label,
        bar: gtk::ProgressBar,
        cancel: gtk::Button,
        export: gtk::Button,
    }
}

/// The dialog while it is open.
struct Dialog {
    widgets: ExportWidgets,
    app: Rc<AppContext>,
    viewport: Rc<Viewport>,
    work: RefCell<Option<Arc<Progress>>>,
    /// What glTF cannot hold of the document, once that is known.
    losses: RefCell<Option<Vec<String>>>,
    /// Whether it is being computed.
    looking: Cell<bool>,
    /// Whether there is no `ffmpeg`, which videos are made by.
    no_ffmpeg: Cell<bool>,
}

/// Opens the dialog.
pub(crate) fn show(app: &Rc<AppContext>, viewport: &Rc<Viewport>) {
    let dialog = Rc::new(Dialog {
        widgets: ExportWidgets::build(),
        app: app.clone(),
        viewport: viewport.clone(),
        work: RefCell::new(None),
        losses: RefCell::new(None),
        looking: Cell::new(false),
        no_ffmpeg: Cell::new(false),
    });
    let root = &dialog.widgets.root;
    root.set_transient_for(Some(&app.widget));
    dialog.widgets.kind.set_model(Some(&ui::words(&ExportKind::ALL.map(ExportKind::label))));
    dialog.widgets.course.set_model(Some(&ui::words(&MotionSource::ALL.map(MotionSource::label))));
    let scale = viewport.scale().max(1);
    let (width, height) = viewport.size();
    dialog.widgets.width.set_value(f64::from((width * scale).max(16)));
    dialog.widgets.height.set_value(f64::from((height * scale).max(16)));
    dialog.connect();
    dialog.show_choice();
    let asking = dialog.clone();
    glib::spawn_future_local(async move {
        if let Ok(false) = gio::spawn_blocking(video::ffmpeg_available).await {
            asking.no_ffmpeg.set(true);
            asking.show_choice();
        }
    });
    root.present();
}

impl Dialog {
    fn connect(self: &Rc<Self>) {
        let root = &self.widgets.root;
        for list in [&self.widgets.kind, &self.widgets.course] {
            let dialog = self.clone();
            list.connect_selected_notify(move |list| {
                if list.widget_name() == "course" {
                    dialog.usual_sweep();
                }
                dialog.show_choice();
            });
        }
        let widgets = &self.widgets;
        for number in [&widgets.width, &widgets.height, &widgets.from, &widgets.to, &widgets.fps, &widgets.duration] {
            let dialog = self.clone();
            number.connect_value_changed(move |_| dialog.show_choice());
        }
        let dialog = self.clone();
        self.widgets.cancel.connect_clicked(move |_| dialog.widgets.root.close());
        let dialog = self.clone();
        self.widgets.export.connect_clicked(move |_| dialog.ask_where());
        // A running export is stopped first; the dialog stays to say so.
        let dialog = self.clone();
        root.connect_close_request(move |_| {
            if let Some(work) = &*dialog.work.borrow() {
                work.cancel();
                return glib::Propagation::Stop;
            }
            glib::Propagation::Proceed
        });
        let keys = gtk::EventControllerKey::new();
        let weak = root.downgrade();
        keys.connect_key_pressed(move |_, key, _, _| match weak.upgrade() {
            Some(root) if key == gtk::gdk::Key::Escape => {
                root.close();
                glib::Propagation::Stop
            }
            _ => glib::Propagation::Proceed,
        });
        root.add_controller(keys);
    }

    fn options(&self) -> ExportOptions {
        let chosen = |list: &gtk::DropDown| list.selected() as usize;
        let (width, height) = (self.widgets.width.value().max(1.0), self.widgets.height.value().max(1.0));
        let on_screen = f64::from(self.viewport.size().0.max(1));
        ExportOptions {
            kind: ExportKind::ALL.get(chosen(&self.widgets.kind)).copied().unwrap_or(ExportKind::Picture),
            motion: MotionSource::ALL.get(chosen(&self.widgets.course)).copied().unwrap_or(MotionSource::Whole),
            sweep: (self.widgets.from.value(), self.widgets.to.value()),
            size: (width as u32, height as u32),
            scale: (width / on_screen).clamp(0.25, 16.0) as f32,
            fps: self.widgets.fps.value(),
            duration: self.widgets.duration.value(),
            transparent: self.widgets.transparent.is_active(),
            helps: self.widgets.helps.is_active(),
        }
    }

    fn usual_sweep(&self) {
        let end = if self.options().motion == MotionSource::Contraction { 100.0 } else { 130.0 };
        self.widgets.from.set_value(0.0);
        self.widgets.to.set_value(end);
    }

    /// Shows the rows that the choice needs, and what will come of it.
    fn show_choice(self: &Rc<Self>) {
        let options = self.options();
        let (drawn, is_sequence) = (options.kind.is_drawn(), options.kind.is_sequence());
        let over_time = options.kind.table().is_some() && self.app.session.read(|session| session.state().clip.is_some());
        let widgets = &self.widgets;
        let show = |parts: &[&gtk::Widget], shown: bool| parts.iter().for_each(|part| part.set_visible(shown));
        show(&[widgets.size_label.upcast_ref(), widgets.size_box.upcast_ref()], drawn);
        show(&[widgets.transparent.upcast_ref(), widgets.helps.upcast_ref()], drawn);
        show(&[widgets.course_label.upcast_ref(), widgets.course.upcast_ref()], is_sequence);
        show(&[widgets.fps_label.upcast_ref(), widgets.fps.upcast_ref()], is_sequence || over_time);
        show(&[widgets.sweep_label.upcast_ref(), widgets.sweep_box.upcast_ref()], is_sequence && options.motion.is_sweep());
        show(&[widgets.duration_label.upcast_ref(), widgets.duration.upcast_ref()], is_sequence && options.motion.has_duration());
        let summary = self.app.session.read(|session| options.check(session)).map(|sequence| match options.kind {
            _ if is_sequence => tr!(
                "app-export-frames",
                count = sequence.count,
                width = options.size.0.to_string(),
                height = options.size.1.to_string(),
                seconds = format::number(sequence.seconds(), 2)
            ),
            _ if drawn => tr!("app-export-one", width = options.size.0.to_string(), height = options.size.1.to_string()),
            kind if kind.is_scene() => tr!("app-export-scene"),
            ExportKind::Joints(_) => tr!("app-export-joints"),
            ExportKind::Muscles(_) => {
                if over_time {
                    tr!("app-export-muscles-clip")
                } else {
                    tr!("app-export-muscles")
                }
            }
            _ => tr!("app-export-surface"),
        });
        let summary = match summary {
            Ok(_) if options.kind.is_made_by_ffmpeg() && self.no_ffmpeg.get() => Err(tr!("export-no-ffmpeg")),
            Ok(summary) => Ok(summary),
            Err(cannot) => Err(cannot.to_string()),
        };
        self.widgets.export.set_sensitive(summary.is_ok());
        self.say(&summary.unwrap_or_else(|trouble| trouble));
        self.show_losses(options.kind);
    }

    /// Lists what glTF cannot express of the document. Computed off the interface thread, when it is first requested.
    fn show_losses(self: &Rc<Self>, kind: ExportKind) {
        let scroller = &self.widgets.losses_box;
        scroller.set_visible(false);
        if !kind.is_scene() {
            return;
        }
        if let Some(losses) = &*self.losses.borrow() {
            scroller.set_visible(!losses.is_empty());
            let lines: Vec<&str> = losses.iter().map(String::as_str).collect();
            ui::set_label(&self.widgets.losses, &format!("{}\n{}", tr!("app-export-losses"), lines.join("\n")));
            return;
        }
        if self.looking.replace(true) {
            return;
        }
        let document = self.app.session.read(|session| session.document().clone());
        let dialog = self.clone();
        glib::spawn_future_local(async move {
            let found = gio::spawn_blocking(move || {
                gltf::unsupported_features(&document).iter().map(|loss| format!("• {}", loss.sentence())).collect::<Vec<_>>()
            })
            .await;
            if let Ok(found) = found {
                dialog.losses.replace(Some(found));
                dialog.show_losses(dialog.options().kind);
            }
        });
    }

    fn say(&self, text: &str) {
        ui::set_label(&self.widgets.summary, text);
    }

    fn ask_where(self: &Rc<Self>) {
        let options = self.options();
        let (app, kind) = (&self.app, options.kind);
        let folder = save_as::usual_folder(app);
        let name = save_as::name_like_open(app, kind.ending());
        let there = folder.clone().unwrap_or_default();
        let name = app.open_files.guard(&app.session).free_name(&there, &name, |file| kind.first_files(&kind.completed(file)));
        let name = save_as::name_of(&kind.completed(Path::new(&name)));
        let (asked, dialog) = (save_as::FileDialogOptions { title: tr!("app-export-title"), name, folder }, self.clone());
        save_as::choose(&self.widgets.root, asked, move |file| kind.completed(file), move |path| dialog.prepare(options, path));
    }

    /// Completes the name, refuses files that are open, and asks about those that are there and that the chooser did not ask about.
    fn prepare(self: &Rc<Self>, options: ExportOptions, chosen: PathBuf) {
        let file = options.kind.completed(&chosen);
        let guard = self.app.open_files.guard(&self.app.session);
        let job = match self.app.session.read(|session| ExportJob::new(session, options, guard.clone())) {
            Ok(job) => job,
            Err(cannot) => return self.say(&cannot.to_string()),
        };
        let written = job.files(&file);
        if let Some(error) = written.iter().find_map(|file| guard.output(file).err()) {
            return self.say(&error.sentence());
        }
        let unasked = written.into_iter().filter(|file| *file != chosen).collect();
        let dialog = self.clone();
        save_as::ask_to_replace(&self.widgets.root, unasked, move || dialog.start(job, options.kind, file));
    }

    /// Runs the export beside the interface.
    fn start(self: &Rc<Self>, job: ExportJob, kind: ExportKind, file: PathBuf) {
        let (count, work) = (job.count(), Arc::new(Progress::default()));
        self.work.replace(Some(work.clone()));
        self.show_running(true);
        self.watch(count, &work);
        let dialog = self.clone();
        glib::spawn_future_local(async move {
            let (target, hand) = (file.clone(), work.clone());
            let result = gio::spawn_blocking(move || job.run(&target, &hand)).await;
            dialog.work.replace(None);
            dialog.show_running(false);
            match result {
                Ok(Ok(())) => {
                    let file = kind.first_files(&file).into_iter().next().unwrap_or(file);
                    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
                    dialog.app.toasts.toast(&tr!("app-saved", file = name), Some(file));
                    dialog.widgets.root.close();
                }
                Ok(Err(error)) if error.is_cancelled() => dialog.say(&tr!("export-cancelled")),
                Ok(Err(error)) => dialog.say(&error.sentence()),
                Err(_) => dialog.say(&tr!("app-export-broke")),
            }
        });
    }

    fn show_running(&self, running: bool) {
        ui::set_sensitive(&self.widgets.choices, !running);
        self.widgets.export.set_sensitive(!running);
        self.widgets.bar.set_visible(running);
        self.widgets.bar.set_fraction(0.0);
    }

    fn watch(self: &Rc<Self>, count: usize, work: &Arc<Progress>) {
        let (dialog, work) = (self.clone(), work.clone());
        glib::timeout_add_local(PULSE, move || {
            if dialog.work.borrow().is_none() {
                return glib::ControlFlow::Break;
            }
            let bar = &dialog.widgets.bar;
            let done = work.steps();
            if count > 1 {
                bar.set_fraction(done as f64 / count as f64);
                dialog.say(&tr!("cli-progress", done = done, count = count));
            } else {
                bar.pulse();
            }
            glib::ControlFlow::Continue
        });
    }
}
