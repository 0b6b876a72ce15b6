//! A muscle's line of action: from its origin through via points and round wrap surfaces to its insertion, and the centreline that is drawn for it.
//!
//! A line of action is a shortest path ([`super::wrapping`]): straight in the air, a geodesic on each surface that it lies on. Its length and its moment arm
//! change with the pose without a jump, save where a via point that is passed in a range of angles alone comes in or drops out off the line.
//!
//! What is drawn is another line of *exactly the same length*, so that the volume on the screen is the volume of the table. It leaves the line of action at
//! its corners alone, which it rounds ([`super::rounded_centerline`]). On the two-rod arm the line of action may run between points on
//! the rods' axes, so a belly drawn along it would swallow the rods; there an arch ([`Centerline::arc_between`]) is drawn whose ends lie on the rods' surfaces on
//! the muscle's side, slid a few millimetres towards the elbow to give the arch its height ([`super::bone_clearance`]). Length and moment arm stay those of the
//! line of action: on the straight-rod arm, the law of cosines.

use glam::{DMat4, DVec3};

use super::centerline::Centerline;
use super::rounded_centerline::{self, Corner};
use super::via_point::ViaPoint;
use super::wrap_object::{RigidMotion, WrapObject};
use super::wrapping::{PathPoint, PathSolver, Solution, WrapSurface};

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

    /// The angle of joint `index` of the rig, degrees; not a number where it has none.
    fn angle(&self, index: usize) -> f64;

    /// Where a point is.
    fn place(&self, point: Point) -> DVec3 {
        self.frame(point.bone).transform_point3(point.local)
    }
}

/// How frames change as something turns.
pub(super) trait FrameRates: Frames {
    /// The change of [`Frames::frame`] a radian; a matrix whose last row is zero.
    fn rate(&self, index: usize) -> DMat4;

    /// The change of the angle of joint `index`: 1 of the joint that turns, 0 of all others.
    fn angle_rate(&self, index: usize) -> f64;
}

/// A line of action.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Line {
    /// Where it begins.
    pub origin: Point,
    /// Where it ends.
    pub insertion: Point,
    /// Points in between, in order.
    pub via: Vec<ViaPoint>,
    /// What it goes round, in the order in which surfaces of one stretch follow one another.
    pub wraps: Vec<WrapObject>,
    /// Radius of the arcs at corners that are drawn.
    pub rounding: f64,
    /// The ends of the centreline that is drawn, where it is an arch.
    pub drawn: Option<CenterlineOffset>,
}

/// How the drawn centreline differs from the line of action.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CenterlineOffset {
    /// Ends on the bones' surfaces.
    pub ends: [Point; 2],
    /// Side that the arch bulges to, in the axes of both ends' bones.
    pub side: DVec3,
}

/// Share of the length in each shoulder of the arch: steep at the ends and flat along the belly.
const SHOULDER: f64 = 0.36;

/// Solves lines of action, and keeps its buffers from one to the next.
#[derive(Debug, Clone, Default)]
pub(super) struct LineSolver {
    points: Vec<PathPoint>,
    surfaces: Vec<WrapSurface>,
    solver: PathSolver,
    corners: Vec<Corner>,
}

impl LineSolver {
    /// The line that was solved last. Bodies are the numbers of the line's points, origin first, and behind them those of its wraps.
    pub(super) fn solution(&self) -> &Solution {
        self.solver.solution()
    }

    /// The number of a point of that solution among all points of the line, 0 the origin.
    pub(super) fn number_of(&self, point: usize) -> Option<usize> {
        self.points.get(point).map(|point| point.body)
    }
}

impl Line {
    /// The same line with wraps and rounding multiplied by `scale`: offsets are scaled by the bones that they are on.
    pub(super) fn scaled(mut self, scale: f64) -> Self {
        self.rounding *= scale;
        self.wraps.iter_mut().for_each(|wrap| wrap.rescale(scale));
        self
    }

    /// Whether several surfaces leave a choice of ways, which takes hundreds of times as long to find.
    pub(super) fn has_choices(&self) -> bool {
        self.wraps.len() > 1 && self.wraps.iter().any(WrapObject::has_ways)
    }

    /// How many points it has: origin, via points, insertion.
    pub(super) fn count(&self) -> usize {
        self.via.len() + 2
    }

    /// The bones of its points in order.
    pub(super) fn bones(&self) -> impl Iterator<Item = usize> + '_ {
        [self.origin.bone].into_iter().chain(self.via.iter().map(|via| via.point.bone)).chain([self.insertion.bone])
    }

    /// Point `number` in these frames, 0 the origin; `None` of a via point that is not passed, and of a number without a point.
    pub(super) fn place(&self, number: usize, frames: &(impl Frames + ?Sized)) -> Option<DVec3> {
        let point = match number.checked_sub(1) {
            None => self.origin,
            Some(via) if via < self.via.len() => {
                let via = self.via.get(via).filter(|via| via.is_active(|joint| frames.angle(joint)))?;
                Point { local: via.local(|joint| frames.angle(joint)), ..via.point }
            }
            Some(via) if via == self.via.len() => self.insertion,
            Some(_) => return None,
        };
        Some(frames.place(point))
    }

    /// Solves it: see [`LineSolver::solution`].
    pub(super) fn solve<'a>(&self, frames: &(impl Frames + ?Sized), solver: &'a mut LineSolver) -> &'a Solution {
        let LineSolver { points, surfaces, solver, .. } = solver;
        points.clear();
        points.extend((0..self.count()).filter_map(|body| self.place(body, frames).map(|position| PathPoint { body, position })));
        surfaces.clear();
        for (number, wrap) in self.wraps.iter().enumerate() {
            // A stretch between points that are passed stands for all between them.
            let overlaps = |pair: &[PathPoint]| pair[0].body < wrap.stretches.end && pair[1].body > wrap.stretches.start;
            let first = points.windows(2).position(overlaps).unwrap_or(0);
            let count = points.windows(2).filter(|pair| overlaps(pair)).count();
            surfaces.push(wrap.placed(&frames.frame(wrap.center.bone), self.count() + number, first..first + count));
        }
        solver.solve(points, surfaces)
    }

    /// Length of the line of action.
    pub(super) fn length(&self, frames: &(impl Frames + ?Sized)) -> f64 {
        if !self.wraps.is_empty() {
            return self.solve(frames, &mut LineSolver::default()).length;
        }
        // Straight from point to point, which needs no memory: a slider asks for many lengths a frame.
        let mut places = (0..self.count()).filter_map(|number| self.place(number, frames));
        let first = places.next();
        places.fold((0.0, first), |(length, before), place| (length + before.map_or(0.0, |before| before.distance(place)), Some(place))).0
    }

    /// The change of the length a radian, of a line that has been solved in these frames.
    pub(super) fn length_rate(&self, frames: &(impl FrameRates + ?Sized), solution: &Solution) -> f64 {
        let motions: Vec<RigidMotion> =
            self.wraps.iter().map(|wrap| wrap.motion(&frames.frame(wrap.center.bone), &frames.rate(wrap.center.bone))).collect();
        let of_point = |point: Point| (frames.rate(point.bone) * point.local.extend(1.0)).truncate();
        let (angle, rate) = (|joint: usize| frames.angle(joint), |joint: usize| frames.angle_rate(joint));
        solution.length_rate(|body, place| match body.checked_sub(1) {
            None => of_point(self.origin),
            Some(number) if number < self.via.len() => self.via.get(number).map_or(DVec3::ZERO, |via| {
                let moved = frames.frame(via.point.bone).transform_vector3(via.rate(angle, rate));
                of_point(Point { local: via.local(angle), ..via.point }) + moved
            }),
            Some(number) if number == self.via.len() => of_point(self.insertion),
            Some(number) => motions.get(number - self.via.len() - 1).map_or(DVec3::ZERO, |motion| motion.at(place)),
        })
    }

    /// Writes the centreline that is drawn for a line that has been solved in these frames; `length` is that of the line of action or, where the muscle is held at
    /// a limit, another.
    pub(super) fn draw(&self, frames: &(impl Frames + ?Sized), solver: &mut LineSolver, length: f64, centerline: &mut Centerline) {
        match &self.drawn {
            Some(drawn) => drawn.draw(frames, length, centerline),
            None => {
                let side = self.wraps.first().map_or(DVec3::X, |wrap| frames.frame(wrap.center.bone).transform_vector3(DVec3::X));
                let LineSolver { solver, corners, .. } = solver;
                rounded_centerline::round(solver.solution(), self.rounding, side.normalize_or(DVec3::X), corners, centerline);
            }
        }
    }
}

impl CenterlineOffset {
    /// Writes the arch of this length between the drawn ends.
    pub(super) fn draw(&self, frames: &(impl Frames + ?Sized), length: f64, centerline: &mut Centerline) {
        let [start, end] = self.ends.map(|point| frames.place(point));
        let [above, below] = self.ends.map(|point| frames.frame(point.bone).transform_vector3(self.side));
        centerline.arch(start, end, length, SHOULDER, above + below);
    }
}
