//! The muscle panel: the two sliders, and the ledger that shows why the muscle bulges.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::node_table::NodeTable;
use super::profile_view::{ProfileView, Shape};
use super::session::{Changes, Session};
use super::window::{Window, part};
use super::{format, ui};
use crate::document::{Document, SourceKind};
use crate::muscle::{Rig, Solved};
use crate::scene::{Content, MuscleId};
use crate::tr;

/// The panel.
pub struct MusclePanel {
    /// The whole.
    pub root: gtk::ScrolledWindow,
    builder: gtk::Builder,
    contraction: gtk::Scale,
    flexion: gtk::Scale,
    which: gtk::DropDown,
    shown: Rc<Cell<u32>>,
    profile: ProfileView,
    nodes: NodeTable,
    ledger: [gtk::Label; 7],
    quadratic: [gtk::Label; 6],
    solved: RefCell<Solved>,
}

/// A muscle's file unit, for numbers.
pub struct Unit {
    /// The sign of a length.
    pub length: String,
    volume: String,
    /// What a volume in cubed file units is multiplied by.
    volume_factor: f64,
}

impl Unit {
    /// The unit of the file that a rig was made from.
    pub fn of_rig(document: &Document, rig: &Rig) -> Self {
        let metres = document.sources.iter().find_map(|source| match &source.kind {
            SourceKind::Muscles(file, own) if std::ptr::eq(&raw const **own, rig) => Some(file.unit_metres),
            _ => None,
        });
        Self::of(metres.unwrap_or(0.001))
    }

    fn of(metres: f64) -> Self {
        let near = |value: f64| (metres / value - 1.0).abs() < 1e-9;
        if near(0.001) {
            Self { length: tr!("app-unit-mm"), volume: tr!("app-unit-cm3"), volume_factor: 1e-3 }
        } else if near(0.01) {
            Self { length: tr!("app-unit-cm"), volume: tr!("app-unit-cm3"), volume_factor: 1.0 }
        } else if near(1.0) {
            Self { length: tr!("app-unit-m"), volume: tr!("app-unit-m3"), volume_factor: 1.0 }
        } else {
            Self { length: String::new(), volume: String::new(), volume_factor: 1.0 }
        }
    }
}

impl MusclePanel {
    /// A panel of no muscle.
    pub fn new() -> Self {
        let builder = ui::builder(ui::MUSCLE_PANEL);
        let profile = ProfileView::new();
        part::<gtk::Box>(&builder, "profile_slot").append(&profile.canvas);
        let ledger = rows(
            &part(&builder, "ledger"),
            &["app-length", "app-rest-length", "app-shortening", "app-volume", "app-rest-volume", "app-volume-error", "app-delta"],
        );
        let quadratic =
            rows(&part(&builder, "quadratic"), &["app-a", "app-b", "app-c", "app-discriminant", "app-root-taken", "app-root-other"]);
        Self {
            root: part(&builder, "root"),
            contraction: part(&builder, "contraction"),
            flexion: part(&builder, "flexion"),
            which: part(&builder, "which"),
            shown: Rc::default(),
            profile,
            nodes: NodeTable::new(&part(&builder, "nodes")),
            ledger,
            quadratic,
            solved: RefCell::default(),
            builder,
        }
    }

    /// Lets the sliders drive.
    pub fn connect(&self, window: &Rc<Window>) {
        self.contraction.connect_value_changed(glib::clone!(
            #[weak]
            window,
            move |slider| window.act(|session| session.set_contraction(slider.value()))
        ));
        self.flexion.connect_value_changed(glib::clone!(
            #[weak]
            window,
            move |slider| window.act(|session| session.set_flexion(slider.value()))
        ));
        let shown = self.shown.clone();
        self.which.connect_selected_notify(glib::clone!(
            #[weak]
            window,
            move |list| {
                if list.selected() != gtk::INVALID_LIST_POSITION && shown.replace(list.selected()) != list.selected() {
                    window.act(Session::show_other_muscle);
                }
            }
        ));
    }

    /// Shows what changed.
    pub fn refresh(&self, session: &mut Session, changes: Changes) {
        if changes.any(Changes::DOCUMENT) {
            self.refresh_document(session);
        }
        if changes.any(Changes::DOCUMENT | Changes::DRIVE) {
            let drive = session.drive();
            self.contraction.set_value(drive.contraction);
            self.flexion.set_value(drive.flexion);
            let text = |id: &str, value: String| part::<gtk::Label>(&self.builder, id).set_text(&value);
            text("contraction_value", format::with_unit(drive.contraction, 1, "%"));
            let jointed = session.document().driven_rig().is_some_and(|rig| rig.flexion_range().is_some());
            text("flexion_value", if jointed { format!("{}°", format::number(drive.flexion, 1)) } else { "–".into() });
        }
        if changes.any(Changes::SELECTION) {
            self.show_selected(session);
        }
        let moves = Changes::DOCUMENT | Changes::DRIVE | Changes::TIME | Changes::SELECTION | Changes::MUSCLE;
        if changes.any(moves) && self.root.is_mapped() || changes.any(Changes::DOCUMENT | Changes::MUSCLE) {
            self.refresh_ledger(session, changes.any(Changes::DOCUMENT | Changes::SELECTION | Changes::MUSCLE));
        }
    }

    fn refresh_document(&self, session: &Session) {
        let document = session.document();
        let names: Vec<String> =
            document.rigs().flat_map(|(rig, _)| (0..rig.len()).map(|index| rig.name(index).to_owned()).collect::<Vec<_>>()).collect();
        let there = !names.is_empty();
        self.which.set_model(Some(&gtk::StringList::new(&names.iter().map(String::as_str).collect::<Vec<_>>())));
        self.which.set_visible(names.len() > 1);
        self.shown.set(0);
        part::<gtk::Label>(&self.builder, "none").set_visible(!there);
        part::<gtk::Widget>(&self.builder, "details").set_visible(there);
        part::<gtk::Widget>(&self.builder, "sliders").set_visible(there);
        let range = document.driven_rig().and_then(|rig| rig.flexion_range());
        self.flexion.set_sensitive(range.is_some());
        if let Some(range) = range {
            self.flexion.set_range(*range.start(), range.end().max(*range.start() + 1e-9));
        }
    }

    fn show_selected(&self, session: &Session) {
        let Some(node) = session.selected().map(|id| session.document().scene.graph.node(id)) else { return };
        let muscle = node.contents.iter().find_map(|content| if let Content::Muscle(id) = content { Some(*id) } else { None });
        if let Some(muscle) = muscle {
            self.shown.set(muscle.0);
            self.which.set_selected(muscle.0);
        }
    }

    fn refresh_ledger(&self, session: &mut Session, anew: bool) {
        let drive = session.drive();
        let id = MuscleId(self.shown.get());
        session.frame();
        let (document, frame) = (session.document(), session.posed());
        let Some((rig, index)) = document.muscle(id) else { return };
        let mut solved = self.solved.borrow_mut();
        rig.solve_into(index, drive, &frame.world, &mut solved);
        let Some(profile) = rig.profile(index) else { return };
        let unit = Unit::of_rig(document, rig);
        let length = |value: f64, digits| format::with_unit(value, digits, &unit.length);
        let volume = |value: f64| format::with_unit(value * unit.volume_factor, 3, &unit.volume);
        let values = [
            length(solved.length, 2),
            length(profile.rest_length(), 2),
            format::with_unit((solved.length / profile.rest_length() - 1.0) * 100.0, 2, "%"),
            volume(solved.volume),
            volume(profile.volume()),
            format::significant(solved.volume_error, 2),
            length(solved.delta, 4),
        ];
        set_all(&self.ledger, &values);
        let [a, b, c] = solved.quadratic;
        let [taken, other] = solved.roots;
        set_all(&self.quadratic, &[a, b, c, solved.discriminant, taken, other].map(|value| format::significant(value, 7)));
        part::<gtk::Label>(&self.builder, "held").set_visible(solved.held);
        let sign = |value: f64| if value < 0.0 { '−' } else { '+' };
        part::<gtk::Label>(&self.builder, "equation").set_text(&format!(
            "{} δ² {} {} δ {} {} = 0",
            format::significant(a, 5),
            sign(b),
            format::significant(b.abs(), 5),
            sign(c),
            format::significant(c.abs(), 5)
        ));
        self.profile.show(Shape {
            rest: profile.radii().to_vec(),
            rest_length: profile.rest_length(),
            now: solved.radii.clone(),
            length: solved.length,
            unit: unit.length.clone(),
        });
        self.nodes.show(profile, &solved.radii, &unit.length, anew);
    }
}

/// Labels on the left, values on the right, one row a key of the catalogue.
fn rows<const N: usize>(grid: &gtk::Grid, keys: &[&str; N]) -> [gtk::Label; N] {
    std::array::from_fn(|row| {
        let label = gtk::Label::builder().label(tr!(keys[row])).xalign(0.0).hexpand(true).wrap(true).build();
        let value = gtk::Label::builder().xalign(1.0).width_chars(16).css_classes(["numeric"]).build();
        value.set_selectable(true);
        value.set_can_focus(false);
        grid.attach(&label, 0, row as i32, 1, 1);
        grid.attach(&value, 1, row as i32, 1, 1);
        value
    })
}

fn set_all<const N: usize>(labels: &[gtk::Label; N], values: &[String; N]) {
    for (label, value) in labels.iter().zip(values) {
        label.set_text(value);
    }
}
