//! The tree of nodes.

use glam::DMat4;

use super::transform::{Transform, TransformOp, compose};
use super::{CameraId, Label, LightId, MeshInstance, MuscleId, Unnamed};

/// A node in a [`Graph`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub u32);

impl NodeId {
    /// The position in the graph's list.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What a node is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NodeKind {
    /// An ordinary node.
    #[default]
    Node,
    /// A bone of a skeleton.
    Joint,
    /// The root of a loaded file: carries its unit and up axis.
    Asset,
}

/// What hangs on a node.
#[derive(Debug, Clone, PartialEq)]
pub enum Content {
    /// A mesh, with the deformers that a skin or morph puts on it.
    Mesh(MeshInstance),
    /// A muscle of the document.
    Muscle(MuscleId),
    /// A light of the file.
    Light(LightId),
    /// A camera of the file.
    Camera(CameraId),
}

/// A node: a place in the tree, a local transform, and what hangs on it.
#[derive(Debug, Clone, Default)]
pub struct Node {
    /// The name in its file, else its id or scoped id there; empty where it has none of them.
    pub name: String,
    /// The id in the file; empty where it has none.
    pub id: String,
    /// The scoped id in the file; empty where it has none.
    pub sid: String,
    /// Ordinary node, joint or asset root.
    pub kind: NodeKind,
    /// Local transform at rest.
    pub transform: Transform,
    /// Meshes, muscles, lights, cameras.
    pub contents: Vec<Content>,
    /// Whether it and all below is drawn.
    pub visible: bool,
    parent: Option<NodeId>,
    children: Vec<NodeId>,
}

impl Node {
    /// A visible node without a transform.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), visible: true, ..Self::default() }
    }

    /// The same node of this kind.
    pub fn with_kind(mut self, kind: NodeKind) -> Self {
        self.kind = kind;
        self
    }

    /// The same node with this local transform.
    pub fn with_transform(mut self, transform: Transform) -> Self {
        self.transform = transform;
        self
    }

    /// The same node with this hanging on it too.
    pub fn with_content(mut self, content: Content) -> Self {
        self.contents.push(content);
        self
    }

    /// The node above.
    pub fn parent(&self) -> Option<NodeId> {
        self.parent
    }

    /// The nodes below, in file order.
    pub fn children(&self) -> &[NodeId] {
        &self.children
    }
}

/// All nodes, parents before children, so that one pass makes world transforms.
#[derive(Debug, Clone, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    roots: Vec<NodeId>,
}

impl Graph {
    /// Adds `node` under `parent` (or as a root) and returns its id.
    pub fn add(&mut self, parent: Option<NodeId>, mut node: Node) -> NodeId {
        let id = NodeId(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        node.parent = parent;
        node.children.clear();
        self.nodes.push(node);
        match parent {
            Some(parent) => self.nodes[parent.index()].children.push(id),
            None => self.roots.push(id),
        }
        id
    }

    /// Takes away the nodes from the one with number `count` on.
    pub fn truncate(&mut self, count: usize) {
        let stays = |id: &NodeId| id.index() < count;
        self.nodes.truncate(count);
        self.roots.retain(stays);
        self.nodes.iter_mut().for_each(|node| node.children.retain(stays));
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is no node.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The nodes without a parent.
    pub fn roots(&self) -> &[NodeId] {
        &self.roots
    }

    /// The node `id`. Ids come from this graph, so they are always in range.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.index()]
    }

    /// The node `id`, to change it.
    pub fn node_mut(&mut self, id: NodeId) -> &mut Node {
        &mut self.nodes[id.index()]
    }

    /// All nodes, each with its parent, parents before children.
    pub fn into_nodes(self) -> impl ExactSizeIterator<Item = (Option<NodeId>, Node)> {
        self.nodes.into_iter().map(|node| (node.parent, node))
    }

    /// All nodes with their ids, parents before children.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (NodeId, &Node)> {
        self.nodes.iter().enumerate().map(|(i, node)| (NodeId(i as u32), node))
    }

    /// What a node is called: by its name, else by what muscle or part of the arm it is, else by its place in its file.
    pub fn label(&self, id: NodeId) -> Label<'_> {
        // The nodes of a file follow its root.
        let before = self.roots.partition_point(|root| *root <= id).checked_sub(1);
        let root = before.and_then(|place| self.roots.get(place)).map_or(0, |root| root.0);
        let node = self.node(id);
        let unnamed = || match self.muscle_number(id) {
            Some(number) => Unnamed::Muscle(number),
            None => Unnamed::of_id(&node.id, if id.0 == root { Unnamed::Scene } else { Unnamed::Node(id.0 - root) }),
        };
        if node.name.is_empty() { Label::Unnamed(unnamed()) } else { Label::Name(&node.name) }
    }

    /// Of the node of a muscle, its place among those of its file, from 1.
    fn muscle_number(&self, id: NodeId) -> Option<u32> {
        let is_muscle = |id: &NodeId| self.node(*id).contents.iter().any(|content| matches!(content, Content::Muscle(_)));
        let siblings = &self.node(self.node(id).parent?).children;
        is_muscle(&id).then(|| siblings.iter().filter(|other| **other <= id && is_muscle(other)).count() as u32)
    }

    /// The first node that is called so.
    pub fn find(&self, name: &str) -> Option<NodeId> {
        let named = || self.iter().find(|(_, node)| node.name == name).map(|(id, _)| id);
        if name.is_empty() { None } else { named().or_else(|| self.find_unnamed(name, |_| true)) }
    }

    /// The first node without a name that is called so, among those that are accepted.
    pub fn find_unnamed(&self, name: &str, accepts: impl Fn(NodeId) -> bool) -> Option<NodeId> {
        let unnamed = Unnamed::parse(name)?;
        let is = |id: &NodeId| self.label(*id) == Label::Unnamed(unnamed) && accepts(*id);
        match unnamed {
            Unnamed::Node(number) => {
                let places = self.roots.iter().filter_map(|root| root.0.checked_add(number).map(NodeId));
                places.filter(|id| id.index() < self.len()).find(is)
            }
            Unnamed::Scene | Unnamed::Part(_) | Unnamed::Muscle(_) => self.iter().map(|(id, _)| id).find(is),
            _ => None,
        }
    }

    /// `root` and everything below it, depth first in file order.
    pub fn subtree(&self, root: NodeId) -> Vec<NodeId> {
        let (mut found, mut open) = (Vec::new(), vec![root]);
        while let Some(id) = open.pop() {
            found.push(id);
            open.extend(self.node(id).children.iter().rev());
        }
        found
    }

    /// Whether `id` and all nodes above it are visible.
    pub fn is_shown(&self, id: NodeId) -> bool {
        let mut next = Some(id);
        while let Some(id) = next {
            let node = self.node(id);
            if !node.visible {
                return false;
            }
            next = node.parent;
        }
        true
    }

    /// Local matrices at rest, one a node.
    pub fn rest_locals(&self) -> Vec<DMat4> {
        self.nodes.iter().map(|node| node.transform.matrix()).collect()
    }

    /// World matrices from local ones: `world[i] = world[parent(i)] · local[i]`. Both hold one matrix a node.
    pub fn world_from_local(&self, local: &[DMat4], world: &mut Vec<DMat4>) {
        world.clear();
        world.reserve(self.nodes.len());
        for (node, local) in self.nodes.iter().zip(local) {
            let matrix = match node.parent.and_then(|parent| world.get(parent.index())) {
                Some(parent) => *parent * *local,
                None => *local,
            };
            world.push(matrix);
        }
    }

    /// The operations of all nodes in one flat list with each node's range, the form that animation writes into.
    pub fn flat_ops(&self) -> (Vec<TransformOp>, Vec<std::ops::Range<u32>>) {
        let mut ops = Vec::new();
        let ranges = self
            .nodes
            .iter()
            .map(|node| {
                let start = ops.len() as u32;
                ops.extend_from_slice(&node.transform.ops);
                start..ops.len() as u32
            })
            .collect();
        (ops, ranges)
    }

    /// Local matrices from flat operations as [`Graph::flat_ops`] lays them out.
    pub fn compose_flat(ops: &[TransformOp], ranges: &[std::ops::Range<u32>], local: &mut Vec<DMat4>) {
        local.clear();
        local.extend(ranges.iter().map(|range| compose(&ops[range.start as usize..range.end as usize])));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn world_is_parent_times_local() {
        let mut graph = Graph::default();
        let root = graph.add(None, Node::new("root").with_transform(Transform::from_translation(DVec3::X)));
        let turned = TransformOp::Rotate { axis: DVec3::Z, angle: 90.0 };
        let arm = graph.add(Some(root), Node::new("arm").with_transform(Transform { ops: vec![turned] }));
        let hand = graph.add(Some(arm), Node::new("hand").with_transform(Transform::from_translation(DVec3::X)));
        let mut world = Vec::new();
        graph.world_from_local(&graph.rest_locals(), &mut world);
        assert!((world[hand.index()].w_axis.truncate() - DVec3::new(1.0, 1.0, 0.0)).length() < 1e-12);
        assert_eq!(graph.subtree(root), [root, arm, hand]);
        assert_eq!(graph.find("hand"), Some(hand));
        assert_eq!(graph.node(hand).parent(), Some(arm));
    }

    #[test]
    fn nodes_without_a_name_are_called_by_their_place_in_their_file() {
        let mut graph = Graph::default();
        for root in ["a.dae", "b.dae"] {
            let root = graph.add(None, Node::new(root));
            let arm = graph.add(Some(root), Node::new(""));
            graph.add(Some(arm), Node::new("hand"));
            graph.add(Some(arm), Node::new(""));
        }
        let called: Vec<_> = graph.iter().map(|(id, _)| graph.label(id).plain()).collect();
        assert_eq!(called, ["a.dae", "Node 1", "hand", "Node 3", "b.dae", "Node 1", "hand", "Node 3"]);
        assert_eq!(["Node 3", "Узел 3"].map(|name| graph.find(name)), [Some(NodeId(3)); 2]);
        assert_eq!(["Node 2", "Node 0", "Node 9", "Node 4294967295", "Clip 1", ""].map(|name| graph.find(name)), [None; 6]);
        graph.node_mut(NodeId(6)).name = "Node 3".into();
        assert_eq!(graph.find("Node 3"), Some(NodeId(6)));
    }

    #[test]
    fn hiding_a_node_hides_what_is_below() {
        let mut graph = Graph::default();
        let root = graph.add(None, Node::new("root"));
        let leaf = graph.add(Some(root), Node::new("leaf"));
        assert!(graph.is_shown(leaf));
        graph.node_mut(root).visible = false;
        assert!(!graph.is_shown(leaf));
    }
}
