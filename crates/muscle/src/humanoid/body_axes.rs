//! Where a figure's right, top and front are, from the places of its joints at rest.

use glam::DVec3;

use super::tree::BoneTree;
use super::{Limb, LimbJoint, middle};

/// A foot tells where the front is where it reaches so far out, as a share of its length.
const FOOT_REACH: f64 = 0.3;
/// A knee tells where the front is where it lies so far off the line from hip to ankle, as a share of the leg's length.
const KNEE_REACH: f64 = 0.01;

/// Directions of a trunk in the world, of length 1 and square to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in super::super) struct BodyAxes {
    /// Where the figure looks.
    pub front: DVec3,
    /// From the hips to the shoulders.
    pub up: DVec3,
    /// To the side that the names of bones call right.
    pub right: DVec3,
}

impl BodyAxes {
    /// The axes of the figure with these limbs, left first. Without a pair of limbs its right is −X, without legs and trunk its top is +Y: it looks along +Z.
    pub(super) fn new(tree: &BoneTree<'_>, arms: &[Limb; 2], legs: &[Limb; 2]) -> Self {
        let place = |limb: &Limb, joint: LimbJoint| limb.joint(joint).map(|id| tree.place(id));
        let pair = |limbs: &[Limb; 2], joint: LimbJoint| Some([place(&limbs[0], joint)?, place(&limbs[1], joint)?]);
        let (hips, shoulders) = (pair(legs, LimbJoint::Root), pair(arms, LimbJoint::Root));
        let across = |pair: Option<[DVec3; 2]>| pair.and_then(|[left, right]| (right - left).try_normalize()).unwrap_or(DVec3::ZERO);
        let right = (across(hips) + across(shoulders)).try_normalize().unwrap_or(DVec3::NEG_X);
        let one_of = |limbs: &[Limb; 2]| limbs.iter().find_map(|limb| place(limb, LimbJoint::Root));
        let trunk = match (hips.map(middle), shoulders.map(middle)) {
            (Some(hips), Some(shoulders)) => Some(shoulders - hips),
            (Some(hips), None) => pair(legs, LimbJoint::Middle).map(|knees| hips - middle(knees)),
            // Of one limb of each kind the way between them tells.
            _ => one_of(arms).zip(one_of(legs)).map(|(shoulder, hip)| shoulder - hip),
        };
        let square = |way: DVec3| (way - right * way.dot(right)).try_normalize();
        let up = trunk.and_then(square).or_else(|| square(DVec3::Y)).unwrap_or_else(|| right.any_orthonormal_vector());
        let front = up.cross(right);
        // In a mirrored figure right and left are exchanged, front and back are not.
        let is_mirrored = front_told(tree, legs, front).is_some_and(|told| told < 0.0);
        Self { front: if is_mirrored { -front } else { front }, up, right }
    }

    /// Whether the figure is seen in a mirror: its front, top and right are left-handed.
    pub(in super::super) fn is_mirrored(&self) -> bool {
        self.front.cross(self.up).dot(self.right) < 0.0
    }
}

/// How far feet, else knees, lie to this front, as a share; `None` where neither tells.
pub(super) fn front_told(tree: &BoneTree<'_>, legs: &[Limb; 2], front: DVec3) -> Option<f64> {
    let way = |limb: &Limb, from: LimbJoint, to: LimbJoint| Some(tree.place(limb.joint(to)?) - tree.place(limb.joint(from)?));
    let feet = legs.iter().filter_map(|leg| way(leg, LimbJoint::End, LimbJoint::Tip)?.try_normalize());
    let feet: f64 = feet.map(|foot| foot.dot(front)).sum();
    if feet.abs() > FOOT_REACH {
        return Some(feet);
    }
    let bend = |leg: &Limb| {
        let (leg_way, thigh) = (way(leg, LimbJoint::Root, LimbJoint::End)?, way(leg, LimbJoint::Root, LimbJoint::Middle)?);
        let along = leg_way.try_normalize()?;
        Some(thigh.reject_from_normalized(along).dot(front) / leg_way.length())
    };
    let knees: f64 = legs.iter().filter_map(bend).sum();
    (knees.abs() > KNEE_REACH).then_some(knees)
}
