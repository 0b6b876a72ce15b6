//! A muscle as it was measured once.

use super::Solved;

/// A muscle at one angle of its joint, or at one time of a clip. Lengths are in the unit of the muscle's file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MuscleSample {
    /// Seconds on the clip's own axis; `None` where it was measured over angles.
    pub time: Option<f64>,
    /// Angle of the joint that turns the muscle, degrees; `None` where nothing turns it.
    pub angle: Option<f64>,
    /// −dL/dφ about that joint, φ in radians; `None` where nothing turns the muscle.
    pub moment_arm: Option<f64>,
    /// −dL/dφ about each joint of the rig, in their order; none where nothing turns the muscle.
    pub moment_arms: Vec<f64>,
    /// The solution.
    pub solved: Solved,
}
