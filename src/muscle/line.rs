//! A muscle's line of action: from its origin over via points and round a joint to its insertion, and the centre line that is drawn for it.
//!
//! A line of action is made of straight stretches. At a via point it is rounded by an arc whose radius the muscle's thickness allows, and round a
//! joint it lies on a ball like a rope on a pulley; its length is that of the rounded line, in closed form.
//!
//! On the two-rod arm the line of action may run between points on the rods' axes, so a belly drawn along it would swallow the rods. What is drawn
//! there is an arch ([`Path::arch`]) of *exactly the same length*, whose ends lie on the rods' surfaces on the muscle's side, slid a few
//! millimetres towards the elbow to give the arch its height ([`super::clearance`]). So the volume on the screen is the volume of the ledger, and
//! length and moment arm stay those of the line of action: on the straight-rod arm, the law of cosines.

use glam::{DMat4, DVec3};

use super::edit::VIA;
use super::path::{Path, perpendicular};

/// A point that moves with a bone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Index of the bone in the rig's list.
    pub bone: usize,
    /// Place in the bone's axes, in the file's unit.
    pub local: DVec3,
}

/// Frames of the rig's bones in the space of its root: positions in the file's unit, axes of length 1.
pub trait Frames {
    /// The frame of bone `index`.
    fn frame(&self, index: usize) -> DMat4;

    /// Where a point is.
    fn place(&self, point: Point) -> DVec3 {
        self.frame(point.bone).transform_point3(point.local)
    }
}

/// A ball that the line goes round.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulley {
    /// Its centre.
    pub center: Point,
    /// The side that the line passes on: a direction in the axes of the centre's bone.
    pub side: DVec3,
    /// Its radius.
    pub radius: f64,
    /// The stretch that goes round it: 0 = from the origin to the first via point.
    pub stretch: usize,
}

/// A line of action.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Where it begins.
    pub origin: Point,
    /// Where it ends.
    pub insertion: Point,
    /// Points in between, in order.
    pub via: Vec<Point>,
    /// What it goes round.
    pub pulley: Option<Pulley>,
    /// Radius of the arcs at via points.
    pub rounding: f64,
    /// The ends of the centre line that is drawn, where it is not the line of action itself.
    pub drawn: Option<Drawn>,
}

/// How the drawn centre line differs from the line of action.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drawn {
    /// Ends on the bones' surfaces.
    pub ends: [Point; 2],
    /// Side that the arch bulges to, in the axes of both ends' bones.
    pub side: DVec3,
}

/// Most points of a line.
const POINTS: usize = VIA + 2;
/// Most times that via points are drawn in, each time for the places that their neighbours have got; what does not fit then is rounded with a smaller arc.
const PASSES: usize = 12;
/// Points that lie nearer to each other than this share of the line are one.
const TINY: f64 = 1e-9;
/// Share of the length in each shoulder of the arch: steep at the ends and flat along the belly.
const SHOULDER: f64 = 0.36;

impl Line {
    /// Whether it has neither via points nor a pulley.
    pub fn is_straight(&self) -> bool {
        self.via.is_empty() && self.pulley.is_none()
    }

    /// Length of the line of action.
    pub fn length(&self, frames: &(impl Frames + ?Sized)) -> f64 {
        if self.is_straight() { frames.place(self.origin).distance(frames.place(self.insertion)) } else { self.route(frames).length() }
    }

    /// The centre line that is drawn; `length` is that of the line of action or, where the muscle is held at a limit, another.
    pub fn lay(&self, frames: &(impl Frames + ?Sized), length: f64) -> Path {
        match &self.drawn {
            Some(drawn) => drawn.lay(frames, length),
            None => self.route(frames),
        }
    }

    /// The line of action itself, rounded.
    pub fn route(&self, frames: &(impl Frames + ?Sized)) -> Path {
        let side = self.pulley.map_or(DVec3::X, |pulley| frames.frame(pulley.center.bone).transform_vector3(pulley.side));
        Way::new(self, frames).path(side)
    }
}

impl Drawn {
    /// The arch of this length between the drawn ends.
    pub fn lay(&self, frames: &(impl Frames + ?Sized), length: f64) -> Path {
        let [start, end] = self.ends.map(|point| frames.place(point));
        let [above, below] = self.ends.map(|point| frames.frame(point.bone).transform_vector3(self.side));
        Path::arch(start, end, length, SHOULDER, above + below)
    }
}

impl Pulley {
    /// The part of the shortest way from `from` to `to` past the ball, on its side, that lies on the ball. It lies in the plane of the two ends and the
    /// side. `None` where the straight line clears the ball, or an end lies within it: then the way is straight.
    fn between(&self, frames: &(impl Frames + ?Sized), from: DVec3, to: DVec3) -> Option<Contact> {
        let along = (to - from).try_normalize()?;
        let frame = frames.frame(self.center.bone);
        let up = perpendicular(frame.transform_vector3(self.side), along);
        let center = frame.transform_point3(self.center.local);
        // The ball's circle in that plane, and both ends seen from its middle: x along the chord, y up.
        let off = (from - center).dot(along.cross(up));
        let middle = center + along.cross(up) * off;
        let squared = self.radius * self.radius - off * off;
        let flat = |point: DVec3| ((point - middle).dot(along), (point - middle).dot(up));
        let ((px, py), (qx, qy)) = (flat(from), flat(to));
        let (p, q) = (px.hypot(py), qx.hypot(qy));
        let radius = squared.max(0.0).sqrt();
        if radius <= 0.0 || p <= radius || q <= radius || px >= 0.0 || qx <= 0.0 {
            return None;
        }
        // Directions of the tangent points: the start's lies left of the top, the end's right of it.
        let leave = std::f64::consts::PI - (py / -px).atan() - (radius / p).acos();
        let arrive = (qy / qx).atan() + (radius / q).acos();
        if leave <= arrive {
            return None;
        }
        let outward = |angle: f64| along * angle.cos() + up * angle.sin();
        let (touch, lift) = (middle + outward(leave) * radius, middle + outward(arrive) * radius);
        Some(Contact {
            touch,
            lift,
            tangent: along * leave.sin() - up * leave.cos(),
            normal: -outward(leave),
            radius,
            angle: leave - arrive,
        })
    }
}

/// The arc of a line that lies on a ball.
struct Contact {
    touch: DVec3,
    lift: DVec3,
    tangent: DVec3,
    normal: DVec3,
    radius: f64,
    angle: f64,
}

/// Origin, via points and insertion where they are, the via points drawn in until the line can be rounded at each.
struct Way<'a, F: Frames + ?Sized> {
    line: &'a Line,
    frames: &'a F,
    points: [DVec3; POINTS],
    /// The number of each among all points of the line: points that fall together count once.
    numbers: [usize; POINTS],
    count: usize,
}

impl<'a, F: Frames + ?Sized> Way<'a, F> {
    fn new(line: &'a Line, frames: &'a F) -> Self {
        let mut way = Self { line, frames, points: [DVec3::ZERO; POINTS], numbers: [0; POINTS], count: 0 };
        let via = line.via.len().min(POINTS - 2);
        let all = [line.origin].into_iter().chain(line.via.iter().take(via).copied()).chain([line.insertion]);
        for (number, point) in all.enumerate() {
            (way.points[number], way.numbers[number]) = (frames.place(point), number);
            way.count = number + 1;
        }
        if via > 0 {
            way.draw_in();
        }
        way
    }

    /// Draws via points in, each towards the straight line between its neighbours, until the arcs at all of them fit: a thick muscle is not bent tighter
    /// than its thickness allows. One that comes to lie on its neighbour is no corner any more.
    fn draw_in(&mut self) {
        let long: f64 = self.points[..self.count].windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let (tiny, mut fits) = (TINY * long, false);
        for _ in 0..PASSES {
            if std::mem::replace(&mut fits, true) {
                break;
            }
            let mut index = 1;
            while index + 1 < self.count {
                let (before, after) = self.neighbours(index);
                if let Some(drawn) = drawn_in(before, self.points[index], after, self.line.rounding) {
                    (self.points[index], fits) = (drawn, false);
                }
                let near = |other: usize| self.points[index].distance(self.points[other]) <= tiny;
                if near(index - 1) || near(index + 1) {
                    self.points.copy_within(index + 1..self.count, index);
                    self.numbers.copy_within(index + 1..self.count, index);
                    (self.count, fits) = (self.count - 1, false);
                } else {
                    index += 1;
                }
            }
        }
    }

    /// What a corner is between: the points beside it, or those where the line touches the ball on the way there.
    fn neighbours(&self, index: usize) -> (DVec3, DVec3) {
        let before = self.contact(index - 1).map_or(self.points[index - 1], |contact| contact.lift);
        let after = self.contact(index).map_or(self.points[index + 1], |contact| contact.touch);
        (before, after)
    }

    /// The ball on the way from a point to the next one.
    fn contact(&self, index: usize) -> Option<Contact> {
        let pulley = self.line.pulley.as_ref()?;
        let there = (self.numbers[index]..self.numbers[index + 1]).contains(&pulley.stretch);
        if there { pulley.between(self.frames, self.points[index], self.points[index + 1]) } else { None }
    }

    fn path(&self, side: DVec3) -> Path {
        let (mut path, mut from) = (Path::new(side), self.points[0]);
        for index in 1..self.count {
            let corner = (index + 1 < self.count).then(|| {
                let (before, after) = self.neighbours(index);
                Corner::new(before, self.points[index], after, self.line.rounding)
            });
            let to = corner.as_ref().map_or(self.points[index], |corner| corner.start);
            match self.contact(index - 1) {
                Some(Contact { touch, lift, tangent, normal, radius, angle }) => {
                    path.line(from, touch);
                    path.arc(touch, tangent, normal, radius, angle);
                    path.line(lift, to);
                }
                None => path.line(from, to),
            }
            from = to;
            if let Some(Corner { start, end, tangent, normal, radius, angle }) = corner {
                path.arc(start, tangent, normal, radius, angle);
                from = end;
            }
        }
        path
    }
}

/// A rounded corner.
struct Corner {
    start: DVec3,
    end: DVec3,
    tangent: DVec3,
    normal: DVec3,
    radius: f64,
    angle: f64,
}

impl Corner {
    /// The corner at `via`, with an arc of this radius, or of the largest that fits where that is smaller: so the line has no kink whatever happens.
    fn new(before: DVec3, via: DVec3, after: DVec3, radius: f64) -> Self {
        let (into, out) = ((via - before).normalize_or_zero(), (after - via).normalize_or_zero());
        let angle = into.angle_between(out);
        let (angle, tan) = if angle.is_finite() { (angle, (0.5 * angle).tan()) } else { (0.0, 0.0) };
        let room = room(before, via, after);
        let radius = if radius * tan > room { room / tan } else { radius };
        let reach = radius * tan;
        Self { start: via - into * reach, end: via + out * reach, tangent: into, normal: perpendicular(out, into), radius, angle }
    }
}

/// How much of the stretches beside a corner its arc may take.
fn room(before: DVec3, via: DVec3, after: DVec3) -> f64 {
    0.5 * before.distance(via).min(via.distance(after))
}

/// Where a corner must be for an arc of this radius; `None` where it may stay.
fn drawn_in(before: DVec3, via: DVec3, after: DVec3, radius: f64) -> Option<DVec3> {
    let foot = {
        let along = (after - before).normalize_or_zero();
        before + along * (via - before).dot(along).clamp(0.0, before.distance(after))
    };
    let fits = |via: DVec3| {
        let angle = (via - before).normalize_or_zero().angle_between((after - via).normalize_or_zero());
        radius * (0.5 * angle).tan() <= room(before, via, after) * (1.0 + 1e-9)
    };
    if fits(via) {
        return None;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if fits(foot + (via - foot) * middle) { low = middle } else { high = middle }
    }
    Some(foot + (via - foot) * low)
}
