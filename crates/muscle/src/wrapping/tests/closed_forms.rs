//! Whole paths whose length is known in closed form, and the general method on surfaces that have one.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat3, DQuat, DVec3};

use super::super::newton::{Contact, Newton, Placed};
use super::super::shape::Shape;
use super::super::{PathPoint, PathSolver, Side, Status, Surface, WrapSurface};
use super::{Random, at, solved, wrap};

/// Length of the path over a sphere from its own formula: both tangents and the great circle between them.
fn over_sphere(radius: f64, from: DVec3, to: DVec3) -> f64 {
    let (p, q) = (from.length(), to.length());
    let between = from.angle_between(to) - (radius / p).acos() - (radius / q).acos();
    if between <= 0.0 { from.distance(to) } else { (p * p - radius * radius).sqrt() + radius * between + (q * q - radius * radius).sqrt() }
}

#[test]
fn a_sphere_is_passed_on_a_great_circle() {
    let mut random = Random(11);
    for _ in 0..500 {
        let radius = random.between(0.3, 1.0);
        let (from, to) = (random.direction() * random.between(1.01, 4.0), random.direction() * random.between(1.01, 4.0));
        let points = [PathPoint { body: 0, position: from }, PathPoint { body: 1, position: to }];
        let solution = solved(&points, &[wrap(Surface::Sphere { radius }, Side::Either)]);
        let exact = over_sphere(radius, from, to);
        assert!((solution.length - exact).abs() < 1e-12 * exact, "{} instead of {exact}", solution.length);
        let near = solved(&points, &[wrap(Surface::Ellipsoid { radii: DVec3::splat(radius) }, Side::Either)]);
        assert!((near.length - exact).abs() < 1e-10 && near.status == Status::Converged, "{} instead of {exact}", near.length);
    }
}

#[test]
fn a_side_takes_the_long_way_round() {
    // In the plane of the centre, a line that passes behind: both tangents and the rest of the circle.
    let points = [at(0, -3.0, -0.5, 0.0), at(1, 3.0, -0.5, 0.0)];
    let p = 3.0_f64.hypot(0.5);
    let angle = PI + 2.0 * f64::atan2(0.5, 3.0) - 2.0 * (1.0 / p).acos();
    let exact = 2.0 * (p * p - 1.0).sqrt() + angle;
    for surface in
        [Surface::Sphere { radius: 1.0 }, Surface::Cylinder { radius: 1.0, length: 1.0 }, Surface::Ellipsoid { radii: DVec3::ONE }]
    {
        let solution = solved(&points, &[wrap(surface, Side::PlusY)]);
        assert!((solution.length - exact).abs() < 1e-12, "{surface:?}: {} instead of {exact}", solution.length);
    }
}

#[test]
fn a_cylinder_is_passed_on_a_helix() {
    let mut random = Random(12);
    let mut tried = 0;
    for _ in 0..500 {
        let radius = random.between(0.3, 0.9);
        let point = |random: &mut Random, angle: f64| {
            let distance = random.between(1.0, 3.0);
            DVec3::new(distance * angle.cos(), distance * angle.sin(), random.between(-2.0, 2.0))
        };
        // Angles from the side: the path never crosses that behind.
        let angles = [random.between(1.4, 2.6), -random.between(1.4, 2.6)];
        let [from, to] = angles.map(|angle| point(&mut random, angle));
        let (p, q) = (from.truncate().length(), to.truncate().length());
        let round = radius * (angles[0] - angles[1] - (radius / p).acos() - (radius / q).acos());
        let flat = (p * p - radius * radius).sqrt() + round + (q * q - radius * radius).sqrt();
        let exact = flat.hypot(to.z - from.z);
        let points = [PathPoint { body: 0, position: from }, PathPoint { body: 1, position: to }];
        let solution = solved(&points, &[wrap(Surface::Cylinder { radius, length: 1.0 }, Side::PlusX)]);
        // Where the line ends within half a radius of its foot, the surface yields.
        let along = (to - from).truncate().normalize();
        if round > 0.0 && from.truncate().dot(along) < -0.5 * radius && to.truncate().dot(along) > 0.5 * radius {
            tried += 1;
            assert!((solution.length - exact).abs() < 1e-12 * exact, "{} instead of {exact}", solution.length);
        }
    }
    assert!(tried > 200, "{tried}");
}

#[test]
fn the_general_method_finds_the_closed_forms_from_afar() {
    let mut random = Random(13);
    for shape in [Shape::Sphere(1.0), Shape::Cylinder(1.0)] {
        for _ in 0..200 {
            let placed = Placed { shape, rotation: DMat3::from_quat(random.rotation()), center: random.direction() };
            let world = |x: f64, y: f64, z: f64| placed.to_world(DVec3::new(x, y, z));
            let from = world(random.between(-3.0, -1.2), random.between(-0.2, 0.9), random.between(-1.0, 1.0));
            let to = world(random.between(1.2, 3.0), random.between(-0.2, 0.9), random.between(-1.0, 1.0));
            let Some(touch) = shape.touch(placed.to_local(from), placed.to_local(to), Some(DVec3::Y), false) else { continue };
            let mut start = touch.start;
            let normal = shape.normal(start.point);
            let binormal = start.tangent.cross(normal);
            start.point =
                shape.project(start.point + (start.tangent * random.between(-1.0, 1.0) + binormal * random.between(-1.0, 1.0)) * 0.2);
            let tangent = start.tangent + binormal * random.between(-0.2, 0.2);
            start.tangent = tangent.reject_from_normalized(shape.normal(start.point)).normalize();
            start.length += random.between(-0.1, 0.3);
            let mut contacts = [Contact::new(&shape, start)];
            let convergence = Newton::with_budget(1000).solve(from, to, &[placed], &mut contacts);
            assert!(convergence.converged, "{convergence:?}");
            let length =
                |point: DVec3, length: f64, end: DVec3| from.distance(placed.to_world(point)) + length + placed.to_world(end).distance(to);
            let found = length(contacts[0].start.point, contacts[0].start.length, contacts[0].end.point);
            let exact = length(touch.start.point, touch.start.length, touch.end);
            assert!((found - exact).abs() < 1e-10, "{found} instead of {exact}");
        }
    }
}

#[test]
fn two_cylinders_with_parallel_axes_are_two_circles() {
    let surface = |x: f64, y: f64, side: Side| WrapSurface {
        center: DVec3::new(x, y, 0.0),
        ..wrap(Surface::Cylinder { radius: 1.0, length: 9.0 }, side)
    };
    // Over one and under the next at the same height: the straight part between them crosses the line of centres halfway.
    let points = [at(0, -4.0, 0.0, 0.0), at(1, 8.0, 0.0, 0.0)];
    let solution = solved(&points, &[surface(0.0, 0.0, Side::PlusY), surface(4.0, 0.0, Side::MinusY)]);
    let tangent = (16.0_f64 - 1.0).sqrt();
    let first = FRAC_PI_2 - (0.25_f64).acos() + FRAC_PI_2 - (0.5_f64).acos();
    let exact = 2.0 * tangent + 2.0 * first + 2.0 * (4.0_f64 - 1.0).sqrt();
    assert!((solution.length - exact).abs() < 1e-12 && solution.status == Status::Converged, "{} instead of {exact}", solution.length);
    // Over both: the straight part is as long as the centres are apart.
    let solution = solved(&points, &[surface(0.0, 0.0, Side::PlusY), surface(4.0, 0.0, Side::PlusY)]);
    let exact = 2.0 * tangent + 2.0 * (FRAC_PI_2 - (0.25_f64).acos()) + 4.0;
    assert!((solution.length - exact).abs() < 1e-12, "{} instead of {exact}", solution.length);
}

#[test]
fn a_torus_holds_a_path_in_its_hole() {
    // In a meridian's plane the tube is a circle of radius 1 about x = 3, passed on its inner side.
    let points = [at(0, 4.0, 0.0, 3.0), at(1, 4.0, 0.0, -3.0)];
    let solution = solved(&points, &[wrap(Surface::Torus { major: 3.0, minor: 1.0 }, Side::Either)]);
    let p = 1.0_f64.hypot(3.0);
    let angle = 2.0 * (PI - f64::atan2(3.0, 1.0) - (1.0 / p).acos());
    let exact = 2.0 * (p * p - 1.0).sqrt() + angle;
    assert!((solution.length - exact).abs() < 1e-11 && solution.status == Status::Converged, "{} instead of {exact}", solution.length);
    // Through the middle of the hole nothing touches.
    let free = solved(&[at(0, 0.5, 0.0, 3.0), at(1, -0.5, 0.3, -3.0)], &[wrap(Surface::Torus { major: 3.0, minor: 1.0 }, Side::Either)]);
    assert!(free.arcs().is_empty());
}

#[test]
fn an_ellipsoid_is_passed_in_its_plane_of_symmetry() {
    // Half an ellipse with radii 2 and 1 and a tangent at either end: the perimeter is 9.688448220547675 (complete elliptic integral of the second kind).
    let points = [at(0, -2.0, -5.0, 0.0), at(1, 2.0, -5.0, 0.0)];
    let surface = wrap(Surface::Ellipsoid { radii: DVec3::new(2.0, 1.0, 1.5) }, Side::PlusY);
    // The ends are moved out by a hair, so that neither tangent is vertical by rounding alone.
    let solution = solved(&points, &[surface]);
    let exact = 10.0 + 0.5 * 9.688_448_220_547_675;
    assert!((solution.length - exact).abs() < 1e-9 && solution.status == Status::Converged, "{} instead of {exact}", solution.length);
}

#[test]
fn a_world_that_is_turned_and_moved_has_the_same_lengths() {
    let mut random = Random(14);
    for _ in 0..50 {
        let surface = wrap(Surface::Ellipsoid { radii: DVec3::new(0.8, 1.0, 1.3) }, random.side());
        let (from, to) = (random.direction() * 3.0, random.direction() * 3.0);
        let path = |turn: DQuat, by: DVec3| {
            let points = [from, to].map(|position| PathPoint { body: 0, position: turn * position + by });
            let moved = WrapSurface { rotation: turn, center: by, ..surface.clone() };
            PathSolver::new().solve(&points, &[moved]).length
        };
        let (turn, by) = (random.rotation(), random.direction() * 5.0);
        assert!((path(DQuat::IDENTITY, DVec3::ZERO) - path(turn, by)).abs() < 1e-11);
    }
}
