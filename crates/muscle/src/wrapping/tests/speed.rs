//! Convergence, and what a solution costs.

use std::hint::black_box;
use std::time::Instant;

use glam::{DMat3, DVec3};

use super::super::ellipsoid::Ellipsoid;
use super::super::newton::{Contact, Newton, Placed};
use super::super::shape::Shape;
use super::super::{PathPoint, PathSolver, Side, Surface, WrapSurface};
use super::{Random, at, wrap};

#[test]
fn newtons_steps_square_the_path_error() {
    let mut random = Random(41);
    let mut squared = 0;
    for _ in 0..100 {
        let surfaces = [0.0, 3.0].map(|x| Placed {
            shape: Shape::Ellipsoid(Ellipsoid::new(DVec3::new(1.0, 0.8, 1.4))),
            rotation: DMat3::from_rotation_z(0.3),
            center: DVec3::new(x, -0.4, 0.0),
        });
        let (from, to) = (DVec3::new(-3.0, random.between(0.0, 0.3), 0.4), DVec3::new(6.0, random.between(0.0, 0.3), -0.3));
        let mut contacts = Vec::new();
        let mut before = from;
        for placed in &surfaces {
            let touch =
                placed.shape.touch(placed.to_local(before), placed.to_local(to), Some(DVec3::Y), false).expect("the line runs into it");
            before = placed.to_world(touch.end);
            contacts.push(Contact::new(&placed.shape, touch.start));
        }
        let convergence = Newton::with_budget(1000).solve(from, to, &surfaces, &mut contacts);
        assert!(convergence.converged && convergence.steps <= 9, "{convergence:?}");
        for pair in convergence.errors[..=convergence.steps].windows(2) {
            // Where a step begins small, and does not end in rounding.
            if pair[0] < 1e-2 && pair[0] > 1e-7 {
                assert!(pair[1] < 50.0 * pair[0] * pair[0] + 1e-13, "{convergence:?}");
                squared += 1;
            }
        }
    }
    assert!(squared > 100, "{squared}");
}

#[test]
#[ignore = "prints times, which is for a quiet machine and a release build"]
fn times_of_solutions() {
    let sphere = Surface::Sphere { radius: 1.0 };
    let cylinder = Surface::Cylinder { radius: 1.0, length: 2.0 };
    let ellipsoid = Surface::Ellipsoid { radii: DVec3::new(1.0, 0.8, 1.4) };
    let torus = Surface::Torus { major: 2.0, minor: 0.5 };
    let row = |shapes: &[Surface], side: Side| -> Vec<WrapSurface> {
        let place =
            |(index, surface): (usize, &Surface)| WrapSurface { center: DVec3::new(3.0 * index as f64, -0.4, 0.0), ..wrap(*surface, side) };
        shapes.iter().enumerate().map(place).collect()
    };
    for (name, surfaces, points) in [
        ("sphere", row(&[sphere], Side::PlusY), [at(0, -3.0, 0.1, 0.2), at(1, 3.0, 0.2, 0.0)]),
        ("cylinder", row(&[cylinder], Side::PlusY), [at(0, -3.0, 0.1, 0.2), at(1, 3.0, 0.2, 0.0)]),
        ("ellipsoid", row(&[ellipsoid], Side::PlusY), [at(0, -3.0, 0.1, 0.2), at(1, 3.0, 0.2, 0.0)]),
        ("ellipsoid, either side", row(&[ellipsoid], Side::Either), [at(0, -3.0, 0.1, 0.2), at(1, 3.0, 0.2, 0.0)]),
        ("torus", vec![wrap(torus, Side::Either)], [at(0, 2.5, 0.4, 2.0), at(1, 2.0, -0.5, -2.5)]),
        ("two cylinders", row(&[cylinder; 2], Side::PlusY), [at(0, -3.0, 0.1, 0.2), at(1, 6.0, 0.2, 0.0)]),
        ("four ellipsoids", row(&[ellipsoid; 4], Side::PlusY), [at(0, -3.0, 0.1, 0.2), at(1, 12.0, 0.2, 0.0)]),
        ("two ellipsoids, either side", row(&[ellipsoid; 2], Side::Either), [at(0, -3.0, 0.1, 0.2), at(1, 6.0, 0.2, 0.0)]),
    ] {
        for kept in [true, false] {
            let mut solver = PathSolver::new();
            let rounds = 2000;
            let mut steps = 0;
            let begin = Instant::now();
            for round in 0..rounds {
                let by = 0.002 * f64::from(round % 50);
                let moved = points.map(|point| PathPoint { position: point.position + DVec3::Y * by, ..point });
                if !kept {
                    solver = PathSolver::new();
                }
                steps += black_box(solver.solve(&moved, &surfaces)).steps;
            }
            let each = begin.elapsed().as_secs_f64() / f64::from(rounds) * 1e6;
            println!(
                "{name:28} {} {each:8.2} µs, {:.1} steps",
                if kept { "buffers kept" } else { "new solver" },
                steps as f64 / f64::from(rounds)
            );
        }
    }
}
