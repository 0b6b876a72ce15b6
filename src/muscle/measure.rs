//! Moment arms.

use glam::DVec3;

use super::hinge::Hinge;
use super::line::{Frames, Line, Point};

/// −dL/dφ of a line of action, φ in radians: the moment about the joint of a unit pull along it.
///
/// For a straight line by virtual work: an end at `x` from the axis moves by `axis × x` a radian, and only the part along the line changes its
/// length. On the two-rod arm that is `p d sin φ / L`. A line that is bent by via points or a wrap is differentiated over ±h and ±2h, which leaves
/// an error of the order h⁴.
pub fn moment_arm(hinge: &Hinge, line: &Line, degrees: f64) -> f64 {
    if !line.is_straight() {
        const H: f64 = 1e-3;
        let length = |steps: f64| line.length(&hinge.at(degrees + (steps * H).to_degrees()));
        return (8.0 * (length(-1.0) - length(1.0)) - (length(-2.0) - length(2.0))) / (12.0 * H);
    }
    let frames = hinge.at(degrees);
    let (origin, insertion) = (frames.place(line.origin), frames.place(line.insertion));
    let along = (insertion - origin).try_normalize().unwrap_or(DVec3::ZERO);
    let speed = |point: Point, place: DVec3| {
        let moves = hinge.bones.get(point.bone).is_some_and(|(_, moves)| *moves);
        if moves { hinge.axis.cross(place - hinge.pivot) } else { DVec3::ZERO }
    };
    along.dot(speed(line.origin, origin) - speed(line.insertion, insertion))
}
