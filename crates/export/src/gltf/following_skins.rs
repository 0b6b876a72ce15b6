//! Skins that follow the muscles beneath them: what following adds to the skeleton's movement, as a few morph targets of the skinned meshes.
//!
//! The format morphs first and skins then (glTF 2.0, section 3.7.2.2), so that displacements are given in the space of the bind shape: where the skin's
//! blended matrix M = Σ wⱼ · Jⱼ · IBMⱼ · BSM takes a vertex v and following puts it to x, its displacement is M⁻¹ x − v. Only vertices that are bound to
//! muscles have one.

use std::sync::Arc;

use glam::{DMat3, DMat4, DVec3, Vec3};
use rustc_hash::FxHashMap;
use serde_json::{Value, json};

use super::animations::{Animation, AnimationRange};
use super::buffer::{Buffer, ENTRY};
use super::keyframe_reduction::KeyTime;
use super::muscles::{largest_error, stretch, write_weights};
use super::shape_basis::Shape;
use super::shape_sampling::{Displacements, MovingSurfaces, sample, thread_count};
use super::surfaces::{PointInfluences, SkinBone};
use super::unsupported_features::UnsupportedFeature;
use sinew_engine::document::{Document, PoseBuffers};
use sinew_scene::{Content, Deformer, Frame, Mesh, NodeId, SurfaceGeometry, limits};

/// The least volume that a vertex's matrix makes of a unit cube, beside the cube of its largest stretch. A flatter one can hardly be undone, and its vertex
/// gets no displacement.
const FLAT: f64 = 1e-4;
/// Most shapes of one skin: one may lie over dozens of muscles, each of which moves it in its own way.
const MAX_SKIN_SHAPES: usize = 192;

/// A skinned mesh as it was written.
#[derive(Debug, Clone)]
pub(super) struct WrittenSkin {
    /// The written node.
    pub holder: usize,
    /// The joints that it was written with.
    pub bones: Vec<SkinBone>,
}

/// The skinned meshes that were written, by node of the scene and place among its contents.
pub(super) type WrittenSkins = FxHashMap<(NodeId, usize), WrittenSkin>;

/// A skin that follows muscles.
#[derive(Debug)]
struct FollowingSkin {
    /// Its surface in a frame.
    surface: usize,
    mesh: Arc<Mesh>,
    written: WrittenSkin,
    /// The vertices that are bound to muscles, rising.
    vertices: Vec<u32>,
    /// For each of them its joints and weights as they are written.
    influences: Vec<PointInfluences>,
}

/// The skins of a document that follow muscles.
pub(super) struct FollowingSkins<'a> {
    document: &'a Document,
    ranges: &'a [AnimationRange],
    skins: Vec<FollowingSkin>,
    /// Largest distance of a vertex from where it belongs, metres.
    error: f32,
}

/// Buffers that posing uses again and again.
#[derive(Default)]
pub(super) struct SkinScratch {
    buffers: PoseBuffers,
    frame: Frame,
}

impl MovingSurfaces for FollowingSkins<'_> {
    type Scratch = SkinScratch;

    fn vertices(&self) -> Vec<usize> {
        self.skins.iter().map(|skin| skin.vertices.len()).collect()
    }

    fn pose(&self, range: usize, at: f64, scratch: &mut SkinScratch) -> Vec<Displacements> {
        if let Some(range) = self.ranges.get(range) {
            self.document.pose(&range.state(self.document, at), &mut scratch.buffers, &mut scratch.frame);
        }
        self.skins.iter().map(|skin| skin.displacements(&scratch.frame)).collect()
    }
}

impl FollowingSkin {
    /// What following adds in a frame, in the space of the bind shape.
    fn displacements(&self, frame: &Frame) -> Displacements {
        let Some(surface) = frame.surfaces.get(self.surface) else { return Displacements::default() };
        let SurfaceGeometry::Deformed { positions, normals } = &surface.geometry else { return Displacements::default() };
        let world = |node: NodeId| frame.world.get(node.index()).copied().unwrap_or(DMat4::IDENTITY);
        let matrices: Vec<DMat4> = self.written.bones.iter().map(|bone| world(bone.node) * bone.inverse_bind).collect();
        let mut moved = Displacements::default();
        for (vertex, influences) in self.vertices.iter().zip(&self.influences) {
            let of = |list: &[Vec3]| list.get(*vertex as usize).map_or(DVec3::ZERO, |vector| vector.as_dvec3());
            let part = |(joint, weight): &(u16, f32)| matrices.get(usize::from(*joint)).map(|matrix| *matrix * f64::from(*weight));
            let matrix = influences.iter().filter_map(part).fold(DMat4::ZERO, |sum, part| sum + part);
            let (linear, longest) = (DMat3::from_mat4(matrix), stretch(&matrix));
            let (mut step, mut turn) = (Vec3::ZERO, Vec3::ZERO);
            if linear.determinant().abs() > FLAT * longest.powi(3) {
                step = (linear.inverse() * (of(positions) - matrix.w_axis.truncate()) - of(&self.mesh.positions)).as_vec3();
                // A surface's normals go by the inverse of the transposed matrix, and so come back by the transposed one.
                let back = (linear.transpose() * of(normals)).try_normalize().zip(of(&self.mesh.normals).try_normalize());
                turn = back.map_or(Vec3::ZERO, |(after, before)| (after - before).as_vec3());
            }
            moved.positions.push(step);
            moved.normals.push(turn);
            moved.scale = moved.scale.max(longest as f32);
        }
        moved
    }

    /// Writes a shape as a morph target of the whole mesh.
    fn target(&self, shape: &Shape, buffer: &mut Buffer) -> Value {
        let count = self.mesh.positions.len();
        let whole = |rows: &[[f32; 3]]| {
            let mut all = vec![[0.0; 3]; count];
            for (vertex, row) in self.vertices.iter().zip(rows) {
                if let Some(place) = all.get_mut(*vertex as usize) {
                    *place = *row;
                }
            }
            all
        };
        let mut target = json!({"POSITION": buffer.differences(&whole(&shape.positions), true)});
        if self.mesh.normals.len() == count {
            target["NORMAL"] = buffer.differences(&whole(&shape.normals), false).into();
        }
        target
    }
}

impl<'a> FollowingSkins<'a> {
    /// The skins that follow, of those that were written; those that cannot be written so are told.
    pub(super) fn new(
        document: &'a Document,
        ranges: &'a [AnimationRange],
        written: &WrittenSkins,
        losses: &mut Vec<UnsupportedFeature>,
    ) -> Self {
        let bound = document.bound_surfaces();
        let mut skins = Vec::new();
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        if !bound.is_empty() {
            document.pose(&document.start_state(), &mut buffers, &mut frame);
        }
        for (index, vertices) in bound {
            let Some(surface) = frame.surfaces.get(index) else { continue };
            let content = document.scene.graph.node(surface.node).contents.get(surface.content as usize);
            let (Some(Content::Mesh(instance)), Some(made)) = (content, written.get(&(surface.node, surface.content as usize))) else {
                continue;
            };
            let [Deformer::Skin { skin, .. }] = &*instance.deformers else {
                losses.push(UnsupportedFeature::FollowingSkin { mesh: surface.mesh.label().plain().into_owned() });
                continue;
            };
            let Some(skin) = document.scene.skins.get(skin.index()) else { continue };
            let of_points = super::surfaces::influences_of_points(skin, &surface.mesh);
            let of = |vertex: &u32| {
                let point = surface.mesh.source_vertex.get(*vertex as usize);
                point.and_then(|point| of_points.get(*point as usize)).cloned().unwrap_or_default()
            };
            let influences = vertices.iter().map(of).collect();
            skins.push(FollowingSkin { surface: index, mesh: Arc::clone(&surface.mesh), written: made.clone(), vertices, influences });
        }
        Self { document, ranges, skins, error: largest_error(&frame) }
    }

    /// Adds the morph targets to the meshes, and the movement of their weights to the takes' `animations`.
    pub(super) fn write(
        &self,
        animations: &mut [Animation],
        nodes: &mut [Value],
        meshes: &mut Vec<Value>,
        buffer: &mut Buffer,
        losses: &mut Vec<UnsupportedFeature>,
    ) {
        let moments: Vec<Vec<KeyTime>> = self.ranges.iter().map(|range| range.moments(self.document)).collect();
        let most = (limits::SHAPE_VERTICES / self.vertices().into_iter().sum::<usize>().max(1)).min(MAX_SKIN_SHAPES);
        let sampled = sample(self, &moments, self.error, most, thread_count());
        let mut exceeded = sampled.exceeded;
        sampled.finish(|number, shapes| {
            exceeded |= shapes.basis.exceeded;
            let Some(skin) = self.skins.get(number).filter(|_| !shapes.basis.shapes.is_empty() && !buffer.is_full()) else { return };
            let Some(mesh) = own_mesh(skin.written.holder, nodes, meshes) else { return };
            let targets: Vec<Value> = shapes.basis.shapes.iter().map(|shape| skin.target(shape, buffer)).collect();
            for primitive in mesh["primitives"].as_array_mut().into_iter().flatten() {
                buffer.spend(targets.len() * ENTRY);
                primitive["targets"] = targets.clone().into();
            }
            mesh["weights"] = json!(vec![0.0; targets.len()]);
            write_weights(skin.written.holder, &shapes, animations, buffer);
        });
        if exceeded {
            losses.push(UnsupportedFeature::SkinShapes { kept: most });
        }
    }
}

/// The mesh of a written node; a copy of it where other nodes have the same one, which may follow otherwise.
fn own_mesh<'a>(node: usize, nodes: &mut [Value], meshes: &'a mut Vec<Value>) -> Option<&'a mut Value> {
    let number = nodes.get(node)?.get("mesh")?.as_u64()?;
    let users = nodes.iter().filter(|other| other.get("mesh").and_then(Value::as_u64) == Some(number)).count();
    let mut index = usize::try_from(number).ok()?;
    if users > 1 {
        let copy = meshes.get(index)?.clone();
        index = meshes.len();
        meshes.push(copy);
        nodes.get_mut(node)?["mesh"] = index.into();
    }
    meshes.get_mut(index)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_with_the_same_mesh_get_one_each() {
        let mut nodes = vec![json!({"mesh": 1}), json!({"mesh": 0}), json!({}), json!({"mesh": 1})];
        let mut meshes = vec![json!({"name": "other"}), json!({"name": "skin"})];
        for node in [0, 3] {
            own_mesh(node, &mut nodes, &mut meshes).expect("a mesh")["weights"] = node.into();
        }
        assert_eq!(nodes, [json!({"mesh": 2}), json!({"mesh": 0}), json!({}), json!({"mesh": 1})]);
        assert_eq!(meshes[1..], [json!({"name": "skin", "weights": 3}), json!({"name": "skin", "weights": 0})]);
        assert!(own_mesh(2, &mut nodes, &mut meshes).is_none() && own_mesh(9, &mut nodes, &mut meshes).is_none());
    }
}
