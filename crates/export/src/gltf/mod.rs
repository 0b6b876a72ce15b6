//! Export of the whole document as glTF 2.0: node tree, meshes, skins, morphs, materials, images, cameras, lights and animations; muscles and the skin
//! that follows them as a few morph targets each.
//!
//! What both formats express alike is written unchanged: values of nodes, LINEAR and STEP keys, Bézier translations at thirds as cubic splines.
//! Everything else is taken from the same sampler that draws, with keys wherever interpolation between two deviates by more than [`MAX_ERROR`] of the scene's diagonal
//! or 2·10⁻⁵ radians. What cannot be written is reported as an [`UnsupportedFeature`].

mod animations;
mod buffer;
mod container;
mod following_skins;
mod keyframe_reduction;
mod materials;
mod muscles;
mod shape_basis;
mod shape_sampling;
mod spline;
mod surfaces;
mod symmetric_eigen;
mod trs;
mod unsupported_features;

pub use unsupported_features::UnsupportedFeature;

use std::path::Path;

use glam::{DMat4, Vec3};
use rustc_hash::{FxHashMap, FxHashSet};
use serde_json::{Value, json};

use self::animations::{Animation, AnimationRange, Stage, Weights};
use self::buffer::{Buffer, ENTRY};
use self::following_skins::{FollowingSkins, WrittenSkin, WrittenSkins};
use self::materials::GltfMaterials;
use self::muscles::Muscles;
use self::surfaces::{SkinBone, Surfaces, bones};
use self::trs::Placing;
use super::ExportError;
use sinew_engine::document::{Document, PoseBuffers};
use sinew_engine::output::Output;
use sinew_engine::output::{self, PendingFile};
use sinew_scene::animation::Pose;
use sinew_scene::{Content, Deformer, Frame, LightKind, Mesh, MeshInstance, MorphId, NodeId, Projection, SurfaceGeometry};

/// Largest distance, in diagonals of the scene, that sampled movement is off.
pub const MAX_ERROR: f64 = 2e-5;

/// The two forms of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GltfContainer {
    /// `.glb`: one binary file.
    Binary,
    /// `.gltf`: JSON, with the binary part inside as base64.
    Text,
}

impl GltfContainer {
    /// The form that a file name's ending asks for.
    pub fn of(file: &Path) -> Option<Self> {
        let ending = file.extension()?.to_string_lossy().to_lowercase();
        match ending.as_str() {
            "glb" => Some(Self::Binary),
            "gltf" => Some(Self::Text),
            _ => None,
        }
    }
}

/// Writes the document to `file` atomically and returns what the format cannot express.
///
/// # Errors
/// [`ExportError`] where the file cannot be written, where converting would take more than [`sinew_scene::limits::CONVERTED_BYTES`], or where the file would be larger
/// than the 4 GiB that the binary form can be.
pub fn save(file: &Output, form: GltfContainer, document: &Document) -> Result<Vec<UnsupportedFeature>, ExportError> {
    let (pending, unsupported) = prepare(file, form, document)?;
    pending.commit()?;
    Ok(unsupported)
}

/// As [`save`], but the caller commits the file.
///
/// # Errors
/// As [`save`].
pub fn prepare(file: &Output, form: GltfContainer, document: &Document) -> Result<(PendingFile, Vec<UnsupportedFeature>), ExportError> {
    let (mut root, bytes, unsupported) = GltfWriter::new(document).write().map_err(|why| why.about(file.file()))?;
    let pending = output::prepare(file, |out| match form {
        GltfContainer::Binary => container::binary(out, &root, &bytes),
        GltfContainer::Text => container::text(out, &mut root, &bytes),
    })?;
    Ok((pending, unsupported))
}

/// What the format cannot express of the document, without writing a file; empty where the document cannot be converted.
pub fn unsupported_features(document: &Document) -> Vec<UnsupportedFeature> {
    GltfWriter::new(document).write().map(|(_, _, unsupported)| unsupported).unwrap_or_default()
}

/// Why a document is not converted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum NotConverted {
    /// It would take more than [`sinew_scene::limits::CONVERTED_BYTES`].
    TooMuch,
    /// The system gives no memory for it.
    OutOfMemory,
}

impl NotConverted {
    fn about(self, file: &Path) -> ExportError {
        match self {
            Self::TooMuch => ExportError::TooMuch { file: file.to_owned() },
            Self::OutOfMemory => ExportError::io(file, std::io::ErrorKind::OutOfMemory.into()),
        }
    }
}

/// The parts of a glTF file under construction.
struct GltfWriter<'a> {
    document: &'a Document,
    buffer: Buffer,
    materials: GltfMaterials,
    surfaces: Surfaces,
    nodes: Vec<Value>,
    /// For each node of the scene: the written node that its parent holds, and the one that holds what hangs on it (another only where it shears).
    places: Vec<(usize, usize)>,
    /// How each node rests.
    rest: Vec<Placing>,
    roots: Vec<usize>,
    lights: Vec<Value>,
    cameras: Vec<Value>,
    /// Nodes with a skin that mirrors at the start.
    mirrored: FxHashSet<NodeId>,
    /// Surfaces that the format cannot bend, as they stand at the start: by node and place among its contents.
    still: FxHashMap<(NodeId, usize), (Vec<Vec3>, Vec<Vec3>)>,
    /// Skinned meshes, which may follow muscles.
    skinned: WrittenSkins,
    /// Written nodes with morphs.
    morphed: Vec<(usize, Vec<MorphId>)>,
    unsupported: Vec<UnsupportedFeature>,
}

impl<'a> GltfWriter<'a> {
    fn new(document: &'a Document) -> Self {
        Self {
            document,
            buffer: Buffer::default(),
            materials: GltfMaterials::default(),
            surfaces: Surfaces::default(),
            nodes: Vec::new(),
            places: Vec::new(),
            rest: Vec::new(),
            roots: Vec::new(),
            lights: Vec::new(),
            cameras: Vec::new(),
            mirrored: FxHashSet::default(),
            still: FxHashMap::default(),
            skinned: WrittenSkins::default(),
            morphed: Vec::new(),
            unsupported: Vec::new(),
        }
    }

    /// The JSON, the buffer and what got lost.
    fn write(mut self) -> Result<(Value, Vec<u8>, Vec<UnsupportedFeature>), NotConverted> {
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        self.document.pose(&self.document.start_state(), &mut buffers, &mut frame);
        let length = f64::from(frame.bounds.diagonal()) * MAX_ERROR;
        self.mirrored = frame.surfaces.iter().filter(|surface| surface.mirrored).map(|surface| surface.node).collect();
        for surface in &frame.surfaces {
            let content = self.document.scene.graph.node(surface.node).contents.get(surface.content as usize);
            if let (Some(Content::Mesh(instance)), SurfaceGeometry::Deformed { positions, normals }) = (content, &surface.geometry)
                && instance.mixes_skins()
            {
                self.still.insert((surface.node, surface.content as usize), (positions.clone(), normals.clone()));
            }
        }
        drop((buffers, frame.surfaces));
        self.write_nodes();
        self.write_contents()?;
        let ranges = AnimationRange::all(self.document);
        let mut animations: Vec<Animation> = ranges.iter().map(|_| Animation::default()).collect();
        let scales = self.scales(&frame.world);
        let nodes: Vec<(usize, Placing)> = self.places.iter().map(|place| place.0).zip(self.rest.iter().copied()).collect();
        let nodes_writer = Stage { document: self.document, nodes: &nodes, length, scales: &scales };
        let mut pose = Pose::rest(&self.document.scene);
        for (range, animation) in ranges.iter().zip(&mut animations) {
            nodes_writer.write(range, &mut pose, animation, &mut self.buffer, &mut self.unsupported);
            for (node, morphs) in &self.morphed {
                if self.buffer.is_full() {
                    return Err(NotConverted::TooMuch);
                }
                Weights { node: *node, morphs }.write(self.document, range, animation, &mut self.buffer);
            }
        }
        FollowingSkins::new(self.document, &ranges, &self.skinned, &mut self.unsupported).write(
            &mut animations,
            &mut self.nodes,
            &mut self.surfaces.meshes,
            &mut self.buffer,
            &mut self.unsupported,
        );
        let muscles = Muscles::new(self.document, &ranges).write(
            &mut animations,
            &mut self.nodes,
            &mut self.surfaces.meshes,
            &mut self.materials,
            &mut self.buffer,
            &mut self.unsupported,
        );
        for (node, bone) in muscles {
            match bone.and_then(|bone| self.places.get(bone.index())) {
                Some(&(_, place)) => self.add_child(place, node),
                None => self.roots.push(node),
            }
        }
        if self.buffer.is_full() {
            return Err(NotConverted::TooMuch);
        }
        // One thing may be met in several clips or on several meshes; it is told once, where it was first met.
        let mut reported = FxHashSet::default();
        self.unsupported.retain(|feature| reported.insert(feature.clone()));
        let animations = ranges.iter().zip(animations).filter_map(|(range, animation)| animation.value(range)).collect();
        Ok(self.assemble(animations))
    }

    /// World scale above each node, the cube root of the volume that its parent's matrix makes of a unit cube.
    fn scales(&self, world: &[DMat4]) -> Vec<f64> {
        let graph = &self.document.scene.graph;
        let above = |(_, node): (NodeId, &sinew_scene::Node)| node.parent().and_then(|parent| world.get(parent.index()));
        graph.iter().map(|node| above(node).map_or(1.0, |matrix| matrix.determinant().abs().cbrt())).collect()
    }

    /// The tree with its transforms at rest.
    fn write_nodes(&mut self) {
        let graph = &self.document.scene.graph;
        let mut moving = vec![false; graph.len()];
        for channel in self.document.clips.iter().flat_map(|clip| &clip.channels) {
            if let sinew_scene::animation::ChannelTarget::Transform { node, .. } = channel.target
                && let Some(moving) = moving.get_mut(node.index())
            {
                *moving = true;
            }
        }
        self.buffer.spend(graph.len() * ENTRY);
        for ((id, node), moves) in graph.iter().zip(moving) {
            let matrix = finite_or_zero(&node.transform.matrix());
            let (placing, sheared) = Placing::of(&matrix);
            let outer = self.nodes.len();
            let mut value = json!({"name": graph.label(id).plain()});
            let inner = if sheared && !moves {
                let (first, second) = trs::split(&matrix);
                first.write(&mut value);
                self.nodes.push(value);
                let mut below = json!({"name": format!("{} ·", graph.label(id).plain())});
                second.write(&mut below);
                self.nodes.push(below);
                self.nodes[outer]["children"] = json!([outer + 1]);
                self.rest.push(first);
                outer + 1
            } else {
                placing.write(&mut value);
                self.nodes.push(value);
                self.rest.push(placing);
                outer
            };
            self.places.push((outer, inner));
            match node.parent().and_then(|parent| self.places.get(parent.index())) {
                Some(&(_, above)) => self.add_child(above, outer),
                None => self.roots.push(outer),
            }
            debug_assert_eq!(self.places.len(), id.index() + 1);
        }
    }

    fn add_child(&mut self, parent: usize, child: usize) {
        match self.nodes[parent]["children"].as_array_mut() {
            Some(children) => children.push(child.into()),
            None => self.nodes[parent]["children"] = json!([child]),
        }
    }

    /// The written node that holds one more thing of a kind that a node can hold once: the node itself, or a new one below it.
    fn holder(&mut self, node: NodeId, kind: &str) -> usize {
        let Some(&(_, place)) = self.places.get(node.index()) else { return 0 };
        if self.nodes[place].get(kind).is_none() {
            return place;
        }
        let name = self.nodes[place]["name"].clone();
        self.nodes.push(json!({"name": name}));
        let new = self.nodes.len() - 1;
        self.add_child(place, new);
        new
    }

    fn write_contents(&mut self) -> Result<(), NotConverted> {
        let document = self.document;
        for (id, node) in document.scene.graph.iter() {
            for (place, content) in node.contents.iter().enumerate() {
                self.buffer.spend(ENTRY);
                if self.buffer.is_full() {
                    return Err(NotConverted::TooMuch);
                }
                match content {
                    Content::Mesh(instance) => match self.still.remove(&(id, place)) {
                        Some(posed) => self.write_rigid_mesh(id, instance, &posed),
                        None => self.write_mesh((id, place), instance),
                    },
                    Content::Light(light) => self.write_light(id, light.index()),
                    Content::Camera(camera) => self.write_camera(id, camera.index()),
                    Content::Muscle(_) => {}
                }
            }
        }
        if self.surfaces.out_of_memory { Err(NotConverted::OutOfMemory) } else { Ok(()) }
    }

    /// A surface in the world, at the root.
    fn write_rigid_mesh(&mut self, node: NodeId, instance: &MeshInstance, (positions, normals): &(Vec<Vec3>, Vec<Vec3>)) {
        let scene = &self.document.scene;
        let Some(mesh) = scene.meshes.get(instance.mesh.index()) else { return };
        let posed = Mesh { positions: positions.clone(), normals: normals.clone(), ..Mesh::clone(mesh) };
        let mirrored = self.mirrored.contains(&node);
        let bindings = &instance.materials;
        let made = self.surfaces.still(scene, &posed, bindings, mirrored, &mut self.materials, &mut self.buffer, &mut self.unsupported);
        if let Some(number) = made {
            self.nodes.push(json!({"name": scene.graph.label(node).plain(), "mesh": number}));
            self.roots.push(self.nodes.len() - 1);
            self.unsupported.push(UnsupportedFeature::Mixed { mesh: mesh.label().plain().into_owned() });
        }
    }

    fn write_mesh(&mut self, (node, content): (NodeId, usize), instance: &MeshInstance) {
        let scene = &self.document.scene;
        let mirrored = instance.is_skinned() && self.mirrored.contains(&node);
        let made = self.surfaces.mesh(scene, instance, mirrored, &mut self.materials, &mut self.buffer, &mut self.unsupported);
        let (Some(number), Some(mesh)) = (made, scene.meshes.get(instance.mesh.index())) else { return };
        let skin = instance.deformers.iter().find_map(|deformer| match deformer {
            Deformer::Skin { skin, joints } => Some((*skin, scene.skins.get(skin.index())?, joints)),
            Deformer::Morph(_) => None,
        });
        let holder = match skin {
            // The place of a skinned mesh means nothing, so it stands at the root, as the format advises.
            Some((id, skin, joints)) => {
                let mut root = node;
                while let Some(parent) = scene.graph.node(root).parent() {
                    root = parent;
                }
                let bones = bones(skin, mesh, joints, root, node);
                let joints = self.joint_nodes(&bones);
                let skin = self.surfaces.skin((instance.mesh, id), &skin.label().plain(), &joints, &bones, &mut self.buffer);
                self.nodes.push(json!({"name": scene.graph.label(node).plain(), "skin": skin}));
                self.roots.push(self.nodes.len() - 1);
                let holder = self.nodes.len() - 1;
                self.skinned.insert((node, content), WrittenSkin { holder, bones });
                holder
            }
            None => self.holder(node, "mesh"),
        };
        self.nodes[holder]["mesh"] = number.into();
        let morphs: Vec<MorphId> = instance
            .deformers
            .iter()
            .filter_map(|deformer| match deformer {
                Deformer::Morph(id) => Some(*id),
                Deformer::Skin { .. } => None,
            })
            .collect();
        if !morphs.is_empty() {
            self.morphed.push((holder, morphs));
        }
    }

    /// The written nodes of a skin's joints. The format wants each once in a skin, so a second use gets a node of its own below the first.
    fn joint_nodes(&mut self, bones: &[SkinBone]) -> Vec<usize> {
        let mut taken = FxHashSet::default();
        bones
            .iter()
            .map(|bone| {
                let place = self.places.get(bone.node.index()).map_or(0, |place| place.1);
                if taken.insert(place) {
                    return place;
                }
                let name = self.nodes[place]["name"].clone();
                self.nodes.push(json!({"name": name}));
                let new = self.nodes.len() - 1;
                self.add_child(place, new);
                new
            })
            .collect()
    }

    fn write_light(&mut self, node: NodeId, light: usize) {
        let Some(light) = self.document.scene.lights.get(light) else { return };
        let kind = match light.kind {
            LightKind::Ambient => {
                self.unsupported.push(UnsupportedFeature::AmbientLight { name: light.label().plain().into_owned() });
                return;
            }
            LightKind::Directional => json!({"type": "directional"}),
            LightKind::Point => json!({"type": "point"}),
            LightKind::Spot { falloff_angle, .. } => {
                let half = (falloff_angle.to_radians() / 2.0).clamp(0.01, std::f32::consts::FRAC_PI_2);
                json!({"type": "spot", "spot": {"innerConeAngle": 0.0, "outerConeAngle": half}})
            }
        };
        let mut value = kind;
        value["name"] = light.label().plain().into();
        // Colours of lights are linear in both formats; what is brighter than 1 goes into the intensity.
        let brightest = light.color.max_element().max(1.0);
        let color = (light.color / brightest).clamp(Vec3::ZERO, Vec3::ONE);
        value["color"] = json!(if color.is_finite() { color.to_array() } else { [1.0; 3] });
        value["intensity"] = json!(if brightest.is_finite() { brightest } else { 1.0 });
        self.lights.push(value);
        let number = self.lights.len() - 1;
        let holder = self.holder(node, "extensions");
        self.nodes[holder]["extensions"] = json!({"KHR_lights_punctual": {"light": number}});
    }

    fn write_camera(&mut self, node: NodeId, camera: usize) {
        let Some(camera) = self.document.scene.cameras.get(camera) else { return };
        let near = if camera.near.is_finite() && camera.near > 0.0 { camera.near } else { 0.01 };
        let far = if camera.far.is_finite() && camera.far > near { camera.far } else { near * 1e4 };
        let aspect = camera.aspect.filter(|aspect| aspect.is_finite() && *aspect > 0.0);
        let mut value = match camera.projection {
            Projection::Perspective { fov_y } => {
                let fov_y = if fov_y.is_finite() { fov_y.clamp(0.01, 3.1) } else { 0.7 };
                let mut lens = json!({"yfov": fov_y, "znear": near, "zfar": far});
                if let Some(aspect) = aspect {
                    lens["aspectRatio"] = aspect.into();
                }
                json!({"type": "perspective", "perspective": lens})
            }
            Projection::Orthographic { height } => {
                let half = if height.is_finite() && height > 0.0 { height / 2.0 } else { 1.0 };
                json!({"type": "orthographic", "orthographic": {"ymag": half, "xmag": half * aspect.unwrap_or(1.0), "znear": near, "zfar": far}})
            }
        };
        value["name"] = camera.label().plain().into();
        self.cameras.push(value);
        let number = self.cameras.len() - 1;
        let holder = self.holder(node, "camera");
        self.nodes[holder]["camera"] = number.into();
    }

    fn assemble(self, animations: Vec<Value>) -> (Value, Vec<u8>, Vec<UnsupportedFeature>) {
        let mut root = json!({
            "asset": {"version": "2.0", "generator": format!("Sinew {}", env!("CARGO_PKG_VERSION"))},
            "scene": 0,
            "scenes": [{"nodes": self.roots}],
        });
        if self.roots.is_empty() {
            root["scenes"] = json!([{}]);
        }
        let lists = [
            ("nodes", self.nodes),
            ("meshes", self.surfaces.meshes),
            ("skins", self.surfaces.skins),
            ("materials", self.materials.materials.clone()),
            ("textures", self.materials.textures.clone()),
            ("samplers", self.materials.samplers.clone()),
            ("images", self.materials.images.clone()),
            ("cameras", self.cameras),
            ("animations", animations),
            ("accessors", self.buffer.accessors),
            ("bufferViews", self.buffer.views),
        ];
        for (name, list) in lists {
            if !list.is_empty() {
                root[name] = list.into();
            }
        }
        if !self.buffer.bytes.is_empty() {
            root["buffers"] = json!([{"byteLength": self.buffer.bytes.len()}]);
        }
        let mut extensions = Vec::new();
        if self.materials.uses_unlit() {
            extensions.push("KHR_materials_unlit");
        }
        if self.materials.uses_transform() {
            extensions.push("KHR_texture_transform");
        }
        if !self.lights.is_empty() {
            extensions.push("KHR_lights_punctual");
            root["extensions"] = json!({"KHR_lights_punctual": {"lights": self.lights}});
        }
        if !extensions.is_empty() {
            root["extensionsUsed"] = extensions.into();
        }
        (root, self.buffer.bytes, self.unsupported)
    }
}

/// A matrix without infinities, which the format does not allow.
fn finite_or_zero(matrix: &DMat4) -> DMat4 {
    if matrix.as_mat4().is_finite() { *matrix } else { DMat4::IDENTITY }
}
