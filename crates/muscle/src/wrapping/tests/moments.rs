//! r = −dL/dq, and a length without jumps, on random paths over random joints.

use glam::{DQuat, DVec3};

use super::super::{PathPoint, PathSolver, Side, Solution, Status, Surface, WrapSurface};
use super::Random;

/// A quarter of a degree.
const STEP: f64 = 0.25 * std::f64::consts::PI / 180.0;

struct Joint { axis: DVec3, center: DVec3 }

/// A path over two or three bodies in a chain along x.
struct Problem { points: Vec<PathPoint>, surfaces: Vec<WrapSurface>, joints: Vec<Joint>, speeds: Vec<f64> }

impl Problem {
    fn random(random: &mut Random, sided: bool) -> Self {
        let bodies = 2 + random.below(2);
        let joints: Vec<Joint> = (1..bodies).map(|body| Joint {
            axis: (DVec3::Z + random.direction() * 0.4).normalize(),
            center: DVec3::new(4.0 * body as f64 - 4.0, 0.0, 0.0) }).collect();
        let speeds = joints.iter().map(|_| random.between(-1.0, 1.0)).collect();
        let mut points = vec![PathPoint { body: 0, position: DVec3::new(-3.5, random.between(0.0, 1.6), random.between(-0.5, 0.5)) }];
        if random.next() < 0.3 {
            points.push(PathPoint { body: 0, position: DVec3::new(-2.2, random.between(0.5, 1.6), random.between(-0.5, 0.5)) });
        }
        points.push(PathPoint { body: bodies - 1, position: DVec3::new(4.0 * bodies as f64 - 4.5, random.between(0.0, 1.6), random.between(-0.5, 0.5)) });
        let count = 1 + random.below(4);
        let last = points.len() - 2;
        let room = 4.0 * (bodies as f64 - 1.0) + 2.0;
        let surfaces = (0..count).map(|index| {
            let x = -1.0 + room * (index as f64 + 0.5) / count as f64 - 0.5;
            let size = (0.8 * room / count as f64).min(1.0) * random.between(0.5, 1.0);
            let tilt = DQuat::from_axis_angle(random.direction(), 0.3);
            let surface = match random.below(3) {
                0 => Surface::Sphere { radius: size },
                1 => Surface::Cylinder { radius: size, length: 2.0 },
                _ => Surface::Ellipsoid { radii: DVec3::new(size, size * random.between(0.5, 1.0), size * random.between(0.7, 2.0)) },
            };
            WrapSurface { surface, body: if x < 2.0 { random.below(2) } else { bodies - 1 - random.below(2) }, rotation: tilt,
                center: DVec3::new(x, random.between(-0.3, 0.3), random.between(-0.3, 0.3)),
                side: if sided { Side::PlusY } else { Side::Either }, stretches: last..last + 1 }
        }).collect();
        Self { points, surfaces, joints, speeds }
    }

    /// Turns the bodies beyond each joint; those further out first, so that axes and centres are the ones at rest.
    fn moved(&self, turn: f64, body: usize, point: DVec3) -> DVec3 {
        let mut point = point;
        for (joint, speed) in self.joints.iter().zip(&self.speeds).take(body).rev() {
            point = joint.center + DQuat::from_axis_angle(joint.axis, turn * speed) * (point - joint.center);
        }
        point
    }

    fn solve<'a>(&self, solver: &'a mut PathSolver, turn: f64) -> &'a Solution {
        let points: Vec<_> = self.points.iter().map(|point| PathPoint { position: self.moved(turn, point.body, point.position), ..*point }).collect();
        let surfaces: Vec<_> = self.surfaces.iter().map(|surface| {
            let mut rotation = surface.rotation;
            for (joint, speed) in self.joints.iter().zip(&self.speeds).take(surface.body).rev() {
                rotation = DQuat::from_axis_angle(joint.axis, turn * speed) * rotation;
            }
            WrapSurface { rotation, center: self.moved(turn, surface.body, surface.center), ..surface.clone() }
        }).collect();
        solver.solve(&points, &surfaces)
    }

    /// Velocity of a point of a body for a turn by 1 radian a second, by the joints' axes as they stand.
    fn velocity(&self, turn: f64, body: usize, point: DVec3) -> DVec3 {
        (0..body.min(self.joints.len())).map(|index| {
            let (joint, speed) = (&self.joints[index], self.speeds[index]);
            let mut axis = joint.axis;
            let mut center = joint.center;
            for (inner, speed) in self.joints.iter().zip(&self.speeds).take(index).rev() {
                let rotation = DQuat::from_axis_angle(inner.axis, turn * speed);
                axis = rotation * axis;
                center = inner.center + rotation * (center - inner.center);
            }
            (axis * speed).cross(point - center)
        }).sum()
    }

    fn rate(&self, solver: &mut PathSolver, turn: f64) -> f64 {
        self.solve(solver, turn).length_rate(|body, point| self.velocity(turn, body, point))
    }
}

#[test]
fn explore() {
    let mut random = Random(21);
    let mut bad = 0; let mut jumps = 0; let mut rates = 0; let mut cold_bad = 0; let mut total = 0;
    for trial in 0..300 {
        let sided = trial % 3 != 0;
        let problem = Problem::random(&mut random, sided);
        let (mut solver, mut probe) = (PathSolver::new(), PathSolver::new());
        let mut before: Option<(f64, f64, bool)> = None;
        for step in -200..=200 {
            let turn = f64::from(step) * STEP * 2.0;
            total += 1;
            let solution = problem.solve(&mut solver, turn);
            let (length, ok, arcs) = (solution.length, solution.status == Status::Converged, solution.arcs().iter().map(|a| a.surface).collect::<Vec<_>>());
            let rate = solution.length_rate(|body, point| problem.velocity(turn, body, point));
            if !ok { bad += 1; if bad < 8 { println!("trial {trial} step {step}: not converged {} {:?}", solution.path_error, problem.surfaces.iter().map(|s| (s.surface, s.side)).collect::<Vec<_>>()); } }
            if let Some((old, old_rate, old_ok)) = before {
                let predicted = 0.5 * (rate + old_rate) * STEP * 2.0;
                let slack = (length - old - predicted).abs();
                if slack > 2e-3 && ok && old_ok { jumps += 1; if jumps < 12 { println!("trial {trial} step {step}: jump {slack:e} arcs {arcs:?} rate {old_rate} -> {rate} sided {sided} {:?}", problem.surfaces.iter().map(|s| (s.surface, s.center)).collect::<Vec<_>>()); } }
            }
            before = Some((length, rate, ok));
            if ok && step % 5 == 0 {
                let mut cold = PathSolver::new();
                let again = problem.solve(&mut cold, turn).length;
                if (again - length).abs() > 1e-10 { cold_bad += 1; if cold_bad < 8 { println!("trial {trial} step {step}: cold {again} warm {length} arcs {arcs:?}"); } }
                let h = 2e-4;
                let l: Vec<f64> = [-2.0, -1.0, 1.0, 2.0].iter().map(|by| problem.solve(&mut probe, turn + by * h).length).collect();
                let difference = (l[0] - 8.0 * l[1] + 8.0 * l[2] - l[3]) / (12.0 * h);
                if (difference - rate).abs() > 1e-6 * rate.abs().max(1.0) { rates += 1; if rates < 12 { println!("trial {trial} step {step}: rate {rate} difference {difference} arcs {arcs:?} sided {sided}"); } }
            }
        }
    }
    println!("total {total} bad {bad} jumps {jumps} rates {rates} cold {cold_bad}");
}
