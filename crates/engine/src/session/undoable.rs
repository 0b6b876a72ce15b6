//! Undoable edits of a session's pose: elbow, contraction, transform of the model.

use glam::DVec2;

use super::history::{Snapshot, UndoStep};
use super::{ChangeSet, Gizmo, ModelDrag, ModelTransform, Session, Tool};
use crate::document::JointControl;
use sinew_muscle::MuscleState;
use sinew_scene::NodeId;
use sinew_scene::message::Message;

impl Session {
    /// How joints are turned by hand.
    pub fn joint_control(&self) -> &JointControl {
        &self.state.joints
    }

    /// Elbow angle and contraction.
    pub fn drive(&self) -> MuscleState {
        self.state.joints.drive
    }

    /// Sets the elbow angle of the arm or of the clip's joint (see [`Session::angle_slider`]), degrees; the contraction follows.
    pub fn set_flexion(&mut self, degrees: f64) {
        if !self.bends_arm() {
            return self.set_joint_angle(degrees);
        }
        let drive = self.document.driven_rig().filter(|_| degrees.is_finite()).map(|rig| rig.at_flexion(degrees));
        self.set_drive(drive);
    }

    /// Sets the contraction, per cent; the elbow angle follows.
    pub fn set_contraction(&mut self, per_cent: f64) {
        if !self.contracts_freely() && per_cent.is_finite() {
            return self.contract_by_joint(per_cent.clamp(0.0, 100.0));
        }
        let drive = self.document.driven_rig().filter(|_| per_cent.is_finite()).map(|rig| rig.at_contraction(per_cent.clamp(0.0, 100.0)));
        self.set_drive(drive);
    }

    fn set_drive(&mut self, drive: Option<MuscleState>) {
        if let Some(drive) = drive.filter(|drive| *drive != self.state.joints.drive) {
            self.state.joints.drive = drive;
            self.changed(ChangeSet::DRIVE);
        }
    }

    /// The model's transform.
    pub fn model(&self) -> &ModelTransform {
        &self.model
    }

    /// Changes the model's transform; within [`Session::undoable`] undo takes it back.
    pub fn change_model(&mut self, change: impl FnOnce(&mut ModelTransform)) {
        let before = self.model;
        change(&mut self.model);
        if before != self.model {
            self.changed(ChangeSet::MODEL);
        }
    }

    /// The tool in hand.
    pub fn tool(&self) -> Tool {
        self.tool
    }

    /// Takes a tool.
    pub fn set_tool(&mut self, tool: Tool) {
        if tool != self.tool {
            self.tool = tool;
            self.changed(ChangeSet::TOOL);
        }
    }

    /// Works with the handles of the tool in hand, in a picture of this size (logical pixels); `None` where it has none.
    pub fn with_gizmo<T>(&mut self, size: DVec2, work: impl FnOnce(&Gizmo) -> T) -> Option<T> {
        if self.tool == Tool::Navigate || self.is_empty() {
            return None;
        }
        self.frame();
        let camera = self.view.camera.camera(&self.document.scene, &self.frame);
        let middle = self.model.pivot + self.model.translation;
        Some(work(&Gizmo { tool: self.tool, camera: &camera, size, middle }))
    }

    /// The model follows a drag of a handle that came to `to`, in a picture of this size (logical pixels); with `snap` by whole steps.
    pub fn drag_model(&mut self, drag: &ModelDrag, to: DVec2, size: DVec2, snap: bool) {
        let middle = drag.start.pivot + drag.start.translation;
        let dragged = self.with_gizmo(size, |handles| Gizmo { middle, ..*handles }.dragged(drag, to, snap));
        if let Some(dragged) = dragged {
            self.change_model(|model| *model = dragged);
        }
    }

    /// Does something that undo takes back; `what` says it in the user's language. Where nothing changed there is nothing to take back. Steps within it
    /// are parts of it.
    pub fn undoable<T>(&mut self, what: Message, step: UndoStep, change: impl FnOnce(&mut Self) -> T) -> T {
        if self.history.inside {
            return change(self);
        }
        let before = self.snapshot();
        self.history.inside = true;
        let result = change(self);
        self.history.inside = false;
        if self.snapshot() != before {
            self.history.push_undo(before, what, step);
            self.changed(ChangeSet::HISTORY);
        }
        result
    }

    /// What undo and redo would take back and do again, in the user's language.
    pub fn undo_names(&self) -> (Option<&Message>, Option<&Message>) {
        self.history.names()
    }

    /// Whether there is a step back, and one forward.
    pub fn undo_counts(&self) -> (bool, bool) {
        (self.history.can_undo(), self.history.can_redo())
    }

    /// Goes back one step.
    pub fn undo(&mut self) {
        let step = self.history.undo(self.snapshot());
        self.restore(step);
    }

    /// Goes forward one step.
    pub fn redo(&mut self) {
        let step = self.history.redo(self.snapshot());
        self.restore(step);
    }

    fn snapshot(&self) -> Snapshot {
        let hidden = self.document.scene.graph.iter().filter(|(_, node)| !node.visible).map(|(id, _)| id).collect();
        Snapshot {
            model: self.model,
            light: self.view.light,
            hidden,
            files: self.document.muscle_files().cloned().collect(),
            joints: self.state.joints.clone(),
            slider: self.joint_slider(),
        }
    }

    fn restore(&mut self, step: Option<Snapshot>) {
        if let Some(step) = step {
            if step.hidden != self.snapshot().hidden {
                self.isolated = None;
            }
            (self.model, self.view.light) = (step.model, step.light);
            self.put_muscle_files(&step.files);
            for index in 0..self.document.scene.graph.len() as u32 {
                let id = NodeId(index);
                self.document.scene.graph.node_mut(id).visible = step.hidden.binary_search(&id).is_err();
            }
            self.state.joints = step.joints;
            self.restore_joint_slider(step.slider);
            self.changed(ChangeSet::MODEL | ChangeSet::LIGHT | ChangeSet::DISPLAY | ChangeSet::JOINT_OVERRIDES | ChangeSet::DRIVE);
        }
        self.changed(ChangeSet::HISTORY);
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use proptest::prelude::*;

    use super::super::history::History;
    use super::*;
    use crate::session::tests::{biceps, clip};
    use sinew_muscle::Edit;
    use sinew_scene::MuscleId;
    use sinew_scene::message::ToMessage;

    /// An edit of the user.
    #[derive(Debug, Clone, Copy)]
    enum TestEdit {
        Bend(f64),
        Contract(f64),
        Turn(u32, f64),
        Radius(usize, f64),
        Move(u32, f64),
        Hide(u32),
        Release,
        OnTop(bool),
        Undo,
        Redo,
    }

    impl TestEdit {
        /// What it is called, and what of; `None` for undo and redo.
        fn what(self) -> Option<(Message, u32)> {
            let (key, of) = match self {
                Self::Bend(_) => ("bend", 0),
                Self::Contract(_) => ("contract", 0),
                Self::Turn(node, _) => ("turn", node),
                Self::Radius(node, value) => return Some((Edit::Radius(node, value).message(), 0)),
                Self::Move(axis, _) => ("move", axis),
                Self::Hide(_) => ("hide", 0),
                Self::Release => ("release", 0),
                Self::OnTop(_) => ("on top", 0),
                Self::Undo | Self::Redo => return None,
            };
            Some((Message::new(key, Vec::new()), of))
        }

        fn change(self, session: &mut Session) {
            match self {
                Self::Bend(degrees) => session.set_flexion(degrees),
                Self::Contract(per_cent) => session.set_contraction(per_cent),
                Self::Turn(node, degrees) => session.override_joint(NodeId(node), glam::DVec3::new(degrees, 0.0, 0.0)),
                Self::Move(axis, by) => session.change_model(|model| model.translation[axis as usize] = by),
                Self::Hide(node) => session.document.scene.graph.node_mut(NodeId(node)).visible ^= true,
                Self::Release => session.release_joint(),
                Self::OnTop(on_top) => session.set_on_top(on_top),
                Self::Radius(..) | Self::Undo | Self::Redo => {}
            }
        }

        fn apply(self, session: &mut Session, step: UndoStep) {
            match (self, self.what()) {
                (Self::Undo, _) => session.undo(),
                (Self::Redo, _) => session.redo(),
                (Self::Radius(node, value), _) => {
                    session.edit_muscle(MuscleId(0), &Edit::Radius(node, value), step).expect("a sound radius");
                }
                (deed, Some((what, _))) => session.undoable(what, step, |session| deed.change(session)),
                (_, None) => {}
            }
        }
    }

    fn deed() -> impl Strategy<Value = TestEdit> {
        // Few values, so that some are set twice and some come back.
        let degrees = prop::sample::select(vec![10.0, 40.0, 90.0]);
        prop_oneof![
            degrees.clone().prop_map(TestEdit::Bend),
            degrees.clone().prop_map(TestEdit::Contract),
            (1..3_u32, degrees).prop_map(|(node, degrees)| TestEdit::Turn(node, degrees)),
            (1..3_usize, prop::sample::select(vec![20.0, 25.0])).prop_map(|(node, radius)| TestEdit::Radius(node, radius)),
            (0..2_u32, prop::sample::select(vec![0.0, 1.0])).prop_map(|(axis, by)| TestEdit::Move(axis, by)),
            (0..2_u32).prop_map(TestEdit::Hide),
            Just(TestEdit::Release),
            any::<bool>().prop_map(TestEdit::OnTop),
            Just(TestEdit::Undo),
            Just(TestEdit::Undo),
            Just(TestEdit::Redo),
        ]
    }

    /// What undo should be: the states that were, and which of them is the present one.
    struct HistoryModel {
        states: Vec<Snapshot>,
        present: usize,
        /// What was changed last and when, while it may go on.
        open: Option<(Message, u32, Duration, bool)>,
    }

    impl HistoryModel {
        fn changed(&mut self, to: Snapshot, (what, of): (Message, u32), now: Duration, near: bool, same: bool) {
            if to == self.states[self.present] {
                return;
            }
            let goes_on = self.open.as_ref().is_some_and(|(last, last_of, then, was_near)| {
                let at_once = near && *was_near && *last_of == of && now - *then < History::GESTURE;
                *last == what && (same || at_once)
            });
            self.states.truncate(self.present + 1);
            if goes_on {
                self.states[self.present] = to;
            } else {
                self.states.push(to);
                self.present += 1;
            }
            self.open = Some((what, of, now, near));
        }

        /// To the nearest state before or after that is another one; those between say the same as the present and are of no use.
        fn move_in_history(&mut self, back: bool) {
            self.open = None;
            let other = |index: &usize| self.states[*index] != self.states[self.present];
            if back {
                if let Some(to) = (0..self.present).rev().find(other) {
                    self.states.drain(to + 1..self.present);
                    self.present = to;
                }
            } else if let Some(to) = (self.present + 1..self.states.len()).find(other) {
                self.states.drain(self.present + 1..to);
                self.present += 1;
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]

        #[test]
        fn undo_and_redo_go_through_what_was_whatever_is_done_and_however_fast(
            deeds in prop::collection::vec((deed(), 0..3_usize, prop::sample::select(vec![1_u64, 300, 900])), 1..40)
        ) {
            let mut session = clip();
            session.new_muscle(biceps()).expect("a muscle");
            session.history = History::default();
            let begun = Instant::now();
            let mut now = Duration::ZERO;
            let mut model = HistoryModel { states: vec![session.snapshot()], present: 0, open: None };
            for (deed, how, gap) in deeds {
                now += Duration::from_millis(gap);
                let of = deed.what().map_or(0, |(_, of)| of);
                let step = [UndoStep::New, UndoStep::Same, UndoStep::Near { of, now: begun + now }][how];
                deed.apply(&mut session, step);
                match deed {
                    TestEdit::Undo => model.move_in_history(true),
                    TestEdit::Redo => model.move_in_history(false),
                    _ => model.changed(session.snapshot(), deed.what().expect("a name"), now, how == 2, how == 1),
                }
                prop_assert!(session.snapshot() == model.states[model.present], "after {deed:?}");
            }
            // All the way back and all the way forth.
            while model.present > 0 {
                let before = model.present;
                session.undo();
                model.move_in_history(true);
                prop_assert!(session.snapshot() == model.states[model.present]);
                if model.present == before {
                    break;
                }
            }
            let first = session.snapshot();
            while model.present + 1 < model.states.len() {
                let before = model.present;
                session.redo();
                model.move_in_history(false);
                prop_assert!(session.snapshot() == model.states[model.present]);
                if model.present == before {
                    break;
                }
            }
            prop_assert!(model.states[0] == first);
        }
    }

    #[test]
    fn bending_by_the_slider_is_undone_and_an_edit_after_an_undo_is_a_step_of_its_own() {
        let mut session = clip();
        let turn = |session: &Session| session.state().joints.rotation;
        session.set_angle_undoable(50.0);
        session.set_angle_undoable(107.0);
        let bent = turn(&session);
        assert_eq!(session.undo_names().0, Some(&sinew_scene::message!("app-edit-bend")));
        session.undo();
        assert_eq!((turn(&session), session.undo_counts()), (None, (false, true)));
        // At once, of the same value: within what would be one gesture.
        session.set_angle_undoable(30.0);
        let again = turn(&session);
        assert_eq!(session.undo_counts(), (true, false));
        session.undo();
        assert_eq!(turn(&session), None);
        session.redo();
        assert_eq!(turn(&session), again);
        session.set_angle_undoable(107.0);
        assert!(
            turn(&session) == bent
                && session.held_joint_text().is_some_and(|told| told.parameter("angle") == Some(&sinew_scene::message::signed(107.0, 0)))
        );
        session.release_undoable();
        assert_eq!((turn(&session), session.held_joint_text()), (None, None));
        session.undo();
        assert_eq!(turn(&session), bent);
        session.undo();
        assert_eq!(turn(&session), again);
        session.set_on_top(true);
        session.set_angle_undoable(20.0);
        assert_eq!(session.held_joint_text(), None, "the clip goes on moving it");
    }
}
