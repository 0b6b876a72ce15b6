//! Where the segments of a model lie on a figure: a similarity a segment.
//!
//! A segment is mapped so that its joint comes to lie on the figure's joint and the direction to its next joint on that of the figure; what is left to turn about
//! that direction is told by the axis about which the joint at its end, or its own, bends. That axis is square to the plane of the limb where the limb is bent at rest, else
//! it is told by the trunk: legs bend about the line from left to right, arms bring the hand to the front. On the other side of the body, and in a figure seen in
//! a mirror, the map mirrors too, so that “outward” stays outward.

use glam::{DMat3, DMat4, DQuat, DVec3};
use sinew_scene::animation::Clip;
use sinew_scene::{NodeId, Scene};

use super::super::humanoid::{BodyAxes, BodySide, Humanoid, Limb, LimbJoint};
use super::data::{Coordinate, Model, Segment, SegmentData};
use super::error::{BodyJoint, SetError, SidedJoint};
use crate::joint_dof::JointDof;

/// A limb that is bent by so many degrees at rest tells the axis of its bend where that agrees with the trunk to within so many: the more it is bent, the less
/// it has to agree.
const TELLS: [(f64, f64); 2] = [(20.0, 60.0), (3.0, 30.0)];
/// A pelvis is scaled with the distance of the hips, so that nothing crosses the middle, but not below this share of the thigh's scale, nor above the thigh's.
const LEAST_PELVIS: f64 = 0.7;
/// Where an arm at rest hangs within this of the trunk's axis, degrees, its shoulder has an angle as the model counts it; else it is counted from rest.
const HANGS: f64 = 60.0;

/// A segment of a model on a figure.
#[derive(Debug, Clone, Copy)]
pub(super) struct SegmentFrame {
    /// The bone that carries it.
    pub bone: NodeId,
    /// Where its joint is in the model.
    begin: DVec3,
    /// Where its joint is in the world at rest, metres.
    pub origin: DVec3,
    /// The model's axes in the world, of length 1; left-handed where the map mirrors.
    pub axes: DMat3,
    /// The figure's length over the model's.
    pub scale: f64,
}

impl SegmentFrame {
    /// A point of the segment in the world at rest.
    pub(super) fn place(&self, point: DVec3) -> DVec3 {
        self.origin + self.axes * (point - self.begin) * self.scale
    }

    /// The axis of a turn of a coordinate in the world at rest: turning to the same hand in the model's axes.
    pub(super) fn turn_axis(&self, coordinate: Coordinate) -> DVec3 {
        self.axes * vector(coordinate.axis()) * self.axes.determinant().signum()
    }
}

/// The segments of one limb.
pub(super) struct LimbFrames {
    frames: Vec<(Segment, SegmentFrame)>,
    /// Whether the arm of these segments hangs at rest; true for legs.
    hangs: bool,
}

impl LimbFrames {
    pub(super) fn of(&self, segment: Segment) -> Option<&SegmentFrame> {
        self.frames.iter().find(|(known, _)| *known == segment).map(|(_, frame)| frame)
    }

    /// The angle that a coordinate of the model has in the figure's rest pose, degrees.
    pub(super) fn at_rest(&self, coordinate: Coordinate) -> f64 {
        let [child, parent] = coordinate.segments().map(|segment| self.of(segment).map_or(DMat3::IDENTITY, |frame| frame.axes));
        if coordinate == Coordinate::ShoulderElevation && !self.hangs {
            return 0.0;
        }
        let turn = DQuat::from_mat3(&(parent.transpose() * child));
        let along = DVec3::new(turn.x, turn.y, turn.z).dot(vector(coordinate.axis()));
        let degrees = (2.0 * along.atan2(turn.w)).to_degrees();
        (degrees + 180.0).rem_euclid(360.0) - 180.0
    }
}

/// A figure at rest, and what is needed of its scene.
pub(super) struct Figure<'a> {
    pub scene: &'a Scene,
    pub clips: &'a [Clip],
    pub humanoid: &'a Humanoid,
    /// One matrix a node, at rest.
    pub world: &'a [DMat4],
}

impl Figure<'_> {
    fn place(&self, id: NodeId) -> DVec3 {
        self.world.get(id.index()).map_or(DVec3::NAN, |matrix| matrix.w_axis.truncate())
    }

    /// The frames of a model's segments on the limb of one side.
    pub(super) fn frames(&self, model: &Model, side: BodySide) -> Result<LimbFrames, SetError> {
        let is_leg = model.segments.iter().any(|data| data.segment == Segment::Femur);
        let limb = if is_leg { &self.humanoid.legs[side as usize] } else { &self.humanoid.arms[side as usize] };
        let joints = LimbBones::of(limb).ok_or_else(|| SetError::MissingJoints(missing(limb, is_leg, Some(side))))?;
        Ok(if is_leg { self.leg(model, side, &joints) } else { self.arm(model, side, &joints) })
    }

    /// The figure's axes, and to which hand a side's frames are: 1 right-handed.
    fn axes(&self, side: BodySide) -> (BodyAxes, DVec3, f64) {
        let axes = self.humanoid.axes;
        let outward = if side == BodySide::Right { axes.right } else { -axes.right };
        (axes, outward, if (side == BodySide::Right) != axes.is_mirrored() { 1.0 } else { -1.0 })
    }

    fn leg(&self, model: &Model, side: BodySide, joints: &LimbBones) -> LimbFrames {
        let (axes, outward, hand) = self.axes(side);
        let [hip, knee, ankle] = joints.bones.map(|bone| self.place(bone));
        let toes = joints.tip.map(|bone| self.place(bone));
        let lateral = limb_axis([hip, knee, ankle], outward, -hand);
        let (thigh, shin) = (knee - hip, ankle - knee);
        let data = |segment| segment_data(model, segment);
        let femur = limb_frame(data(Segment::Femur), joints.bones[0], hip, thigh, lateral, hand);
        let tibia = limb_frame(data(Segment::Tibia), joints.bones[1], knee, shin, lateral, hand);
        // A foot without toes points to the front, as the model's does, and has the shin's scale.
        let foot_data = data(Segment::Foot);
        let foot_way = vector(foot_data.end) - vector(foot_data.begin);
        let straight = (axes.front * foot_way.x + axes.up * foot_way.y + outward * foot_way.z) * tibia.scale;
        let foot_way = toes.map(|toes| toes - ankle).filter(|way| way.length() > 0.2 * straight.length()).unwrap_or(straight);
        let foot = limb_frame(foot_data, joints.bones[2], ankle, foot_way, outward, hand);
        let pelvis_data = data(Segment::Pelvis);
        let other = self.humanoid.legs[if side == BodySide::Left { 1 } else { 0 }].joint(LimbJoint::Root);
        let width = (vector(pelvis_data.end) - vector(pelvis_data.begin)).length();
        let hips = other.map_or(f64::INFINITY, |other| self.place(other).distance(hip) / width);
        let pelvis = SegmentFrame {
            bone: joints.girdle,
            begin: vector(pelvis_data.begin),
            origin: hip,
            axes: DMat3::from_cols(axes.front, axes.up, outward),
            scale: hips.clamp(LEAST_PELVIS * femur.scale, femur.scale),
        };
        let frames = vec![(Segment::Pelvis, pelvis), (Segment::Femur, femur), (Segment::Tibia, tibia), (Segment::Foot, foot)];
        LimbFrames { frames, hangs: true }
    }

    fn arm(&self, model: &Model, side: BodySide, joints: &LimbBones) -> LimbFrames {
        let (axes, mut outward, hand) = self.axes(side);
        let mut front = axes.front;
        let [shoulder, elbow, wrist] = joints.bones.map(|bone| self.place(bone));
        let (upper, fore) = (elbow - shoulder, wrist - elbow);
        if self.humanoid.has_one_arm {
            // An arm without a body bends as its clip bends it, else as its file lets it.
            let bends = JointDof::at_node(self.scene, self.clips, joints.bones[1]);
            if let Some(told) = bends.and_then(|joint| self.flexes_to(&joint, upper)) {
                front = told;
                outward = (front.cross(axes.up) * hand).try_normalize().unwrap_or(outward);
            }
        }
        // The axis about which the forearm comes to the front.
        let to_front = upper.cross(front).try_normalize().unwrap_or_else(|| upper.any_orthonormal_vector());
        let lateral = limb_axis([shoulder, elbow, wrist], to_front * hand, hand);
        let data = |segment| segment_data(model, segment);
        let humerus = limb_frame(data(Segment::Humerus), joints.bones[0], shoulder, upper, lateral, hand);
        let forearm = limb_frame(data(Segment::Forearm), joints.bones[1], elbow, fore, lateral, hand);
        let girdle = SegmentFrame {
            bone: joints.girdle,
            begin: vector(data(Segment::Girdle).begin),
            origin: shoulder,
            axes: DMat3::from_cols(front, axes.up, outward),
            scale: humerus.scale,
        };
        let hangs = upper.angle_between(-axes.up).to_degrees() < HANGS;
        let frames = vec![(Segment::Girdle, girdle), (Segment::Humerus, humerus), (Segment::Forearm, forearm)];
        LimbFrames { frames, hangs }
    }

    /// Where a joint brings the limb below it, across the limb above.
    fn flexes_to(&self, joint: &JointDof, upper: DVec3) -> Option<DVec3> {
        let parent =
            self.scene.graph.node(joint.node).parent().and_then(|id| self.world.get(id.index())).copied().unwrap_or(DMat4::IDENTITY);
        let inside = parent.inverse().transform_vector3(upper);
        parent.transform_vector3(joint.axis.cross(inside)).try_normalize().filter(|way| way.is_finite())
    }
}

/// The bones of a whole limb.
struct LimbBones {
    girdle: NodeId,
    bones: [NodeId; 3],
    tip: Option<NodeId>,
}

impl LimbBones {
    fn of(limb: &Limb) -> Option<Self> {
        let bone = |joint| limb.joint(joint);
        let bones = [bone(LimbJoint::Root)?, bone(LimbJoint::Middle)?, bone(LimbJoint::End)?];
        Some(Self { girdle: limb.girdle?, bones, tip: bone(LimbJoint::Tip) })
    }
}

/// The joints that a limb lacks.
pub(super) fn missing(limb: &Limb, is_leg: bool, side: Option<BodySide>) -> Vec<SidedJoint> {
    use BodyJoint::{Ankle, Chest, Elbow, Hip, Knee, Pelvis, Shoulder, Wrist};
    let (girdle, joints) = if is_leg { (Pelvis, [Hip, Knee, Ankle]) } else { (Chest, [Shoulder, Elbow, Wrist]) };
    let of_limb = [LimbJoint::Root, LimbJoint::Middle, LimbJoint::End].into_iter().zip(joints);
    let lacks = of_limb.filter(|(joint, _)| limb.joint(*joint).is_none()).map(|(_, joint)| SidedJoint { joint, side });
    // What a limb hangs on is known once the limb's first joint is.
    let hangs_on_nothing = limb.girdle.is_none() && limb.joint(LimbJoint::Root).is_some();
    lacks.chain(hangs_on_nothing.then_some(SidedJoint { joint: girdle, side: None })).collect()
}

fn vector(values: [f64; 3]) -> DVec3 {
    DVec3::from_array(values)
}

fn segment_data(model: &Model, segment: Segment) -> &SegmentData {
    // Every model has the segments of its limb; a test holds that.
    const NONE: SegmentData = SegmentData { segment: Segment::Pelvis, begin: [0.0; 3], end: [0.0, -1.0, 0.0] };
    model.segments.iter().find(|data| data.segment == segment).unwrap_or(&NONE)
}

/// The direction that is outward (z) for a limb of three joints: `trunk`, unless the bend of the limb tells; `sign` is that of the model's z axis against the axis of
/// the bend.
fn limb_axis([first, second, third]: [DVec3; 3], trunk: DVec3, sign: f64) -> DVec3 {
    let (upper, lower) = (second - first, third - second);
    let bend = upper.angle_between(lower).to_degrees();
    let Some(told) = (upper.cross(lower) * sign).try_normalize() else { return trunk };
    let off = told.angle_between(trunk).to_degrees();
    if TELLS.iter().any(|(bent, agrees)| bend >= *bent && off <= *agrees) { told } else { trunk }
}

/// Axes with −y along `way` and z as near `z` as that allows; right-handed where `hand` is 1.
fn basis(way: DVec3, z: DVec3, hand: f64) -> DMat3 {
    let y = -way.normalize_or(DVec3::NEG_Y);
    let z = z.reject_from_normalized(y).try_normalize().unwrap_or_else(|| y.any_orthonormal_vector());
    DMat3::from_cols(y.cross(z) * hand, y, z)
}

/// The frame of a segment that lies along `way` from `origin`.
fn limb_frame(data: &SegmentData, bone: NodeId, origin: DVec3, way: DVec3, z: DVec3, hand: f64) -> SegmentFrame {
    let (begin, end) = (vector(data.begin), vector(data.end));
    let axes = basis(way, z, hand) * basis(end - begin, DVec3::Z, 1.0).transpose();
    SegmentFrame { bone, begin, origin, axes, scale: way.length() / (end - begin).length() }
}
