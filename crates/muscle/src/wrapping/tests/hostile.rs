//! Input that nobody means: every answer is a number, and comes.

use glam::{DQuat, DVec3};
use proptest::prelude::*;

use super::super::{PathPoint, PathSolver, Side, Status, Surface, WrapSurface};

/// Lengths from nothing to everything, more often plain ones.
fn length() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => 0.1..3.0,
        2 => prop::sample::select(vec![0.0, -1.0, 1e-12, 1e-6, 1e3, 1e6, 1e12, 1.0]),
        1 => prop::sample::select(vec![f64::NAN, f64::INFINITY, 1e-300, 1e300, f64::MIN_POSITIVE]),
    ]
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => -4.0..4.0,
        3 => prop::sample::select(vec![0.0, 1.0, -1.0, 2.0, 1e-9, 1e9]),
        1 => prop::sample::select(vec![f64::NAN, f64::NEG_INFINITY, 1e200, 1e49, 1e-300]),
    ]
}

fn place() -> impl Strategy<Value = DVec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(DVec3::from_array)
}

fn surface() -> impl Strategy<Value = WrapSurface> {
    let shape = prop_oneof![
        length().prop_map(|radius| Surface::Sphere { radius }),
        [length(), length()].prop_map(|[radius, length]| Surface::Cylinder { radius, length }),
        [length(), length(), length()].prop_map(|radii| Surface::Ellipsoid { radii: radii.into() }),
        [length(), length()].prop_map(|[major, minor]| Surface::Torus { major, minor }),
    ];
    let sides = vec![Side::Either, Side::PlusX, Side::MinusX, Side::PlusY, Side::MinusY, Side::PlusZ, Side::MinusZ];
    (shape, place(), [coordinate(), coordinate(), coordinate(), coordinate()], prop::sample::select(sides), 0..3_usize).prop_map(
        |(surface, center, turn, side, first)| WrapSurface {
            surface,
            body: first,
            rotation: DQuat::from_array(turn),
            center,
            side,
            stretches: first..first + 2,
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn every_path_has_an_answer(places in prop::collection::vec(place(), 0..5), surfaces in prop::collection::vec(surface(), 0..5)) {
        let points: Vec<_> = places.iter().enumerate().map(|(body, place)| PathPoint { body, position: *place }).collect();
        let mut solver = PathSolver::new();
        for _ in 0..2 {
            let solution = solver.solve(&points, &surfaces);
            prop_assert!(solution.length.is_finite() && solution.length >= 0.0);
            prop_assert!(solution.length_rate(|body, point| DVec3::Y * body as f64 + point * 0.1).is_finite());
            let straight: f64 = places.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            prop_assert!(solution.status == Status::NotFinite || solution.length >= straight * (1.0 - 1e-9));
            for arc in solution.arcs() {
                prop_assert!(arc.length >= 0.0 && arc.sample(5).all(|(point, tangent)| point.is_finite() && tangent.is_finite()));
                prop_assert!(arc.start_tangent.is_finite() && arc.end_tangent.is_finite() && arc.start_normal().is_finite());
            }
        }
    }
}

#[test]
fn points_in_one_place_and_at_the_centre_are_a_path() {
    let surfaces: Vec<WrapSurface> = [
        Surface::Sphere { radius: 1.0 },
        Surface::Cylinder { radius: 1.0, length: 1.0 },
        Surface::Ellipsoid { radii: DVec3::new(1.0, 1e-3, 1e3) },
        Surface::Torus { major: 2.0, minor: 1.0 },
    ]
    .map(|surface| super::wrap(surface, Side::PlusX))
    .to_vec();
    let zero = super::at(0, 0.0, 0.0, 0.0);
    for points in
        [vec![zero, zero], vec![zero, super::at(1, 0.0, 0.0, 3.0)], vec![super::at(0, 0.0, 0.0, -3.0), super::at(1, 0.0, 0.0, 3.0)]]
    {
        for surface in &surfaces {
            let solution = super::solved(&points, std::slice::from_ref(surface));
            assert!(solution.length.is_finite() && solution.length < 20.0, "{surface:?}: {}", solution.length);
        }
        assert!(super::solved(&points, &surfaces).length.is_finite());
    }
}

#[test]
fn a_surface_without_a_size_does_not_act() {
    let points = [super::at(0, -2.0, 0.0, 0.0), super::at(0, 2.0, 0.0, 0.0)];
    for surface in [
        Surface::Sphere { radius: 0.0 },
        Surface::Cylinder { radius: f64::NAN, length: 1.0 },
        Surface::Ellipsoid { radii: DVec3::new(1.0, 0.0, 1.0) },
        Surface::Torus { major: 1.0, minor: 1.0 },
    ] {
        let solution = super::solved(&points, &[super::wrap(surface, Side::PlusY)]);
        assert!(solution.length == 4.0 && solution.arcs().is_empty() && solution.status == Status::Converged);
    }
}
