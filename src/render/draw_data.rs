//! Data of one frame that the stages share, and the mapping from triangle numbers to corners.

use std::ops::Range;
use std::sync::Arc;

use glam::{Affine2, Vec2, Vec3};

use super::bin_lists::Bins;
use super::clip::Clipped;
use super::light::Lights;
use super::material_state::{RenderPass, ResolvedMaterial};
use super::projection::{ScreenVertex, ViewTransform};
use super::texture::Texture;
use super::vertex::{Geometry, Quad};
use crate::scene::{Frame, SurfaceGeometry};

/// Where an item's geometry comes from.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Source {
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
    pub source: Source,
    pub style: ResolvedMaterial,
    /// Leaves out what faces away.
    pub cull: bool,
    /// For each triangle of its mesh whether another one of the opposite winding lies on it, which is seen from the other side in its stead; `None` where
    /// none does. See [`crate::scene::backed_triangles`].
    pub backed: Option<Arc<[bool]>>,
    /// Its vertices in the flat arrays.
    pub vertices: Range<usize>,
    /// See [`Geometry::first`] and [`Geometry::expanded`].
    pub first_vertex: u32,
    pub expanded: bool,
    /// The numbers of its triangles in the picture.
    pub triangles: Range<u32>,
    /// Whether heat is painted on: index of the first value in the heat list.
    pub heat: Option<usize>,
}

impl DrawCall {
    /// Whether its triangle `t` does not show where its area on the picture is this: it is nothing, or it faces away and is not seen from behind.
    #[inline(always)]
    pub(super) fn hides(&self, t: usize, area: i64) -> bool {
        // Positive is clockwise as seen: the other side, unless the surface is mirrored.
        let away = (area > 0) != self.style.mirrored;
        area == 0 || (away && (self.cull || self.is_backed(t)))
    }

    #[inline(always)]
    fn is_backed(&self, t: usize) -> bool {
        let (Some(backed), Source::Surface { triangles, .. }) = (&self.backed, &self.source) else { return false };
        backed.get(triangles.start as usize + t).copied().unwrap_or(false)
    }

    /// Whether it is laid over what is there instead of replacing it.
    pub(super) fn blended(&self) -> bool {
        self.style.layer == RenderPass::Blended
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
    /// Triangle numbers, or [`CUT`] and an index in `clipped`, by band.
    pub bins: Bins,
    pub clipped: Vec<Clipped>,
    /// Blended triangles with their nearness, not yet in bins.
    pub blended: Vec<(f32, u32)>,
}

/// Marks an entry that stands for a cut piece.
pub(super) const CUT: u32 = 1 << 31;

/// What the stages after the vertex stage share.
pub(super) struct FrameData<'a> {
    pub view: ViewTransform,
    pub lights: Lights,
    pub frame: &'a Frame,
    pub bones: &'a GeneratedMesh,
    pub items: &'a [DrawCall],
    pub textures: &'a [Texture],
    pub heat: &'a [glam::Vec4],
    pub screen: &'a [ScreenVertex],
    pub front: &'a [Quad],
    pub back: &'a [Quad],
}

/// A triangle that is ready to be filled.
pub(super) struct ClippedTriangle {
    /// Its index in the item.
    pub triangle: usize,
    pub screen: [ScreenVertex; 3],
    pub mixture: Option<[[f32; 3]; 3]>,
}

/// The geometry of an item.
pub(super) fn geometry<'a>(frame: &'a Frame, bones: &'a GeneratedMesh, heat: &'a [glam::Vec4], item: &DrawCall) -> Geometry<'a> {
    let (first, expanded) = (item.first_vertex, item.expanded);
    match &item.source {
        Source::Surface { index, triangles } => {
            let surface = &frame.surfaces[*index as usize];
            let mesh = &*surface.mesh;
            let (positions, normals, transform) = match &surface.geometry {
                SurfaceGeometry::Rigid(matrix) => (&mesh.positions[..], &mesh.normals[..], Some((*matrix, normal_matrix(matrix)))),
                SurfaceGeometry::Deformed { positions, normals } => (&positions[..], &normals[..], None),
            };
            let triangles = &mesh.triangles[triangles.start as usize..triangles.end as usize];
            let heat = item.heat.and_then(|from| heat.get(from..)).unwrap_or(&[]);
            Geometry { positions, normals, transform, triangles, colors: &mesh.colors, heat, first, expanded }
        }
        Source::Bones => Geometry {
            positions: &bones.positions,
            normals: &bones.normals,
            transform: None,
            triangles: &bones.triangles,
            colors: &bones.colors,
            heat: &[],
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
    /// The item that triangle `number` of the picture belongs to.
    pub(super) fn item_of(&self, number: u32) -> Option<&'a DrawCall> {
        let after = self.items.partition_point(|item| item.triangles.end <= number);
        self.items.get(after).filter(|item| item.triangles.contains(&number))
    }

    /// What an entry of a bin stands for.
    #[inline(always)]
    pub(super) fn part(item: &DrawCall, reader: &VertexReader<'_>, unit: &WorkUnit, entry: u32) -> Option<ClippedTriangle> {
        let (number, cut) = if entry & CUT == 0 {
            (entry, None)
        } else {
            let cut = unit.clipped.get((entry & !CUT) as usize)?;
            (cut.triangle, Some(cut))
        };
        let triangle = number.wrapping_sub(item.triangles.start) as usize;
        let part = match cut {
            Some(cut) => ClippedTriangle { triangle, screen: cut.screen, mixture: Some(cut.mixture) },
            None => ClippedTriangle { triangle, screen: reader.screens(triangle)?, mixture: None },
        };
        Some(part)
    }

    /// The triangle number of an entry.
    #[inline(always)]
    pub(super) fn number(unit: &WorkUnit, entry: u32) -> u32 {
        if entry & CUT == 0 { entry } else { unit.clipped.get((entry & !CUT) as usize).map_or(0, |cut| cut.triangle) }
    }

    /// Access to an item's vertices by triangle.
    #[inline(always)]
    pub(super) fn reader(&self, item: &'a DrawCall) -> VertexReader<'a> {
        let geometry = geometry(self.frame, self.bones, self.heat, item);
        let (uv, placing) = match (&item.source, &item.style.diffuse.or(item.style.cutout).or(item.style.glow)) {
            (Source::Surface { index, .. }, Some(sampler)) => {
                let set = self.frame.surfaces[*index as usize].mesh.uv_sets.get(sampler.uv_set as usize);
                (set.map_or(&[][..], |set| set), sampler.placing)
            }
            _ => (&[][..], None),
        };
        let range = item.vertices.clone();
        VertexReader {
            geometry,
            uv,
            placing,
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
    pub geometry: Geometry<'a>,
    uv: &'a [Vec2],
    placing: Option<Affine2>,
    screen: &'a [ScreenVertex],
    front: &'a [Quad],
    back: &'a [Quad],
}

impl VertexReader<'_> {
    /// The corners on the picture; `None` where a vertex isn't there.
    #[inline(always)]
    pub(super) fn screens(&self, t: usize) -> Option<[ScreenVertex; 3]> {
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
    pub(super) fn places(&self, t: usize) -> [Vec3; 3] {
        self.lit(t, false).map(|[x, y, z, _]| Vec3::new(x, y, z))
    }

    /// Normals at the corners, as for [`VertexReader::places`].
    #[inline(always)]
    pub(super) fn normals(&self, t: usize) -> [Vec3; 3] {
        self.lit(t, true).map(|[x, y, z, _]| Vec3::new(x, y, z))
    }

    /// Texture coordinates at the corners.
    #[inline(always)]
    pub(super) fn uvs(&self, t: usize) -> [Vec2; 3] {
        let given = self.geometry.triangles[t].map(|v| self.uv.get(v as usize).copied().unwrap_or_default());
        match &self.placing {
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
