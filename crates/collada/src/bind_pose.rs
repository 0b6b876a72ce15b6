//! Whether a skin and its joints meet at rest.

use glam::{DMat3, DMat4, DQuat};

use super::Finding;
use sinew_scene::{Graph, NodeId, Skin};

/// Sizes that differ by less are the same: a hundredth, as rounded matrices have it.
const SIZE: f64 = 0.01;
/// Turns that differ by less are the same, degrees.
const TURN: f64 = 1.0;

/// Where the nodes of the graph are at rest below its root, in the file's own unit and axes.
pub(super) fn rest(graph: &Graph) -> Vec<DMat4> {
    let mut locals = graph.rest_locals();
    if let Some(root) = locals.first_mut() {
        *root = DMat4::IDENTITY;
    }
    let mut world = Vec::new();
    graph.world_from_local(&locals, &mut world);
    world
}

/// A skin on its joints.
pub(super) struct Bound<'b> {
    /// The skin.
    pub skin: &'b Skin,
    /// Which of its joints points are weighted to.
    pub used: &'b [bool],
    /// The node of each.
    pub joints: &'b [Option<NodeId>],
    /// The node that holds the skin.
    pub node: NodeId,
}

impl Bound<'_> {
    /// What does not meet at rest, where the nodes are at `rest`; `None` where all does.
    ///
    /// A rest pose may be any pose, so turned joints prove nothing, and a rig that is scaled as a whole takes its skin along. What no pose explains is size
    /// in an inverse bind matrix that no node gives back, and a mesh beneath the same scaled or turned node as its joints, which goes along with it on
    /// paper and not in the skin (Blender's armatures).
    pub(super) fn mismatch(&self, graph: &Graph, rest: &[DMat4]) -> Option<Finding> {
        let at = |node: NodeId| rest.get(node.index()).copied();
        let bound = || {
            let joints = self.skin.joints.iter().zip(self.joints).zip(self.used);
            joints.filter(|(_, used)| **used).filter_map(|((joint, node), _)| {
                let node = (*node)?;
                Some((joint, node, at(node)? * joint.inverse_bind))
            })
        };
        let off = |size: f64| size.is_finite() && size > 0.0 && (size - 1.0).abs() > SIZE;
        let bind_shape = size(&self.skin.bind_shape);
        let scaled = bound().filter_map(|(joint, _, posed)| {
            let made = size(&posed);
            (off(size(&joint.inverse_bind)) && off(made) && off(made * bind_shape)).then_some((joint, made))
        });
        if let Some((joint, made)) = scaled.max_by(|(_, a), (_, b)| a.ln().abs().total_cmp(&b.ln().abs())) {
            return Some(Finding::BindPoseScaled { skin: self.skin.name.clone(), joint: joint.name.clone(), factor: made });
        }
        let (joint, node, posed) = bound().next()?;
        let above = at(common(graph, self.node, node)?)?;
        let turned = |matrix: &DMat4, other: &DMat4| rotation(matrix).angle_between(rotation(other)).to_degrees();
        if !off(size(&above)) && turned(&above, &DMat4::IDENTITY) <= TURN {
            return None;
        }
        let (here, drawn) = (at(self.node)?, posed * self.skin.bind_shape);
        let made = size(&drawn) / size(&here);
        let (skin, joint) = (self.skin.name.clone(), joint.name.clone());
        if off(made) {
            return Some(Finding::BindPoseScaledByNode { skin, joint, factor: made });
        }
        let angle = turned(&drawn, &here);
        let at_bind = bound().all(|(_, _, other)| turned(&other, &posed) <= TURN);
        (at_bind && angle.is_finite() && angle > TURN).then_some(Finding::BindPoseTurned { skin, joint, angle })
    }
}

/// How much larger a matrix makes things: the cube root of what it makes of volumes.
fn size(matrix: &DMat4) -> f64 {
    DMat3::from_mat4(*matrix).determinant().abs().cbrt()
}

fn rotation(matrix: &DMat4) -> DQuat {
    let linear = DMat3::from_mat4(*matrix);
    let x = linear.x_axis.normalize_or(glam::DVec3::X);
    let y = (linear.y_axis - x * x.dot(linear.y_axis)).try_normalize().unwrap_or_else(|| x.any_orthonormal_vector());
    DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y)))
}

/// The lowest node that is or stands above both, unless that is the root of the file.
fn common(graph: &Graph, a: NodeId, b: NodeId) -> Option<NodeId> {
    let above = |node: NodeId| std::iter::successors(Some(node), |node| graph.node(*node).parent());
    // Parents come before their children, so what stands lower has the higher number.
    let (mut a, mut b) = (above(a).peekable(), above(b).peekable());
    while let (Some(left), Some(right)) = (a.peek(), b.peek()) {
        match left.cmp(right) {
            std::cmp::Ordering::Equal => return graph.node(*left).parent().map(|_| *left),
            std::cmp::Ordering::Greater => drop(a.next()),
            std::cmp::Ordering::Less => drop(b.next()),
        }
    }
    None
}
