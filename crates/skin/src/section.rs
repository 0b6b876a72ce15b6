//! What the skin is told of muscles and bones at one moment, in the world.

use std::ops::Range;

use glam::DVec3;

/// A cross-section of a muscle or tendon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossSection {
    /// Its centre, metres.
    pub center: DVec3,
    /// Direction of the muscle's line, of length 1.
    pub tangent: DVec3,
    /// Radius of the circle of the same area, metres.
    pub radius: f64,
    /// How it is flattened: half axes `radius · √flatness` across and `radius / √flatness` along [`CrossSection::flattened_along`]; 1 = a circle.
    pub flatness: f64,
    /// The direction that it is flattened along, of length 1; of no meaning where [`CrossSection::flatness`] is 1.
    pub flattened_along: DVec3,
    /// Half of the length of line that it stands for, metres.
    pub half_length: f64,
    /// Volume of that length, m³.
    pub volume: f64,
    /// Whether it belongs to the belly; else to a tendon.
    pub belly: bool,
}

/// A bone as a straight line between two joints, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// One joint.
    pub start: DVec3,
    /// The other; of the last bone of a limb, its tip.
    pub end: DVec3,
}

impl Segment {
    /// Where the foot of the perpendicular from a point stands: 0 at the start, 1 at the end. 0 for a bone without a length.
    pub(crate) fn share(&self, point: DVec3) -> f64 {
        let along = self.end - self.start;
        let square = along.length_squared();
        if square > 0.0 { (point - self.start).dot(along) / square } else { 0.0 }
    }
}

/// What stays the same of a muscle in all poses.
#[derive(Debug, Clone, PartialEq)]
pub struct MuscleTissue {
    /// Which of the cross-sections are its own, from origin to insertion.
    pub sections: Range<usize>,
    /// Which of the bones it runs along, from the one of its origin to the one of its insertion.
    pub bones: Vec<usize>,
    /// How its skin lies over it.
    pub layer: SkinLayer,
}

/// How skin lies over a muscle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkinLayer {
    /// Thickness of the tissue between muscle and skin, metres.
    pub fat: f64,
    /// How far from the muscle's surface skin follows it, metres.
    pub reach: f64,
    /// How much skin round a bulge is drawn along with it, 0 to 1.
    pub elasticity: f64,
}

impl Default for SkinLayer {
    /// 3 mm of fat, a reach of 40 mm, half of the elasticity.
    fn default() -> Self {
        Self { fat: 0.003, reach: 0.04, elasticity: 0.5 }
    }
}
