//! Moment arms.

use glam::DVec3;

use super::line_of_action::{Frames, Leg, Line, Point};
use super::revolute_joint::{RevoluteJoint, Turned};

/// −dL/dφ of a line of action, φ in radians: the moment about the joint of a unit pull along it.
///
/// By virtual work, which is exact for a shortest path: a point that the line leaves in one direction and reaches in another pulls at its bone with the
/// difference, and a ball that the line lies on is a point as well, its centre, for nothing rubs. On the two-rod arm that is `p d sin φ / L`.
pub(super) fn moment_arm(hinge: &RevoluteJoint, line: &Line, degrees: f64) -> f64 {
    let frames = hinge.at(degrees);
    -line.legs(&frames).map(|leg| slope(&frames, line, &leg)).sum::<f64>()
}

/// The change of a leg's length a radian.
fn slope(frames: &Turned<'_>, line: &Line, leg: &Leg) -> f64 {
    let speed = |point: Point| {
        let rate = frames.rate(point.bone);
        (rate * point.local.extend(1.0)).truncate()
    };
    let (from, to) = (speed(leg.from), speed(leg.to));
    let Some((contact, wrap_object)) = leg.contact.as_ref().zip(line.wrap_object) else {
        return (leg.end - leg.start).try_normalize().unwrap_or(DVec3::ZERO).dot(to - from);
    };
    let center = speed(wrap_object.center);
    let moved = contact.tangent.dot(center - from) + contact.leaves.dot(to - center);
    // A ball that is held small by a point on it grows and shrinks with that point's distance.
    let grown = contact.held_by.map_or(0.0, |end| {
        let (place, speed) = if end == 0 { (leg.start, from) } else { (leg.end, to) };
        let out = (place - frames.place(wrap_object.center)).normalize_or_zero();
        contact.angle * out.dot(speed - center)
    });
    moved + grown
}
