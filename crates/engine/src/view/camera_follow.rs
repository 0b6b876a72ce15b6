//! Camera that follows a node that the clip moves.

use glam::Vec3;

use super::SessionState;
use crate::document::{Document, PoseBuffers, PoseState};
use sinew_scene::{Camera, Frame, NodeId};

/// The node that a camera follows, with the position for which the camera was placed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraFollow {
    /// The node.
    pub node: NodeId,
    /// Its position when the camera was placed, world, metres.
    pub reference: Vec3,
}

impl CameraFollow {
    /// The node that the camera of a session file follows; `state` is the pose that the file stores. `None` where the camera is fixed.
    pub fn from_session(saved: &SessionState, document: &Document, state: &PoseState) -> Option<Self> {
        let node = saved.follow.as_ref()?.find(document)?;
        let mut frame = Frame::default();
        document.pose_nodes(state, &mut PoseBuffers::default(), &mut frame);
        Some(Self { node, reference: frame.position(node) })
    }

    /// How far the node is from where it was when the camera was placed, world, metres; zero where it is nowhere.
    pub fn offset(&self, frame: &Frame) -> Vec3 {
        let offset = frame.position(self.node) - self.reference;
        if offset.is_finite() { offset } else { Vec3::ZERO }
    }

    /// The camera moved by the node's displacement in `frame`.
    pub fn moved(&self, camera: Camera, frame: &Frame) -> Camera {
        Camera { eye: camera.eye + self.offset(frame), ..camera }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::SceneReaders;
    use crate::view::saved_node;
    use sinew_scene::OrbitCamera;
    use sinew_scene::progress::Progress;

    #[test]
    fn what_is_followed_stays_where_it_is_in_the_picture() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../configs/walker.dae");
        let document = Document::open(&[file], SceneReaders::TESTED, &Progress::default()).unwrap();
        let hand = document.scene.graph.find("hand.L").unwrap();
        let start = document.start_state();
        let saved = SessionState { follow: Some(saved_node(&document, hand)), ..SessionState::default() };
        let follow = CameraFollow::from_session(&saved, &document, &start).unwrap();
        assert_eq!(CameraFollow::from_session(&SessionState::default(), &document, &start), None);
        let camera = OrbitCamera::default().camera();
        let mut offsets = Vec::new();
        for step in 0..5 {
            let state = start.at_time(start.time + 0.2 * f64::from(step));
            let mut frame = Frame::default();
            document.pose_nodes(&state, &mut PoseBuffers::default(), &mut frame);
            let moved = follow.moved(camera, &frame);
            assert!(((frame.position(hand) - moved.eye) - (follow.reference - camera.eye)).length() < 1e-5);
            assert_eq!((moved.rotation, moved.projection), (camera.rotation, camera.projection));
            offsets.push((moved.eye - camera.eye).length());
        }
        assert!(offsets[0] == 0.0 && offsets[2] > 0.05, "{offsets:?}");
    }
}
