//! Triangle meshes, ready to draw.

use std::ops::Range;

use glam::{Vec2, Vec3, Vec4};

use super::{Bounds, Label, Unnamed};

/// A stretch of a mesh that one material covers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Part {
    /// The material symbol that the file binds; empty where it has none.
    pub symbol: String,
    /// Range in [`Mesh::triangles`].
    pub triangles: Range<u32>,
    /// Range in [`Mesh::lines`].
    pub lines: Range<u32>,
}

/// A mesh. All vertex lists have the same length, or are empty where the file has no such values.
///
/// Vertices are split where position, normal, texture coordinate or colour differ, so the same point of the file may stand here several times:
/// [`Mesh::source_vertex`] says which it was.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// The name in its file; empty where it has none.
    pub name: String,
    /// The id in the file.
    pub id: String,
    /// Positions in the file's own unit and axes.
    pub positions: Vec<Vec3>,
    /// Unit normals; never empty when there are triangles (computed where the file has none).
    pub normals: Vec<Vec3>,
    /// Texture coordinates by set, (0,0) at the *bottom* left, as COLLADA has it.
    pub uv_sets: Vec<Vec<Vec2>>,
    /// Vertex colours, RGBA from 0 to 1; empty where there are none.
    pub colors: Vec<Vec4>,
    /// For each vertex the index of its point in the file.
    pub source_vertex: Vec<u32>,
    /// Number of points in the file.
    pub source_count: u32,
    /// Three vertices a triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Two vertices a line.
    pub lines: Vec<[u32; 2]>,
    /// Which material covers what, in order.
    pub parts: Vec<Part>,
    /// Whether the file says that both sides show.
    pub double_sided: bool,
    /// Whether it is known to be closed as it stands, with its outside outward everywhere.
    pub solid: bool,
}

impl Mesh {
    /// What it is called.
    pub fn label(&self) -> Label<'_> {
        Label::of(&self.name, Unnamed::of_id(&self.id, Unnamed::Mesh))
    }
}

impl Mesh {
    /// The box of the positions.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(self.positions.iter().copied())
    }
}

/// Area-weighted smooth normals of `triangles` over `positions`; vertices with the same `group` share one. Degenerate ones point up.
pub fn smooth_normals(positions: &[Vec3], triangles: &[[u32; 3]], group: impl Fn(u32) -> u32, groups: usize, normals: &mut Vec<Vec3>) {
    let mut sums = vec![Vec3::ZERO; groups];
    for &[a, b, c] in triangles {
        let (Some(&p), Some(&q), Some(&r)) = (positions.get(a as usize), positions.get(b as usize), positions.get(c as usize)) else {
            continue;
        };
        let normal = (q - p).cross(r - p);
        for corner in [a, b, c] {
            if let Some(sum) = sums.get_mut(group(corner) as usize) {
                *sum += normal;
            }
        }
    }
    normals.clear();
    normals.extend((0..positions.len() as u32).map(|v| {
        let sum = sums.get(group(v) as usize).copied().unwrap_or(Vec3::ZERO);
        sum.try_normalize().unwrap_or(Vec3::Y)
    }));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_of_a_flat_square_point_out_of_it() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
        let mut normals = Vec::new();
        smooth_normals(&positions, &[[0, 1, 2], [0, 2, 3]], |v| v, 4, &mut normals);
        assert_eq!(normals, [Vec3::Z; 4]);
    }
}
