//! The scene posed at one moment: what a renderer or exporter reads.

use std::sync::Arc;

use glam::{DMat4, Mat4, Vec2, Vec3};

use super::{Bounds, Material, MaterialBinding, Mesh, MuscleId, NodeId};

/// Where the vertices of a surface are.
#[derive(Debug, Clone)]
pub enum SurfaceGeometry {
    /// The mesh's own, after this matrix into the world.
    Rigid(Mat4),
    /// Deformed: one position and unit normal for each vertex of the mesh, in the world.
    Deformed {
        /// Positions in the world.
        positions: Vec<Vec3>,
        /// Unit normals in the world.
        normals: Vec<Vec3>,
    },
}

/// How a surface is drawn that only accompanies the scene: the same thing at another moment, or another file that it is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ghost {
    /// Its tint, 0 to 1.
    pub tint: Vec3,
    /// Share of the tint in its colour, 0 to 1.
    pub tint_share: f32,
    /// Opacity, 0 to 1, on top of its material's.
    pub opacity: f32,
    /// Whether its materials are those of the scene that is drawn; else it has the neutral colour under its tint.
    pub materials: bool,
    /// Thousandths of its distance by which it is pushed back in depth, so that it does not cloud a surface of the scene that it nearly lies on.
    pub depth_offset: f32,
}

/// A line drawn over the scene; a dot where both ends are equal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverlayLine {
    /// One end, world, metres.
    pub from: Vec3,
    /// The other.
    pub to: Vec3,
    /// 0 to 1.
    pub color: Vec3,
    /// Opacity, 0 to 1.
    pub opacity: f32,
    /// Logical pixels.
    pub width: f32,
}

/// A procedural texture that a part of a surface is drawn with: fibres along v, at constant u, of the first set of texture coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fibers {
    /// Their colour where the part has no material, `0xRRGGBB`, sRGB; else the material's counts.
    pub color: u32,
    /// What the fibres pass into at both ends, v = 0 and v = 1, `0xRRGGBB`, sRGB; `None` = they stay as they are.
    pub ends: Option<u32>,
}

/// A surface to draw.
#[derive(Debug, Clone)]
pub struct Surface {
    /// The node that it hangs on.
    pub node: NodeId,
    /// Topology, texture coordinates, colours; positions too where it is rigid.
    pub mesh: Arc<Mesh>,
    /// One a part of the mesh.
    pub materials: Arc<[Option<MaterialBinding>]>,
    /// Where it is.
    pub geometry: SurfaceGeometry,
    /// Whether the transform mirrors, so that clockwise is outside.
    pub mirrored: bool,
    /// The muscle that it shows, if it does.
    pub muscle: Option<MuscleId>,
    /// The box round it in the world where it is known to be closed, with its outside outward everywhere; a camera outside of that box cannot see its back faces.
    pub solid: Option<Bounds>,
    /// One a part of the mesh where the surface is made of fibres; else none.
    pub fibers: Arc<[Fibers]>,
    /// Texture coordinates at this moment in place of the first set of the mesh, one a vertex; none = those of the mesh.
    pub coordinates: Vec<Vec2>,
    /// Whether its node is shown.
    pub visible: bool,
    /// Which of its node's contents it shows, so that skin, morph and weights can be found.
    pub content: u32,
    /// Whether it is a mesh that muscles lie beneath.
    pub skin: bool,
    /// How it is drawn if it belongs to a secondary pose. Such a surface cannot be picked; its node and materials need not be the scene's.
    pub ghost: Option<Ghost>,
}

/// A bone to draw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameJoint {
    /// Its node.
    pub node: NodeId,
    /// The joint above it, if any.
    pub parent: Option<NodeId>,
}

/// The scene at one moment. Make it once with [`Frame::default`] and pose into it again and again: its buffers are kept.
#[derive(Debug, Clone, Default)]
pub struct Frame {
    /// World matrix of each node.
    pub world: Vec<DMat4>,
    /// What is drawn.
    pub surfaces: Vec<Surface>,
    /// The bones.
    pub joints: Vec<FrameJoint>,
    /// Materials at this moment, as [`super::Scene::materials`] but with animated values.
    pub materials: Vec<Material>,
    /// Lines drawn over the scene: motion paths, the bones of onion skins.
    pub overlay_lines: Vec<OverlayLine>,
    /// The box round everything visible, in the world; round the joints where there is no surface.
    pub bounds: Bounds,
    /// Changes whenever the list of surfaces, meshes or nodes changes, so that caches made from them can be invalidated.
    pub layout_revision: u64,
    /// Changes whenever the muscles do, which stand behind all other surfaces.
    pub muscle_revision: u64,
}

impl Frame {
    /// Position of a node in the world; the origin for one that isn't there.
    pub fn position(&self, node: NodeId) -> Vec3 {
        self.world.get(node.index()).map_or(Vec3::ZERO, |matrix| matrix.w_axis.truncate().as_vec3())
    }
}

impl Surface {
    /// Whether it is made of fibres. Such a surface is made by the program: it has no skin weights, and the lines of its mesh show how it is made.
    pub fn is_fibrous(&self) -> bool {
        !self.fibers.is_empty()
    }

    /// Texture coordinates of set `set`, one a vertex; none where the mesh has no such set.
    pub fn texture_coordinates(&self, set: usize) -> &[Vec2] {
        if set == 0 && !self.coordinates.is_empty() { &self.coordinates } else { self.mesh.uv_sets.get(set).map_or(&[], Vec::as_slice) }
    }

    /// Position of vertex `v` in the world; NaN where it isn't there.
    pub fn position(&self, v: u32) -> Vec3 {
        match &self.geometry {
            SurfaceGeometry::Rigid(matrix) => self.mesh.positions.get(v as usize).map_or(Vec3::NAN, |p| matrix.transform_point3(*p)),
            SurfaceGeometry::Deformed { positions, .. } => positions.get(v as usize).copied().unwrap_or(Vec3::NAN),
        }
    }
}
