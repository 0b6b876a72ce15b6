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
            let size = (0.42 * room / count as f64).min(1.0) * random.between(0.5, 1.0);
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

/// The largest step of the length that is left when a range of turns is halved, each time towards the half that the rate explains less.
fn jump(problem: &Problem, mut low: f64, mut high: f64) -> f64 {
    let length = |turn: f64| problem.solve(&mut PathSolver::new(), turn).length;
    while high - low > 1e-9 {
        let middle = 0.5 * (low + high);
        if (length(middle) - length(low)).abs() > (length(high) - length(middle)).abs() { high = middle } else { low = middle }
    }
    (length(high) - length(low)).abs()
}

#[test]
fn explore() {
    let mut random = Random(21);
    let trials: usize = std::env::var("TRIALS").ok().and_then(|t| t.parse().ok()).unwrap_or(150);
    let range: i32 = std::env::var("RANGE").ok().and_then(|t| t.parse().ok()).unwrap_or(100);
    let only: Option<usize> = std::env::var("ONLY").ok().and_then(|t| t.parse().ok());
    let mut sums = [0usize; 5];
    for trial in 0..trials {
        let sided = trial % 3 != 0;
        let problem = Problem::random(&mut random, sided);
        if only.is_some_and(|o| o != trial) { continue; }
        let mut solver = PathSolver::new();
        let mut probe = PathSolver::new();
        let mut old: Option<(f64, f64, bool)> = None;
        let mut counts = [0usize; 5];
        let mut first: Vec<String> = vec![];
        for step in -range..=range {
            let turn = f64::from(step) * STEP * 2.0;
            counts[4] += 1;
            let warm = problem.solve(&mut solver, turn).clone();
            let ok = warm.status == Status::Converged;
            let rate = warm.length_rate(|body, point| problem.velocity(turn, body, point));
            if !ok { counts[0] += 1; if only.is_some() && counts[0] < 4 { println!("trial step {step} err {:.1e} inside {:?} arcs {:?}", warm.path_error, warm.inside(), warm.arcs().iter().map(|a| format!("{} {:.3} {:.2}->{:.2}", a.surface, a.length, a.start, a.end)).collect::<Vec<_>>()); for st in warm.stretches() { println!("trial   from {:.2} to {:.2}", st.start, st.end); } for s in &problem.surfaces { let c = problem.moved(turn, s.body, s.center); println!("trial   {:.2?} {c:.2} body {}", s.surface, s.body); } } }
            if let Some((l, r, o)) = old {
                let jump = (warm.length - l - 0.5 * (r + rate) * 2.0 * STEP).abs();
                if jump > 1e-4 + (rate - r).abs() * STEP * 2.0 && self::jump(&problem, turn - 2.0 * STEP, turn) > 1e-7 { counts[1] += 1; if first.len() < 3 || only.is_some() { first.push(format!("step {step} jump {jump:.1e} ok {o} {ok} rates {r:.3} {rate:.3}")); } }
            }
            if only.is_some() && std::env::var("AT").is_ok_and(|at| (at.parse::<i32>().unwrap() - step).abs() < 2) { println!("trial at {step} L {} {:?}", warm.length, warm.arcs().iter().map(|a| format!("{} {:.4} {:.3}->{:.3} {}", a.surface, a.length, a.start, a.end, a.changes())).collect::<Vec<_>>()); }
            old = Some((warm.length, rate, ok));
            if ok && step % 5 == 0 {
                let mut c = PathSolver::new();
                let cold = problem.solve(&mut c, turn).clone();
                if (cold.length - warm.length).abs() > 1e-10 { counts[2] += 1; if first.len() < 3 || only.is_some() { first.push(format!("step {step} warm {} cold {} {:?}", warm.length, cold.length, cold.status)); } }
                let h = 1e-4;
                let l: Vec<f64> = [-1.0, 1.0].iter().map(|by| problem.solve(&mut probe, turn + by * h).length).collect();
                let difference = (l[1] - l[0]) / (2.0 * h);
                if (difference - rate).abs() > 3e-5 { counts[3] += 1; if first.len() < 3 || only.is_some() { first.push(format!("step {step} rate {rate} fd {difference}")); } }
            }
        }
        for (sum, count) in sums.iter_mut().zip(counts) { *sum += count; }
        if counts[..4].iter().any(|c| *c > 0) || only.is_some() {
            let kinds: Vec<&str> = problem.surfaces.iter().map(|s| match s.surface { Surface::Sphere { .. } => "S", Surface::Cylinder { .. } => "C", _ => "E" }).collect();
            println!("trial {trial} sided {sided} {kinds:?} bad {} jumps {} cold {} rates {} :: {first:?}", counts[0], counts[1], counts[2], counts[3]);
        }
    }
    println!("bad jumps cold rates total {sums:?}");
}
