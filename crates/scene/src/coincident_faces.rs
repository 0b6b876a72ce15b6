//! Faces that lie on each other with opposite windings: how several exporters write a surface whose two sides look different.
//!
//! Such a face is to be seen from its own side only; from the other one the face that it lies on is. Which faces these are has to be found, since the two
//! may be cut into triangles along other diagonals and belong to other parts of the mesh: a triangle counts if all over it, at seven places, something
//! of the opposite winding lies in its plane. Meshes without such faces, which most are, are told by a glance at the corners.

use std::collections::TryReserveError;

use glam::{DVec3, Vec3};
use rustc_hash::FxHashMap;

use super::Mesh;

/// Cosine between normals from which on they are opposite.
const OPPOSITE_COSINE: f32 = -0.98;
/// Any two normals that are opposite have one whose cosine with a third normal is less.
const SIDE_COSINE: f32 = 0.2;
/// Corners where more triangles meet are looked into only so far; their triangles are found from other corners too.
const MAX_TRIANGLES_PER_CORNER: usize = 64;
/// Most opposite triangles that are looked at for one triangle.
const MAX_CANDIDATES: usize = 160;
/// How far apart two planes may be and still be one, as a share of the triangle's longest side.
const PLANE_TOLERANCE: f64 = 1e-4;
/// Shares of the corners in the places that are asked about: the middle, near the corners, near the middles of the sides.
const SAMPLE_POINTS: [[f64; 3]; 7] = [
    [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
    [0.9, 0.05, 0.05],
    [0.05, 0.9, 0.05],
    [0.05, 0.05, 0.9],
    [0.48, 0.48, 0.04],
    [0.04, 0.48, 0.48],
    [0.48, 0.04, 0.48],
];

/// For each triangle of `mesh` whether triangles of the opposite winding lie on it all over; empty where that is so for none.
///
/// # Errors
/// Where the system gives no memory for the search, which takes some hundred bytes a triangle.
pub fn backed_triangles(mesh: &Mesh) -> Result<Vec<bool>, TryReserveError> {
    if mesh.solid || mesh.triangles.len() < 2 {
        return Ok(Vec::new());
    }
    let welded = Welded { points: weld(&mesh.positions)?, triangles: &mesh.triangles };
    // A triangle without an area has a normal of zero, and so has one whose corners aren't there.
    let normals = collect(mesh.triangles.iter().map(|corners| normal(mesh, *corners).as_vec3()))?;
    let Some(candidate_points) = opposite_normal_points(&welded, &normals)? else { return Ok(Vec::new()) };
    let fans = Fans::new(&welded)?;
    let search = Search { mesh, welded: &welded, normals: &normals, fans: &fans };
    let (mut near, mut seen) = (Vec::new(), Vec::new());
    let is_backed = |t: usize| {
        let may_be = welded.corners(t).is_some_and(|corners| corners.iter().any(|point| candidate_points[*point as usize]));
        may_be && search.is_backed(t, &mut near, &mut seen)
    };
    let backed = collect((0..mesh.triangles.len()).map(is_backed))?;
    Ok(if backed.contains(&true) { backed } else { Vec::new() })
}

/// The elements as a list.
fn collect<T>(elements: impl ExactSizeIterator<Item = T>) -> Result<Vec<T>, TryReserveError> {
    let mut list = Vec::new();
    list.try_reserve_exact(elements.len())?;
    list.extend(elements);
    Ok(list)
}

/// So many of one value.
fn filled<T: Clone>(value: T, count: usize) -> Result<Vec<T>, TryReserveError> {
    let mut list = Vec::new();
    list.try_reserve_exact(count)?;
    list.resize(count, value);
    Ok(list)
}

/// For each vertex the first one at the same place.
fn weld(positions: &[Vec3]) -> Result<Vec<u32>, TryReserveError> {
    let mut first: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    first.try_reserve(positions.len())?;
    // Adding zero makes the negative zero a positive one.
    let place = |position: &Vec3| (*position + 0.0).to_array().map(f32::to_bits);
    let weld = |(vertex, position)| *first.entry(place(position)).or_insert(vertex as u32);
    collect(positions.iter().enumerate().map(weld))
}

/// The triangles of a mesh whose vertices at one place are one point.
struct Welded<'a> {
    points: Vec<u32>,
    triangles: &'a [[u32; 3]],
}

impl Welded<'_> {
    /// The points that a triangle's corners stand at; `None` where one isn't there.
    fn corners(&self, t: usize) -> Option<[u32; 3]> {
        let corners = self.triangles.get(t)?;
        let at = |k: usize| self.points.get(corners[k] as usize).copied();
        Some([at(0)?, at(1)?, at(2)?])
    }

    fn all(&self) -> impl Iterator<Item = (u32, [u32; 3])> {
        (0..self.triangles.len()).filter_map(|t| Some((t as u32, self.corners(t)?)))
    }
}

fn position(mesh: &Mesh, vertex: u32) -> DVec3 {
    mesh.positions.get(vertex as usize).copied().unwrap_or(Vec3::NAN).as_dvec3()
}

/// The unit normal; zero where there is none.
fn normal(mesh: &Mesh, corners: [u32; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|vertex| position(mesh, vertex));
    let normal = (b - a).cross(c - a).normalize_or_zero();
    if normal.is_finite() { normal } else { DVec3::ZERO }
}

/// Which points have triangles that face apart, as those have where a surface lies on its own back; `None` where no point has.
fn opposite_normal_points(welded: &Welded<'_>, normals: &[Vec3]) -> Result<Option<Vec<bool>>, TryReserveError> {
    let mut first = filled(Vec3::ZERO, welded.points.len())?;
    let (mut candidate_points, mut any) = (filled(false, welded.points.len())?, false);
    for (t, corners) in welded.all() {
        let normal = normals[t as usize];
        for point in corners {
            let first = &mut first[point as usize];
            if *first == Vec3::ZERO {
                *first = normal;
            } else if normal != Vec3::ZERO && first.dot(normal) < SIDE_COSINE {
                (candidate_points[point as usize], any) = (true, true);
            }
        }
    }
    Ok(any.then_some(candidate_points))
}

/// The triangles round each point.
struct Fans {
    start: Vec<u32>,
    triangles: Vec<u32>,
}

impl Fans {
    fn new(welded: &Welded<'_>) -> Result<Self, TryReserveError> {
        let points = welded.points.len();
        let mut start = filled(0_u32, points + 1)?;
        welded.all().flat_map(|(_, corners)| corners).for_each(|point| start[point as usize + 1] += 1);
        for point in 0..points {
            start[point + 1] += start[point];
        }
        let mut next = collect(start.iter().copied())?;
        let mut triangles = filled(0, start[points] as usize)?;
        for (t, corners) in welded.all() {
            for point in corners {
                let next = &mut next[point as usize];
                triangles[*next as usize] = t;
                *next += 1;
            }
        }
        Ok(Self { start, triangles })
    }

    fn of(&self, point: u32) -> &[u32] {
        let all = &self.triangles[self.start[point as usize] as usize..self.start[point as usize + 1] as usize];
        &all[..all.len().min(MAX_TRIANGLES_PER_CORNER)]
    }
}

struct Search<'a> {
    mesh: &'a Mesh,
    welded: &'a Welded<'a>,
    normals: &'a [Vec3],
    fans: &'a Fans,
}

impl Search<'_> {
    /// Whether opposite triangles lie on all places of triangle `t`. They are looked for from its corners on, over their own corners.
    fn is_backed(&self, t: usize, near: &mut Vec<u32>, seen: &mut Vec<u32>) -> bool {
        let Some(own) = self.welded.corners(t) else { return false };
        let [a, b, c] = self.mesh.triangles[t].map(|vertex| position(self.mesh, vertex));
        let side = (b - a).length().max((c - b).length()).max((a - c).length());
        let reach = side * PLANE_TOLERANCE + (a.abs().max(b.abs()).max(c.abs())).max_element() * 1e-6;
        let mut open = SAMPLE_POINTS.map(|[x, y, z]| Some(a * x + b * y + c * z));
        near.clear();
        seen.clear();
        self.collect_neighbours(t, &own, near, seen);
        let mut next = 0;
        while let Some(&other) = near.get(next) {
            next += 1;
            for place in &mut open {
                if place.is_some_and(|at| self.contains(other as usize, at, reach)) {
                    *place = None;
                }
            }
            if open.iter().all(Option::is_none) {
                return true;
            }
            if let Some(points) = self.welded.corners(other as usize) {
                self.collect_neighbours(t, &points, near, seen);
            }
        }
        false
    }

    /// Adds the triangles round these points that face the other way than `t`.
    fn collect_neighbours(&self, t: usize, points: &[u32; 3], near: &mut Vec<u32>, seen: &mut Vec<u32>) {
        for point in points {
            if near.len() >= MAX_CANDIDATES {
                return;
            }
            if seen.contains(point) {
                continue;
            }
            seen.push(*point);
            for &other in self.fans.of(*point) {
                let opposite = self.normals[t].dot(self.normals[other as usize]) < OPPOSITE_COSINE;
                if opposite && near.len() < MAX_CANDIDATES && !near.contains(&other) {
                    near.push(other);
                }
            }
        }
    }

    /// Whether a place lies in triangle `t`, at most `reach` beside its plane and its sides.
    fn contains(&self, t: usize, at: DVec3, reach: f64) -> bool {
        let [a, b, c] = self.mesh.triangles[t].map(|vertex| position(self.mesh, vertex));
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let inside = |p: DVec3, q: DVec3| normal.cross(q - p).normalize_or_zero().dot(at - p) >= -reach;
        normal.dot(at - a).abs() <= reach && inside(a, b) && inside(b, c) && inside(c, a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Mesh {
        Mesh { positions: positions.iter().map(|p| Vec3::from_array(*p)).collect(), triangles: triangles.to_vec(), ..Mesh::default() }
    }

    fn backed(mesh: &Mesh) -> Vec<bool> {
        backed_triangles(mesh).expect("there is memory for a few triangles")
    }

    const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.2], [1.0, 1.0, 0.2], [0.0, 1.0, 0.0]];

    #[test]
    fn two_sides_are_found_along_either_diagonal() {
        for back in [[[0, 2, 1], [0, 3, 2]], [[1, 0, 3], [1, 3, 2]]] {
            let triangles = [[0, 1, 2], [0, 2, 3], back[0], back[1]];
            assert_eq!(backed(&mesh(&SQUARE, &triangles)), [true; 4]);
            // With points of its own.
            let twice: Vec<_> = SQUARE.iter().chain(&SQUARE).copied().collect();
            let apart = [[0, 1, 2], [0, 2, 3], back[0].map(|v| v + 4), back[1].map(|v| v + 4)];
            assert_eq!(backed(&mesh(&twice, &apart)), [true; 4]);
        }
    }

    #[test]
    fn polygons_are_found_however_they_are_cut() {
        // A regular polygon as two fans from opposite corners: most triangles share no corner with those that cover them.
        let n = 24;
        let rim = |k: u32| (f64::from(k) / f64::from(n) * std::f64::consts::TAU).sin_cos();
        let positions: Vec<_> = (0..n).map(rim).map(|(y, x)| [x as f32, y as f32, 3.0]).collect();
        let fan = |hub: u32| (1..n - 1).map(move |k| [hub, (hub + k) % n, (hub + k + 1) % n]);
        let triangles: Vec<_> = fan(0).chain(fan(n / 2).map(|[a, b, c]| [a, c, b])).collect();
        assert_eq!(backed(&mesh(&positions, &triangles)), vec![true; triangles.len()]);
    }

    #[test]
    fn other_surfaces_have_no_backs() {
        // The same winding twice; a half of the back; a fold; a gap between the sides; a closed box.
        let twice = [[0, 1, 2], [0, 2, 3], [1, 2, 3], [1, 3, 0]];
        assert!(backed(&mesh(&SQUARE, &twice)).is_empty());
        assert!(backed(&mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3]])).is_empty());
        let half = backed(&mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3], [0, 3, 2]]));
        assert_eq!(half, [false, true, true]);
        let fold = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 0.01]];
        assert!(backed(&mesh(&fold, &[[0, 1, 2], [0, 3, 1]])).is_empty());
        let raised: Vec<_> = SQUARE.iter().copied().chain(SQUARE.map(|[x, y, z]| [x, y, z + 0.01])).collect();
        assert!(backed(&mesh(&raised, &[[4, 5, 6], [4, 6, 7], [0, 2, 1], [0, 3, 2]])).is_empty());
        let corner = |i: u32| [(i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32];
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let cube: Vec<_> = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        let corners: Vec<_> = (0..8).map(corner).collect();
        assert!(backed(&mesh(&corners, &cube)).is_empty());
        let both: Vec<_> = cube.iter().copied().chain(cube.iter().map(|[a, b, c]| [*b, *a, *c])).collect();
        assert_eq!(backed(&mesh(&corners, &both)), vec![true; 24]);
    }

    #[test]
    fn broken_and_crowded_meshes_take_no_time() {
        let broken = mesh(&[[f32::NAN; 3], [f32::INFINITY; 3], [0.0; 3]], &[[0, 1, 2], [0, 2, 1], [7, 8, 9], [2, 2, 2]]);
        assert!(backed(&broken).is_empty());
        assert!(backed(&Mesh::default()).is_empty());
        // A hundred thousand times the same triangle, and as many round one point.
        let same = vec![[0, 1, 2]; 100_000];
        assert!(backed(&mesh(&SQUARE, &same)).is_empty());
        let spokes = 100_000;
        let rim = |k: u32| (f64::from(k) / f64::from(spokes) * 6.0).sin_cos();
        let mut positions: Vec<_> = (0..spokes).map(rim).map(|(y, x)| [x as f32, y as f32, 0.0]).collect();
        positions.push([0.0; 3]);
        let fan = |k: u32| [spokes, k, k + 1];
        let triangles: Vec<_> = (0..spokes - 1).map(fan).chain((0..spokes - 1).map(|k| [spokes, k + 1, k])).collect();
        let found = backed(&mesh(&positions, &triangles));
        assert!(found.iter().filter(|backed| **backed).count() > triangles.len() / 2);
    }
}
