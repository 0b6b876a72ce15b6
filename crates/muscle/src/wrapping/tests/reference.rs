//! A slow reference of another kind: a chain of points that is pulled tight outside of the surfaces.

use glam::DVec3;

use super::super::{PathPoint, Side, Status, Surface, WrapSurface};
use super::{at, solved, wrap};

/// The point of the outside of a surface (in its own frame, at the origin) that is nearest to a point.
fn outside(surface: &Surface, point: DVec3) -> DVec3 {
    match *surface {
        Surface::Ellipsoid { radii } => {
            let squares = radii * radii;
            if (point / radii).length() >= 1.0 {
                return point;
            }
            // The foot is x = p a² / (a² + t), with t between −(least a²) and 0 where it lies on the surface.
            let (mut low, mut high) = (-squares.min_element(), 0.0);
            for _ in 0..60 {
                let t = 0.5 * (low + high);
                if (point * radii / (squares + DVec3::splat(t))).length() > 1.0 { low = t } else { high = t }
            }
            point * squares / (squares + DVec3::splat(high))
        }
        Surface::Torus { major, minor } => {
            let ring = point.with_z(0.0).normalize() * major;
            let from_ring = point - ring;
            if from_ring.length() >= minor { point } else { ring + from_ring.normalize() * minor }
        }
        _ => point,
    }
}

/// Length of a chain of `count` links through `start`, which is refined, after it is pulled tight by over-relaxation.
fn tight(surfaces: &[WrapSurface], chain: &mut Vec<DVec3>, count: usize) -> f64 {
    while chain.len() <= count {
        let refined: Vec<DVec3> =
            chain.windows(2).flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1])]).chain(chain.last().copied()).collect();
        *chain = refined;
        // A coarse chain would slip through.
        if chain.len() < 16 {
            continue;
        }
        for sweep in 0..30 * chain.len() {
            let pull = if sweep % 50 == 49 { 1.0 } else { 1.9 };
            for index in 1..chain.len() - 1 {
                let middle = 0.5 * (chain[index - 1] + chain[index + 1]);
                let mut point = chain[index] + (middle - chain[index]) * pull;
                for surface in surfaces {
                    let local = surface.rotation.inverse() * (point - surface.center);
                    point = surface.center + surface.rotation * outside(&surface.surface, local);
                }
                chain[index] = point;
            }
        }
        // The last sweeps do not over-shoot.
        for _ in 0..4 * chain.len() {
            for index in 1..chain.len() - 1 {
                let mut point = 0.5 * (chain[index - 1] + chain[index + 1]);
                for surface in surfaces {
                    let local = surface.rotation.inverse() * (point - surface.center);
                    point = surface.center + surface.rotation * outside(&surface.surface, local);
                }
                chain[index] = point;
            }
        }
    }
    chain.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

fn agree(points: [PathPoint; 2], surfaces: &[WrapSurface], over: &[DVec3]) {
    let solution = solved(&points, surfaces);
    assert!(solution.status == Status::Converged && solution.arcs().len() == surfaces.len(), "{solution:?}");
    let mut chain = vec![points[0].position];
    chain.extend(over);
    chain.push(points[1].position);
    let links = chain.len() - 1;
    let lengths = [32, 64, 128].map(|factor| tight(surfaces, &mut chain, links * factor - 1));
    let errors = lengths.map(|length| solution.length - length);
    // Chords are shorter than arcs by the square of their length: the error falls to a quarter, and what the quarter leaves is far smaller.
    assert!(errors[2].abs() < 0.35 * errors[1].abs() && errors[1].abs() < 0.35 * errors[0].abs(), "{errors:?}");
    let extrapolated = (4.0 * lengths[2] - lengths[1]) / 3.0;
    assert!((extrapolated - solution.length).abs() < 2e-5, "{} and {extrapolated}, {errors:?}", solution.length);
}

#[test]
fn an_ellipsoid_agrees_with_a_chain_pulled_tight() {
    for (radii, side) in [(DVec3::new(1.5, 1.0, 0.7), Side::PlusY), (DVec3::new(0.8, 1.0, 1.7), Side::Either)] {
        let surface = wrap(Surface::Ellipsoid { radii }, side);
        agree([at(0, -3.0, 0.2, 0.3), at(1, 2.5, 0.5, -0.4)], &[surface], &[DVec3::new(0.0, 1.5, 0.0)]);
    }
}

#[test]
fn a_torus_agrees_with_a_chain_pulled_tight() {
    let surface = wrap(Surface::Torus { major: 2.0, minor: 0.6 }, Side::Either);
    agree([at(0, 2.5, 0.4, 2.0), at(1, 2.0, -0.5, -2.5)], &[surface], &[DVec3::new(1.0, 0.0, 0.0)]);
}

#[test]
fn three_surfaces_agree_with_a_chain_pulled_tight() {
    let turned = |surface: Surface, side: Side, x: f64, y: f64| WrapSurface {
        rotation: glam::DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.2),
        center: DVec3::new(x, y, 0.0),
        ..wrap(surface, side)
    };
    let surfaces = [
        turned(Surface::Ellipsoid { radii: DVec3::new(0.8, 0.9, 1.0) }, Side::PlusY, 0.0, -0.4),
        turned(Surface::Ellipsoid { radii: DVec3::new(0.7, 0.6, 0.8) }, Side::MinusY, 3.0, 0.4),
        turned(Surface::Ellipsoid { radii: DVec3::new(1.0, 0.8, 0.9) }, Side::PlusY, 6.0, -0.4),
    ];
    let over = [DVec3::new(0.0, 0.9, 0.1), DVec3::new(3.0, -0.4, 0.1), DVec3::new(6.0, 0.7, 0.0)];
    agree([at(0, -3.0, 0.2, 0.3), at(1, 9.0, 0.1, -0.2)], &surfaces, &over);
}
