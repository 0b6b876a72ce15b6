//! `library_visual_scenes` and `library_nodes`: the tree of nodes.

use std::collections::HashMap;

use glam::{DMat4, DVec3};
use rustc_hash::FxHashMap;

use super::context::{Context, ReadResult, child, children, id_of, name_of, text_of, vector};
use super::lookup::Url;
use super::{Asset, El, Finding, asset};
use sinew_scene::limits;
use sinew_scene::{Graph, Node, NodeId, NodeKind, Scene, Transform, TransformOp};

/// What a node and one of its operations take, roughly, for the budget.
const NODE_BYTES: usize = 640;
const OP_BYTES: usize = 160;

/// What hangs on a node, to be read when the tree is there.
pub(super) struct Instance<'a> {
    /// The node.
    pub node: NodeId,
    /// The `instance_…` element.
    pub element: El<'a>,
}

/// Which graph nodes an element of the file became, and how to find nodes by name.
#[derive(Default)]
pub(super) struct Tree<'a> {
    by_element: FxHashMap<roxmltree::NodeId, Vec<NodeId>>,
    /// The element of each graph node; `None` for the asset node.
    elements: Vec<Option<El<'a>>>,
    /// One past the last node below each node: a node and all below it stand in a row.
    ends: Vec<u32>,
    /// Operations put before a node's own because its `asset` has another unit.
    lead: Vec<u32>,
    /// What hangs on the nodes.
    pub instances: Vec<Instance<'a>>,
    sids: HashMap<&'a str, Vec<NodeId>>,
    ids: HashMap<&'a str, Vec<NodeId>>,
    names: HashMap<&'a str, Vec<NodeId>>,
    /// Of names that several nodes have those that are joints, where some are and some are not.
    joints: HashMap<(Key, &'a str), Vec<NodeId>>,
}

/// A piece of work while the tree is built: an element, and with `siblings` all that follow it. One entry stands for all children of a node, so that
/// the list grows with the depth of the tree alone.
#[derive(Clone, Copy)]
struct PendingNode<'a> {
    element: El<'a>,
    siblings: bool,
    parent: NodeId,
    depth: usize,
    /// From the unit and axes of the nearest `asset` above to those of the document.
    space: Option<DMat4>,
}

impl<'a> Tree<'a> {
    /// Builds the tree of the scene that the file names, under an asset node.
    ///
    /// # Errors
    /// Where commas separate the numbers of a transform, or on cancel.
    pub(super) fn read(context: &mut Context<'a>, scene: &mut Scene, asset: &Asset, name: &str) -> ReadResult<Self> {
        let mut tree = Self::default();
        let mut top = Node::new(if name.is_empty() { "COLLADA" } else { name });
        top.kind = NodeKind::Asset;
        top.transform = Transform::from_matrix(asset::to_world(asset));
        let root = scene.graph.add(None, top);
        tree.elements.push(None);
        tree.lead.push(0);
        let mut todo = Vec::new();
        match scene_element(context) {
            Some(element) => {
                let space = asset::space(context, asset, element);
                todo.extend(PendingNode::children(element, root, 1, space));
            }
            None => {
                let parts = loose_parts(context);
                tree.loose(context, scene, asset, root, parts)?;
            }
        }
        tree.work_off(context, scene, asset, &mut todo)?;
        let skeletons = tree.loose_skeletons(context);
        tree.loose(context, scene, asset, root, skeletons)?;
        tree.finish(&scene.graph);
        Ok(tree)
    }

    /// Puts elements that no scene holds right below the root, one after the other, so that the list of things to do stays short.
    fn loose(
        &mut self,
        context: &mut Context<'a>,
        scene: &mut Scene,
        asset: &Asset,
        root: NodeId,
        elements: Vec<El<'a>>,
    ) -> ReadResult<()> {
        let mut todo = Vec::new();
        for element in elements {
            let before = scene.graph.len();
            todo.push(PendingNode { element, siblings: false, parent: root, depth: 1, space: None });
            self.work_off(context, scene, asset, &mut todo)?;
            if scene.graph.len() == before {
                // A limit was reached.
                break;
            }
        }
        Ok(())
    }

    fn work_off(&mut self, context: &mut Context<'a>, scene: &mut Scene, asset: &Asset, todo: &mut Vec<PendingNode<'a>>) -> ReadResult<()> {
        while let Some(work) = todo.pop() {
            if work.siblings
                && let Some(next) = work.element.next_siblings().skip(1).find(is_node)
            {
                todo.push(PendingNode { element: next, ..work });
            }
            self.add(context, scene, asset, &work, todo)?;
        }
        Ok(())
    }

    fn add(
        &mut self,
        context: &mut Context<'a>,
        scene: &mut Scene,
        asset: &Asset,
        work: &PendingNode<'a>,
        todo: &mut Vec<PendingNode<'a>>,
    ) -> ReadResult<()> {
        let PendingNode { element, parent, depth, space, .. } = *work;
        let (target, space) = match element.tag_name().name() {
            "instance_node" => {
                let Some(target) = context.follow(element, "url", &["node"]) else { return Ok(()) };
                if self.is_inside(&scene.graph, parent, target) {
                    context.report.report(element, Finding::ReferenceCycle);
                    return Ok(());
                }
                (target, target.parent().and_then(|around| asset::space(context, asset, around)))
            }
            _ => (element, space),
        };
        let in_bounds = depth <= limits::DEPTH && scene.graph.len() < limits::NODES;
        if !in_bounds {
            context.report.report(element, Finding::TooManyNodes);
        }
        if !in_bounds || !context.spend(element, NODE_BYTES) {
            todo.clear();
            return Ok(());
        }
        if scene.graph.len().is_multiple_of(4096) {
            context.check_cancelled()?;
        }
        let space = if child(target, "asset").is_some() { asset::space(context, asset, target) } else { space };
        let mut ops = transform(context, target)?;
        if let Some(space) = space {
            // In and out again, so that only this node's own lengths and directions are read in its unit and axes.
            ops.reserve_exact(2);
            ops.insert(0, TransformOp::Matrix(space));
            ops.push(TransformOp::Matrix(space.inverse()));
        }
        let is_scene_node = target.tag_name().name() == "node";
        let kind = if is_scene_node && target.attribute("type") == Some("JOINT") { NodeKind::Joint } else { NodeKind::Node };
        let mut node = Node::new(name_of(target));
        if is_scene_node {
            node.id = id_of(target);
            node.sid = target.attribute("sid").unwrap_or_default().to_owned();
        }
        node.kind = kind;
        node.transform = Transform { ops };
        let id = scene.graph.add(Some(parent), node);
        self.elements.push(Some(target));
        self.lead.push(u32::from(space.is_some()));
        self.by_element.entry(target.id()).or_default().push(id);
        if is_scene_node {
            for child in target.children() {
                if matches!(child.tag_name().name(), "instance_geometry" | "instance_controller" | "instance_light" | "instance_camera") {
                    self.instances.push(Instance { node: id, element: child });
                }
            }
            todo.extend(PendingNode::children(target, id, depth + 1, space));
        } else {
            self.instances.push(Instance { node: id, element: target });
        }
        Ok(())
    }

    /// Skeletons that skins name but no scene shows: without their joints the skins could not be posed.
    fn loose_skeletons(&self, context: &mut Context<'a>) -> Vec<El<'a>> {
        let mut tops: Vec<El<'a>> = Vec::new();
        for instance in &self.instances {
            for skeleton in children(instance.element, "skeleton") {
                let text = text_of(skeleton);
                let Url::Here { document, id } = context.lookup.url(skeleton, &text) else { continue };
                let Some(node) = context.lookup.in_document(skeleton, document, &id, &["node"]) else { continue };
                if self.by_element.contains_key(&node.id()) {
                    continue;
                }
                let in_library = |element: &El<'a>| element.tag_name().name() == "node";
                let top = node.ancestors().take_while(in_library).last().unwrap_or(node);
                if !tops.contains(&top) && context.spend(skeleton, 8 * tops.len()) {
                    context.report.report(skeleton, Finding::SkeletonNotInScene);
                    tops.push(top);
                }
            }
        }
        tops
    }

    /// Whether `node` or one above it was made from `element`.
    fn is_inside(&self, graph: &Graph, node: NodeId, element: El<'a>) -> bool {
        let mut next = Some(node);
        while let Some(node) = next {
            if self.elements.get(node.index()).copied().flatten() == Some(element) {
                return true;
            }
            next = graph.node(node).parent();
        }
        false
    }

    fn finish(&mut self, graph: &Graph) {
        self.ends = (1..=graph.len() as u32).collect();
        for (id, node) in graph.iter().collect::<Vec<_>>().into_iter().rev() {
            let end = self.ends.get(id.index()).copied().unwrap_or(0);
            if let Some(above) = node.parent().and_then(|parent| self.ends.get_mut(parent.index())) {
                *above = (*above).max(end);
            }
        }
        self.index();
        let mut joints = HashMap::new();
        for (key, map) in [(Key::Sid, &self.sids), (Key::Id, &self.ids), (Key::Name, &self.names)] {
            for (name, nodes) in map.iter().filter(|(_, nodes)| nodes.len() > 1) {
                let only: Vec<NodeId> = nodes.iter().copied().filter(|node| self.is_joint(*node)).collect();
                if !only.is_empty() && only.len() < nodes.len() {
                    joints.insert((key, *name), only);
                }
            }
        }
        self.joints = joints;
    }

    fn index(&mut self) {
        for (index, element) in self.elements.iter().enumerate() {
            let Some(element) = element.filter(|element| element.tag_name().name() == "node") else { continue };
            let id = NodeId(index as u32);
            for (key, map) in [("sid", &mut self.sids), ("id", &mut self.ids), ("name", &mut self.names)] {
                if let Some(name) = element.attribute(key) {
                    map.entry(name).or_default().push(id);
                }
            }
        }
    }

    /// The graph nodes that a `node` element became.
    pub(super) fn nodes_of(&self, element: El<'_>) -> &[NodeId] {
        self.by_element.get(&element.id()).map_or(&[], Vec::as_slice)
    }

    /// A `node` element, or where the scene doesn't show it the first of its id that it shows: files with several scenes repeat ids.
    pub(super) fn shown(&self, element: El<'a>) -> El<'a> {
        let first_of = |id| self.ids.get(id).and_then(|nodes| self.elements.get(nodes.first()?.index()).copied().flatten());
        match element.attribute("id").and_then(first_of) {
            Some(other) if element.tag_name().name() == "node" && self.nodes_of(element).is_empty() => other,
            _ => element,
        }
    }

    /// The only `node` element that goes by `name` as its sid, else as its name.
    pub(super) fn only_element(&self, name: &str) -> Option<El<'a>> {
        let only = |found: &Vec<NodeId>| {
            let mut elements = found.iter().map(|node| self.elements.get(node.index()).copied().flatten());
            let first = elements.next().flatten()?;
            elements.all(|element| element == Some(first)).then_some(first)
        };
        [&self.sids, &self.names].into_iter().find_map(|map| map.get(name).and_then(only))
    }

    /// Operations of this node that stand before those of the file.
    pub(super) fn lead(&self, node: NodeId) -> u32 {
        self.lead.get(node.index()).copied().unwrap_or(0)
    }

    /// The first node with scoped id `sid` at or below `root`.
    pub(super) fn sid_below(&self, root: NodeId, sid: &str) -> Option<NodeId> {
        self.below(root, self.sids.get(sid)?, None)
    }

    /// The first node with this id at or below `root`.
    pub(super) fn id_below(&self, root: NodeId, id: &str) -> Option<NodeId> {
        self.below(root, self.ids.get(id)?, None)
    }

    /// The first of `found`, which are in order, at or below `root`, but for `apart`.
    fn below(&self, root: NodeId, found: &[NodeId], apart: Option<NodeId>) -> Option<NodeId> {
        let end = self.ends.get(root.index()).copied()?;
        let from = found.partition_point(|node| *node < root);
        found.get(from..)?.iter().copied().find(|node| Some(*node) != apart).filter(|node| node.0 < end)
    }

    /// The node with this sid, id or name anywhere but `apart`; where there are several a joint, and of these the one nearest to `near`.
    pub(super) fn anywhere(&self, graph: &Graph, near: NodeId, key: Key, name: &str, apart: Option<NodeId>) -> Option<NodeId> {
        let map = match key {
            Key::Sid => &self.sids,
            Key::Id => &self.ids,
            Key::Name => &self.names,
        };
        let all = map.get(name)?.as_slice();
        let joints = self.joints.get(&(key, name)).map(Vec::as_slice).filter(|joints| joints.iter().any(|node| Some(*node) != apart));
        self.nearest_but(graph, near, joints.unwrap_or(all), apart)
    }

    /// Whether the file calls a node a joint.
    pub(super) fn is_joint(&self, node: NodeId) -> bool {
        self.elements.get(node.index()).copied().flatten().is_some_and(|element| element.attribute("type") == Some("JOINT"))
    }

    /// Whether any node goes by this name in any way.
    pub(super) fn knows(&self, name: &str) -> bool {
        self.sids.contains_key(name) || self.ids.contains_key(name) || self.names.contains_key(name)
    }

    /// Of several nodes the one whose way to `near` through a common parent starts lowest; the first among equals.
    pub(super) fn nearest(&self, graph: &Graph, near: NodeId, found: &[NodeId]) -> Option<NodeId> {
        self.nearest_but(graph, near, found, None)
    }

    fn nearest_but(&self, graph: &Graph, near: NodeId, found: &[NodeId], apart: Option<NodeId>) -> Option<NodeId> {
        let mut others = found.iter().copied().filter(|node| Some(*node) != apart);
        let first = others.next()?;
        if others.next().is_none() {
            return Some(first);
        }
        let mut above = Some(near);
        while let Some(root) = above {
            if let Some(node) = self.below(root, found, apart) {
                return Some(node);
            }
            above = graph.node(root).parent();
        }
        Some(first)
    }
}

/// What a name is looked up as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Key {
    /// A scoped id.
    Sid,
    /// An id.
    Id,
    /// A name.
    Name,
}

/// Whether a child of a node or scene is a node in the tree.
fn is_node(element: &El<'_>) -> bool {
    matches!(element.tag_name().name(), "node" | "instance_node")
}

impl<'a> PendingNode<'a> {
    /// All nodes right below `element`.
    fn children(element: El<'a>, parent: NodeId, depth: usize, space: Option<DMat4>) -> Option<Self> {
        element.children().find(is_node).map(|element| Self { element, siblings: true, parent, depth, space })
    }
}

/// The visual scene that `scene` names, else the first one.
fn scene_element<'a>(context: &mut Context<'a>) -> Option<El<'a>> {
    let root = context.root;
    let instance = child(root, "scene").and_then(|scene| child(scene, "instance_visual_scene"));
    if let Some(instance) = instance
        && let Some(found) = context.follow(instance, "url", &["visual_scene"])
    {
        return Some(found);
    }
    let first = children(root, "library_visual_scenes").find_map(|library| child(library, "visual_scene"))?;
    context.report.report(first, Finding::NoSceneNamed);
    Some(first)
}

/// What a file without a scene has to show: the nodes of its libraries, else its geometry.
fn loose_parts<'a>(context: &mut Context<'a>) -> Vec<El<'a>> {
    let all = |library, tag| children(context.root, library).flat_map(move |library| children(library, tag));
    let mut parts: Vec<El<'a>> = all("library_nodes", "node").collect();
    if parts.is_empty() {
        parts = all("library_geometries", "geometry").collect();
    }
    match parts.first() {
        Some(first) => context.report.report(*first, Finding::NoScene),
        None => context.report.report(context.root, Finding::NothingToShow),
    }
    parts
}

/// Whether a child of a node is one of its transforms.
pub(super) fn is_transform(tag: &str) -> bool {
    matches!(tag, "lookat" | "matrix" | "rotate" | "scale" | "skew" | "translate")
}

/// A node's transforms, in document order. One that cannot be read counts as one that does nothing, so that the others keep their places.
fn transform<'a>(context: &mut Context<'a>, node: El<'a>) -> ReadResult<Vec<TransformOp>> {
    let mut ops = Vec::new();
    if node.tag_name().name() != "node" {
        return Ok(ops);
    }
    let elements = || node.children().filter(|child| is_transform(child.tag_name().name()));
    let count = elements().count();
    if count > 0 && !context.spend(node, count * OP_BYTES) {
        return Ok(ops);
    }
    // Most nodes have one, and a list that grows by itself begins with room for four.
    ops.reserve_exact(count);
    for element in elements() {
        let op = match element.tag_name().name() {
            "translate" => context.exactly(element)?.map(|by| TransformOp::Translate(vector(by))),
            "scale" => context.exactly(element)?.map(|by| TransformOp::Scale(vector(by))),
            "rotate" => context.exactly(element)?.map(|[x, y, z, angle]| TransformOp::Rotate { axis: DVec3::new(x, y, z), angle }),
            "matrix" => context.matrix(element)?.map(TransformOp::Matrix),
            "lookat" => context.exactly(element)?.map(|[a, b, c, d, e, f, g, h, i]| TransformOp::LookAt {
                eye: DVec3::new(a, b, c),
                target: DVec3::new(d, e, f),
                up: DVec3::new(g, h, i),
            }),
            _ => context.exactly(element)?.map(|[angle, a, b, c, d, e, f]| TransformOp::Skew {
                angle,
                along: DVec3::new(a, b, c),
                across: DVec3::new(d, e, f),
            }),
        };
        ops.push(op.unwrap_or(TransformOp::Translate(DVec3::ZERO)));
    }
    Ok(ops)
}
