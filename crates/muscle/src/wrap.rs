//! The ball that a line of action goes round: the shortest path over it, in closed form.

use std::f64::consts::PI;

use glam::DVec3;

use super::centerline::perpendicular;
use super::line_of_action::{Frames, Point};

/// Nearer to the ball's centre than this share of its radius a straight line passes on no side of it.
const CENTRAL: f64 = 1e-6;
/// A line that leans to the wrong side by no more than this, as a cosine, is not on it.
const LEANS: f64 = 1e-9;

/// A ball that the line goes round.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WrapObject {
    /// Its centre.
    pub center: Point,
    /// The side that the line passes on: a direction in the axes of the centre's bone.
    pub side: DVec3,
    /// Its radius.
    pub radius: f64,
    /// The stretch that goes round it: 0 = from the origin to the first via point.
    pub stretch: usize,
}

/// The arc of a line that lies on a ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TangentPoints {
    /// Where it begins.
    pub touch: DVec3,
    /// Where it ends.
    pub lift: DVec3,
    /// Its direction where it begins, of length 1.
    pub tangent: DVec3,
    /// Its direction where it ends, of length 1.
    pub leaves: DVec3,
    /// Towards its centre where it begins, of length 1.
    pub normal: DVec3,
    /// Its radius.
    pub radius: f64,
    /// Radians.
    pub angle: f64,
    /// The end (0 or 1) that lies inside the ball, so that the ball is taken no larger than that end is far from its centre.
    pub held_by: Option<usize>,
}

impl WrapObject {
    /// The part of the shortest path from `from` to `to` over the ball that lies on it: an arc of the great circle in the plane of both ends and the
    /// centre. Of its two ways round it takes the one on the ball's side. `None` where the straight line clears the ball.
    ///
    /// An end inside the ball leaves only as much of the ball as it does not lie in: then the line starts round it at that end.
    pub(super) fn between(&self, frames: &(impl Frames + ?Sized), from: DVec3, to: DVec3) -> Option<TangentPoints> {
        self.on_the_side(frames, from, to, self.outward(frames))
    }

    /// The ball's side in the space of the frames, of length 1.
    fn outward(&self, frames: &(impl Frames + ?Sized)) -> DVec3 {
        frames.frame(self.center.bone).transform_vector3(self.side).normalize_or(DVec3::X)
    }

    /// The direction, perpendicular to the straight line, in which the path goes round the ball: a side that [`WrapObject::on_the_side`] takes.
    pub(super) fn passes(&self, frames: &(impl Frames + ?Sized), from: DVec3, to: DVec3) -> Option<DVec3> {
        let center = frames.frame(self.center.bone).transform_point3(self.center.local);
        Some(self.up(center, from, (to - from).try_normalize()?, self.outward(frames)))
    }

    fn up(&self, center: DVec3, from: DVec3, along: DVec3, side: DVec3) -> DVec3 {
        let out = (from - center).reject_from_normalized(along);
        // Twice made perpendicular: of a short vector the first time leaves as much as rounding of the long ones.
        let up = perpendicular(if out.length() > CENTRAL * self.radius { out.normalize_or(side) } else { side }, along);
        if up.dot(side) < -LEANS { -up } else { up }
    }

    /// [`WrapObject::between`] with another side than the ball's own.
    pub(super) fn on_the_side(&self, frames: &(impl Frames + ?Sized), from: DVec3, to: DVec3, side: DVec3) -> Option<TangentPoints> {
        let along = (to - from).try_normalize()?;
        let center = frames.frame(self.center.bone).transform_point3(self.center.local);
        let up = self.up(center, from, along, side);
        // Both ends seen from the centre: x along the straight line, y up.
        let flat = |point: DVec3| ((point - center).dot(along), (point - center).dot(up));
        let ((px, py), (qx, qy)) = (flat(from), flat(to));
        let (p, q) = (px.hypot(py), qx.hypot(qy));
        let radius = self.radius.min(p).min(q);
        if radius <= 0.0 || px >= 0.0 || qx <= 0.0 {
            return None;
        }
        // Directions of the tangent points: the start's lies left of the top, the end's right of it.
        let leave = PI - (py / -px).atan() - (radius / p).acos();
        let arrive = (qy / qx).atan() + (radius / q).acos();
        if leave <= arrive {
            return None;
        }
        let outward = |angle: f64| along * angle.cos() + up * angle.sin();
        let onward = |angle: f64| along * angle.sin() - up * angle.cos();
        Some(TangentPoints {
            touch: center + outward(leave) * radius,
            lift: center + outward(arrive) * radius,
            tangent: onward(leave),
            leaves: onward(arrive),
            normal: -outward(leave),
            radius,
            angle: leave - arrive,
            held_by: (radius < self.radius).then_some(usize::from(q < p)),
        })
    }
}
