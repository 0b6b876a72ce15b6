//! Data for the inspector: the picked surface point, the influences of the picked vertex, manual joint rotations.

use glam::{DMat4, DVec3, Vec3};

use super::{ChangeSet, Session, UndoStep};
use crate::document::{JointOverride, VertexInfluences};
use sinew_render::PickHit;
use sinew_scene::message;
use sinew_scene::{Content, Deformer, Frame, NodeId, NodeKind};

/// A point on a surface, or a bone; it moves with what it is on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ProbedPoint {
    node: NodeId,
    surface: Option<u32>,
    triangle: u32,
    shares: Vec3,
}

/// The last two points and the vertex nearest to the last one.
#[derive(Debug, Clone, Default)]
pub(super) struct Probe {
    last: [Option<ProbedPoint>; 2],
    vertex: Option<(usize, u32)>,
    /// The three bones that the user chose for the joint angle.
    angle: Option<[NodeId; 3]>,
}

impl ProbedPoint {
    fn place(&self, frame: &Frame) -> Option<Vec3> {
        let Some(surface) = self.surface else { return Some(frame.position(self.node)) };
        let surface = frame.surfaces.get(surface as usize)?;
        let [a, b, c] = surface.mesh.triangles.get(self.triangle as usize)?.map(|corner| surface.position(corner));
        let place = a * self.shares.x + b * self.shares.y + c * self.shares.z;
        place.is_finite().then_some(place)
    }
}

/// The matrices of a selected node at the present moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Matrices {
    /// Under the node above.
    pub local: DMat4,
    /// In the world.
    pub world: DMat4,
    /// A joint's bind matrix: where its skin was bound to it, in the skin's own space.
    pub bind: Option<DMat4>,
    /// Its inverse, as the file has it.
    pub inverse_bind: Option<DMat4>,
}

impl Session {
    /// A click: selects what it hit, or nothing, and remembers the point.
    pub fn point_at(&mut self, pick: Option<PickHit>) {
        self.select(pick.map(|pick| pick.node));
        let Some(pick) = pick else {
            self.probe.vertex = None;
            return self.changed(ChangeSet::PROBE);
        };
        let pin = ProbedPoint { node: pick.node, surface: pick.surface, triangle: pick.triangle, shares: pick.barycentric };
        self.probe.last = [self.probe.last[1], Some(pin)];
        self.probe.vertex = self.nearest_vertex(&pick);
        self.changed(ChangeSet::PROBE);
    }

    /// The inspector shows something else of the same selection.
    pub fn refresh_probe(&mut self) {
        self.changed(ChangeSet::PROBE);
    }

    /// The corner of the picked triangle that is nearest to the point.
    fn nearest_vertex(&self, pick: &PickHit) -> Option<(usize, u32)> {
        let index = pick.surface? as usize;
        let surface = self.frame.surfaces.get(index).filter(|surface| surface.muscle.is_none())?;
        let corners = surface.mesh.triangles.get(pick.triangle as usize)?;
        let far = |corner: &u32| surface.position(*corner).distance_squared(pick.point);
        corners.iter().copied().min_by(|a, b| far(a).total_cmp(&far(b))).map(|vertex| (index, vertex))
    }

    /// The vertex that was clicked, explained; `None` where none was or the selection has gone elsewhere.
    pub fn vertex_influences(&mut self) -> Option<VertexInfluences> {
        self.frame();
        let (surface, vertex) = self.probe.vertex?;
        let same = self.frame.surfaces.get(surface).map(|surface| surface.node) == self.view.display.highlight.selected;
        self.document.vertex_influences(&self.buffers, &self.frame, surface, vertex).filter(|_| same)
    }

    /// The last two points that were clicked, oldest first, and where they are now; world, metres.
    pub fn probed_point(&mut self) -> [Option<Vec3>; 2] {
        self.frame();
        self.probe.last.map(|pin| pin?.place(&self.frame))
    }

    /// The matrices of a node at the present moment.
    pub fn matrices(&mut self, node: NodeId) -> Option<Matrices> {
        self.frame();
        let graph = &self.document.scene.graph;
        let world = *self.frame.world.get(node.index())?;
        let above = graph.node(node).parent().and_then(|parent| self.frame.world.get(parent.index()));
        let inverse_bind = self.inverse_bind(node);
        Some(Matrices {
            local: above.map_or(world, |above| above.inverse() * world),
            world,
            bind: inverse_bind.map(|matrix| matrix.inverse()),
            inverse_bind,
        })
    }

    /// The inverse bind matrix of a joint in the first skin that uses it.
    fn inverse_bind(&self, node: NodeId) -> Option<DMat4> {
        let scene = &self.document.scene;
        let contents = scene.graph.iter().flat_map(|(_, node)| &node.contents);
        let deformers = contents.filter_map(|content| if let Content::Mesh(mesh) = content { Some(&mesh.deformers) } else { None });
        deformers.flatten().find_map(|deformer| {
            let Deformer::Skin { skin, joints } = deformer else { return None };
            let place = joints.iter().position(|joint| *joint == Some(node))?;
            scene.skins.get(skin.index())?.joints.get(place).map(|joint| joint.inverse_bind)
        })
    }

    /// The three bones whose angle is shown while `node` is selected: those that the user chose, else the node's own.
    pub fn angle_bones(&self, node: NodeId) -> Option<[NodeId; 3]> {
        self.probe.angle.or_else(|| self.own_angle_bones(node))
    }

    /// The three bones that the user chose.
    pub fn chosen_angle(&self) -> Option<[NodeId; 3]> {
        self.probe.angle
    }

    /// Chooses the three bones whose angle is shown, the corner in the middle; `None` = those of the selected joint.
    pub fn choose_angle(&mut self, bones: Option<[NodeId; 3]>) {
        let count = self.document.scene.graph.len();
        self.probe.angle = bones.filter(|bones| bones.iter().all(|bone| bone.index() < count));
        self.changed(ChangeSet::PROBE);
    }

    /// The joints, to choose from.
    pub fn joints(&self) -> Vec<NodeId> {
        self.document.scene.graph.iter().filter(|(_, node)| node.kind == NodeKind::Joint).map(|(id, _)| id).collect()
    }

    /// The three bones whose angle belongs to a joint: the joint above, itself, and the first joint below. `None` at the ends of a chain.
    fn own_angle_bones(&self, node: NodeId) -> Option<[NodeId; 3]> {
        let graph = &self.document.scene.graph;
        let is_joint = |id: &NodeId| graph.node(*id).kind == NodeKind::Joint;
        let node = Some(node).filter(|id| id.index() < graph.len() && is_joint(id))?;
        let above = graph.node(node).parent().filter(is_joint)?;
        let below = graph.node(node).children().iter().copied().find(is_joint)?;
        Some([above, node, below])
    }

    /// Sets the override of a joint, degrees about its own axes. Within [`Session::undoable`] undo takes it back.
    pub fn override_joint(&mut self, node: NodeId, degrees: DVec3) {
        let joints = &mut self.state.joints;
        let before = joints.joint_override(node);
        if node.index() < self.document.scene.graph.len() {
            joints.set_override(node, degrees);
        }
        if joints.joint_override(node) != before {
            self.changed(ChangeSet::JOINT_OVERRIDES);
        }
    }

    /// Removes the joint override of one node, or all overrides.
    pub fn reset_joint_overrides(&mut self, node: Option<NodeId>) {
        let is_kept = |turn: &JointOverride| node.is_some_and(|node| turn.node != node);
        if !self.state.joints.overrides().iter().all(is_kept) {
            self.undoable(message!("app-edit-reset-rotations"), UndoStep::New, |session| {
                session.state.joints.retain_overrides(is_kept);
                session.changed(ChangeSet::JOINT_OVERRIDES);
            });
        }
    }
}
