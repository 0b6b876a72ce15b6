//! Muscles: each moment's surface as a morph target, so that they bulge in any viewer.

use glam::{DMat3, DMat4, Vec3};
use serde_json::{Value, json};

use super::animations::{Animation, AnimationRange};
use super::buffer::{Buffer, Usage};
use super::keyframe_reduction::KeyTime;
use super::materials::GltfMaterials;
use super::surfaces::{IndexAccessors, MeshSides, given_shape, primitives};
use super::unsupported_features::UnsupportedFeature;
use sinew_engine::document::{Document, PoseBuffers, PoseState};
use sinew_scene::limits;
use sinew_scene::{Frame, MuscleId, NodeId, Surface, SurfaceGeometry};

/// Most morph targets of one muscle in one animation.
const MAX_SHAPES: usize = 144;
/// Largest deviation of a surface between two of its shapes, in diagonals of the scene.
const MAX_ERROR: f32 = 6e-5;

/// The surface of one muscle at one moment, in the space of the bone that it originates from: there it moves least, however far the whole walks.
#[derive(Debug, Clone, Default, PartialEq)]
struct MuscleShape {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    /// Metres a unit of that space.
    scale: f32,
}

/// A muscle's surface in a frame, and the node that its shapes are given in; `None` for the world.
#[derive(Debug, Clone, Copy)]
struct MuscleSurface {
    surface: usize,
    bone: Option<NodeId>,
}

/// Poses a document and hands out the surfaces of its muscles.
pub(super) struct Muscles<'a> {
    document: &'a Document,
    buffers: PoseBuffers,
    frame: Frame,
    surfaces: Vec<MuscleSurface>,
}

/// An interval between two keys, with the shapes in its middle and their deviation from linear interpolation.
struct KeyInterval {
    from: usize,
    to: usize,
    error: f32,
    middle: (KeyTime, Vec<MuscleShape>),
}

impl<'a> Muscles<'a> {
    pub(super) fn new(document: &'a Document) -> Self {
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        document.pose(&document.start_state(), &mut buffers, &mut frame);
        let bone = |muscle: MuscleId| document.muscle(muscle).and_then(|(rig, index)| rig.origin_bone(index));
        // A bone that is flat at the start has no inside to stand in.
        let solid = |node: &NodeId| frame.world.get(node.index()).is_some_and(|world| world.determinant().abs() > f64::MIN_POSITIVE);
        let place = |(surface, shown): (usize, &Surface)| Some(MuscleSurface { surface, bone: bone(shown.muscle?).filter(solid) });
        let places = frame.surfaces.iter().enumerate().filter_map(place).collect();
        Self { document, buffers, frame, surfaces: places }
    }

    fn at(&mut self, state: &PoseState) -> Vec<MuscleShape> {
        self.document.pose(state, &mut self.buffers, &mut self.frame);
        let shape = |place: &MuscleSurface| match self.frame.surfaces.get(place.surface).map(|surface| &surface.geometry) {
            Some(SurfaceGeometry::Deformed { positions, normals }) => {
                let world = place.bone.and_then(|bone| self.frame.world.get(bone.index())).copied().unwrap_or(DMat4::IDENTITY);
                let scale = world.determinant().abs().cbrt() as f32;
                let (inside, upright) = (world.inverse(), DMat3::from_mat4(world).transpose());
                if !inside.is_finite() {
                    return MuscleShape { positions: vec![Vec3::ZERO; positions.len()], normals: vec![Vec3::Y; normals.len()], scale };
                }
                let positions = positions.iter().map(|point| inside.transform_point3(point.as_dvec3()).as_vec3()).collect();
                let normals = normals.iter().map(|normal| (upright * normal.as_dvec3()).as_vec3().normalize_or(Vec3::Y)).collect();
                MuscleShape { positions, normals, scale }
            }
            _ => MuscleShape::default(),
        };
        self.surfaces.iter().map(shape).collect()
    }

    /// Writes all muscles and the movement of their shapes into the takes' `animations`. Returns the new nodes, each with the bone that it belongs under.
    #[allow(clippy::too_many_arguments, reason = "what is written and the tables that it goes into, each borrowed for itself")]
    pub(super) fn write(
        &mut self,
        ranges: &[AnimationRange],
        diagonal: f32,
        animations: &mut [Animation],
        nodes: &mut Vec<Value>,
        meshes: &mut Vec<Value>,
        materials: &mut GltfMaterials,
        buffer: &mut Buffer,
        losses: &mut Vec<UnsupportedFeature>,
    ) -> Vec<(usize, Option<NodeId>)> {
        let start = self.at(&self.document.start_state());
        // However many muscles and clips there are, all shapes together stay within a bound.
        let vertices: usize = start.iter().map(|shape| shape.positions.len()).sum();
        let most = (limits::SHAPE_VERTICES / vertices.max(1) / ranges.len().max(1)).min(MAX_SHAPES);
        let mut rough = false;
        let mut keyed: Vec<Vec<(f32, Vec<MuscleShape>)>> = Vec::new();
        for range in ranges {
            let keys = self.keys(range, diagonal * MAX_ERROR, most, &mut rough);
            let shapes = keys.iter().flat_map(|(_, shapes)| shapes);
            buffer.spend(shapes.map(|shape| size_of_val(&*shape.positions) + size_of_val(&*shape.normals)).sum());
            keyed.push(keys);
            if buffer.is_full() {
                return Vec::new();
            }
        }
        if rough && most < MAX_SHAPES {
            losses.push(UnsupportedFeature::Shapes { kept: if most < 2 { 0 } else { most } });
        }
        let mut written = Vec::new();
        for (number, place) in self.surfaces.clone().into_iter().enumerate() {
            let Some(surface) = self.frame.surfaces.get(place.surface) else { continue };
            let Some(base) = start.get(number) else { continue };
            let mut targets = Vec::new();
            for (_, shapes) in keyed.iter().flatten() {
                let Some(shape) = shapes.get(number) else { continue };
                let less = |a: &[Vec3], b: &[Vec3]| -> Vec<[f32; 3]> { a.iter().zip(b).map(|(a, b)| (*a - *b + 0.0).to_array()).collect() };
                targets.push(json!({
                    "POSITION": buffer.floats(Usage::Vertices, &less(&shape.positions, &base.positions), true),
                    "NORMAL": buffer.floats(Usage::Vertices, &less(&shape.normals, &base.normals), false),
                }));
            }
            let attributes = given_shape(&base.positions, &base.normals, buffer);
            let scene = &self.document.scene;
            let shaped = sinew_scene::Mesh { positions: base.positions.clone(), ..(*surface.mesh).clone() };
            let primitives = primitives(
                scene,
                &shaped,
                &surface.materials,
                &attributes,
                &targets,
                MeshSides::default(),
                &mut IndexAccessors::default(),
                materials,
                buffer,
                losses,
            );
            if primitives.is_empty() {
                continue;
            }
            let name = scene.graph.label(surface.node).plain().into_owned();
            let mut mesh = json!({"name": name, "primitives": primitives});
            if !targets.is_empty() {
                mesh["weights"] = json!(vec![0.0; targets.len()]);
            }
            meshes.push(mesh);
            nodes.push(json!({"name": name, "mesh": meshes.len() - 1}));
            written.push((nodes.len() - 1, place.bone));
            self.weights(nodes.len() - 1, &keyed, animations, buffer);
        }
        written
    }

    /// At each key its own target counts whole, and in between the two neighbours mix.
    fn weights(&self, node: usize, keyed: &[Vec<(f32, Vec<MuscleShape>)>], animations: &mut [Animation], buffer: &mut Buffer) {
        let all: usize = keyed.iter().map(Vec::len).sum();
        let mut before = 0;
        for (keys, animation) in keyed.iter().zip(animations) {
            if !keys.is_empty() {
                let times: Vec<f32> = keys.iter().map(|(time, _)| *time).collect();
                let mut values = vec![0.0_f32; all * keys.len()];
                for key in 0..keys.len() {
                    values[key * all + before + key] = 1.0;
                }
                let (input, output) = (buffer.scalars(&times, true), buffer.scalars(&values, false));
                animation.add(node, "weights", input, output, "LINEAR");
            }
            before += keys.len();
        }
    }

    /// The shapes of all muscles at so many moments of a take that the straight way between them is nowhere off by more than `length`, the worst stretches
    /// halved first; no more than `most` moments, and none where that is less than the two ends. `rough` where that was too few.
    fn keys(&mut self, range: &AnimationRange, length: f32, most: usize, rough: &mut bool) -> Vec<(f32, Vec<MuscleShape>)> {
        if self.surfaces.is_empty() {
            return Vec::new();
        }
        if most < 2 {
            *rough = true;
            return Vec::new();
        }
        let document = self.document;
        let when = range.moments(document);
        let ends = [when.first(), when.last()].into_iter().flatten().copied();
        let mut keys: Vec<(KeyTime, Vec<MuscleShape>)> = ends.map(|moment| (moment, self.at(&range.state(document, moment.at)))).collect();
        if keys.len() == 2 && keys[0].0 == keys[1].0 {
            keys.pop();
        }
        let mut open: Vec<KeyInterval> = Vec::new();
        if keys.len() == 2 {
            open.push(self.stretch(range, &keys, 0, 1));
        }
        loop {
            let worst = (0..open.len()).max_by(|a, b| open[*a].error.total_cmp(&open[*b].error));
            let Some(worst) = worst.filter(|worst| open[*worst].error > length) else { break };
            if keys.len() >= most {
                *rough = true;
                break;
            }
            let KeyInterval { from, to, middle, .. } = open.swap_remove(worst);
            if middle.0.written <= keys[from].0.written || middle.0.written >= keys[to].0.written {
                continue;
            }
            keys.push(middle);
            let new = keys.len() - 1;
            open.push(self.stretch(range, &keys, from, new));
            open.push(self.stretch(range, &keys, new, to));
        }
        keys.sort_by(|a, b| a.0.written.total_cmp(&b.0.written));
        keys.into_iter().map(|(moment, shapes)| (moment.written, shapes)).collect()
    }

    fn stretch(&mut self, range: &AnimationRange, keys: &[(KeyTime, Vec<MuscleShape>)], from: usize, to: usize) -> KeyInterval {
        let ((start, first), (end, last)) = (&keys[from], &keys[to]);
        let at = |part: f64| start.at + (end.at - start.at) * part;
        let [quarter, middle, rest] = [0.25, 0.5, 0.75].map(|part| self.at(&range.state(self.document, at(part))));
        let off = off(first, last, 0.25, &quarter).max(off(first, last, 0.5, &middle)).max(off(first, last, 0.75, &rest));
        let moment = KeyTime { at: at(0.5), written: start.written + (end.written - start.written) * 0.5 };
        KeyInterval { from, to, error: off, middle: (moment, middle) }
    }
}

/// Deviation of shapes from the linear interpolation of two others, metres.
fn off(from: &[MuscleShape], to: &[MuscleShape], part: f32, shapes: &[MuscleShape]) -> f32 {
    let muscle = |((from, to), shape): ((&MuscleShape, &MuscleShape), &MuscleShape)| {
        let vertices = from.positions.iter().zip(&to.positions).zip(&shape.positions);
        vertices.map(|((from, to), here)| (from.lerp(*to, part) - *here).length()).fold(0.0, f32::max) * shape.scale
    };
    from.iter().zip(to).zip(shapes).map(muscle).fold(0.0, f32::max)
}
