//! Contraction of a muscle on the bones of a clip, through the joint that it crosses.

use super::{Document, PoseBuffers, PoseState};
use sinew_muscle::JointRotation;
use sinew_scene::{Frame, MuscleId};

impl Document {
    /// How [`Document::joint`] is to be turned in `state` for the first muscle that it lengthens and shortens to have this contraction, 0 to 100 per
    /// cent; `None` where there is no such joint or muscle.
    pub fn joint_rotation_for_contraction(&self, state: &PoseState, per_cent: f64) -> Option<JointRotation> {
        let joint = self.joint()?;
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        self.pose_nodes(&state.with_rotation(None), &mut buffers, &mut frame);
        let driving = (0..self.muscle_count()).find_map(|number| {
            let (rig, index) = self.muscle(MuscleId(number as u32))?;
            rig.driven_by(index, &joint, &self.scene, &frame.world)
        })?;
        Some(joint.absolute(driving.at_contraction(per_cent.clamp(0.0, 100.0)).flexion))
    }
}
