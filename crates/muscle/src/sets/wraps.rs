//! Wrap surfaces of a model on the bones of a figure.

use glam::{DMat3, DQuat, DVec3};

use super::super::wrap_object::{euler_angles, turned};
use super::bone_space::{Bones, STEPS, UNIT};
use super::data::{Model, MuscleData, Segment, WrapData};
use super::error::SetError;
use super::frames::LimbFrames;
use crate::config::{Wrap, WrapRange, WrapShape};

/// Angles between which a point is looked for in a wrap surface, degrees.
const LOOK: f64 = 5.0;
/// A point lies outside a wrap surface by this share of its size at least.
const OUTSIDE: f64 = 1.02;
/// Least size that a wrap surface is shrunk to, as a share.
const LEAST_WRAP: f64 = 0.2;

/// A wrap surface on the bone of its segment, shrunk until the points of the muscle lie outside at every angle of the joints between.
pub(super) fn carried_wrap(
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
