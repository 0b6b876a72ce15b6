//! The two ends of an arc as closed forms and estimates give them.

use glam::{DMat3, DVec3};

use super::geodesic::GeodesicStart;

/// An arc on a surface, in the surface's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Touch {
    /// Where the path touches down, its direction there, and the length of the arc.
    pub start: GeodesicStart,
    /// Where it lifts off.
    pub end: DVec3,
    /// Its direction there, of length 1.
    pub end_tangent: DVec3,
}

impl Touch {
    /// An arc of no length.
    pub(super) fn at(point: DVec3, tangent: DVec3) -> Self {
        Self { start: GeodesicStart { point, tangent, length: 0.0 }, end: point, end_tangent: tangent }
    }

    /// The image under a linear map of an arc of the unit circle that rises by `rise` for each unit of its length; its length is measured along the image.
    pub(super) fn mapped(&self, map: DMat3, rise: DVec3) -> Self {
        /// Pairs of pieces of Simpson's rule.
        const PAIRS: u32 = 4;
        let GeodesicStart { point, tangent, length } = self.start;
        // What of the point lies along the axis that the arc rises by does not turn with it.
        let outward = if rise == DVec3::ZERO { point } else { point.reject_from(rise) };
        let speed = |angle: f64| (map * (tangent * angle.cos() - outward * angle.sin() + rise)).length();
        let step = length / f64::from(2 * PAIRS);
        let sum: f64 = (0..PAIRS)
            .map(|pair| {
                let left = f64::from(2 * pair) * step;
                speed(left) + 4.0 * speed(left + step) + speed(left + 2.0 * step)
            })
            .sum();
        Self {
            start: GeodesicStart { point: map * point, tangent: (map * (tangent + rise)).normalize_or(DVec3::X), length: sum * step / 3.0 },
            end: map * self.end,
            end_tangent: (map * (self.end_tangent + rise)).normalize_or(DVec3::X),
        }
    }
}
