//! What hangs on nodes: meshes with their controllers and materials, lights, cameras.

use std::sync::Arc;

use glam::DMat4;

use super::bind_pose::Bound;
use super::context::{Context, Step, child, children, text_of};
use super::controller::{Chain, Controllers, Link, Sources};
use super::geometry::{Geometries, Placed};
use super::light_camera::LightsAndCameras;
use super::material::Materials;
use super::nodes::{Instance, Tree};
use super::skin::JointFinder;
use super::{Asset, El, codes};
use crate::scene::{Content, Deformer, MaterialBinding, Mesh, MeshInstance, NodeId, NodeKind, Scene, SkinId, SkinnedTarget};
use crate::tr;

/// What a binding of one part or joint takes, roughly, for the budget.
const BINDING_BYTES: usize = 64;
/// What one thing on a node takes, roughly.
const CONTENT_BYTES: usize = 256;

/// Everything that instances refer to.
pub struct Libraries<'s, 'a> {
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
}

impl<'a> Libraries<'_, 'a> {
    /// Hangs everything on its node.
    ///
    /// # Errors
    /// Where commas separate numbers, or on cancel.
    pub fn hang_all(&mut self, context: &mut Context<'a>, scene: &mut Scene) -> Step<()> {
        let total = self.tree.instances.len().max(1);
        for (done, instance) in self.tree.instances.iter().enumerate() {
            context.advance(0.4 + 0.4 * done as f32 / total as f32)?;
            if !context.spend(instance.element, CONTENT_BYTES) {
                break;
            }
            if let Some(content) = self.content(context, scene, instance)? {
                scene.graph.node_mut(instance.node).contents.push(content);
            }
        }
        Ok(())
    }

    fn content(&mut self, context: &mut Context<'a>, scene: &mut Scene, instance: &Instance<'a>) -> Step<Option<Content>> {
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

    fn plain(&mut self, context: &mut Context<'a>, scene: &mut Scene, element: El<'a>, geometry: El<'a>) -> Step<Option<MeshInstance>> {
        let placed = self.geometries.place(context, scene, self.asset, geometry)?;
        Ok(placed.map(|placed| self.dressed(context, scene, element, &placed, Vec::new())))
    }

    fn controlled(&mut self, context: &mut Context<'a>, scene: &mut Scene, instance: &Instance<'a>) -> Step<Option<MeshInstance>> {
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
            let message = tr!("collada-joint-not-found", count = lost.len(), first = super::context::shortened(first));
            context.report.warn(instance.element, codes::JOINT_NOT_FOUND, message);
        }
        let bound = Bound { skin, used: &names.used, joints: &joints, node: instance.node };
        if let Some(message) = bound.mismatch(&scene.graph, &self.rest) {
            context.report.warn(instance.element, codes::BIND_POSE_MISMATCH, message);
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
        &self,
        context: &mut Context<'a>,
        scene: &Scene,
        element: El<'a>,
        placed: &Placed,
        deformers: Vec<Deformer>,
    ) -> MeshInstance {
        let bindings = self.bindings(context, element, placed);
        let mesh: Option<&Arc<Mesh>> = scene.meshes.get(placed.mesh.index());
        let parts = mesh.map_or(&[][..], |mesh| &mesh.parts);
        let mut materials = Vec::new();
        let mut unbound = Vec::new();
        for part in parts {
            if !context.spend(element, BINDING_BYTES) {
                break;
            }
            let bound = bindings.iter().find(|(symbol, _)| *symbol == part.symbol).map(|(_, binding)| binding.clone());
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
                        unbound.push(part.symbol.as_str());
                    }
                    direct
                }
                None => None,
            };
            materials.push(material);
        }
        materials.resize(parts.len(), None);
        if let Some(first) = unbound.first() {
            let message = tr!("collada-unbound-material", symbol = super::context::shortened(first));
            context.report.note(element, codes::UNBOUND_MATERIAL, message);
        }
        MeshInstance { mesh: placed.mesh, deformers, materials, skinned_targets: Vec::new() }
    }

    /// What an instance binds: symbol to material with its sets of texture coordinates.
    fn bindings(&self, context: &mut Context<'a>, element: El<'a>, placed: &Placed) -> Vec<(&'a str, Option<MaterialBinding>)> {
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
