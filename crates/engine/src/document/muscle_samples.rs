//! Muscles over the time of a clip that moves their bones.

use super::{Document, PoseBuffers, PoseState, SkinMotion};
use sinew_muscle::MuscleSample;
use sinew_scene::Frame;

impl Document {
    /// Measures all muscles at these times of the clip that `state` names; all else stays as `state` has it. One list a muscle, by
    /// [`sinew_scene::MuscleId`], with one sample a time.
    pub fn measure_times(&self, state: &PoseState, times: &[f64]) -> Vec<Vec<MuscleSample>> {
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        let mut rows: Vec<Vec<MuscleSample>> = vec![Vec::with_capacity(times.len()); self.muscle_count()];
        // Lengths and moment arms do not depend on the skin.
        let state = &PoseState { skin: SkinMotion::Skeleton, ..state.clone() };
        let clip = state.clip.and_then(|clip| self.clips.get(clip));
        for time in times {
            let time = clip.map_or(*time, |clip| time.max(clip.start).min(clip.end.max(clip.start)));
            self.pose(&state.at_time(time), &mut buffers, &mut frame);
            for (rig, first) in self.rigs() {
                let angle = rig.joint().and_then(|joint| joint.angle(&self.scene, &frame.world));
                for index in 0..rig.len() {
                    let id = first.index() + index;
                    let (Some(row), Some(solved)) = (rows.get_mut(id), buffers.solved().get(id)) else { continue };
                    let about = |(_, joint)| rig.moment_arm_about(index, &joint, &self.scene, &frame.world);
                    let moment_arms: Vec<f64> = rig.joints().filter_map(about).collect();
                    let angle = angle.filter(|_| rig.is_attached(index));
                    let moment_arm = moment_arms.first().copied();
                    row.push(MuscleSample { time: Some(time), angle, moment_arm, moment_arms, solved: solved.shape.clone() });
                }
            }
        }
        rows
    }
}
