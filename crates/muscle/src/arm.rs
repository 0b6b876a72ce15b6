//! The two-rod arm: an upper rod that hangs from the shoulder, an elbow, a forearm that bends towards +X.
//!
//! Elbow flexion φ is 0° for the straight arm. A muscle from a point `p` above the elbow on one rod's axis to a point `d` below it on the other's
//! has, by the law of cosines,
//!
//! ```text
//! L(φ)² = p² + d² + 2 p d cos φ        moment arm  −dL/dφ = p d sin φ / L
//! ```
//!
//! The arm stands on the ground plane: the wrist of the straight arm is at height 0, the shoulder on top.

use glam::{DMat4, DVec3};

use super::materials;
use super::primitive_meshes::{ROUND, SLENDER, ball, hang, revolved};
use sinew_scene::animation::Pose;
use sinew_scene::{BodyPart, Node, NodeId, NodeKind, Scene, Transform, TransformOp};

/// The upper rod's id in the scene: what an attachment names.
pub const UPPER_ARM: &str = BodyPart::UpperArm.id();
/// The forearm's id in the scene.
pub const FOREARM: &str = BodyPart::Forearm.id();
/// What files call the arm's joint.
pub(super) const ELBOW_JOINT: &str = "elbow";
/// The farthest that an elbow bends, degrees.
pub const FULL_FLEXION: f64 = 150.0;
/// Radius of the elbow's ball over that of the rods.
pub(super) const ELBOW: f64 = 1.35;
/// Radius of the balls at the free ends over that of the rods.
const END: f64 = 1.2;
/// The axis that the elbow turns about; the forearm goes from −Y towards +X.
pub(super) const AXIS: DVec3 = DVec3::Z;

/// Two rods and the elbow between them. Lengths are in the file's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arm {
    /// Shoulder to elbow.
    pub upper: f64,
    /// Elbow to wrist.
    pub lower: f64,
    /// Radius of the rods.
    pub thickness: f64,
    /// Least and greatest flexion that the file asks for, degrees; `None` = from straight to as far as the muscle allows, at most
    /// [`FULL_FLEXION`].
    pub flexion: Option<[f64; 2]>,
}

/// An arm's place in a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmNodes {
    /// The upper rod.
    pub upper: NodeId,
    /// The elbow, which turns; the forearm hangs on it.
    pub elbow: NodeId,
    /// The forearm's rod.
    pub forearm: NodeId,
    /// Which of the elbow's operations turns it.
    turn: u32,
}

impl Arm {
    /// Frames of the upper rod (at the shoulder) and the forearm (at the elbow) at this flexion, from the arm's root.
    pub fn frames(&self, degrees: f64) -> [DMat4; 2] {
        let shoulder = DMat4::from_translation(DVec3::Y * (self.upper + self.lower));
        let elbow = DMat4::from_translation(self.elbow()) * TransformOp::Rotate { axis: AXIS, angle: degrees }.matrix();
        [shoulder, elbow]
    }

    /// Where the elbow is, from the arm's root.
    pub fn elbow(&self) -> DVec3 {
        DVec3::Y * self.lower
    }

    /// Adds the arm's nodes, rods and balls under `root`.
    pub fn build(&self, scene: &mut Scene, root: NodeId) -> ArmNodes {
        let bone = materials::bone(scene);
        let named = |part: BodyPart| {
            let mut node = Node::new("");
            node.id = part.id().to_owned();
            node
        };
        let joint = |part: BodyPart, ops: Vec<TransformOp>| {
            let mut node = named(part);
            node.kind = NodeKind::Joint;
            node.transform = Transform { ops };
            node
        };
        let down = |by: f64| TransformOp::Translate(DVec3::NEG_Y * by);
        let graph = &mut scene.graph;
        let upper = joint(BodyPart::UpperArm, vec![TransformOp::Translate(DVec3::Y * (self.upper + self.lower))]);
        let upper = graph.add(Some(root), upper);
        let turn = TransformOp::Rotate { axis: AXIS, angle: 0.0 };
        let elbow = graph.add(Some(upper), joint(BodyPart::Elbow, vec![down(self.upper), turn]));
        let forearm = graph.add(Some(elbow), named(BodyPart::Forearm));
        let wrist = graph.add(Some(elbow), joint(BodyPart::Wrist, vec![down(self.lower)]));

        let r = self.thickness;
        // Closed by a disc at either end, so that nobody can look into it and its far side need not be drawn.
        let rod = |length: f64| {
            let disc = |height: f64, up: f64| [(height, 0.0, [up, 0.0]), (height, r, [up, 0.0])];
            let ([top, rim], [bottom, foot]) = (disc(0.0, 1.0), disc(-length, -1.0));
            vec![top, rim, (0.0, r, [0.0, 1.0]), (-length, r, [0.0, 1.0]), foot, bottom]
        };
        for (node, part, profile, segments) in [
            (upper, BodyPart::UpperArm, rod(self.upper), SLENDER),
            (upper, BodyPart::Shoulder, ball(END * r), ROUND),
            (elbow, BodyPart::Elbow, ball(ELBOW * r), ROUND),
            (forearm, BodyPart::Forearm, rod(self.lower), SLENDER),
            (wrist, BodyPart::Wrist, ball(END * r), ROUND),
        ] {
            hang(scene, node, revolved(part, &profile, segments), bone);
        }
        ArmNodes { upper, elbow, forearm, turn: 1 }
    }
}

impl ArmNodes {
    /// Bends the elbow of a pose.
    pub fn bend(&self, degrees: f64, pose: &mut Pose) {
        let Some(range) = pose.ranges.get(self.elbow.index()) else { return };
        if let Some(TransformOp::Rotate { angle, .. }) = pose.ops.get_mut((range.start + self.turn) as usize) {
            *angle = degrees;
        }
    }
}
