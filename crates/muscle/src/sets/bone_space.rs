//! The bones of a scene at rest, and places on them as muscle files have them.

use glam::{DMat4, DQuat, DVec3};
use sinew_scene::{Graph, NodeId};

use super::super::bones::bone_name;
use super::super::joint_dof::rotation;
use super::super::line_of_action::Frames;
use super::super::revolute_joint::plain;
use super::super::scaling;
use super::error::SetError;
use crate::config::{Anchor, MuscleFile};

/// Metres a unit of the files that are made.
pub(super) const UNIT: f64 = 0.001;
/// Steps of numbers in the file: far below what can be seen, so that left and right stay alike to a millionth of a metre.
pub(super) const STEPS: f64 = 1e5;

/// The bones of a scene at rest, as offsets of a file see them.
pub(super) struct Bones<'a> {
    pub graph: &'a Graph,
    world: &'a [DMat4],
    /// Metres a unit of the file.
    unit: f64,
    /// By what offsets are multiplied on each node; `None` where they are in the file's unit whatever the scale of the bones.
    ride: Option<Vec<f64>>,
    /// The bones' scale at which the file's lengths hold.
    pub scale: f64,
}

impl<'a> Bones<'a> {
    /// Bones whose lengths hold at the scale of this one.
    pub(super) fn new(graph: &'a Graph, world: &'a [DMat4], bone: NodeId) -> Self {
        let scale = Some(scaling::of_bone(graph, world, bone)).filter(|scale| *scale > 0.0 && scale.is_finite()).unwrap_or(1.0);
        Self { graph, world, unit: UNIT, ride: Some(scaling::ride(graph, UNIT, scale)), scale }
    }

    /// Bones as a file sees them.
    pub(super) fn of_file(graph: &'a Graph, world: &'a [DMat4], file: &MuscleFile) -> Self {
        let ride = file.scale.map(|scale| scaling::ride(graph, file.unit_metres, scale));
        Self { graph, world, unit: file.unit_metres, ride, scale: file.scale.unwrap_or(1.0) }
    }

    pub(super) fn matrix(&self, id: NodeId) -> DMat4 {
        self.world.get(id.index()).copied().unwrap_or(DMat4::IDENTITY)
    }

    /// The frame of a bone in the file's unit, seen from the world's origin.
    pub(super) fn frame(&self, id: NodeId) -> DMat4 {
        let mut frame = DMat4::from_scale(DVec3::splat(self.unit.recip())) * self.matrix(id);
        let Some(ride) = &self.ride else { return plain(frame) };
        let ride = ride.get(id.index()).copied().unwrap_or(1.0);
        for axis in [&mut frame.x_axis, &mut frame.y_axis, &mut frame.z_axis] {
            *axis *= ride;
        }
        frame
    }

    pub(super) fn name(&self, id: NodeId) -> Result<String, SetError> {
        bone_name(self.graph, None, id).ok_or_else(|| SetError::NamelessBone(self.graph.label(id).to_owned()))
    }

    pub(super) fn offset(&self, id: NodeId, place: DVec3) -> DVec3 {
        (self.frame(id).inverse().transform_point3(place / self.unit) * STEPS).round() / STEPS + DVec3::ZERO
    }

    pub(super) fn anchor(&self, id: NodeId, place: DVec3) -> Result<Anchor, SetError> {
        Ok(Anchor { bone: self.name(id)?, offset: self.offset(id, place) })
    }

    /// A direction of the world along a bone's own axes.
    pub(super) fn direction(&self, id: NodeId, direction: DVec3) -> DVec3 {
        self.frame(id).inverse().transform_vector3(direction).normalize_or_zero()
    }

    /// Where an offset on a bone is in the world, metres.
    pub(super) fn place(&self, id: NodeId, offset: DVec3) -> DVec3 {
        self.frame(id).transform_point3(offset) * self.unit
    }

    /// An axis of a turn in the world as the axis of a joint at this bone, along the bone's own axes.
    pub(super) fn joint_axis(&self, id: NodeId, axis: DVec3) -> DVec3 {
        // What turns is the node in the axes of the one above it; where these are mirrored, to the other hand.
        let parent = self.parent(id);
        let axis = parent.inverse().transform_vector3(axis) * parent.determinant().signum();
        let own = self.own_rotation(id).inverse() * axis;
        (own.normalize_or(DVec3::Z) * 1e9).round() / 1e9 + DVec3::ZERO
    }

    /// The way back: the axis of a joint at this bone in the world.
    pub(super) fn turn_axis(&self, id: NodeId, axis: DVec3) -> DVec3 {
        let parent = self.parent(id);
        (parent.transform_vector3(self.own_rotation(id) * axis) * parent.determinant().signum()).normalize_or(DVec3::Z)
    }

    fn parent(&self, id: NodeId) -> DMat4 {
        self.graph.node(id).parent().map_or(DMat4::IDENTITY, |id| self.matrix(id))
    }

    fn own_rotation(&self, id: NodeId) -> DQuat {
        rotation(&self.graph.node(id).transform.matrix()).unwrap_or_default()
    }

    /// By what lengths of a muscle from this bone are multiplied.
    pub(super) fn muscle_scale(&self, id: NodeId) -> f64 {
        let scale = scaling::of_bone(self.graph, self.world, id) / self.scale;
        if scale > 0.0 && scale.is_finite() { scale } else { 1.0 }
    }
}

/// Bones at rest by their number in a list; all joints are at rest.
pub(super) struct RestFrames(pub Vec<DMat4>);

impl Frames for RestFrames {
    fn frame(&self, index: usize) -> DMat4 {
        self.0.get(index).copied().unwrap_or(DMat4::IDENTITY)
    }

    fn angle(&self, _: usize) -> f64 {
        0.0
    }
}
