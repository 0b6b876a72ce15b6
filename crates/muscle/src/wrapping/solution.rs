//! What a solved path is: its length, its straight segments and geodesic arcs, and how its length changes.

use std::iter;
use std::ops::Range;

use glam::DVec3;

use super::dual::DualVec;
use super::geodesic::{Accuracy, GeodesicStart};
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
    /// Whether no other surface may act on the stretch.
    pub alone: bool,
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

    /// `count` points in the world at equal spacing from P to Q, both among them, and the path's direction at each; of a count of 1, P alone. Those between
    /// P and Q are for drawing: on the surface, and within 10⁻⁷ of its size on the geodesic.
    pub fn sample(&self, count: usize) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
        let last = count.saturating_sub(1);
        let mut at = self.contact.start;
        at.length /= last.max(1) as f64;
        (0..count).map(move |index| {
            if index > 0 {
                let end = if index < last { self.placed.shape.shoot_within(&at, Accuracy::Drawn) } else { self.contact.end };
                (at.point, at.tangent) = (end.point, end.tangent);
            }
            (self.placed.to_world(at.point), self.placed.rotation * at.tangent)
        })
    }

    /// The radius of the circle that the geodesic is a part of; `None` where it is another curve.
    #[must_use]
    pub fn circle(&self) -> Option<f64> {
        /// Less of the direction than this along a cylinder's axis is a rounding.
        const ALONG: f64 = 1e-12;
        match self.placed.shape {
            Shape::Sphere(radius) => Some(radius),
            Shape::Cylinder(radius) if self.contact.start.tangent.z.abs() < ALONG => Some(radius),
            _ => None,
        }
    }

    /// About how far the path's direction turns along the geodesic, radians: its length over the smallest radius of curvature at its ends and its middle.
    #[must_use]
    pub fn turn(&self) -> f64 {
        let shape = &self.placed.shape;
        let start = self.contact.start;
        let middle = shape.shoot_within(&GeodesicStart { length: 0.5 * start.length, ..start }, Accuracy::Drawn);
        let end = self.contact.end;
        let bend = |(point, tangent): (DVec3, DVec3)| {
            let curvature = shape.curvature(point, tangent, tangent.cross(shape.normal(point)));
            curvature.along.hypot(curvature.twist)
        };
        let places = [(start.point, start.tangent), (middle.point, middle.tangent), (end.point, end.tangent)];
        self.length * places.map(bend).into_iter().fold(0.0, f64::max)
    }

    /// What the surface's yielding adds to the rate of the length. A surface that moves along its normal by v lengthens the path by its normal curvature κ
    /// times v, for each unit of length: ∫ κ v ds, by Gauss' rule.
    fn yielding_rate(&self, stretch: &Stretch, velocity: &impl Fn(usize, DVec3) -> DVec3) -> f64 {
        /// Pieces of the geodesic, with five points each.
        const PIECES: u32 = 8;
        const NODES: [(f64, f64); 5] = [
            (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
            (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (0.0, 0.568_888_888_888_888_9),
            (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (0.906_179_845_938_664, 0.236_926_885_056_189_08),
        ];
        if !self.given.yields {
            return 0.0;
        }
        let given = self.given.placed;
        let local = |point: DVec3, body: usize| DualVec {
            value: given.to_local(point),
            rate: given.rotation.transpose() * (velocity(body, point) - velocity(self.body, point)),
        };
        let (from, to) = (local(stretch.start, stretch.start_body), local(stretch.end, stretch.end_body));
        let yielding = Yielding::of(&given.shape, self.given.side, self.given.alone, from, to);
        let shape = &self.placed.shape;
        let half = self.length / f64::from(2 * PIECES);
        let (mut start, mut reached, mut rate) = (self.contact.start, 0.0, 0.0);
        for piece in 0..PIECES {
            for (node, weight) in NODES {
                let place = (f64::from(2 * piece + 1) + node) * half;
                start.length = place - reached;
                let end = shape.shoot(&start);
                (start.point, start.tangent, reached) = (end.point, end.tangent, place);
                let normal = shape.normal(start.point);
                let bend = shape.curvature(start.point, start.tangent, start.tangent.cross(normal)).along;
                // A surface that yields may have a frame of its own.
                let point = given.to_local(self.placed.to_world(start.point));
                let outward = given.rotation.transpose() * (self.placed.rotation * normal);
                rate += weight * half * bend * yielding.normal_speed(&given.shape, point, outward);
            }
        }
        rate
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
    /// with their directions e. A surface that yields adds how it moves along its normal. For the velocities of a turn by 1 radian a second about a joint, the moment
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
            rate += along(before, arc.start).dot(velocity(arc.body, arc.start) - before_velocity) + arc.yielding_rate(stretch, velocity);
            (before, before_velocity) = (arc.end, velocity(arc.body, arc.end));
        }
        rate + along(before, stretch.end).dot(velocity(stretch.end_body, stretch.end) - before_velocity)
    }
}
