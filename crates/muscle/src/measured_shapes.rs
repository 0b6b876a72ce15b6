//! Measured poses: a profile given by its radii at several lengths instead of by growth multipliers.
//!
//! Between two lengths the radii are blended linearly, beyond them the nearest ones stand; then all are scaled by one factor to the conserved volume.
//! That is the quadratic again, with the blended radii themselves as multipliers: `r′ᵢ = rᵢ + rᵢ δ`. Unlike multipliers, which are one number a node,
//! poses let a node grow and shrink again on the way.

use super::profile::{LARGEST, ProfileError};
use sinew_scene::limits;

/// Radii at one length.
#[derive(Debug, Clone, PartialEq)]
pub struct Pose {
    /// Length of the belly.
    pub length: f64,
    /// Radius of each node there.
    pub radii: Vec<f64>,
}

/// Poses in the order of their lengths, checked.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Poses(Vec<Pose>);

impl Poses {
    pub(super) fn new(mut poses: Vec<Pose>) -> Result<Self, ProfileError> {
        let Some(nodes) = poses.first().map(|pose| pose.radii.len()) else { return Err(ProfileError::TooFewNodes(0)) };
        if poses.len() > limits::MUSCLE_POSES {
            return Err(ProfileError::TooManyPoses(poses.len()));
        }
        for (index, pose) in poses.iter().enumerate() {
            if pose.radii.len() != nodes {
                return Err(ProfileError::PoseNodes { pose: index, nodes: pose.radii.len(), wanted: nodes });
            }
            if !(pose.length > 0.0 && pose.length <= LARGEST) {
                return Err(ProfileError::PoseLength(index));
            }
            if let Some(node) = pose.radii.iter().position(|radius| !(0.0..=LARGEST).contains(radius)) {
                return Err(ProfileError::BadRadius(node));
            }
            if super::profile::cone_sum(&pose.radii) < f64::MIN_POSITIVE {
                return Err(ProfileError::NoRadius);
            }
        }
        poses.sort_by(|a, b| a.length.total_cmp(&b.length));
        // Nearer than this, what lies between would be rounding.
        match poses.windows(2).position(|pair| matches!(pair, [a, b] if b.length - a.length <= 1e-9 * b.length)) {
            Some(pose) => Err(ProfileError::PosesCoincide(pose)),
            None => Ok(Self(poses)),
        }
    }

    /// The same poses with all lengths multiplied by `scale`.
    pub(super) fn scaled(&self, scale: f64) -> Self {
        let times = |pose: &Pose| Pose { length: pose.length * scale, radii: pose.radii.iter().map(|radius| radius * scale).collect() };
        Self(self.0.iter().map(times).collect())
    }

    /// Writes the blended radii at `length`, before any scaling.
    pub(super) fn shape_into(&self, length: f64, radii: &mut Vec<f64>) {
        radii.clear();
        let next = self.0.partition_point(|pose| pose.length < length);
        match (next.checked_sub(1).and_then(|before| self.0.get(before)), self.0.get(next)) {
            (Some(before), Some(after)) => {
                let share = (length - before.length) / (after.length - before.length);
                radii.extend(before.radii.iter().zip(&after.radii).map(|(a, b)| a + (b - a) * share));
            }
            (Some(only), None) | (None, Some(only)) => radii.extend_from_slice(&only.radii),
            // There is at least one pose.
            (None, None) => {}
        }
    }
}
