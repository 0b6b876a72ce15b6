//! Newton's method on the path error of all surfaces of a stretch together, after Scholz et al. (2016).
//!
//! Every surface that acts has four unknowns: its geodesic starts further along (1) or further aside (2), in a turned direction (3), and is longer (4). Four
//! numbers say how far the path is from a shortest one: the straight parts before and after the geodesic, as directions e, must have no component along the
//! normal n and the binormal b where they meet it. A change of one geodesic moves the straight parts to its neighbours alone, so that the Jacobian is
//! block-tridiagonal.

use glam::{DMat3, DVec3};

use super::banded::{BLOCK, BandedSystem};
use super::geodesic::{GeodesicEnd, GeodesicStart};
use super::shape::{Curvature, Shape};

/// A surface where it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placed {
    /// Its shape.
    pub shape: Shape,
    /// Turns its frame's directions into the world's.
    pub rotation: DMat3,
    /// Its centre in the world.
    pub center: DVec3,
}

impl Placed {
    pub(super) fn to_local(self, point: DVec3) -> DVec3 {
        self.rotation.transpose() * (point - self.center)
    }

    pub(super) fn to_world(self, point: DVec3) -> DVec3 {
        self.center + self.rotation * point
    }
}

/// A geodesic on a surface, in the surface's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Contact {
    /// Where it starts.
    pub start: GeodesicStart,
    /// Where that leads.
    pub end: GeodesicEnd,
}

impl Contact {
    pub(super) fn new(shape: &Shape, start: GeodesicStart) -> Self {
        Self { start, end: shape.shoot(&start) }
    }
}

/// How a run of Newton's method ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Convergence {
    /// Whether the path error came down to rounding, with straight parts that run on in the geodesics' directions and not against them.
    pub converged: bool,
    /// Largest component of the path error, before each step and at the end.
    pub errors: [f64; STEPS + 1],
    /// Steps taken.
    pub steps: usize,
}

impl Convergence {
    /// The path error at the end.
    pub(super) fn error(&self) -> f64 {
        self.errors.get(self.steps).copied().unwrap_or(f64::INFINITY)
    }
}

/// Most steps.
pub(super) const STEPS: usize = 30;
/// A path error, as the sine of an angle, that needs no further step.
const DONE: f64 = 3e-13;
/// A path error that counts as converged where rounding lets no step make it smaller.
const ROUNDING: f64 = 1e-9;
/// Longest step: radians of turning, and of moving over a sphere of the surface's smallest radius.
const LONGEST: f64 = 0.8;
/// Straight parts shorter than this share of the surface's size count by their distance, longer ones by their angle.
const SHORT: f64 = 0.5;
/// Halvings of a step that makes the path error larger.
const HALVINGS: usize = 10;

/// The frame of a geodesic at one of its ends, in the world: tangent t, outward normal n, binormal b = t × n.
#[derive(Debug, Clone, Copy)]
struct ContactFrame {
    point: DVec3,
    tangent: DVec3,
    normal: DVec3,
    binormal: DVec3,
    curvature: Curvature,
}

/// How a contact point and two axes of its frame move when one unknown grows.
#[derive(Debug, Clone, Copy)]
struct Variation {
    point: DVec3,
    normal: DVec3,
    binormal: DVec3,
}

impl ContactFrame {
    fn new(placed: &Placed, point: DVec3, tangent: DVec3) -> Self {
        let normal = placed.shape.normal(point);
        let binormal = tangent.cross(normal);
        Self {
            point: placed.to_world(point),
            tangent: placed.rotation * tangent,
            normal: placed.rotation * normal,
            binormal: placed.rotation * binormal,
            curvature: placed.shape.curvature(point, tangent, binormal),
        }
    }

    /// Moving along the geodesic: n′ = S t, b′ = −(b·S t) n.
    fn along(&self) -> Variation {
        let Curvature { along, twist, .. } = self.curvature;
        Variation { point: self.tangent, normal: self.tangent * along + self.binormal * twist, binormal: self.normal * -twist }
    }

    /// Moving by `distance` along the binormal while the direction turns by `turn` towards it.
    fn aside(&self, distance: f64, turn: f64) -> Variation {
        let Curvature { twist, across, .. } = self.curvature;
        Variation {
            point: self.binormal * distance,
            normal: (self.tangent * twist + self.binormal * across) * distance,
            binormal: self.tangent * -turn - self.normal * (across * distance),
        }
    }

    fn none() -> Variation {
        Variation { point: DVec3::ZERO, normal: DVec3::ZERO, binormal: DVec3::ZERO }
    }
}

/// Both frames of a geodesic and their variations by the four unknowns.
#[derive(Debug, Clone, Copy)]
struct Variations {
    size: f64,
    first: ContactFrame,
    last: ContactFrame,
    of_first: [Variation; BLOCK],
    of_last: [Variation; BLOCK],
}

impl Variations {
    fn new(placed: &Placed, contact: &Contact) -> Self {
        let first = ContactFrame::new(placed, contact.start.point, contact.start.tangent);
        let last = ContactFrame::new(placed, contact.end.point, contact.end.tangent);
        let end = &contact.end;
        Self {
            size: placed.shape.size(),
            first,
            last,
            of_first: [first.along(), first.aside(1.0, 0.0), first.aside(0.0, 1.0), ContactFrame::none()],
            of_last: [last.along(), last.aside(end.shift, end.shift_rate), last.aside(end.turn, end.turn_rate), last.along()],
        }
    }
}

/// Buffers of Newton's method.
#[derive(Debug, Clone, Default)]
pub(super) struct Newton {
    /// How many more geodesics may be tried: what bounds the time of a stretch whatever its surfaces are.
    pub budget: usize,
    system: BandedSystem,
    variations: Vec<Variations>,
    trial: Vec<Contact>,
}

impl Newton {
    /// With so many geodesics to try.
    #[cfg(test)]
    pub(super) fn with_budget(budget: usize) -> Self {
        Self { budget, ..Self::default() }
    }

    /// Brings `contacts`, one on each surface, to the shortest path near them. They are left at the smallest path error that was reached.
    pub(super) fn solve(&mut self, from: DVec3, to: DVec3, surfaces: &[Placed], contacts: &mut [Contact]) -> Convergence {
        let mut result = Convergence { converged: false, errors: [f64::INFINITY; STEPS + 1], steps: 0 };
        let (mut square, mut largest, mut forwards) = path_error(from, to, surfaces, contacts);
        for step in 0..=STEPS {
            result.steps = step;
            if let Some(error) = result.errors.get_mut(step) {
                *error = largest;
            }
            if largest < DONE || step == STEPS || !square.is_finite() {
                break;
            }
            self.assemble(from, to, surfaces, contacts);
            self.system.solve();
            let mut factor = self.longest(surfaces);
            let mut better = false;
            for _ in 0..HALVINGS {
                if self.budget < surfaces.len() {
                    self.budget = 0;
                    break;
                }
                self.budget -= surfaces.len();
                self.trial.clear();
                let moves = self.system.values.chunks_exact(BLOCK);
                self.trial
                    .extend(surfaces.iter().zip(&*contacts).zip(moves).map(|((placed, contact), by)| moved(placed, contact, by, factor)));
                let (trial_square, trial_largest, trial_forwards) = path_error(from, to, surfaces, &self.trial);
                if trial_square < square * (1.0 - 1e-3 * factor) {
                    (square, largest, forwards) = (trial_square, trial_largest, trial_forwards);
                    contacts.copy_from_slice(&self.trial);
                    better = true;
                    break;
                }
                factor *= 0.5;
            }
            if !better {
                break;
            }
        }
        result.converged = forwards && largest < ROUNDING;
        result
    }

    /// The factor that keeps the step that was solved for below the longest.
    fn longest(&self, surfaces: &[Placed]) -> f64 {
        let mut most = 0.0_f64;
        for (by, placed) in self.system.values.chunks_exact(BLOCK).zip(surfaces) {
            if let [along, aside, turn, longer] = *by {
                let size = placed.shape.size();
                most = most.max(turn.abs()).max(along.abs().max(aside.abs()).max(longer.abs()) / size);
            }
        }
        if most > LONGEST { LONGEST / most } else { 1.0 }
    }

    fn assemble(&mut self, from: DVec3, to: DVec3, surfaces: &[Placed], contacts: &[Contact]) {
        self.variations.clear();
        self.variations.extend(surfaces.iter().zip(contacts).map(|(placed, contact)| Variations::new(placed, contact)));
        let Self { system, variations, .. } = self;
        system.reset(BLOCK * variations.len());
        for (index, here) in variations.iter().enumerate() {
            let row = BLOCK * index;
            let before = index.checked_sub(1).and_then(|before| variations.get(before));
            let after = variations.get(index + 1);
            let start = before.map_or(from, |before| before.last.point);
            let end = after.map_or(to, |after| after.first.point);
            let size = here.size;
            let w = weighed(here.first.point - start, size);
            equation(system, row, w, 1.0, here.first.normal, here.of_first.map(|by| (by.point, by.normal)));
            equation(system, row + 1, w, 1.0, here.first.binormal, here.of_first.map(|by| (by.point, by.binormal)));
            if let Some(before) = before {
                for (offset, axis) in [here.first.normal, here.first.binormal].into_iter().enumerate() {
                    neighbour(system, row + offset, w, -1.0, axis, row - BLOCK, &before.of_last);
                }
            }
            let w = weighed(end - here.last.point, size);
            equation(system, row + 2, w, -1.0, here.last.normal, here.of_last.map(|by| (by.point, by.normal)));
            equation(system, row + 3, w, -1.0, here.last.binormal, here.of_last.map(|by| (by.point, by.binormal)));
            if let Some(after) = after {
                for (offset, axis) in [here.last.normal, here.last.binormal].into_iter().enumerate() {
                    neighbour(system, row + 2 + offset, w, 1.0, axis, row + BLOCK, &after.of_first);
                }
            }
        }
    }
}

/// A straight part w as an equation sees it: w / (|w| + μ), and the reciprocal of |w| + μ.
///
/// The sine of an angle says nothing good about a contact point that is all but at the path's end: a hair's breadth turns it round. Divided by |w| + μ in
/// place of |w|, with μ half the surface's size, a long straight part counts by its angle, and a short one by its distance.
fn weighed(straight: DVec3, size: f64) -> (DVec3, f64) {
    let inverse = (straight.length() + SHORT * size).recip();
    (straight * inverse, inverse)
}

/// The equation w·axis / (|w| + μ) = 0 by the unknowns of its own surface; `sign` is negative where its beginning moves. `w` is weighed.
fn equation(system: &mut BandedSystem, row: usize, (w, inverse): (DVec3, f64), sign: f64, axis: DVec3, by: [(DVec3, DVec3); BLOCK]) {
    let error = w.dot(axis);
    let square = (axis - w.normalize_or_zero() * error) * (sign * inverse);
    let column = row / BLOCK * BLOCK;
    for (offset, (point, turned)) in by.into_iter().enumerate() {
        system.set(row, column + offset, point.dot(square) + w.dot(turned));
    }
    if let Some(value) = system.values.get_mut(row) {
        *value = -error;
    }
}

/// The same equation by the unknowns of a neighbour, which move the other end of the straight part.
fn neighbour(
    system: &mut BandedSystem,
    row: usize,
    (w, inverse): (DVec3, f64),
    sign: f64,
    axis: DVec3,
    column: usize,
    by: &[Variation; BLOCK],
) {
    let square = (axis - w.normalize_or_zero() * w.dot(axis)) * (sign * inverse);
    for (offset, variation) in by.iter().enumerate() {
        system.set(row, column + offset, variation.point.dot(square));
    }
}

/// The sum of squares of the equations' errors, the largest sine between a straight part and its geodesic, and whether all straight parts run on with the
/// geodesics.
fn path_error(from: DVec3, to: DVec3, surfaces: &[Placed], contacts: &[Contact]) -> (f64, f64, bool) {
    let (mut square, mut largest, mut forwards) = (0.0, 0.0_f64, true);
    let mut before = from;
    for (index, (placed, contact)) in surfaces.iter().zip(contacts).enumerate() {
        let after = surfaces.get(index + 1).zip(contacts.get(index + 1)).map_or(to, |(placed, next)| placed.to_world(next.start.point));
        let (first, last) = (placed.to_world(contact.start.point), placed.to_world(contact.end.point));
        for (straight, point, tangent) in
            [(first - before, contact.start.point, contact.start.tangent), (after - last, contact.end.point, contact.end.tangent)]
        {
            let (w, _) = weighed(placed.rotation.transpose() * straight, placed.shape.size());
            let e = w.normalize_or(tangent);
            let normal = placed.shape.normal(point);
            for axis in [normal, tangent.cross(normal)] {
                square += w.dot(axis).powi(2);
                largest = largest.max(e.dot(axis).abs());
            }
            forwards &= e.dot(tangent) > 0.0;
        }
        before = last;
    }
    (square, largest, forwards)
}

/// A geodesic whose unknowns have grown by `factor` times a solution of the linear equations.
fn moved(placed: &Placed, contact: &Contact, by: &[f64], factor: f64) -> Contact {
    let [along, aside, turn, longer] = *by else { return *contact };
    let GeodesicStart { point, tangent, length } = contact.start;
    let binormal = tangent.cross(placed.shape.normal(point));
    let moved = placed.shape.project(point + (tangent * along + binormal * aside) * factor);
    let (sin, cos) = (turn * factor).sin_cos();
    let turned = tangent * cos + binormal * sin;
    let tangent = turned.reject_from_normalized(placed.shape.normal(moved)).normalize_or(tangent);
    Contact::new(&placed.shape, GeodesicStart { point: moved, tangent, length: length + longer * factor })
}
