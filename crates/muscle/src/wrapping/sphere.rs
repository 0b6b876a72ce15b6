//! The sphere: great circles.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::geodesic::{GeodesicEnd, GeodesicStart};
use super::touch::Touch;

/// Nearer to the centre than this share of the radius, a line passes on no side.
const CENTRAL: f64 = 1e-9;
/// A line that leans to the wrong side by no more than this, as a cosine, is on the side: rounding decides nothing.
pub(super) const LEANS: f64 = 1e-9;

/// The great circle from a point in a direction. With φ = length / R the Jacobi fields of curvature 1/R² are cos φ and R sin φ.
pub(super) fn shoot(radius: f64, start: &GeodesicStart) -> GeodesicEnd {
    let (sin, cos) = (start.length / radius).sin_cos();
    GeodesicEnd {
        point: start.point * cos + start.tangent * (radius * sin),
        tangent: start.tangent * cos - start.point * (sin / radius),
        shift: cos,
        shift_rate: -sin / radius,
        turn: radius * sin,
        turn_rate: cos,
    }
}

/// The path from `from` to `to` over the sphere: in the plane of both and the centre, on the given side or else the shorter way.
pub(super) fn touch(radius: f64, from: DVec3, to: DVec3, side: Option<DVec3>) -> Option<Touch> {
    let along = (to - from).try_normalize()?;
    let out = from.reject_from_normalized(along);
    let side_up = || side.map(|side| side.reject_from_normalized(along));
    let up = if out.length() > CENTRAL * radius {
        out.reject_from_normalized(along)
    } else {
        side_up().filter(|up| up.length() > CENTRAL).unwrap_or_else(|| along.any_orthogonal_vector())
    };
    let up = up.try_normalize()?;
    let up = if side.is_some_and(|side| up.dot(side) < -LEANS) { -up } else { up };
    touch_over(radius, from, to, along, up)
}

/// The path over the end of `up`, a direction perpendicular to `along`, in the plane of both.
pub(super) fn touch_over(radius: f64, from: DVec3, to: DVec3, along: DVec3, up: DVec3) -> Option<Touch> {
    let flat = |point: DVec3| DVec2::new(point.dot(along), point.dot(up));
    let [leave, arrive] = contact_angles(radius, flat(from), flat(to))?;
    let outward = |angle: f64| along * angle.cos() + up * angle.sin();
    let onward = |angle: f64| along * angle.sin() - up * angle.cos();
    Some(Touch {
        start: GeodesicStart { point: outward(leave) * radius, tangent: onward(leave), length: radius * (leave - arrive) },
        end: outward(arrive) * radius,
        end_tangent: onward(arrive),
    })
}

/// Directions of the tangent points of the path over a circle, from x towards y, where x points along the straight line from `from` to `to` and the path
/// passes on the side of y. `None` where it does not touch.
///
/// The tangent point from a point p lies at θ = arg p ± acos(R / |p|). An end inside of the circle takes the circle that it lies on.
pub(super) fn contact_angles(radius: f64, from: DVec2, to: DVec2) -> Option<[f64; 2]> {
    if from.x >= 0.0 || to.x <= 0.0 {
        return None;
    }
    contact_angles_around(radius, from, to)
}

/// [`contact_angles`], also where the foot of the centre lies beyond an end, so that a path on the far side goes round by more than half a turn.
pub(super) fn contact_angles_around(radius: f64, from: DVec2, to: DVec2) -> Option<[f64; 2]> {
    let (p, q) = (from.length(), to.length());
    // A line through the centre itself is none below it, whatever the sign of its 0.
    let (from, to) = (from + DVec2::ZERO, to + DVec2::ZERO);
    // Below the centre the start's direction is counted on beyond half a turn, the end's on below 0.
    let start = if from.y < 0.0 { from.y.atan2(from.x) + TAU } else { from.y.atan2(from.x) };
    let leave = start - (radius / p).min(1.0).acos();
    let arrive = to.y.atan2(to.x) + (radius / q).min(1.0).acos();
    (leave > arrive).then_some([leave, arrive])
}
