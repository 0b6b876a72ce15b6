//! Meshes with their skins and morphs.

use glam::{DMat4, Vec3};
use rustc_hash::FxHashMap;
use serde_json::{Value, json};

use super::buffer::{Buffer, ENTRY, Usage};
use super::materials::GltfMaterials;
use super::unsupported_features::UnsupportedFeature;
use sinew_scene::{Deformer, MaterialBinding, Mesh, MeshId, MeshInstance, Morph, MorphId, NodeId, Scene, Skin, SkinId, backed_triangles};

/// Vertex attributes by name.
type GltfAttributes = serde_json::Map<String, Value>;

/// What is written of meshes and skins.
#[derive(Debug, Default)]
pub(super) struct Surfaces {
    pub meshes: Vec<Value>,
    pub skins: Vec<Value>,
    shapes: FxHashMap<MeshId, GltfAttributes>,
    bindings: FxHashMap<(MeshId, SkinId), GltfAttributes>,
    /// Which triangles of a mesh lie on others of the opposite winding.
    backed: FxHashMap<MeshId, Vec<bool>>,
    targets: FxHashMap<(MeshId, MorphId), Vec<Value>>,
    indices: FxHashMap<MeshId, IndexAccessors>,
    /// The accessor of the matrices that each mesh was last bound with.
    matrices: FxHashMap<(MeshId, SkinId), BindMatrices>,
    /// The number of each mesh that was written; `None` where nothing of it can be drawn.
    written: FxHashMap<MeshKey, Option<usize>>,
    /// Whether the system gave no memory for something, so that what is written is of no use.
    pub out_of_memory: bool,
}

/// Which triangles of a mesh lie on others of the opposite winding.
fn backed(mesh: &Mesh, out_of_memory: &mut bool) -> Vec<bool> {
    backed_triangles(mesh).unwrap_or_else(|_| {
        *out_of_memory = true;
        Vec::new()
    })
}

/// Inverse bind matrices of a skin, and the accessor that holds them.
type BindMatrices = (Vec<[f32; 16]>, usize);

/// Accessors of the indices of a mesh: by part, mode, whether corners are turned round, and whether both sides are seen.
pub(super) type IndexAccessors = FxHashMap<(usize, u32, bool, bool), usize>;

/// What makes an instance look as it does. Instances that look alike are one mesh of the file on several nodes.
#[derive(Debug, PartialEq, Eq, Hash)]
struct MeshKey {
    mesh: MeshId,
    /// Skins and morphs in their order.
    deformers: Vec<(Option<SkinId>, Option<MorphId>)>,
    /// The address of the list that instances with the same materials share.
    materials: *const Option<MaterialBinding>,
    mirrored: bool,
}

impl MeshKey {
    fn of(instance: &MeshInstance, mirrored: bool) -> Self {
        let deformer = |deformer: &Deformer| match deformer {
            Deformer::Skin { skin, .. } => (Some(*skin), None),
            Deformer::Morph(morph) => (None, Some(*morph)),
        };
        let deformers = instance.deformers.iter().map(deformer).collect();
        Self { mesh: instance.mesh, deformers, materials: instance.materials.as_ptr(), mirrored }
    }
}

/// A joint of a skin as it is written: a node, and the matrix that takes the mesh into its space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SkinBone {
    /// The node, or the one that an extra node without a transform is to hang under, where a node is needed twice.
    pub node: NodeId,
    pub inverse_bind: DMat4,
}

/// Which joints a skin needs beside its own: the file's root for what keeps to the bind shape, the node itself for points without weights where that is
/// the identity.
fn extras(skin: &Skin, mesh: &Mesh) -> (bool, bool) {
    let own = skin.joints.len();
    let root = skin.influences.iter().any(|influence| usize::try_from(influence.joint).map_or(true, |joint| joint >= own));
    let loose = |point: usize| !skin.influences_of(point).iter().any(|influence| influence.weight > 0.0);
    let any_loose = (0..mesh.source_count as usize).any(loose);
    (root || (any_loose && !skin.has_identity_bind_shape()), any_loose && skin.has_identity_bind_shape())
}

/// The joints that a skin is written with: its own, then those of [`extras`].
pub(super) fn bones(skin: &Skin, mesh: &Mesh, joints: &[Option<NodeId>], root: NodeId, node: NodeId) -> Vec<SkinBone> {
    let own = skin.joints.iter().zip(joints).map(|(joint, at)| match at {
        Some(at) => SkinBone { node: *at, inverse_bind: joint.inverse_bind * skin.bind_shape },
        None => SkinBone { node: root, inverse_bind: skin.bind_shape },
    });
    let mut bones: Vec<SkinBone> = own.collect();
    let (needs_root, needs_node) = extras(skin, mesh);
    bones.extend(needs_root.then_some(SkinBone { node: root, inverse_bind: skin.bind_shape }));
    bones.extend(needs_node.then_some(SkinBone { node, inverse_bind: skin.bind_shape }));
    bones
}

impl Surfaces {
    /// Writes a mesh with these deformers and materials, if none like it is written yet; returns its number, or `None` where nothing of it can be drawn.
    pub(super) fn mesh(
        &mut self,
        scene: &Scene,
        instance: &MeshInstance,
        mirrored: bool,
        materials: &mut GltfMaterials,
        buffer: &mut Buffer,
        losses: &mut Vec<UnsupportedFeature>,
    ) -> Option<usize> {
        let key = MeshKey::of(instance, mirrored);
        if let Some(known) = self.written.get(&key) {
            return *known;
        }
        let number = self.new_mesh(scene, instance, mirrored, materials, buffer, losses);
        self.written.insert(key, number);
        number
    }

    fn new_mesh(
        &mut self,
        scene: &Scene,
        instance: &MeshInstance,
        mirrored: bool,
        materials: &mut GltfMaterials,
        buffer: &mut Buffer,
        losses: &mut Vec<UnsupportedFeature>,
    ) -> Option<usize> {
        let mesh = scene.meshes.get(instance.mesh.index())?;
        let mut attributes = self.shapes.entry(instance.mesh).or_insert_with(|| shape(mesh, buffer)).clone();
        let mut targets = Vec::new();
        let (mut weights, mut names) = (Vec::new(), Vec::new());
        for deformer in &instance.deformers {
            match deformer {
                Deformer::Skin { skin: id, .. } => {
                    let Some(skin) = scene.skins.get(id.index()) else { continue };
                    let binding = self.bindings.entry((instance.mesh, *id)).or_insert_with(|| influences(skin, mesh, buffer));
                    attributes.extend(binding.clone());
                }
                Deformer::Morph(id) => {
                    let Some(morph) = scene.morphs.get(id.index()) else { continue };
                    let known = self.targets.entry((instance.mesh, *id)).or_insert_with(|| morph_targets(morph, mesh, buffer));
                    targets.extend(known.iter().cloned());
                    weights.extend(morph.weights.iter().copied().chain(std::iter::repeat(0.0)).take(morph.targets.len()));
                    names.extend(morph.targets.iter().map(|target| target.name.clone()));
                }
            }
        }
        let backed = self.backed.entry(instance.mesh).or_insert_with(|| backed(mesh, &mut self.out_of_memory));
        let sides = MeshSides { mirrored, backed };
        let indices = self.indices.entry(instance.mesh).or_default();
        let primitives = primitives(scene, mesh, &instance.materials, &attributes, &targets, sides, indices, materials, buffer, losses);
        if primitives.is_empty() {
            return None;
        }
        let mut value = json!({"name": mesh.label().plain(), "primitives": primitives});
        if !targets.is_empty() {
            value["weights"] = json!(weights);
            value["extras"] = json!({"targetNames": names});
        }
        self.meshes.push(value);
        Some(self.meshes.len() - 1)
    }

    /// Writes a mesh that stands still as it is given; returns its number, or `None` where nothing of it can be drawn.
    #[allow(clippy::too_many_arguments, reason = "what is written and the tables that it goes into, each borrowed for itself")]
    pub(super) fn still(
        &mut self,
        scene: &Scene,
        mesh: &Mesh,
        bindings: &[Option<MaterialBinding>],
        mirrored: bool,
        materials: &mut GltfMaterials,
        buffer: &mut Buffer,
        losses: &mut Vec<UnsupportedFeature>,
    ) -> Option<usize> {
        let attributes = shape(mesh, buffer);
        let primitives = primitives(
            scene,
            mesh,
            bindings,
            &attributes,
            &[],
            MeshSides { mirrored, backed: &backed(mesh, &mut self.out_of_memory) },
            &mut IndexAccessors::default(),
            materials,
            buffer,
            losses,
        );
        if primitives.is_empty() {
            return None;
        }
        self.meshes.push(json!({"name": mesh.label().plain(), "primitives": primitives}));
        Some(self.meshes.len() - 1)
    }

    /// Writes a skin of these nodes and matrices.
    pub(super) fn skin(&mut self, of: (MeshId, SkinId), name: &str, joints: &[usize], bones: &[SkinBone], buffer: &mut Buffer) -> usize {
        let rows: Vec<[f32; 16]> = bones.iter().map(|bone| upright(&bone.inverse_bind)).collect();
        buffer.spend(ENTRY + joints.len() * size_of::<Value>());
        let matrices = match self.matrices.get(&of).filter(|(known, _)| *known == rows) {
            Some((_, known)) => *known,
            None => {
                let matrices = buffer.floats(Usage::Other, &rows, false);
                self.matrices.insert(of, (rows, matrices));
                matrices
            }
        };
        self.skins.push(json!({"name": name, "joints": joints, "inverseBindMatrices": matrices}));
        self.skins.len() - 1
    }
}

fn upright(matrix: &DMat4) -> [f32; 16] {
    let mut numbers = matrix.as_mat4().to_cols_array().map(|number| if number.is_finite() { number } else { 0.0 });
    for (at, number) in [(3, 0.0), (7, 0.0), (11, 0.0), (15, 1.0)] {
        numbers[at] = number;
    }
    numbers
}

/// A vector without infinities, which the format does not allow.
fn finite_or_zero(vector: Vec3) -> [f32; 3] {
    if vector.is_finite() { (vector + 0.0).to_array() } else { [0.0; 3] }
}

/// Positions, normals, texture coordinates, colours.
fn shape(mesh: &Mesh, buffer: &mut Buffer) -> GltfAttributes {
    let mut attributes = GltfAttributes::new();
    let positions: Vec<[f32; 3]> = mesh.positions.iter().map(|position| finite_or_zero(*position)).collect();
    if positions.is_empty() {
        return attributes;
    }
    attributes.insert("POSITION".into(), buffer.floats(Usage::Vertices, &positions, true).into());
    if mesh.normals.len() == positions.len() {
        let normals: Vec<[f32; 3]> = mesh.normals.iter().map(|normal| normal.normalize_or(Vec3::Y).to_array()).collect();
        attributes.insert("NORMAL".into(), buffer.floats(Usage::Vertices, &normals, false).into());
    }
    for (set, uvs) in mesh.uv_sets.iter().enumerate().filter(|(_, uvs)| uvs.len() == positions.len()) {
        // COLLADA counts from the lower edge of a picture, glTF from the upper one.
        let rows: Vec<[f32; 2]> = uvs.iter().map(|uv| if uv.is_finite() { [uv.x, 1.0 - uv.y] } else { [0.0; 2] }).collect();
        attributes.insert(format!("TEXCOORD_{set}"), buffer.floats(Usage::Vertices, &rows, false).into());
    }
    if mesh.colors.len() == positions.len() {
        let rows: Vec<[f32; 4]> = mesh.colors.iter().map(|color| if color.is_finite() { color.to_array() } else { [1.0; 4] }).collect();
        attributes.insert("COLOR_0".into(), buffer.floats(Usage::Vertices, &rows, false).into());
    }
    attributes
}

/// The joints of a point, by their place among [`bones`], with weights that add up to 1; the heaviest first.
pub(super) type PointInfluences = Vec<(u16, f32)>;

/// What is written for each point of a mesh.
pub(super) fn influences_of_points(skin: &Skin, mesh: &Mesh) -> Vec<PointInfluences> {
    let root = skin.joints.len() as u16;
    // Points without weights come behind the root where they have a joint of their own, and at the root else.
    let own = match extras(skin, mesh) {
        (at_root, true) => root + u16::from(at_root),
        _ => root,
    };
    let of_point = |point: usize| -> PointInfluences {
        let mut found = PointInfluences::new();
        for influence in skin.influences_of(point) {
            let joint = u16::try_from(influence.joint).ok().filter(|joint| *joint < root).unwrap_or(root);
            let weight = influence.weight;
            if weight.is_finite() && weight > 0.0 {
                match found.iter_mut().find(|(known, _)| *known == joint) {
                    Some((_, sum)) => *sum += weight,
                    None => found.push((joint, weight)),
                }
            }
        }
        if found.is_empty() {
            return vec![(own, 1.0)];
        }
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        let sum: f64 = found.iter().map(|(_, weight)| f64::from(*weight)).sum();
        found.iter_mut().for_each(|(_, weight)| *weight = (f64::from(*weight) / sum) as f32);
        // Rounding must not leave a sum beside 1: the heaviest takes it up.
        let rest: f64 = found.iter().skip(1).map(|(_, weight)| f64::from(*weight)).sum();
        found[0].1 = (1.0 - rest) as f32;
        found
    };
    (0..mesh.source_count as usize).map(of_point).collect()
}

/// Joints and weights, four to a set, the heaviest first, as many sets as the fullest point needs.
fn influences(skin: &Skin, mesh: &Mesh, buffer: &mut Buffer) -> GltfAttributes {
    let points = influences_of_points(skin, mesh);
    let sets = points.iter().map(Vec::len).max().unwrap_or(1).div_ceil(4).max(1);
    let mut attributes = GltfAttributes::new();
    for set in 0..sets {
        let pick = |vertex: &u32| {
            let mut row = ([0_u16; 4], [0.0_f32; 4]);
            let found = points.get(*vertex as usize).map_or(&[][..], Vec::as_slice);
            for (slot, (joint, weight)) in found.iter().skip(set * 4).take(4).enumerate() {
                (row.0[slot], row.1[slot]) = (*joint, *weight);
            }
            row
        };
        let (joints, weights): (Vec<[u16; 4]>, Vec<[f32; 4]>) = mesh.source_vertex.iter().map(pick).unzip();
        attributes.insert(format!("JOINTS_{set}"), buffer.joints(&joints).into());
        attributes.insert(format!("WEIGHTS_{set}"), buffer.floats(Usage::Vertices, &weights, false).into());
    }
    attributes
}

fn morph_targets(morph: &Morph, mesh: &Mesh, buffer: &mut Buffer) -> Vec<Value> {
    let count = mesh.positions.len();
    let rows = |deltas: &[Vec3]| -> Vec<[f32; 3]> {
        deltas.iter().copied().chain(std::iter::repeat(Vec3::ZERO)).take(count).map(finite_or_zero).collect()
    };
    let target = |target: &sinew_scene::MorphTarget| {
        let mut value = json!({"POSITION": buffer.floats(Usage::Vertices, &rows(&target.position_deltas), true)});
        if target.normal_deltas.len() == count && mesh.normals.len() == count {
            value["NORMAL"] = buffer.floats(Usage::Vertices, &rows(&target.normal_deltas), false).into();
        }
        value
    };
    morph.targets.iter().map(target).collect()
}

/// Which side of a surface is outside.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct MeshSides<'a> {
    /// A skin turns the surface inside out. A player sees that of nodes, whose matrices it knows, but a skinned mesh stands at the root.
    pub mirrored: bool,
    /// For each triangle whether it is to be seen from its own side only, because another one lies on its back; empty where that is so for none.
    pub backed: &'a [bool],
}

/// One primitive a part of the mesh for its triangles, one for those of them that are seen from one side only, one for its lines.
#[allow(clippy::too_many_arguments, reason = "what is written and the tables that it goes into, each borrowed for itself")]
pub(super) fn primitives(
    scene: &Scene,
    mesh: &Mesh,
    bindings: &[Option<MaterialBinding>],
    attributes: &GltfAttributes,
    targets: &[Value],
    sides: MeshSides<'_>,
    known: &mut IndexAccessors,
    materials: &mut GltfMaterials,
    buffer: &mut Buffer,
    losses: &mut Vec<UnsupportedFeature>,
) -> Vec<Value> {
    let count = mesh.positions.len();
    let good = |vertex: &u32| mesh.positions.get(*vertex as usize).is_some_and(|position| position.is_finite());
    let mut written = Vec::new();
    for (number, part) in mesh.parts.iter().enumerate() {
        buffer.spend((2 + targets.len()) * ENTRY);
        if buffer.is_full() {
            break;
        }
        let triangles = mesh.triangles.get(part.triangles.start as usize..part.triangles.end as usize).unwrap_or(&[]);
        let lines = mesh.lines.get(part.lines.start as usize..part.lines.end as usize).unwrap_or(&[]);
        let turn = |&[a, b, c]: &[u32; 3]| if sides.mirrored { [a, c, b] } else { [a, b, c] };
        let is_backed = |t: usize| sides.backed.get(part.triangles.start as usize + t).copied().unwrap_or(false);
        let corners = |backed: bool| -> Vec<u32> {
            let wanted = triangles.iter().enumerate().filter(|(t, corners)| is_backed(*t) == backed && corners.iter().all(good));
            wanted.flat_map(|(_, corners)| turn(corners)).collect()
        };
        let ends = || -> Vec<u32> { lines.iter().filter(|ends| ends.iter().all(good)).flatten().copied().collect() };
        let binding = bindings.get(number).and_then(Option::as_ref);
        for (mode, both_sides) in [(4, true), (4, false), (1, true)] {
            let key = (number, mode, sides.mirrored, both_sides);
            let indices = match known.get(&key) {
                Some(known) => *known,
                None => {
                    let indices = if mode == 1 { ends() } else { corners(!both_sides) };
                    if indices.is_empty() || attributes.is_empty() {
                        continue;
                    }
                    let indices = buffer.indices(&indices, count);
                    known.insert(key, indices);
                    indices
                }
            };
            let mut primitive = json!({"attributes": attributes, "indices": indices, "mode": mode});
            let bound = binding.and_then(|binding| materials.number(scene, binding, both_sides, buffer, losses));
            primitive["material"] = bound.unwrap_or_else(|| materials.unbound(mesh.colors.len() == count, both_sides)).into();
            if !targets.is_empty() {
                primitive["targets"] = targets.into();
            }
            written.push(primitive);
        }
    }
    written
}

/// The attributes of a mesh whose shape is given rather than its own.
pub(super) fn given_shape(positions: &[Vec3], normals: &[Vec3], buffer: &mut Buffer) -> GltfAttributes {
    shape(&Mesh { positions: positions.to_vec(), normals: normals.to_vec(), ..Mesh::default() }, buffer)
}
