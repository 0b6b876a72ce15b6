//! What a solved path is: its length, its straight segments and geodesic arcs, and how its length changes.

use std::iter;
use std::ops::Range;

use glam::DVec3;

use super::dual::DualVec;
use super::newton::{Contact, Placed};
use super::shape::Shape;
use super::yielding::Yielding;

/// Whether a solution can be relied on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Status {
    /// A shortest path.
    #[default]
    Converged,
    /// The path goes round each surface, but is not a shortest one: Newton's method found none in its bounded number of steps.
    NotConverged,
    /// A coordinate is not a number, or beyond 10⁵⁰; the solution has no length and no stretches.
    NotFinite,
}

/// An end of a stretch that lies inside of a wrap surface, which is therefore taken smaller on that stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InsidePoint {
    /// Index of the point in the path.
    pub point: usize,
    /// Index of the surface.
    pub surface: usize,
    /// How deep, along the ray from the surface's centre, its axis or the middle of its tube; in the caller's unit.
    pub depth: f64,
}

/// The part of a path between two of its points.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretch {
    /// Where it begins.
    pub start: DVec3,
    /// The body that its beginning moves with.
    pub start_body: usize,
    /// Where it ends.
    pub end: DVec3,
    /// The body that its end moves with.
    pub end_body: usize,
    /// Its length.
    pub length: f64,
    /// Its arcs among [`Solution::arcs`], in the order of the path.
    pub arcs: Range<usize>,
}

/// A straight part of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Where it begins.
    pub start: DVec3,
    /// Where it ends.
    pub end: DVec3,
}

/// A geodesic on a wrap surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Arc {
    /// Index of the surface.
    pub surface: usize,
    /// The body that the surface moves with.
    pub body: usize,
    /// The contact point P where the path touches down, in the world.
    pub start: DVec3,
    /// The path's direction at P, of length 1.
    pub start_tangent: DVec3,
    /// The contact point Q where it lifts off.
    pub end: DVec3,
    /// The path's direction at Q, of length 1.
    pub end_tangent: DVec3,
    /// Length of the geodesic from P to Q.
    pub length: f64,
    /// Whether both contact points lie beyond the same end of a [`Surface::Cylinder`](super::Surface::Cylinder).
    pub beyond_end: bool,
    /// The outward normal at P.
    start_normal: DVec3,
    contact: Contact,
    placed: Placed,
    given: Given,
}

/// The surface as it was given, from which it follows how it yields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Given {
    pub placed: Placed,
    pub side: Option<DVec3>,
    /// Half the length of a cylinder.
    pub half_length: f64,
    /// Whether size or place differ from what was given.
    pub yields: bool,
}

impl Arc {
    pub(super) fn new(surface: usize, body: usize, contact: Contact, placed: Placed, given: Given) -> Self {
        let half = given.half_length;
        let beyond = |sign: f64| sign * contact.start.point.z > half && sign * contact.end.point.z > half;
        Self {
            surface,
            body,
            start: placed.to_world(contact.start.point),
            start_tangent: placed.rotation * contact.start.tangent,
            end: placed.to_world(contact.end.point),
            end_tangent: placed.rotation * contact.end.tangent,
            length: contact.start.length,
            beyond_end: beyond(1.0) || beyond(-1.0),
            start_normal: placed.rotation * placed.shape.normal(contact.start.point),
            contact,
            placed,
            given,
        }
    }

    /// The surface's outward normal at P, of length 1.
    #[must_use]
    pub fn start_normal(&self) -> DVec3 {
        self.start_normal
    }

    /// `count` points in the world at equal spacing from P to Q, both among them; of a count of 1, P alone.
    pub fn sample(&self, count: usize) -> impl Iterator<Item = DVec3> + '_ {
        let mut start = self.contact.start;
        start.length /= count.saturating_sub(1).max(1) as f64;
        let points = iter::successors(Some(start), move |start| {
            let end = self.placed.shape.shoot(start);
            Some(super::geodesic::GeodesicStart { point: end.point, tangent: end.tangent, length: start.length })
        });
        points.take(count).map(|start| self.placed.to_world(start.point))
    }

    /// How fast the surface yields, and what that adds to the length of the geodesic by itself.
    fn yielding_rate(&self, stretch: &Stretch, velocity: &impl Fn(usize, DVec3) -> DVec3) -> (YieldingRate, f64) {
        if !self.given.yields {
            return (YieldingRate::NONE, 0.0);
        }
        let placed = self.given.placed;
        let local = |point: DVec3, body: usize| DualVec {
            value: placed.to_local(point),
            rate: placed.rotation.transpose() * (velocity(body, point) - velocity(self.body, point)),
        };
        let (from, to) = (local(stretch.start, stretch.start_body), local(stretch.end, stretch.end_body));
        let Yielding { scale, shift } = Yielding::of(&placed.shape, self.given.side, from, to);
        let growth = if scale.value > 0.0 { scale.rate / scale.value } else { 0.0 };
        let longer = match self.placed.shape {
            Shape::Sphere(_) | Shape::Ellipsoid(_) => growth * self.length,
            Shape::Cylinder(_) => growth * self.length * (1.0 - self.contact.start.tangent.z.powi(2)),
            Shape::Torus(torus) => growth * torus.minor * self.total_curvature(),
        };
        (YieldingRate { growth, shift: placed.rotation * shift.rate }, longer)
    }

    /// The integral of the normal curvature along the geodesic, by Simpson's rule.
    fn total_curvature(&self) -> f64 {
        const PIECES: u32 = 32;
        let shape = &self.placed.shape;
        let mut start = self.contact.start;
        let step = start.length / f64::from(2 * PIECES);
        start.length = step;
        let mut sum = 0.0;
        for place in 0..=2 * PIECES {
            let weight = if place == 0 || place == 2 * PIECES { 1.0 } else { f64::from(2 + 2 * (place % 2)) };
            let binormal = start.tangent.cross(shape.normal(start.point));
            sum += weight * shape.curvature(start.point, start.tangent, binormal).along;
            let end = shape.shoot(&start);
            (start.point, start.tangent) = (end.point, end.tangent);
        }
        sum * step / 3.0
    }
}

/// How fast a surface grows about its centre, as a share of its size, and moves.
struct YieldingRate {
    growth: f64,
    shift: DVec3,
}

impl YieldingRate {
    const NONE: Self = Self { growth: 0.0, shift: DVec3::ZERO };

    /// The velocity of a point on the surface beside that of the surface's body. What of it is along the normal does not matter: no straight part has any.
    fn at(&self, placed: &Placed, point: DVec3) -> DVec3 {
        let local = placed.to_local(point);
        let from_center = match placed.shape {
            Shape::Sphere(_) | Shape::Ellipsoid(_) => local,
            Shape::Cylinder(_) => local.with_z(0.0),
            Shape::Torus(_) => DVec3::ZERO,
        };
        self.shift + placed.rotation * from_center * self.growth
    }
}

/// A solved path.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Solution {
    /// Length from origin to insertion.
    pub length: f64,
    /// Whether it can be relied on.
    pub status: Status,
    /// The largest angle (its sine) between a straight segment and the geodesic that it meets; 0 where closed forms gave the path.
    pub path_error: f64,
    /// The most Newton steps of a stretch.
    pub steps: usize,
    pub(super) stretches: Vec<Stretch>,
    pub(super) arcs: Vec<Arc>,
    pub(super) inside: Vec<InsidePoint>,
}

impl Solution {
    /// The parts between one point of the path and the next.
    #[must_use]
    pub fn stretches(&self) -> &[Stretch] {
        &self.stretches
    }

    /// The geodesics of all stretches, in the order of the path.
    #[must_use]
    pub fn arcs(&self) -> &[Arc] {
        &self.arcs
    }

    /// The geodesics of a stretch.
    #[must_use]
    pub fn arcs_of(&self, stretch: &Stretch) -> &[Arc] {
        self.arcs.get(stretch.arcs.clone()).unwrap_or_default()
    }

    /// The straight segments of a stretch, one more than it has arcs.
    pub fn segments_of(&self, stretch: &Stretch) -> impl Iterator<Item = Segment> + '_ {
        let arcs = self.arcs_of(stretch);
        let starts = iter::once(stretch.start).chain(arcs.iter().map(|arc| arc.end));
        let ends = arcs.iter().map(|arc| arc.start).chain(iter::once(stretch.end));
        starts.zip(ends).map(|(start, end)| Segment { start, end })
    }

    /// The points of the path that lie inside of a surface.
    #[must_use]
    pub fn inside(&self) -> &[InsidePoint] {
        &self.inside
    }

    /// The derivative of the length by time, where `velocity` is that of the point of a body that is at a place in the world, the bodies being rigid.
    ///
    /// As the path is a shortest one, the contact points may be taken as fixed to the surface's body: dL/dt = Σ e·(v_end − v_start) over the straight segments
    /// with their directions e. A surface that yields adds how it grows and moves. For the velocities of a turn by 1 radian a second about a joint, the moment
    /// arm is the negative of what this returns.
    #[must_use]
    pub fn length_rate(&self, velocity: impl Fn(usize, DVec3) -> DVec3) -> f64 {
        self.stretches.iter().map(|stretch| self.stretch_rate(stretch, &velocity)).sum()
    }

    fn stretch_rate(&self, stretch: &Stretch, velocity: &impl Fn(usize, DVec3) -> DVec3) -> f64 {
        let along = |from: DVec3, to: DVec3| (to - from).normalize_or_zero();
        let mut rate = 0.0;
        let (mut before, mut before_velocity) = (stretch.start, velocity(stretch.start_body, stretch.start));
        for arc in self.arcs_of(stretch) {
            let (yielding, longer) = arc.yielding_rate(stretch, velocity);
            let of = |point: DVec3| velocity(arc.body, point) + yielding.at(&arc.placed, point);
            rate += along(before, arc.start).dot(of(arc.start) - before_velocity) + longer;
            (before, before_velocity) = (arc.end, of(arc.end));
        }
        rate + along(before, stretch.end).dot(velocity(stretch.end_body, stretch.end) - before_velocity)
    }
}
