//! Motion path of the selected node over the clip.

use glam::{DMat4, DVec3, Vec3};

use super::pose_context::{PoseContext, color};
use crate::document::PoseState;
use sinew_scene::{Frame, NodeId, OverlayLine};

/// Most line segments of a path, and most dots on it.
const MAX_SEGMENTS: usize = 600;

/// Positions of a node over the clip, without the model's own transform.
#[derive(Debug, Default)]
pub(super) struct MotionPath {
    positions: Vec<DVec3>,
    key_positions: Vec<DVec3>,
}

impl MotionPath {
    /// Draws the path of a node into the frame, with dots at its keys and at the present time; fills `cached` where it is empty.
    pub(super) fn draw(cached: &mut Option<Self>, context: &PoseContext<'_>, node: NodeId, frame: &mut Frame) {
        let clip = context.state.clip.and_then(|clip| context.document.clips.get(clip));
        let Some(clip) = clip.filter(|clip| clip.duration() > 0.0) else { return };
        let path = cached.get_or_insert_with(|| {
            let untransformed = PoseState { model: DMat4::IDENTITY, ..context.state.clone() };
            let samples = ((clip.duration() * context.frame_rate).ceil() as usize).clamp(1, MAX_SEGMENTS) + 1;
            let keys = clip.key_times(Some(node));
            Self {
                positions: context.document.node_path(&untransformed, node, samples).into_iter().map(|(_, place)| place).collect(),
                key_positions: context.document.node_positions(&untransformed, node, keys.get(..MAX_SEGMENTS).unwrap_or(&keys)),
            }
        });
        let color = color(context.selection_color);
        let place = |place: &DVec3| context.state.model.transform_point3(*place).as_vec3();
        let mark = |from: Vec3, to: Vec3, width: f32, opacity: f32| OverlayLine { from, to, color, opacity, width };
        let ends = path.positions.iter().zip(path.positions.iter().skip(1));
        let now = frame.position(node);
        let marks = &mut frame.overlay_lines;
        marks.extend(ends.map(|(from, to)| (place(from), place(to))).filter(|(from, to)| from != to).map(|(a, b)| mark(a, b, 1.8, 0.9)));
        marks.extend(path.key_positions.iter().map(place).map(|key| mark(key, key, 5.5, 1.0)));
        marks.push(mark(now, now, 9.0, 1.0));
    }
}
