//! The cylinder: helices, straight on the unrolled surface.

use glam::{DMat2, DVec2, DVec3};

use super::geodesic::{GeodesicEnd, GeodesicStart};
use super::shape::Curvature;
use super::sphere::{contact_angles, contact_angles_around};
use super::touch::Touch;

/// The shape operator: 1/R round the axis, 0 along it.
pub(super) fn curvature(radius: f64, point: DVec3, tangent: DVec3, binormal: DVec3) -> Curvature {
    let round = DVec3::Z.cross(point).normalize_or(DVec3::X);
    let (t, b) = (tangent.dot(round), binormal.dot(round));
    Curvature { along: t * t / radius, twist: t * b / radius, across: b * b / radius }
}

/// The helix from a point in a direction. The surface is flat: its Jacobi fields are 1 and the length.
pub(super) fn shoot(radius: f64, start: &GeodesicStart) -> GeodesicEnd {
    let round = DVec3::Z.cross(start.point).normalize_or(DVec3::X);
    let turn = DMat2::from_angle(start.length * start.tangent.dot(round) / radius);
    let turned = |vector: DVec3| (turn * vector.truncate()).extend(vector.z);
    GeodesicEnd {
        point: turned(start.point) + DVec3::Z * (start.length * start.tangent.z),
        tangent: turned(start.tangent),
        shift: 1.0,
        shift_rate: 0.0,
        turn: start.length,
        turn_rate: 1.0,
    }
}

/// The path from `from` to `to` over the cylinder. Seen along the axis it is that over a circle, of length s with the straight parts; its height grows evenly
/// with s, so that the whole is √(s² + Δz²) long.
///
/// `around`: it may go round by more than half a turn.
pub(super) fn touch(radius: f64, from: DVec3, to: DVec3, side: Option<DVec3>, around: bool) -> Option<Touch> {
    let (p, q) = (from.truncate(), to.truncate());
    let along = (q - p).try_normalize()?;
    // Of both perpendiculars the one that points from the axis to the line.
    let left = along.perp();
    let out = if left.dot(p) < 0.0 { -left } else { left };
    let up = match side.map(|side| side.truncate()) {
        Some(side) if out.dot(side) < 0.0 => -out,
        _ => out,
    };
    let flat = |point: DVec2| DVec2::new(point.dot(along), point.dot(up));
    let [leave, arrive] = if around { contact_angles_around } else { contact_angles }(radius, flat(p), flat(q))?;
    let outward = |angle: f64| along * angle.cos() + up * angle.sin();
    let onward = |angle: f64| along * angle.sin() - up * angle.cos();
    let straight = |point: DVec2| (point.length_squared() - radius * radius).max(0.0).sqrt();
    let (before, round, after) = (straight(p), radius * (leave - arrive), straight(q));
    let whole = before + round + after;
    let rise = (to.z - from.z) / whole;
    let slant = rise.hypot(1.0);
    let tangent = |angle: f64| (onward(angle) / slant).extend(rise / slant);
    Some(Touch {
        start: GeodesicStart {
            point: (outward(leave) * radius).extend(from.z + rise * before),
            tangent: tangent(leave),
            length: round * slant,
        },
        end: (outward(arrive) * radius).extend(to.z - rise * after),
        end_tangent: tangent(arrive),
    })
}
