//! A muscle as it is in one pose.

use std::ops::Deref;

use super::Solved;
use super::centerline::Centerline;
use super::flesh::Flesh;
use super::line_of_action::LineSolver;

/// A muscle solved in one pose: its shape, its line of action, and the centreline that its surface is drawn round. Its buffers are kept from pose to pose.
#[derive(Debug, Clone, Default)]
pub struct SolvedMuscle {
    /// Radii, length, volume.
    pub shape: Solved,
    pub(super) line: LineSolver,
    pub(super) centerline: Centerline,
    pub(super) flesh: Flesh,
}

impl SolvedMuscle {
    /// The centreline, in the space of the rig's root and its unit, tendons included. It is as long as the line of action, or as the muscle where a limit
    /// holds it.
    pub fn centerline(&self) -> &Centerline {
        &self.centerline
    }

    /// The line through the centres of the cross-sections that are drawn: [`SolvedMuscle::centerline`], or another where bones push the flesh aside.
    pub fn flesh_centerline(&self) -> &Centerline {
        self.flesh.centerline().unwrap_or(&self.centerline)
    }

    /// The line of action, in the same space; of a muscle that nothing holds, one without a length.
    pub fn line_of_action(&self) -> &crate::wrapping::Solution {
        self.line.solution()
    }
}

impl Deref for SolvedMuscle {
    type Target = Solved;

    fn deref(&self) -> &Solved {
        &self.shape
    }
}
