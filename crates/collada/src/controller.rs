//! `library_controllers`: chains of skins and morphs over a mesh.

use std::rc::Rc;

use roxmltree::NodeId;
use rustc_hash::FxHashMap;

use super::context::{Context, ReadResult, child};
use super::geometry::{Geometries, PlacedMesh};
use super::morph::{self, MorphTargets, SkinnedShape};
use super::nodes::Tree;
use super::skin::{self, JointNames};
use super::source::Arrays;
use super::{Asset, El, Finding, asset};
use sinew_scene::{MorphId, Scene, SkinId};

/// One step of a chain, from the mesh outwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Link {
    /// A morph.
    Morph(MorphId),
    /// A skin.
    Skin(SkinId),
}

/// A mesh with the controllers over it.
#[derive(Clone)]
pub(super) struct Chain {
    /// The mesh.
    pub placed: PlacedMesh,
    /// The controllers, the first to the mesh itself.
    pub links: Vec<Link>,
}

/// Reads controllers, each once.
#[derive(Default)]
pub(super) struct Controllers<'a> {
    arrays: Arrays<f64>,
    chains: FxHashMap<NodeId, Option<Rc<Chain>>>,
    skins: FxHashMap<NodeId, Option<SkinId>>,
    morphs: FxHashMap<NodeId, Option<MorphId>>,
    /// What the joints of each skin are called, and how to look that up.
    pub joint_names: Vec<JointNames>,
    /// Where each morph's weights stand in the file, for animation.
    pub morph_targets: Vec<MorphTargets<'a>>,
    /// The targets of each morph that have skins of their own, with these skins.
    pub skinned_targets: Vec<Vec<(SkinnedShape<'a>, SkinId)>>,
}

/// What reading a controller needs besides the document.
pub(super) struct Sources<'s, 'a> {
    /// The scene so far.
    pub scene: &'s mut Scene,
    /// The meshes.
    pub geometries: &'s mut Geometries,
    /// Unit and axes of the document.
    pub asset: &'s Asset,
    /// The nodes, for the names of joints.
    pub tree: &'s Tree<'a>,
}

impl<'a> Controllers<'a> {
    /// The chain that starts at a `controller` element; `None`, reported, where it leads to no mesh.
    ///
    /// # Errors
    /// Where commas separate its numbers, or on cancel.
    pub(super) fn chain(
        &mut self,
        context: &mut Context<'a>,
        sources: &mut Sources<'_, 'a>,
        controller: El<'a>,
    ) -> ReadResult<Option<Rc<Chain>>> {
        if let Some(known) = self.chains.get(&controller.id()) {
            return Ok(known.clone());
        }
        let chain = self.read_chain(context, sources, controller)?.map(Rc::new);
        self.chains.insert(controller.id(), chain.clone());
        Ok(chain)
    }

    fn read_chain(&mut self, context: &mut Context<'a>, sources: &mut Sources<'_, 'a>, controller: El<'a>) -> ReadResult<Option<Chain>> {
        let Some((geometry, layers)) = layers(context, controller) else { return Ok(None) };
        let Some(placed) = sources.geometries.place(context, sources.scene, sources.asset, geometry)? else { return Ok(None) };
        let mut links: Vec<Link> = Vec::new();
        // From the mesh outwards.
        for layer in layers.into_iter().rev() {
            if layer.tag_name().name() == "skin" {
                if links.iter().any(|link| matches!(link, Link::Skin(_))) {
                    // Joints place a mesh in the world; a second set of them has nothing left to place.
                    context.report.report(layer, Finding::SecondSkin);
                    continue;
                }
                let points = sources.scene.meshes.get(placed.mesh.index()).map_or(0, |mesh| mesh.source_count as usize);
                links.extend(self.skin(context, sources, layer, points)?.map(Link::Skin));
            } else {
                let morph = match self.morphs.get(&layer.id()) {
                    Some(known) => *known,
                    None => {
                        let morph = self.read_morph(context, sources, layer, &placed)?;
                        self.morphs.insert(layer.id(), morph);
                        morph
                    }
                };
                links.extend(morph.map(Link::Morph));
            }
        }
        Ok(Some(Chain { placed, links }))
    }

    /// The skin of a `skin` element, read the first time.
    fn skin(
        &mut self,
        context: &mut Context<'a>,
        sources: &mut Sources<'_, 'a>,
        element: El<'a>,
        points: usize,
    ) -> ReadResult<Option<SkinId>> {
        if let Some(known) = self.skins.get(&element.id()) {
            return Ok(*known);
        }
        let read = skin::read(context, &mut self.arrays, sources.tree, element, points)?;
        let space = asset::space(context, sources.asset, element);
        let id = read.map(|(mut skin, names)| {
            if let Some(space) = space {
                // Mesh and joints are in the document's unit and axes by now.
                let back = space.inverse();
                skin.bind_shape = space * skin.bind_shape * back;
                skin.joints.iter_mut().for_each(|joint| joint.inverse_bind = space * joint.inverse_bind * back);
            }
            sources.scene.skins.push(skin);
            self.joint_names.push(names);
            SkinId(sources.scene.skins.len() as u32 - 1)
        });
        self.skins.insert(element.id(), id);
        Ok(id)
    }

    fn read_morph(
        &mut self,
        context: &mut Context<'a>,
        sources: &mut Sources<'_, 'a>,
        element: El<'a>,
        placed: &PlacedMesh,
    ) -> ReadResult<Option<MorphId>> {
        let Some(base) = &placed.geometry else { return Ok(None) };
        let Some((morph, mut targets)) = morph::read(context, &mut self.arrays, sources, element, base)? else { return Ok(None) };
        sources.scene.morphs.push(morph);
        let mut skinned = Vec::new();
        for shape in std::mem::take(&mut targets.skinned) {
            let skin = self.skin(context, sources, shape.skin, base.points.len())?;
            skinned.extend(skin.map(|skin| (shape, skin)));
        }
        self.skinned_targets.push(skinned);
        self.morph_targets.push(targets);
        Ok(Some(MorphId(sources.scene.morphs.len() as u32 - 1)))
    }
}

/// Walks from a controller down to its geometry: the `skin` and `morph` elements on the way, the outermost first.
pub(super) fn layers<'a>(context: &mut Context<'a>, controller: El<'a>) -> Option<(El<'a>, Vec<El<'a>>)> {
    let mut layers: Vec<El<'a>> = Vec::new();
    let mut next = controller;
    loop {
        let Some(layer) = child(next, "skin").or_else(|| child(next, "morph")) else {
            context.report.report(next, Finding::EmptyController);
            return None;
        };
        if layers.contains(&layer) {
            context.report.report(layer, Finding::ReferenceCycle);
            return None;
        }
        if !context.spend(layer, 64 * (layers.len() + 1)) {
            return None;
        }
        layers.push(layer);
        let key = if layer.tag_name().name() == "morph" && layer.attribute("source").is_none() { "target" } else { "source" };
        let below = context.follow(layer, key, &["geometry", "controller"])?;
        if below.tag_name().name() == "geometry" {
            return Some((below, layers));
        }
        next = below;
    }
}
