//! The measure panel: length, moment arm and thickness against the elbow angle or the time of the clip; a click on a plot goes there.

use std::cell::{Cell, RefCell};
use std::io::Write as _;
use std::path::Path;
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::panel::Panel;
use crate::app::dialogs::measurement_comparison;
use crate::app::dialogs::save_as::{self, SaveRequest};
use crate::app::handles::app_context::AppContext;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::panels::muscle::muscle_panel::Unit;
use crate::app::widgets::drawing_area::PaintWidget;
use crate::app::widgets::plot_view;
use crate::app::widgets::ui;
use crate::export::file_extension::extension;
use crate::i18n::{self, Sentence};
use crate::muscle::{MuscleSample, literature_data};
use crate::output::write_atomic;
use crate::plot::{Page, Plot, PlotCurve, Series};
use crate::render::Theme;
use crate::scene::{Content, MuscleId};
use crate::session::{ChangeSet, MeasureAxis, Session, csv};
use crate::tr;

/// A quantity: the key of its name, how it is read, and the least that its axis spans.
type Quantity = (&'static str, fn(&MuscleSample) -> f64, f64);

const QUANTITIES: [Quantity; 5] = [
    ("app-measure-length", |reading| reading.solved.length, 0.0),
    ("app-measure-arm", |reading| reading.moment_arm.unwrap_or(f64::NAN), 0.0),
    ("app-measure-radius", |sample| sample.solved.largest_radius(), 0.0),
    ("app-measure-section", |reading| std::f64::consts::PI * reading.solved.largest_radius().powi(2), 0.0),
    // Rounding alone would look like a mountain range.
    ("app-measure-error", |reading| reading.solved.volume_error, 2e-12),
];
/// The quantity that there are published figures of.
const PUBLISHED: usize = 1;
/// What can go right, in the order of the list.
const AXES: [MeasureAxis; 2] = [MeasureAxis::Angle, MeasureAxis::Time];
/// Colour of a saved curve: dark enough for white paper.
const ON_PAPER: u32 = 0xB8_322E;
/// Pixels of a saved picture to a logical pixel.
const PICTURE_SCALE: f64 = 2.0;
/// Colours of moment arms about the joints that are not turned, in turn: on light, and on dark.
const OTHER_JOINTS: [[u32; 4]; 2] = [[0x00_72B2, 0x00_795A, 0x8E_4585, 0x8A_5A00], [0x56_B4E9, 0x3C_CFA0, 0xD9_A0CF, 0xE0_A84A]];

ui::widgets! {
    /// The widgets of the panel.
    struct MeasureWidgets from "measure_panel.ui" {
        root: gtk::ScrolledWindow,
        none: gtk::Label,
        plots: gtk::Box,
        name: gtk::Label,
        axes: gtk::Box,
        axis: gtk::DropDown,
        joints: gtk::Box,
        joint: gtk::DropDown,
        hint: gtk::Label,
        slot: gtk::Box,
        published: gtk::CheckButton,
        sources: gtk::Label,
        copy: gtk::Button,
        save: gtk::Button,
        measurement_comparison: gtk::Button,
    }
}

/// The panel.
pub(crate) struct MeasurePanel {
    /// The whole.
    widgets: MeasureWidgets,
    plots: [(PaintWidget, Rc<RefCell<Plot>>); 5],
    readings: RefCell<Vec<MuscleSample>>,
    muscle: Cell<MuscleId>,
    joint_names: gtk::StringList,
    stale: Cell<bool>,
}

impl MeasurePanel {
    /// The panel of a session.
    pub(crate) fn new(app: &Rc<AppContext>) -> Rc<Self> {
        let widgets = MeasureWidgets::build();
        let plots = std::array::from_fn(|_| {
            let (canvas, plot) = (PaintWidget::new(200, 170), Rc::new(RefCell::new(Plot::default())));
            let painted = plot.clone();
            canvas.set_painter(move |canvas, snapshot, width, height| plot_view::paint(&painted.borrow(), canvas, snapshot, width, height));
            widgets.slot.append(&canvas);
            (canvas, plot)
        });
        let joint_names = ui::words::<&str>(&[]);
        widgets.joint.set_model(Some(&joint_names));
        let (readings, muscle, stale) = (RefCell::default(), Cell::new(MuscleId(0)), Cell::new(true));
        let panel = Rc::new(Self { widgets, plots, readings, muscle, joint_names, stale });
        panel.connect(app);
        panel
    }

    fn connect(self: &Rc<Self>, app: &Rc<AppContext>) {
        let session = &app.session;
        for (canvas, plot) in &self.plots {
            let set = glib::clone!(
                #[weak]
                session,
                #[weak(rename_to = panel)]
                self,
                #[weak]
                canvas,
                #[strong]
                plot,
                move |x: f64| {
                    let place = plot.borrow().x_at(x, f64::from(canvas.width()));
                    let Some(place) = place else { return };
                    match panel.against() {
                        MeasureAxis::Angle => {
                            let (muscle, joint) = (panel.muscle.get(), panel.joint());
                            session.update(|session| session.bend_measured_undoable(muscle, joint, place));
                        }
                        MeasureAxis::Time => session.update(|session| session.time(|playback| playback.seek(place))),
                    }
                }
            );
            let drag = gtk::GestureDrag::new();
            let begin = set.clone();
            drag.connect_drag_begin(move |_, x, _| begin(x));
            drag.connect_drag_update(move |gesture, dx, _| {
                if let Some((x, _)) = gesture.start_point() {
                    set(x + dx);
                }
            });
            canvas.add_controller(drag);
            let motion = gtk::EventControllerMotion::new();
            let point = {
                let (plot, canvas) = (plot.clone(), canvas.downgrade());
                move |x: Option<f64>| {
                    plot.borrow_mut().pointer = x;
                    if let Some(canvas) = canvas.upgrade() {
                        canvas.queue_draw();
                    }
                }
            };
            let leave = point.clone();
            motion.connect_motion(move |_, x, _| point(Some(x)));
            motion.connect_leave(move |_| leave(None));
            canvas.add_controller(motion);
        }
        self.widgets.copy.connect_clicked(glib::clone!(
            #[weak]
            app,
            #[weak(rename_to = panel)]
            self,
            move |button| {
                button.clipboard().set_text(&panel.table(&app.session));
                app.toasts.toast(&tr!("app-copied"), None);
            }
        ));
        self.widgets.save.connect_clicked(glib::clone!(
            #[weak]
            app,
            #[weak(rename_to = panel)]
            self,
            move |_| panel.save(&app)
        ));
        self.widgets.published.connect_toggled(glib::clone!(
            #[weak]
            session,
            move |_| session.update(Session::show_selected_muscle)
        ));
        self.widgets.axis.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            move |_| session.update(Session::show_selected_muscle)
        ));
        self.widgets.joint.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            #[weak(rename_to = panel)]
            self,
            move |_| {
                panel.stale.set(true);
                session.update(Session::show_selected_muscle);
            }
        ));
        self.widgets.measurement_comparison.connect_clicked(glib::clone!(
            #[weak]
            app,
            #[weak(rename_to = panel)]
            self,
            move |_| {
                let muscle = panel.muscle.get();
                if let Some(muscle) = app.session.read(|session| session.muscle_on_joint(muscle)) {
                    measurement_comparison::show(&app, muscle);
                }
            }
        ));
        self.widgets.sources.set_text(&format!("{}\n{}", literature_data::MURRAY_2000.source, literature_data::ARM26_BICEPS.source));
        // Measuring waits until the panel is visible.
        self.widgets.root.connect_map(glib::clone!(
            #[weak]
            session,
            move |_| session.update(Session::show_selected_muscle)
        ));
    }

    /// What goes right.
    fn against(&self) -> MeasureAxis {
        AXES.get(self.widgets.axis.selected() as usize).copied().unwrap_or_default()
    }

    /// The joint that is turned, by its number among those of the muscle's file.
    fn joint(&self) -> usize {
        let chosen = self.widgets.joint.selected();
        if chosen == gtk::INVALID_LIST_POSITION { 0 } else { chosen as usize }
    }

    /// The table of what is measured.
    fn table(&self, session: &SessionHandle) -> String {
        let joints = session.read(|session| session.measured_joints(self.muscle.get()));
        csv(&self.readings.borrow(), &joints)
    }

    /// Lists the joints of the muscle's file.
    fn list_joints(&self, session: &Session) -> Vec<String> {
        let joints = session.measured_joints(self.muscle.get());
        let names: Vec<String> = joints.iter().map(|joint| i18n::shown(&i18n::label(joint.as_label())).into_owned()).collect();
        let shown = |row: usize| self.joint_names.string(row as u32);
        let same = self.joint_names.n_items() as usize == names.len()
            && names.iter().enumerate().all(|(row, name)| shown(row).as_deref() == Some(name.as_str()));
        if !same {
            self.joint_names.splice(0, self.joint_names.n_items(), &names.iter().map(String::as_str).collect::<Vec<_>>());
            self.widgets.joint.set_selected(0);
        }
        self.widgets.joints.set_visible(names.len() > 1 && self.against() == MeasureAxis::Angle);
        names
    }

    /// Offers the axes that there are, and takes the other one where the chosen one is not there.
    fn offer(&self, session: &Session) -> bool {
        let there = AXES.map(|against| session.measurable(self.muscle.get(), against, self.joint()).is_some());
        let chosen = self.widgets.axis.selected() as usize;
        if !there.get(chosen).copied().unwrap_or(false)
            && let Some(other) = there.iter().position(|there| *there)
        {
            self.widgets.axis.set_selected(other as u32);
        }
        self.widgets.axes.set_visible(there == [true; 2]);
        there.contains(&true)
    }

    fn measure(&self, session: &Session) {
        let joints = self.list_joints(session);
        let found = self.offer(session);
        let against = self.against();
        let document = session.document();
        self.widgets.measurement_comparison.set_visible(session.muscle_on_joint(self.muscle.get()).is_some());
        let muscle = document.muscle(self.muscle.get()).filter(|_| found);
        self.widgets.none.set_visible(muscle.is_none());
        self.widgets.plots.set_visible(muscle.is_some());
        let Some((rig, index)) = muscle else { return };
        let readings = session.measure(self.muscle.get(), against, self.joint());
        ui::set_label(&self.widgets.name, &i18n::label(rig.label(index)));
        let several = joints.get(self.joint()).filter(|_| joints.len() > 1);
        let (across, hint) = match (against, several) {
            (MeasureAxis::Angle, Some(joint)) => {
                (tr!("app-measure-angle-of", joint = joint.as_str()), tr!("app-measure-hint-joint", joint = joint.as_str()))
            }
            (MeasureAxis::Angle, None) => (tr!("app-measure-angle"), tr!("app-measure-hint")),
            (MeasureAxis::Time, _) => (tr!("app-measure-time"), tr!("app-measure-hint-time")),
        };
        self.widgets.hint.set_text(&hint);
        let unit = Unit::of_rig(document, rig);
        for ((canvas, plot), (key, read, least_span)) in self.plots.iter().zip(QUANTITIES) {
            let mut plot = plot.borrow_mut();
            plot.x_label.clone_from(&across);
            plot.y_label = tr!(key, unit = unit.length.as_str());
            plot.reference_series.clear();
            plot.more_curves.clear();
            plot.name.clear();
            plot.min_y_span = least_span;
            plot.points = readings.iter().map(|reading| (against.of(reading), read(reading))).collect();
            // There is no moment arm where there is no joint.
            canvas.set_visible(plot.points.iter().any(|point| point.1.is_finite()));
        }
        // The moment arms about the other joints stand beside that about the one that is turned.
        let own = if against == MeasureAxis::Angle { self.joint() } else { 0 };
        if let Some((_, plot)) = self.plots.get(PUBLISHED).filter(|_| joints.len() > 1) {
            let others = joints.iter().enumerate().filter(|(number, _)| *number != own);
            let others = others.map(|(number, name)| {
                let arm = |reading: &MuscleSample| Some((against.of(reading), *reading.moment_arms.get(number)?));
                PlotCurve { name: name.clone(), points: readings.iter().filter_map(arm).collect(), ..PlotCurve::default() }
            });
            let mut plot = plot.borrow_mut();
            plot.name = joints.get(own).cloned().unwrap_or_default();
            plot.more_curves = others.collect();
            color_others(&mut plot, session.theme() == Theme::Dark);
        }
        // The published figures are of muscles that flex the elbow and of one that extends it.
        let flexes = readings.iter().filter_map(|reading| reading.moment_arm).sum::<f64>();
        let comparable = against == MeasureAxis::Angle && joints.len() < 2 && flexes != 0.0;
        self.widgets.published.set_visible(comparable);
        self.widgets.sources.set_visible(comparable);
        if comparable
            && self.widgets.published.is_active()
            && let Some((_, plot)) = self.plots.get(PUBLISHED)
        {
            // Centimetres to the file's unit.
            let scale = 0.01 / unit.metres;
            let flexors = [literature_data::ARM26_BICEPS, literature_data::ARM26_BRACHIALIS, literature_data::MURRAY_2000];
            let published = if flexes > 0.0 { flexors.as_slice() } else { &[literature_data::ARM26_TRICEPS] };
            let series = published.iter().map(|series| Series {
                name: series.name.to_owned(),
                points: series.points.iter().map(|[angle, arm]| (*angle, arm * scale)).collect(),
            });
            plot.borrow_mut().reference_series = series.collect();
        }
        self.readings.replace(readings);
    }

    /// Asks where to and saves the table or the plots.
    fn save(self: &Rc<Self>, app: &Rc<AppContext>) {
        let (title, name) = (tr!("app-measure-save-title"), "measure.csv".to_owned());
        let request = SaveRequest { title, name, folder: None, endings: &["csv", "svg", "png"], own: None };
        let panel = Rc::downgrade(self);
        save_as::ask(app, request, move |app, output| {
            let (path, Some(panel)) = (output.file(), panel.upgrade()) else { return };
            let written = panel
                .bytes(path, &app.session)
                .and_then(|bytes| write_atomic(output, |out| out.write_all(&bytes)).map_err(|error| error.sentence()));
            match written {
                Ok(()) => save_as::done(app, path),
                Err(message) => save_as::failed(app, path, message),
            }
        });
    }

    /// The plots as a page to keep, without the pointer.
    fn page(&self) -> Page {
        let name = self.widgets.name.text().to_string();
        let shown = self.plots.iter().filter(|(canvas, _)| canvas.get_visible());
        let plots = shown.map(|(_, plot)| {
            let mut plot = Plot { pointer: None, color: ON_PAPER, reference_color: 0x5B_6B82, ..plot.borrow().clone() };
            color_others(&mut plot, false);
            plot
        });
        Page { sections: vec![(name, plots.collect())] }
    }

    /// The file that a name's ending asks for: the table, or the plots.
    fn bytes(&self, path: &Path, session: &SessionHandle) -> Result<Vec<u8>, String> {
        match extension(path).as_str() {
            "svg" => Ok(self.page().svg().into_bytes()),
            "png" => self.page().png(PICTURE_SCALE).map_err(|error| error.sentence()),
            _ => Ok(self.table(session).into_bytes()),
        }
    }
}

impl Panel for MeasurePanel {
    fn id(&self) -> &'static str {
        "measure"
    }

    fn title(&self) -> String {
        tr!("app-page-measure")
    }

    fn widget(&self) -> gtk::Widget {
        self.widgets.root.clone().upcast()
    }

    fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        if changes.any(ChangeSet::DOCUMENT) {
            self.muscle.set(MuscleId(0));
            self.stale.set(true);
        }
        if changes.any(ChangeSet::SELECTION)
            && let Some(node) = session.selected()
        {
            let contents = &session.document().scene.graph.node(node).contents;
            let chosen = contents.iter().find_map(|content| if let Content::Muscle(id) = content { Some(*id) } else { None });
            if let Some(muscle) = chosen.filter(|muscle| *muscle != self.muscle.get()) {
                self.muscle.set(muscle);
                self.stale.set(true);
            }
        }
        if changes.any(ChangeSet::EDIT | ChangeSet::MUSCLE) || (changes.any(ChangeSet::PLAYBACK) && self.against() == MeasureAxis::Time) {
            self.stale.set(true);
        }
        if !self.widgets.root.is_mapped() {
            return;
        }
        if self.stale.replace(false) {
            self.measure(session);
        }
        if changes.any(ChangeSet::DRIVE | ChangeSet::TIME | ChangeSet::DOCUMENT | ChangeSet::MUSCLE | ChangeSet::DISPLAY | ChangeSet::EDIT)
        {
            let present = session.current_value(self.muscle.get(), self.against(), self.joint());
            for (canvas, plot) in &self.plots {
                let mut plot = plot.borrow_mut();
                (plot.cursor, plot.color) = (present, session.display().palette.selected);
                let is_dark = session.theme() == Theme::Dark;
                plot.reference_color = if is_dark { 0x8FA3BF } else { 0x5B6B82 };
                color_others(&mut plot, is_dark);
                canvas.queue_draw();
            }
        }
    }
}

/// Gives the curves beside the first one their colours.
fn color_others(plot: &mut Plot, is_dark: bool) {
    let colors = OTHER_JOINTS[usize::from(is_dark)].into_iter().cycle();
    plot.more_curves.iter_mut().zip(colors).for_each(|(curve, color)| curve.color = color);
}
