//! Muscles that scale with the bones that they are on.
//!
//! A bone's scale is what its node and those above it multiply lengths by; the unit of its file, which the file's root carries, is none.

use glam::{DMat3, DMat4};

use sinew_scene::{Graph, NodeId, NodeKind};

/// Nearer to 1 than this a scale is 1: rounding of matrices.
const ONE: f64 = 1e-9;

/// The scale of the bone `node` in a pose; `world` is one matrix a node. Of an uneven one, that of a cube of the same volume.
pub fn of_bone(graph: &Graph, world: &[DMat4], node: NodeId) -> f64 {
    let scale = world.get(node.index()).map_or(1.0, size) / of_file(graph, node);
    if (scale - 1.0).abs() < ONE { 1.0 } else { scale }
}

/// By what offsets on each node are multiplied along its axes, as seen from a root that is scaled to `unit` metres, so that they are in that unit where
/// the bone has the scale `at`.
pub(super) fn ride(graph: &Graph, unit: f64, at: f64) -> Vec<f64> {
    let mut files: Vec<f64> = Vec::with_capacity(graph.len());
    for (id, node) in graph.iter() {
        let above = node.parent().and_then(|parent| files.get(parent.index())).copied();
        files.push(above.unwrap_or_else(|| of_file(graph, id)));
    }
    files.into_iter().map(|file| unit / (file * at)).collect()
}

/// Metres a unit of the file that a node came from.
fn of_file(graph: &Graph, node: NodeId) -> f64 {
    let top = std::iter::successors(Some(node), |id| graph.node(*id).parent()).last().unwrap_or(node);
    let about = graph.node(top);
    let unit = if about.kind == NodeKind::Asset { size(&about.transform.matrix()) } else { 1.0 };
    if unit > 0.0 && unit.is_finite() { unit } else { 1.0 }
}

fn size(matrix: &DMat4) -> f64 {
    DMat3::from_mat4(*matrix).determinant().abs().cbrt()
}
