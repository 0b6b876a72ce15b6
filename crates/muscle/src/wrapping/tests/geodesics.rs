//! Geodesics by themselves: closed forms, Clairaut's relation, the normal of the curve, Jacobi fields against differences.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use super::super::ellipsoid::Ellipsoid;
use super::super::geodesic::{Accuracy, GeodesicStart};
use super::super::shape::Shape;
use super::super::torus::Torus;
use super::Random;

/// A start at the place of the surface that is nearest to a random point.
fn random_start(shape: &Shape, random: &mut Random, length: f64) -> GeodesicStart {
    let outside = random.direction() * 3.0 + DVec3::Z * random.between(-0.5, 0.5);
    let point = shape.project(outside);
    let tangent = random.direction().reject_from_normalized(shape.normal(point)).normalize();
    GeodesicStart { point, tangent, length }
}

fn shapes() -> [Shape; 8] {
    [
        Shape::Sphere(1.3),
        Shape::Cylinder(0.8),
        Shape::Ellipsoid(Ellipsoid::new(DVec3::new(1.0, 1.5, 2.2))),
        Shape::Ellipsoid(Ellipsoid::new(DVec3::new(2.0, 0.5, 1.0))),
        Shape::Torus(Torus { major: 2.0, minor: 0.7 }),
        Shape::Torus(Torus { major: 1.0, minor: 0.4 }),
        // Drawn out along a slanting direction, halfway and to a cylinder.
        Shape::Ellipsoid(Ellipsoid::drawn_out(DVec3::new(1.0, 1.5, 2.2), DVec3::new(0.6, 0.0, 0.8), 0.5)),
        Shape::Ellipsoid(Ellipsoid::drawn_out(DVec3::new(1.0, 1.5, 2.2), DVec3::new(0.6, 0.0, 0.8), 0.0)),
    ]
}

#[test]
fn an_ellipsoid_of_equal_radii_has_the_great_circles_of_the_sphere() {
    let (sphere, round) = (Shape::Sphere(1.7), Shape::Ellipsoid(Ellipsoid::new(DVec3::splat(1.7))));
    let mut random = Random(1);
    for _ in 0..200 {
        let length = random.between(-6.0, 6.0);
        let start = random_start(&sphere, &mut random, length);
        let (exact, found) = (sphere.shoot(&start), round.shoot(&start));
        assert!(exact.point.distance(found.point) < 2e-12 && exact.tangent.distance(found.tangent) < 2e-12, "{length}");
        for (exact, found) in
            [(exact.shift, found.shift), (exact.shift_rate, found.shift_rate), (exact.turn, found.turn), (exact.turn_rate, found.turn_rate)]
        {
            assert!((exact - found).abs() < 1e-10, "{exact} {found}");
        }
    }
}

#[test]
fn what_is_only_drawn_lies_on_the_surface_and_near_the_geodesic() {
    let mut random = Random(11);
    let mut farthest = 0.0_f64;
    for shape in shapes() {
        for _ in 0..200 {
            let length = random.between(0.0, 2.0);
            let start = random_start(&shape, &mut random, length);
            let (exact, drawn) = (shape.shoot(&start), shape.shoot_within(&start, Accuracy::Drawn));
            assert!(drawn.point.distance(shape.project(drawn.point)) < 1e-14 && (drawn.tangent.length() - 1.0).abs() < 1e-14);
            farthest = farthest.max(exact.point.distance(drawn.point)).max(exact.tangent.distance(drawn.tangent));
        }
    }
    assert!(farthest > 0.0 && farthest < 1e-7, "{farthest:e}");
}

#[test]
fn equators_and_meridians_of_a_torus_close() {
    let torus = Torus { major: 2.0, minor: 0.7 };
    let shape = Shape::Torus(torus);
    for (radius, gauss) in [(2.7, 1.0 / (0.7 * 2.7)), (1.3, -1.0 / (0.7 * 1.3))] {
        let start = GeodesicStart { point: DVec3::X * radius, tangent: DVec3::Y, length: radius * FRAC_PI_2 };
        let end = shape.shoot(&start);
        assert!(end.point.distance(DVec3::Y * radius) < 1e-11, "{:?}", end.point);
        // On an equator K is constant: the Jacobi fields are cos and sin, or cosh and sinh.
        let root = f64::sqrt(f64::abs(gauss));
        let angle = root * start.length;
        let (shift, turn) = if gauss > 0.0 { (angle.cos(), angle.sin() / root) } else { (angle.cosh(), angle.sinh() / root) };
        assert!((end.shift - shift).abs() < 1e-10 * shift.abs().max(1.0) && (end.turn - turn).abs() < 1e-10 * turn.abs().max(1.0));
    }
    let start = GeodesicStart { point: DVec3::X * 1.3, tangent: DVec3::Z, length: TAU * 0.7 };
    assert!(shape.shoot(&start).point.distance(start.point) < 1e-11);
    let half = GeodesicStart { length: PI * 0.7, ..start };
    assert!(shape.shoot(&half).point.distance(DVec3::X * 2.7) < 1e-11);
}

#[test]
fn clairauts_relation_holds_on_surfaces_of_revolution() {
    let mut random = Random(2);
    for shape in [
        Shape::Ellipsoid(Ellipsoid::new(DVec3::new(1.2, 1.2, 2.5))),
        Shape::Ellipsoid(Ellipsoid::new(DVec3::new(2.0, 2.0, 0.6))),
        Shape::Torus(Torus { major: 2.0, minor: 0.7 }),
    ] {
        for _ in 0..100 {
            let length = random.between(0.0, 8.0);
            let start = random_start(&shape, &mut random, length);
            let end = shape.shoot(&start);
            // The distance from the axis times the cosine of the angle to the circle of latitude.
            let clairaut = |point: DVec3, tangent: DVec3| DVec3::Z.cross(point).dot(tangent);
            let (first, last) = (clairaut(start.point, start.tangent), clairaut(end.point, end.tangent));
            assert!((first - last).abs() < 2e-11, "{first} {last} after {length} on {shape:?}");
        }
    }
}

#[test]
fn the_curve_bends_along_the_normal_alone() {
    let mut random = Random(3);
    for shape in shapes() {
        for _ in 0..50 {
            let length = random.between(0.0, 3.0);
            let start = random_start(&shape, &mut random, length);
            let h = 1e-3;
            let [before, here, after] = [-h, 0.0, h].map(|by| shape.shoot(&GeodesicStart { length: length + by, ..start }));
            let bend = (after.tangent - before.tangent) / (2.0 * h);
            let normal = shape.normal(here.point);
            let binormal = here.tangent.cross(normal);
            let sharp = shape.curvature(here.point, here.tangent, binormal).along.abs().max(1.0);
            let near = 2e-5 * sharp.powi(3);
            assert!(bend.dot(binormal).abs() < near && (bend.dot(here.tangent)).abs() < near, "{shape:?}");
            assert!((bend.dot(normal) + shape.curvature(here.point, here.tangent, binormal).along).abs() < near, "{shape:?}");
            assert!((after.point - before.point - here.tangent * 2.0 * h).length() < 1e-7);
            assert!(here.point.distance(shape.project(here.point)) < 1e-14 && (here.tangent.length() - 1.0).abs() < 1e-14);
        }
    }
}

#[test]
fn the_shape_operator_is_the_derivative_of_the_normal() {
    let mut random = Random(4);
    for shape in shapes() {
        for _ in 0..50 {
            let start = random_start(&shape, &mut random, 0.0);
            let (point, tangent) = (start.point, start.tangent);
            let binormal = tangent.cross(shape.normal(point));
            let by = |direction: DVec3| {
                let h = 1e-5;
                let normal = |by: f64| shape.normal(shape.project(point + direction * by));
                (normal(h) - normal(-h)) / (2.0 * h)
            };
            let curvature = shape.curvature(point, tangent, binormal);
            assert!((by(tangent).dot(tangent) - curvature.along).abs() < 1e-7, "{shape:?}");
            assert!((by(tangent).dot(binormal) - curvature.twist).abs() < 1e-7, "{shape:?}");
            assert!((by(binormal).dot(tangent) - curvature.twist).abs() < 1e-7, "{shape:?}");
            assert!((by(binormal).dot(binormal) - curvature.across).abs() < 1e-7, "{shape:?}");
        }
    }
}

#[test]
fn jacobi_fields_are_the_differences_of_neighbouring_geodesics() {
    let mut random = Random(5);
    for shape in shapes() {
        for _ in 0..30 {
            let length = random.between(0.1, 3.0);
            let start = random_start(&shape, &mut random, length);
            let end = shape.shoot(&start);
            let binormal = start.tangent.cross(shape.normal(start.point));
            let end_binormal = end.tangent.cross(shape.normal(end.point));
            let h = 1e-5;
            let turned = |by: f64| shape.shoot(&GeodesicStart { tangent: start.tangent * f64::cos(by) + binormal * f64::sin(by), ..start });
            let turn = (turned(h).point - turned(-h).point) / (2.0 * h);
            assert!((turn - end_binormal * end.turn).length() < 1e-6 * (1.0 + end.turn.abs()), "{shape:?}");
            let shifted = |by: f64| {
                let point = shape.project(start.point + binormal * by);
                let tangent = start.tangent.reject_from_normalized(shape.normal(point)).normalize();
                shape.shoot(&GeodesicStart { point, tangent, length })
            };
            let shift = (shifted(h).point - shifted(-h).point) / (2.0 * h);
            assert!((shift - end_binormal * end.shift).length() < 1e-6 * (1.0 + end.shift.abs() + end.turn.abs()), "{shape:?}");
        }
    }
}
