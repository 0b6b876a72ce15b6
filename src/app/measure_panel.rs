//! The measure panel: length, moment arm and thickness against the elbow angle; a click on a plot sets the angle.

use std::cell::{Cell, RefCell};
use std::fmt::Write as _;
use std::io::Write as _;
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::canvas::Canvas;
use super::error_bar::Trouble;
use super::muscle_panel::Unit;
use super::plot_view;
use super::session::{Changes, Session};
use super::ui;
use super::window::{Window, part};
use crate::export::atomic::write_whole;
use crate::muscle::{Sample, published};
use crate::plot::{Plot, Series};
use crate::render::Theme;
use crate::scene::{Content, MuscleId};
use crate::tr;

/// Samples of a curve.
const SAMPLES: u32 = 90;

/// A quantity: the key of its name, and how it is read from a sample.
type Quantity = (&'static str, fn(&Sample) -> f64);

const QUANTITIES: [Quantity; 5] = [
    ("app-measure-length", |sample| sample.solved.length),
    ("app-measure-arm", |sample| sample.moment_arm),
    ("app-measure-radius", |sample| sample.solved.radii.iter().copied().fold(0.0, f64::max)),
    ("app-measure-section", |sample| std::f64::consts::PI * sample.solved.radii.iter().copied().fold(0.0, f64::max).powi(2)),
    ("app-measure-error", |sample| sample.solved.volume_error),
];
/// The quantity that there are published figures of.
const PUBLISHED: usize = 1;

/// The panel.
pub struct MeasurePanel {
    /// The whole.
    pub root: gtk::ScrolledWindow,
    builder: gtk::Builder,
    plots: [(Canvas, Rc<RefCell<Plot>>); 5],
    samples: RefCell<Vec<Sample>>,
    muscle: Cell<MuscleId>,
    stale: Cell<bool>,
}

impl MeasurePanel {
    /// A panel of no muscle.
    pub fn new() -> Self {
        let builder = ui::builder(ui::MEASURE_PANEL);
        let slot: gtk::Box = part(&builder, "slot");
        let plots = std::array::from_fn(|_| {
            let (canvas, plot) = (Canvas::new(200, 170), Rc::new(RefCell::new(Plot::default())));
            let painted = plot.clone();
            canvas.set_painter(move |canvas, snapshot, width, height| plot_view::paint(&painted.borrow(), canvas, snapshot, width, height));
            slot.append(&canvas);
            (canvas, plot)
        });
        Self {
            root: part(&builder, "root"),
            builder,
            plots,
            samples: RefCell::default(),
            muscle: Cell::new(MuscleId(0)),
            stale: Cell::new(true),
        }
    }

    /// Lets the plots set the angle.
    pub fn connect(&self, window: &Rc<Window>) {
        for (canvas, plot) in &self.plots {
            let set = {
                let (weak, plot, canvas) = (Rc::downgrade(window), plot.clone(), canvas.downgrade());
                move |x: f64| {
                    let Some((window, canvas)) = weak.upgrade().zip(canvas.upgrade()) else { return };
                    let angle = plot.borrow().x_at(x, f64::from(canvas.width()));
                    if let Some(angle) = angle {
                        window.act(|session| session.set_flexion(angle));
                    }
                }
            };
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
        part::<gtk::Button>(&self.builder, "copy").connect_clicked(glib::clone!(
            #[weak]
            window,
            move |button| {
                button.clipboard().set_text(&csv(&window.measured()));
                window.viewport.toast(&tr!("app-copied"), None);
            }
        ));
        part::<gtk::Button>(&self.builder, "save").connect_clicked(glib::clone!(
            #[weak]
            window,
            move |_| save(&window)
        ));
        part::<gtk::CheckButton>(&self.builder, "published").connect_toggled(glib::clone!(
            #[weak]
            window,
            move |_| window.act(Session::show_other_muscle)
        ));
        part::<gtk::Label>(&self.builder, "sources").set_text(&format!("{}\n{}", published::MURRAY_2000.source, published::ARM26.source));
        // Measuring waits until somebody looks.
        self.root.connect_map(glib::clone!(
            #[weak]
            window,
            move |_| window.act(Session::show_other_muscle)
        ));
    }

    /// Shows what changed.
    pub fn refresh(&self, session: &Session, changes: Changes) {
        if changes.any(Changes::DOCUMENT) {
            self.muscle.set(MuscleId(0));
            self.stale.set(true);
        }
        if changes.any(Changes::SELECTION)
            && let Some(node) = session.selected()
        {
            let contents = &session.document().scene.graph.node(node).contents;
            let chosen = contents.iter().find_map(|content| if let Content::Muscle(id) = content { Some(*id) } else { None });
            if let Some(muscle) = chosen.filter(|muscle| *muscle != self.muscle.get()) {
                self.muscle.set(muscle);
                self.stale.set(true);
            }
        }
        if changes.any(Changes::EDIT | Changes::MUSCLE) {
            self.stale.set(true);
        }
        if !self.root.is_mapped() {
            return;
        }
        if self.stale.replace(false) {
            self.measure(session);
        }
        if changes.any(Changes::DRIVE | Changes::DOCUMENT | Changes::MUSCLE | Changes::DISPLAY | Changes::EDIT) {
            for (canvas, plot) in &self.plots {
                let mut plot = plot.borrow_mut();
                (plot.cursor, plot.color) = (Some(session.drive().flexion), session.display().palette.selected);
                plot.published_color = if session.theme() == Theme::Dark { 0x8FA3BF } else { 0x5B6B82 };
                canvas.queue_draw();
            }
        }
    }

    fn measure(&self, session: &Session) {
        let document = session.document();
        let found = document.muscle(self.muscle.get()).and_then(|(rig, index)| Some((rig, index, rig.flexion_range()?)));
        part::<gtk::Label>(&self.builder, "none").set_visible(found.is_none());
        part::<gtk::Box>(&self.builder, "plots").set_visible(found.is_some());
        let Some((rig, index, range)) = found else { return };
        let step = (range.end() - range.start()) / f64::from(SAMPLES);
        let angles: Vec<f64> = (0..=SAMPLES).map(|index| range.start() + f64::from(index) * step).collect();
        let samples = rig.measure(index, &angles);
        part::<gtk::Label>(&self.builder, "name").set_text(rig.name(index));
        let unit = Unit::of_rig(document, rig);
        for ((_, plot), (key, read)) in self.plots.iter().zip(QUANTITIES) {
            let mut plot = plot.borrow_mut();
            plot.across = tr!("app-measure-angle");
            plot.up = tr!(key, unit = unit.length.as_str());
            plot.published.clear();
            plot.points = samples.iter().map(|sample| (sample.angle, read(sample))).collect();
        }
        if part::<gtk::CheckButton>(&self.builder, "published").is_active()
            && let Some((_, plot)) = self.plots.get(PUBLISHED)
        {
            // Centimetres to the file's unit.
            let scale = 0.01 / unit.metres;
            plot.borrow_mut().published = [published::ARM26, published::MURRAY_2000]
                .map(|series| Series {
                    name: series.name.to_owned(),
                    points: series.points.iter().map(|[angle, arm]| (*angle, arm * scale)).collect(),
                })
                .to_vec();
        }
        self.samples.replace(samples);
    }

    /// What was measured last.
    pub fn samples(&self) -> Vec<Sample> {
        self.samples.borrow().clone()
    }
}

/// Asks where to and saves the table.
fn save(window: &Rc<Window>) {
    let text = csv(&window.measured());
    let dialog = gtk::FileChooserNative::new(
        Some(&tr!("app-measure-save")),
        Some(&window.widget),
        gtk::FileChooserAction::Save,
        Some(&tr!("app-save")),
        Some(&tr!("app-cancel")),
    );
    dialog.set_current_name("measure.csv");
    let keep = RefCell::new(Some(dialog.clone()));
    dialog.connect_response(glib::clone!(
        #[weak]
        window,
        move |dialog, response| {
            keep.take();
            let Some(path) = dialog.file().and_then(|file| file.path()).filter(|_| response == gtk::ResponseType::Accept) else { return };
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            match write_whole(&path, |out| out.write_all(text.as_bytes())) {
                Ok(()) => window.viewport.toast(&tr!("app-saved", file = name), Some(path)),
                Err(error) => window.error_bar.show(Trouble {
                    headline: tr!("app-unsaved", file = name),
                    message: error.to_string(),
                    details: path.display().to_string(),
                    again: None,
                }),
            }
        }
    ));
    dialog.show();
}

/// One row an angle, with decimal points; lengths in the file's unit.
fn csv(samples: &[Sample]) -> String {
    let nodes = samples.first().map_or(0, |sample| sample.solved.radii.len());
    let mut text = String::from("angle,length,moment_arm,volume,volume_error,delta");
    for node in 1..=nodes {
        // Writing to a string cannot fail.
        let _ = write!(text, ",r{node}");
    }
    for sample in samples {
        let solved = &sample.solved;
        let _ = write!(
            text,
            "\n{},{},{},{},{},{}",
            sample.angle, solved.length, sample.moment_arm, solved.volume, solved.volume_error, solved.delta
        );
        for radius in &solved.radii {
            let _ = write!(text, ",{radius}");
        }
    }
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::muscle::Solved;

    #[test]
    fn the_table_has_a_column_a_radius() {
        let solved = Solved { length: 2.5, radii: vec![1.0, 2.0], ..Solved::default() };
        let text = csv(&[Sample { angle: 30.0, moment_arm: 0.5, solved }]);
        assert_eq!(text, "angle,length,moment_arm,volume,volume_error,delta,r1,r2\n30,2.5,0.5,0,0,0,1,2\n");
    }
}
