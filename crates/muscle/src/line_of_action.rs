//! A muscle's line of action: from its origin over via points and round a joint to its insertion, and the centre line that is drawn for it.
//!
//! A line of action is a shortest path: straight from point to point, and round a joint the great circle of a ball that it lies on ([`super::wrap`]). Its
//! length and its moment arm are exact and change with the pose without a jump.
//!
//! What is drawn is another line of *exactly the same length*, so that the volume on the screen is the volume of the ledger. A line with via points is
//! rounded at each and pushed out a little for what that takes off ([`super::rounded_centerline`]). On the two-rod arm the line of action may run between points on
//! the rods' axes, so a belly drawn along it would swallow the rods; there an arch ([`Path::arc_between`]) is drawn whose ends lie on the rods' surfaces on the
//! muscle's side, slid a few millimetres towards the elbow to give the arch its height ([`super::bone_clearance`]). Length and moment arm stay those of the
//! line of action: on the straight-rod arm, the law of cosines.

use glam::{DMat4, DVec3};

use super::centerline::Path;
use super::edit::VIA;
use super::rounded_centerline;
use super::wrap::{TangentPoints, WrapObject};

/// A point that moves with a bone.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Point {
    /// Index of the bone in the rig's list.
    pub bone: usize,
    /// Place in the bone's axes, in the file's unit.
    pub local: DVec3,
}

/// Frames of the rig's bones in the space of its root: positions in the file's unit, axes of length 1 unless the muscles scale with the bones.
pub(super) trait Frames {
    /// The frame of bone `index`.
    fn frame(&self, index: usize) -> DMat4;

    /// Where a point is.
    fn place(&self, point: Point) -> DVec3 {
        self.frame(point.bone).transform_point3(point.local)
    }
}

/// A line of action.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Line {
    /// Where it begins.
    pub origin: Point,
    /// Where it ends.
    pub insertion: Point,
    /// Points in between, in order.
    pub via: Vec<Point>,
    /// What it goes round.
    pub wrap_object: Option<WrapObject>,
    /// Radius of the arcs at via points that are drawn.
    pub rounding: f64,
    /// The ends of the centre line that is drawn, where it is an arch.
    pub drawn: Option<CenterlineOffset>,
}

/// How the drawn centre line differs from the line of action.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CenterlineOffset {
    /// Ends on the bones' surfaces.
    pub ends: [Point; 2],
    /// Side that the arch bulges to, in the axes of both ends' bones.
    pub side: DVec3,
}

/// The part of a line of action between two of its points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Leg {
    /// The points.
    pub from: Point,
    /// See `from`.
    pub to: Point,
    /// Where they are.
    pub start: DVec3,
    /// See `start`.
    pub end: DVec3,
    /// Where it lies on the ball.
    pub contact: Option<TangentPoints>,
}

impl Leg {
    /// Its length.
    pub(super) fn length(&self) -> f64 {
        match &self.contact {
            None => self.start.distance(self.end),
            Some(arc) => self.start.distance(arc.touch) + arc.radius * arc.angle + arc.lift.distance(self.end),
        }
    }
}

/// Most points of a line.
pub(super) const POINTS: usize = VIA + 2;
/// Share of the length in each shoulder of the arch: steep at the ends and flat along the belly.
const SHOULDER: f64 = 0.36;

impl Line {
    /// The same line with the ball and the rounding multiplied by `scale`: offsets are scaled by the bones that they are on.
    pub(super) fn scaled(mut self, scale: f64) -> Self {
        self.rounding *= scale;
        if let Some(wrap_object) = &mut self.wrap_object {
            wrap_object.radius *= scale;
        }
        self
    }

    /// Its points in order: origin, via points, insertion.
    pub(super) fn points(&self) -> impl Iterator<Item = Point> + Clone + '_ {
        [self.origin].into_iter().chain(self.via.iter().take(VIA).copied()).chain([self.insertion])
    }

    /// Its parts between one point and the next.
    pub(super) fn legs<'a>(&'a self, frames: &'a (impl Frames + ?Sized)) -> impl Iterator<Item = Leg> + 'a {
        let wrap_object = self.wrap_object.as_ref();
        let mut before = (self.origin, frames.place(self.origin));
        self.points().skip(1).enumerate().map(move |(stretch, point)| {
            let ((from, start), end) = (before, frames.place(point));
            before = (point, end);
            let contact = wrap_object
                .filter(|wrap_object| wrap_object.stretch == stretch)
                .and_then(|wrap_object| wrap_object.between(frames, start, end));
            Leg { from, to: point, start, end, contact }
        })
    }

    /// Length of the line of action.
    pub(super) fn length(&self, frames: &(impl Frames + ?Sized)) -> f64 {
        self.legs(frames).map(|leg| leg.length()).sum()
    }

    /// The centre line that is drawn; `length` is that of the line of action or, where the muscle is held at a limit, another.
    pub(super) fn centerline(&self, frames: &(impl Frames + ?Sized), length: f64) -> Path {
        match &self.drawn {
            Some(drawn) => drawn.centerline(frames, length),
            None => rounded_centerline::rounded(self, frames),
        }
    }
}

impl CenterlineOffset {
    /// The arch of this length between the drawn ends.
    pub(super) fn centerline(&self, frames: &(impl Frames + ?Sized), length: f64) -> Path {
        let [start, end] = self.ends.map(|point| frames.place(point));
        let [above, below] = self.ends.map(|point| frames.frame(point.bone).transform_vector3(self.side));
        Path::arc_between(start, end, length, SHOULDER, above + below)
    }
}
