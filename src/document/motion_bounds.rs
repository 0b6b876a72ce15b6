//! The room that a movement takes, so that a camera can stand far enough away from the start.

use super::{Document, PoseBuffers, PoseState};
use crate::scene::{Bounds, Frame};

/// Moments at which the movement is looked at.
const MOMENTS: usize = 17;

impl Document {
    /// The box round everything that `state`'s clip covers, or, where no clip moves anything, the arm from straight to fully bent.
    pub fn reach(&self, state: &PoseState) -> Bounds {
        let (mut buffers, mut frame, mut reach) = (PoseBuffers::default(), Frame::default(), Bounds::EMPTY);
        let mut see = |state: &PoseState| {
            self.pose(state, &mut buffers, &mut frame);
            reach.merge(&frame.bounds);
        };
        let parts = (0..MOMENTS).map(|i| i as f64 / (MOMENTS - 1) as f64);
        match state.clip.and_then(|index| self.clips.get(index)) {
            Some(clip) if clip.duration() > 0.0 => {
                parts.for_each(|part| see(&PoseState { time: clip.start + clip.duration() * part, ..*state }))
            }
            _ => match self.driven_rig().filter(|rig| rig.is_drivable()) {
                Some(rig) => parts.for_each(|part| see(&PoseState { drive: rig.at_contraction(100.0 * part), ..*state })),
                None => see(state),
            },
        }
        reach
    }
}
