//! Bounding box of a whole movement, for placing the camera.

use super::{Document, PoseBuffers, PoseState};
use sinew_scene::{Bounds, Frame};

/// Number of poses that are sampled.
const SAMPLES: usize = 17;

impl Document {
    /// Bounding box over the clip of `state`, or, without a moving clip, of the arm from straight to fully bent.
    pub fn motion_bounds(&self, state: &PoseState) -> Bounds {
        let (mut buffers, mut frame, mut bounds) = (PoseBuffers::default(), Frame::default(), Bounds::EMPTY);
        let mut add_pose = |state: &PoseState| {
            self.pose(state, &mut buffers, &mut frame);
            bounds.merge(&frame.bounds);
        };
        let fractions = (0..SAMPLES).map(|i| i as f64 / (SAMPLES - 1) as f64);
        match state.clip.and_then(|index| self.clips.get(index)) {
            Some(clip) if clip.duration() > 0.0 => {
                fractions.for_each(|fraction| add_pose(&state.at_time(clip.start + clip.duration() * fraction)))
            }
            _ => match self.driven_rig().filter(|rig| rig.is_drivable()) {
                Some(rig) => fractions.for_each(|fraction| add_pose(&state.with_drive(rig.at_contraction(100.0 * fraction)))),
                None => add_pose(state),
            },
        }
        bounds
    }
}
