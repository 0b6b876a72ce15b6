//! A point that a line of action passes: always, in a range of a joint's angle, or at a place that moves with one.

use glam::DVec3;

use super::config::PointMotion;
use super::line_of_action::Point;

/// A range of angles ends this much later, degrees: OpenSim's tolerance of 1e-5 radians.
const TOLERANCE: f64 = 1e-5 * 180.0 / std::f64::consts::PI;

/// A point that a line of action passes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ViaPoint {
    /// Where it is, unless it moves.
    pub point: Point,
    /// The joint (of the rig's list) and the range of its angle, degrees, in which it is passed.
    pub active: Option<(usize, [f64; 2])>,
    /// The joint that moves it, and how.
    pub moves: Option<(usize, MotionCurve)>,
}

impl ViaPoint {
    /// Whether it is passed where the rig's joints have these angles.
    pub(super) fn is_active(&self, angle: impl Fn(usize) -> f64) -> bool {
        self.active.is_none_or(|(joint, [low, high])| {
            let angle = angle(joint);
            // A joint that has no angle excludes nothing.
            !(angle < low - TOLERANCE || angle > high + TOLERANCE)
        })
    }

    /// Its place on its bone.
    pub(super) fn local(&self, angle: impl Fn(usize) -> f64) -> DVec3 {
        self.moves.as_ref().map_or(self.point.local, |(joint, curve)| curve.at(angle(*joint)).0)
    }

    /// The change of that place a radian of each joint's angle, which changes at these rates.
    pub(super) fn rate(&self, angle: impl Fn(usize) -> f64, rate: impl Fn(usize) -> f64) -> DVec3 {
        let slope = |(joint, curve): &(usize, MotionCurve)| curve.at(angle(*joint)).1 * (rate(*joint) * 1f64.to_degrees());
        self.moves.as_ref().map_or(DVec3::ZERO, slope)
    }
}

/// The place of a point over an angle: a natural cubic spline, straight on beyond its ends.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MotionCurve {
    angles: Vec<f64>,
    places: Vec<DVec3>,
    /// Second derivatives at the angles.
    bends: Vec<DVec3>,
}

impl MotionCurve {
    /// The spline through the places of a file.
    pub(super) fn new(motion: &PointMotion) -> Self {
        let count = motion.angles.len().min(motion.offsets.len());
        let (angles, places) = (motion.angles[..count].to_vec(), motion.offsets[..count].to_vec());
        let bends = natural_bends(&angles, &places);
        Self { angles, places, bends }
    }

    /// Place and slope (a degree) at an angle, degrees.
    pub(super) fn at(&self, angle: f64) -> (DVec3, DVec3) {
        let last = self.angles.len().saturating_sub(1);
        let (Some(first_angle), Some(last_angle)) = (self.angles.first(), self.angles.last()) else { return (DVec3::ZERO, DVec3::ZERO) };
        let held = if angle.is_nan() { *first_angle } else { angle.clamp(*first_angle, *last_angle) };
        let span = self.angles.partition_point(|known| *known <= held).clamp(1, last.max(1)) - 1;
        let both = |list: &[DVec3]| (list.get(span).copied().unwrap_or_default(), list.get(span + 1).copied().unwrap_or_default());
        let ((p, q), (a, b)) = (both(&self.places), both(&self.bends));
        let start = self.angles.get(span).copied().unwrap_or_default();
        let width = self.angles.get(span + 1).copied().unwrap_or(start) - start;
        if width <= 0.0 {
            return (p, DVec3::ZERO);
        }
        let (s, t) = (1.0 - (held - start) / width, (held - start) / width);
        let sixth = width * width / 6.0;
        let place = p * s + q * t + (a * (s * s * s - s) + b * (t * t * t - t)) * sixth;
        let slope = (q - p) / width + (b * (3.0 * t * t - 1.0) - a * (3.0 * s * s - 1.0)) * (width / 6.0);
        let beyond = if angle.is_finite() { angle - held } else { 0.0 };
        (place + slope * beyond, slope)
    }
}

/// Second derivatives of the natural cubic spline: 0 at both ends, and between them the tridiagonal system of a continuous second derivative.
fn natural_bends(angles: &[f64], places: &[DVec3]) -> Vec<DVec3> {
    let count = angles.len();
    let mut bends = vec![DVec3::ZERO; count];
    let mut factors = vec![0.0; count];
    for ((index, angle), place) in angles.windows(3).enumerate().zip(places.windows(3)) {
        let ([a, b, c], [p, q, r]) = ([angle[0], angle[1], angle[2]], [place[0], place[1], place[2]]);
        let weight = (b - a) / (c - a);
        let pivot = weight * factors[index] + 2.0;
        factors[index + 1] = (weight - 1.0) / pivot;
        let bend = ((r - q) / (c - b) - (q - p) / (b - a)) * (6.0 / (c - a));
        bends[index + 1] = (bend - bends[index] * weight) / pivot;
    }
    for index in (1..count.saturating_sub(1)).rev() {
        let after = bends[index + 1];
        bends[index] += after * factors[index];
    }
    bends
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_moves_along_a_natural_spline() {
        let offsets = [0.0, 1.0, 0.0, -1.0].map(|y: f64| DVec3::new(y, 2.0 * y, 3.0)).to_vec();
        let curve = MotionCurve::new(&PointMotion { joint: String::new(), angles: vec![-10.0, 0.0, 20.0, 50.0], offsets: offsets.clone() });
        for (angle, offset) in [-10.0, 0.0, 20.0, 50.0].into_iter().zip(&offsets) {
            assert!(curve.at(angle).0.distance(*offset) < 1e-14);
        }
        // Slope and curvature are continuous, the curvature is 0 at the ends and beyond, and the slope is the derivative.
        let bend = |angle: f64| (curve.at(angle + 1e-4).1 - curve.at(angle - 1e-4).1) / 2e-4;
        for angle in [-10.0, 0.0, 20.0, 50.0, 7.0, 33.0, 80.0] {
            assert!(curve.at(angle + 1e-9).1.distance(curve.at(angle - 1e-9).1) < 1e-8, "{angle}");
            let slope = (curve.at(angle + 1e-5).0 - curve.at(angle - 1e-5).0) / 2e-5;
            assert!(slope.distance(curve.at(angle).1) < 1e-8, "{angle}");
        }
        assert!(bend(-12.0).length() < 1e-9 && bend(60.0).length() < 1e-9 && bend(-9.9998).length() < 1e-4 && bend(5.0).length() > 1e-3);
        assert!(curve.at(f64::NAN).0.is_finite() && curve.at(f64::INFINITY).0.is_finite());
    }

    #[test]
    fn two_places_are_a_straight_line() {
        let motion = PointMotion { joint: String::new(), angles: vec![0.0, 90.0], offsets: vec![DVec3::ZERO, DVec3::new(9.0, 0.0, 0.0)] };
        let curve = MotionCurve::new(&motion);
        for angle in [-30.0, 0.0, 45.0, 120.0] {
            assert!(curve.at(angle).0.distance(DVec3::X * (0.1 * angle)) < 1e-14);
        }
    }
}
