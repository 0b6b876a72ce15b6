//! What a person does to joints, beside what the clip does: one value, from which every pose is made, which session files keep, and which undo brings back.

use std::sync::Arc;

use glam::DVec3;

use super::JointOverride;
use sinew_muscle::{JointRotation, MuscleState};
use sinew_scene::NodeId;

/// How joints are turned by hand.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JointControl {
    /// Elbow angle and contraction of the arms that muscle files bring.
    pub drive: MuscleState,
    /// The joint of a clip that the slider turns, on top of the clip or instead of it: see [`super::Document::joint`].
    pub rotation: Option<JointRotation>,
    /// Rotations on top of the clip and of `rotation`, ascending by node. Shared, so that a copy of a state allocates nothing.
    overrides: Arc<[JointOverride]>,
}

impl JointControl {
    /// Only the arms of muscle files are driven.
    pub fn driven(drive: MuscleState) -> Self {
        Self { drive, ..Self::default() }
    }

    /// The rotations on top of the clip, ascending by node.
    pub fn overrides(&self) -> &[JointOverride] {
        &self.overrides
    }

    /// The override of `node`, degrees about its own axes; zero where it has none.
    pub fn joint_override(&self, node: NodeId) -> DVec3 {
        self.overrides.iter().find(|turn| turn.node == node).map_or(DVec3::ZERO, |turn| turn.degrees)
    }

    /// Sets the override of `node`; zero removes it. Numbers that are not finite change nothing.
    pub fn set_override(&mut self, node: NodeId, degrees: DVec3) {
        if degrees.is_finite() && degrees != self.joint_override(node) {
            let before = self.overrides.iter().copied().filter(|turn| turn.node < node);
            let own = Some(JointOverride { node, degrees }).filter(|_| degrees != DVec3::ZERO);
            let after = self.overrides.iter().copied().filter(|turn| turn.node > node);
            self.overrides = before.chain(own).chain(after).collect();
        }
    }

    /// Removes the overrides of which `kept` says no.
    pub fn retain_overrides(&mut self, kept: impl Fn(&JointOverride) -> bool) {
        self.overrides = self.overrides.iter().copied().filter(kept).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overrides_are_sorted_and_zero_removes_one() {
        let mut joints = JointControl::default();
        for (node, degrees) in [(4, 1.0), (2, 2.0), (9, 3.0), (4, 5.0), (2, 0.0), (1, f64::NAN)] {
            joints.set_override(NodeId(node), DVec3::splat(degrees));
        }
        let listed: Vec<_> = joints.overrides().iter().map(|turn| (turn.node.0, turn.degrees.x)).collect();
        assert_eq!(listed, [(4, 5.0), (9, 3.0)]);
        assert_eq!((joints.joint_override(NodeId(9)), joints.joint_override(NodeId(2))), (DVec3::splat(3.0), DVec3::ZERO));
        joints.retain_overrides(|turn| turn.node.0 > 4);
        assert_eq!(joints.overrides().len(), 1);
    }
}
