//! What a published model says about muscles: paths on segments, sizes, and the coordinates of its joints. Metres, newtons, degrees; the right side of a body.
//!
//! The axes of all segments in the model's default pose, standing upright, are x to the front, y up, z to the right.

use crate::config::WrapShape;

/// A rigid part of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Segment {
    Pelvis,
    Femur,
    Tibia,
    Foot,
    /// Scapula, clavicle and what they lie on.
    Girdle,
    Humerus,
    Forearm,
}

/// A degree of freedom between two segments; signs as in the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Coordinate {
    /// Forward is positive.
    HipFlexion,
    /// Inward is positive.
    HipAdduction,
    /// Inward is positive.
    HipRotation,
    /// Bent is negative.
    KneeAngle,
    /// Toes up is positive.
    AnkleAngle,
    /// Forward is positive.
    ShoulderElevation,
    /// Bent is positive.
    ElbowFlexion,
}

impl Coordinate {
    /// What joints of a muscle file are called, before the side.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::HipFlexion => "hip_flexion",
            Self::HipAdduction => "hip_adduction",
            Self::HipRotation => "hip_rotation",
            Self::KneeAngle => "knee_angle",
            Self::AnkleAngle => "ankle_angle",
            Self::ShoulderElevation => "shoulder_elevation",
            Self::ElbowFlexion => "elbow_flexion",
        }
    }

    /// The segment that it turns, with all beyond, and the one that this hangs on.
    pub(super) fn segments(self) -> [Segment; 2] {
        match self {
            Self::HipFlexion | Self::HipAdduction | Self::HipRotation => [Segment::Femur, Segment::Pelvis],
            Self::KneeAngle => [Segment::Tibia, Segment::Femur],
            Self::AnkleAngle => [Segment::Foot, Segment::Tibia],
            Self::ShoulderElevation => [Segment::Humerus, Segment::Girdle],
            Self::ElbowFlexion => [Segment::Forearm, Segment::Humerus],
        }
    }

    /// The axis that it turns about, in the axes of the segments, of length 1.
    pub(super) fn axis(self) -> [f64; 3] {
        match self {
            Self::HipAdduction => [1.0, 0.0, 0.0],
            Self::HipRotation => [0.0, 1.0, 0.0],
            Self::HipFlexion | Self::KneeAngle => [0.0, 0.0, 1.0],
            Self::AnkleAngle => [-0.10501355, -0.17402245, 0.97912632],
            Self::ShoulderElevation => [-0.05889802, 0.0023, 0.99826136],
            Self::ElbowFlexion => [0.04940001, 0.03660001, 0.99810825],
        }
    }
}

/// Where a segment begins and ends: the joint that it hangs on, and the next one.
pub(super) struct SegmentData {
    pub segment: Segment,
    pub begin: [f64; 3],
    pub end: [f64; 3],
}

/// A coordinate with its least and greatest angle, degrees.
pub(super) struct CoordinateData {
    pub coordinate: Coordinate,
    pub range: [f64; 2],
}

/// A point of a path.
pub(super) struct PointData {
    pub segment: Segment,
    /// Where it is; of one that moves, see `when`.
    pub place: [f64; 3],
    pub when: When,
}

/// When a point is passed, and where it is then.
pub(super) enum When {
    Always,
    /// While a coordinate lies in this range, degrees.
    Within(Coordinate, [f64; 2]),
    /// At places that depend on a coordinate: angles in degrees, and the place at each.
    Moving(Coordinate, &'static [(f64, [f64; 3])]),
}

/// A wrap surface of one muscle.
pub(super) struct WrapData {
    pub segment: Segment,
    pub shape: WrapShape,
    pub center: [f64; 3],
    /// Body-fixed turns about x, y and z, radians.
    pub rotation: [f64; 3],
    /// The side on which the muscle passes, along the surface's axes.
    pub side: [f64; 3],
    /// The points of the path between which it acts; `None` = all of it.
    pub between: Option<[usize; 2]>,
}

/// A muscle.
pub(super) struct MuscleData {
    /// What the model calls it, without the side.
    pub name: &'static str,
    /// Its anatomical name.
    pub meaning: &'static str,
    /// Greatest isometric force, newtons.
    pub force: f64,
    /// Optimal length of the fibres.
    pub fiber: f64,
    /// Slack length of the tendon.
    pub tendon: f64,
    /// The segment whose scale the muscle has.
    pub belly_on: Segment,
    /// Share of the tendon that lies at the origin.
    pub origin_tendon: f64,
    /// The share of the unit, from the origin, beyond which all is tendon.
    pub belly_end: f64,
    /// From origin to insertion.
    pub path: &'static [PointData],
    pub wraps: &'static [WrapData],
}

/// A model, or the part of it that is used.
pub(super) struct Model {
    pub name: &'static str,
    /// Authors and licence.
    pub credit: &'static str,
    pub segments: &'static [SegmentData],
    /// The main one first.
    pub coordinates: &'static [CoordinateData],
    pub muscles: &'static [MuscleData],
}

/// A point that is always passed.
pub(super) const fn fixed(segment: Segment, place: [f64; 3]) -> PointData {
    PointData { segment, place, when: When::Always }
}

/// A point that is passed while a coordinate lies in a range.
pub(super) const fn within(segment: Segment, place: [f64; 3], coordinate: Coordinate, range: [f64; 2]) -> PointData {
    PointData { segment, place, when: When::Within(coordinate, range) }
}

/// A point that moves with a coordinate.
pub(super) const fn moving(segment: Segment, coordinate: Coordinate, places: &'static [(f64, [f64; 3])]) -> PointData {
    PointData { segment, place: [0.0; 3], when: When::Moving(coordinate, places) }
}
