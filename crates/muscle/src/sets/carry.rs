//! Muscles of a model as a muscle file has them, on the bones of a figure.

use glam::{DMat4, DVec3};

use super::belly;
use super::bone_space::{Bones, RestFrames, UNIT};
use super::data::{Coordinate, Model, MuscleData, PointData, Segment, When};
use super::error::SetError;
use super::frames::{LimbFrames, SegmentFrame};
use super::wraps::carried_wrap;
use crate::build::{find_bone, resolve};
use crate::config::{ActiveRange, Anchor, JointSpec, MuscleSpec, PointMotion, ViaPoint};

/// The joints of a limb, the main one first; `suffix` tells the side.
pub(super) fn joints(model: &Model, frames: &LimbFrames, bones: &Bones<'_>, suffix: &str) -> Result<Vec<JointSpec>, SetError> {
    let mut joints = Vec::new();
    for data in model.coordinates {
        let [child, _] = data.coordinate.segments();
        let Some(frame) = frames.of(child) else { continue };
        let rest = frames.at_rest(data.coordinate);
        joints.push(JointSpec {
            name: joint_name(data.coordinate, suffix),
            bone: bones.name(frame.bone)?,
            axis: bones.joint_axis(frame.bone, frame.turn_axis(data.coordinate)),
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
