//! Sliders for contraction and joint angle in the muscle panel, and the joint that they drive on a clip.

use std::cell::RefCell;
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use super::commands::Command;
use super::format;
use super::session_handle::SessionHandle;
use super::ui::{self, object};
use crate::i18n;
use crate::message;
use crate::scene::NodeId;
use crate::session::{ChangeSet, JointAxis, Session, UndoStep};
use crate::tr;

/// The axes, in the order of their list.
const AXES: [JointAxis; 4] = [JointAxis::Hinge, JointAxis::Own(0), JointAxis::Own(1), JointAxis::Own(2)];

/// Sliders and joint.
pub(super) struct ContractionControls {
    builder: gtk::Builder,
    contraction: gtk::Scale,
    flexion: gtk::Scale,
    joint: gtk::DropDown,
    axis: gtk::DropDown,
    on_top: gtk::CheckButton,
    /// The bones behind the list's rows, the first row left out.
    bones: Rc<RefCell<Vec<NodeId>>>,
}

impl ContractionControls {
    /// Those of a panel.
    pub(super) fn new(builder: &gtk::Builder, session: &SessionHandle) -> Self {
        let (joint, axis): (gtk::DropDown, gtk::DropDown) = (object(builder, "joint"), object(builder, "joint_axis"));
        ui::narrow(&joint, 14);
        let names = [tr!("app-joint-axis-hinge"), "X".to_owned(), "Y".to_owned(), "Z".to_owned()];
        axis.set_model(Some(&ui::words(&names)));
        let controls = Self {
            contraction: object(builder, "contraction"),
            flexion: object(builder, "flexion"),
            joint,
            axis,
            on_top: object(builder, "on_top"),
            bones: Rc::default(),
            builder: builder.clone(),
        };
        controls.connect(session);
        controls
    }

    /// Lets the sliders drive.
    fn connect(&self, session: &SessionHandle) {
        self.contraction.connect_value_changed(glib::clone!(
            #[weak]
            session,
            move |slider| session.update(|session| session.set_contraction_undoable(slider.value()))
        ));
        self.flexion.connect_value_changed(glib::clone!(
            #[weak]
            session,
            move |slider| session.update(|session| session.set_angle_undoable(slider.value()))
        ));
        for list in [&self.joint, &self.axis] {
            let (joint, axis, bones) = (self.joint.downgrade(), self.axis.downgrade(), self.bones.clone());
            list.connect_selected_notify(glib::clone!(
                #[weak]
                session,
                move |_| {
                    let (Some(joint), Some(axis)) = (joint.upgrade(), axis.upgrade()) else { return };
                    let bone = (joint.selected() as usize).checked_sub(1).and_then(|row| bones.borrow().get(row).copied());
                    let axis = AXES.get(axis.selected() as usize).copied().unwrap_or_default();
                    session.update(|session| {
                        // Another axis of the joint that was found is a choice too.
                        let found = || session.joint().map(|joint| joint.node).filter(|_| axis != JointAxis::Hinge);
                        let chosen = bone.or_else(found).map(|node| (node, axis));
                        session.undoable(message!("app-edit-joint"), UndoStep::New, |session| session.choose_joint(chosen));
                    });
                }
            ));
        }
        self.on_top.connect_toggled(glib::clone!(
            #[weak]
            session,
            move |on_top| session.update(|session| {
                session.undoable(message!("app-edit-on-top"), UndoStep::New, |session| session.set_on_top(on_top.is_active()));
            })
        ));
        object::<gtk::Button>(&self.builder, "joint_release").connect_clicked(glib::clone!(
            #[weak]
            session,
            move |_| session.update(Session::release_undoable)
        ));
    }

    /// Shows what changed.
    pub(super) fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        if changes.any(ChangeSet::DOCUMENT) {
            self.list_joints(session);
        }
        let (there, bend, contraction) = (session.document().muscle_count() > 0, session.angle_slider(), session.contraction());
        let (text, show) = (
            |id: &str, value: String| object::<gtk::Label>(&self.builder, id).set_text(&value),
            |id: &str, shown: bool| object::<gtk::Widget>(&self.builder, id).set_visible(shown),
        );
        show("sliders", there || bend.is_some());
        for id in ["contraction_label", "contraction", "contraction_value"] {
            show(id, there);
        }
        self.contraction.set_sensitive(contraction.is_some());
        ui::show_value(&self.contraction.adjustment(), contraction.unwrap_or(0.0));
        text("contraction_value", contraction.map_or_else(|| "–".into(), |value| format::with_unit(value, 1, "%")));
        let of_clip = !session.bends_arm() && session.joint().is_some();
        for id in ["joint_label", "joint_box", "joint_more"] {
            show(id, of_clip);
        }
        self.flexion.set_sensitive(bend.is_some());
        let Some(bend) = bend else { return text("flexion_value", "–".into()) };
        let (low, high) = bend.range.into_inner();
        // A clip can bend a joint farther than the slider's hand.
        self.flexion.set_range(low.min(bend.value), high.max(bend.value).max(low + 1e-9));
        ui::show_value(&self.flexion.adjustment(), bend.value);
        let sign = if of_clip && session.is_on_top() && bend.value > 0.0 { "+" } else { "" };
        text("flexion_value", format!("{sign}{}°", format::number(bend.value, 1)));
        if of_clip {
            self.on_top.set_active(session.is_on_top());
            self.on_top.set_visible(!session.document().clips.is_empty());
            object::<gtk::Button>(&self.builder, "joint_release").set_sensitive(bend.is_manual);
            let row = |node: NodeId| self.bones.borrow().iter().position(|bone| *bone == node).map_or(0, |row| row as u32 + 1);
            let (bone, axis) = session.chosen_joint().map_or((0, JointAxis::Hinge), |(node, axis)| (row(node), axis));
            self.joint.set_selected(bone);
            self.axis.set_selected(AXES.iter().position(|own| *own == axis).unwrap_or(0) as u32);
        }
        let tip = if of_clip { tr!("app-elbow-clip-tip") } else { tr!("app-elbow-tip") };
        self.flexion.set_tooltip_text(Some(&Command::with_keys(&tip, &[Command::ElbowMore, Command::ElbowLess])));
        text("flexion_label", if of_clip && session.chosen_joint().is_some() { tr!("app-joint-angle") } else { tr!("app-elbow") });
    }

    fn list_joints(&self, session: &Session) {
        let graph = &session.document().scene.graph;
        let found = session.joint().map(|joint| tr!("app-joint-found", name = i18n::label(graph.label(joint.node))));
        let bones = if found.is_some() { session.turnable() } else { Vec::new() };
        let names = found.into_iter().chain(bones.iter().map(|bone| i18n::label(graph.label(*bone)).into_owned())).collect::<Vec<_>>();
        self.bones.replace(bones);
        self.joint.set_model(Some(&ui::words(&names)));
    }
}
