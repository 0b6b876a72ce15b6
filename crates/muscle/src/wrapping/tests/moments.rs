//! r = −dL/dq and a length without jumps, on random paths over random joints.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};

use super::super::{PathPoint, PathSolver, Side, Solution, Status, Surface, WrapSurface};
use super::Random;

/// A quarter of a degree.
const STEP: f64 = 0.25 * PI / 180.0;

/// A hinge between a body and the next.
struct Joint {
    axis: DVec3,
    center: DVec3,
    /// Radians that it turns for one of the whole.
    speed: f64,
}

/// A path from the first of two or three bodies in a row along x to the last, over one to four surfaces.
struct Problem {
    points: Vec<PathPoint>,
    surfaces: Vec<WrapSurface>,
    joints: Vec<Joint>,
}

impl Problem {
    fn random(random: &mut Random, side: Side) -> Self {
        let bodies = 2 + random.below(2);
        let joints = (1..bodies).map(|body| Joint {
            axis: (DVec3::Z + random.direction() * 0.4).normalize(),
            center: DVec3::X * (4.0 * body as f64 - 4.0),
            speed: random.between(-1.0, 1.0),
        });
        let joints: Vec<Joint> = joints.collect();
        let mut point = |body: usize, x: f64| {
            let position = DVec3::new(x, random.between(0.2, 1.6), random.between(-0.5, 0.5));
            PathPoint { body, position }
        };
        let mut points = vec![point(0, -3.5), point(0, -2.2), point(bodies - 1, 4.0 * bodies as f64 - 4.5)];
        if random.next() < 0.7 {
            points.remove(1);
        }
        let count = 1 + random.below(4);
        let room = 4.0 * (bodies as f64 - 1.0) + 2.0;
        let last = points.len() - 2;
        let surface = |index: usize| {
            let x = room * (index as f64 + 0.5) / count as f64 - 1.5;
            let size = (0.42 * room / count as f64).min(1.0) * random.between(0.5, 1.0);
            let surface = match random.below(3) {
                0 => Surface::Sphere { radius: size },
                1 => Surface::Cylinder { radius: size, length: 2.0 },
                _ => Surface::Ellipsoid { radii: DVec3::new(1.0, random.between(0.5, 1.0), random.between(0.7, 2.0)) * size },
            };
            WrapSurface {
                surface,
                body: if x < 2.0 { random.below(2) } else { bodies - 1 - random.below(2) },
                rotation: DQuat::from_axis_angle(random.direction(), 0.3),
                center: DVec3::new(x, random.between(-0.3, 0.3), random.between(-0.3, 0.3)),
                side,
                stretches: last..last + 1,
            }
        };
        let surfaces = (0..count).map(surface).collect();
        Self { points, surfaces, joints }
    }

    /// Turns what a body bears. The outer joints turn first, so that axes and centres of all are those at rest.
    fn moved(&self, turn: f64, body: usize, mut point: DVec3) -> DVec3 {
        for joint in self.joints.iter().take(body).rev() {
            point = joint.center + DQuat::from_axis_angle(joint.axis, turn * joint.speed) * (point - joint.center);
        }
        point
    }

    fn turned(&self, turn: f64, body: usize) -> DQuat {
        let joints = self.joints.iter().take(body);
        joints.fold(DQuat::IDENTITY, |turned, joint| turned * DQuat::from_axis_angle(joint.axis, turn * joint.speed))
    }

    fn solve<'a>(&self, solver: &'a mut PathSolver, turn: f64) -> &'a Solution {
        let points = self.points.iter().map(|point| PathPoint { position: self.moved(turn, point.body, point.position), ..*point });
        let surfaces = self.surfaces.iter().map(|surface| WrapSurface {
            rotation: self.turned(turn, surface.body) * surface.rotation,
            center: self.moved(turn, surface.body, surface.center),
            ..surface.clone()
        });
        solver.solve(&points.collect::<Vec<_>>(), &surfaces.collect::<Vec<_>>())
    }

    /// Velocity of a point of a body when `turn` grows by 1 radian a second.
    fn velocity(&self, turn: f64, body: usize, point: DVec3) -> DVec3 {
        let of = |(index, joint): (usize, &Joint)| {
            let axis = self.turned(turn, index) * joint.axis * joint.speed;
            axis.cross(point - self.moved(turn, index, joint.center))
        };
        self.joints.iter().enumerate().take(body).map(of).sum()
    }

    fn rate(&self, solution: &Solution, turn: f64) -> f64 {
        solution.length_rate(|body, point| self.velocity(turn, body, point))
    }

    fn length(&self, turn: f64) -> f64 {
        self.solve(&mut PathSolver::new(), turn).length
    }

    /// The step of the length that is left when a range of turns is halved, each time to the half with the larger change.
    fn jump(&self, mut low: f64, mut high: f64) -> f64 {
        while high - low > 1e-9 {
            let middle = 0.5 * (low + high);
            if (self.length(middle) - self.length(low)).abs() > (self.length(high) - self.length(middle)).abs() {
                high = middle;
            } else {
                low = middle;
            }
        }
        (self.length(high) - self.length(low)).abs()
    }
}

#[test]
fn a_moment_arm_is_the_derivative_of_the_length() {
    let mut random = Random(31);
    let mut acting = 0;
    for trial in 0..100 {
        let problem = Problem::random(&mut random, if trial % 4 == 0 { Side::Either } else { Side::PlusY });
        for _ in 0..6 {
            let turn = random.between(-0.6, 0.6);
            let solution = problem.solve(&mut PathSolver::new(), turn).clone();
            assert_eq!(solution.status, Status::Converged, "trial {trial}, turn {turn}");
            acting += usize::from(!solution.arcs().is_empty());
            let rate = problem.rate(&solution, turn);
            // One of three differences: beside touchdown, where the second derivative jumps, a wide one is not good enough, and a narrow one feels rounding.
            let error = [3e-5, 1e-5, 3e-6].map(|h| ((problem.length(turn + h) - problem.length(turn - h)) / (2.0 * h) - rate).abs());
            let least = error.into_iter().fold(f64::INFINITY, f64::min);
            assert!(least < 1e-6 * rate.abs().max(1.0), "trial {trial}, turn {turn}: {rate} differs by {least}");
        }
    }
    assert!(acting > 250, "{acting}");
}

#[test]
fn a_length_has_no_jumps() {
    let mut random = Random(32);
    let (mut touchdowns, mut solved) = (0, 0);
    for trial in 0..40 {
        let problem = Problem::random(&mut random, Side::PlusY);
        let mut solver = PathSolver::new();
        let mut before: Option<(f64, f64, usize)> = None;
        for step in -100..=100 {
            let turn = f64::from(step) * STEP;
            let solution = problem.solve(&mut solver, turn);
            let (length, arcs, rate) = (solution.length, solution.arcs().len(), problem.rate(solution, turn));
            assert_eq!(solution.status, Status::Converged, "trial {trial}, step {step}");
            solved += 1;
            if let Some((last_length, last_rate, last_arcs)) = before {
                touchdowns += usize::from(arcs != last_arcs);
                let unexplained = (length - last_length - 0.5 * (rate + last_rate) * STEP).abs();
                let curved = (rate - last_rate).abs() * STEP;
                if unexplained > 1e-5 + curved {
                    let jump = problem.jump(turn - STEP, turn);
                    assert!(jump < 1e-7, "trial {trial}, step {step}: {jump}");
                }
            }
            before = Some((length, rate, arcs));
            if step % 10 == 0 {
                assert_eq!(problem.length(turn).to_bits(), length.to_bits(), "trial {trial}, step {step}: what was solved before tells");
            }
        }
    }
    assert!(touchdowns > 20 && solved > 8000, "{touchdowns} {solved}");
}

#[test]
fn length_and_rate_are_continuous_through_touchdown_and_liftoff() {
    // A point passes over the place where the straight line touches; all surfaces that have one.
    for surface in [
        Surface::Sphere { radius: 1.0 },
        Surface::Cylinder { radius: 1.0, length: 2.0 },
        Surface::Ellipsoid { radii: DVec3::new(1.3, 1.0, 0.8) },
    ] {
        let surface = WrapSurface { rotation: DQuat::from_rotation_x(0.2), ..super::wrap(surface, Side::PlusY) };
        let solve = |y: f64| super::solved(&[super::at(1, -3.0, y, 0.2), super::at(0, 3.0, 0.9, -0.1)], std::slice::from_ref(&surface));
        let (mut free, mut wrapped) = (2.0, 0.0);
        while free - wrapped > 1e-12 {
            let middle = 0.5 * (free + wrapped);
            if solve(middle).arcs().is_empty() { free = middle } else { wrapped = middle }
        }
        let up = |body: usize, _: DVec3| if body == 1 { DVec3::Y } else { DVec3::ZERO };
        let (above, below) = (solve(free), solve(wrapped));
        assert!((above.length - below.length).abs() < 1e-11);
        assert!((above.length_rate(up) - below.length_rate(up)).abs() < 1e-6);
        // Just below, the arc is as long as the surface's curvature makes it: a length that grows from 0.
        assert!(solve(wrapped - 1e-4).arcs().first().is_some_and(|arc| arc.length > 0.0 && arc.length < 1e-3));
    }
}

#[test]
fn a_torus_is_touched_and_left_without_a_jump() {
    let torus = super::wrap(Surface::Torus { major: 2.0, minor: 0.5 }, Side::Either);
    let solve = |x: f64| super::solved(&[super::at(1, x, 0.3, 2.0), super::at(0, 1.3, -0.2, -2.5)], std::slice::from_ref(&torus));
    let (mut free, mut wrapped) = (0.0, 3.0);
    while wrapped - free > 1e-12 {
        let middle = 0.5 * (free + wrapped);
        if solve(middle).arcs().is_empty() { free = middle } else { wrapped = middle }
    }
    let aside = |body: usize, _: DVec3| if body == 1 { DVec3::X } else { DVec3::ZERO };
    let (through, round) = (solve(free), solve(wrapped));
    assert!((through.length - round.length).abs() < 1e-10 && (through.length_rate(aside) - round.length_rate(aside)).abs() < 1e-6);
    // From there to outside of the ring, where the straight line would no longer go through the hole.
    let mut before = round;
    for step in 1..=400 {
        let solution = solve(wrapped + f64::from(step) * 0.01);
        let predicted = 0.005 * (solution.length_rate(aside) + before.length_rate(aside));
        assert!(solution.status == Status::Converged && (solution.length - before.length - predicted).abs() < 1e-6);
        before = solution;
    }
}

#[test]
fn the_same_input_gives_the_same_bits() {
    let mut random = Random(33);
    for _ in 0..20 {
        let problem = Problem::random(&mut random, Side::PlusY);
        let run = || {
            let mut solver = PathSolver::new();
            (-10..10).map(|step| problem.solve(&mut solver, f64::from(step) * 0.03).length.to_bits()).collect::<Vec<_>>()
        };
        assert_eq!(run(), run());
    }
}

#[test]
fn an_end_that_enters_a_surface_is_reported_and_does_not_jump() {
    for surface in [
        Surface::Sphere { radius: 1.0 },
        Surface::Cylinder { radius: 1.0, length: 2.0 },
        Surface::Ellipsoid { radii: DVec3::new(1.2, 1.0, 0.9) },
    ] {
        let surface = super::wrap(surface, Side::PlusY);
        let solve = |x: f64| super::solved(&[super::at(0, -3.0, 0.1, 0.1), super::at(1, x, -0.3, 0.2)], std::slice::from_ref(&surface));
        let mut before = solve(2.0).length;
        for step in 1..=15_000 {
            let x = 2.0 - f64::from(step) * 0.0002;
            let solution = solve(x);
            assert_eq!(solution.status, Status::Converged, "{surface:?} at {x}");
            assert!((solution.length - before).abs() < 0.01, "{surface:?} at {x}: {} after {before}", solution.length);
            before = solution.length;
        }
        assert!(solve(1.5).inside().is_empty());
        let inside = solve(0.5);
        assert!(matches!(inside.inside(), [found] if found.point == 1 && found.surface == 0 && found.depth > 0.1), "{:?}", inside.inside());
    }
}

/// The derivative of a length by moving body 1 along a direction, from the solution and by differences.
fn rates(points: &[PathPoint], surfaces: &[WrapSurface], by: DVec3) -> [f64; 2] {
    let length = |h: f64| {
        let place = |body: usize, position: DVec3| if body == 1 { position + by * h } else { position };
        let points: Vec<_> = points.iter().map(|point| PathPoint { position: place(point.body, point.position), ..*point }).collect();
        let moved = |surface: &WrapSurface| WrapSurface { center: place(surface.body, surface.center), ..surface.clone() };
        super::solved(&points, &surfaces.iter().map(moved).collect::<Vec<_>>()).length
    };
    let solution = super::solved(points, surfaces);
    assert_eq!(solution.status, Status::Converged);
    let h = 1e-5;
    [solution.length_rate(|body, _| if body == 1 { by } else { DVec3::ZERO }), (length(h) - length(-h)) / (2.0 * h)]
}

#[test]
fn tori_and_surfaces_that_yield_have_the_right_derivative() {
    let torus =
        WrapSurface { rotation: DQuat::from_rotation_x(0.2), ..super::wrap(Surface::Torus { major: 2.0, minor: 0.5 }, Side::Either) };
    let sphere = WrapSurface { body: 1, center: DVec3::new(2.3, -0.3, -2.0), ..super::wrap(Surface::Sphere { radius: 0.8 }, Side::MinusX) };
    let ellipsoid = super::wrap(Surface::Ellipsoid { radii: DVec3::new(1.0, 0.8, 1.4) }, Side::PlusY);
    let beyond = [super::at(0, 2.6, 0.4, 2.0), super::at(1, 2.8, -0.5, -4.0)];
    let inside = [super::at(0, 2.0, 0.1, 0.3), super::at(1, 2.8, -0.5, -3.0)];
    let behind = [super::at(0, -3.0, -0.3, 0.4), super::at(1, 3.0, -0.2, 0.1)];
    let aside = [super::at(0, -3.0, 0.2, 0.5), super::at(1, 3.0, 0.1, 0.4)];
    let entered = [super::at(0, -3.0, 0.2, 0.5), super::at(1, 0.7, 0.1, 0.4)];
    for (points, surfaces) in [
        (beyond, vec![torus.clone()]),
        (beyond, vec![torus.clone(), sphere]),
        (inside, vec![torus]),
        (behind, vec![ellipsoid.clone()]),
        (aside, vec![ellipsoid.clone()]),
        (entered, vec![ellipsoid]),
    ] {
        assert!(!super::solved(&points, &surfaces).arcs().is_empty());
        for by in DVec3::AXES {
            let [rate, difference] = rates(&points, &surfaces, by);
            assert!((rate - difference).abs() < 1e-7, "{rate} instead of {difference} along {by} for {surfaces:?}");
        }
    }
}

#[test]
fn a_sphere_with_a_side_is_the_sphere_itself_on_that_side_and_a_pulley_straight_behind_it() {
    let mut random = Random(36);
    let sphere = |side| [super::wrap(Surface::Sphere { radius: 1.0 }, side)];
    for _ in 0..200 {
        let (height, offset) = (random.between(1e-3, 1.5), random.between(-1.5, 1.5));
        let points = [super::at(0, -3.0, height, offset), super::at(1, 2.5, height, offset)];
        let [held, free] = [Side::PlusY, Side::Either].map(|side| super::solved(&points, &sphere(side)).length);
        assert!((held - free).abs() < 1e-12, "{height} {offset}: {held} {free}");
    }
    // Behind the sphere, in the plane of its side: the tangents and the arc over the top.
    for height in [-0.1, -0.5, -2.0] {
        let points = [super::at(0, -3.0, height, 0.0), super::at(1, 3.0, height, 0.0)];
        let far = 3.0_f64.hypot(height);
        let arc = PI - 2.0 * ((height / 3.0).atan() + (1.0 / far).acos());
        let exact = 2.0 * (far * far - 1.0).sqrt() + arc;
        assert!((super::solved(&points, &sphere(Side::PlusY)).length - exact).abs() < 1e-12, "{height}");
    }
}

#[test]
fn a_line_that_crosses_to_the_other_side_of_a_sphere_has_no_jump() {
    let mut random = Random(37);
    for _ in 0..100 {
        // Through the centre itself the rate has a jump.
        let aside = if random.next() < 0.5 { -1.0 } else { 1.0 };
        let (from, to) = (aside * random.between(0.1, 0.8), aside * random.between(0.1, 0.8));
        let slope = random.between(0.2, 2.0);
        let solve = |height: f64| {
            let points = [super::at(1, -3.0, height, from), super::at(2, 2.5, height * slope, to)];
            let solution = super::solved(&points, &[super::wrap(Surface::Sphere { radius: 1.0 }, Side::PlusY)]);
            let rate = solution.length_rate(|body, _| DVec3::Y * [0.0, 1.0, slope][body]);
            (solution.length, rate)
        };
        let step = 1e-3;
        let mut before: Option<(f64, f64)> = None;
        for index in -1000..=1000 {
            let (length, rate) = solve(f64::from(index) * step);
            if let Some((last, last_rate)) = before {
                let missed = length - last - 0.5 * (rate + last_rate) * step;
                assert!(missed.abs() < 1e-6 + (rate - last_rate).abs() * step, "{index}: {missed}");
            }
            before = Some((length, rate));
        }
    }
}

#[test]
fn a_path_on_its_side_goes_round_by_more_than_half_a_turn_and_lets_go_without_a_jump() {
    for (surface, aside) in [
        (Surface::Cylinder { radius: 1.0, length: 2.0 }, 0.4),
        (Surface::Sphere { radius: 1.0 }, 0.0),
        (Surface::Sphere { radius: 1.0 }, 0.3),
    ] {
        // One end above the surface, which the path passes on the left; the other turns about it from below, on to the right and up.
        let surface = [super::wrap(surface, Side::MinusX)];
        let solve = |turn: f64| {
            let end = DQuat::from_rotation_z(turn) * DVec3::new(0.0, -2.0, aside);
            let points = [super::at(1, 0.0, 3.0, aside), PathPoint { body: 2, position: end }];
            let solution = super::solved(&points, &surface);
            (solution.length, solution.length_rate(|body, point| if body == 2 { DVec3::Z.cross(point) } else { DVec3::ZERO }))
        };
        let step = 1e-3;
        let mut before = solve(-1.0);
        for index in -999..3600 {
            let turn = f64::from(index) * step;
            let (length, rate) = solve(turn);
            let missed = length - before.0 - 0.5 * (rate + before.1) * step;
            assert!(missed.abs() < 1e-5 + (rate - before.1).abs() * step, "{surface:?} at {turn}: {missed}");
            if aside == 0.0 && (0.0..2.6).contains(&turn) {
                let arc = turn + PI - (1.0_f64 / 3.0).acos() - 0.5_f64.acos();
                let exact = 8.0_f64.sqrt() + 3.0_f64.sqrt() + arc;
                assert!((length - exact).abs() < 1e-9 && (rate - 1.0).abs() < 1e-9, "{turn}: {length} {exact} {rate}");
            }
            before = (length, rate);
        }
    }
}
