//! Mesh deformers: skins and morphs, and the mesh instances that use them.

use std::sync::Arc;

use glam::{DMat4, Vec3};

use super::{Label, MaterialBinding, MeshId, MorphId, NodeId, SkinId, Unnamed};

/// A joint of a skin.
#[derive(Debug, Clone, PartialEq)]
pub struct SkinJoint {
    /// The name that the file uses: sid, id or name of a node.
    pub name: String,
    /// Takes a point from the bind pose's world into the joint's space.
    pub inverse_bind: DMat4,
}

/// Weight of one joint for one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Influence {
    /// Index in [`Skin::joints`]; −1 is the bind shape itself, which no joint moves.
    pub joint: i32,
    /// Its weight; the weights of a point add up to 1.
    pub weight: f32,
}

/// A skin: `v' = Σ wᵢ Jᵢ IBMᵢ BSM v` (COLLADA 1.4.1, chapter 4, "Skin deformation (or skinning) in COLLADA").
#[derive(Debug, Clone, Default)]
pub struct Skin {
    /// The name in its file; empty where it has none.
    pub name: String,
    /// The id of the controller in the file.
    pub id: String,
    /// Bind shape matrix: from the mesh into the bind pose's world.
    pub bind_shape: DMat4,
    /// The joints, in the order of the weights.
    pub joints: Vec<SkinJoint>,
    /// First influence of each point of the *file* (see [`super::Mesh::source_vertex`]), and one past the last: length = points + 1.
    pub offsets: Vec<u32>,
    /// All influences, normalised; a point may have any number. One without any stays in its bind shape; only where that is the identity the node that
    /// holds the skin places it, since a bind shape usually is where that node was.
    pub influences: Vec<Influence>,
}

impl Skin {
    /// What it is called.
    pub fn label(&self) -> Label<'_> {
        Label::of(&self.name, Unnamed::Skin)
    }
}

impl Skin {
    /// The influences of file point `point`; none where it is out of range.
    pub fn influences_of(&self, point: usize) -> &[Influence] {
        match (self.offsets.get(point), self.offsets.get(point + 1)) {
            (Some(&from), Some(&to)) => self.influences.get(from as usize..to as usize).unwrap_or(&[]),
            _ => &[],
        }
    }
}

impl Skin {
    /// Whether the bind shape matrix is the identity within the rounding of printed numbers.
    pub fn has_identity_bind_shape(&self) -> bool {
        self.bind_shape.abs_diff_eq(DMat4::IDENTITY, 1e-5)
    }
}

/// How morph targets are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MorphMethod {
    /// `base · (1 − Σw) + Σ w·target`.
    #[default]
    Normalized,
    /// `base + Σ w·target`.
    Relative,
}

/// A shape that a mesh can be drawn towards.
#[derive(Debug, Clone, Default)]
pub struct MorphTarget {
    /// Display name.
    pub name: String,
    /// For each vertex of the base mesh what weight 1 adds to its position, so that both methods are `base + Σ w·delta` over the bare mesh. Over another
    /// deformer a normalised target is `mesh + delta`, and the result is mixed with it.
    pub position_deltas: Vec<Vec3>,
    /// The same for normals; empty where the target has none that fit.
    pub normal_deltas: Vec<Vec3>,
}

/// A morph: targets and their weights at rest.
#[derive(Debug, Clone, Default)]
pub struct Morph {
    /// The name in its file; empty where it has none.
    pub name: String,
    /// The id of the controller in the file.
    pub id: String,
    /// The method that the file names; the deltas already follow it.
    pub method: MorphMethod,
    /// The targets.
    pub targets: Vec<MorphTarget>,
    /// Weights at rest, one a target.
    pub weights: Vec<f32>,
}

impl Morph {
    /// What it is called.
    pub fn label(&self) -> Label<'_> {
        Label::of(&self.name, Unnamed::Morph)
    }
}

/// One step of deformation.
#[derive(Debug, Clone, PartialEq)]
pub enum Deformer {
    /// Morph with the weights of the pose.
    Morph(MorphId),
    /// Skin onto these nodes of the graph.
    Skin {
        /// The skin.
        skin: SkinId,
        /// For each joint of the skin the node that moves it; `None` where the file names one that isn't there (it stays in its bind pose).
        joints: Vec<Option<NodeId>>,
    },
}

/// A morph target that joints of its own place, so that it is another shape in every pose.
#[derive(Debug, Clone, PartialEq)]
pub struct SkinnedTarget {
    /// The morph, one of the instance's deformers.
    pub morph: MorphId,
    /// The place of the target in [`Morph::targets`]; what stands there is its shape in the bind pose.
    pub target: u32,
    /// For each vertex of the base mesh where the target has it before its skin.
    pub positions: Vec<Vec3>,
    /// The skin.
    pub skin: SkinId,
    /// Its joints, as in [`Deformer::Skin`].
    pub joints: Vec<Option<NodeId>>,
}

/// A mesh on a node.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshInstance {
    /// The mesh.
    pub mesh: MeshId,
    /// Applied in order, the first to the mesh itself, at most one of them a skin. What a skin makes is in the world, and where it is the last step the
    /// node's own transform is not applied; a morph above it mixes the skinned shape with its targets in the space of the file's root, and the node's
    /// transform holds for the result.
    pub deformers: Vec<Deformer>,
    /// Targets of these morphs that have skins of their own.
    pub skinned_targets: Vec<SkinnedTarget>,
    /// One a part of the mesh; `None` where the file binds nothing. Instances that bind the same share one list.
    pub materials: Arc<[Option<MaterialBinding>]>,
}

impl MeshInstance {
    /// Whether a skin places it, so that the transform of its node does not.
    pub fn is_skinned(&self) -> bool {
        matches!(self.deformers.last(), Some(Deformer::Skin { .. }))
    }

    /// Whether it can only be told from pose to pose: a morph above a skin, or between skinned shapes.
    pub fn mixes_skins(&self) -> bool {
        let skin = self.deformers.iter().position(|deformer| matches!(deformer, Deformer::Skin { .. }));
        skin.is_some_and(|place| place + 1 < self.deformers.len()) || !self.skinned_targets.is_empty()
    }
}
