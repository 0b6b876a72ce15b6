//! Deformed surfaces: morphs in the mesh's own space, then the skin into the world, then what is mixed with the skinned shape.

use glam::{DMat4, Vec3, Vec3A};

use super::mix::{ActiveMorph, MorphMixer};
use super::skinning::{SkinDeformer, normal_matrix};
use super::{PoseState, Skinning};
use sinew_scene::{Bounds, Deformer, Mesh, MeshInstance, Morph, NodeId, Scene, Skin, SkinId};

/// What bending one instance needs, laid out once.
#[derive(Debug, Clone, Default)]
pub(super) struct MeshDeformer {
    skin_deformer: SkinDeformer,
    mixer: MorphMixer,
    /// The shape after the morphs, where a skin follows; empty where there are none.
    morphed: (Vec<Vec3>, Vec<Vec3>),
    /// Skins of morph targets, and what they make: those of [`MeshInstance::skinned_targets`], in their order.
    targets: Vec<(SkinDeformer, Vec<Vec3>, Vec<Vec3>)>,
}

/// The skin of an instance, if it has one that the scene knows.
pub(super) fn skin_of<'a>(scene: &'a Scene, instance: &'a MeshInstance) -> Option<(&'a Skin, &'a [Option<NodeId>])> {
    instance.deformers.iter().find_map(|deformer| match deformer {
        Deformer::Skin { skin: SkinId(skin), joints } => Some((scene.skins.get(*skin as usize)?, joints.as_slice())),
        Deformer::Morph(_) => None,
    })
}

/// The morphs of an instance below its skin, and those above it. Without a skin all are above: what they make is placed by the node.
pub(super) fn morphs_of<'a>(scene: &'a Scene, instance: &'a MeshInstance, below: bool) -> impl Iterator<Item = (usize, &'a Morph)> {
    let skin = instance.deformers.iter().position(|deformer| matches!(deformer, Deformer::Skin { .. })).unwrap_or(0);
    let (first, last) = instance.deformers.split_at(skin);
    let found = if below { first } else { last };
    found.iter().filter_map(|deformer| match deformer {
        Deformer::Morph(id) => Some((id.index(), scene.morphs.get(id.index())?)),
        Deformer::Skin { .. } => None,
    })
}

impl MeshDeformer {
    /// Lays out the buffers for `instance` of `mesh`.
    pub(super) fn new(scene: &Scene, instance: &MeshInstance, mesh: &Mesh) -> Self {
        let mut morphs = morphs_of(scene, instance, true).chain(morphs_of(scene, instance, false));
        let lacks_normals = |morph: &Morph| morph.targets.iter().any(|target| target.normal_deltas.len() != mesh.positions.len());
        let smooths = !instance.skinned_targets.is_empty() || morphs.any(|(_, morph)| lacks_normals(morph));
        let targets = instance.skinned_targets.iter().map(|_| Default::default()).collect();
        Self { mixer: MorphMixer::new(mesh, smooths), targets, ..Self::default() }
    }

    /// Bends the instance on `node` into the buffers and says whether it is mirrored.
    #[allow(
        clippy::too_many_arguments,
        reason = "the matrices and buffers of one surface, each borrowed from another part of the document"
    )]
    pub(super) fn deform(
        &mut self,
        scene: &Scene,
        (node, instance): (NodeId, &MeshInstance),
        mesh: &Mesh,
        state: &PoseState,
        world: &[DMat4],
        morph_weights: &[Vec<f32>],
        (positions, normals): (&mut Vec<Vec3>, &mut Vec<Vec3>),
    ) -> (Bounds, bool) {
        let count = mesh.positions.len();
        positions.resize(count, Vec3::ZERO);
        normals.resize(count, Vec3::Y);
        let at = |node: NodeId| world.get(node.index()).copied();
        let here = at(node).unwrap_or(DMat4::IDENTITY);
        let file = at(root_of(scene, node)).unwrap_or(DMat4::IDENTITY);
        let dual = state.skinning == Skinning::DualQuaternion;
        let mut mirrored = here.determinant() < 0.0;
        if let Some((skin, joints)) = skin_of(scene, instance) {
            let last = instance.is_skinned();
            let worlds = joints.iter().map(|joint| joint.and_then(at));
            self.skin_deformer.set(skin, worlds, if last { &here } else { &file }, &file, dual);
            let is_unmorphed = morphs_of(scene, instance, true).next().is_none() && mesh.normals.len() == count;
            let (mut p, mut n) = std::mem::take(&mut self.morphed);
            let from = if is_unmorphed {
                (mesh.positions.as_slice(), mesh.normals.as_slice())
            } else {
                self.shape(scene, instance, mesh, morph_weights, (&mut p, &mut n));
                (p.as_slice(), n.as_slice())
            };
            let bounds = self.skin_deformer.deform(skin, mesh, from, (positions, normals));
            self.morphed = (p, n);
            if last {
                return (bounds, self.skin_deformer.mirrors());
            }
            mirrored ^= self.skin_deformer.mirrors();
            // The targets are where the file's root is, not yet in metres.
            transform_all(&file.inverse(), positions, normals);
        } else {
            copy_rest_shape(mesh, (positions, normals));
        }
        for ((palette, p, n), target) in self.targets.iter_mut().zip(&instance.skinned_targets) {
            let Some(skin) = scene.skins.get(target.skin.index()) else { continue };
            p.resize(count, Vec3::ZERO);
            n.resize(count, Vec3::Y);
            palette.set(skin, target.joints.iter().map(|joint| joint.and_then(at)), &file, &file, dual);
            if target.positions.len() == count && mesh.normals.len() == count {
                palette.deform(skin, mesh, (&target.positions, &mesh.normals), (p, n));
                transform_all(&file.inverse(), p, n);
            }
        }
        for (id, morph) in morphs_of(scene, instance, false) {
            let Some(weights) = morph_weights.get(id) else { continue };
            let given = instance.skinned_targets.iter().zip(&self.targets).filter(|(target, _)| target.morph.index() == id);
            let given = given.map(|(target, (_, positions, _))| (target.target as usize, positions.as_slice()));
            self.mixer.mix(&ActiveMorph { morph, weights, mesh, given }, positions, normals);
        }
        transform_all(&here, positions, normals);
        (Bounds::of(positions.iter().copied()), mirrored)
    }

    /// The mesh after the morphs below its skin, in its own space.
    fn shape(
        &mut self,
        scene: &Scene,
        instance: &MeshInstance,
        mesh: &Mesh,
        morph_weights: &[Vec<f32>],
        (positions, normals): (&mut Vec<Vec3>, &mut Vec<Vec3>),
    ) {
        copy_rest_shape(mesh, (positions, normals));
        for (id, morph) in morphs_of(scene, instance, true) {
            if let Some(weights) = morph_weights.get(id) {
                self.mixer.mix(&ActiveMorph { morph, weights, mesh, given: std::iter::empty() }, positions, normals);
            }
        }
    }
}

/// The mesh as it stands.
fn copy_rest_shape(mesh: &Mesh, (positions, normals): (&mut Vec<Vec3>, &mut Vec<Vec3>)) {
    positions.clear();
    positions.extend_from_slice(&mesh.positions);
    normals.clear();
    normals.extend_from_slice(&mesh.normals);
    normals.resize(positions.len(), Vec3::Y);
}

/// Moves a shape by a matrix.
fn transform_all(by: &DMat4, positions: &mut [Vec3], normals: &mut [Vec3]) {
    let (matrix, turn) = (by.as_mat4(), normal_matrix(by));
    for (position, normal) in positions.iter_mut().zip(normals) {
        *position = matrix.transform_point3(*position);
        *normal = (turn * Vec3A::from(*normal)).normalize_or(Vec3A::Y).into();
    }
}

/// The uppermost node above `node`: the root of its file.
pub(super) fn root_of(scene: &Scene, mut node: NodeId) -> NodeId {
    while let Some(parent) = scene.graph.node(node).parent() {
        node = parent;
    }
    node
}
