//! Length, moment arm, volume and radii over the elbow angle.

use glam::DVec3;

use super::arm::{AXIS, Arm};
use super::line::{Frames, Line};

/// −dL/dφ of a line of action on the arm, φ in radians: the moment of a unit pull along it about the elbow.
///
/// By virtual work the insertion, at `x` from the elbow, moves by `axis × x` a radian, and only the part along the line changes its length.
pub fn moment_arm(arm: &Arm, line: &Line, degrees: f64) -> f64 {
    let frames = arm.frames(degrees);
    let (origin, insertion) = (frames.place(line.origin), frames.place(line.insertion));
    let along = (insertion - origin).try_normalize().unwrap_or(DVec3::ZERO);
    let speed = |bone: usize, place: DVec3| if bone == 1 { AXIS.cross(place - arm.elbow()) } else { DVec3::ZERO };
    along.dot(speed(line.origin.bone, origin) - speed(line.insertion.bone, insertion))
}
