//! The ellipsoid x²/a² + y²/b² + z²/c² = 1, and what becomes of it where it yields: one that is drawn out along a direction, as far as an elliptic cylinder.

use glam::{DMat3, DVec3};

use super::geodesic::{Accuracy, Bend, GeodesicEnd, GeodesicStart, integrate};
use super::shape::Curvature;
use super::sphere;
use super::touch::Touch;

/// The surface |T x| = 1, where T x = x / radii with the component along one direction squeezed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ellipsoid {
    /// Half its lengths along the axes, before it is drawn out.
    pub radii: DVec3,
    /// T: it makes the unit sphere of the surface, or of a cylinder the unit circle.
    to_unit: DMat3,
    /// The inverse of T; of a cylinder, back to the plane square to its axis.
    from_unit: DMat3,
    /// TᵀT, of which xᵀ(TᵀT)x = 1 is the surface.
    form: DMat3,
    /// Determinant of `form`; 0 of a cylinder.
    determinant: f64,
    /// The axis of a cylinder as a direction of x / radii.
    axis: Option<DVec3>,
}

/// An ellipsoid that is drawn out more than this is taken as a cylinder: its ends curve by less than the square of it.
const DRAWN: f64 = 1e-6;

/// A line that passes nearer to the centre than this, in radii, passes on no side.
const CENTRAL: f64 = 1e-9;

impl Ellipsoid {
    pub(super) fn new(radii: DVec3) -> Self {
        Self::drawn_out(radii, DVec3::X, 1.0)
    }

    /// With the component of x / radii along `axis` multiplied by `squeeze`, from 1 for none to 0 for a cylinder.
    pub(super) fn drawn_out(radii: DVec3, axis: DVec3, squeeze: f64) -> Self {
        let squeeze = if squeeze < DRAWN { 0.0 } else { squeeze };
        let along = DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z);
        let back = if squeeze > 0.0 { squeeze.recip() - 1.0 } else { -1.0 };
        let to_unit = (DMat3::IDENTITY - along * (1.0 - squeeze)) * DMat3::from_diagonal(radii.recip());
        let inverse = radii.recip();
        Self {
            radii,
            to_unit,
            from_unit: DMat3::from_diagonal(radii) * (DMat3::IDENTITY + along * back),
            form: to_unit.transpose() * to_unit,
            determinant: (squeeze * inverse.x * inverse.y * inverse.z).powi(2),
            axis: (squeeze == 0.0).then_some(axis),
        }
    }

    /// T of a point.
    pub(super) fn mapped(&self, point: DVec3) -> DVec3 {
        self.to_unit * point
    }

    /// The surface multiplied by `factor`.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let inverse = factor.recip();
        Self {
            radii: self.radii * factor,
            to_unit: self.to_unit * inverse,
            from_unit: self.from_unit * factor,
            form: self.form * (inverse * inverse),
            determinant: self.determinant * inverse.powi(6),
            axis: self.axis,
        }
    }

    /// Half the gradient of xᵀ(TᵀT)x: outwards.
    pub(super) fn gradient(&self, point: DVec3) -> DVec3 {
        self.form * point
    }

    /// The shape operator is the Hessian of the level function over the length of its gradient.
    pub(super) fn curvature(&self, point: DVec3, tangent: DVec3, binormal: DVec3) -> Curvature {
        let scale = self.gradient(point).length().recip();
        let turned = self.form * tangent;
        Curvature {
            along: turned.dot(tangent) * scale,
            twist: turned.dot(binormal) * scale,
            across: (self.form * binormal).dot(binormal) * scale,
        }
    }

    /// The point of the surface on the ray from the centre.
    pub(super) fn project(&self, point: DVec3) -> DVec3 {
        let level = (self.to_unit * point).length();
        if level > 0.0 { point / level } else { self.from_unit * self.to_unit.x_axis.normalize_or(DVec3::X) }
    }

    /// The path over the unit sphere that T makes of the ellipsoid, mapped back. Straight parts and the condition of touching are exact, as the map is linear;
    /// the arc is a plane section, which is a geodesic only where there is symmetry. The plane is that of the straight line and of the surface's normal over
    /// the middle of it: the centre says nothing of a long ellipsoid that is crossed near a tip.
    pub(super) fn touch(&self, from: DVec3, to: DVec3, side: Option<DVec3>) -> Option<Touch> {
        let Some(axis) = self.axis else {
            let (from, to) = (self.to_unit * from, self.to_unit * to);
            let along = (to - from).try_normalize()?;
            let out = from.reject_from_normalized(along);
            let normal = self.to_unit * self.gradient(self.from_unit * out);
            let up = if out.length() > CENTRAL { normal } else { side.unwrap_or_else(|| along.any_orthonormal_vector()) };
            let up = up.reject_from_normalized(along);
            let away = side.is_some_and(|side| out.dot(side) < -sphere::LEANS);
            return self.touch_by(from, to, if away { -up } else { up });
        };
        let touch = sphere::touch(1.0, self.to_unit * from, self.to_unit * to, side)?;
        // Along the axis of a cylinder the path advances evenly with its length across.
        let (from, to) = (from / self.radii, to / self.radii);
        let flat = |point: DVec3| point.reject_from_normalized(axis);
        let (before, after) = (flat(from).distance(touch.start.point), touch.end.distance(flat(to)));
        let rise = (to - from).dot(axis) / (before + touch.start.length + after);
        let mut raised = touch;
        raised.start.point += axis * (from.dot(axis) + rise * before);
        raised.end += axis * (to.dot(axis) - rise * after);
        Some(raised.mapped(DMat3::from_diagonal(self.radii), axis * rise))
    }

    /// The same over the side that is `turn` radians round the straight line from the nearer one.
    pub(super) fn touch_turned(&self, from: DVec3, to: DVec3, turn: f64) -> Option<Touch> {
        let (from, to) = (self.to_unit * from, self.to_unit * to);
        let along = (to - from).try_normalize()?;
        let up = from.reject_from_normalized(along).try_normalize().unwrap_or_else(|| along.any_orthonormal_vector());
        self.touch_by(from, to, up * turn.cos() + along.cross(up) * turn.sin())
    }

    /// The same on the way round that a direction shows.
    pub(super) fn touch_on(&self, from: DVec3, to: DVec3, way: DVec3) -> Option<Touch> {
        self.touch_by(self.to_unit * from, self.to_unit * to, self.to_unit * way)
    }

    fn touch_by(&self, from: DVec3, to: DVec3, up: DVec3) -> Option<Touch> {
        let along = (to - from).try_normalize()?;
        let out = from.reject_from_normalized(along);
        let up = up.reject_from_normalized(along).try_normalize()?;
        if out.length_squared() >= 1.0 {
            return None;
        }
        // The section by the plane of the straight line and `up`, a smaller circle where that misses the centre.
        let center = out - out.project_onto_normalized(up);
        let radius = (1.0 - center.length_squared()).max(0.0).sqrt();
        let touch = sphere::touch_over(radius, from - center, to - center, along, up)?;
        let place = |point: DVec3| (point + center).normalize_or(up);
        let (start, end) = (place(touch.start.point), place(touch.end));
        let tangent = touch.start.tangent.reject_from_normalized(start).normalize_or(along);
        let end_tangent = touch.end_tangent.reject_from_normalized(end).normalize_or(along);
        let start = GeodesicStart { point: start, tangent, length: touch.start.length };
        Some(Touch { start, end, end_tangent }.mapped(self.from_unit, DVec3::ZERO))
    }
}

/// The geodesic from a point in a direction, integrated.
pub(super) fn shoot(ellipsoid: &Ellipsoid, start: &GeodesicStart, accuracy: Accuracy) -> GeodesicEnd {
    let root = ellipsoid.determinant.sqrt();
    integrate(
        start,
        accuracy,
        |point, tangent| {
            let gradient = ellipsoid.gradient(point);
            let square = gradient.length_squared();
            Bend {
                acceleration: gradient * -((ellipsoid.form * tangent).dot(tangent) / square),
                // Gauss, with half gradients: K = det(TᵀT) / |TᵀT x|⁴; of an ellipsoid 1 / ((abc)² (x²/a⁴ + y²/b⁴ + z²/c⁴)²).
                gauss: ellipsoid.determinant / (square * square),
            }
        },
        |point, tangent| {
            // Nothing may change much in a step: neither direction nor normal, and it stays short beside the ellipsoid's own width along it.
            let scale = ellipsoid.gradient(point).length().recip();
            let turned = ellipsoid.form * tangent;
            (turned.length() * scale).max(root * scale * scale).max(turned.dot(tangent).max(0.0).sqrt())
        },
        |point| ellipsoid.project(point),
        |point| ellipsoid.gradient(point),
    )
}
