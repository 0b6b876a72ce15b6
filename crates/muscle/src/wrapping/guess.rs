//! The two ends of an arc as closed forms and estimates give them.

use glam::DVec3;

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

    /// The image of an arc on the unit sphere under x ↦ scale ∘ x; its length is measured along the image.
    pub(super) fn stretched(&self, scale: DVec3) -> Self {
        /// Points of Simpson's rule are twice as many, and one.
        const PIECES: u32 = 4;
        let GeodesicStart { point, tangent, length } = self.start;
        let speed = |angle: f64| ((tangent * angle.cos() - point * angle.sin()) * scale).length();
        let step = length / f64::from(2 * PIECES);
        let sum: f64 = (0..PIECES)
            .map(|piece| {
                let left = f64::from(2 * piece) * step;
                speed(left) + 4.0 * speed(left + step) + speed(left + 2.0 * step)
            })
            .sum();
        Self {
            start: GeodesicStart {
                point: point * scale,
                tangent: (tangent * scale).normalize_or(DVec3::X),
                length: sum * step / 3.0,
            },
            end: self.end * scale,
            end_tangent: (self.end_tangent * scale).normalize_or(DVec3::X),
        }
    }
}
