//! Moment arms.

use super::line_of_action::{Line, LineSolver};
use super::revolute_joint::RevoluteJoint;

/// A line of action at one angle of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LineAtAngle {
    /// Its length.
    pub length: f64,
    /// −dL/dφ about the joint, φ in radians: the moment of a unit pull along the line.
    pub moment_arm: f64,
}

/// Length and moment arm at an angle of the joint, degrees.
///
/// The moment arm is that of virtual work, which is exact for a shortest path. On the two-rod arm it is `p d sin φ / L`.
pub(super) fn at_angle(revolute: &RevoluteJoint, line: &Line, degrees: f64, solver: &mut LineSolver) -> LineAtAngle {
    let frames = revolute.at(degrees);
    let solution = line.solve(&frames, solver);
    LineAtAngle { length: solution.length, moment_arm: -line.length_rate(&frames, solution) }
}
