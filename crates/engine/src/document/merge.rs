//! Puts a loaded file beside what is already open: every id moves up by the number of things before it.

use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::Document;
use super::Finding;
use sinew_scene::animation::{Channel, ChannelTarget, Clip};
use sinew_scene::import::{AnyFinding, ImportedScene};
use sinew_scene::message::SourceName;
use sinew_scene::{
    CameraId, Content, Deformer, ImageId, LightId, Material, MaterialBinding, MaterialId, MeshId, MorphId, NodeId, Scene, SkinId,
};

/// Materials of the parts of an instance.
type MaterialList = Arc<[Option<MaterialBinding>]>;

/// How far each kind of id moves.
struct IdOffsets {
    node: u32,
    mesh: u32,
    skin: u32,
    morph: u32,
    material: u32,
    image: u32,
    light: u32,
    camera: u32,
}

impl IdOffsets {
    fn past(scene: &Scene) -> Self {
        Self {
            node: scene.graph.len() as u32,
            mesh: scene.meshes.len() as u32,
            skin: scene.skins.len() as u32,
            morph: scene.morphs.len() as u32,
            material: scene.materials.len() as u32,
            image: scene.images.len() as u32,
            light: scene.lights.len() as u32,
            camera: scene.cameras.len() as u32,
        }
    }

    fn node(&self, id: NodeId) -> NodeId {
        NodeId(id.0 + self.node)
    }

    /// `moved`: lists of materials that instances share, by their address before, with what becomes of them.
    fn content(&self, content: &mut Content, moved: &mut FxHashMap<*const Option<MaterialBinding>, (MaterialList, MaterialList)>) {
        match content {
            Content::Mesh(instance) => {
                instance.mesh = MeshId(instance.mesh.0 + self.mesh);
                let (_, materials) = moved.entry(instance.materials.as_ptr()).or_insert_with(|| {
                    let mut materials = instance.materials.to_vec();
                    materials.iter_mut().flatten().for_each(|binding| self.binding(binding));
                    // The old list is kept, so that its address stays its own.
                    (Arc::clone(&instance.materials), materials.into())
                });
                instance.materials = Arc::clone(materials);
                for deformer in &mut instance.deformers {
                    match deformer {
                        Deformer::Morph(morph) => *morph = MorphId(morph.0 + self.morph),
                        Deformer::Skin { skin, joints } => self.skin(skin, joints),
                    }
                }
                for target in &mut instance.skinned_targets {
                    target.morph = MorphId(target.morph.0 + self.morph);
                    self.skin(&mut target.skin, &mut target.joints);
                }
            }
            Content::Light(id) => *id = LightId(id.0 + self.light),
            Content::Camera(id) => *id = CameraId(id.0 + self.camera),
            Content::Muscle(_) => {}
        }
    }

    fn skin(&self, skin: &mut SkinId, joints: &mut [Option<NodeId>]) {
        *skin = SkinId(skin.0 + self.skin);
        for joint in joints.iter_mut().flatten() {
            *joint = self.node(*joint);
        }
    }

    fn binding(&self, binding: &mut MaterialBinding) {
        binding.material = MaterialId(binding.material.0 + self.material);
    }

    fn material(&self, material: &mut Material) {
        let paints = [&mut material.diffuse, &mut material.emission, &mut material.ambient, &mut material.specular];
        let textures = paints.into_iter().filter_map(|paint| paint.texture.as_mut());
        for texture in textures.chain(material.opacity_texture.as_mut().map(|(texture, _)| texture)) {
            texture.image = ImageId(texture.image.0 + self.image);
        }
    }

    fn target(&self, target: &mut ChannelTarget) {
        match target {
            ChannelTarget::Transform { node, .. } => *node = self.node(*node),
            ChannelTarget::MorphWeight { morph, .. } => *morph = MorphId(morph.0 + self.morph),
            ChannelTarget::Material { material, .. } => *material = MaterialId(material.0 + self.material),
            ChannelTarget::LightColor { light, .. } => *light = LightId(light.0 + self.light),
        }
    }
}

/// Appends a file to the document and returns its root node.
pub(super) fn append(document: &mut Document, imported: ImportedScene<AnyFinding>, name: &SourceName) -> Option<NodeId> {
    let ImportedScene { mut scene, clips, findings, .. } = imported;
    document.diagnostics.extend(findings.into_iter().map(|found| {
        // A document inside an archive is named behind it.
        let file = match found.file.path() {
            None => name.clone(),
            Some(part) => SourceName::from(format!("{name}/{part}")),
        };
        found.map(Finding::Reader).in_file(file)
    }));
    if is_empty(&document.scene) && document.clips.is_empty() {
        // The first one stays as it is, and is not held twice on the way.
        let root = scene.graph.roots().first().copied();
        (document.scene, document.clips) = (scene, clips);
        return root;
    }
    let offsets = IdOffsets::past(&document.scene);
    let root = scene.graph.roots().first().map(|root| offsets.node(*root));
    let into = &mut document.scene;
    let mut moved = FxHashMap::default();
    for (parent, mut node) in std::mem::take(&mut scene.graph).into_nodes() {
        node.contents.iter_mut().for_each(|content| offsets.content(content, &mut moved));
        into.graph.add(parent.map(|parent| offsets.node(parent)), node);
    }
    scene.materials.iter_mut().for_each(|material| offsets.material(material));
    into.meshes.append(&mut scene.meshes);
    into.skins.append(&mut scene.skins);
    into.morphs.append(&mut scene.morphs);
    into.materials.append(&mut scene.materials);
    into.images.append(&mut scene.images);
    into.lights.append(&mut scene.lights);
    into.cameras.append(&mut scene.cameras);
    document.clips.extend(clips.into_iter().map(|clip| offset_clip(clip, &offsets)));
    root
}

fn is_empty(scene: &Scene) -> bool {
    scene.graph.is_empty() && scene.meshes.is_empty() && scene.materials.is_empty() && scene.images.is_empty()
}

fn offset_clip(clip: Clip, offsets: &IdOffsets) -> Clip {
    let channels = clip.channels.into_iter().map(|Channel { mut target, curve }| {
        offsets.target(&mut target);
        Channel { target, curve }
    });
    Clip { channels: channels.collect(), ..clip }
}
