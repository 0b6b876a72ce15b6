//! The inspector under the scene tree: transform and contents of the selection, influences of the picked vertex, and joint overrides.
//! Its texts are in [`inspector_text`], the thumbnails of its materials in [`material_preview`].

mod inspector_text;
mod material_preview;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use glam::{DMat4, DVec3};
use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use self::inspector_text::Space;
use crate::app::format;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::notices::toasts::Toasts;
use crate::app::widgets::drawing_area::PaintWidget;
use crate::app::widgets::plot_view;
use crate::app::widgets::ui::{self, object};
use crate::document::{Skinning, angle_at};
use crate::i18n;
use crate::message;
use crate::plot::Plot;
use crate::scene::{Content, NodeId, NodeKind};
use crate::session::{ChangeSet, Matrices, Session, UndoStep};
use crate::tr;

/// Moments at which the angle over a clip is taken.
const MOMENTS: usize = 241;
/// Most materials and bones that are listed.
const MOST: usize = 12;

ui::widgets! {
    /// The widgets of the inspector.
    struct InspectorWidgets from "inspector.ui" {
        root: gtk::Box,
        name: gtk::Label,
        copy: gtk::Button,
        space: gtk::DropDown,
        transform: gtk::Grid,
        matrix: gtk::Grid,
        hand: gtk::Box,
        turns: gtk::Grid,
        reset: gtk::Button,
        reset_all: gtk::Button,
        dual: gtk::CheckButton,
        angle: gtk::Box,
        angle_value: gtk::Label,
        angle_slot: gtk::Box,
        angle_from: gtk::DropDown,
        angle_corner: gtk::DropDown,
        angle_to: gtk::DropDown,
        angle_own: gtk::Button,
        mesh: gtk::Box,
        mesh_facts: gtk::Label,
        materials: gtk::Box,
        vertex: gtk::Box,
        vertex_title: gtk::Label,
        shares: gtk::Grid,
        vertex_note: gtk::Label,
        distance: gtk::Label,
    }
}

/// The inspector.
pub(crate) struct Inspector {
    /// The whole; hidden while nothing is selected.
    pub root: gtk::Box,
    widgets: InspectorWidgets,
    /// The space that the user chose.
    wanted: Rc<Cell<Space>>,
    transform: [[gtk::Label; 3]; 3],
    matrix: [[gtk::Label; 4]; 4],
    turns: [gtk::Scale; 3],
    turn_values: [gtk::Label; 3],
    plot: PaintWidget,
    curve: Rc<RefCell<Plot>>,
    /// The lists that the three bones of the angle are chosen from.
    corners: [gtk::DropDown; 3],
    joints: Rc<RefCell<Vec<NodeId>>>,
}

fn number_label() -> gtk::Label {
    gtk::Label::builder().xalign(1.0).hexpand(true).css_classes(["numeric", "small"]).selectable(false).build()
}

impl Inspector {
    /// The inspector of a session.
    pub(crate) fn new(session: &SessionHandle, toasts: &Toasts) -> Self {
        let widgets = InspectorWidgets::build();
        let labels = std::array::from_fn(|row| {
            let key = ["app-position", "app-rotation", "app-scale"][row];
            let name = gtk::Label::builder().label(tr!(key)).xalign(0.0).css_classes(["small"]).build();
            widgets.transform.attach(&name, 0, row as i32, 1, 1);
            std::array::from_fn(|column| {
                let label = number_label();
                widgets.transform.attach(&label, column as i32 + 1, row as i32, 1, 1);
                label
            })
        });
        let matrix = std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                let label = number_label();
                widgets.matrix.attach(&label, column as i32, row as i32, 1, 1);
                label
            })
        });
        let scales = std::array::from_fn(|row| turn_scale(&widgets.turns, row));
        let turn_values = std::array::from_fn(|row| {
            let label = gtk::Label::builder().xalign(1.0).width_chars(7).css_classes(["numeric", "small"]).build();
            widgets.turns.attach(&label, 2, row as i32, 1, 1);
            label
        });
        let (plot, curve) = (PaintWidget::new(200, 130), Rc::new(RefCell::new(Plot::default())));
        plot.set_hexpand(true);
        widgets.angle_slot.append(&plot);
        let corners = [&widgets.angle_from, &widgets.angle_corner, &widgets.angle_to].map(gtk::DropDown::clone);
        corners.iter().for_each(|list| ui::narrow(list, 12));
        let joints = Rc::default();
        let inspector = Self {
            corners,
            joints,
            root: widgets.root.clone(),
            widgets,
            wanted: Rc::new(Cell::new(Space::World)),
            transform: labels,
            matrix,
            turns: scales,
            turn_values,
            plot,
            curve,
        };
        inspector.connect(session, toasts);
        inspector
    }

    /// Connects the input of the widgets.
    fn connect(&self, session: &SessionHandle, toasts: &Toasts) {
        let wanted = self.wanted.clone();
        self.widgets.space.connect_selected_notify(glib::clone!(
            #[weak]
            session,
            move |list| session.update(|session| {
                wanted.set(Space::ALL.get(list.selected() as usize).copied().unwrap_or(Space::World));
                session.refresh_probe();
            })
        ));
        self.widgets.copy.connect_clicked(glib::clone!(
            #[weak]
            session,
            #[strong]
            toasts,
            move |button| {
                let text = session.read(inspector_text::report);
                button.clipboard().set_text(&text);
                toasts.toast(&tr!("app-copied"), None);
            }
        ));
        for (axis, scale) in self.turns.iter().enumerate() {
            scale.connect_value_changed(glib::clone!(
                #[weak]
                session,
                move |scale| session.update(|session| turn(session, axis, scale.value()))
            ));
        }
        for (button, all) in [(&self.widgets.reset, false), (&self.widgets.reset_all, true)] {
            button.connect_clicked(glib::clone!(
                #[weak]
                session,
                move |_| session.update(|session| {
                    let node = session.selected();
                    if all || node.is_some() {
                        session.reset_joint_overrides(node.filter(|_| !all));
                    }
                })
            ));
        }
        self.widgets.dual.connect_toggled(glib::clone!(
            #[weak]
            session,
            move |dual| {
                let skinning = if dual.is_active() { Skinning::DualQuaternion } else { Skinning::Linear };
                session.update(|session| session.set_skinning(skinning));
            }
        ));
        for list in &self.corners {
            let (corners, joints) = (self.corners.clone(), self.joints.clone());
            list.connect_selected_notify(glib::clone!(
                #[weak]
                session,
                move |_| {
                    let chosen = corners.each_ref().map(|list| joints.borrow().get(list.selected() as usize).copied());
                    if let [Some(from), Some(corner), Some(to)] = chosen {
                        session.update(|session| session.choose_angle(Some([from, corner, to])));
                    }
                }
            ));
        }
        self.widgets.angle_own.connect_clicked(glib::clone!(
            #[weak]
            session,
            move |_| session.update(|session| session.choose_angle(None))
        ));
        let curve = self.curve.clone();
        self.plot.set_painter(move |canvas, snapshot, width, height| plot_view::paint(&curve.borrow(), canvas, snapshot, width, height));
        let motion = gtk::EventControllerMotion::new();
        let point = |curve: &Rc<RefCell<Plot>>, plot: &PaintWidget, x: Option<f64>| {
            curve.borrow_mut().pointer = x;
            plot.queue_draw();
        };
        motion.connect_motion(glib::clone!(
            #[strong(rename_to = curve)]
            self.curve,
            #[weak(rename_to = plot)]
            self.plot,
            move |_, x, _| point(&curve, &plot, Some(x))
        ));
        motion.connect_leave(glib::clone!(
            #[strong(rename_to = curve)]
            self.curve,
            #[weak(rename_to = plot)]
            self.plot,
            move |_| point(&curve, &plot, None)
        ));
        self.plot.add_controller(motion);
        let click = gtk::GestureClick::new();
        click.connect_released(glib::clone!(
            #[weak]
            session,
            #[strong(rename_to = curve)]
            self.curve,
            #[weak(rename_to = plot)]
            self.plot,
            move |_, _, x, _| {
                let time = curve.borrow().x_at(x, f64::from(plot.width()));
                if let Some(time) = time {
                    session.update(|session| session.time(|cursor| cursor.seek(time)));
                }
            }
        ));
        self.plot.add_controller(click);
    }

    /// Shows what changed.
    pub(crate) fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        let other = changes.any(ChangeSet::DOCUMENT | ChangeSet::SELECTION);
        let moved =
            ChangeSet::TIME | ChangeSet::DRIVE | ChangeSet::MODEL | ChangeSet::JOINT_OVERRIDES | ChangeSet::PROBE | ChangeSet::DISPLAY;
        if !other && !changes.any(moved | ChangeSet::PLAYBACK) {
            return;
        }
        let Some(node) = session.selected() else {
            self.root.set_visible(false);
            return;
        };
        self.root.set_visible(true);
        if other {
            self.show_kind(session, node);
        }
        if changes.any(ChangeSet::DOCUMENT) {
            self.list_joints(session);
        }
        if other || changes.any(ChangeSet::PLAYBACK | ChangeSet::JOINT_OVERRIDES | ChangeSet::PROBE) {
            self.show_curve(session, node);
        }
        self.show_transform(session, node);
        self.show_joint_overrides(session, node);
        self.show_angle(session, node);
        self.show_vertex(session);
        let distance = &self.widgets.distance;
        let pinned = session.probed_point();
        distance.set_visible(pinned[1].is_some());
        distance.set_text(&inspector_text::distance(pinned));
    }

    fn show_kind(&self, session: &Session, node: NodeId) {
        let scene = &session.document().scene;
        let shown = scene.graph.node(node);
        let name = &self.widgets.name;
        let label = i18n::label(scene.graph.label(node));
        let text = i18n::shown(&label);
        name.set_text(&text);
        name.set_tooltip_text(Some(&text));
        let is_joint = shown.kind == NodeKind::Joint;
        self.widgets.hand.set_visible(is_joint);
        let instance = shown.contents.iter().find_map(|content| if let Content::Mesh(mesh) = content { Some(mesh) } else { None });
        self.widgets.mesh.set_visible(instance.is_some());
        let Some(instance) = instance else { return };
        self.widgets.mesh_facts.set_text(&i18n::shown_lines(&inspector_text::mesh(scene, instance)));
        let materials = &self.widgets.materials;
        while let Some(child) = materials.first_child() {
            materials.remove(&child);
        }
        let mut listed = Vec::new();
        for binding in instance.materials.iter().flatten().take(MOST) {
            let Some(material) = scene.materials.get(binding.material.index()).filter(|_| !listed.contains(&binding.material)) else {
                continue;
            };
            listed.push(binding.material);
            let row = gtk::Box::new(gtk::Orientation::Horizontal, 6);
            row.append(&material_preview::of(scene, material));
            let label =
                gtk::Label::builder().label(&*i18n::shown(&inspector_text::material(scene, material))).xalign(0.0).wrap(true).hexpand(true);
            row.append(&label.css_classes(["small"]).build());
            materials.append(&row);
        }
    }

    fn show_transform(&self, session: &mut Session, node: NodeId) {
        let Some(matrices) = session.matrices(node) else { return };
        let matrix = self.choose_space(&matrices);
        let (scale, rotation, place) = matrix.to_scale_rotation_translation();
        let degrees = inspector_text::degrees(rotation);
        for (labels, (values, digits)) in self.transform.iter().zip([(place, 4), (degrees, 2), (scale, 4)]) {
            for (label, value) in labels.iter().zip(values.to_array()) {
                label.set_text(&format::number(value, digits));
            }
        }
        for (row, labels) in self.matrix.iter().enumerate() {
            for (column, label) in labels.iter().enumerate() {
                label.set_text(&format::number(matrix.col(column)[row], 4));
            }
        }
    }

    /// The matrix in the chosen space, where the node has one there; else in the world. The list names what there is.
    fn choose_space(&self, matrices: &Matrices) -> DMat4 {
        let there: Vec<Space> = Space::ALL.into_iter().filter(|space| space.of(matrices).is_some()).collect();
        if self.widgets.space.model().map_or(0, |list| list.n_items() as usize) != there.len() {
            let words: Vec<String> = there.iter().map(|space| space.label()).collect();
            self.widgets.space.set_model(Some(&ui::words(&words)));
        }
        let wanted = there.iter().position(|space| *space == self.wanted.get());
        let world = || there.iter().position(|space| *space == Space::World);
        self.widgets.space.set_selected(wanted.or_else(world).unwrap_or(0) as u32);
        self.wanted.get().of(matrices).unwrap_or(matrices.world)
    }

    fn show_joint_overrides(&self, session: &Session, node: NodeId) {
        let degrees = session.joint_control().joint_override(node);
        for ((scale, label), value) in self.turns.iter().zip(&self.turn_values).zip(degrees.to_array()) {
            ui::show_value(&scale.adjustment(), value);
            label.set_text(&format!("{}°", format::number(value, 1)));
        }
        self.widgets.reset.set_sensitive(degrees != DVec3::ZERO);
        self.widgets.reset_all.set_sensitive(!session.joint_control().overrides().is_empty());
        self.widgets.dual.set_active(session.state().skinning == Skinning::DualQuaternion);
    }

    fn show_curve(&self, session: &Session, node: NodeId) {
        let points = match session.angle_bones(node) {
            Some(bones) => session.document().angle_curve(&session.state(), bones, MOMENTS),
            None => Vec::new(),
        };
        self.plot.set_visible(!points.is_empty());
        let (across, up) = (tr!("app-angle-across"), tr!("app-angle-up"));
        self.curve.replace(Plot { x_label: across, y_label: up, points, color: 0xFF7A59, ..Plot::default() });
    }

    fn list_joints(&self, session: &Session) {
        let joints = session.joints();
        let names: Vec<String> =
            joints.iter().map(|joint| i18n::label(session.document().scene.graph.label(*joint)).into_owned()).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        for list in &self.corners {
            list.set_model(Some(&ui::words(&names)));
        }
        self.joints.replace(joints);
    }

    fn show_angle(&self, session: &mut Session, node: NodeId) {
        let bones = session.angle_bones(node);
        let is_joint = session.document().scene.graph.node(node).kind == NodeKind::Joint;
        self.widgets.angle.set_visible(bones.is_some() || is_joint);
        let told = &self.widgets.angle_value;
        self.widgets.angle_own.set_sensitive(session.chosen_angle().is_some());
        let Some(bones) = bones else {
            told.set_text(&tr!("app-angle-end"));
            self.corners.iter().for_each(|list| list.set_selected(gtk::INVALID_LIST_POSITION));
            return;
        };
        for (list, bone) in self.corners.iter().zip(bones) {
            let place = self.joints.borrow().iter().position(|joint| *joint == bone);
            list.set_selected(place.map_or(gtk::INVALID_LIST_POSITION, |place| place as u32));
        }
        let angle = angle_at(session.frame(), bones[0], bones[1], bones[2]);
        let [from, corner, to] = bones.map(|bone| i18n::label(session.document().scene.graph.label(bone)));
        let angle = format!("{}°", format::number(angle.unwrap_or(f64::NAN), 2));
        told.set_text(&tr!("app-angle-value", from = from, corner = corner, to = to, angle = angle));
        self.curve.borrow_mut().cursor = Some(session.playback().time);
        self.plot.queue_draw();
    }

    fn show_vertex(&self, session: &mut Session) {
        let told = session.vertex_influences();
        self.widgets.vertex.set_visible(told.is_some());
        let Some(told) = told else { return };
        self.widgets.vertex_title.set_text(&tr!("app-vertex", number = told.point));
        let grid = &self.widgets.shares;
        let rows = inspector_text::shares(&told, MOST);
        // The cells are used again: while a clip plays only their text changes.
        for (row, texts) in rows.iter().enumerate() {
            for (column, text) in texts.iter().enumerate() {
                let label = grid.child_at(column as i32, row as i32).and_downcast::<gtk::Label>().unwrap_or_else(|| {
                    let label = number_label();
                    if column == 0 {
                        label.set_xalign(0.0);
                        label.set_ellipsize(gtk::pango::EllipsizeMode::Middle);
                    }
                    grid.attach(&label, column as i32, row as i32, 1, 1);
                    label
                });
                ui::set_label(&label, text);
            }
        }
        while grid.child_at(0, rows.len() as i32).is_some() {
            grid.remove_row(rows.len() as i32);
        }
        self.widgets.vertex_note.set_text(&i18n::shown_lines(&inspector_text::vertex_note(&told)));
    }
}

/// A slider that turns about one axis, in its row of the grid.
fn turn_scale(grid: &gtk::Grid, row: usize) -> gtk::Scale {
    let builder = ui::builder(include_str!("joint_rotation.ui"));
    let scale: gtk::Scale = object(&builder, ["turn_x", "turn_y", "turn_z"][row]);
    let name = gtk::Label::builder().label(["X", "Y", "Z"][row]).build();
    grid.attach(&name, 0, row as i32, 1, 1);
    grid.attach(&scale, 1, row as i32, 1, 1);
    scale
}

/// Turns the selected joint about one of its axes.
fn turn(session: &mut Session, axis: usize, degrees: f64) {
    let Some(node) = session.selected() else { return };
    let mut turns = session.joint_control().joint_override(node);
    turns[axis] = degrees;
    session.undoable(message!("app-edit-rotate-joint"), UndoStep::near(node.0), |session| session.override_joint(node, turns));
}
