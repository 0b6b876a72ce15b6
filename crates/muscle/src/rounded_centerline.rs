//! The centreline that is drawn for a solved line of action: the line itself, rounded where it has a corner, and as long as it is.
//!
//! An arc that takes the short cut round a corner would lose length. So a corner by the angle θ is drawn as three arcs of one radius ρ: outwards by β, inwards
//! by θ + 2β, outwards by β again. They begin and end on the line, at the distance d from the corner, and are together as long as the way over the corner,
//!
//! ```text
//! 2 d = ρ (θ + 4 β),        2 sin(θ/2 + β) − sin(θ/2) = (θ/2 + 2 β) cos(θ/2)
//! ```
//!
//! where the second equation, that the arcs meet the line on the other side, has one root β between 0 and π/3, for a line that turns right round (θ = π) too.
//! Nothing changes but within d of the corner.

use glam::DVec3;

use super::centerline::{Centerline, perpendicular};
use super::wrapping::{Arc, Solution};

/// Straight parts shorter than this share of the line have no direction of their own.
const TINY: f64 = 1e-12;
/// A line that turns by less than this, radians, has no corner that could be seen.
const FLAT: f64 = 1e-7;

/// Corners for which there is room from the first: as many as most lines have in any pose.
const CORNERS: usize = 16;

/// A part of the line.
#[derive(Clone, Copy)]
enum Part<'a> {
    Straight { start: DVec3, end: DVec3 },
    Geodesic(&'a Arc),
}

impl Part<'_> {
    fn directions(&self) -> [DVec3; 2] {
        match self {
            Part::Straight { start, end } => [(end - start).normalize_or_zero(); 2],
            Part::Geodesic(arc) => [arc.start_tangent, arc.end_tangent],
        }
    }

    /// Length that a corner may take of it.
    fn room(&self) -> f64 {
        match self {
            Part::Straight { start, end } => start.distance(*end),
            Part::Geodesic(_) => 0.0,
        }
    }
}

/// Where two parts of the line meet.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Corner {
    into: DVec3,
    out: DVec3,
    /// θ.
    angle: f64,
    /// β.
    outward: f64,
    /// d of an arc with the radius that is asked for.
    wish: f64,
    /// d as the parts beside it have room for.
    reach: f64,
    /// Length of these parts that may be taken.
    rooms: [f64; 2],
}

impl Corner {
    fn new(into: DVec3, out: DVec3, rounding: f64, rooms: [f64; 2]) -> Self {
        let angle = into.cross(out).length().atan2(into.dot(out));
        if angle < FLAT {
            return Self { into, out, rooms, ..Self::default() };
        }
        let outward = outward(angle);
        Self { into, out, angle, outward, wish: rounding * spread(angle, outward), reach: 0.0, rooms }
    }

    /// Draws the three arcs round the corner at `place`.
    fn draw(&self, place: DVec3, centerline: &mut Centerline) {
        if self.reach <= 0.0 {
            return;
        }
        let radius = self.reach / spread(self.angle, self.outward);
        let mut arm = Turtle { place: place - self.into * self.reach, tangent: self.into, inward: perpendicular(self.out, self.into) };
        for (sign, angle) in [(-1.0, self.outward), (1.0, self.angle + 2.0 * self.outward), (-1.0, self.outward)] {
            centerline.arc(arm.place, arm.tangent, arm.inward * sign, radius, angle);
            arm.turn(sign, radius, angle);
        }
    }
}

/// A place on arcs in one plane, and the direction there.
struct Turtle {
    place: DVec3,
    tangent: DVec3,
    /// Square to the tangent, towards the inside of the corner.
    inward: DVec3,
}

impl Turtle {
    /// Goes along an arc, inwards for a sign of 1, outwards for −1.
    fn turn(&mut self, sign: f64, radius: f64, angle: f64) {
        let (sin, cos) = angle.sin_cos();
        let Self { place, tangent, inward } = *self;
        self.place = place + tangent * (radius * sin) + inward * (sign * radius * (1.0 - cos));
        self.tangent = tangent * cos + inward * (sign * sin);
        self.inward = inward * cos - tangent * (sign * sin);
    }
}

/// d over ρ.
fn spread(angle: f64, outward: f64) -> f64 {
    0.5 * angle + 2.0 * outward
}

/// The root β of the equation above, by Newton's method from beyond it, where the function is concave and falls.
fn outward(angle: f64) -> f64 {
    let half = 0.5 * angle;
    let (sin, cos) = half.sin_cos();
    let mut beta = 0.7 * half;
    for _ in 0..12 {
        let off = 2.0 * (half + beta).sin() - sin - (half + 2.0 * beta) * cos;
        let step = off / (2.0 * ((half + beta).cos() - cos));
        if !step.is_finite() || step.abs() <= 1e-16 * half {
            break;
        }
        beta -= step;
    }
    beta.clamp(0.5 * half, 0.7 * half)
}

/// The parts of a line that have a direction, in order.
fn parts(solution: &Solution) -> impl Iterator<Item = Part<'_>> {
    let tiny = TINY * solution.length;
    solution.stretches().iter().flat_map(move |stretch| {
        let mut arcs = solution.arcs_of(stretch).iter();
        let all = solution.segments_of(stretch).flat_map(move |segment| {
            let straight = Part::Straight { start: segment.start, end: segment.end };
            [Some(straight), arcs.next().map(Part::Geodesic)].into_iter().flatten()
        });
        all.filter(move |part| match part {
            Part::Straight { start, end } => start.distance(*end) > tiny,
            Part::Geodesic(arc) => arc.length > tiny,
        })
    })
}

/// Writes the rounded line of a solution; corners have this radius where the straight parts beside them have room. `side` is where the first cross-section's
/// first axis points.
pub(super) fn round(solution: &Solution, rounding: f64, side: DVec3, corners: &mut Vec<Corner>, centerline: &mut Centerline) {
    corners.clear();
    corners.reserve(CORNERS);
    let mut before: Option<Part<'_>> = None;
    for part in parts(solution) {
        if let Some(before) = before {
            corners.push(Corner::new(before.directions()[1], part.directions()[0], rounding, [before.room(), part.room()]));
        }
        before = Some(part);
    }
    // Two corners at one straight part share it as they need it.
    let mut wish_before = 0.0;
    for index in 0..corners.len() {
        let wish_after = corners.get(index + 1).map_or(0.0, |corner| corner.wish);
        let Some(corner) = corners.get_mut(index) else { break };
        let granted =
            |room: f64, other: f64| if corner.wish + other > room { corner.wish * room / (corner.wish + other) } else { corner.wish };
        corner.reach = granted(corner.rooms[0], wish_before).min(granted(corner.rooms[1], wish_after));
        wish_before = corner.wish;
    }
    centerline.begin(side);
    let mut start = Corner::default();
    for (index, part) in parts(solution).enumerate() {
        let end = corners.get(index).copied().unwrap_or_default();
        match part {
            Part::Straight { start: from, end: to } => {
                let along = (to - from).normalize_or_zero();
                let (first, last) = (from + along * start.reach, to - along * end.reach);
                // What two corners leave of a part may be a rounding, which has no direction.
                if (last - first).dot(along) > TINY * solution.length {
                    centerline.line(first, last);
                }
                end.draw(to, centerline);
            }
            Part::Geodesic(arc) => {
                centerline.geodesic(arc);
                end.draw(arc.end, centerline);
            }
        }
        start = end;
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::wrapping::{PathPoint, PathSolver};

    #[test]
    fn a_rounded_line_is_as_long_as_the_line_and_ends_where_it_ends() {
        let points = [
            (0.0, 0.0, 0.0),
            (10.0, 0.0, 0.0),
            (10.0, 7.0, 1.0),
            (2.0, 7.0, 1.0),
            (9.0, 7.0, 1.0),
            (9.5, -3.0, 4.0),
            (9.5, -3.0, 4.0),
            (9.5, -2.9, 4.0),
        ];
        let points: Vec<PathPoint> =
            points.iter().enumerate().map(|(body, (x, y, z))| PathPoint { body, position: DVec3::new(*x, *y, *z) }).collect();
        for rounding in [0.0, 0.3, 2.0, 50.0] {
            let mut solver = PathSolver::new();
            let solution = solver.solve(&points, &[]);
            let mut centerline = Centerline::default();
            round(solution, rounding, DVec3::Z, &mut Vec::new(), &mut centerline);
            assert!((centerline.length() - solution.length).abs() < 1e-12 * solution.length, "{rounding}");
            // It has no gap: each piece begins where the one before it ends.
            let mut cursor = centerline.cursor();
            let mut before = cursor.frame_at(0.0);
            assert!(before.position.distance(points[0].position) < 1e-12);
            let steps = 20_000;
            for step in 1..=steps {
                let frame = cursor.frame_at(centerline.length() * f64::from(step) / f64::from(steps));
                let moved = frame.position.distance(before.position);
                assert!(moved < 1.001 * centerline.length() / f64::from(steps), "{rounding}: {moved} at {step}");
                if rounding == 2.0 {
                    assert!(frame.u.dot(before.u) > 0.9 && frame.tangent.dot(before.tangent) > 0.9, "a kink at {step}");
                }
                before = frame;
            }
            assert!(before.position.distance(points[points.len() - 1].position) < 1e-9);
        }
    }

    #[test]
    fn the_outward_angle_solves_its_equation() {
        for step in 1..=1000 {
            let angle = PI * f64::from(step) / 1000.0;
            let (half, beta) = (0.5 * angle, outward(angle));
            let off = 2.0 * (half + beta).sin() - half.sin() - (half + 2.0 * beta) * half.cos();
            assert!(off.abs() < 1e-15 && beta > 0.5 * half && beta <= PI / 3.0 + 1e-12, "{angle}: {beta} {off}");
        }
        assert!((outward(PI) - PI / 3.0).abs() < 1e-12);
    }
}
