//! How a surface yields to a path that it cannot hold: to an end inside of it, and to a line that slips off sideways.
//!
//! A length must not jump where a path has no way round a surface as it stands. Both rules change the surface as continuous functions of the two points of the
//! stretch in the surface's frame, *before* any path is looked for; their derivatives are part of that of the length
//! ([`Solution::length_rate`](super::Solution::length_rate)).
//!
//! **An end inside.** The surface is shrunk about its centre (axis, middle of the tube) until the end lies outside of it by one part in 10⁴: on the surface
//! itself the tangent from the end would have no direction.
//!
//! **A side.** Map sphere and ellipsoid to the unit sphere, the cylinder to the unit circle. Let the straight line from end to end pass the centre at height
//! h towards the side and at offset u square to both. On its side, and within 45° of it (h > |u|), nothing yields: the path is the shortest one. When the line
//! goes to the other side (h < 0) the path stays on its own, over the surface. No round surface holds it there: the path would slip off sideways. So between
//! h = |u| and h = 0 the surface is drawn out along u until it is a cylinder, which a path can lie on anywhere, and moved along by u,
//! and shrunk where that has reached an end. Where the line is far out
//! (|u| from ½ to 1), or ends near the surface (its foot less than ½ from an end), the surface shrinks and moves to the line, until it does not act at all; so
//! that a line beyond it is free on any side.

use glam::DVec3;

use super::dual::{Dual, DualVec};
use super::ellipsoid::Ellipsoid;
use super::shape::Shape;

/// Ends are kept outside of a surface by this share of its size.
const CLEARANCE: f64 = 1e-4;
/// Less of the side's direction than this square to the line, and the line has no side.
const SIDEWAYS: f64 = 1e-6;

/// How a surface is changed in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Yielding {
    /// Factor of its size.
    pub scale: Dual,
    /// Where its centre is moved to.
    pub shift: DualVec,
    /// The direction along which it is drawn out, after the map to the unit sphere.
    pub across: DualVec,
    /// Factor of lengths along `across` in the map to the unit sphere: 1 for none, 0 for a cylinder.
    pub squeeze: Dual,
}

impl Yielding {
    pub(super) const NONE: Self = Self::of_size(Dual::ONE);

    const fn of_size(scale: Dual) -> Self {
        Self { scale, shift: DualVec::ZERO, across: DualVec::ZERO, squeeze: Dual::ONE }
    }

    /// Of a surface for a stretch from `from` to `to`, both in its frame.
    pub(super) fn of(shape: &Shape, side: Option<DVec3>, from: DualVec, to: DualVec) -> Self {
        let kept = |point| level(shape, point) * Dual::constant(1.0 - CLEARANCE);
        let held = Dual::ONE.min(kept(from)).min(kept(to));
        let sideways = match (side, unit(shape)) {
            (Some(side), Some(unit)) if held.value > 0.0 => {
                let inverse = held.recip();
                let flat = |point: DualVec| point.scaled(unit) * inverse;
                beside(side, flat(from), flat(to), matches!(shape, Shape::Cylinder(_))).map(|beside| {
                    let back = unit.map(|factor| if factor > 0.0 { factor.recip() } else { 0.0 });
                    Self { scale: beside.scale * held, shift: beside.shift.scaled(back) * held, ..beside }
                })
            }
            _ => None,
        };
        sideways.unwrap_or(Self::of_size(held))
    }

    /// The surface as it is changed, about its own centre.
    pub(super) fn changed(&self, shape: &Shape) -> Shape {
        let scaled = shape.scaled(self.scale.value);
        let radii = match scaled {
            Shape::Sphere(radius) => DVec3::splat(radius),
            Shape::Ellipsoid(ellipsoid) => ellipsoid.radii,
            Shape::Cylinder(_) | Shape::Torus(_) => return scaled,
        };
        if self.squeeze.value >= 1.0 {
            scaled
        } else {
            Shape::Ellipsoid(Ellipsoid::drawn_out(radii, self.across.value, self.squeeze.value))
        }
    }

    /// How fast the surface moves along its outward `normal` at a point of it, both in its frame. `shape` is the surface as it was given.
    pub(super) fn normal_speed(&self, shape: &Shape, point: DVec3, normal: DVec3) -> f64 {
        // Of a torus the tube alone grows.
        let Some(unit) = unit(shape) else { return shape.size() * self.scale.rate };
        let level = |yielding: &Self, point: DualVec| {
            let flat = (point - yielding.shift).scaled(unit) * yielding.scale.recip();
            (flat + yielding.across * ((yielding.squeeze - Dual::ONE) * yielding.across.dot(flat))).length().rate
        };
        let still = |value: Dual| Dual::constant(value.value);
        let at_rest = Self {
            scale: still(self.scale),
            shift: DualVec::constant(self.shift.value),
            across: DualVec::constant(self.across.value),
            squeeze: still(self.squeeze),
        };
        // A surface of level 1 moves by what the level loses in a fixed place, over what it gains along the normal.
        let gain = level(&at_rest, DualVec { value: point, rate: normal });
        if gain > 0.0 { -level(self, DualVec::constant(point)) / gain } else { 0.0 }
    }
}

/// Factors that map a shape to the unit sphere, or to the circle in the plane z = 0; none of a torus.
fn unit(shape: &Shape) -> Option<DVec3> {
    match shape {
        Shape::Sphere(radius) => Some(DVec3::splat(radius.recip())),
        Shape::Cylinder(radius) => Some(DVec3::splat(radius.recip()).with_z(0.0)),
        Shape::Ellipsoid(ellipsoid) => Some(ellipsoid.radii.recip()),
        Shape::Torus(_) => None,
    }
}

/// The factor of a shape's size at which a point lies on it.
fn level(shape: &Shape, point: DualVec) -> Dual {
    match (shape, unit(shape)) {
        (Shape::Torus(torus), _) => {
            let flat = point.scaled(DVec3::ONE.with_z(0.0)).length() - Dual::constant(torus.major);
            let high = point.dot(DualVec::constant(DVec3::Z));
            (flat * flat + high * high).sqrt() * Dual::constant(torus.minor.recip())
        }
        (_, Some(unit)) => point.scaled(unit).length(),
        (_, None) => Dual::ONE,
    }
}

/// How deep a point lies inside of a surface, along the ray from its centre (axis, middle of the tube); 0 outside.
pub(super) fn depth(shape: &Shape, point: DVec3) -> f64 {
    let level = level(shape, DualVec::constant(point)).value;
    if level >= 1.0 {
        return 0.0;
    }
    match shape {
        Shape::Sphere(radius) | Shape::Cylinder(radius) => radius * (1.0 - level),
        Shape::Torus(torus) => torus.minor * (1.0 - level),
        // At the centre, where no ray has a direction, the shortest way out.
        Shape::Ellipsoid(_) if level > 0.0 => point.length() * (level.recip() - 1.0).min(1e100),
        Shape::Ellipsoid(ellipsoid) => ellipsoid.radii.min_element(),
    }
}

/// How the unit sphere, or the unit circle, yields to a line with a side; `None` where it stays as it is.
fn beside(side: DVec3, from: DualVec, to: DualVec, flat: bool) -> Option<Yielding> {
    let line = to - from;
    let length = line.length();
    if length.value <= 0.0 {
        return None;
    }
    let along = line * length.recip();
    let side = DualVec::constant(side);
    let up = side - along * side.dot(along);
    let square = up.length();
    if square.value < SIDEWAYS {
        return None;
    }
    let up = up * square.recip();
    let across = up.cross(along);
    let height = from.dot(up);
    let offset = if flat { Dual::ZERO } else { from.dot(across) };
    if height.value >= offset.value.abs() {
        return None;
    }
    let yields = if height.value <= 0.0 { Dual::ONE } else { (Dual::ONE - height * offset.abs().recip()).step() };
    let double = Dual::constant(2.0);
    let before = (-(double * from.dot(along))).step();
    let after = (double * to.dot(along)).step();
    let keeps = ((Dual::ONE - offset.abs()) * double).step() * before * after;
    let lost = Dual::ONE - keeps;
    let scale = Dual::ONE - yields * lost;
    let shift = across * (offset * yields) + up * (lost * height.min(Dual::ZERO));
    let squeeze = if flat { Dual::ONE } else { Dual::ONE - yields };
    // What is drawn out may have reached an end.
    let kept = |point: DualVec| {
        let from_center = point - shift;
        let unit = from_center + across * ((squeeze - Dual::ONE) * across.dot(from_center));
        unit.length() * Dual::constant(1.0 - CLEARANCE)
    };
    let scale = scale.min(kept(from)).min(kept(to));
    Some(Yielding { scale, shift, across, squeeze })
}
