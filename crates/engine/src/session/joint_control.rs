//! Manual rotation of a joint of a clip's skeleton, added to the clip or in place of it, and the contraction of the muscle that it drives.

use std::cell::OnceCell;
use std::ops::RangeInclusive;

use glam::DVec3;

use super::{ChangeSet, Session, UndoStep};
use crate::document::Document;
use sinew_muscle::{Driving, JointDof, JointRotation, MuscleState};
use sinew_scene::message;
use sinew_scene::message::{Message, signed};
use sinew_scene::{MuscleId, NodeId, NodeKind};

/// Which axis a chosen joint turns about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum JointAxis {
    /// That about which the skeleton bends it.
    #[default]
    Flexion,
    /// The bone's own X (0), Y (1) or Z (2) axis.
    Own(usize),
}

/// What is known and chosen about that joint.
#[derive(Debug, Default)]
pub(super) struct JointController {
    /// The elbow found in the skeleton.
    elbow: OnceCell<Option<JointDof>>,
    slider: JointSlider,
    joint: OnceCell<Option<JointDof>>,
    /// The muscle that was added last and found no place, and the joint that turns about its own bone: that is why.
    pub(super) twisted: Option<(MuscleId, NodeId)>,
}

impl JointController {
    /// Drops the cached joint that the muscles cross, because the muscles changed.
    pub(super) fn muscles_changed(&mut self) {
        self.joint = OnceCell::new();
    }
}

/// What was chosen for the slider: undo brings it back with the rotation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct JointSlider {
    chosen: Option<(NodeId, JointAxis)>,
    on_top: bool,
}

/// What the elbow slider shows, degrees.
#[derive(Debug, Clone, PartialEq)]
pub struct SliderState {
    /// Where the slider stands.
    pub value: f64,
    /// Where it can go.
    pub range: RangeInclusive<f64>,
    /// Whether the joint of a clip is controlled manually; then it can be released.
    pub is_manual: bool,
}

impl Session {
    /// Whether the elbow slider bends the arm of a muscle file.
    pub fn bends_arm(&self) -> bool {
        self.document.driven_rig().is_some_and(|rig| rig.flexion_range().is_some())
    }

    /// The joint of the clip's skeleton that the elbow slider turns: the one that was chosen, else the one that [`Document::joint`] finds.
    pub fn joint(&self) -> Option<JointDof> {
        let find = || match self.joint.slider.chosen {
            Some((node, axis)) => self.joint_at(node, axis),
            None => self.document.muscles_joint().or_else(|| self.found_elbow()),
        };
        *self.joint.joint.get_or_init(find)
    }

    /// The elbow that is found in the clip's skeleton, whatever was chosen.
    pub(super) fn found_elbow(&self) -> Option<JointDof> {
        *self.joint.elbow.get_or_init(|| self.document.elbow())
    }

    fn joint_at(&self, node: NodeId, axis: JointAxis) -> Option<JointDof> {
        let scene = &self.document.scene;
        match axis {
            JointAxis::Flexion => {
                let mut joints = self.document.rigs().flat_map(|(rig, _)| rig.joints().map(|(_, joint)| joint));
                let named = self.document.muscles_joint().filter(|joint| joint.node == node);
                named
                    .or_else(|| joints.find(|joint| joint.node == node))
                    .or_else(|| JointDof::at_node(scene, &self.document.clips, node))
                    .or_else(|| Some(JointDof::about(scene, node, DVec3::Z)))
            }
            JointAxis::Own(axis) => Some(JointDof::about(scene, node, [DVec3::X, DVec3::Y, DVec3::Z].into_iter().nth(axis)?)),
        }
    }

    /// The joint and axis that were chosen; `None` = the joint that is found.
    pub fn chosen_joint(&self) -> Option<(NodeId, JointAxis)> {
        self.joint.slider.chosen
    }

    /// Chooses which joint the slider turns; `None` = the one that is found. The one before goes back to the clip.
    pub fn choose_joint(&mut self, chosen: Option<(NodeId, JointAxis)>) {
        let chosen = chosen.filter(|(node, _)| node.index() < self.document.scene.graph.len());
        if chosen != self.joint.slider.chosen {
            self.joint.slider.chosen = chosen;
            self.joint.joint = OnceCell::new();
            self.state.joints.rotation = None;
            self.changed(ChangeSet::DRIVE);
        }
    }

    /// The joints that can be chosen: those of all skeletons, muscles' own arms left out.
    pub fn turnable(&self) -> Vec<NodeId> {
        bones(&self.document)
    }

    /// Whether the joint turns on top of what the clip does; else instead of it.
    pub fn is_on_top(&self) -> bool {
        self.joint.slider.on_top
    }

    /// Turns on top of the clip, or instead of it. The pose stays as it is.
    pub fn set_on_top(&mut self, on_top: bool) {
        if on_top == self.joint.slider.on_top {
            return;
        }
        self.joint.slider.on_top = on_top;
        if let (Some(turn), Some(joint)) = (self.state.joints.rotation, self.joint()) {
            self.state.joints.rotation = match self.joint_angle() {
                Some(angle) if on_top => {
                    self.state.joints.rotation = None;
                    self.needs_posing = true;
                    Some(joint.relative(angle - self.joint_angle().unwrap_or(angle)))
                }
                Some(angle) => Some(joint.absolute(angle)),
                None => Some(turn),
            };
        }
        self.changed(ChangeSet::DRIVE);
    }

    /// The angle of the clip's joint in the present pose, degrees.
    pub fn joint_angle(&mut self) -> Option<f64> {
        let joint = self.joint()?;
        self.frame();
        joint.angle(&self.document.scene, &self.frame.world)
    }

    /// What the elbow slider shows; `None` where nothing can be bent.
    pub fn angle_slider(&mut self) -> Option<SliderState> {
        if let Some(range) = self.document.driven_rig().and_then(|rig| rig.flexion_range()) {
            return Some(SliderState { value: self.state.joints.drive.flexion, range, is_manual: false });
        }
        let joint = self.joint()?;
        let [low, high] = joint.range;
        let by_hand = self.state.joints.rotation.is_some();
        if self.joint.slider.on_top {
            let value = self.state.joints.rotation.map_or(0.0, |turn| turn.degrees);
            return Some(SliderState { value, range: low - high..=high - low, is_manual: by_hand });
        }
        // A clip may bend a joint beyond the range of the slider.
        let value = self.joint_angle()?;
        Some(SliderState { value, range: low..=high, is_manual: by_hand })
    }

    /// Bends the clip's joint: to an angle, or by one on top of the clip. Degrees, held within the range.
    pub fn set_joint_angle(&mut self, degrees: f64) {
        let Some(joint) = self.joint().filter(|_| degrees.is_finite()) else { return };
        let [low, high] = joint.range;
        let turn = if self.joint.slider.on_top { joint.relative(degrees.clamp(low - high, high - low)) } else { joint.absolute(degrees) };
        self.set_joint_rotation(Some(turn));
    }

    /// Gives the joint back to the clip.
    pub fn release_joint(&mut self) {
        self.set_joint_rotation(None);
    }

    fn set_joint_rotation(&mut self, turn: Option<JointRotation>) {
        if turn != self.state.joints.rotation {
            self.state.joints.rotation = turn;
            self.changed(ChangeSet::DRIVE);
        }
    }

    /// A hand bends the elbow of the arm, or the joint of the clip; undo takes that back.
    pub fn set_angle_undoable(&mut self, degrees: f64) {
        self.undoable(message!("app-edit-bend"), UndoStep::near(0), |session| session.set_flexion(degrees));
    }

    /// A hand bends the joint that muscle `muscle` is measured over, by its number among those of its file; undo takes that back.
    pub fn bend_measured_undoable(&mut self, muscle: MuscleId, joint: usize, degrees: f64) {
        let measured = self.document.muscle(muscle).and_then(|(rig, _)| rig.joints().nth(joint)).map(|(_, joint)| joint.node);
        self.undoable(message!("app-edit-bend"), UndoStep::near(0), |session| {
            // The first joint is what the slider turns anyway.
            if let Some(node) = measured.filter(|node| joint > 0 || session.chosen_joint().is_some_and(|(chosen, _)| chosen != *node)) {
                session.choose_joint(Some((node, JointAxis::Flexion)));
            }
            session.set_flexion(degrees);
        });
    }

    /// A hand sets the contraction; undo takes that back.
    pub fn set_contraction_undoable(&mut self, per_cent: f64) {
        self.undoable(message!("app-edit-contract"), UndoStep::near(0), |session| session.set_contraction(per_cent));
    }

    /// A hand gives the joint back to the clip; undo takes that back.
    pub fn release_undoable(&mut self) {
        self.undoable(message!("app-edit-release"), UndoStep::New, Self::release_joint);
    }

    /// Says that a joint stands still, whatever the clip does, and at which angle; `None` where none does.
    pub fn held_joint_text(&mut self) -> Option<Message> {
        let turn = self.state.joints.rotation.filter(|turn| !turn.on_top && self.playback.duration() > 0.0)?;
        let angle = signed(self.joint_angle()?, 0);
        let elbow = self.joint.slider.chosen.is_none() && self.found_elbow().is_some_and(|elbow| elbow.node == turn.node);
        Some(match elbow {
            true => message!("app-joint-held-elbow", angle = angle),
            false => message!("app-joint-held", joint = self.document.scene.graph.label(turn.node), angle = angle),
        })
    }

    pub(super) fn joint_slider(&self) -> JointSlider {
        self.joint.slider
    }

    pub(super) fn restore_joint_slider(&mut self, slider: JointSlider) {
        if slider.chosen != self.joint.slider.chosen {
            self.joint.joint = OnceCell::new();
        }
        self.joint.slider = slider;
    }

    /// How the clip's joint drives the muscle that is shown; `None` where it does not.
    fn driving(&mut self) -> Option<Driving<'_>> {
        let joint = self.joint()?;
        self.frame();
        let (rig, index) = self.document.muscle(self.shown_muscle)?;
        rig.driven_by(index, &joint, &self.document.scene, &self.frame.world)
    }

    /// The contraction of the muscle that is shown, per cent; `None` where neither an arm, nor the joint, nor the slider sets it.
    pub fn contraction(&mut self) -> Option<f64> {
        if self.contracts_freely() {
            return Some(self.state.joints.drive.contraction);
        }
        let angle = self.joint_angle()?;
        self.driving().map(|driving| driving.at_angle(angle).contraction)
    }

    /// Whether contraction is a state of its own: on an arm, or of a muscle that nothing holds.
    pub(super) fn contracts_freely(&self) -> bool {
        let free = self.document.muscle(self.shown_muscle).is_some_and(|(rig, index)| !rig.is_attached(index));
        self.bends_arm() || free
    }

    /// Bends the clip's joint so that the muscle shown has this contraction.
    pub(super) fn contract_by_joint(&mut self, per_cent: f64) {
        let Some(present) = self.joint_angle() else { return };
        let Some(MuscleState { flexion, .. }) = self.driving().map(|driving| driving.at_contraction(per_cent)) else { return };
        let turned = self.state.joints.rotation.filter(|turn| turn.on_top).map_or(0.0, |turn| turn.degrees);
        // What the clip does by itself. The angle in the pose is known but for whole turns, and the user may bend the joint past half of one.
        let own = (present - turned + 180.0).rem_euclid(360.0) - 180.0;
        self.set_joint_angle(if self.joint.slider.on_top { flexion - own } else { flexion });
    }

    /// The controlled joint, to find it again after a reload.
    pub(super) fn joint_for_reload(&self) -> Option<(String, Option<JointAxis>, Option<f64>)> {
        let joint = self.joint.joint.get().copied().flatten()?;
        let name = self.document.scene.graph.label(joint.node).plain().into_owned();
        let turned = self.state.joints.rotation.map(|turn| if turn.on_top { turn.degrees } else { turn.degrees + joint.at_rest });
        Some((name, self.joint.slider.chosen.map(|(_, axis)| axis), turned))
    }

    /// Turns that joint again.
    pub(super) fn restore_joint(&mut self, kept: Option<(String, Option<JointAxis>, Option<f64>)>) {
        let Some((name, axis, turned)) = kept else { return };
        let chosen = axis.and_then(|axis| Some((self.document.scene.graph.find(&name)?, axis)));
        self.choose_joint(chosen);
        let same = self.joint().is_some_and(|joint| self.document.scene.graph.label(joint.node).is(&name));
        if let Some(degrees) = turned.filter(|_| same) {
            self.set_joint_angle(degrees);
        }
    }

    /// Forgets what was known of another document's joints.
    pub(super) fn clear_joint(&mut self) {
        let slider = JointSlider { on_top: self.joint.slider.on_top, ..JointSlider::default() };
        self.joint = JointController { slider, ..JointController::default() };
    }
}

/// The bones of all skeletons, without those of muscles' own arms; where there are no joints, all nodes.
pub(super) fn bones(document: &Document) -> Vec<NodeId> {
    let graph = &document.scene.graph;
    let mut own = vec![false; graph.len()];
    for root in document.rig_roots() {
        graph.subtree(root).into_iter().for_each(|id| own[id.index()] = true);
    }
    let of_kind =
        |kind: NodeKind| graph.iter().filter(|(id, node)| node.kind == kind && !own[id.index()]).map(|(id, _)| id).collect::<Vec<_>>();
    let joints = of_kind(NodeKind::Joint);
    if joints.is_empty() { of_kind(NodeKind::Node) } else { joints }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::tests::{biceps, clip};

    #[test]
    fn contraction_and_the_joint_of_a_clip_are_one_state() {
        let mut session = clip();
        assert_eq!((session.contraction(), session.angle_slider().map(|bend| bend.range)), (None, Some(0.0..=150.0)));
        session.new_muscle(biceps()).unwrap();
        for (on_top, time) in [(false, 0.0), (true, 0.0), (true, 1.3)] {
            session.set_on_top(on_top);
            session.time(|cursor| cursor.seek(time));
            session.set_contraction(60.0);
            let (angle, contraction) = (session.joint_angle().unwrap(), session.contraction().unwrap());
            assert!((contraction - 60.0).abs() < 1e-6, "{contraction}");
            session.set_contraction(10.0);
            let bend = session.angle_slider().unwrap().value + angle - session.joint_angle().unwrap();
            session.set_flexion(bend);
            assert!((session.contraction().unwrap() - 60.0).abs() < 1e-6);
        }
        let turned = session.joint_angle();
        session.set_on_top(false);
        assert!((session.joint_angle().unwrap() - turned.unwrap()).abs() < 1e-6, "the pose stays");
        session.release_joint();
        assert_eq!(session.state().joints.rotation, None);
    }

    #[test]
    fn the_slider_does_what_the_command_line_does() {
        let mut session = clip();
        let joint = session.document().joint().unwrap();
        session.set_flexion(75.0);
        assert_eq!(session.state().joints.rotation, Some(joint.absolute(75.0)));
        session.set_on_top(true);
        session.set_flexion(-20.0);
        assert_eq!(session.state().joints.rotation, Some(joint.relative(-20.0)));
    }

    #[test]
    fn another_joint_turns_about_its_own_axis() {
        let mut session = clip();
        let hand = session.document().scene.graph.find("hand").unwrap();
        session.choose_joint(Some((hand, JointAxis::Own(0))));
        session.set_flexion(40.0);
        assert!((session.joint_angle().unwrap() - 40.0).abs() < 1e-9);
        assert_eq!(session.angle_slider().unwrap().range, -150.0..=150.0);
        session.choose_joint(None);
        assert_eq!((session.state().joints.rotation, session.chosen_joint()), (None, None));
    }
}
