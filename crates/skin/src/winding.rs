//! How many times a surface goes round a point: 1 inside of a closed surface, 0 outside, between them where it has holes.
//!
//! Jacobson, Kavan & Sorkine-Hornung 2013, "Robust inside-outside segmentation using generalized winding numbers". Triangles far away are taken together,
//! as in Barill et al. 2018, "Fast winding numbers for soups and clouds", in the cells of one grid.

use std::f64::consts::PI;
use std::ops::Range;

use glam::{DVec3, IVec3, Vec3};

/// Cells along the longest side of the box round the surface.
const CELLS: f64 = 16.0;
/// A cell is far away from a point at this many times its radius.
const FAR: f64 = 3.0;

/// A surface made ready for winding numbers.
#[derive(Debug, Clone, Default)]
pub(crate) struct WindingNumbers {
    triangles: Vec<[DVec3; 3]>,
    cells: Vec<Cell>,
}

#[derive(Debug, Clone)]
struct Cell {
    center: DVec3,
    radius: f64,
    /// Half of the sum of the cross products of two sides.
    area: DVec3,
    triangles: Range<usize>,
}

impl WindingNumbers {
    /// Of these triangles; those with a corner that is no number count for nothing.
    pub(crate) fn of(triangles: impl Iterator<Item = [Vec3; 3]>) -> Self {
        let sound = |corners: &[Vec3; 3]| corners.iter().all(|corner| corner.is_finite());
        let triangles: Vec<[DVec3; 3]> = triangles.filter(sound).map(|corners| corners.map(Vec3::as_dvec3)).collect();
        let low = triangles.iter().flatten().fold(DVec3::INFINITY, |low, corner| low.min(*corner));
        let high = triangles.iter().flatten().fold(DVec3::NEG_INFINITY, |high, corner| high.max(*corner));
        let side = ((high - low).max_element() / CELLS).max(f64::MIN_POSITIVE);
        let middle = |corners: &[DVec3; 3]| (corners[0] + corners[1] + corners[2]) / 3.0;
        let cell_of = |corners: &[DVec3; 3]| ((middle(corners) - low) / side).floor().as_ivec3();
        let mut sorted: Vec<(IVec3, [DVec3; 3])> = triangles.into_iter().map(|corners| (cell_of(&corners), corners)).collect();
        sorted.sort_by_key(|(cell, _)| cell.to_array());
        let mut numbers = Self::default();
        for group in sorted.chunk_by(|a, b| a.0 == b.0) {
            let start = numbers.triangles.len();
            numbers.triangles.extend(group.iter().map(|(_, corners)| *corners));
            let own = numbers.triangles.get(start..).unwrap_or(&[]);
            let center = own.iter().map(middle).sum::<DVec3>() / own.len() as f64;
            let radius = own.iter().flatten().map(|corner| corner.distance(center)).fold(0.0, f64::max);
            let area = own.iter().map(|[a, b, c]| (*b - *a).cross(*c - *a) * 0.5).sum();
            numbers.cells.push(Cell { center, radius, area, triangles: start..start + group.len() });
        }
        numbers
    }

    /// The winding number of a point.
    pub(crate) fn at(&self, point: DVec3) -> f64 {
        let of_cell = |cell: &Cell| {
            let to = cell.center - point;
            let distance = to.length();
            if distance > FAR * cell.radius && distance > 0.0 {
                return cell.area.dot(to) / distance.powi(3);
            }
            let own = self.triangles.get(cell.triangles.clone()).unwrap_or(&[]);
            own.iter().map(|corners| solid_angle(corners.map(|corner| corner - point))).sum()
        };
        self.cells.iter().map(of_cell).sum::<f64>() / (4.0 * PI)
    }
}

/// The solid angle of a triangle seen from the origin, positive where its outside is turned away. van Oosterom & Strackee 1983.
fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let [x, y, z] = [a.length(), b.length(), c.length()];
    2.0 * a.dot(b.cross(c)).atan2(x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball of radius 1 of `rings` rings; without its top third where it is `open`.
    fn ball(rings: u32, open: bool) -> Vec<[Vec3; 3]> {
        let at = |ring: u32, corner: u32| {
            let (polar, round) = (ring as f32 / rings as f32 * std::f32::consts::PI, corner as f32 / rings as f32 * std::f32::consts::TAU);
            Vec3::new(polar.sin() * round.cos(), polar.cos(), -polar.sin() * round.sin())
        };
        let first = if open { rings / 3 } else { 0 };
        let squares = (first..rings).flat_map(|ring| (0..rings).map(move |corner| (ring, corner)));
        squares
            .flat_map(|(r, c)| {
                let [a, b, x, y] = [at(r, c), at(r, c + 1), at(r + 1, c), at(r + 1, c + 1)];
                [[a, x, b], [b, x, y]]
            })
            .collect()
    }

    #[test]
    fn a_closed_surface_goes_round_what_is_inside_once() {
        let numbers = WindingNumbers::of(ball(48, false).into_iter());
        for (point, expected) in
            [(DVec3::ZERO, 1.0), (DVec3::new(0.9, 0.1, 0.0), 1.0), (DVec3::new(1.1, 0.0, 0.0), 0.0), (DVec3::X * 9.0, 0.0)]
        {
            assert!((numbers.at(point) - expected).abs() < 0.02, "{point}: {}", numbers.at(point));
        }
        let turned = WindingNumbers::of(ball(48, false).into_iter().map(|[a, b, c]| [a, c, b]));
        assert!((turned.at(DVec3::ZERO) + 1.0).abs() < 0.02);
    }

    #[test]
    fn an_open_one_goes_round_in_part_and_nothing_goes_round_nothing() {
        let open = WindingNumbers::of(ball(48, true).into_iter());
        // A cap of 60 degrees is a quarter of a sphere.
        assert!((open.at(DVec3::ZERO) - 0.75).abs() < 0.02, "{}", open.at(DVec3::ZERO));
        assert_eq!(WindingNumbers::of([[Vec3::NAN; 3]].into_iter()).at(DVec3::ZERO), 0.0);
    }
}
