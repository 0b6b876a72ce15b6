//! Bones as a muscle file names them, and the points of a muscle on them, in the world.

use std::borrow::Cow;

use glam::{DMat4, DVec3};

use super::build::find_bone;
use super::config::Anchor;
use super::line_of_action::{Frames, Point};
use super::muscle_rig::MuscleRig;
use sinew_scene::{Graph, NodeId};

/// A point of a muscle that can be dragged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AttachmentPoint {
    /// The origin (0) or the insertion (1).
    End(usize),
    /// A point on the way, from 0.
    Via(usize),
    /// The centre of a surface that the muscle goes round, from 0.
    Wrap(usize),
}

/// What a muscle file calls `node`, so that it is found again: its name where that tells it from all others, else its id; its place in its file where it has
/// neither. `None` where none of them does.
pub fn bone_name(graph: &Graph, own: Option<NodeId>, node: NodeId) -> Option<String> {
    let about = graph.node(node);
    [graph.label(node).plain(), about.id.as_str().into(), about.sid.as_str().into()]
        .into_iter()
        .find(|name| !name.is_empty() && find_bone(graph, own, name) == Some(node))
        .map(Cow::into_owned)
}

impl MuscleRig {
    /// What this file calls `node`. On the arm only its two bones have names; the elbow and the parts of the forearm stand for the forearm.
    pub fn bone_name(&self, graph: &Graph, node: NodeId) -> Option<String> {
        let Some((_, nodes)) = &self.arm else { return bone_name(graph, self.root, node) };
        if graph.subtree(nodes.elbow).contains(&node) {
            Some(super::arm::FOREARM.to_owned())
        } else {
            graph.subtree(nodes.upper).contains(&node).then(|| super::arm::UPPER_ARM.to_owned())
        }
    }

    /// The two bones of the arm, upper one first; `None` without an arm.
    pub fn arm_bones(&self) -> Option<[NodeId; 2]> {
        self.arm.as_ref().map(|(_, nodes)| [nodes.upper, nodes.elbow])
    }

    /// The node whose axes an offset on `node` is along: on the arm, the upper rod's or the elbow's.
    pub(super) fn carrier(&self, graph: &Graph, node: NodeId) -> NodeId {
        match &self.arm {
            Some((_, nodes)) if graph.subtree(nodes.elbow).contains(&node) => nodes.elbow,
            Some((_, nodes)) => nodes.upper,
            None => node,
        }
    }

    /// The frame of a bone as offsets have it: from the file's root, in its unit, axes of length 1. `world` is one matrix a node.
    fn bone_frame(&self, node: NodeId, world: &[DMat4]) -> DMat4 {
        let frames = self.frames(world);
        super::muscle_rig::WorldFrames { bones: &[node], ..frames }.frame(0)
    }

    /// A point of the world (metres) as a place on the bone `node`, to the hundredth of a millimetre; `None` where the file has no name for that
    /// bone.
    pub fn anchor_at(&self, graph: &Graph, node: NodeId, place: DVec3, world: &[DMat4]) -> Option<Anchor> {
        let bone = self.bone_name(graph, node)?;
        let frame = self.bone_frame(self.carrier(graph, node), world);
        let inside = self.frames(world).from_world.transform_point3(place);
        let frame = if frame.determinant().abs() > f64::MIN_POSITIVE { frame } else { DMat4::from_translation(frame.w_axis.truncate()) };
        Some(Anchor { bone, offset: self.tidy(frame.inverse().transform_point3(inside), world) }).filter(|anchor| anchor.offset.is_finite())
    }

    /// A direction of the world along the axes of the bone `node`.
    pub(super) fn direction_on(&self, node: NodeId, direction: DVec3, world: &[DMat4]) -> DVec3 {
        let inside = self.frames(world).from_world.transform_vector3(direction);
        let local = self.bone_frame(node, world).inverse().transform_vector3(inside).normalize_or(DVec3::X);
        (local * 1e4).round() / 1e4
    }

    /// Lengths of the file's unit in a metre of the world, in this pose.
    pub(super) fn per_metre(&self, world: &[DMat4]) -> f64 {
        self.frames(world).from_world.x_axis.truncate().length()
    }

    /// Numbers that a person can read: to the hundredth of a millimetre.
    fn tidy(&self, offset: DVec3, world: &[DMat4]) -> DVec3 {
        let step = 10f64.powf((1e-5 * self.per_metre(world)).log10().round());
        // A division by whole steps a unit keeps 0.1 what it is in decimals.
        let round = |value: f64| if step < 1.0 { (value * (1.0 / step).round()).round() / (1.0 / step).round() } else { value };
        DVec3::new(round(offset.x), round(offset.y), round(offset.z)) + DVec3::ZERO
    }

    /// Where a point of muscle `index` is in the world, metres; `None` where it has no such point.
    pub fn hold(&self, index: usize, hold: AttachmentPoint, world: &[DMat4]) -> Option<DVec3> {
        let line = self.muscles.get(index)?.line.as_ref()?;
        let (root, frames) = (self.root_matrix(world), self.frames(world));
        // A via point that is not passed has a place all the same.
        let moving = match hold {
            AttachmentPoint::Via(number) => line.place(number + 1, &frames),
            _ => None,
        };
        let place = moving.or_else(|| self.hold_point(index, hold).map(|point| frames.place(point)))?;
        Some(root.transform_point3(place))
    }

    /// The bone that a point of muscle `index` is on.
    pub fn hold_bone(&self, index: usize, hold: AttachmentPoint) -> Option<NodeId> {
        self.bones.get(self.hold_point(index, hold)?.bone).copied()
    }

    fn hold_point(&self, index: usize, hold: AttachmentPoint) -> Option<Point> {
        let line = self.muscles.get(index)?.line.as_ref()?;
        match hold {
            AttachmentPoint::End(0) => Some(line.origin),
            AttachmentPoint::End(_) => Some(line.insertion),
            AttachmentPoint::Via(number) => line.via.get(number).map(|via| via.point),
            AttachmentPoint::Wrap(number) => line.wraps.get(number).map(|wrap| wrap.center),
        }
    }

    /// The points of muscle `index` that can be dragged.
    pub fn holds(&self, index: usize) -> impl Iterator<Item = AttachmentPoint> + '_ {
        let line = self.muscles.get(index).and_then(|muscle| muscle.line.as_ref());
        let via = line.map_or(0, |line| line.via.len());
        let ends = if line.is_some() { 2 } else { 0 };
        let wraps = line.map_or(0, |line| line.wraps.len());
        (0..ends).map(AttachmentPoint::End).chain((0..via).map(AttachmentPoint::Via)).chain((0..wraps).map(AttachmentPoint::Wrap))
    }
}
