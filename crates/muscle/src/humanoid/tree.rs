//! The bones of a scene as a tree with places at rest.

use glam::{DMat4, DVec3};
use sinew_scene::{Graph, NodeId, NodeKind, Scene};

/// Bones nearer to each other than this share of their distance from the origin, plus a thousandth of that in metres, lie at one place.
const APART: f64 = 1e-6;

/// For each node whether it is a bone: a joint, or where a scene has none an ordinary node. Nodes at and below `skip` are none.
pub(in super::super) fn bone_flags(graph: &Graph, skip: &[NodeId]) -> Vec<bool> {
    let mut skipped: Vec<bool> = Vec::with_capacity(graph.len());
    for (id, node) in graph.iter() {
        let above = node.parent().is_some_and(|parent| skipped.get(parent.index()).copied().unwrap_or(false));
        skipped.push(above || skip.contains(&id));
    }
    let is_free = |id: NodeId| !skipped.get(id.index()).copied().unwrap_or(false);
    let joints = graph.iter().any(|(id, node)| node.kind == NodeKind::Joint && is_free(id));
    let kind = if joints { NodeKind::Joint } else { NodeKind::Node };
    graph.iter().map(|(id, node)| node.kind == kind && is_free(id)).collect()
}

/// Whether two places are two.
pub(in super::super) fn are_apart(a: DVec3, b: DVec3) -> bool {
    a.is_finite() && b.is_finite() && a.distance(b) > APART * (1e-3 + a.length().max(b.length()))
}

/// A scene's bones, and where they are at rest.
pub(super) struct BoneTree<'a> {
    pub graph: &'a Graph,
    bones: Vec<bool>,
    rest: Vec<DMat4>,
    depths: Vec<usize>,
    /// For each node the length of the longest way down from it over bones, metres, and the next bone of that way.
    reach: Vec<(f64, Option<NodeId>)>,
}

impl<'a> BoneTree<'a> {
    pub(super) fn new(scene: &'a Scene, skip: &[NodeId]) -> Self {
        let graph = &scene.graph;
        let mut rest = Vec::new();
        graph.world_from_local(&graph.rest_locals(), &mut rest);
        let mut depths: Vec<usize> = Vec::with_capacity(graph.len());
        for (_, node) in graph.iter() {
            depths.push(node.parent().and_then(|parent| depths.get(parent.index())).map_or(0, |depth| depth + 1));
        }
        let mut tree = Self { graph, bones: bone_flags(graph, skip), rest, depths, reach: vec![(0.0, None); graph.len()] };
        // Children come after their parents.
        for index in (0..graph.len()).rev() {
            let id = NodeId(index as u32);
            let Some(parent) = graph.node(id).parent().filter(|_| tree.is_bone(id)) else { continue };
            let length = tree.longest_below(id) + tree.place(id).distance(tree.place(parent));
            if let Some(known) =
                tree.reach.get_mut(parent.index()).filter(|known| length.is_finite() && (length > known.0 || known.1.is_none()))
            {
                *known = (length, Some(id));
            }
        }
        tree
    }

    /// Length of the longest way down from a bone, metres.
    pub(super) fn longest_below(&self, id: NodeId) -> f64 {
        self.reach.get(id.index()).map_or(0.0, |reach| reach.0)
    }

    /// That way, from the bone itself on.
    pub(super) fn longest_way(&self, id: NodeId) -> impl Iterator<Item = NodeId> + '_ {
        std::iter::successors(Some(id), |id| self.reach.get(id.index())?.1)
    }

    pub(super) fn is_bone(&self, id: NodeId) -> bool {
        self.bones.get(id.index()).copied().unwrap_or(false)
    }

    /// Where a bone begins, metres.
    pub(super) fn place(&self, id: NodeId) -> DVec3 {
        self.rest.get(id.index()).map_or(DVec3::NAN, |matrix| matrix.w_axis.truncate())
    }

    /// The bones of each figure: all below a bone that has none above it.
    pub(super) fn figures(&self) -> Vec<Vec<NodeId>> {
        let mut figure_of: Vec<Option<usize>> = Vec::with_capacity(self.graph.len());
        let mut figures: Vec<Vec<NodeId>> = Vec::new();
        for (id, node) in self.graph.iter() {
            let above = node.parent().and_then(|parent| figure_of.get(parent.index()).copied().flatten());
            let own = if self.is_bone(id) {
                let number = above.unwrap_or(figures.len());
                match figures.get_mut(number) {
                    Some(bones) => bones.push(id),
                    None => figures.push(vec![id]),
                }
                Some(number)
            } else {
                above
            };
            figure_of.push(own);
        }
        figures
    }

    /// The nodes above, nearest first.
    pub(super) fn ancestors(&self, id: NodeId) -> impl Iterator<Item = NodeId> + '_ {
        std::iter::successors(self.graph.node(id).parent(), |id| self.graph.node(*id).parent())
    }

    /// The bones above, nearest first.
    pub(super) fn bones_above(&self, id: NodeId) -> impl Iterator<Item = NodeId> + '_ {
        self.ancestors(id).filter(|id| self.is_bone(*id))
    }

    /// The bones below, those nearer in the tree first.
    pub(super) fn bones_below(&self, id: NodeId) -> Vec<NodeId> {
        let mut found: Vec<NodeId> = self.graph.node(id).children().to_vec();
        let mut next = 0;
        while let Some(id) = found.get(next).copied() {
            found.extend(self.graph.node(id).children());
            next += 1;
        }
        found.retain(|id| self.is_bone(*id));
        found
    }

    /// The nearest bone above that begins elsewhere.
    pub(super) fn bone_above_apart(&self, id: NodeId) -> Option<NodeId> {
        self.bones_above(id).find(|above| are_apart(self.place(*above), self.place(id)))
    }

    /// How many nodes are above.
    pub(super) fn depth(&self, id: NodeId) -> usize {
        self.depths.get(id.index()).copied().unwrap_or(0)
    }

    /// The lowest node above both, which may be one of them.
    pub(super) fn common(&self, a: NodeId, b: NodeId) -> Option<NodeId> {
        let above_b: Vec<NodeId> = std::iter::once(b).chain(self.ancestors(b)).collect();
        std::iter::once(a).chain(self.ancestors(a)).find(|id| above_b.contains(id))
    }
}
