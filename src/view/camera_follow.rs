//! Camera that follows a node that the clip moves.

use glam::Vec3;

use super::Saved;
use crate::document::{Document, PoseBuffers, PoseState};
use crate::scene::{Camera, Frame, NodeId};

/// What a camera goes along with, and where that is at the moment for which the camera stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Along {
    /// The node.
    pub node: NodeId,
    /// Its place in the world then, metres.
    pub from: Vec3,
}

impl Along {
    /// What the camera of a session file goes along with; `state` is the moment that the file keeps. `None` where it stands still.
    pub fn of_saved(saved: &Saved, document: &Document, state: &PoseState) -> Option<Self> {
        let node = saved.follow.as_ref()?.find(document)?;
        let mut frame = Frame::default();
        document.pose_nodes(state, &mut PoseBuffers::default(), &mut frame);
        Some(Self { node, from: frame.position(node) })
    }

    /// The camera moved as far as the node has gone in `frame`.
    pub fn moved(&self, camera: Camera, frame: &Frame) -> Camera {
        let way = frame.position(self.node) - self.from;
        if way.is_finite() { Camera { eye: camera.eye + way, ..camera } } else { camera }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collada::Progress;
    use crate::scene::OrbitCamera;
    use crate::view::name_of;

    #[test]
    fn what_is_followed_stays_where_it_is_in_the_picture() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/configs/walker.dae");
        let document = Document::open(&[file], &Progress::default()).unwrap();
        let hand = document.scene.graph.find("hand.L").unwrap();
        let start = document.start_state();
        let saved = Saved { follow: Some(name_of(&document, hand)), ..Saved::default() };
        let along = Along::of_saved(&saved, &document, &start).unwrap();
        assert_eq!(Along::of_saved(&Saved::default(), &document, &start), None);
        let camera = OrbitCamera::default().camera();
        let mut ways = Vec::new();
        for step in 0..5 {
            let state = PoseState { time: start.time + 0.2 * f64::from(step), ..start };
            let mut frame = Frame::default();
            document.pose_nodes(&state, &mut PoseBuffers::default(), &mut frame);
            let moved = along.moved(camera, &frame);
            assert!(((frame.position(hand) - moved.eye) - (along.from - camera.eye)).length() < 1e-5);
            assert_eq!((moved.rotation, moved.projection), (camera.rotation, camera.projection));
            ways.push((moved.eye - camera.eye).length());
        }
        assert!(ways[0] == 0.0 && ways[2] > 0.05, "{ways:?}");
    }
}
