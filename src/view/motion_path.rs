//! Motion path of the selected node over the clip.

use glam::{DMat4, DVec3, Vec3};

use super::overlays::{PoseContext, color};
use crate::document::PoseState;
use crate::scene::{Frame, Mark, NodeId};

/// Most pieces of a path, and most dots on it.
const PIECES: usize = 600;

/// Where a node goes over the clip, the model where the file has it.
#[derive(Debug, Default)]
pub(super) struct Trail {
    places: Vec<DVec3>,
    keys: Vec<DVec3>,
}

impl Trail {
    /// Draws the path of a node into the frame, with dots at its keys and at the present moment; `kept` is made where there is none.
    pub(super) fn draw(kept: &mut Option<Self>, host: &PoseContext<'_>, node: NodeId, frame: &mut Frame) {
        let clip = host.state.clip.and_then(|clip| host.document.clips.get(clip));
        let Some(clip) = clip.filter(|clip| clip.duration() > 0.0) else { return };
        let trail = kept.get_or_insert_with(|| {
            let at_home = PoseState { model: DMat4::IDENTITY, ..host.state };
            let pieces = ((clip.duration() * host.rate).ceil() as usize).clamp(1, PIECES) + 1;
            let keys = clip.key_times(Some(node));
            Self {
                places: host.document.node_path(&at_home, node, pieces).into_iter().map(|(_, place)| place).collect(),
                keys: host.document.node_places(&at_home, node, keys.get(..PIECES).unwrap_or(&keys)),
            }
        });
        let paint = color(host.paint);
        let place = |place: &DVec3| host.state.model.transform_point3(*place).as_vec3();
        let mark = |from: Vec3, to: Vec3, width: f32, opacity: f32| Mark { from, to, color: paint, opacity, width };
        let ends = trail.places.iter().zip(trail.places.iter().skip(1));
        let now = frame.position(node);
        let marks = &mut frame.marks;
        marks.extend(ends.map(|(from, to)| (place(from), place(to))).filter(|(from, to)| from != to).map(|(a, b)| mark(a, b, 1.8, 0.9)));
        marks.extend(trail.keys.iter().map(place).map(|key| mark(key, key, 5.5, 1.0)));
        marks.push(mark(now, now, 9.0, 1.0));
    }
}
