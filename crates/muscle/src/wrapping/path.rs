//! A path from its origin over its via points to its insertion, solved stretch by stretch.

use glam::{DMat3, DVec3};

use super::dual::DualVec;
use super::newton::Placed;
use super::shape::Shape;
use super::solution::{Arc, Given, InsidePoint, Solution, Status, Stretch};
use super::stretch::{Slot, StretchSolver};
use super::surface::{PathPoint, Surface, WrapSurface};
use super::yielding::{self, Yielding};

/// Coordinates beyond this are as good as infinite: their squares have to stay finite.
const FARTHEST: f64 = 1e50;
/// A surface that yields to less than this share of its size does not act.
const VANISHED: f64 = 1e-9;

/// Solves paths. No memory is asked for while the numbers of points and surfaces stay the same.
///
/// A solution depends on what is given alone, to the last bit, and not on what was solved before: the estimates by closed forms are so near that the last
/// solution as the start of the next saved no step (two on an ellipsoid, either way).
#[derive(Debug, Clone, Default)]
pub struct PathSolver {
    stretch: StretchSolver,
    solution: Solution,
}

impl PathSolver {
    /// A solver with empty buffers.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The last solution; of none, one without a length.
    #[must_use]
    pub fn solution(&self) -> &Solution {
        &self.solution
    }

    /// Solves the path through `points` in their order. On each stretch the surfaces that may act on it follow one another in the order of `surfaces`, as in
    /// OpenSim's `Scholz2015GeometryPath`: the order is the caller's, no surface is passed twice on a stretch.
    ///
    /// Fewer than two points have no length. Any input has an answer; [`Solution::status`] tells whether it can be relied on.
    pub fn solve(&mut self, points: &[PathPoint], surfaces: &[WrapSurface]) -> &Solution {
        let solution = &mut self.solution;
        solution.stretches.clear();
        solution.arcs.clear();
        solution.inside.clear();
        // What this path does not touch the next one may.
        solution.arcs.reserve(surfaces.len());
        solution.inside.reserve(surfaces.len());
        (solution.length, solution.status, solution.path_error, solution.steps) = (0.0, Status::Converged, 0.0, 0);
        let near = |point: DVec3| point.abs().max_element() < FARTHEST && point.is_finite();
        if !points.iter().all(|point| near(point.position)) || !surfaces.iter().all(|surface| near(surface.center)) {
            solution.status = Status::NotFinite;
            return &self.solution;
        }
        for (index, ends) in points.windows(2).enumerate() {
            if let [from, to] = ends {
                self.solve_stretch(index, from, to, surfaces);
            }
        }
        &self.solution
    }

    fn solve_stretch(&mut self, stretch: usize, from: &PathPoint, to: &PathPoint, surfaces: &[WrapSurface]) {
        let Self { stretch: solver, solution } = self;
        solver.slots.clear();
        let alone = surfaces.iter().filter(|surface| surface.stretches.contains(&stretch) && given(surface).is_some()).count() == 1;
        for (index, surface) in surfaces.iter().enumerate() {
            let Some(given) = given(surface).filter(|_| surface.stretches.contains(&stretch)) else { continue };
            let [near, far] = [from, to].map(|point| given.placed.to_local(point.position));
            for (end, local) in [near, far].into_iter().enumerate() {
                let depth = yielding::depth(&given.placed.shape, local);
                if depth > 0.0 {
                    solution.inside.push(InsidePoint { point: stretch + end, surface: index, depth });
                }
            }
            let yielding = Yielding::of(&given.placed.shape, given.side, alone, DualVec::constant(near), DualVec::constant(far));
            if yielding.scale.value < VANISHED {
                continue;
            }
            let (placed, side) =
                if yielding == Yielding::NONE { (given.placed, given.side) } else { yielding.changed(&given.placed, given.side) };
            solver.slots.push(Slot::new(index, placed, side, alone && yielding.passes.is_some()));
        }
        let outcome = solver.solve(from.position, to.position);
        if !outcome.converged {
            solution.status = Status::NotConverged;
        }
        solution.path_error = solution.path_error.max(outcome.error);
        solution.steps = solution.steps.max(outcome.steps);
        let arcs = solution.arcs.len();
        let (mut length, mut before) = (0.0, from.position);
        for slot in &solver.slots {
            let (Some(contact), Some(surface)) = (slot.contact, surfaces.get(slot.surface)) else { continue };
            let Some(mut given) = given(surface) else { continue };
            if contact.start.length < 0.0 {
                continue;
            }
            (given.alone, given.yields) = (alone, slot.placed != given.placed);
            let arc = Arc::new(slot.surface, surface.body, contact, slot.placed, given);
            length += before.distance(arc.start) + arc.length;
            before = arc.end;
            solution.arcs.push(arc);
        }
        length += before.distance(to.position);
        solution.length += length;
        solution.stretches.push(Stretch {
            start: from.position,
            start_body: from.body,
            end: to.position,
            end_body: to.body,
            length,
            arcs: arcs..solution.arcs.len(),
        });
    }
}

/// A surface in its place as the caller gives it; `None` where it is inert.
fn given(surface: &WrapSurface) -> Option<Given> {
    let shape = Shape::new(&surface.surface)?;
    let length = surface.rotation.length();
    if !(length > 1e-100 && length < 1e100) {
        return None;
    }
    let rotation = DMat3::from_quat(surface.rotation / length);
    let side = match shape {
        Shape::Torus(_) => None,
        Shape::Cylinder(_) => surface.side.direction().and_then(|side| side.with_z(0.0).try_normalize()),
        Shape::Sphere(_) | Shape::Ellipsoid(_) => surface.side.direction(),
    };
    let half_length = match surface.surface {
        Surface::Cylinder { length, .. } => 0.5 * length,
        _ => f64::INFINITY,
    };
    Some(Given { placed: Placed { shape, rotation, center: surface.center }, side, half_length, alone: false, yields: false })
}
