//! What hangs on nodes: meshes with their controllers and materials, lights, cameras.

use std::sync::Arc;

use glam::DMat4;
use rustc_hash::{FxHashMap, FxHashSet};

use super::bind_pose::Bound;
use super::context::{Context, ReadResult, child, children, text_of};
use super::controller::{Chain, Controllers, Link, Sources};
use super::geometry::{Geometries, PlacedMesh};
use super::light_camera::LightsAndCameras;
use super::material::Materials;
use super::nodes::{Instance, Tree};
use super::skin::JointFinder;
use super::{Asset, El, Finding};
use sinew_scene::limits;
use sinew_scene::{Content, Deformer, MaterialBinding, Mesh, MeshId, MeshInstance, NodeId, NodeKind, Part, Scene, SkinId, SkinnedTarget};

/// What a binding of one part or joint takes, roughly, for the budget.
const BINDING_BYTES: usize = 64;
/// What one thing on a node takes, roughly.
const CONTENT_BYTES: usize = 256;
/// What drawing an instance takes: for each part, each triangle, each vertex as it is, each vertex that is deformed, each joint.
const PART_BYTES: usize = 4_096;
const TRIANGLE_BYTES: usize = 16;
const VERTEX_BYTES: usize = 48;
const DEFORMED_BYTES: usize = 96;
const JOINT_BYTES: usize = 256;

/// What an instance binds: a symbol, and the material that it means.
type Bindings<'a> = Vec<(&'a str, Option<MaterialBinding>)>;

/// The materials of the parts of a mesh, and the first symbol that is bound to nothing.
#[derive(Clone)]
struct Dressed {
    materials: Arc<[Option<MaterialBinding>]>,
    unbound: Option<String>,
}

/// What instances have in common and what is left for them.
pub(super) struct Sharing<'a> {
    /// Materials of the parts of a mesh, by what is bound.
    dressed: FxHashMap<(MeshId, Bindings<'a>), Dressed>,
    /// Meshes that hang somewhere.
    hung: FxHashSet<MeshId>,
    /// Bytes that drawing further instances may take.
    left: usize,
}

impl Default for Sharing<'_> {
    fn default() -> Self {
        Self { dressed: FxHashMap::default(), hung: FxHashSet::default(), left: limits::INSTANCES_BYTES }
    }
}

/// Everything that instances refer to.
pub(super) struct Libraries<'s, 'a> {
    /// The meshes.
    pub geometries: &'s mut Geometries,
    /// Skins and morphs.
    pub controllers: &'s mut Controllers<'a>,
    /// The materials.
    pub materials: &'s Materials<'a>,
    /// Lights and cameras.
    pub lights: &'s mut LightsAndCameras,
    /// The nodes.
    pub tree: &'s Tree<'a>,
    /// Unit and axes of the document.
    pub asset: &'s Asset,
    /// Where the nodes are at rest, in the document's own unit and axes.
    pub rest: Vec<DMat4>,
    /// What instances share.
    pub sharing: Sharing<'a>,
}

impl<'a> Libraries<'_, 'a> {
    /// Hangs everything on its node.
    ///
    /// # Errors
    /// Where commas separate numbers, or on cancel.
    pub(super) fn hang_all(&mut self, context: &mut Context<'a>, scene: &mut Scene) -> ReadResult<()> {
        let total = self.tree.instances.len().max(1);
        for (done, instance) in self.tree.instances.iter().enumerate() {
            context.advance(0.4 + 0.4 * done as f32 / total as f32)?;
            if !context.spend(instance.element, CONTENT_BYTES) {
                break;
            }
            if let Some(content) = self.content(context, scene, instance)?
                && self.may_be_drawn(context, scene, instance.element, &content)
            {
                let contents = &mut scene.graph.node_mut(instance.node).contents;
                // Most nodes hold one thing.
                if contents.is_empty() {
                    contents.reserve_exact(1);
                }
                contents.push(content);
            }
        }
        Ok(())
    }

    /// Takes what drawing an instance will need from what is left. The first of each mesh costs the file enough by itself.
    fn may_be_drawn(&mut self, context: &mut Context<'a>, scene: &Scene, element: El<'a>, content: &Content) -> bool {
        let Content::Mesh(instance) = content else { return true };
        let Some(mesh) = scene.meshes.get(instance.mesh.index()) else { return true };
        if self.sharing.hung.insert(instance.mesh) {
            return true;
        }
        let joints: usize =
            instance.deformers.iter().map(|deformer| if let Deformer::Skin { joints, .. } = deformer { joints.len() } else { 0 }).sum();
        let vertex = if instance.deformers.is_empty() { VERTEX_BYTES } else { DEFORMED_BYTES };
        let bytes =
            mesh.parts.len() * PART_BYTES + mesh.triangles.len() * TRIANGLE_BYTES + mesh.positions.len() * vertex + joints * JOINT_BYTES;
        match self.sharing.left.checked_sub(bytes) {
            Some(left) => {
                self.sharing.left = left;
                true
            }
            None => {
                context.say_once_drawn(element);
                false
            }
        }
    }

    fn content(&mut self, context: &mut Context<'a>, scene: &mut Scene, instance: &Instance<'a>) -> ReadResult<Option<Content>> {
        let element = instance.element;
        Ok(match element.tag_name().name() {
            "instance_light" => match context.follow(element, "url", &["light"]) {
                Some(light) => self.lights.light(context, scene, light)?.map(Content::Light),
                None => None,
            },
            "instance_camera" => match context.follow(element, "url", &["camera"]) {
                Some(camera) => self.lights.camera(context, scene, camera)?.map(Content::Camera),
                None => None,
            },
            "instance_controller" => self.controlled(context, scene, instance)?.map(Content::Mesh),
            // A geometry that is shown without a scene.
            "geometry" => self.plain(context, scene, element, element)?.map(Content::Mesh),
            // A controller under `instance_geometry` is met as well.
            _ => match context.follow(element, "url", &["geometry", "controller"]) {
                Some(geometry) if geometry.tag_name().name() == "geometry" => {
                    self.plain(context, scene, element, geometry)?.map(Content::Mesh)
                }
                Some(_) => self.controlled(context, scene, instance)?.map(Content::Mesh),
                None => None,
            },
        })
    }

    fn plain(
        &mut self,
        context: &mut Context<'a>,
        scene: &mut Scene,
        element: El<'a>,
        geometry: El<'a>,
    ) -> ReadResult<Option<MeshInstance>> {
        let placed = self.geometries.place(context, scene, self.asset, geometry)?;
        Ok(placed.map(|placed| self.dressed(context, scene, element, &placed, Vec::new())))
    }

    fn controlled(&mut self, context: &mut Context<'a>, scene: &mut Scene, instance: &Instance<'a>) -> ReadResult<Option<MeshInstance>> {
        // A morph or geometry under `instance_controller` is met as well.
        let Some(target) = context.follow(instance.element, "url", &["controller", "geometry"]) else { return Ok(None) };
        if target.tag_name().name() == "geometry" {
            return self.plain(context, scene, instance.element, target);
        }
        let mut sources = Sources { scene, geometries: self.geometries, asset: self.asset, tree: self.tree };
        let Some(chain) = self.controllers.chain(context, &mut sources, target)? else { return Ok(None) };
        let (deformers, skinned_targets) = self.deformers(context, scene, instance, &chain);
        let dressed = self.dressed(context, scene, instance.element, &chain.placed, deformers);
        Ok(Some(MeshInstance { skinned_targets, ..dressed }))
    }

    fn deformers(
        &self,
        context: &mut Context<'a>,
        scene: &mut Scene,
        instance: &Instance<'a>,
        chain: &Chain,
    ) -> (Vec<Deformer>, Vec<SkinnedTarget>) {
        // A morph below a skin moves the mesh before any joint does: skins of its targets play no part there.
        let skin = chain.links.iter().rposition(|link| matches!(link, Link::Skin(_))).unwrap_or(0);
        let above = chain.links.get(skin..).unwrap_or_default().iter().filter_map(|link| match link {
            Link::Morph(morph) => Some((*morph, self.controllers.skinned_targets.get(morph.index())?)),
            Link::Skin(_) => None,
        });
        let targets: Vec<_> = above.flat_map(|(morph, shapes)| shapes.iter().map(move |shape| (morph, shape))).collect();
        let mut roots: Vec<NodeId> = Vec::new();
        let has_skin = !targets.is_empty() || chain.links.iter().any(|link| matches!(link, Link::Skin(_)));
        for skeleton in children(instance.element, "skeleton").filter(|_| has_skin) {
            let text = text_of(skeleton);
            let Some(root) = context.resolve(skeleton, text.trim(), &["node", "visual_scene"]) else { continue };
            if root.tag_name().name() == "node" {
                roots.extend(self.tree.nearest(&scene.graph, instance.node, self.tree.nodes_of(root)));
            }
        }
        let mut deformers = Vec::new();
        for link in &chain.links {
            match link {
                Link::Morph(morph) => deformers.push(Deformer::Morph(*morph)),
                Link::Skin(skin) => {
                    let joints = self.joints(context, scene, instance, *skin, &roots);
                    deformers.extend(joints.map(|joints| Deformer::Skin { skin: *skin, joints }));
                }
            }
        }
        let mut skinned = Vec::new();
        for (morph, (shape, skin)) in targets {
            if !context.spend(instance.element, size_of_val(shape.positions.as_slice())) {
                break;
            }
            let joints = self.joints(context, scene, instance, *skin, &roots);
            let positions = || shape.positions.clone();
            skinned.extend(joints.map(|joints| SkinnedTarget { morph, target: shape.target, positions: positions(), skin: *skin, joints }));
        }
        (deformers, skinned)
    }

    /// The nodes of a skin's joints for one instance; `None` where the budget is used up.
    fn joints(
        &self,
        context: &mut Context<'a>,
        scene: &mut Scene,
        instance: &Instance<'a>,
        id: SkinId,
        roots: &[NodeId],
    ) -> Option<Vec<Option<NodeId>>> {
        let skin = scene.skins.get(id.index())?;
        if !context.spend(instance.element, skin.joints.len() * BINDING_BYTES) {
            return None;
        }
        let names = self.controllers.joint_names.get(id.index())?;
        let finder = JointFinder { tree: self.tree, graph: &scene.graph, instance: instance.node, roots };
        let joints = finder.find_all(skin, names.kind);
        let lost: Vec<&str> =
            skin.joints.iter().zip(&joints).filter(|(_, node)| node.is_none()).map(|(joint, _)| joint.name.as_str()).collect();
        if let Some(first) = lost.first() {
            let finding = Finding::JointsNotFound { count: lost.len(), first: super::context::shortened(first) };
            context.report.report(instance.element, finding);
        }
        let bound = Bound { skin, used: &names.used, joints: &joints, node: instance.node };
        if let Some(finding) = bound.mismatch(&scene.graph, &self.rest) {
            context.report.report(instance.element, finding);
        }
        // Exporters that know no joints write plain nodes; what moves a skin is a bone.
        for joint in joints.iter().flatten() {
            let node = scene.graph.node_mut(*joint);
            if node.kind == NodeKind::Node {
                node.kind = NodeKind::Joint;
            }
        }
        Some(joints)
    }

    /// A mesh with its materials.
    fn dressed(
        &mut self,
        context: &mut Context<'a>,
        scene: &Scene,
        element: El<'a>,
        placed: &PlacedMesh,
        deformers: Vec<Deformer>,
    ) -> MeshInstance {
        let bindings = self.bindings(context, element, placed);
        let mesh: Option<&Arc<Mesh>> = scene.meshes.get(placed.mesh.index());
        let parts = mesh.map_or(&[][..], |mesh| &mesh.parts);
        let key = (placed.mesh, bindings);
        let dressed = match self.sharing.dressed.get(&key) {
            Some(known) => known.clone(),
            None => self.dress(context, scene, element, parts, key),
        };
        if let Some(first) = dressed.unbound {
            context.report.report(element, Finding::UnboundMaterial(super::context::shortened(&first)));
        }
        MeshInstance { mesh: placed.mesh, deformers, materials: dressed.materials, skinned_targets: Vec::new() }
    }

    /// The materials of `parts` of a mesh, on which this is bound.
    fn dress(&mut self, context: &mut Context<'a>, scene: &Scene, element: El<'a>, parts: &[Part], key: (MeshId, Bindings<'a>)) -> Dressed {
        let bindings = &key.1;
        let mut bound: FxHashMap<&str, &Option<MaterialBinding>> = FxHashMap::default();
        for (symbol, binding) in bindings {
            bound.entry(symbol).or_insert(binding);
        }
        let mut materials = Vec::new();
        let (mut unbound, mut whole) = (None, true);
        for part in parts {
            if !context.spend(element, BINDING_BYTES) {
                whole = false;
                break;
            }
            let bound = bound.get(part.symbol.as_str()).map(|binding| (*binding).clone());
            let direct = || {
                let material = context.lookup.by_id(element, &part.symbol, &["material"])?;
                self.materials.of(material).map(MaterialBinding::plain)
            };
            let material = match bound {
                Some(bound) => bound,
                // Some exporters name the material itself and bind nothing.
                None if !part.symbol.is_empty() => {
                    let direct = direct();
                    if direct.is_none() && !scene.materials.is_empty() {
                        unbound.get_or_insert(part.symbol.as_str());
                    }
                    direct
                }
                None => None,
            };
            materials.push(material);
        }
        materials.resize(parts.len(), None);
        let dressed = Dressed { materials: materials.into(), unbound: unbound.map(ToOwned::to_owned) };
        if whole && context.spend(element, 2 * BINDING_BYTES * (bindings.len() + 1)) {
            self.sharing.dressed.insert(key, dressed.clone());
        }
        dressed
    }

    /// What an instance binds: symbol to material with its sets of texture coordinates.
    fn bindings(&self, context: &mut Context<'a>, element: El<'a>, placed: &PlacedMesh) -> Bindings<'a> {
        let common = child(element, "bind_material").and_then(|bind| child(bind, "technique_common"));
        let Some(common) = common else { return Vec::new() };
        let mut bindings = Vec::new();
        for instance in children(common, "instance_material") {
            let Some(symbol) = instance.attribute("symbol") else { continue };
            let material = context.follow(instance, "target", &["material"]).and_then(|material| self.materials.of(material));
            let mut uv_sets = Vec::new();
            for bind in children(instance, "bind_vertex_input") {
                let input = bind.attribute("input_semantic").unwrap_or("TEXCOORD");
                let set = bind.attribute("input_set").and_then(|set| set.trim().parse::<u32>().ok()).unwrap_or(0);
                if let (Some(semantic), "TEXCOORD" | "UV", Ok(place)) = (bind.attribute("semantic"), input, placed.sets.binary_search(&set))
                {
                    uv_sets.push((semantic.to_owned(), place as u32));
                }
            }
            bindings.push((symbol, material.map(|material| MaterialBinding { material, uv_sets })));
        }
        bindings
    }
}
