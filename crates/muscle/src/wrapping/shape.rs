//! The local geometry that every surface has: normal, curvature, geodesics. The formulas of each lie in a file of its name.

use glam::DVec3;

use super::ellipsoid::Ellipsoid;
use super::geodesic::{Accuracy, GeodesicEnd, GeodesicStart};
use super::surface::Surface;
use super::torus::Torus;
use super::touch::Touch;
use super::{cylinder, ellipsoid, sphere, torus};

/// Smallest and largest radius of a surface that acts: their squares and fourth powers neither vanish nor overflow.
const RADIUS: std::ops::RangeInclusive<f64> = 1e-50..=1e50;

/// A surface whose radii are sound, in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "a handful of them live at a time, and a box would be memory asked for in each solution")]
pub(super) enum Shape {
    /// Radius.
    Sphere(f64),
    /// Radius.
    Cylinder(f64),
    /// With what follows from its radii.
    Ellipsoid(Ellipsoid),
    /// Major and minor radius.
    Torus(Torus),
}

/// The shape operator S (the derivative of the outward normal) at a point, in an orthonormal basis of the tangent plane (tangent, binormal).
///
/// Convex surfaces have positive curvatures: the normal turns towards where one walks.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Curvature {
    /// Normal curvature along the tangent: t·S t.
    pub along: f64,
    /// Geodesic torsion: b·S t.
    pub twist: f64,
    /// Normal curvature along the binormal: b·S b.
    pub across: f64,
}

impl Shape {
    /// The shape of a surface; `None` where it is inert.
    pub(super) fn new(surface: &Surface) -> Option<Self> {
        let sound = |radius: f64| RADIUS.contains(&radius);
        match *surface {
            Surface::Sphere { radius } => sound(radius).then_some(Shape::Sphere(radius)),
            Surface::Cylinder { radius, .. } => sound(radius).then_some(Shape::Cylinder(radius)),
            Surface::Ellipsoid { radii } => radii.to_array().into_iter().all(sound).then(|| Shape::Ellipsoid(Ellipsoid::new(radii))),
            Surface::Torus { major, minor } => {
                (sound(major) && sound(minor) && minor < major).then_some(Shape::Torus(Torus { major, minor }))
            }
        }
    }

    /// The shape multiplied by `factor`; of a torus the tube alone, so that the hole's middle circle stays.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        match self {
            Shape::Sphere(radius) => Shape::Sphere(radius * factor),
            Shape::Cylinder(radius) => Shape::Cylinder(radius * factor),
            Shape::Ellipsoid(ellipsoid) => Shape::Ellipsoid(ellipsoid.scaled(factor)),
            Shape::Torus(torus) => Shape::Torus(Torus { minor: torus.minor * factor, ..*torus }),
        }
    }

    /// A length to measure steps on the surface by: its smallest radius.
    pub(super) fn size(&self) -> f64 {
        match self {
            Shape::Sphere(radius) | Shape::Cylinder(radius) => *radius,
            Shape::Ellipsoid(ellipsoid) => ellipsoid.radii.min_element(),
            Shape::Torus(torus) => torus.minor,
        }
    }

    /// The outward normal at a point of the surface, of length 1.
    pub(super) fn normal(&self, point: DVec3) -> DVec3 {
        match self {
            Shape::Sphere(_) => point.normalize_or(DVec3::X),
            Shape::Cylinder(_) => point.with_z(0.0).normalize_or(DVec3::X),
            Shape::Ellipsoid(ellipsoid) => ellipsoid.gradient(point).normalize_or(DVec3::X),
            Shape::Torus(torus) => torus.normal(point),
        }
    }

    /// The shape operator at a point of the surface in the basis of two tangents.
    pub(super) fn curvature(&self, point: DVec3, tangent: DVec3, binormal: DVec3) -> Curvature {
        match self {
            Shape::Sphere(radius) => Curvature { along: radius.recip(), twist: 0.0, across: radius.recip() },
            Shape::Cylinder(radius) => cylinder::curvature(*radius, point, tangent, binormal),
            Shape::Ellipsoid(ellipsoid) => ellipsoid.curvature(point, tangent, binormal),
            Shape::Torus(torus) => torus.curvature(point, tangent, binormal),
        }
    }

    /// A point of the surface near a point: along the ray from the centre, from the axis, or from the middle of the tube.
    pub(super) fn project(&self, point: DVec3) -> DVec3 {
        match self {
            Shape::Sphere(radius) => point.normalize_or(DVec3::X) * *radius,
            Shape::Cylinder(radius) => (point.with_z(0.0).normalize_or(DVec3::X) * *radius).with_z(point.z),
            Shape::Ellipsoid(ellipsoid) => ellipsoid.project(point),
            Shape::Torus(torus) => torus.project(point),
        }
    }

    /// The geodesic from a point in a direction, with its Jacobi fields. Negative lengths run backwards.
    pub(super) fn shoot(&self, start: &GeodesicStart) -> GeodesicEnd {
        self.shoot_within(start, Accuracy::Exact)
    }

    /// [`Shape::shoot`] as exactly as asked for, or better.
    pub(super) fn shoot_within(&self, start: &GeodesicStart, accuracy: Accuracy) -> GeodesicEnd {
        match self {
            Shape::Sphere(radius) => sphere::shoot(*radius, start),
            Shape::Cylinder(radius) => cylinder::shoot(*radius, start),
            Shape::Ellipsoid(ellipsoid) => ellipsoid::shoot(ellipsoid, start, accuracy),
            Shape::Torus(torus) => torus::shoot(torus, start, accuracy),
        }
    }

    /// Where a path from `from` to `to` lies on the surface: exactly on spheres and cylinders, nearly on the others. `None` where the straight line clears it.
    /// `around`: round a cylinder it may go by more than half a turn.
    pub(super) fn touch(&self, from: DVec3, to: DVec3, side: Option<DVec3>, around: bool) -> Option<Touch> {
        match self {
            Shape::Sphere(radius) => sphere::touch(*radius, from, to, side),
            Shape::Cylinder(radius) => cylinder::touch(*radius, from, to, side, around),
            Shape::Ellipsoid(ellipsoid) => ellipsoid.touch(from, to, side),
            Shape::Torus(torus) => torus.touch(from, to),
        }
    }

    /// Whether [`Shape::touch`] is exact.
    pub(super) fn is_exact(&self) -> bool {
        matches!(self, Shape::Sphere(_) | Shape::Cylinder(_))
    }

    /// How far from the centre (axis) a straight line passes, in radii; `None` of a shape that has but one way round.
    pub(super) fn passes(&self, from: DVec3, to: DVec3) -> Option<f64> {
        let (from, to) = match self {
            Shape::Sphere(radius) => (from / *radius, to / *radius),
            Shape::Cylinder(radius) => (from.with_z(0.0) / *radius, to.with_z(0.0) / *radius),
            Shape::Ellipsoid(ellipsoid) => (ellipsoid.mapped(from), ellipsoid.mapped(to)),
            Shape::Torus(_) => return None,
        };
        Some(from.reject_from_normalized((to - from).try_normalize()?).length())
    }
}
