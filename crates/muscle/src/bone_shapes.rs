//! The shapes of a rig's bones, from the meshes that a clip has for them; where it has none, rods.

use glam::{DMat4, DVec3};

use super::bone_shape::BoneShape;
use super::line_of_action::Frames;
use super::muscle_rig::MuscleRig;
use sinew_scene::{Content, Deformer, Graph, Mesh, MeshInstance, Node, NodeId, NodeKind, Scene};

/// Radius of a bone without a mesh, over its length: that of a human humerus in the middle of its shaft (about 11 of 310 mm).
const SLENDER: f64 = 0.036;
/// A vertex whose joint has this weight moves with that bone alone.
const RIGID: f32 = 0.999;
/// A mesh of which more than this share of the vertices moves with one bone each is made of rigid parts.
const PARTS: f64 = 0.98;
/// Parts of names of meshes, nodes and materials that show bones, in small letters.
const NAMES: [&str; 16] = [
    "bone",
    "skelet",
    "humer",
    "radius",
    "ulna",
    "femur",
    "tibia",
    "fibula",
    "scapula",
    "clavic",
    "pelvis",
    "sacrum",
    "patella",
    "кост",
    "скелет",
    "плечев",
];

impl MuscleRig {
    /// Looks up the shapes of the rig's bones, with the scene at rest. `rest`: one matrix a node.
    pub(super) fn shape_bones(&mut self, scene: &Scene, rest: &[DMat4]) {
        let frames = self.frames(rest);
        let mut triangles: Vec<Vec<[DVec3; 3]>> = vec![Vec::new(); self.bones.len()];
        for (id, node) in scene.graph.iter() {
            for content in &node.contents {
                let Content::Mesh(instance) = content else { continue };
                let Some(mesh) = scene.meshes.get(instance.mesh.index()) else { continue };
                if shows_bones(scene, node, instance, mesh) {
                    let place = |bone: usize, point: DVec3| {
                        frames.frame(bone).inverse().transform_point3(frames.from_world.transform_point3(point))
                    };
                    collect(scene, (id, instance, mesh), rest, &self.bones, &mut |bone, corners| {
                        if let Some(list) = triangles.get_mut(bone) {
                            list.push(corners.map(|corner| place(bone, corner)));
                        }
                    });
                }
            }
        }
        let shapes = self.bones.iter().enumerate().map(|(index, node)| {
            let tip = tip_of(&scene.graph, *node, rest)?;
            let local = frames.frame(index).inverse().transform_point3(frames.from_world.transform_point3(tip));
            let rod = || BoneShape::capsule(local, SLENDER * local.length());
            triangles.get(index).and_then(|triangles| BoneShape::of_triangles(triangles, local)).or_else(rod)
        });
        self.bone_shapes = shapes.collect();
    }
}

/// Whether a mesh is one of bones: made of rigid parts, and called so.
fn shows_bones(scene: &Scene, node: &Node, instance: &MeshInstance, mesh: &Mesh) -> bool {
    let materials = instance.materials.iter().flatten().filter_map(|binding| scene.materials.get(binding.material.index()));
    let mut names =
        [node.name.as_str(), node.id.as_str(), mesh.name.as_str()].into_iter().chain(materials.map(|material| material.name.as_str()));
    if !names.any(is_bone_name) {
        return false;
    }
    match instance.deformers.as_slice() {
        [] => true,
        [Deformer::Skin { skin, .. }] => {
            let Some(skin) = scene.skins.get(skin.index()) else { return false };
            let points = skin.offsets.len().saturating_sub(1);
            let rigid = (0..points).filter(|point| matches!(skin.influences_of(*point), [one] if one.weight >= RIGID)).count();
            rigid as f64 >= PARTS * points as f64
        }
        _ => false,
    }
}

/// Whether a name is that of bones.
fn is_bone_name(name: &str) -> bool {
    let small = name.to_lowercase();
    NAMES.iter().any(|part| small.contains(part))
}

/// Gives the triangles of a mesh in the world, each with the number of the bone that moves it.
fn collect(
    scene: &Scene,
    (id, instance, mesh): (NodeId, &MeshInstance, &Mesh),
    rest: &[DMat4],
    bones: &[NodeId],
    give: &mut impl FnMut(usize, [DVec3; 3]),
) {
    let number = |node: NodeId| bones.iter().position(|bone| *bone == node);
    let vertex = |index: u32| mesh.positions.get(index as usize).map(|position| position.as_dvec3());
    match instance.deformers.first() {
        None => {
            // A mesh on a node below a bone moves with that bone.
            let above = std::iter::successors(Some(id), |node| scene.graph.node(*node).parent());
            let (Some(bone), Some(world)) = (above.into_iter().find_map(number), rest.get(id.index())) else { return };
            for triangle in &mesh.triangles {
                let [Some(a), Some(b), Some(c)] = triangle.map(vertex) else { continue };
                give(bone, [a, b, c].map(|corner| world.transform_point3(corner)));
            }
        }
        Some(Deformer::Skin { skin, joints, .. }) => {
            let Some(skin) = scene.skins.get(skin.index()) else { return };
            let of_joint = |joint: usize| {
                let node = joints.get(joint).copied().flatten()?;
                let matrix = *rest.get(node.index())? * skin.joints.get(joint)?.inverse_bind * skin.bind_shape;
                Some((number(node)?, matrix))
            };
            let moved: Vec<Option<(usize, DMat4)>> = (0..skin.joints.len()).map(of_joint).collect();
            for triangle in &mesh.triangles {
                let point = triangle.first().and_then(|first| mesh.source_vertex.get(*first as usize)).copied().unwrap_or(0);
                let [one] = skin.influences_of(point as usize) else { continue };
                let Some((bone, matrix)) = usize::try_from(one.joint).ok().and_then(|joint| moved.get(joint).copied().flatten()) else {
                    continue;
                };
                let [Some(a), Some(b), Some(c)] = triangle.map(vertex) else { continue };
                give(bone, [a, b, c].map(|corner| matrix.transform_point3(corner)));
            }
        }
        Some(Deformer::Morph(_)) => {}
    }
}

/// The other end of a bone in the world: the farthest of the joints below it; of a joint without one, as far beyond as it is from the joint above it.
pub(super) fn tip_of(graph: &Graph, bone: NodeId, rest: &[DMat4]) -> Option<DVec3> {
    let place = |node: NodeId| rest.get(node.index()).map(|world| world.w_axis.truncate());
    let (about, here) = (graph.node(bone), place(bone)?);
    let follows = |node: &&NodeId| about.kind != NodeKind::Joint || graph.node(**node).kind == NodeKind::Joint;
    let far = about
        .children()
        .iter()
        .filter(follows)
        .filter_map(|child| place(*child))
        .max_by(|a, b| a.distance(here).total_cmp(&b.distance(here)))?;
    (far.distance(here) > 0.0 && far.is_finite()).then_some(far)
}
