//! The ellipsoid x²/a² + y²/b² + z²/c² = 1.

use glam::DVec3;

use super::geodesic::{Bend, GeodesicEnd, GeodesicStart, integrate};
use super::guess::Touch;
use super::shape::Curvature;
use super::sphere;

/// Radii and what follows from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ellipsoid {
    /// Half its lengths along the axes.
    pub radii: DVec3,
    /// 1 / radii².
    inverse_squares: DVec3,
    /// 1 / (abc)².
    inverse_volume_square: f64,
}

impl Ellipsoid {
    pub(super) fn new(radii: DVec3) -> Self {
        let inverse = radii.recip();
        Self { radii, inverse_squares: inverse * inverse, inverse_volume_square: (inverse.x * inverse.y * inverse.z).powi(2) }
    }

    /// Half the gradient of x²/a² + y²/b² + z²/c²: outwards.
    pub(super) fn gradient(&self, point: DVec3) -> DVec3 {
        point * self.inverse_squares
    }

    /// The shape operator is the Hessian of the level function over the length of its gradient.
    pub(super) fn curvature(&self, point: DVec3, tangent: DVec3, binormal: DVec3) -> Curvature {
        let scale = self.gradient(point).length().recip();
        let turned = tangent * self.inverse_squares;
        Curvature {
            along: turned.dot(tangent) * scale,
            twist: turned.dot(binormal) * scale,
            across: (binormal * self.inverse_squares).dot(binormal) * scale,
        }
    }

    /// The point of the surface on the ray from the centre.
    pub(super) fn project(&self, point: DVec3) -> DVec3 {
        (point / self.radii).normalize_or(DVec3::X) * self.radii
    }

    /// The path over the unit sphere that x ↦ x / radii makes of the ellipsoid, mapped back. Straight parts and the condition of touching are exact, as the
    /// map is affine; the arc is a section through the centre, which is a geodesic only where there is symmetry.
    pub(super) fn touch(&self, from: DVec3, to: DVec3, side: Option<DVec3>) -> Option<Touch> {
        sphere::touch(1.0, from / self.radii, to / self.radii, side).map(|touch| touch.stretched(self.radii))
    }

    /// The same over the side that is `turn` radians round the straight line from the nearer one.
    pub(super) fn touch_turned(&self, from: DVec3, to: DVec3, turn: f64) -> Option<Touch> {
        let (from, to) = (from / self.radii, to / self.radii);
        let along = (to - from).try_normalize()?;
        let out = from.reject_from_normalized(along);
        if out.length_squared() >= 1.0 {
            return None;
        }
        let up = out.try_normalize().unwrap_or_else(|| along.any_orthonormal_vector());
        let up = (up * turn.cos() + along.cross(up) * turn.sin()).reject_from_normalized(along).try_normalize()?;
        // Tangent points in the plane of both ends and the centre for the nearer side, in a plane that is turned about the straight line for the others.
        let center = out - out.project_onto_normalized(up);
        let radius = (1.0 - center.length_squared()).max(0.0).sqrt();
        let touch = sphere::touch_over(radius, from - center, to - center, along, up)?;
        let place = |point: DVec3| (point + center).normalize_or(up);
        let (start, end) = (place(touch.start.point), place(touch.end));
        let tangent = touch.start.tangent.reject_from_normalized(start).normalize_or(along);
        let end_tangent = touch.end_tangent.reject_from_normalized(end).normalize_or(along);
        let start = GeodesicStart { point: start, tangent, length: touch.start.length };
        Some(Touch { start, end, end_tangent }.stretched(self.radii))
    }
}

/// The geodesic from a point in a direction, integrated.
pub(super) fn shoot(ellipsoid: &Ellipsoid, start: &GeodesicStart) -> GeodesicEnd {
    integrate(
        start,
        |point, tangent| {
            let gradient = ellipsoid.gradient(point);
            let square = gradient.length_squared();
            Bend {
                acceleration: gradient * -((tangent * ellipsoid.inverse_squares).dot(tangent) / square),
                // Gauss: K = 1 / ((abc)² (x²/a⁴ + y²/b⁴ + z²/c⁴)²).
                gauss: ellipsoid.inverse_volume_square / (square * square),
            }
        },
        |point, tangent| {
            // Nothing may change much in a step: neither direction nor normal, and it stays short beside the ellipsoid's own width along it.
            let scale = ellipsoid.gradient(point).length().recip();
            let turned = tangent * ellipsoid.inverse_squares;
            let gauss = ellipsoid.inverse_volume_square.sqrt() * scale * scale;
            (turned.length() * scale).max(gauss).max(turned.dot(tangent).sqrt())
        },
        |point| ellipsoid.project(point),
        |point| ellipsoid.gradient(point),
    )
}
