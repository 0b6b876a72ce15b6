//! The bones that a muscle runs along.

use glam::{DMat4, DVec3};

use super::bone_shapes::tip_of;
use super::muscle_rig::MuscleRig;
use sinew_scene::{Graph, NodeId};

/// A bone from its joint to the next, or to its tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoneAxis {
    /// The node of its joint.
    pub node: NodeId,
    /// Its other end in the node's own space.
    pub end: DVec3,
}

impl BoneAxis {
    /// Both ends in a pose of the world, metres; `None` where the node has no matrix.
    pub fn ends(&self, world: &[DMat4]) -> Option<[DVec3; 2]> {
        let matrix = world.get(self.node.index())?;
        Some([matrix.w_axis.truncate(), matrix.transform_point3(self.end)])
    }
}

impl MuscleRig {
    /// The bones on the way from the origin of muscle `index` to its insertion; empty where nothing holds it. `rest` is one matrix a node.
    pub fn bone_chain(&self, index: usize, graph: &Graph, rest: &[DMat4]) -> Vec<BoneAxis> {
        let ends = self.muscles.get(index).and_then(|muscle| {
            let line = muscle.line.as_ref()?;
            Some([*self.bones.get(line.origin.bone)?, *self.bones.get(line.insertion.bone)?])
        });
        let Some([origin, insertion]) = ends else { return Vec::new() };
        let above = |node: NodeId| std::iter::successors(Some(node), |node| graph.node(*node).parent()).collect::<Vec<_>>();
        let (from, to) = (above(origin), above(insertion));
        // Up from the origin to the node that both are below, and down to the insertion.
        let Some(top) = from.iter().position(|node| to.contains(node)) else { return Vec::new() };
        let down = to.iter().position(|node| from.get(top) == Some(node)).unwrap_or(0);
        let mut bones: Vec<(NodeId, DVec3)> = Vec::new();
        let place = |node: NodeId| rest.get(node.index()).map(|world| world.w_axis.truncate());
        let up = from.windows(2).take(top);
        let steps = up.chain(to.windows(2).take(down)).filter_map(|pair| match pair {
            [child, parent] => Some((*parent, place(*child)?)),
            _ => None,
        });
        bones.extend(steps);
        for end in [origin, insertion] {
            if !bones.iter().any(|(node, _)| *node == end)
                && let Some(tip) = tip_of(graph, end, rest)
            {
                bones.push((end, tip));
            }
        }
        let axis = |(node, end): (NodeId, DVec3)| {
            let back = rest.get(node.index())?.inverse();
            let end = back.transform_point3(end);
            (end.is_finite() && place(node)?.distance(rest.get(node.index())?.transform_point3(end)) > 0.0)
                .then_some(BoneAxis { node, end })
        };
        bones.into_iter().filter_map(axis).collect()
    }
}
