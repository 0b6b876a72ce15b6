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
//! h towards the side and at offset u square to both. A *cylinder* holds a path on its side as it is.
//!
//! On the side of a *sphere* (h ≥ 0) nothing yields, and the path is the shortest one. When the line is on the other side (h < 0), the path still passes on its
//! own: in the direction (|h|, u), to which the line's own direction (h, u) is mirrored. No sphere would hold it there, it would slip off sideways; so the
//! sphere is drawn out, square to that direction, to a cylinder, which a path can lie on anywhere. Seen along that cylinder the line passes at the height
//! H = (u² − h²) / √(u² + h²). At h = 0 that is |u|, with no slope, as it is on the sphere itself, so that length and moment arm go on without a jump; at u = 0
//! it is h, and the sphere a pulley. Beside other surfaces, which bend the path away from the straight line, it is drawn out by and by until H = 0.
//!
//! On an *ellipsoid* the two paths would differ. It is what was given while the line is not more than 45° off its side (h > |u|); between h = |u| and h = 0
//! it is drawn out along u until it is a cylinder, and moved along by u. Where the line is far out (|u| from ½ to 1), it shrinks and moves to the line until it
//! does not act at all, so that a line beyond it is free on any side.
//!
//! A path on the side goes round by more than half a turn where an end lies behind the surface. Round a sphere or a cylinder that is alone on the stretch it may
//! do so until both ends are seen from the centre in nearly the same direction: between 30° and 10° the surface shrinks and moves to the line. Round an
//! ellipsoid, and beside other surfaces, it shrinks as soon as the line's foot is less than ½ from an end.

use glam::{DMat3, DVec3};

use super::dual::{Dual, DualVec};
use super::ellipsoid::Ellipsoid;
use super::newton::Placed;
use super::shape::Shape;

/// Ends are kept outside of a surface by this share of its size.
const CLEARANCE: f64 = 1e-4;
/// Cosines of the angles between both ends, seen from the centre, between which a surface behind which they lie gives way.
const NARROW: [f64; 2] = [0.866_025_403_784_438_6, 0.984_807_753_012_208];
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
    /// The direction in which the path passes the centre, after that map; `None` where the surface does not yield to a side.
    pub passes: Option<DVec3>,
}

impl Yielding {
    pub(super) const NONE: Self = Self::of_size(Dual::ONE);

    const fn of_size(scale: Dual) -> Self {
        Self { scale, shift: DualVec::ZERO, across: DualVec::ZERO, squeeze: Dual::ONE, passes: None }
    }

    /// Of a surface for a stretch from `from` to `to`, both in its frame; `alone`: no other surface may act on the stretch.
    pub(super) fn of(shape: &Shape, side: Option<DVec3>, alone: bool, from: DualVec, to: DualVec) -> Self {
        let kept = |point| level(shape, point) * Dual::constant(1.0 - CLEARANCE);
        let held = Dual::ONE.min(kept(from)).min(kept(to));
        let sideways = match (side, unit(shape)) {
            (Some(side), Some(unit)) if held.value > 0.0 => {
                let inverse = held.recip();
                let flat = |point: DualVec| point.scaled(unit) * inverse;
                beside(side, flat(from), flat(to), shape, alone).map(|beside| {
                    let back = unit.map(|factor| if factor > 0.0 { factor.recip() } else { 0.0 });
                    Self { scale: beside.scale * held, shift: beside.shift.scaled(back) * held, ..beside }
                })
            }
            _ => None,
        };
        sideways.unwrap_or(Self::of_size(held))
    }

    /// The surface as it is changed, and the side of it that the path passes on, in its new frame.
    pub(super) fn changed(&self, placed: &Placed, side: Option<DVec3>) -> (Placed, Option<DVec3>) {
        let shape = placed.shape.scaled(self.scale.value);
        let center = placed.to_world(self.shift.value);
        let plain = |shape| (Placed { shape, rotation: placed.rotation, center }, side);
        let Some(passes) = self.passes else { return plain(shape) };
        let axis = self.across.value;
        match shape {
            // A sphere that is drawn out to the end is a cylinder, of which paths have a closed form.
            Shape::Sphere(radius) if self.squeeze.value <= 0.0 => {
                let rotation = placed.rotation * DMat3::from_cols(passes, axis.cross(passes), axis);
                (Placed { shape: Shape::Cylinder(radius), rotation, center }, Some(DVec3::X))
            }
            Shape::Sphere(_) | Shape::Ellipsoid(_) if self.squeeze.value < 1.0 => {
                let radii = match shape {
                    Shape::Ellipsoid(ellipsoid) => ellipsoid.radii,
                    _ => DVec3::splat(shape.size()),
                };
                let drawn = Ellipsoid::drawn_out(radii, axis, self.squeeze.value);
                (Placed { shape: Shape::Ellipsoid(drawn), rotation: placed.rotation, center }, Some(passes))
            }
            shape => plain(shape),
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
            passes: self.passes,
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

/// How a shape whose image under the map is the unit sphere, or the unit circle of a cylinder, yields to a line with a side; `None` where it stays as it is.
/// `alone`: no other surface may act on the stretch.
fn beside(side: DVec3, from: DualVec, to: DualVec, shape: &Shape, alone: bool) -> Option<Yielding> {
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
    let double = Dual::constant(2.0);
    let ends = [from.dot(along), to.dot(along)];
    let room = (-(double * ends[0])).step() * (double * ends[1]).step();
    let line = Line { along, up, across, height: from.dot(up), offset: from.dot(across), ends, room, alone };
    let side = match shape {
        Shape::Cylinder(_) => line.beside_circle(),
        Shape::Sphere(_) => line.beside_sphere(),
        Shape::Ellipsoid(_) | Shape::Torus(_) => line.beside_ellipsoid(),
    }?;
    // What is drawn out may have reached an end.
    let kept = |point: DualVec| {
        let from_center = point - side.shift;
        let unit = from_center + side.across * ((side.squeeze - Dual::ONE) * side.across.dot(from_center));
        unit.length() * Dual::constant(1.0 - CLEARANCE)
    };
    Some(Yielding { scale: side.scale.min(kept(from)).min(kept(to)), ..side })
}

/// A straight line seen from the centre of the unit sphere.
struct Line {
    /// Its direction.
    along: DualVec,
    /// The side, square to the line.
    up: DualVec,
    /// Square to both.
    across: DualVec,
    /// How far the line passes towards `up`: h.
    height: Dual,
    /// How far it passes towards `across`: u.
    offset: Dual,
    /// How far along it its ends are from the foot of the centre.
    ends: [Dual; 2],
    /// 1 where both ends are further than half a radius from the foot of the centre, 0 where the foot lies beyond an end.
    room: Dual,
    /// Whether no other surface may act on the stretch.
    alone: bool,
}

impl Line {
    /// How a path that goes round the far side of a circle gives way, where the line passes below its centre at this height: what is left of the size, and where
    /// the centre goes along `along` and up.
    fn gives_way(&self, height: Dual) -> (Dual, [Dual; 2]) {
        let [from, to] = self.ends;
        if !self.alone {
            let lost = Dual::ONE - self.room;
            return (self.room, [Dual::ZERO, lost * height.min(Dual::ZERO)]);
        }
        // Cosine of the angle from end to end, seen from the centre: the rest of a turn is that of the path.
        let lengths = (from * from + height * height).sqrt() * (to * to + height * height).sqrt();
        let cosine = if lengths.value > 0.0 { (from * to + height * height) * lengths.recip() } else { Dual::ONE };
        let least = Dual::constant(NARROW[0]);
        let lost = ((cosine - least) * Dual::constant((NARROW[1] - NARROW[0]).recip())).step();
        // The nearest point of the line between its ends.
        let foot = to.min(Dual::ZERO) - (-from).min(Dual::ZERO);
        (Dual::ONE - lost, [lost * foot, lost * height.min(Dual::ZERO)])
    }

    fn beside_circle(&self) -> Option<Yielding> {
        if self.height.value >= 0.0 {
            return None;
        }
        let (scale, [along, up]) = self.gives_way(self.height);
        Some(Yielding { scale, shift: self.along * along + self.up * up, passes: Some(self.up.value), ..Yielding::NONE })
    }

    fn beside_sphere(&self) -> Option<Yielding> {
        let Self { up, across, height, offset, .. } = *self;
        if height.value >= 0.0 {
            return None;
        }
        let near = (height * height + offset * offset).sqrt().recip();
        let (cosine, sine) = (-height * near, offset * near);
        let (passes, axis) = (up * cosine + across * sine, across * cosine - up * sine);
        // H, and how far the line passes along the axis of the cylinder.
        let (high, aside) = (height * cosine + offset * sine, offset * cosine - height * sine);
        // 1 from H = 0 on.
        let yields = (Dual::constant(2.0) * cosine * cosine).step();
        let drawn = if self.alone { Dual::ONE } else { yields };
        let (left, [moved, raised]) = self.gives_way(high);
        Some(Yielding {
            scale: Dual::ONE - yields * (Dual::ONE - left),
            shift: axis * (drawn * aside) + (self.along * moved + passes * raised) * yields,
            across: axis,
            squeeze: Dual::ONE - drawn,
            passes: Some(passes.value),
        })
    }

    fn beside_ellipsoid(&self) -> Option<Yielding> {
        let Self { up, across, height, offset, room, .. } = *self;
        if height.value >= offset.value.abs() {
            return None;
        }
        let yields = if height.value <= 0.0 { Dual::ONE } else { (Dual::ONE - height * offset.abs().recip()).step() };
        let keeps = ((Dual::ONE - offset.abs()) * Dual::constant(2.0)).step() * room;
        let lost = Dual::ONE - keeps;
        Some(Yielding {
            scale: Dual::ONE - yields * lost,
            shift: across * (offset * yields) + up * (lost * height.min(Dual::ZERO)),
            across,
            squeeze: Dual::ONE - yields,
            passes: Some(up.value),
        })
    }
}
