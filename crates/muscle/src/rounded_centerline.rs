//! The centre line that is drawn for a line of action with via points: rounded at each, and as long as the line of action itself.
//!
//! An arc takes the short cut round a corner. What all arcs take off is given back by moving the corners outward, each in the measure in which the line
//! turns there, by one common share that is found by halving; the length rises with it. So the arcs pass close to the via points.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::centerline::{Path, perpendicular};
use super::line_of_action::{Frames, Line, POINTS};
use super::wrap::{TangentPoints, WrapObject};

/// Points that lie nearer to each other than this share of the line are one.
const TINY: f64 = 1e-9;
/// Most length that an arc takes of the stretches on either side, over the rounding: a line that turns by more than 2 atan 4 = 152° gets sharper arcs.
/// Without a bound a line that turns right round would lose to its arc whatever it gained by moving its corner outward, and stay too short.
const REACH: f64 = 4.0;
/// A drawn line that is off by no more than this share is as long as the line of action.
const CLOSE: f64 = 1e-12;
/// Shares of the rounding that are tried one after the other. The last takes off less than 1e-10 of any line that has room for the first.
const SHARPER: [f64; 6] = [1.0, 0.25, 0.0625, 0.016, 0.004, 1e-9];
/// Most steps in search of the share by which corners are moved outward.
const STEPS: usize = 80;

/// The drawn centre line of a line that is no arch.
pub(super) fn rounded(line: &Line, frames: &(impl Frames + ?Sized)) -> Path {
    let side = line.wrap_object.map_or(DVec3::X, |wrap_object| frames.frame(wrap_object.center.bone).transform_vector3(wrap_object.side));
    let mut corners = Corners::new(line, frames);
    corners.make_up();
    corners.path(side)
}

/// A rounded corner, or an end where `angle` is 0.
#[derive(Debug, Clone, Copy, Default)]
struct Corner {
    into: DVec3,
    out: DVec3,
    /// Radians by which the line turns.
    angle: f64,
    /// Length that the arc takes of the stretches on either side.
    reach: f64,
}

impl Corner {
    fn tangent(&self) -> f64 {
        // Rounding may put half of a half turn just beyond π/2, where the tangent is negative.
        (0.5 * self.angle).min(FRAC_PI_2).tan()
    }

    fn radius(&self) -> f64 {
        if self.angle > 0.0 { self.reach / self.tangent() } else { 0.0 }
    }
}

/// The points of a line, those that fall together counted once, and the arcs between them.
struct Corners<'a, F: Frames + ?Sized> {
    line: &'a Line,
    frames: &'a F,
    /// Radius of the arcs at corners.
    rounding: f64,
    /// Where the line of action passes.
    points: [DVec3; POINTS],
    /// Number of the first and the last point of the line that each stands for.
    numbers: [(usize, usize); POINTS],
    /// Where each goes for a share of 1.
    outward: [DVec3; POINTS],
    count: usize,
    /// Where they are drawn.
    places: [DVec3; POINTS],
    contacts: [Option<TangentPoints>; POINTS],
    corners: [Corner; POINTS],
    /// The side on which the line of action passes the ball; moved corners do not change it.
    side: Option<DVec3>,
}

impl<'a, F: Frames + ?Sized> Corners<'a, F> {
    fn new(line: &'a Line, frames: &'a F) -> Self {
        let mut all = Self {
            line,
            frames,
            rounding: line.rounding,
            points: [DVec3::ZERO; POINTS],
            numbers: [(0, 0); POINTS],
            outward: [DVec3::ZERO; POINTS],
            count: 0,
            places: [DVec3::ZERO; POINTS],
            contacts: [None; POINTS],
            corners: [Corner::default(); POINTS],
            side: None,
        };
        let mut long = 0.0;
        let mut before: Option<DVec3> = None;
        for point in line.points() {
            let place = frames.place(point);
            long += before.map_or(0.0, |before| before.distance(place));
            before = Some(place);
        }
        let last = line.points().count() - 1;
        for (number, point) in line.points().enumerate() {
            let place = frames.place(point);
            // A via point that lies on its neighbour is no corner; the ends stay.
            let near = |index: usize| all.points[index].distance(place) <= TINY * long;
            if all.count > 0 && near(all.count - 1) && (number < last || all.count > 1) {
                (all.points[all.count - 1], all.numbers[all.count - 1].1) = (place, number);
                continue;
            }
            (all.points[all.count], all.numbers[all.count]) = (place, (number, number));
            all.count += 1;
        }
        all.side = line.wrap_object.and_then(|wrap_object| {
            let index = (0..all.count.saturating_sub(1)).find(|index| all.is_at(*index, &wrap_object))?;
            wrap_object.passes(frames, all.points[index], all.points[index + 1])
        });
        all.settle(0.0);
        for index in 1..all.count.saturating_sub(1) {
            all.outward[index] = all.corners[index].into - all.corners[index].out;
        }
        all
    }

    /// Moves the corners outward until the rounded line is as long as the line of action. Where a corner on its way outward comes into
    /// the ball, the length may leap over the one that is wanted; there sharper arcs, which take off less, need less of that way. The last resort
    /// are corners so sharp that they take off nothing that counts.
    fn make_up(&mut self) {
        let wanted = self.line.length(self.frames);
        for sharper in SHARPER {
            self.rounding = self.line.rounding * sharper;
            if self.moves_out(wanted) {
                return;
            }
        }
        self.settle(0.0);
    }

    /// See [`Self::make_up`]; whether the length was reached.
    fn moves_out(&mut self, wanted: f64) -> bool {
        let moves: f64 = self.outward.iter().map(|out| out.length_squared()).sum();
        let missing = wanted - self.settle(0.0);
        let close = |off: f64| off.abs() <= CLOSE * wanted;
        if moves <= 0.0 || missing <= 1e-14 * wanted {
            return close(missing);
        }
        let (mut low, mut high) = (0.0, missing / moves);
        let mut doubled = 0;
        while self.settle(high) < wanted {
            (low, high) = (high, 2.0 * high);
            doubled += 1;
            if doubled == 40 {
                return false;
            }
        }
        // Regula falsi that halves the weight of an end that stays: it needs about eight steps where halving alone needs fifty.
        let (mut below, mut above) = (self.settle(low) - wanted, self.settle(high) - wanted);
        let mut off = above;
        for _ in 0..STEPS {
            let share = (low * above - high * below) / (above - below);
            let share = if share > low && share < high { share } else { 0.5 * (low + high) };
            off = self.settle(share) - wanted;
            if off.abs() <= 1e-14 * wanted || share == low || share == high {
                break;
            }
            if off < 0.0 {
                (low, below, above) = (share, off, 0.5 * above);
            } else {
                (high, above, below) = (share, off, 0.5 * below);
            }
        }
        close(off)
    }

    /// Places the corners with this share of their way outward; returns the length of the rounded line.
    fn settle(&mut self, share: f64) -> f64 {
        for index in 0..self.count {
            self.places[index] = self.points[index] + self.outward[index] * share;
        }
        let mut length = 0.0;
        // Length of the straight stretches after each point and before the next, and whether they are one.
        let mut rooms = [(0.0, 0.0, true); POINTS];
        for index in 1..self.count {
            let (from, to) = (self.places[index - 1], self.places[index]);
            let contact = self.contact(index - 1);
            let straight = (to - from).normalize_or_zero();
            let (into, out) = match &contact {
                // Where the ball is held small by a point, the line has no straight stretch there.
                Some(arc) => (arc.leaves, arc.tangent),
                None => (straight, straight),
            };
            (self.corners[index - 1].out, self.corners[index].into) = (out, into);
            rooms[index - 1] = match &contact {
                Some(arc) => (from.distance(arc.touch), arc.lift.distance(to), false),
                None => (from.distance(to), from.distance(to), true),
            };
            length += match &contact {
                Some(arc) => rooms[index - 1].0 + arc.radius * arc.angle + rooms[index - 1].1,
                None => rooms[index - 1].0,
            };
            self.contacts[index - 1] = contact;
        }
        let last = self.count.saturating_sub(1);
        for index in 0..self.count {
            let inner = index > 0 && index < last;
            let corner = &mut self.corners[index];
            corner.angle = if inner { turn(corner.into, corner.out) } else { 0.0 };
            corner.reach = self.rounding * corner.tangent().min(REACH);
        }
        let wishes = self.corners.map(|corner| corner.reach);
        for index in 1..last {
            // Two corners at one stretch share it as they need it.
            let granted = |room: f64, shared: bool, own: f64, other: f64| {
                let all = if shared { own + other } else { own };
                if all > room { own * (room / all) } else { own }
            };
            let ((_, before, first), (after, _, second)) = (rooms[index - 1], rooms[index]);
            let own = wishes[index];
            self.corners[index].reach = granted(before, first, own, wishes[index - 1]).min(granted(after, second, own, wishes[index + 1]));
            let corner = &self.corners[index];
            length -= corner.reach * 2.0 - corner.radius() * corner.angle;
        }
        length
    }

    /// Whether the ball is between a point and the next one.
    fn is_at(&self, index: usize, wrap_object: &WrapObject) -> bool {
        (self.numbers[index].1..self.numbers[index + 1].0).contains(&wrap_object.stretch)
    }

    /// Where the line lies on the ball between a point and the next one.
    fn contact(&self, index: usize) -> Option<TangentPoints> {
        let wrap_object = self.line.wrap_object.as_ref().filter(|wrap_object| self.is_at(index, wrap_object))?;
        wrap_object.on_the_side(self.frames, self.places[index], self.places[index + 1], self.side?)
    }

    fn path(&self, side: DVec3) -> Path {
        let (mut path, mut from) = (Path::new(side), self.places[0]);
        // What an arc leaves of a stretch may be a rounding, which has no direction.
        let tiny = TINY * TINY.sqrt() * self.line.length(self.frames);
        let straight = |path: &mut Path, from: DVec3, to: DVec3| {
            if from.distance(to) > tiny {
                path.line(from, to);
            }
        };
        for index in 1..self.count {
            let (corner, place) = (&self.corners[index], self.places[index]);
            let to = place - corner.into * corner.reach;
            match &self.contacts[index - 1] {
                Some(arc) => {
                    straight(&mut path, from, arc.touch);
                    path.arc(arc.touch, arc.tangent, arc.normal, arc.radius, arc.angle);
                    straight(&mut path, arc.lift, to);
                }
                None => straight(&mut path, from, to),
            }
            path.arc(to, corner.into, perpendicular(corner.out, corner.into), corner.radius(), corner.angle);
            from = place + corner.out * corner.reach;
        }
        path
    }
}

/// The angle between two directions, exact for small ones; 0 where one is none.
fn turn(into: DVec3, out: DVec3) -> f64 {
    into.cross(out).length().atan2(into.dot(out)) * f64::from(into != DVec3::ZERO && out != DVec3::ZERO)
}
