//! What a hand changes in a session: elbow and contraction, the model's place, and undo.

use glam::DVec2;

use super::history::Snapshot;
use super::{Changes, Handles, ModelDrag, ModelTransform, Session, Tool};
use crate::muscle::Drive;
use crate::scene::NodeId;
use crate::tr;

impl Session {
    /// Elbow angle and contraction.
    pub fn drive(&self) -> Drive {
        self.state.drive
    }

    /// Sets the elbow angle of the arm or of the clip's joint (see [`Session::bend`]), degrees; the contraction follows.
    pub fn set_flexion(&mut self, degrees: f64) {
        if !self.bends_arm() {
            return self.set_bend(degrees);
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

    fn set_drive(&mut self, drive: Option<Drive>) {
        if let Some(drive) = drive.filter(|drive| *drive != self.state.drive) {
            self.state.drive = drive;
            self.changed(Changes::DRIVE);
        }
    }

    /// The model's transform.
    pub fn model(&self) -> &ModelTransform {
        &self.model
    }

    /// Changes the model's transform. Call [`Session::remember`] before the first change of a gesture.
    pub fn change_model(&mut self, change: impl FnOnce(&mut ModelTransform)) {
        let before = self.model;
        change(&mut self.model);
        if before != self.model {
            self.changed(Changes::MODEL);
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
            self.changed(Changes::TOOL);
        }
    }

    /// Works with the handles of the tool in hand, in a picture of this size (logical pixels); `None` where it has none.
    pub fn with_handles<T>(&mut self, size: DVec2, work: impl FnOnce(&Handles) -> T) -> Option<T> {
        if self.tool == Tool::Navigate || self.is_empty() {
            return None;
        }
        self.frame();
        let camera = self.eye.camera(&self.document.scene, &self.frame);
        let middle = self.model.pivot + self.model.translation;
        Some(work(&Handles { tool: self.tool, camera: &camera, size, middle }))
    }

    /// The model follows a drag of a handle that came to `to`, in a picture of this size (logical pixels); with `snap` by whole steps.
    pub fn drag_model(&mut self, drag: &ModelDrag, to: DVec2, size: DVec2, snap: bool) {
        let middle = drag.start.pivot + drag.start.translation;
        let dragged = self.with_handles(size, |handles| Handles { middle, ..*handles }.dragged(drag, to, snap));
        if let Some(dragged) = dragged {
            self.change_model(|model| *model = dragged);
        }
    }

    /// Makes the present state a step that can be gone back to.
    pub fn remember(&mut self) {
        self.remember_as("app-edit-change");
    }

    /// Makes the present state a step that can be gone back to, with the catalogue's key for what is done now.
    pub fn remember_as(&mut self, what: &'static str) {
        self.remember_named(tr!(what));
    }

    /// [`Session::remember_as`] with the words themselves.
    pub fn remember_named(&mut self, what: String) {
        self.history.remember(self.snapshot(), what);
        self.changed(Changes::HISTORY);
    }

    /// What undo and redo would take back and do again, in the user's language.
    pub fn step_names(&self) -> (Option<&str>, Option<&str>) {
        self.history.names()
    }

    /// Whether there is a step back, and one forward.
    pub fn steps(&self) -> (bool, bool) {
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
            light: self.light,
            hidden,
            files: self.document.muscle_files().cloned().collect(),
            turned: self.document.hand_turns().to_vec(),
        }
    }

    fn restore(&mut self, step: Option<Snapshot>) {
        if let Some(step) = step {
            if step.hidden != self.snapshot().hidden {
                self.isolated = None;
            }
            (self.model, self.light) = (step.model, step.light);
            self.put_muscle_files(&step.files);
            for index in 0..self.document.scene.graph.len() as u32 {
                let id = NodeId(index);
                self.document.scene.graph.node_mut(id).visible = step.hidden.binary_search(&id).is_err();
            }
            self.document.set_hand_turns(&step.turned);
            self.changed(Changes::MODEL | Changes::LIGHT | Changes::DISPLAY | Changes::HAND);
        }
        self.changed(Changes::HISTORY);
    }
}
