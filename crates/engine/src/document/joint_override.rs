//! Joint overrides: rotations applied on top of the clip.

use glam::{DMat4, DQuat, DVec3, EulerRot};

use super::Document;
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

impl Document {
    /// The joint overrides, ascending by node.
    pub fn joint_overrides(&self) -> &[JointOverride] {
        &self.joint_overrides
    }

    /// The override of `node`, degrees about its own axes; zero where it has none.
    pub fn joint_override(&self, node: NodeId) -> DVec3 {
        self.joint_overrides.iter().find(|turn| turn.node == node).map_or(DVec3::ZERO, |turn| turn.degrees)
    }

    /// Sets the override of `node`; zero removes it. A node that does not exist and numbers that are not finite change nothing.
    pub fn set_joint_override(&mut self, node: NodeId, degrees: DVec3) {
        if node.index() >= self.scene.graph.len() || !degrees.is_finite() {
            return;
        }
        let place = self.joint_overrides.binary_search_by_key(&node, |turn| turn.node);
        if let Ok(at) = place {
            self.joint_overrides.remove(at);
        }
        if degrees != DVec3::ZERO {
            self.joint_overrides.insert(place.unwrap_or_else(|at| at), JointOverride { node, degrees });
        }
    }

    /// Puts these turns in the place of all others.
    pub fn set_joint_overrides(&mut self, overrides: &[JointOverride]) {
        self.joint_overrides.clear();
        overrides.iter().for_each(|turn| self.set_joint_override(turn.node, turn.degrees));
    }
}
