//! Muscles of a model as a muscle file has them, on the bones of a figure.

use glam::{DMat3, DMat4, DQuat, DVec3};
use sinew_scene::{Graph, NodeId};

use super::super::bones::bone_name;
use super::super::joint_dof::rotation;
use super::super::line_of_action::Frames;
use super::super::scaling;
use super::super::wrap_object::{euler_angles, turned};
use super::belly;
use super::data::{Coordinate, Model, MuscleData, PointData, Segment, When, WrapData};
use super::error::SetError;
use super::frames::{LimbFrames, SegmentFrame};
use crate::build::{find_bone, resolve};
use crate::config::{ActiveRange, Anchor, JointSpec, MuscleSpec, PointMotion, ViaPoint, Wrap, WrapRange, WrapShape};

/// Metres a unit of the files that are made.
pub(super) const UNIT: f64 = 0.001;
/// Steps of numbers in the file: far below what can be seen, so that left and right stay alike to a millionth of a metre.
pub(super) const STEPS: f64 = 1e5;
/// Angles between which a point is looked for in a wrap surface, degrees.
const LOOK: f64 = 5.0;
/// A point lies outside a wrap surface by this share of its size at least.
const OUTSIDE: f64 = 1.02;
/// Least size that a wrap surface is shrunk to, as a share.
const LEAST_WRAP: f64 = 0.2;

/// The bones of a scene at rest, as offsets of a file see them.
pub(super) struct Bones<'a> {
    graph: &'a Graph,
    world: &'a [DMat4],
    /// By what offsets are multiplied on each node.
    ride: Vec<f64>,
    /// The bones' scale at which the file's lengths hold.
    pub scale: f64,
}

impl<'a> Bones<'a> {
    /// Bones whose lengths hold at the scale of this one.
    pub(super) fn new(graph: &'a Graph, world: &'a [DMat4], bone: NodeId) -> Self {
        let scale = Some(scaling::of_bone(graph, world, bone)).filter(|scale| *scale > 0.0 && scale.is_finite()).unwrap_or(1.0);
        Self { graph, world, ride: scaling::ride(graph, UNIT, scale), scale }
    }

    fn matrix(&self, id: NodeId) -> DMat4 {
        self.world.get(id.index()).copied().unwrap_or(DMat4::IDENTITY)
    }

    /// The frame of a bone in the file's unit, seen from the world's origin.
    fn frame(&self, id: NodeId) -> DMat4 {
        let ride = self.ride.get(id.index()).copied().unwrap_or(1.0);
        let mut frame = DMat4::from_scale(DVec3::splat(UNIT.recip())) * self.matrix(id);
        for axis in [&mut frame.x_axis, &mut frame.y_axis, &mut frame.z_axis] {
            *axis *= ride;
        }
        frame
    }

    fn name(&self, id: NodeId) -> Result<String, SetError> {
        bone_name(self.graph, None, id).ok_or_else(|| SetError::NamelessBone(self.graph.label(id).to_owned()))
    }

    fn offset(&self, id: NodeId, place: DVec3) -> DVec3 {
        (self.frame(id).inverse().transform_point3(place / UNIT) * STEPS).round() / STEPS + DVec3::ZERO
    }

    fn anchor(&self, id: NodeId, place: DVec3) -> Result<Anchor, SetError> {
        Ok(Anchor { bone: self.name(id)?, offset: self.offset(id, place) })
    }

    /// A direction of the world along a bone's own axes.
    fn direction(&self, id: NodeId, direction: DVec3) -> DVec3 {
        self.frame(id).inverse().transform_vector3(direction).normalize_or_zero()
    }

    /// By what lengths of a muscle from this bone are multiplied.
    fn muscle_scale(&self, id: NodeId) -> f64 {
        let scale = scaling::of_bone(self.graph, self.world, id) / self.scale;
        if scale > 0.0 && scale.is_finite() { scale } else { 1.0 }
    }
}

/// Bones at rest by their number in a list; all joints are at rest.
struct RestFrames(Vec<DMat4>);

impl Frames for RestFrames {
    fn frame(&self, index: usize) -> DMat4 {
        self.0.get(index).copied().unwrap_or(DMat4::IDENTITY)
    }

    fn angle(&self, _: usize) -> f64 {
        0.0
    }
}

/// The joints of a limb, the main one first; `suffix` tells the side.
pub(super) fn joints(model: &Model, frames: &LimbFrames, bones: &Bones<'_>, suffix: &str) -> Result<Vec<JointSpec>, SetError> {
    let mut joints = Vec::new();
    for data in model.coordinates {
        let [child, _] = data.coordinate.segments();
        let Some(frame) = frames.of(child) else { continue };
        let rest = frames.at_rest(data.coordinate);
        let parent = bones.graph.node(frame.bone).parent().map_or(DMat4::IDENTITY, |id| bones.matrix(id));
        let own = rotation(&bones.graph.node(frame.bone).transform.matrix()).unwrap_or_default();
        // What turns is the node in the axes of the one above it; where these are mirrored, to the other hand.
        let axis = parent.inverse().transform_vector3(frame.turn_axis(data.coordinate)) * parent.determinant().signum();
        let axis = (own.inverse() * axis).normalize_or(DVec3::Z);
        joints.push(JointSpec {
            name: joint_name(data.coordinate, suffix),
            bone: bones.name(frame.bone)?,
            axis: (axis * 1e9).round() / 1e9 + DVec3::ZERO,
            range: data.range.map(|angle| from_rest(angle, rest)),
        });
    }
    Ok(joints)
}

fn joint_name(coordinate: Coordinate, suffix: &str) -> String {
    format!("{}{suffix}", coordinate.name())
}

/// An angle of the model as an angle from the figure's rest pose, in hundredths of a degree.
fn from_rest(angle: f64, rest: f64) -> f64 {
    ((angle - rest) * 100.0).round() / 100.0 + 0.0
}

/// A muscle of a model on a limb.
pub(super) fn muscle(
    data: &MuscleData,
    model: &Model,
    frames: &LimbFrames,
    bones: &Bones<'_>,
    joints: &[JointSpec],
    suffix: &str,
) -> Result<MuscleSpec, SetError> {
    // Every segment of a path is one of its limb's; a test holds that.
    let frame = |segment: Segment| frames.of(segment).ok_or(SetError::NoFigure);
    let [first, between @ .., last] = data.path else { return Err(SetError::NoFigure) };
    let at = |point: &PointData| -> Result<Anchor, SetError> {
        let frame = frame(point.segment)?;
        bones.anchor(frame.bone, frame.place(DVec3::from_array(point.place)))
    };
    let origin_bone = frame(first.segment)?.bone;
    let lengths = bones.muscle_scale(origin_bone);
    let mut path = MuscleSpec::new(crate::Profile::new(vec![1.0, 1.0], vec![1.0, 1.0], 1.0).map_err(|error| no_muscle(data, error))?);
    path.origin = Some(at(first)?);
    path.via = between.iter().map(|point| via(point, frames, bones, suffix, frame(point.segment)?)).collect::<Result<_, _>>()?;
    path.insertion = Some(at(last)?);
    path.wraps = data.wraps.iter().map(|wrap| carried_wrap(wrap, data, model, frames, bones, lengths)).collect::<Result<_, _>>()?;
    let unit = unit_length(&path, joints, bones, lengths) * UNIT;
    let scale = frame(data.belly_on)?.scale;
    let mut spec = belly::shape(data, unit, scale, (UNIT * lengths).recip()).map_err(|error| no_muscle(data, error))?;
    spec.name = format!("{}{suffix}", data.name);
    spec.source = format!("{}: {} of {} ({}), carried to this figure.", data.meaning, data.name, model.name, model.credit);
    Ok(MuscleSpec { origin: path.origin, via: path.via, wraps: path.wraps, insertion: path.insertion, ..spec })
}

fn no_muscle(data: &MuscleData, error: crate::ProfileError) -> SetError {
    SetError::NoMuscle { muscle: data.name.to_owned(), error }
}

/// A point between the ends.
fn via(point: &PointData, frames: &LimbFrames, bones: &Bones<'_>, suffix: &str, frame: &SegmentFrame) -> Result<ViaPoint, SetError> {
    let offset = |place: [f64; 3]| bones.offset(frame.bone, frame.place(DVec3::from_array(place)));
    let anchor = |offset| Ok(Anchor { bone: bones.name(frame.bone)?, offset });
    Ok(match point.when {
        When::Always => ViaPoint::from(anchor(offset(point.place))?),
        When::Within(coordinate, range) => {
            let rest = frames.at_rest(coordinate);
            let active = ActiveRange { joint: joint_name(coordinate, suffix), range: range.map(|angle| from_rest(angle, rest)) };
            ViaPoint { active: Some(active), ..ViaPoint::from(anchor(offset(point.place))?) }
        }
        When::Moving(coordinate, places) => {
            let rest = frames.at_rest(coordinate);
            let angles = places.iter().map(|(angle, _)| from_rest(*angle, rest)).collect();
            let offsets: Vec<DVec3> = places.iter().map(|(_, place)| offset(*place)).collect();
            let first = offsets.first().copied().unwrap_or_default();
            let moves = PointMotion { joint: joint_name(coordinate, suffix), angles, offsets };
            ViaPoint { moves: Some(moves), ..ViaPoint::from(anchor(first)?) }
        }
    })
}

/// Length of the unit in the rest pose, in the file's unit.
fn unit_length(path: &MuscleSpec, joints: &[JointSpec], bones: &Bones<'_>, scale: f64) -> f64 {
    let mut names: Vec<String> = Vec::new();
    let find = |bone: &str| {
        let known = names.iter().position(|name| name == bone);
        Some(known.unwrap_or_else(|| {
            names.push(bone.to_owned());
            names.len() - 1
        }))
    };
    let labels: Vec<String> = joints.iter().map(|joint| joint.name.clone()).collect();
    let line = resolve(path, &labels, find).ok().flatten();
    let frame = |name: &String| find_bone(bones.graph, None, name).map_or(DMat4::IDENTITY, |id| bones.frame(id));
    let frames = RestFrames(names.iter().map(frame).collect());
    line.map_or(0.0, |line| line.scaled(scale).length(&frames))
}

/// A wrap surface on the bone of its segment, shrunk until the points of the muscle lie outside at every angle of the joints between.
fn carried_wrap(
    wrap: &WrapData,
    data: &MuscleData,
    model: &Model,
    frames: &LimbFrames,
    bones: &Bones<'_>,
    scale: f64,
) -> Result<Wrap, SetError> {
    let frame = frames.of(wrap.segment).ok_or(SetError::NoFigure)?;
    let center = frame.place(DVec3::from_array(wrap.center));
    let axes = frame.axes * turned(DVec3::from_array(wrap.rotation).map(f64::to_degrees));
    let shape = wrap.shape.scaled(frame.scale);
    let inside = Surface { center, axes, shape };
    let outside = points_over_joints(wrap.segment, data, model, frames).map(|point| inside.size_at(point)).fold(f64::INFINITY, f64::min);
    let shape = inside.shrunk((outside / OUTSIDE).clamp(LEAST_WRAP, 1.0));
    let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| bones.direction(frame.bone, axis));
    let side = DVec3::from_array(wrap.side);
    Ok(Wrap {
        shape: rounded(shape.scaled((UNIT * scale).recip())),
        center: bones.anchor(frame.bone, center)?,
        rotation: (euler_angles(x, z) * STEPS).round() / STEPS + DVec3::ZERO,
        side: Some(if x.cross(y).dot(z) < 0.0 { side * DVec3::new(1.0, -1.0, 1.0) + DVec3::ZERO } else { side }),
        range: wrap.between.map_or(WrapRange::Whole, WrapRange::Between),
    })
}

fn rounded(shape: WrapShape) -> WrapShape {
    let round = |length: f64| (length * STEPS).round() / STEPS;
    match shape {
        WrapShape::Sphere { radius } => WrapShape::Sphere { radius: round(radius) },
        WrapShape::Cylinder { radius, length } => WrapShape::Cylinder { radius: round(radius), length: round(length) },
        WrapShape::Ellipsoid { radii } => WrapShape::Ellipsoid { radii: radii.map(round) },
        WrapShape::Torus { radius, tube } => WrapShape::Torus { radius: round(radius), tube: round(tube) },
    }
}

/// The points of a muscle in the world at rest: those on the segment `seat` and its neighbours, the latter as every angle of the coordinate between brings them.
fn points_over_joints<'a>(
    seat: Segment,
    data: &'a MuscleData,
    model: &'a Model,
    frames: &'a LimbFrames,
) -> impl Iterator<Item = DVec3> + 'a {
    data.path.iter().flat_map(move |point| {
        let Some(frame) = frames.of(point.segment) else { return Vec::new() };
        let place = frame.place(DVec3::from_array(point.place));
        if point.segment == seat {
            return vec![place];
        }
        let between = model.coordinates.iter().filter_map(|known| {
            let [child, parent] = known.coordinate.segments();
            let sign = if [child, parent] == [point.segment, seat] { 1.0 } else { -1.0 };
            let joins = [child, parent] == [point.segment, seat] || [parent, child] == [point.segment, seat];
            Some((known, frames.of(child).filter(|_| joins)?, sign))
        });
        let turned = between.flat_map(|(known, joint, sign)| {
            let rest = frames.at_rest(known.coordinate);
            let steps = ((known.range[1] - known.range[0]) / LOOK).ceil();
            (0..=steps as usize).map(move |step| {
                let angle = known.range[0] + (known.range[1] - known.range[0]) * step as f64 / steps - rest;
                let turn = DQuat::from_axis_angle(joint.turn_axis(known.coordinate), (sign * angle).to_radians());
                joint.origin + turn * (place - joint.origin)
            })
        });
        turned.collect()
    })
}

/// A wrap surface in the world.
struct Surface {
    center: DVec3,
    axes: DMat3,
    shape: WrapShape,
}

impl Surface {
    /// By what the surface would have to be multiplied to reach a point.
    fn size_at(&self, point: DVec3) -> f64 {
        let local = self.axes.transpose() * (point - self.center);
        match self.shape {
            WrapShape::Sphere { radius } => local.length() / radius,
            WrapShape::Cylinder { radius, length } if local.z.abs() <= 0.5 * length => local.truncate().length() / radius,
            WrapShape::Ellipsoid { radii } => (local / radii).length(),
            WrapShape::Cylinder { .. } | WrapShape::Torus { .. } => f64::INFINITY,
        }
    }

    /// The shape with its thickness multiplied.
    fn shrunk(&self, share: f64) -> WrapShape {
        match self.shape {
            WrapShape::Cylinder { radius, length } => WrapShape::Cylinder { radius: radius * share, length },
            other => other.scaled(share),
        }
    }
}
