//! The muscle panel: the two sliders, and the ledger that shows why the muscle bulges.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk::{gdk, gio};
use gtk4 as gtk;

use super::attach_muscles;
use super::attachment_field::Bones;
use super::attachments_editor::AttachmentsEditor;
use super::contraction_controls::ContractionControls;
use super::muscle_editor::{Editor, connect_entry, show_text};
use super::profile_plot::{ProfilePlot, ProfileShape};
use super::profile_table::ProfileTable;
use super::skin_editor::SkinEditor;
use super::via_points_editor::ViaPointsEditor;
use super::wrap_surfaces_editor::WrapSurfacesEditor;
use crate::app::commands::Command;
use crate::app::format;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::notices::toasts::Toasts;
use crate::app::panels::panel::Panel;
use crate::app::widgets::ui::{self, object};
use crate::document::{Document, SourceKind};
use crate::i18n::{self, Sentence};
use crate::muscle::presets::{PRESETS, Preset};
use crate::muscle::solver_report::{Root, SolverReport};
use crate::muscle::{Edit, LimitCause, MuscleRig, MuscleSpec, SolvedMuscle, Tendon};
use crate::scene::MuscleId;
use crate::session::{ChangeSet, Session, UndoStep};
use crate::tr;

ui::widgets! {
    /// The widgets of the panel that are not those of one of its editors.
    struct MuscleWidgets in "muscle_panel.ui" {
        root: gtk::ScrolledWindow,
        none: gtk::Label,
        which: gtk::DropDown,
        new_muscle: gtk::MenuButton,
        muscle_menu: gtk::MenuButton,
        details: gtk::Box,
        alone: gtk::Label,
        hang_box: gtk::Box,
        hang: gtk::Button,
        held: gtk::Label,
        refused: gtk::Label,
        profile_slot: gtk::Box,
        ledger: gtk::Grid,
        limits: gtk::Label,
        equation: gtk::Label,
        quadratic: gtk::Grid,
        root_why: gtk::Label,
        nodes: gtk::ColumnView,
        add_node: gtk::Button,
        delete_node: gtk::Button,
        name: gtk::Entry,
        fit_length: gtk::Button,
        colour: gtk::ColorButton,
    }
}

/// The panel.
pub(crate) struct MusclePanel {
    widgets: MuscleWidgets,
    joint: ContractionControls,
    bones: Bones,
    ends: AttachmentsEditor,
    way: ViaPointsEditor,
    wraps: WrapSurfacesEditor,
    skin: SkinEditor,
    shown: Rc<Cell<u32>>,
    editor: Editor,
    profile: ProfilePlot,
    nodes: ProfileTable,
    /// Rest length; length and radius of both tendons; pennation angle.
    fields: [gtk::Entry; 6],
    /// The signs of their units.
    units: [gtk::Label; 6],
    ledger: [gtk::Label; 9],
    quadratic: [gtk::Label; 6],
    solved: RefCell<SolvedMuscle>,
}

/// What a new muscle is where no other is asked for.
const NEW: Preset = PRESETS[2];

/// The entries of the shape, rest length first.
const FIELDS: [&str; 6] = ["rest_length", "tendon_0_length", "tendon_0_radius", "tendon_1_length", "tendon_1_radius", "pennation"];
/// The one of them that is an angle.
const PENNATION: usize = 5;
/// What a person calls them, in the same order.
const FIELD_NAMES: [&str; 6] = [
    "app-rest-length",
    "app-tendon-origin-length",
    "app-tendon-origin-radius",
    "app-tendon-insertion-length",
    "app-tendon-insertion-radius",
    "app-pennation",
];

/// Takes what was typed into a field of the shape.
fn typed(editor: &Editor, field: usize, entry: &gtk::Entry) {
    let Some(spec) = editor.spec() else { return };
    if entry.text() == field_text(&spec, field) {
        return entry.remove_css_class("error");
    }
    let value = format::parse_number(&entry.text()).unwrap_or(f64::NAN);
    let tendon = |end: usize, change: &dyn Fn(&mut Tendon)| {
        let mut tendon = spec.tendons[end];
        change(&mut tendon);
        // A tendon that gets its length first is as thick as the muscle's end.
        if tendon.length > 0.0 && tendon.radius == 0.0 {
            let radii = spec.profile.radii();
            tendon.radius = 0.5 * if end == 0 { radii.first() } else { radii.last() }.copied().unwrap_or(0.0);
        }
        Edit::Tendon(end, tendon)
    };
    let edit = match field {
        0 => Edit::RestLength(value),
        1 => tendon(0, &|tendon| tendon.length = value),
        2 => tendon(0, &|tendon| tendon.radius = value),
        3 => tendon(1, &|tendon| tendon.length = value),
        PENNATION => Edit::Pennation(value),
        _ => tendon(1, &|tendon| tendon.radius = value),
    };
    if !editor.edit(&edit, UndoStep::New) {
        return entry.add_css_class("error");
    }
    entry.remove_css_class("error");
    if let Some(spec) = editor.spec() {
        entry.set_text(&field_text(&spec, field));
    }
}

fn field_text(spec: &MuscleSpec, field: usize) -> String {
    let value = match field {
        0 => spec.profile.rest_length(),
        1 => spec.tendons[0].length,
        2 => spec.tendons[0].radius,
        3 => spec.tendons[1].length,
        PENNATION => spec.pennation,
        _ => spec.tendons[1].radius,
    };
    format::number(value, 2)
}

/// A muscle's file unit, for numbers.
pub(crate) struct Unit {
    /// The sign of a length.
    pub length: String,
    /// Metres a unit.
    pub metres: f64,
    volume: String,
    /// What a volume in cubed file units is multiplied by.
    volume_factor: f64,
}

impl Unit {
    /// The unit of the file that a rig was made from.
    pub(crate) fn of_rig(document: &Document, rig: &MuscleRig) -> Self {
        let metres = document.sources.iter().find_map(|source| match &source.kind {
            SourceKind::Muscles(file, own) if std::ptr::eq(&raw const **own, rig) => Some(file.unit_metres),
            _ => None,
        });
        Self::of(metres.unwrap_or(0.001))
    }

    fn of(metres: f64) -> Self {
        let near = |value: f64| (metres / value - 1.0).abs() < 1e-9;
        if near(0.001) {
            Self { metres, length: tr!("app-unit-mm"), volume: tr!("app-unit-cm3"), volume_factor: 1e-3 }
        } else if near(0.01) {
            Self { metres, length: tr!("app-unit-cm"), volume: tr!("app-unit-cm3"), volume_factor: 1.0 }
        } else if near(1.0) {
            Self { metres, length: tr!("app-unit-m"), volume: tr!("app-unit-m3"), volume_factor: 1.0 }
        } else {
            Self { metres, length: String::new(), volume: String::new(), volume_factor: 1.0 }
        }
    }
}

impl MusclePanel {
    /// The name of the page.
    pub(crate) const ID: &'static str = "muscle";

    /// The panel of a session.
    pub(crate) fn new(session: &SessionHandle, toasts: &Toasts) -> Self {
        let builder = ui::builder(include_str!("muscle_panel.ui"));
        let widgets = MuscleWidgets::of(&builder);
        let bones = Bones::new();
        let profile = ProfilePlot::new();
        widgets.profile_slot.append(&profile.canvas);
        let ledger = rows(
            &widgets.ledger,
            &[
                "app-length",
                "app-rest-length",
                "app-shortening",
                "app-volume",
                "app-rest-volume",
                "app-volume-error",
                "app-delta",
                "app-moment-arm",
                "app-largest-radius",
            ],
        );
        let quadratic = rows(&widgets.quadratic, &["app-a", "app-b", "app-c", "app-discriminant", "app-root-taken", "app-root-other"]);
        let shown = Rc::default();
        let panel = Self {
            joint: ContractionControls::new(&builder, session),
            ends: AttachmentsEditor::new(&builder, &bones),
            way: ViaPointsEditor::new(&builder, &bones),
            wraps: WrapSurfacesEditor::new(&builder, &bones),
            skin: SkinEditor::new(&builder),
            bones,
            editor: Editor::new(session, &shown, &widgets.refused),
            shown,
            profile,
            nodes: ProfileTable::new(&widgets.nodes),
            ledger,
            quadratic,
            solved: RefCell::default(),
            fields: FIELDS.map(|id| object(&builder, id)),
            units: FIELDS.map(|id| object(&builder, &format!("{id}_unit"))),
            widgets,
        };
        panel.connect(session, toasts);
        panel
    }

    fn connect(&self, session: &SessionHandle, toasts: &Toasts) {
        self.connect_edits(&self.editor);
        self.connect_menus(&self.editor);
        self.widgets.which.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            move |list| {
                if list.selected() != gtk::INVALID_LIST_POSITION {
                    session.update(|session| session.show_muscle(MuscleId(list.selected())));
                }
            }
        ));
        self.widgets.hang.connect_clicked(glib::clone!(
            #[weak]
            session,
            #[strong]
            toasts,
            move |_| {
                let file = session.read(|session| session.shown_file());
                attach_muscles::attach(&session, &toasts, file);
            }
        ));
    }

    /// What changes the muscle that is shown; the panel says why it cannot.
    pub(crate) fn editor(&self) -> &Editor {
        &self.editor
    }

    /// Adds a muscle.
    pub(crate) fn add_muscle(&self) {
        self.editor.tell(|session| session.new_muscle(NEW));
    }

    /// Copies the muscle that is shown.
    pub(crate) fn duplicate_muscle(&self) {
        let id = self.editor.id();
        self.editor.tell(|session| session.duplicate_muscle(id));
    }

    /// Takes the muscle that is shown away.
    pub(crate) fn delete_muscle(&self) {
        let id = self.editor.id();
        self.editor.tell(|session| session.delete_muscle(id));
    }

    fn connect_edits(&self, editor: &Editor) {
        let (delete, own) = (self.widgets.delete_node.clone(), editor.clone());
        let name_node = move |node: usize| delete.set_label(&tr!("app-node-delete-number", node = node + 1));
        self.nodes.connect(move |edit| own.edit(&edit, UndoStep::New), name_node);
        let own = editor.clone();
        self.profile.connect(move |edit, first| {
            own.edit(&edit, if first { UndoStep::New } else { UndoStep::Same });
        });
        for (button, edit) in [(&self.widgets.add_node, Edit::AddNode as fn(usize) -> Edit), (&self.widgets.delete_node, Edit::DeleteNode)]
        {
            let (own, current) = (editor.clone(), self.nodes.at_hand());
            button.connect_clicked(move |_| {
                own.edit(&edit(current()), UndoStep::New);
            });
        }
        for (field, entry) in self.fields.iter().enumerate() {
            let own = editor.clone();
            connect_entry(entry, move |entry| typed(&own, field, entry));
        }
        self.ends.connect(editor);
        self.way.connect(editor);
        self.wraps.connect(editor);
        self.skin.connect(editor);
        let own = editor.clone();
        connect_entry(&self.widgets.name, move |entry| {
            let name = entry.text().trim().to_owned();
            if own.name().is_some_and(|shown| shown != name && !name.is_empty()) {
                own.edit(&Edit::Name(name), UndoStep::New);
            }
        });
        let own = editor.clone();
        self.widgets.fit_length.connect_clicked(move |_| {
            let id = own.id();
            own.tell(|session| session.fit_length(id, UndoStep::New));
        });
        let own = editor.clone();
        self.widgets.colour.connect_color_set(move |button| {
            let color = button.rgba();
            let byte = |part: f32| (part * 255.0).round().clamp(0.0, 255.0) as u8;
            own.edit(&Edit::Color(Some([byte(color.red()), byte(color.green()), byte(color.blue())])), UndoStep::New);
        });
    }

    /// The menus of new muscles and of what can be done with the one that is shown.
    fn connect_menus(&self, editor: &Editor) {
        type Change = fn(&Editor, Preset);
        let list = |button: &gtk::MenuButton, group: &str, change: Change| {
            let (actions, menu) = (gio::SimpleActionGroup::new(), gio::Menu::new());
            for preset in PRESETS {
                let (own, action) = (editor.clone(), gio::SimpleAction::new(preset.id, None));
                action.connect_activate(move |_, _| change(&own, preset));
                actions.add_action(&action);
                menu.append(Some(&preset.name().sentence()), Some(&format!("{group}.{}", preset.id)));
            }
            button.insert_action_group(group, Some(&actions));
            menu
        };
        let button = &self.widgets.new_muscle;
        let new = list(button, "new", |editor, preset| {
            editor.tell(|session| session.new_muscle(preset));
        });
        let sets = gio::Menu::new();
        for command in [Command::AttachArms, Command::AttachLegs, Command::AttachBody] {
            sets.append(Some(&command.label()), Some(&format!("win.{}", command.id())));
        }
        new.append_section(Some(&tr!("app-menu-muscle-sets")), &sets);
        button.set_menu_model(Some(&new));
        let button = &self.widgets.muscle_menu;
        let ready = list(button, "ready", |own, preset| {
            let id = own.id();
            own.tell(|session| session.apply_preset(id, preset));
        });
        let menu = gio::Menu::new();
        for command in [Command::DuplicateMuscle, Command::MirrorMuscle, Command::DeleteMuscle] {
            menu.append(Some(&command.label()), Some(&format!("win.{}", command.id())));
        }
        menu.append_section(Some(&tr!("app-muscle-replace")), &ready);
        button.set_menu_model(Some(&menu));
    }

    /// Offers to hang muscles that are on an arm of their own on the clip that is open with them.
    fn refresh_attachment(&self, session: &Session) {
        let joint = session.shown_file().and_then(|place| session.joint_to_attach_to(place));
        self.widgets.hang_box.set_visible(joint.is_some());
        if let Some(joint) = joint {
            let name = &i18n::label(session.document().scene.graph.label(joint.node));
            let button = &self.widgets.hang;
            button.set_label(&tr!("app-attach", joint = name.clone()));
            if let Some(label) = button.child().and_downcast::<gtk::Label>() {
                label.set_ellipsize(gtk::pango::EllipsizeMode::Middle);
            }
        }
    }

    fn refresh_document(&self, session: &Session) {
        let document = session.document();
        let names: Vec<String> = document
            .rigs()
            .flat_map(|(rig, _)| (0..rig.len()).map(|index| i18n::label(rig.label(index)).into_owned()).collect::<Vec<_>>())
            .collect();
        let there = !names.is_empty();
        self.widgets.which.set_model(Some(&ui::words(&names)));
        self.widgets.which.set_visible(names.len() > 1);
        self.widgets.which.set_selected(if there { session.shown_muscle().0 } else { gtk::INVALID_LIST_POSITION });
        self.widgets.none.set_visible(!there);
        self.widgets.details.set_visible(there);
        self.widgets.muscle_menu.set_visible(there);
    }

    fn refresh_solver_report(&self, session: &mut Session, anew: bool) {
        let drive = session.drive();
        let id = session.shown_muscle();
        session.frame();
        let (document, frame) = (session.document(), session.posed());
        let Some((rig, index)) = document.muscle(id) else { return };
        let mut solved = self.solved.borrow_mut();
        rig.solve_into(index, drive, &frame.world, &mut solved);
        let (Some(spec), Some(profile)) = (rig.spec(index), rig.profile(index)) else { return };
        let Some(ledger) = rig.ledger(index, &solved, &document.scene, &frame.world) else { return };
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
            ledger.moment_arm.map_or_else(|| "–".into(), |arm| length(arm, 2)),
            tr!("app-largest-radius-value", radius = length(ledger.largest_radius, 2), node = ledger.largest_node + 1),
        ];
        set_all(&self.ledger, &values);
        let [a, b, c] = solved.quadratic;
        let [taken, other] = solved.roots;
        set_all(&self.quadratic, &[a, b, c, solved.discriminant, taken, other].map(|value| format::significant(value, 7)));
        self.widgets.held.set_visible(solved.held);
        let (alone, why) = (&self.widgets.alone, session.standalone_reason());
        alone.set_visible(why.is_some());
        if let Some(why) = why.map(|why| why.sentence()).filter(|why| alone.text() != *why) {
            alone.set_text(&why);
        }
        let sign = |value: f64| if value < 0.0 { '−' } else { '+' };
        self.widgets.equation.set_text(&format!(
            "{} δ² {} {} δ {} {} = 0",
            format::significant(a, 5),
            sign(b),
            format::significant(b.abs(), 5),
            sign(c),
            format::significant(c.abs(), 5)
        ));
        self.profile.show(ProfileShape {
            // In the numbers of the file, which a drag changes.
            rest: spec.profile.radii().to_vec(),
            rest_length: spec.profile.rest_length(),
            now: solved.radii.iter().map(|radius| radius / rig.scale(index)).collect(),
            length: solved.length / rig.scale(index),
            unit: unit.length.clone(),
            growth: spec.profile.growth().to_vec(),
        });
        self.widgets.limits.set_text(&limits(&ledger, &unit.length));
        self.widgets.root_why.set_text(&tr!(match ledger.taken {
            Root::Larger => "app-root-larger",
            Root::Smaller => "app-root-smaller",
            Root::Double => "app-root-double",
        }));
        for (field, entry) in self.fields.iter().enumerate() {
            let text = field_text(spec, field);
            show_text(entry, &text, anew);
            let sign = if field == PENNATION { tr!("app-unit-degree") } else { unit.length.clone() };
            self.units[field].set_text(&sign);
            if anew {
                entry.set_tooltip_text(Some(&format!("{}, {sign}", tr!(FIELD_NAMES[field]))));
            }
        }
        let [red, green, blue] = spec.color.unwrap_or([0xB8, 0x32, 0x2E]).map(|part| f32::from(part) / 255.0);
        self.widgets.colour.set_rgba(&gdk::RGBA::new(red, green, blue, 1.0));
        show_text(&self.widgets.name, &i18n::label(rig.label(index)), anew);
        if anew {
            self.bones.list(session, id);
        }
        self.ends.show(session, id, &unit.length, anew);
        self.way.show(session, id, &unit.length, anew);
        self.wraps.show(session, id, &unit.length, anew);
        self.skin.show(session, id, &unit.length, anew);
        self.widgets.fit_length.set_sensitive(rig.is_attached(index));
        self.nodes.show(profile, &solved.radii, &unit.length, anew);
    }
}

impl Panel for MusclePanel {
    fn id(&self) -> &'static str {
        Self::ID
    }

    fn title(&self) -> String {
        tr!("app-page-muscle")
    }

    fn widget(&self) -> gtk::Widget {
        self.widgets.root.clone().upcast()
    }

    fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        if changes.any(ChangeSet::DOCUMENT) {
            self.refresh_document(session);
        }
        self.shown.set(session.shown_muscle().0);
        if changes.any(ChangeSet::MUSCLE) {
            self.widgets.which.set_selected(self.shown.get());
        }
        let bends = ChangeSet::DRIVE | ChangeSet::JOINT_OVERRIDES | ChangeSet::MUSCLE | ChangeSet::EDIT;
        if changes.any(ChangeSet::DOCUMENT | bends) || changes.any(ChangeSet::TIME) && self.widgets.root.is_mapped() {
            self.joint.refresh(session, changes);
        }
        if changes.any(ChangeSet::DOCUMENT | ChangeSet::MUSCLE | ChangeSet::SELECTION) {
            self.refresh_attachment(session);
        }
        if changes.any(ChangeSet::HISTORY) {
            self.widgets.refused.set_visible(false);
            self.way.forget_refusals();
            self.wraps.forget_refusals();
            self.skin.forget_refusals();
        }
        let moves = ChangeSet::DOCUMENT
            | ChangeSet::DRIVE
            | ChangeSet::TIME
            | ChangeSet::MUSCLE
            | ChangeSet::EDIT
            | ChangeSet::JOINT_OVERRIDES
            | ChangeSet::PICKING;
        if changes.any(moves) && self.widgets.root.is_mapped() || changes.any(ChangeSet::DOCUMENT | ChangeSet::MUSCLE) {
            self.refresh_solver_report(session, changes.any(ChangeSet::DOCUMENT | ChangeSet::MUSCLE));
        }
    }
}

/// How short and how long the muscle can get, and what sets that.
fn limits(ledger: &SolverReport, unit: &str) -> String {
    let cause = |cause: LimitCause| match cause {
        LimitCause::Discriminant => tr!("app-limit-discriminant"),
        LimitCause::Radius(node) => tr!("app-limit-radius", node = node + 1),
        LimitCause::Reach => tr!("app-limit-program"),
        LimitCause::Shortest => tr!("app-limit-shortest"),
    };
    let [short, long] = ledger.limits.map(|limit| (format::with_unit(limit.length, 1, unit), cause(limit.cause)));
    tr!("app-limits", short = short.0, short_cause = short.1, long = long.0, long_cause = long.1)
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
