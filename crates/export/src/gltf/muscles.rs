//! Muscles: their movement as a few morph targets with weights, so that they bulge in any viewer.
//!
//! Targets are plain `f32` accessors, sparse where that is smaller: both are core glTF 2.0, which every reader knows. Targets of 16-bit integers would need
//! `KHR_mesh_quantization` as a *required* extension, and readers without it refuse the whole file.

use glam::{DMat3, DMat4, Vec3};
use serde_json::{Value, json};
use std::sync::Arc;

use super::animations::{Animation, AnimationRange};
use super::buffer::Buffer;
use super::keyframe_reduction::KeyTime;
use super::materials::GltfMaterials;
use super::shape_sampling::{AnimatedShapes, Displacements, MAX_SHAPES, MovingSurfaces, sample, thread_count};
use super::surfaces::{IndexAccessors, MeshSides, given_shape, primitives};
use super::unsupported_features::UnsupportedFeature;
use sinew_engine::document::{Document, PoseBuffers, PoseState, SkinMotion};
use sinew_scene::limits;
use sinew_scene::{Frame, Mesh, MuscleId, NodeId, Surface, SurfaceGeometry};

/// Largest distance of a vertex from where it belongs, at any moment, metres.
const MAX_ERROR: f32 = 5e-4;
/// The same in diagonals of the scene, for small ones.
const MAX_RELATIVE_ERROR: f32 = 1e-3;

/// The surface of one muscle at one moment, in the space of a bone.
#[derive(Debug, Clone, Default, PartialEq)]
struct MuscleShape {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    /// Metres a unit of that space, in the direction in which they are most.
    scale: f32,
}

/// A muscle's surface in a frame, and the node that its shapes are given in: the bone that it originates from, in whose space it moves least, however far the
/// whole walks. `None` for the world.
#[derive(Debug, Clone, Copy)]
struct MuscleSurface {
    surface: usize,
    bone: Option<NodeId>,
}

/// The muscles of a document as they stand at its start, and how they move.
pub(super) struct Muscles<'a> {
    document: &'a Document,
    ranges: &'a [AnimationRange],
    /// The document's start.
    frame: Frame,
    surfaces: Vec<MuscleSurface>,
    rest: Vec<MuscleShape>,
}

/// Buffers that posing uses again and again.
#[derive(Default)]
pub(super) struct MuscleScratch {
    buffers: PoseBuffers,
    frame: Frame,
}

/// Index accessors of the meshes written so far: muscles with as many nodes have the same triangles.
type SharedIndices = Vec<(Arc<Mesh>, IndexAccessors)>;

impl MovingSurfaces for Muscles<'_> {
    type Scratch = MuscleScratch;

    fn vertices(&self) -> Vec<usize> {
        self.rest.iter().map(|shape| shape.positions.len()).collect()
    }

    fn pose(&self, range: usize, at: f64, scratch: &mut MuscleScratch) -> Vec<Displacements> {
        if let Some(range) = self.ranges.get(range) {
            // Muscles stand where they do whether the skin follows them or not, and so it need not.
            let state = PoseState { skin: SkinMotion::Skeleton, ..range.state(self.document, at) };
            self.document.pose(&state, &mut scratch.buffers, &mut scratch.frame);
        }
        let less = |a: &[Vec3], b: &[Vec3]| -> Vec<Vec3> { a.iter().zip(b).map(|(a, b)| *a - *b).collect() };
        let displaced = |(place, rest): (&MuscleSurface, &MuscleShape)| match shape(&scratch.frame, place) {
            Some(shape) => Displacements {
                positions: less(&shape.positions, &rest.positions),
                normals: less(&shape.normals, &rest.normals),
                scale: shape.scale,
            },
            None => Displacements::default(),
        };
        self.surfaces.iter().zip(&self.rest).map(displaced).collect()
    }
}

/// How far a vertex of a muscle, or of the skin over it, may be from where it belongs at any moment, metres, in a scene that starts as this frame.
pub(super) fn largest_error(start: &Frame) -> f32 {
    MAX_ERROR.min(MAX_RELATIVE_ERROR * start.bounds.diagonal())
}

/// A muscle in the space of its bone; `None` where it is not shown or the bone is flat.
fn shape(frame: &Frame, place: &MuscleSurface) -> Option<MuscleShape> {
    let SurfaceGeometry::Deformed { positions, normals } = &frame.surfaces.get(place.surface)?.geometry else { return None };
    let world = place.bone.and_then(|bone| frame.world.get(bone.index())).copied().unwrap_or(DMat4::IDENTITY);
    let (inside, upright) = (world.inverse(), DMat3::from_mat4(world).transpose());
    if !inside.is_finite() {
        return None;
    }
    let positions = positions.iter().map(|point| inside.transform_point3(point.as_dvec3()).as_vec3()).collect();
    let normals = normals.iter().map(|normal| (upright * normal.as_dvec3()).as_vec3().normalize_or(Vec3::Y)).collect();
    Some(MuscleShape { positions, normals, scale: stretch(&world) as f32 })
}

/// How much longer a matrix makes a vector at most: exact where its columns are square to each other, else an upper bound (‖M‖₂² ≤ ‖MᵀM‖∞).
pub(super) fn stretch(matrix: &DMat4) -> f64 {
    let upright = DMat3::from_mat4(*matrix);
    let square = upright.transpose() * upright;
    [square.row(0), square.row(1), square.row(2)].map(|row| row.abs().element_sum()).into_iter().fold(0.0, f64::max).sqrt()
}

impl<'a> Muscles<'a> {
    pub(super) fn new(document: &'a Document, ranges: &'a [AnimationRange]) -> Self {
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        document.pose(&document.start_state(), &mut buffers, &mut frame);
        let bone = |muscle: MuscleId| document.muscle(muscle).and_then(|(rig, index)| rig.origin_bone(index));
        // A bone that is flat at the start has no inside to stand in.
        let solid = |node: &NodeId| frame.world.get(node.index()).is_some_and(|world| world.determinant().abs() > f64::MIN_POSITIVE);
        let place = |(surface, shown): (usize, &Surface)| Some(MuscleSurface { surface, bone: bone(shown.muscle?).filter(solid) });
        let surfaces: Vec<MuscleSurface> = frame.surfaces.iter().enumerate().filter_map(place).collect();
        let rest = surfaces.iter().map(|place| shape(&frame, place).unwrap_or_default()).collect();
        Self { document, ranges, frame, surfaces, rest }
    }

    /// Writes all muscles and the movement of their shapes into the takes' `animations`. Returns the new nodes, each with the bone that it belongs under.
    #[allow(clippy::too_many_arguments, reason = "what is written and the tables that it goes into, each borrowed for itself")]
    pub(super) fn write(
        &self,
        animations: &mut [Animation],
        nodes: &mut Vec<Value>,
        meshes: &mut Vec<Value>,
        materials: &mut GltfMaterials,
        buffer: &mut Buffer,
        losses: &mut Vec<UnsupportedFeature>,
    ) -> Vec<(usize, Option<NodeId>)> {
        let moments: Vec<Vec<KeyTime>> = self.ranges.iter().map(|range| range.moments(self.document)).collect();
        let error = largest_error(&self.frame);
        // However many muscles there are, all shapes together stay within a bound.
        let most = (limits::SHAPE_VERTICES / self.vertices().into_iter().sum::<usize>().max(1)).min(MAX_SHAPES);
        let sampled = sample(self, &moments, error, most, thread_count());
        let mut exceeded = sampled.exceeded;
        let (mut written, mut shared) = (Vec::new(), SharedIndices::new());
        sampled.finish(|number, shapes| {
            exceeded |= shapes.basis.exceeded;
            if let (Some(place), Some(base), false) = (self.surfaces.get(number), self.rest.get(number), buffer.is_full())
                && let Some(mesh) = self.mesh(place, base, &shapes, &mut shared, materials, buffer, losses)
            {
                nodes.push(json!({"name": mesh["name"], "mesh": meshes.len()}));
                meshes.push(mesh);
                written.push((nodes.len() - 1, place.bone));
                write_weights(nodes.len() - 1, &shapes, animations, buffer);
            }
        });
        if exceeded {
            losses.push(UnsupportedFeature::Shapes { kept: most });
        }
        written
    }

    /// Writes the surface of a muscle with its morph targets; `None` where nothing of it can be drawn.
    #[allow(clippy::too_many_arguments, reason = "what is written and the tables that it goes into, each borrowed for itself")]
    fn mesh(
        &self,
        place: &MuscleSurface,
        base: &MuscleShape,
        shapes: &AnimatedShapes,
        shared: &mut SharedIndices,
        materials: &mut GltfMaterials,
        buffer: &mut Buffer,
        losses: &mut Vec<UnsupportedFeature>,
    ) -> Option<Value> {
        let surface = self.frame.surfaces.get(place.surface)?;
        let mut targets = Vec::new();
        for shape in &shapes.basis.shapes {
            targets
                .push(json!({"POSITION": buffer.differences(&shape.positions, true), "NORMAL": buffer.differences(&shape.normals, false)}));
        }
        let attributes = given_shape(&base.positions, &base.normals, buffer);
        let scene = &self.document.scene;
        let shaped = Mesh { positions: base.positions.clone(), ..(*surface.mesh).clone() };
        let same = |known: &Mesh| {
            known.triangles == surface.mesh.triangles && known.lines == surface.mesh.lines && known.parts == surface.mesh.parts
        };
        let mut own = IndexAccessors::default();
        // Triangles of vertices that are nowhere are left out, so that only whole surfaces have indices in common.
        let indices = if base.positions.iter().all(|position| position.is_finite()) {
            let known = shared.iter().position(|(mesh, _)| mesh.positions.len() == base.positions.len() && same(mesh));
            let at = known.unwrap_or_else(|| {
                shared.push((surface.mesh.clone(), IndexAccessors::default()));
                shared.len() - 1
            });
            &mut shared[at].1
        } else {
            &mut own
        };
        let bindings = &surface.materials;
        let primitives =
            primitives(scene, &shaped, bindings, &attributes, &targets, MeshSides::default(), indices, materials, buffer, losses);
        if primitives.is_empty() {
            return None;
        }
        let mut mesh = json!({"name": scene.graph.label(surface.node).plain(), "primitives": primitives});
        if !targets.is_empty() {
            mesh["weights"] = json!(vec![0.0; targets.len()]);
        }
        Some(mesh)
    }
}

/// Writes the weights of a node's shapes over each range.
pub(super) fn write_weights(node: usize, shapes: &AnimatedShapes, animations: &mut [Animation], buffer: &mut Buffer) {
    if shapes.basis.shapes.is_empty() {
        return;
    }
    for (keys, animation) in shapes.keys.iter().zip(animations).filter(|(keys, _)| !keys.is_empty()) {
        let times: Vec<f32> = keys.iter().map(|(time, _)| *time).collect();
        let rows = keys.iter().filter_map(|(_, moment)| shapes.basis.weights.get(*moment));
        let values: Vec<f32> = rows.flatten().map(|weight| weight + 0.0).collect();
        let (input, output) = (buffer.scalars(&times, true), buffer.scalars(&values, false));
        animation.add(node, "weights", input, output, "LINEAR");
    }
}
