//! The joint that measurements turn: the arm's elbow, or any joint of a clip's skeleton.
//!
//! What turns is the joint's own matrix, in the axes of the node above it. Where that node is mirrored, scaled unevenly or sheared, the bones below move
//! as the picture shows them, which is no rotation in the world; so the real pose is turned here, not a copy of it.

use glam::{DMat3, DMat4, DQuat, DVec3};

use super::arm::{AXIS, Arm};
use super::line_of_action::{FrameRates, Frames};

/// A joint with one axis, and what it moves. Everything is seen from the rig's root, in the file's unit, unless it says otherwise.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RevoluteJoint {
    /// The node above the joint.
    pub above: DMat4,
    /// The way back into it; `None` where it is flat, and nothing can be turned in it.
    pub back: Option<DMat4>,
    /// A point of the axis, in the axes of the node above.
    pub pivot: DVec3,
    /// Direction of the axis there, of length 1; the angle turns right-handed about it.
    pub axis: DVec3,
    /// The bones in some pose.
    pub bones: Vec<Bone>,
    /// The angle from which the joint turns them, degrees: for measurements the one that it has in that pose.
    pub at_rest: f64,
    /// Least and greatest angle, degrees.
    pub range: [f64; 2],
    /// The angles of all joints of the rig in that pose, degrees; not a number where one has none.
    pub angles: Vec<f64>,
    /// Which of them this joint is.
    pub own: Option<usize>,
}

/// A bone of a [`RevoluteJoint`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bone {
    /// Its matrix as the pose has it.
    pub matrix: DMat4,
    /// Whether the joint moves it.
    pub moves: bool,
    /// Whether offsets on it are along its axes in the file's unit; else they are scaled with it.
    pub plain: bool,
}

impl RevoluteJoint {
    /// A joint at `pivot` with this axis, both in the axes of the node above it, whose matrix is `above`.
    pub(super) fn new(above: DMat4, pivot: DVec3, axis: DVec3, bones: Vec<Bone>) -> Self {
        let back = Some(above.inverse()).filter(|back| back.is_finite() && above.determinant().abs() > f64::MIN_POSITIVE);
        Self { above, back, pivot, axis, bones, at_rest: 0.0, range: [0.0, 0.0], angles: Vec::new(), own: None }
    }

    /// The elbow of an arm; bone 0 is the upper rod, bone 1 the forearm.
    pub(super) fn elbow(arm: &Arm, range: [f64; 2]) -> Self {
        let [upper, forearm] = arm.frames(0.0);
        let bone = |matrix, moves| Bone { matrix, moves, plain: true };
        let bones = vec![bone(upper, false), bone(forearm, true)];
        Self { range, angles: vec![0.0], own: Some(0), ..Self::new(DMat4::IDENTITY, arm.elbow(), AXIS, bones) }
    }

    /// This joint in the pose that another joint makes by turning. `carried`: whether the other one moves the node above this one.
    pub(super) fn in_pose(&self, turned: &Turned<'_>, carried: bool) -> Self {
        let bone =
            |(bone, other): (&Bone, &Bone)| Bone { matrix: if other.moves { turned.turn * bone.matrix } else { bone.matrix }, ..*bone };
        let bones = self.bones.iter().zip(&turned.revolute.bones).map(bone).collect();
        let above = if carried { turned.turn * self.above } else { self.above };
        let angles = (0..turned.revolute.angles.len()).map(|index| turned.angle(index)).collect();
        Self { at_rest: self.at_rest, range: self.range, angles, own: self.own, ..Self::new(above, self.pivot, self.axis, bones) }
    }

    /// Where the tip of a vector that is fixed below the joint moves to as the angle rises.
    pub(super) fn bends(&self, vector: DVec3) -> DVec3 {
        self.back.map_or(DVec3::ZERO, |back| self.above.transform_vector3(self.axis.cross(back.transform_vector3(vector))))
    }

    /// The bones with the joint at this angle.
    pub(super) fn at(&self, degrees: f64) -> Turned<'_> {
        let Some(back) = self.back else { return Turned { revolute: self, degrees, turn: DMat4::IDENTITY, rate: DMat4::ZERO } };
        let turn = DMat3::from_quat(DQuat::from_axis_angle(self.axis, (degrees - self.at_rest).to_radians()));
        let [x, y, z] = [turn.x_axis, turn.y_axis, turn.z_axis].map(|column| self.axis.cross(column));
        let about = |linear: DMat3, still: DVec3| {
            let mut matrix = DMat4::from_mat3(linear);
            matrix.w_axis = (still - linear * self.pivot).extend(1.0);
            matrix
        };
        // A rate has no place of its own: where the turn has a 1 in the corner, it has a 0.
        let mut rate = about(DMat3::from_cols(x, y, z), DVec3::ZERO);
        rate.w_axis.w = 0.0;
        Turned { revolute: self, degrees, turn: self.above * about(turn, self.pivot) * back, rate: self.above * rate * back }
    }
}

/// The bones of a joint at one angle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turned<'a> {
    revolute: &'a RevoluteJoint,
    degrees: f64,
    turn: DMat4,
    /// Its change a radian; the last row is zero.
    rate: DMat4,
}

impl FrameRates for Turned<'_> {
    fn rate(&self, index: usize) -> DMat4 {
        let Some(bone) = self.revolute.bones.get(index).filter(|bone| bone.moves) else { return DMat4::ZERO };
        let (mut frame, mut rate) = (self.turn * bone.matrix, self.rate * bone.matrix);
        rate.w_axis.w = 0.0;
        if bone.plain {
            let axes = [&mut frame.x_axis, &mut frame.y_axis, &mut frame.z_axis];
            for (axis, rate) in axes.into_iter().zip([&mut rate.x_axis, &mut rate.y_axis, &mut rate.z_axis]) {
                // An axis that is kept at length 1 only turns.
                let (long, along) = (axis.length(), axis.normalize_or_zero());
                *rate = if long > 0.0 { (*rate - along * along.dot(*rate)) / long } else { glam::DVec4::ZERO };
            }
        }
        rate
    }

    fn angle_rate(&self, index: usize) -> f64 {
        f64::from(self.revolute.own == Some(index))
    }
}

impl Frames for Turned<'_> {
    fn angle(&self, index: usize) -> f64 {
        let posed = self.revolute.angles.get(index).copied().unwrap_or(f64::NAN);
        if self.revolute.own == Some(index) { posed + self.degrees - self.revolute.at_rest } else { posed }
    }

    fn frame(&self, index: usize) -> DMat4 {
        let Some(bone) = self.revolute.bones.get(index) else { return DMat4::IDENTITY };
        let frame = if bone.moves { self.turn * bone.matrix } else { bone.matrix };
        if bone.plain { plain(frame) } else { frame }
    }
}

/// The same place and directions with axes of length 1: offsets are in the muscle's own unit, whatever the bone's scale.
pub(super) fn plain(mut frame: DMat4) -> DMat4 {
    for axis in [&mut frame.x_axis, &mut frame.y_axis, &mut frame.z_axis] {
        *axis = axis.normalize_or_zero();
    }
    frame
}
