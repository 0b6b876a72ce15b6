//! A mesh by its points: vertices that stand at the same place are one, whatever their normals and texture coordinates are.

use glam::Vec3;
use rustc_hash::FxHashMap;

/// The shape of a skin at rest.
#[derive(Debug, Clone, Copy)]
pub struct SkinMesh<'a> {
    /// Positions in the world, metres: one a vertex.
    pub positions: &'a [Vec3],
    /// Three vertices a triangle; those that name none are left out.
    pub triangles: &'a [[u32; 3]],
}

/// The points of a mesh and its triangles over them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Points {
    /// The point of each vertex.
    pub(crate) of_vertex: Vec<u32>,
    pub(crate) positions: Vec<Vec3>,
    /// Without those that have no area because two corners are one.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The number of the connected piece that each point belongs to.
    pub(crate) pieces: Vec<u32>,
    pub(crate) piece_count: usize,
}

impl Points {
    pub(crate) fn of(mesh: &SkinMesh<'_>) -> Self {
        let mut points = Self::default();
        let mut known: FxHashMap<[u32; 3], u32> = FxHashMap::default();
        for position in mesh.positions {
            // Both zeros are one.
            let key = (*position + Vec3::ZERO).to_array().map(f32::to_bits);
            let point = *known.entry(key).or_insert_with(|| {
                points.positions.push(*position);
                points.positions.len() as u32 - 1
            });
            points.of_vertex.push(point);
        }
        let point_of = |vertex: u32| points.of_vertex.get(vertex as usize).copied();
        let whole = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(point_of);
            Some([a?, b?, c?]).filter(|[a, b, c]| a != b && b != c && c != a)
        };
        points.triangles = mesh.triangles.iter().filter_map(whole).collect();
        points.find_pieces();
        points
    }

    fn find_pieces(&mut self) {
        let mut above: Vec<u32> = (0..self.positions.len() as u32).collect();
        for [a, b, c] in &self.triangles {
            for other in [b, c] {
                let (one, other) = (root(&mut above, *a), root(&mut above, *other));
                if let Some(parent) = above.get_mut(one.max(other) as usize) {
                    *parent = one.min(other);
                }
            }
        }
        let mut numbers: FxHashMap<u32, u32> = FxHashMap::default();
        for point in 0..self.positions.len() as u32 {
            let next = numbers.len() as u32;
            self.pieces.push(*numbers.entry(root(&mut above, point)).or_insert(next));
        }
        self.piece_count = numbers.len();
    }

    /// Normals of the points, of length 1: means of those of their triangles by area. 0 where there are none.
    pub(crate) fn normals(&self) -> Vec<Vec3> {
        let mut normals = vec![Vec3::ZERO; self.positions.len()];
        add_normals(&self.positions, &self.triangles, &mut normals);
        normals.into_iter().map(Vec3::normalize_or_zero).collect()
    }

    /// The corners of a triangle.
    pub(crate) fn corners(&self, triangle: [u32; 3]) -> Option<[Vec3; 3]> {
        let [a, b, c] = triangle.map(|point| self.positions.get(point as usize).copied());
        Some([a?, b?, c?])
    }
}

/// Adds twice the area vector of each triangle to its corners.
pub(crate) fn add_normals(positions: &[Vec3], triangles: &[[u32; 3]], normals: &mut [Vec3]) {
    for triangle in triangles {
        let [Some(a), Some(b), Some(c)] = triangle.map(|point| positions.get(point as usize)) else { continue };
        let normal = (*b - *a).cross(*c - *a);
        for point in triangle {
            if let Some(sum) = normals.get_mut(*point as usize) {
                *sum += normal;
            }
        }
    }
}

/// The uppermost of a point's chain, which is made shorter on the way.
fn root(above: &mut [u32], mut point: u32) -> u32 {
    while let Some(&parent) = above.get(point as usize).filter(|parent| **parent != point) {
        let grand = above.get(parent as usize).copied().unwrap_or(parent);
        if let Some(slot) = above.get_mut(point as usize) {
            *slot = grand;
        }
        point = grand;
    }
    point
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_at_one_place_are_one_point_and_pieces_are_told_apart() {
        let p = |x: f32| Vec3::new(x, x * x, 0.0);
        let positions = [p(0.0), p(1.0), p(2.0), p(2.0), p(1.0), p(3.0), p(9.0), p(10.0), p(11.0), Vec3::new(-0.0, 0.0, -0.0)];
        let mesh = SkinMesh { positions: &positions, triangles: &[[0, 1, 2], [3, 4, 5], [6, 7, 8], [0, 9, 1], [0, 1, 99]] };
        let points = Points::of(&mesh);
        assert_eq!(points.positions.len(), 7);
        assert_eq!(points.of_vertex, [0, 1, 2, 2, 1, 3, 4, 5, 6, 0]);
        assert_eq!(points.triangles, [[0, 1, 2], [2, 1, 3], [4, 5, 6]]);
        assert_eq!((points.piece_count, points.pieces), (2, vec![0, 0, 0, 0, 1, 1, 1]));
    }
}
