//! Joints over the time of a clip.

use glam::{DMat4, DVec3};
use rustc_hash::FxHashMap;

use super::{Document, PoseBuffers, PoseState, angle_at};
use sinew_muscle::rotation;
use sinew_scene::{Frame, NodeId};

/// One joint at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointSample {
    /// Seconds on the clip's own axis, held between its ends.
    pub time: f64,
    /// The angle between the bone that ends at the joint and the one that begins there, degrees: 0 where the two are in line. `None` for a joint with
    /// no joint above or below it. Where several are below, the one that most others hang on counts.
    pub flexion: Option<f64>,
    /// How the joint is turned from its rest pose, in the axes of the node above it: the axis times the angle, degrees from 0 to 180. `None` where a
    /// matrix is flat and has no rotation.
    pub turn: Option<DVec3>,
}

/// One joint over time.
#[derive(Debug, Clone, PartialEq)]
pub struct JointTrack {
    /// The joint.
    pub node: NodeId,
    /// One sample a time.
    pub samples: Vec<JointSample>,
}

impl Document {
    /// What every joint does at these times of the clip that `state` names; all else stays as `state` has it.
    pub fn joint_angles(&self, state: &PoseState, times: &[f64]) -> Vec<JointTrack> {
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        self.pose_nodes(state, &mut buffers, &mut frame);
        let next = next_joints(&frame);
        let mut tracks: Vec<JointTrack> =
            frame.joints.iter().map(|joint| JointTrack { node: joint.node, samples: Vec::with_capacity(times.len()) }).collect();
        let clip = state.clip.and_then(|clip| self.clips.get(clip));
        for time in times {
            let time = clip.map_or(*time, |clip| time.max(clip.start).min(clip.end.max(clip.start)));
            self.pose_nodes(&PoseState { time, ..state.clone() }, &mut buffers, &mut frame);
            for ((track, joint), next) in tracks.iter_mut().zip(&frame.joints).zip(&next) {
                let flexion = joint.parent.zip(*next).and_then(|(above, below)| Some(180.0 - angle_at(&frame, above, joint.node, below)?));
                track.samples.push(JointSample { time, flexion, turn: self.joint_rotation(&frame, joint.node) });
            }
        }
        tracks
    }

    fn joint_rotation(&self, frame: &Frame, node: NodeId) -> Option<DVec3> {
        let own = self.scene.graph.node(node);
        let above = own.parent().map_or(Some(&DMat4::IDENTITY), |parent| frame.world.get(parent.index()))?;
        if above.determinant().abs() <= f64::MIN_POSITIVE {
            return None;
        }
        let local = above.inverse() * *frame.world.get(node.index())?;
        let turn = rotation(&local)? * rotation(&own.transform.matrix())?.inverse();
        // Of the two quaternions of a rotation the one of the shorter way round.
        let turn = if turn.w < 0.0 { -turn } else { turn };
        let sine = turn.xyz().length();
        let angle = 2.0 * sine.atan2(turn.w).to_degrees();
        let vector = turn.xyz().try_normalize().map_or(DVec3::ZERO, |axis| axis * angle);
        vector.is_finite().then_some(vector)
    }
}

/// For each joint of the frame the joint below it, where there is one: of several the one that most joints hang on, the first of equals.
fn next_joints(frame: &Frame) -> Vec<Option<NodeId>> {
    let places: FxHashMap<NodeId, usize> = frame.joints.iter().zip(0..).map(|(joint, place)| (joint.node, place)).collect();
    let above: Vec<Option<usize>> = frame.joints.iter().map(|joint| places.get(&joint.parent?).copied()).collect();
    let mut below = vec![0_u32; above.len()];
    // Joints stand behind the one they hang on, so the last are counted first.
    for (index, above) in above.iter().enumerate().rev() {
        if let Some(above) = above {
            below[*above] += below[index] + 1;
        }
    }
    let mut next: Vec<Option<usize>> = vec![None; above.len()];
    for (index, above) in above.iter().enumerate() {
        if let Some(above) = above
            && next[*above].is_none_or(|known| below[known] < below[index])
        {
            next[*above] = Some(index);
        }
    }
    next.into_iter().map(|index| index.and_then(|index| frame.joints.get(index)).map(|joint| joint.node)).collect()
}
