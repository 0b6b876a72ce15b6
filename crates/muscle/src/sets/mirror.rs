//! A muscle on the other side of its figure.
//!
//! Bones have a counterpart each: that of a limb is the bone of the other limb, that of any other bone the one that lies at its mirror image at rest, and a bone in
//! the middle is its own. A point of the muscle is mirrored in the plane between left and right and put on the counterpart; where this does not lie at the mirror
//! image itself, the point goes with it.

use glam::{DMat4, DVec3};
use sinew_scene::{NodeId, Scene};

use super::super::humanoid::{Humanoid, Limb, LimbJoint};
use super::super::wrap_object::{euler_angles, turned};
use super::bone_space::{Bones, STEPS};
use super::error::SetError;
use crate::build::find_bone;
use crate::config::{ActiveRange, Anchor, JointSpec, MuscleFile, MuscleSpec, PointMotion, ViaPoint, Wrap, WrapShape};

/// A bone farther from the mirror image of another than this share of the figure's width is not its counterpart.
const NEAR: f64 = 0.05;

/// The muscle `spec` of `file` on the other side of the figure that it is on, and the joints of the other side that it depends on and the file has not yet.
/// Nodes at and below `skip` are no bones.
///
/// # Errors
/// [`SetError`] where there is no figure, or a bone has no counterpart.
pub fn mirrored(file: &MuscleFile, spec: &MuscleSpec, scene: &Scene, skip: &[NodeId]) -> Result<(MuscleSpec, Vec<JointSpec>), SetError> {
    let mut world = Vec::new();
    scene.graph.world_from_local(&scene.graph.rest_locals(), &mut world);
    let figures = Humanoid::find(scene, skip);
    let bone = |name: &str| find_bone(&scene.graph, None, name).ok_or(SetError::NoFigure);
    let origin = bone(&spec.origin.as_ref().ok_or(SetError::NoFigure)?.bone)?;
    let top = |id: NodeId| std::iter::successors(Some(id), |id| scene.graph.node(*id).parent()).last();
    // Of several figures the one that the muscle's bones belong to.
    let holds = |figure: &&Humanoid| limbs(figure).any(|limb| limb.girdle.is_some_and(|girdle| shares_root(scene, girdle, origin)));
    let humanoid = figures.iter().find(holds).filter(|_| top(origin).is_some()).ok_or(SetError::NoFigure)?;
    let mirror = Mirror::new(scene, humanoid, Bones::of_file(&scene.graph, &world, file))?;
    mirror.muscle(file, spec)
}

fn limbs(figure: &Humanoid) -> impl Iterator<Item = &Limb> {
    figure.arms.iter().chain(&figure.legs)
}

/// Whether one node is below the topmost joint that carries the other.
fn shares_root(scene: &Scene, a: NodeId, b: NodeId) -> bool {
    let graph = &scene.graph;
    let root = |id: NodeId| {
        let ways = std::iter::successors(Some(id), |id| graph.node(*id).parent());
        ways.take_while(|id| graph.node(*id).kind == graph.node(a).kind).last()
    };
    root(a) == root(b)
}

struct Mirror<'a> {
    bones: Bones<'a>,
    /// Nodes of one side and their counterparts.
    pairs: Vec<[NodeId; 2]>,
    /// The plane between left and right: a point of it, and its normal.
    middle: DVec3,
    normal: DVec3,
    /// How near counterparts lie to mirror images, metres.
    near: f64,
}

impl<'a> Mirror<'a> {
    fn new(scene: &'a Scene, humanoid: &Humanoid, bones: Bones<'a>) -> Result<Self, SetError> {
        let mut pairs: Vec<[NodeId; 2]> = Vec::new();
        for [left, right] in [&humanoid.arms, &humanoid.legs].map(|pair| [&pair[0], &pair[1]]) {
            let joints = [LimbJoint::Root, LimbJoint::Middle, LimbJoint::End, LimbJoint::Tip];
            let of_joints = joints.into_iter().filter_map(|joint| Some([left.joint(joint)?, right.joint(joint)?]));
            pairs.extend(of_joints.chain(left.girdle.zip(right.girdle).map(|(left, right)| [left, right])));
        }
        let place = |id: NodeId| bones.matrix(id).w_axis.truncate();
        let normal = humanoid.axes.right;
        // Where pairs have their middle; a girdle that both limbs share is a pair of one.
        let apart: Vec<&[NodeId; 2]> = pairs.iter().filter(|[left, right]| left != right).collect();
        let width = apart.iter().map(|[left, right]| place(*left).distance(place(*right))).fold(0.0, f64::max);
        let sum: DVec3 = apart.iter().map(|[left, right]| 0.5 * (place(*left) + place(*right))).sum();
        if apart.is_empty() || scene.graph.is_empty() {
            return Err(SetError::NoFigure);
        }
        Ok(Self { middle: sum / apart.len() as f64, pairs, bones, normal, near: NEAR * width })
    }

    fn reflect(&self, point: DVec3) -> DVec3 {
        point - self.normal * (2.0 * (point - self.middle).dot(self.normal))
    }

    fn reflect_direction(&self, direction: DVec3) -> DVec3 {
        direction - self.normal * (2.0 * direction.dot(self.normal))
    }

    fn origin(&self, id: NodeId) -> DVec3 {
        self.bones.matrix(id).w_axis.truncate()
    }

    /// The bone of the other side.
    fn counterpart(&self, id: NodeId) -> Result<NodeId, SetError> {
        let graph = self.bones.graph;
        let paired = self.pairs.iter().find_map(|[left, right]| match id {
            id if id == *left => Some(*right),
            id if id == *right => Some(*left),
            _ => None,
        });
        if let Some(found) = paired {
            return Ok(found);
        }
        let there = self.reflect(self.origin(id));
        if there.distance(self.origin(id)) < self.near {
            return Ok(id);
        }
        let depth = |id: NodeId| std::iter::successors(graph.node(id).parent(), |id| graph.node(*id).parent()).count();
        let kind = graph.node(id).kind;
        let near = graph.iter().filter(|(_, node)| node.kind == kind).map(|(other, _)| (self.origin(other).distance(there), other));
        let same = near.filter(|(far, other)| *far < self.near && depth(*other) == depth(id)).min_by(|a, b| a.0.total_cmp(&b.0));
        same.map(|(_, other)| other).ok_or_else(|| SetError::NoCounterpart(graph.label(id).to_owned()))
    }

    fn find(&self, name: &str) -> Result<NodeId, SetError> {
        find_bone(self.bones.graph, None, name).ok_or(SetError::NoFigure)
    }

    /// The offset on the counterpart of a bone.
    fn offset(&self, from: NodeId, to: NodeId, offset: DVec3) -> DVec3 {
        let goes_with = self.origin(to) - self.reflect(self.origin(from));
        self.bones.offset(to, self.reflect(self.bones.place(from, offset)) + goes_with)
    }

    fn anchor(&self, anchor: &Anchor) -> Result<Anchor, SetError> {
        let from = self.find(&anchor.bone)?;
        let to = self.counterpart(from)?;
        Ok(Anchor { bone: self.bones.name(to)?, offset: self.offset(from, to, anchor.offset) })
    }

    fn muscle(&self, file: &MuscleFile, spec: &MuscleSpec) -> Result<(MuscleSpec, Vec<JointSpec>), SetError> {
        let mut joints: Vec<JointSpec> = Vec::new();
        let mut other = spec.clone();
        other.name = other_side(&spec.name).unwrap_or_else(|| spec.name.clone());
        other.origin = spec.origin.as_ref().map(|end| self.anchor(end)).transpose()?;
        other.insertion = spec.insertion.as_ref().map(|end| self.anchor(end)).transpose()?;
        other.via = spec.via.iter().map(|via| self.via(file, via, &mut joints)).collect::<Result<_, _>>()?;
        other.wraps = spec.wraps.iter().map(|wrap| self.wrap(wrap)).collect::<Result<_, _>>()?;
        Ok((other, joints))
    }

    fn via(&self, file: &MuscleFile, via: &ViaPoint, joints: &mut Vec<JointSpec>) -> Result<ViaPoint, SetError> {
        let from = self.find(&via.place.bone)?;
        let to = self.counterpart(from)?;
        let place = self.anchor(&via.place)?;
        let active =
            via.active.as_ref().map(|active| Ok(ActiveRange { joint: self.joint(file, &active.joint, joints)?, ..active.clone() }));
        let moves = via.moves.as_ref().map(|moves| {
            let offsets = moves.offsets.iter().map(|offset| self.offset(from, to, *offset)).collect();
            Ok(PointMotion { joint: self.joint(file, &moves.joint, joints)?, angles: moves.angles.clone(), offsets })
        });
        Ok(ViaPoint { place, active: active.transpose()?, moves: moves.transpose()? })
    }

    /// What the joint of the other side is called; it is added to `joints` where the file has it not.
    fn joint(&self, file: &MuscleFile, name: &str, joints: &mut Vec<JointSpec>) -> Result<String, SetError> {
        let spec = file.joints.iter().find(|joint| joint.label() == name).ok_or(SetError::NoFigure)?;
        let from = self.find(&spec.bone)?;
        let to = self.counterpart(from)?;
        if from == to {
            return Ok(name.to_owned());
        }
        let bone = self.bones.name(to)?;
        // A turn seen in a mirror is to the other hand.
        let axis = self.bones.joint_axis(to, -self.reflect_direction(self.bones.turn_axis(from, spec.axis.normalize_or(DVec3::Z))));
        let is_it = |joint: &&JointSpec| joint.bone == bone && joint.axis.normalize_or_zero().dot(axis) > 0.99;
        if let Some(known) = file.joints.iter().chain(joints.iter()).find(is_it) {
            return Ok(known.label().to_owned());
        }
        let wanted = other_side(name).unwrap_or_else(|| format!("{name} mirrored"));
        joints.push(JointSpec { name: wanted.clone(), bone, axis, range: spec.range });
        Ok(wanted)
    }

    fn wrap(&self, wrap: &Wrap) -> Result<Wrap, SetError> {
        let from = self.find(&wrap.center.bone)?;
        let to = self.counterpart(from)?;
        let center = self.anchor(&wrap.center)?;
        let (here, there) = (self.bones.frame(from), self.bones.frame(to));
        let frame = turned(wrap.rotation);
        let carried = |axis: DVec3| self.bones.direction(to, self.reflect_direction(here.transform_vector3(axis)));
        if let (WrapShape::Sphere { .. }, Some(side)) = (wrap.shape, wrap.side) {
            // A sphere has no axes; its side takes their place.
            return Ok(Wrap { center, rotation: DVec3::ZERO, side: Some(rounded(carried(frame * side))), ..wrap.clone() });
        }
        let rotation = rounded(euler_angles(carried(frame.x_axis), carried(frame.z_axis)));
        // The frame in the mirror is left-handed, that of the file is right-handed: y changes its sign, but where just one of the bones is mirrored itself.
        let exchanged = is_mirrored(&here) == is_mirrored(&there);
        let side = wrap.side.map(|side| if exchanged { side * DVec3::new(1.0, -1.0, 1.0) + DVec3::ZERO } else { side });
        Ok(Wrap { center, rotation, side, ..wrap.clone() })
    }
}

fn is_mirrored(frame: &DMat4) -> bool {
    frame.determinant() < 0.0
}

fn rounded(values: DVec3) -> DVec3 {
    (values * STEPS).round() / STEPS + DVec3::ZERO
}

/// A name with its side exchanged: `_l` and `_r` at the end, with other signs before them, or the words left and right; `None` where it says none.
fn other_side(name: &str) -> Option<String> {
    for (one, two) in [("l", "r"), ("L", "R")] {
        for sign in ["_", ".", " ", "-"] {
            for (from, to) in [(one, two), (two, one)] {
                if let Some(stem) = name.strip_suffix(from).and_then(|stem| stem.strip_suffix(sign)) {
                    return Some(format!("{stem}{sign}{to}"));
                }
            }
        }
    }
    let words = [("left", "right"), ("Left", "Right"), ("right", "left"), ("Right", "Left")];
    words.into_iter().find(|(from, _)| name.contains(from)).map(|(from, to)| name.replacen(from, to, 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_of_names_are_exchanged() {
        for (name, other) in
            [("rect_fem_r", "rect_fem_l"), ("Biceps.L", "Biceps.R"), ("left biceps", "right biceps"), ("Right Arm", "Left Arm")]
        {
            assert_eq!(other_side(name).as_deref(), Some(other));
        }
        assert_eq!(other_side("Biceps"), None);
        assert_eq!(other_side("popl"), None);
    }
}
