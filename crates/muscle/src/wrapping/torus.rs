//! The torus, with a path through its hole.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::cylinder;
use super::geodesic::{Accuracy, Bend, GeodesicEnd, GeodesicStart, integrate};
use super::shape::Curvature;
use super::touch::Touch;

/// Radii of the middle circle of the tube, and of the tube.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Torus {
    /// From the centre to the middle of the tube.
    pub major: f64,
    /// Of the tube.
    pub minor: f64,
}

/// Pieces in which the coarse searches look.
const PIECES: u32 = 24;
/// Bisections of the fine ones: enough to halve an interval down to rounding.
const GOLDEN_STEPS: usize = 44;

impl Torus {
    /// The direction away from the axis, and the distance from it.
    fn radial(point: DVec3) -> (DVec3, f64) {
        let flat = point.with_z(0.0);
        (flat.normalize_or(DVec3::X), flat.length())
    }

    /// From the middle of the tube to a point.
    fn tube_offset(&self, point: DVec3) -> DVec3 {
        let (radial, _) = Self::radial(point);
        point - radial * self.major
    }

    /// Distance of a point from the middle circle of the tube.
    pub(super) fn tube_distance(&self, point: DVec3) -> f64 {
        self.tube_offset(point).length()
    }

    pub(super) fn normal(&self, point: DVec3) -> DVec3 {
        self.tube_offset(point).normalize_or(DVec3::Z)
    }

    pub(super) fn project(&self, point: DVec3) -> DVec3 {
        let (radial, _) = Self::radial(point);
        radial * self.major + self.normal(point) * self.minor
    }

    /// Principal curvatures: 1 / minor along the meridian, cos φ / (major + minor cos φ) round the axis, negative on the inner side.
    pub(super) fn curvature(&self, point: DVec3, tangent: DVec3, binormal: DVec3) -> Curvature {
        let (radial, distance) = Self::radial(point);
        let normal = self.normal(point);
        let round = DVec3::Z.cross(radial);
        let meridian = round.cross(normal);
        let (k_meridian, k_round) = (self.minor.recip(), normal.dot(radial) / distance.max(self.major - self.minor));
        let [tm, tr, bm, br] = [tangent.dot(meridian), tangent.dot(round), binormal.dot(meridian), binormal.dot(round)];
        Curvature {
            along: tm * tm * k_meridian + tr * tr * k_round,
            twist: tm * bm * k_meridian + tr * br * k_round,
            across: bm * bm * k_meridian + br * br * k_round,
        }
    }

    /// An estimate of the arc: on the cylinder that the tube is near the place where the path comes closest. `None` where the straight line goes through the
    /// hole without touching, or does not go through it.
    pub(super) fn touch(&self, from: DVec3, to: DVec3) -> Option<Touch> {
        if from.z * to.z >= 0.0 {
            return None;
        }
        let along = (to - from).try_normalize()?;
        let crossing = from.lerp(to, from.z / (from.z - to.z));
        let azimuth = if crossing.truncate().length() < self.major {
            let closest = self.closest(from, to);
            if self.tube_distance(closest) >= self.minor {
                return None;
            }
            let radial = Self::radial(closest).0;
            return Some(self.touch_at(from, to, radial).unwrap_or_else(|| self.touch_of(closest, along)));
        } else {
            self.shortest_azimuth(from, to)
        };
        let radial = DVec2::from_angle(azimuth).extend(0.0);
        Some(self.touch_at(from, to, radial).unwrap_or_else(|| self.touch_of(radial * (self.major - self.minor), along)))
    }

    /// An arc of no length at the place of the surface that is nearest to `point`.
    fn touch_of(&self, point: DVec3, along: DVec3) -> Touch {
        let place = self.project(point);
        let tangent = along.reject_from_normalized(self.normal(place));
        Touch::at(place, tangent.try_normalize().unwrap_or_else(|| self.normal(place).any_orthonormal_vector()))
    }

    /// The arc on the cylinder that touches the tube all along the meridian at `radial`, brought to the torus.
    fn touch_at(&self, from: DVec3, to: DVec3, radial: DVec3) -> Option<Touch> {
        let round = DVec3::Z.cross(radial);
        let local = |point: DVec3| DVec3::new(point.dot(radial) - self.major, point.z, point.dot(round));
        let world = |vector: DVec3| radial * vector.x + DVec3::Z * vector.y + round * vector.z;
        let touch = cylinder::touch(self.minor, local(from), local(to), Some(DVec3::NEG_X), false)?;
        let place = |point: DVec3, tangent: DVec3| {
            let point = self.project(world(point) + radial * self.major);
            (point, world(tangent).reject_from_normalized(self.normal(point)).normalize_or(DVec3::Z))
        };
        let (point, tangent) = place(touch.start.point, touch.start.tangent);
        let (end, end_tangent) = place(touch.end, touch.end_tangent);
        Some(Touch { start: GeodesicStart { point, tangent, length: touch.start.length }, end, end_tangent })
    }

    /// The point of a straight line that is nearest to the middle of the tube.
    fn closest(&self, from: DVec3, to: DVec3) -> DVec3 {
        let at = |share: f64| from.lerp(to, share);
        at(minimum([0.0, 1.0], |share| self.tube_distance(at(share))))
    }

    /// Where round the hole the way over its rim is the shortest, as an angle from x.
    fn shortest_azimuth(&self, from: DVec3, to: DVec3) -> f64 {
        let rim = |azimuth: f64| (DVec2::from_angle(azimuth) * (self.major - self.minor)).extend(0.0);
        minimum([0.0, TAU], |azimuth| from.distance(rim(azimuth)) + rim(azimuth).distance(to))
    }
}

/// Where a function of an interval is smallest: the least of a row of places, made finer by golden section.
fn minimum([low, high]: [f64; 2], function: impl Fn(f64) -> f64) -> f64 {
    /// The smaller part of a golden section.
    const SMALL: f64 = 0.381_966_011_250_105_1;
    let step = (high - low) / f64::from(PIECES);
    let mut best = (low, f64::INFINITY);
    for piece in 0..=PIECES {
        let place = low + step * f64::from(piece);
        let value = function(place);
        if value < best.1 {
            best = (place, value);
        }
    }
    let (mut left, mut right) = (best.0 - step, best.0 + step);
    for _ in 0..GOLDEN_STEPS {
        let width = (right - left) * SMALL;
        if function(left + width) <= function(right - width) {
            right -= width;
        } else {
            left += width;
        }
    }
    0.5 * (left + right)
}

/// The geodesic from a point in a direction, integrated.
pub(super) fn shoot(torus: &Torus, start: &GeodesicStart, accuracy: Accuracy) -> GeodesicEnd {
    let round_curvature = |point: DVec3| {
        let (radial, distance) = Torus::radial(point);
        (radial, torus.normal(point).dot(radial) / distance.max(torus.major - torus.minor))
    };
    integrate(
        start,
        accuracy,
        |point, tangent| {
            let (radial, k_round) = round_curvature(point);
            let normal = torus.normal(point);
            let round = tangent.dot(DVec3::Z.cross(radial));
            // What is not round the axis is along the meridian.
            let across = tangent.length_squared() - round * round;
            Bend { acceleration: normal * -(round * round * k_round + across / torus.minor), gauss: k_round / torus.minor }
        },
        |_, _| torus.minor.recip().max((torus.major - torus.minor).recip()),
        |point| torus.project(point),
        |point| torus.normal(point),
    )
}
