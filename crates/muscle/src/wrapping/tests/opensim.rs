//! Lengths of OpenSim 4.6 (`Scholz2015GeometryPath` with contact geometry as obstacles, in the order given, with a hint on the side of the path), computed
//! with its Python package. It stops at a path error of about 1e-5, so that its lengths are good to 1e-10.

use glam::{DQuat, DVec3, EulerRot};

use super::super::{PathPoint, Side, Status, Surface, WrapSurface};
use super::{at, solved, wrap};

/// A surface with its centre and the angles of its turns about x, y and z, each about the axis as the last has left it.
fn placed(surface: Surface, center: [f64; 3], [x, y, z]: [f64; 3], side: Side) -> WrapSurface {
    WrapSurface { center: center.into(), rotation: DQuat::from_euler(EulerRot::XYZ, x, y, z), ..wrap(surface, side) }
}

fn cylinder(radius: f64) -> Surface {
    Surface::Cylinder { radius, length: 9.0 }
}

fn ellipsoid(x: f64, y: f64, z: f64) -> Surface {
    Surface::Ellipsoid { radii: DVec3::new(x, y, z) }
}

fn agrees(points: [PathPoint; 2], surfaces: &[WrapSurface], opensim: f64) {
    let solution = solved(&points, surfaces);
    assert!(solution.status == Status::Converged && solution.arcs().len() == surfaces.len());
    assert!((solution.length - opensim).abs() < 2e-10, "{} instead of {opensim}", solution.length);
}

#[test]
fn single_surfaces_have_opensims_lengths() {
    let points = [at(0, -3.0, 0.1, 0.2), at(1, 3.0, 0.2, 0.0)];
    agrees(points, &[wrap(Surface::Sphere { radius: 1.0 }, Side::PlusY)], 6.230_698_233_967_45);
    agrees(points, &[placed(ellipsoid(1.0, 0.8, 1.4), [0.0, -0.4, 0.0], [0.1, 0.2, 0.3], Side::PlusY)], 6.026_856_742_063_588);
    let points = [at(0, -3.0, 0.1, 0.2), at(1, 3.0, 0.2, 1.0)];
    agrees(points, &[placed(cylinder(1.0), [0.0; 3], [0.2, 0.1, 0.0], Side::PlusY)], 6.233_250_993_450_427);
    let points = [at(0, 2.5, 0.4, 2.0), at(1, 2.0, -0.5, -2.5)];
    let torus = placed(Surface::Torus { major: 2.0, minor: 0.5 }, [0.0; 3], [0.1, 0.2, 0.0], Side::Either);
    agrees(points, &[torus], 4.877_457_177_986_642);
}

#[test]
fn rows_of_surfaces_have_opensims_lengths() {
    let surfaces = [
        placed(ellipsoid(1.0, 0.8, 1.4), [0.0, -0.4, 0.0], [0.1, 0.2, 0.3], Side::PlusY),
        placed(cylinder(0.7), [3.0, -0.2, 0.0], [0.1, -0.2, 0.0], Side::PlusY),
        placed(Surface::Sphere { radius: 0.9 }, [6.0, -0.5, 0.1], [0.0; 3], Side::PlusY),
    ];
    agrees([at(0, -3.0, 0.1, 0.2), at(1, 9.0, -0.3, 0.0)], &surfaces, 12.101_525_264_762_254);
}

#[test]
fn cylinders_hold_a_path_on_their_side_as_in_opensim() {
    let surface = placed(cylinder(1.0), [0.0; 3], [0.2, 0.1, 0.0], Side::PlusY);
    agrees([at(0, -3.0, -0.4, 0.2), at(1, 3.0, -0.3, 1.0)], &[surface], 6.549_601_255_963_103);
    let surfaces = [
        placed(cylinder(0.9), [0.0, 0.1, 0.0], [0.1, 0.2, 0.3], Side::PlusY),
        placed(cylinder(0.6), [3.0, -0.1, 0.0], [0.1, -0.2, 0.0], Side::MinusY),
        placed(cylinder(0.8), [6.0, 0.1, 0.0], [0.0, 0.1, 0.2], Side::PlusY),
    ];
    agrees([at(0, -3.0, 0.0, 0.3), at(1, 9.0, 0.0, -0.2)], &surfaces, 13.224_636_570_895_523);
}
