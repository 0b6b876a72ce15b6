//! Figures of human build in a scene: which bones carry which joints, of any usual rig.
//!
//! Where names tell ([`by_name`]), they do; where they do not, the tree of bones and the rest pose tell ([`by_shape`]): a trunk with a symmetric pair of legs
//! and a symmetric pair of arms. Limbs that neither finds stay empty, and [`Limb::joint`] says which joints these are.

mod body_axes;
mod by_name;
mod by_shape;
#[cfg(test)]
mod tests;
mod tree;

pub(super) use body_axes::BodyAxes;
pub use by_name::BodySide;
use tree::BoneTree;
pub(super) use tree::{are_apart, bone_flags};

use glam::DVec3;
use sinew_scene::{NodeId, Scene};

/// A joint of a limb, from the trunk outward.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LimbJoint {
    /// Shoulder or hip.
    Root,
    /// Elbow or knee.
    Middle,
    /// Wrist or ankle.
    End,
    /// Where fingers or toes begin.
    Tip,
}

/// The bones of an arm or a leg.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Limb {
    /// The bone of the trunk that the limb is on: pelvis, clavicle or chest.
    pub girdle: Option<NodeId>,
    /// The bones that begin at shoulder, elbow, wrist, knuckles; or at hip, knee, ankle, toes.
    bones: [Option<NodeId>; 4],
}

impl Limb {
    /// The bone that begins at a joint; `None` where it was not found.
    pub(super) fn joint(&self, joint: LimbJoint) -> Option<NodeId> {
        self.bones[joint as usize]
    }

    fn is_whole(&self) -> bool {
        self.girdle.is_some() && self.bones.iter().take(3).all(Option::is_some)
    }

    fn is_empty(&self) -> bool {
        self.bones.iter().all(Option::is_none)
    }
}

/// A figure: its limbs by side, left first, and where its left, top and front are.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Humanoid {
    /// Left and right arm.
    pub arms: [Limb; 2],
    /// Left and right leg.
    pub legs: [Limb; 2],
    /// Whether the arm on the right is one that has no side: the only one of its figure.
    pub has_one_arm: bool,
    /// The axes of the trunk in the world at rest.
    pub axes: BodyAxes,
}

impl Humanoid {
    /// All figures of a scene, in the order of their roots; nodes below `skip` do not count.
    pub(super) fn find(scene: &Scene, skip: &[NodeId]) -> Vec<Self> {
        let tree = BoneTree::new(scene, skip);
        tree.figures().into_iter().filter_map(|bones| Self::in_figure(&tree, &bones)).collect()
    }

    fn in_figure(tree: &BoneTree<'_>, bones: &[NodeId]) -> Option<Self> {
        let named = by_name::find(tree, bones);
        let shaped = by_shape::find(tree, bones);
        let choose = |named: [Limb; 2], shaped: Option<[Limb; 2]>| match shaped {
            Some(shaped) if named.iter().all(|limb| !limb.is_whole()) => shaped,
            _ => named,
        };
        let arms = choose(named.arms, shaped.as_ref().map(|found| found.arms));
        let legs = choose(named.legs, shaped.as_ref().map(|found| found.legs));
        if arms.iter().chain(&legs).all(Limb::is_empty) {
            return None;
        }
        let axes = BodyAxes::new(tree, &arms, &legs);
        Some(Self { arms, legs, has_one_arm: named.has_one_arm && arms == named.arms, axes })
    }
}

/// The limbs that one of the two ways finds.
pub(super) struct FoundLimbs {
    arms: [Limb; 2],
    legs: [Limb; 2],
    has_one_arm: bool,
}

/// The point between two.
fn middle(points: [DVec3; 2]) -> DVec3 {
    0.5 * (points[0] + points[1])
}
