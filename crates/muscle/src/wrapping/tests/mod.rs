//! Tests of wrapping against closed forms, a slow reference of another kind, and finite differences.

mod closed_forms;
mod geodesics;
mod hostile;
mod moments;
mod opensim;
mod reference;
mod speed;

use glam::{DQuat, DVec3};

use super::{PathPoint, PathSolver, Side, Solution, Surface, WrapSurface};

fn at(body: usize, x: f64, y: f64, z: f64) -> PathPoint {
    PathPoint { body, position: DVec3::new(x, y, z) }
}

/// A surface at the origin, on body 0, that may act everywhere.
fn wrap(surface: Surface, side: Side) -> WrapSurface {
    WrapSurface { surface, body: 0, rotation: DQuat::IDENTITY, center: DVec3::ZERO, side, stretches: 0..usize::MAX }
}

fn solved(points: &[PathPoint], surfaces: &[WrapSurface]) -> Solution {
    PathSolver::new().solve(points, surfaces).clone()
}

/// Numbers from 0 to 1, the same in each run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        ((mixed ^ (mixed >> 33)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn below(&mut self, count: usize) -> usize {
        ((self.next() * count as f64) as usize).min(count - 1)
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let vector = DVec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0));
            if (0.01..1.0).contains(&vector.length()) {
                return vector.normalize();
            }
        }
    }

    fn rotation(&mut self) -> DQuat {
        DQuat::from_axis_angle(self.direction(), self.between(-3.0, 3.0))
    }

    fn side(&mut self) -> Side {
        [Side::PlusX, Side::MinusX, Side::PlusY, Side::MinusY, Side::PlusZ, Side::MinusZ][self.below(6)]
    }
}
