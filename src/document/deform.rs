//! Deformed surfaces: morphs first, in the mesh's own space, then the skin into the world.

use glam::{DMat4, Vec3, Vec3A};
use rustc_hash::FxHashMap;

use super::skinning::{Palette, normal_matrix};
use super::{PoseState, Skinning};
use crate::scene::{Bounds, Deformer, Mesh, MeshInstance, Morph, NodeId, Scene, Skin, SkinId, smooth_normals};

/// What bending one instance needs, laid out once.
#[derive(Debug, Clone, Default)]
pub(super) struct Bender {
    palette: Palette,
    /// For morphs without normals: vertices that share point and normal, so that hard edges stay hard.
    groups: Option<(Vec<u32>, usize)>,
    /// The shape after the morphs, where a skin follows; empty where there are none.
    morphed: (Vec<Vec3>, Vec<Vec3>),
}

/// The skin of an instance, if it has one that the scene knows.
pub(super) fn skin_of<'a>(scene: &'a Scene, instance: &'a MeshInstance) -> Option<(&'a Skin, &'a [Option<NodeId>])> {
    instance.deformers.iter().find_map(|deformer| match deformer {
        Deformer::Skin { skin: SkinId(skin), joints } => Some((scene.skins.get(*skin as usize)?, joints.as_slice())),
        Deformer::Morph(_) => None,
    })
}

pub(super) fn morphs_of<'a>(scene: &'a Scene, instance: &'a MeshInstance) -> impl Iterator<Item = (usize, &'a Morph)> {
    instance.deformers.iter().filter_map(|deformer| match deformer {
        Deformer::Morph(id) => Some((id.index(), scene.morphs.get(id.index())?)),
        Deformer::Skin { .. } => None,
    })
}

impl Bender {
    /// Lays out the buffers for `instance` of `mesh`.
    pub(super) fn new(scene: &Scene, instance: &MeshInstance, mesh: &Mesh) -> Self {
        let lacks_normals = |morph: &Morph| morph.targets.iter().any(|target| target.normal_deltas.len() != mesh.positions.len());
        let groups = morphs_of(scene, instance).any(|(_, morph)| lacks_normals(morph)).then(|| groups(mesh));
        Self { groups, ..Self::default() }
    }

    /// Bends the instance on `node` into the buffers and says whether it is mirrored.
    #[allow(clippy::too_many_arguments)]
    pub(super) fn bend(
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
        let Some((skin, joints)) = skin_of(scene, instance) else {
            self.shape(scene, instance, mesh, morph_weights, positions, normals);
            let (matrix, turn) = (here.as_mat4(), normal_matrix(&here));
            for (position, normal) in positions.iter_mut().zip(normals.iter_mut()) {
                *position = matrix.transform_point3(*position);
                *normal = (turn * Vec3A::from(*normal)).normalize_or(Vec3A::Y).into();
            }
            return (Bounds::of(positions.iter().copied()), here.determinant() < 0.0);
        };
        let file = at(root_of(scene, node)).unwrap_or(DMat4::IDENTITY);
        let worlds = joints.iter().map(|joint| joint.and_then(at));
        self.palette.set(skin, worlds, &here, &file, state.skinning == Skinning::DualQuaternion);
        let as_it_is = morphs_of(scene, instance).next().is_none() && mesh.normals.len() == count;
        let (mut p, mut n) = std::mem::take(&mut self.morphed);
        let from = if as_it_is {
            (mesh.positions.as_slice(), mesh.normals.as_slice())
        } else {
            self.shape(scene, instance, mesh, morph_weights, &mut p, &mut n);
            (p.as_slice(), n.as_slice())
        };
        let bounds = self.palette.bend(skin, mesh, from, (positions, normals));
        self.morphed = (p, n);
        (bounds, self.palette.mirrors())
    }

    /// The mesh after its morphs, in its own space.
    fn shape(
        &self,
        scene: &Scene,
        instance: &MeshInstance,
        mesh: &Mesh,
        morph_weights: &[Vec<f32>],
        positions: &mut Vec<Vec3>,
        normals: &mut Vec<Vec3>,
    ) {
        positions.clear();
        positions.extend_from_slice(&mesh.positions);
        normals.clear();
        normals.extend_from_slice(&mesh.normals);
        normals.resize(positions.len(), Vec3::Y);
        for (id, morph) in morphs_of(scene, instance) {
            if let Some(weights) = morph_weights.get(id) {
                self.morph(morph, weights, mesh, positions, normals);
            }
        }
    }

    fn morph(&self, morph: &Morph, weights: &[f32], mesh: &Mesh, positions: &mut [Vec3], normals: &mut Vec<Vec3>) {
        let mut moved = false;
        for (target, weight) in morph.targets.iter().zip(weights) {
            if *weight == 0.0 || !weight.is_finite() {
                continue;
            }
            moved = true;
            for (position, delta) in positions.iter_mut().zip(&target.position_deltas) {
                *position += *delta * *weight;
            }
            for (normal, delta) in normals.iter_mut().zip(&target.normal_deltas) {
                *normal += *delta * *weight;
            }
        }
        match &self.groups {
            _ if !moved => {}
            Some((group, count)) => {
                let of = |vertex: u32| group.get(vertex as usize).copied().unwrap_or(0);
                smooth_normals(positions, &mesh.triangles, of, *count, normals);
            }
            None => normals.iter_mut().for_each(|normal| *normal = normal.normalize_or(Vec3::Y)),
        }
    }
}

/// Numbers the different pairs of point and normal; returns one number a vertex and how many there are.
fn groups(mesh: &Mesh) -> (Vec<u32>, usize) {
    let mut known = FxHashMap::default();
    let group = mesh
        .source_vertex
        .iter()
        .zip(&mesh.normals)
        .map(|(point, normal)| {
            let next = known.len() as u32;
            *known.entry((*point, normal.to_array().map(f32::to_bits))).or_insert(next)
        })
        .collect();
    (group, known.len())
}

/// The uppermost node above `node`: the root of its file.
pub(super) fn root_of(scene: &Scene, mut node: NodeId) -> NodeId {
    while let Some(parent) = scene.graph.node(node).parent() {
        node = parent;
    }
    node
}
