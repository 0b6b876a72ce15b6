//! Angles between bones and paths of bones, over a clip.

use glam::DVec3;

use super::{Document, PoseBuffers, PoseState};
use sinew_scene::{Frame, NodeId};

/// The angle at `corner` between the directions to `from` and to `to`, degrees from 0 to 180; `None` where two of them coincide.
pub fn angle_at(frame: &Frame, from: NodeId, corner: NodeId, to: NodeId) -> Option<f64> {
    let position = |node: NodeId| Some(frame.world.get(node.index())?.w_axis.truncate());
    let (a, b) = (position(from)? - position(corner)?, position(to)? - position(corner)?);
    // atan2 keeps its digits near 0° and 180°, where the arc cosine loses half of them.
    let angle = a.cross(b).length().atan2(a.dot(b)).to_degrees();
    (a.length_squared() > 0.0 && b.length_squared() > 0.0 && angle.is_finite()).then_some(angle)
}

impl Document {
    /// Walks through the clip of `state` in `samples` even steps (at least 2), nodes only, and hands each time (seconds) with its frame to `visit`.
    /// Without a clip nothing is walked through.
    pub fn sample_clip(&self, state: &PoseState, samples: usize, mut visit: impl FnMut(f64, &Frame)) {
        let Some(clip) = state.clip.and_then(|index| self.clips.get(index)).filter(|clip| clip.duration() > 0.0) else { return };
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        let last = samples.max(2) - 1;
        for step in 0..=last {
            let time = clip.start + clip.duration() * step as f64 / last as f64;
            self.pose_nodes(&PoseState { time, ..state.clone() }, &mut buffers, &mut frame);
            visit(time, &frame);
        }
    }

    /// The angle of three bones over the clip: seconds and degrees, in `samples` even steps.
    pub fn angle_curve(&self, state: &PoseState, [from, corner, to]: [NodeId; 3], samples: usize) -> Vec<(f64, f64)> {
        let mut curve = Vec::with_capacity(samples);
        self.sample_clip(state, samples, |time, frame| curve.extend(angle_at(frame, from, corner, to).map(|angle| (time, angle))));
        curve
    }

    /// Where a node is at some times of the clip of `state`: world positions, metres.
    pub fn node_positions(&self, state: &PoseState, node: NodeId, times: &[f64]) -> Vec<DVec3> {
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        let mut position = |time: f64| {
            self.pose_nodes(&PoseState { time, ..state.clone() }, &mut buffers, &mut frame);
            frame.world.get(node.index()).map_or(DVec3::ZERO, |matrix| matrix.w_axis.truncate())
        };
        times.iter().map(|time| position(*time)).collect()
    }

    /// Where a node goes over the clip: seconds and world positions, in `samples` even steps.
    pub fn node_path(&self, state: &PoseState, node: NodeId, samples: usize) -> Vec<(f64, DVec3)> {
        let mut path = Vec::with_capacity(samples);
        self.sample_clip(state, samples, |time, frame| {
            path.extend(frame.world.get(node.index()).map(|matrix| (time, matrix.w_axis.truncate())));
        });
        path
    }
}
