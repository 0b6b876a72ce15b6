//! The joint that measurements turn: the arm's elbow, or any joint of a clip's skeleton at its rest pose.

use glam::{DAffine3, DMat4, DQuat, DVec3};

use super::arm::{AXIS, Arm};
use super::line::Frames;

/// A joint with one axis, and what it moves. Everything is seen from the rig's root, in the file's unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Hinge {
    /// A point of the axis.
    pub pivot: DVec3,
    /// Direction of the axis, of length 1; the angle turns right-handed about it.
    pub axis: DVec3,
    /// Each bone's frame at rest, and whether the joint moves it.
    pub bones: Vec<(DMat4, bool)>,
    /// The angle at rest, degrees.
    pub at_rest: f64,
    /// Least and greatest angle, degrees.
    pub range: [f64; 2],
}

impl Hinge {
    /// The elbow of an arm; bone 0 is the upper rod, bone 1 the forearm.
    pub fn elbow(arm: &Arm, range: [f64; 2]) -> Self {
        let [upper, forearm] = arm.frames(0.0);
        Self { pivot: arm.elbow(), axis: AXIS, bones: vec![(upper, false), (forearm, true)], at_rest: 0.0, range }
    }

    /// The bones with the joint at this angle.
    pub fn at(&self, degrees: f64) -> Turned<'_> {
        let turn = DAffine3::from_quat(DQuat::from_axis_angle(self.axis, (degrees - self.at_rest).to_radians()));
        let turn = DAffine3::from_translation(self.pivot) * turn * DAffine3::from_translation(-self.pivot);
        Turned { hinge: self, turn: DMat4::from(turn) }
    }
}

/// A hinge's bones at one angle.
#[derive(Debug, Clone, Copy)]
pub struct Turned<'a> {
    hinge: &'a Hinge,
    turn: DMat4,
}

impl Frames for Turned<'_> {
    fn frame(&self, index: usize) -> DMat4 {
        match self.hinge.bones.get(index) {
            Some((frame, true)) => self.turn * *frame,
            Some((frame, false)) => *frame,
            None => DMat4::IDENTITY,
        }
    }
}
