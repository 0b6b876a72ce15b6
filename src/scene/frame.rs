//! The scene posed at one moment: what a renderer or exporter reads.

use std::sync::Arc;

use glam::{DMat4, Mat4, Vec3};

use super::{Bounds, Material, MaterialBinding, Mesh, MuscleId, NodeId};

/// Where the vertices of a surface are.
#[derive(Debug, Clone)]
pub enum Placement {
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
    pub placement: Placement,
    /// Whether the transform mirrors, so that clockwise is outside.
    pub mirrored: bool,
    /// The muscle that it shows, if it does.
    pub muscle: Option<MuscleId>,
    /// Whether its node is shown.
    pub visible: bool,
    /// Which of its node's contents it shows, so that skin, morph and weights can be found.
    pub content: u32,
}

/// A bone to draw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
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
    pub joints: Vec<Joint>,
    /// Materials at this moment, as [`super::Scene::materials`] but with animated values.
    pub materials: Vec<Material>,
    /// The box round everything visible, in the world; round the joints where there is no surface.
    pub bounds: Bounds,
    /// Changes whenever surfaces, meshes or nodes were laid out anew, so that whoever keeps things made from them knows.
    pub stamp: u64,
}

impl Frame {
    /// Position of a node in the world; the origin for one that isn't there.
    pub fn position(&self, node: NodeId) -> Vec3 {
        self.world.get(node.index()).map_or(Vec3::ZERO, |matrix| matrix.w_axis.truncate().as_vec3())
    }
}

impl Surface {
    /// Position of vertex `v` in the world; NaN where it isn't there.
    pub fn position(&self, v: u32) -> Vec3 {
        match &self.placement {
            Placement::Rigid(matrix) => self.mesh.positions.get(v as usize).map_or(Vec3::NAN, |p| matrix.transform_point3(*p)),
            Placement::Deformed { positions, .. } => positions.get(v as usize).copied().unwrap_or(Vec3::NAN),
        }
    }
}
