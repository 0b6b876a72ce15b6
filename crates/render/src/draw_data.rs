//! Data of one frame that the stages share, and the mapping from triangle numbers to corners.

use std::ops::Range;
use std::sync::Arc;

use glam::{Affine2, Vec2, Vec3};

use super::bin_lists::BinLists;
use super::clip::Clipped;
use super::light::Lights;
use super::material_state::{RenderPass, ResolvedMaterial};
use super::projection::{ScreenVertex, ViewTransform};
use super::texture::Texture;
use super::vertex::{Quad, VertexSource};
use sinew_scene::{Frame, SurfaceGeometry};

/// Where an item's geometry comes from.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum GeometrySource {
    /// A stretch of the triangles of a surface of the frame.
    Surface {
        /// Index in [`Frame::surfaces`].
        index: u32,
        /// Triangles of its mesh.
        triangles: Range<u32>,
    },
    /// Bones, made by the renderer.
    Bones,
}

/// Triangles that are drawn alike.
#[derive(Debug, Clone)]
pub(super) struct DrawCall {
    pub source: GeometrySource,
    pub material: ResolvedMaterial,
    /// Leaves out what faces away.
    pub cull: bool,
    /// For each triangle of its mesh whether another one of the opposite winding lies on it, which is seen from the other side in its stead; `None` where
    /// none does. See [`sinew_scene::backed_triangles`].
    pub backed_triangles: Option<Arc<Vec<bool>>>,
    /// Its vertices in the flat arrays.
    pub vertices: Range<usize>,
    /// See [`VertexSource::first`] and [`VertexSource::expanded`].
    pub first_vertex: u32,
    pub expanded: bool,
    /// The numbers of its triangles in the picture.
    pub triangles: Range<u32>,
    /// Index of its first value in the list of computed colours, where its [`ColorSource`](super::color_source::ColorSource) computes them.
    pub computed_colors: Option<usize>,
}

impl DrawCall {
    /// Whether its triangle `t` is culled at this screen area: the area is zero, or the triangle faces away and is not drawn from behind.
    #[inline(always)]
    pub(super) fn culls(&self, t: usize, area: i64) -> bool {
        // Positive is clockwise as seen: the other side, unless the surface is mirrored.
        let away = (area > 0) != self.material.mirrored;
        area == 0 || (away && (self.cull || self.is_backed(t)))
    }

    #[inline(always)]
    fn is_backed(&self, t: usize) -> bool {
        let (Some(backed), GeometrySource::Surface { triangles, .. }) = (&self.backed_triangles, &self.source) else { return false };
        backed.get(triangles.start as usize + t).copied().unwrap_or(false)
    }

    /// Whether it is laid over what is there instead of replacing it.
    pub(super) fn is_blended(&self) -> bool {
        self.material.pass == RenderPass::Blended
    }
}

/// Geometry that the renderer makes itself: positions and normals in the world, colours.
#[derive(Debug, Default)]
pub(super) struct GeneratedMesh {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub colors: Vec<glam::Vec4>,
    pub triangles: Vec<[u32; 3]>,
}

/// The triangles that one worker culls, clips and bins at a time, and what came of it.
#[derive(Debug, Default)]
pub(super) struct WorkUnit {
    /// Numbers of its triangles in the picture.
    pub range: Range<u32>,
    /// Triangle numbers, or [`CLIPPED_FLAG`] and an index in `clipped`, by band.
    pub bins: BinLists,
    pub clipped: Vec<Clipped>,
    /// Blended triangles with their nearness, not yet in bins.
    pub blended: Vec<(f32, u32)>,
    /// Whether there was no memory for some of it.
    pub incomplete: bool,
}

/// Marks an entry that stands for a cut piece.
pub(super) const CLIPPED_FLAG: u32 = 1 << 31;

/// What the stages after the vertex stage share.
pub(super) struct FrameData<'a> {
    pub view: ViewTransform,
    pub lights: Lights,
    pub frame: &'a Frame,
    pub bones: &'a GeneratedMesh,
    pub draw_calls: &'a [DrawCall],
    pub textures: &'a [Texture],
    pub computed_colors: &'a [glam::Vec4],
    pub screen: &'a [ScreenVertex],
    pub front: &'a [Quad],
    pub back: &'a [Quad],
}

/// A triangle that is ready to be filled.
pub(super) struct ClippedTriangle {
    /// Its index in the item.
    pub triangle: usize,
    pub screen: [ScreenVertex; 3],
    pub barycentric: Option<[[f32; 3]; 3]>,
}

/// The geometry of an item.
pub(super) fn geometry<'a>(
    frame: &'a Frame,
    bones: &'a GeneratedMesh,
    computed_colors: &'a [glam::Vec4],
    item: &DrawCall,
) -> VertexSource<'a> {
    let (first, expanded) = (item.first_vertex, item.expanded);
    match &item.source {
        GeometrySource::Surface { index, triangles } => {
            let surface = &frame.surfaces[*index as usize];
            let mesh = &*surface.mesh;
            let (positions, normals, transform) = match &surface.geometry {
                SurfaceGeometry::Rigid(matrix) => (&mesh.positions[..], &mesh.normals[..], Some((*matrix, normal_matrix(matrix)))),
                SurfaceGeometry::Deformed { positions, normals } => (&positions[..], &normals[..], None),
            };
            let triangles = &mesh.triangles[triangles.start as usize..triangles.end as usize];
            let computed_colors = item.computed_colors.and_then(|from| computed_colors.get(from..)).unwrap_or(&[]);
            VertexSource { positions, normals, transform, triangles, colors: &mesh.colors, computed_colors, first, expanded }
        }
        GeometrySource::Bones => VertexSource {
            positions: &bones.positions,
            normals: &bones.normals,
            transform: None,
            triangles: &bones.triangles,
            colors: &bones.colors,
            computed_colors: &[],
            first,
            expanded,
        },
    }
}

/// Takes normals where `matrix` takes points: the inverse transpose, up to a factor, which exists for flat matrices too.
pub(super) fn normal_matrix(matrix: &glam::Mat4) -> glam::Mat3 {
    let m = glam::Mat3::from_mat4(*matrix);
    let cofactors = glam::Mat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    // A mirroring matrix turns the cofactors inside out.
    let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
    let scale = cofactors.x_axis.abs().max(cofactors.y_axis.abs()).max(cofactors.z_axis.abs()).max_element();
    if scale > 0.0 && scale.is_finite() { cofactors * (sign / scale) } else { m }
}

impl<'a> FrameData<'a> {
    /// The draw call that triangle `number` of the picture belongs to.
    pub(super) fn draw_call_of(&self, number: u32) -> Option<&'a DrawCall> {
        let after = self.draw_calls.partition_point(|item| item.triangles.end <= number);
        self.draw_calls.get(after).filter(|item| item.triangles.contains(&number))
    }

    /// What an entry of a bin stands for.
    #[inline(always)]
    pub(super) fn clipped_triangle(item: &DrawCall, reader: &VertexReader<'_>, unit: &WorkUnit, entry: u32) -> Option<ClippedTriangle> {
        let (number, cut) = if entry & CLIPPED_FLAG == 0 {
            (entry, None)
        } else {
            let cut = unit.clipped.get((entry & !CLIPPED_FLAG) as usize)?;
            (cut.triangle, Some(cut))
        };
        let triangle = number.wrapping_sub(item.triangles.start) as usize;
        let part = match cut {
            Some(cut) => ClippedTriangle { triangle, screen: cut.screen, barycentric: Some(cut.barycentric) },
            None => ClippedTriangle { triangle, screen: reader.screen_vertices(triangle)?, barycentric: None },
        };
        Some(part)
    }

    /// The triangle number of an entry.
    #[inline(always)]
    pub(super) fn triangle_number(unit: &WorkUnit, entry: u32) -> u32 {
        if entry & CLIPPED_FLAG == 0 { entry } else { unit.clipped.get((entry & !CLIPPED_FLAG) as usize).map_or(0, |cut| cut.triangle) }
    }

    /// Access to an item's vertices by triangle.
    #[inline(always)]
    pub(super) fn reader(&self, item: &'a DrawCall) -> VertexReader<'a> {
        let geometry = geometry(self.frame, self.bones, self.computed_colors, item);
        let (uv, placing) = match (&item.source, &item.material.diffuse.or(item.material.cutout).or(item.material.emission_texture)) {
            (GeometrySource::Surface { index, .. }, Some(sampler)) => {
                (self.frame.surfaces[*index as usize].texture_coordinates(sampler.uv_set as usize), sampler.uv_transform)
            }
            _ => (&[][..], None),
        };
        let range = item.vertices.clone();
        VertexReader {
            geometry,
            uv,
            uv_transform: placing,
            screen: &self.screen[range.clone()],
            front: &self.front[range.clone()],
            back: &self.back[range],
        }
    }
}

/// An item's vertices, looked up by triangle. Triangles that name vertices which aren't there never get past binning, so what is returned for
/// them does not matter; it must only not panic.
#[derive(Clone, Copy)]
pub(super) struct VertexReader<'a> {
    pub geometry: VertexSource<'a>,
    uv: &'a [Vec2],
    uv_transform: Option<Affine2>,
    screen: &'a [ScreenVertex],
    front: &'a [Quad],
    back: &'a [Quad],
}

impl VertexReader<'_> {
    /// The corners on the screen; `None` where a vertex does not exist.
    #[inline(always)]
    pub(super) fn screen_vertices(&self, t: usize) -> Option<[ScreenVertex; 3]> {
        let at = |k: usize| self.screen.get(self.geometry.item_vertex(t, k)).copied();
        Some([at(0)?, at(1)?, at(2)?])
    }

    /// What the vertex stage made of the corners, on one side of the surface.
    #[inline(always)]
    pub(super) fn lit(&self, t: usize, other_side: bool) -> [Quad; 3] {
        let from = if other_side { self.back } else { self.front };
        // One by one: an array that is filled in a loop goes through memory, and reading it back right after waits for the writes.
        let at = |k: usize| from.get(self.geometry.item_vertex(t, k)).copied().unwrap_or_default();
        [at(0), at(1), at(2)]
    }

    /// Corners in the world. Only where the vertex stage made [`super::material_state::VertexOutput::Geometry`].
    #[inline(always)]
    pub(super) fn positions(&self, t: usize) -> [Vec3; 3] {
        self.lit(t, false).map(|[x, y, z, _]| Vec3::new(x, y, z))
    }

    /// Normals at the corners, as for [`VertexReader::positions`].
    #[inline(always)]
    pub(super) fn normals(&self, t: usize) -> [Vec3; 3] {
        self.lit(t, true).map(|[x, y, z, _]| Vec3::new(x, y, z))
    }

    /// Texture coordinates at the corners.
    #[inline(always)]
    pub(super) fn uvs(&self, t: usize) -> [Vec2; 3] {
        let given = self.geometry.triangles[t].map(|v| self.uv.get(v as usize).copied().unwrap_or_default());
        match &self.uv_transform {
            Some(placing) => given.map(|uv| placing.transform_point2(uv)),
            None => given,
        }
    }

    /// The colour that multiplies the material at corner `k`.
    #[inline(always)]
    pub(super) fn tint(&self, t: usize, k: usize) -> Quad {
        self.geometry.tint(self.geometry.triangles[t][k] as usize).to_array()
    }
}
