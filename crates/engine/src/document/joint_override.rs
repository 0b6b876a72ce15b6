//! Joint overrides: rotations applied on top of the clip.

use glam::{DMat4, DQuat, DVec3, EulerRot};

use sinew_scene::NodeId;

/// A rotation of a node about its own axes, applied after the clip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointOverride {
    /// The node.
    pub node: NodeId,
    /// Degrees about its own X, then Y, then Z axis, as the axes lie before the turn.
    pub degrees: DVec3,
}

impl JointOverride {
    /// The turn as a matrix; applied to the right of the node's local one, so that the joint stays where it is.
    pub fn matrix(&self) -> DMat4 {
        let radians = self.degrees * (std::f64::consts::PI / 180.0);
        DMat4::from_quat(DQuat::from_euler(EulerRot::ZYX, radians.z, radians.y, radians.x))
    }
}
