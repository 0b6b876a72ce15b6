//! Sliders for contraction and joint angle in the muscle panel, and the joint that they drive on a clip.

use std::cell::RefCell;
use std::rc::Rc;

use gtk::glib;
use gtk::prelude::*;
use gtk4 as gtk;

use crate::app::commands::Command;
use crate::app::format;
use crate::app::handles::session_handle::SessionHandle;
use crate::app::widgets::ui;
use crate::i18n;
use crate::message;
use crate::scene::NodeId;
use crate::session::{ChangeSet, JointAxis, Session, UndoStep};
use crate::tr;

/// The axes, in the order of their list.
const AXES: [JointAxis; 4] = [JointAxis::Flexion, JointAxis::Own(0), JointAxis::Own(1), JointAxis::Own(2)];

ui::widgets! {
    /// The widgets of the muscle panel for contraction and joint.
    struct ContractionWidgets in "muscle_panel.ui" {
        sliders: gtk::Grid,
        contraction_label: gtk::Label,
        contraction: gtk::Scale,
        contraction_value: gtk::Label,
        flexion_label: gtk::Label,
        flexion: gtk::Scale,
        flexion_value: gtk::Label,
        joint_label: gtk::Label,
        joint_box: gtk::Box,
        joint: gtk::DropDown,
        joint_axis: gtk::DropDown,
        joint_more: gtk::Box,
        on_top: gtk::CheckButton,
        joint_release: gtk::Button,
    }
}

/// Sliders and joint.
pub(crate) struct ContractionControls {
    widgets: ContractionWidgets,
    /// The bones behind the list's rows, the first row left out.
    bones: Rc<RefCell<Vec<NodeId>>>,
}

impl ContractionControls {
    /// Those of a panel.
    pub(crate) fn new(builder: &gtk::Builder, session: &SessionHandle) -> Self {
        let widgets = ContractionWidgets::of(builder);
        ui::narrow(&widgets.joint, 14);
        let names = [tr!("app-joint-axis-hinge"), "X".to_owned(), "Y".to_owned(), "Z".to_owned()];
        widgets.joint_axis.set_model(Some(&ui::words(&names)));
        let controls = Self { widgets, bones: Rc::default() };
        controls.connect(session);
        controls
    }

    /// Lets the sliders drive.
    fn connect(&self, session: &SessionHandle) {
        self.widgets.contraction.connect_value_changed(glib::clone!(
            #[weak]
            session,
            move |slider| session.update(|session| session.set_contraction_undoable(slider.value()))
        ));
        self.widgets.flexion.connect_value_changed(glib::clone!(
            #[weak]
            session,
            move |slider| session.update(|session| session.set_angle_undoable(slider.value()))
        ));
        for list in [&self.widgets.joint, &self.widgets.joint_axis] {
            let (joint, axis, bones) = (self.widgets.joint.downgrade(), self.widgets.joint_axis.downgrade(), self.bones.clone());
            list.connect_selected_notify(glib::clone!(
                #[weak]
                session,
                move |_| {
                    let (Some(joint), Some(axis)) = (joint.upgrade(), axis.upgrade()) else { return };
                    let bone = (joint.selected() as usize).checked_sub(1).and_then(|row| bones.borrow().get(row).copied());
                    let axis = AXES.get(axis.selected() as usize).copied().unwrap_or_default();
                    session.update(|session| {
                        // Another axis of the joint that was found is a choice too.
                        let found = || session.joint().map(|joint| joint.node).filter(|_| axis != JointAxis::Flexion);
                        let chosen = bone.or_else(found).map(|node| (node, axis));
                        session.undoable(message!("app-edit-joint"), UndoStep::New, |session| session.choose_joint(chosen));
                    });
                }
            ));
        }
        self.widgets.on_top.connect_toggled(glib::clone!(
            #[weak]
            session,
            move |on_top| session.update(|session| {
                session.undoable(message!("app-edit-on-top"), UndoStep::New, |session| session.set_on_top(on_top.is_active()));
            })
        ));
        self.widgets.joint_release.connect_clicked(glib::clone!(
            #[weak]
            session,
            move |_| session.update(Session::release_undoable)
        ));
    }

    /// Shows what changed.
    pub(crate) fn refresh(&self, session: &mut Session, changes: ChangeSet) {
        if changes.any(ChangeSet::DOCUMENT) {
            self.list_joints(session);
        }
        let (there, bend, contraction) = (session.document().muscle_count() > 0, session.angle_slider(), session.contraction());
        let widgets = &self.widgets;
        widgets.sliders.set_visible(there || bend.is_some());
        widgets.contraction_label.set_visible(there);
        widgets.contraction.set_visible(there);
        widgets.contraction_value.set_visible(there);
        self.widgets.contraction.set_sensitive(contraction.is_some());
        ui::show_value(&self.widgets.contraction.adjustment(), contraction.unwrap_or(0.0));
        widgets.contraction_value.set_text(&contraction.map_or_else(|| "–".into(), |value| format::with_unit(value, 1, "%")));
        let of_clip = !session.bends_arm() && session.joint().is_some();
        widgets.joint_label.set_visible(of_clip);
        widgets.joint_box.set_visible(of_clip);
        widgets.joint_more.set_visible(of_clip);
        self.widgets.flexion.set_sensitive(bend.is_some());
        let Some(bend) = bend else { return widgets.flexion_value.set_text("–") };
        let (low, high) = bend.range.into_inner();
        // A clip can bend a joint farther than the slider's hand.
        self.widgets.flexion.set_range(low.min(bend.value), high.max(bend.value).max(low + 1e-9));
        ui::show_value(&self.widgets.flexion.adjustment(), bend.value);
        let sign = if of_clip && session.is_on_top() && bend.value > 0.0 { "+" } else { "" };
        widgets.flexion_value.set_text(&format!("{sign}{}°", format::number(bend.value, 1)));
        if of_clip {
            self.widgets.on_top.set_active(session.is_on_top());
            self.widgets.on_top.set_visible(!session.document().clips.is_empty());
            self.widgets.joint_release.set_sensitive(bend.is_manual);
            let row = |node: NodeId| self.bones.borrow().iter().position(|bone| *bone == node).map_or(0, |row| row as u32 + 1);
            let (bone, axis) = session.chosen_joint().map_or((0, JointAxis::Flexion), |(node, axis)| (row(node), axis));
            self.widgets.joint.set_selected(bone);
            self.widgets.joint_axis.set_selected(AXES.iter().position(|own| *own == axis).unwrap_or(0) as u32);
        }
        let tip = if of_clip { tr!("app-elbow-clip-tip") } else { tr!("app-elbow-tip") };
        self.widgets.flexion.set_tooltip_text(Some(&Command::with_keys(&tip, &[Command::ElbowMore, Command::ElbowLess])));
        widgets.flexion_label.set_text(&if of_clip && session.chosen_joint().is_some() {
            tr!("app-joint-angle")
        } else {
            tr!("app-elbow")
        });
    }

    fn list_joints(&self, session: &Session) {
        let graph = &session.document().scene.graph;
        let found = session.joint().map(|joint| tr!("app-joint-found", name = i18n::label(graph.label(joint.node))));
        let bones = if found.is_some() { session.turnable() } else { Vec::new() };
        let names = found.into_iter().chain(bones.iter().map(|bone| i18n::label(graph.label(*bone)).into_owned())).collect::<Vec<_>>();
        self.bones.replace(bones);
        self.widgets.joint.set_model(Some(&ui::words(&names)));
    }
}
