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
        let (first, last) = (frames.place(self.origin), frames.place(self.insertion));
        let side = self.pulley.map_or(DVec3::X, |pulley| frames.frame(pulley.center.bone).transform_vector3(pulley.side));
        let mut path = Path::new(side);
        // Walk from corner to corner: `from` is where the last arc ended.
        let mut from = first;
        for (index, via) in self.via.iter().enumerate() {
            let before = index.checked_sub(1).and_then(|i| self.via.get(i)).map_or(first, |point| frames.place(*point));
            let after = self.via.get(index + 1).map_or(last, |point| frames.place(*point));
            let corner = Corner::new(before, frames.place(*via), after, self.rounding);
            self.stretch(frames, index, from, corner.start, &mut path);
            path.arc(corner.start, corner.tangent, corner.normal, corner.radius, corner.angle);
            from = corner.end;
        }
        self.stretch(frames, self.via.len(), from, last, &mut path);
        path
    }

    fn stretch(&self, frames: &(impl Frames + ?Sized), index: usize, from: DVec3, to: DVec3, path: &mut Path) {
        match self.pulley.filter(|pulley| pulley.stretch == index) {
            Some(pulley) => pulley.round(frames, from, to, path),
            None => path.line(from, to),
        }
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
    /// Adds the shortest way from `from` to `to` that passes the ball on its side. It lies in the plane of the two ends and the side: tangent, arc,
    /// tangent. Where the straight line clears the ball, or an end lies within it, the way is straight.
    fn round(&self, frames: &(impl Frames + ?Sized), from: DVec3, to: DVec3, path: &mut Path) {
        let Some(along) = (to - from).try_normalize() else { return };
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
            path.line(from, to);
            return;
        }
        // Directions of the tangent points: the start's lies left of the top, the end's right of it.
        let leave = std::f64::consts::PI - (py / -px).atan() - (radius / p).acos();
        let arrive = (qy / qx).atan() + (radius / q).acos();
        if leave <= arrive {
            path.line(from, to);
            return;
        }
        let outward = |angle: f64| along * angle.cos() + up * angle.sin();
        let (touch, lift) = (middle + outward(leave) * radius, middle + outward(arrive) * radius);
        path.line(from, touch);
        path.arc(touch, along * leave.sin() - up * leave.cos(), -outward(leave), radius, leave - arrive);
        path.line(lift, to);
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
    /// The corner at `via`. Where the arc would need more than half of a stretch beside it, the point is drawn towards the straight line between
    /// its neighbours until the arc fits: a thick muscle is not bent tighter than its thickness allows.
    fn new(before: DVec3, via: DVec3, after: DVec3, radius: f64) -> Self {
        let foot = {
            let along = (after - before).normalize_or_zero();
            before + along * (via - before).dot(along).clamp(0.0, before.distance(after))
        };
        let fits = |pull: f64| Self::fit(before, foot + (via - foot) * pull, after, radius);
        let (full, ok) = fits(1.0);
        if ok {
            return full;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if fits(middle).1 { low = middle } else { high = middle }
        }
        fits(low).0
    }

    fn fit(before: DVec3, via: DVec3, after: DVec3, radius: f64) -> (Self, bool) {
        let (into, out) = ((via - before).normalize_or_zero(), (after - via).normalize_or_zero());
        let angle = into.angle_between(out);
        let reach = radius * (0.5 * angle).tan();
        let room = 0.5 * before.distance(via).min(via.distance(after));
        let corner = Self {
            start: via - into * reach,
            end: via + out * reach,
            tangent: into,
            normal: perpendicular(out, into),
            radius,
            angle: if angle.is_finite() { angle } else { 0.0 },
        };
        (corner, reach <= room)
    }
}
