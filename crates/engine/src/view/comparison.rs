//! Comparison of two poses in one view: with another file, another clip, or the other skinning method.

use std::collections::HashMap;

use glam::{DMat4, DVec3};

use super::pose_context::{PoseContext, color};
use super::session_file::SavedComparison;
use crate::document::{Document, JointControl, PoseState, PosedCopy, Skinning};
use sinew_scene::{Bounds, Frame, Ghost, NodeId, NodeKind};

/// Tint of the compared pose, `0xRRGGBB`.
pub const TINT: u32 = 0x53_9BF5;

/// Depth offset of the compared pose, thousandths of its distance from the camera.
const DEPTH_OFFSET: f32 = 0.1;

/// What the open document is compared with.
#[derive(Debug, Clone)]
pub enum CompareTarget {
    /// Another file.
    File(Box<Document>, String),
    /// Another clip of the same file, by its index.
    Clip(usize),
    /// The same pose with the other skinning method: linear blend against dual quaternions.
    Skinning,
}

/// A comparison under way.
#[derive(Debug)]
pub struct PoseComparison {
    target: CompareTarget,
    /// Key by which the compared clip is found after a reload.
    key: Option<String>,
    /// The clip of another file that plays with this one.
    clip: Option<usize>,
    /// Seconds by which the compared pose is ahead.
    /// Seconds by which the compared pose is ahead.
    time_offset: f64,
    /// Metres by which the compared pose stands beside the main one.
    offset: f64,
    /// Unit direction of `offset`.
    direction: DVec3,
    posed: PosedCopy,
    /// Corresponding joints of the main document and the compared one.
    joint_pairs: Vec<(NodeId, NodeId)>,
    max_deviation: Option<(Option<NodeId>, f64)>,
}

impl PoseComparison {
    /// A comparison of `document` with `target`. `yaw` is the camera's, degrees: the offset points to the right of the view. `None` where the target is a
    /// clip that does not exist.
    pub fn new(target: CompareTarget, document: &Document, yaw: f32) -> Option<Self> {
        if matches!(target, CompareTarget::Clip(clip) if clip >= document.clips.len()) {
            return None;
        }
        let other = match &target {
            CompareTarget::File(other, _) => other,
            CompareTarget::Clip(_) | CompareTarget::Skinning => document,
        };
        let (pairs, clip) = (joint_pairs(document, other), other.start_state().clip);
        let yaw = f64::from(yaw).to_radians();
        // Along the nearer axis.
        let right = DVec3::new(yaw.cos(), 0.0, -yaw.sin());
        let direction = if right.x.abs() >= right.z.abs() { DVec3::X * right.x.signum() } else { DVec3::Z * right.z.signum() };
        let key = match &target {
            CompareTarget::Clip(clip) => document.clip_key(*clip),
            CompareTarget::File(..) | CompareTarget::Skinning => None,
        };
        Some(Self {
            target,
            key,
            clip,
            time_offset: 0.0,
            offset: 0.0,
            direction,
            posed: PosedCopy::default(),
            joint_pairs: pairs,
            max_deviation: None,
        })
    }

    /// What is compared with.
    pub fn target(&self) -> &CompareTarget {
        &self.target
    }

    /// Time offset, seconds, and spatial offset, metres, of the compared pose.
    pub fn offsets(&self) -> (f64, f64) {
        (self.time_offset, self.offset)
    }

    /// Unit direction of the spatial offset.
    pub fn direction(&self) -> DVec3 {
        self.direction
    }

    /// Sets direction and offsets from a session file; numbers that are not finite change nothing.
    pub fn apply_saved(&mut self, saved: &SavedComparison) {
        self.direction = saved.toward.and_then(|toward| DVec3::from_array(toward).try_normalize()).unwrap_or(self.direction);
        self.set_offsets(saved.later, saved.aside);
    }

    /// Sets the offsets in time (seconds ahead) and space (metres); returns whether anything changed. Numbers that are not finite change nothing.
    pub fn set_offsets(&mut self, later: f64, aside: f64) -> bool {
        let moved = later.is_finite() && aside.is_finite() && (self.time_offset, self.offset) != (later, aside);
        if moved {
            (self.time_offset, self.offset) = (later, aside);
        }
        moved
    }

    /// Where both are the same but for their skins, puts the second one beside the first, whose box is given; whether it did.
    pub fn place_beside(&mut self, bounds: &Bounds) -> bool {
        let size = bounds.size();
        let width = if self.direction.x == 0.0 { size.z } else { size.x };
        let is_beside = matches!(self.target, CompareTarget::Skinning) && width.is_finite() && width != 0.0;
        if is_beside {
            self.offset = f64::from(width) * 1.15;
        }
        is_beside
    }

    /// The joint that is farthest from its counterpart, and how far, metres; of two ways to bend a skin the farthest vertex, which has no joint.
    /// `None` where the two have no joint in common.
    pub fn max_deviation(&self) -> Option<(Option<NodeId>, f64)> {
        self.max_deviation
    }

    /// Bounding box of the compared pose.
    pub fn bounds(&self) -> Bounds {
        self.posed.bounds()
    }

    /// Bounding box of the whole movement of the compared document.
    pub fn motion_bounds(&self, document: &Document, state: &PoseState) -> Bounds {
        self.other(document).motion_bounds(&self.state(document, state))
    }

    /// A copy for another frame, without posed buffers.
    pub(super) fn clone_for_frame(&self) -> Self {
        let Self { target, key, clip, time_offset: later, offset: aside, direction, joint_pairs: pairs, .. } = self;
        let (companion, farthest) = (PosedCopy::default(), None);
        let (target, key, pairs) = (target.clone(), key.clone(), pairs.clone());
        Self {
            target,
            key,
            clip: *clip,
            time_offset: *later,
            offset: *aside,
            direction: *direction,
            posed: companion,
            joint_pairs: pairs,
            max_deviation: farthest,
        }
    }

    /// Replaces the compared file after its reload; a comparison with anything else stays as it is.
    pub fn replace_file(&mut self, replacement: Document, document: &Document) {
        if let CompareTarget::File(other, _) = &mut self.target {
            (self.clip, self.joint_pairs) = (replacement.start_state().clip, joint_pairs(document, &replacement));
            **other = replacement;
            (self.posed, self.max_deviation) = (PosedCopy::default(), None);
        }
    }

    /// The same comparison after a reload as `document`; `None` where its clip no longer exists.
    pub(super) fn rebound(mut self, document: &Document) -> Option<Self> {
        if let (CompareTarget::Clip(clip), Some(key)) = (&mut self.target, &self.key) {
            *clip = document.clip_named(key)?;
        }
        let pairs = joint_pairs(document, self.other(document));
        Some(Self { posed: PosedCopy::default(), joint_pairs: pairs, ..self })
    }

    /// Moves the surfaces out of the main frame, back into the buffers.
    pub(super) fn remove_from(&mut self, frame: &mut Frame) {
        self.posed.remove_from(frame);
    }

    /// Poses the second one and finds the joint that is farthest off; `frame` is the first one's.
    pub(super) fn pose(&mut self, context: &PoseContext<'_>, frame: &Frame) {
        let other_state = self.state(context.document, &context.state);
        let translation = self.translation();
        let other = match &self.target {
            CompareTarget::File(other, _) => other,
            CompareTarget::Clip(_) | CompareTarget::Skinning => context.document,
        };
        self.posed.pose(other, &other_state);
        let other_world = &self.posed.frame().world;
        self.max_deviation = if let CompareTarget::Skinning = self.target {
            Some((None, f64::from(self.posed.max_vertex_distance(frame, translation.as_vec3()))))
        } else {
            let distance = |(document, other): &(NodeId, NodeId)| {
                let (a, b) = (frame.world.get(document.index())?, other_world.get(other.index())?);
                Some((Some(*document), a.w_axis.truncate().distance(b.w_axis.truncate() - translation)))
            };
            self.joint_pairs.iter().filter_map(distance).filter(|(_, distance)| distance.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1))
        };
    }

    /// Appends the compared pose to the frame.
    pub(super) fn append_to(&mut self, context: &PoseContext<'_>, frame: &mut Frame) {
        let tint = color(TINT);
        let is_beside = self.offset != 0.0;
        let opacity = if is_beside { 1.0 } else { 0.6 };
        let (tint_share, materials) = match self.target {
            CompareTarget::Skinning => (0.0, true),
            CompareTarget::Clip(_) => (0.45, true),
            CompareTarget::File(..) => (0.45, false),
        };
        let other = match &self.target {
            CompareTarget::File(other, _) => other,
            CompareTarget::Clip(_) | CompareTarget::Skinning => context.document,
        };
        if context.bones || !other.shows_surface() {
            self.posed.append_bone_lines(&other.scene, tint, 0.9, &mut frame.overlay_lines);
        }
        let bounds = self.posed.bounds();
        // Where both coincide the main one is drawn in front.
        let depth_offset = if is_beside { 0.0 } else { DEPTH_OFFSET };
        self.posed.append_to(frame, Ghost { tint, tint_share, opacity, materials, depth_offset });
        if !bounds.is_empty() {
            frame.bounds.merge(&bounds);
        }
    }

    fn other<'a>(&'a self, document: &'a Document) -> &'a Document {
        match &self.target {
            CompareTarget::File(document, _) => document,
            CompareTarget::Clip(_) | CompareTarget::Skinning => document,
        }
    }

    fn translation(&self) -> DVec3 {
        self.direction * self.offset
    }

    /// Pose state of the compared document while the main one is in `state`.
    fn state(&self, document: &Document, state: &PoseState) -> PoseState {
        let model = DMat4::from_translation(self.translation()) * state.model;
        let start = |document: &Document, clip: Option<usize>| clip.and_then(|clip| document.clips.get(clip)).map(|clip| clip.start);
        let since = state.time - start(document, state.clip).unwrap_or(0.0);
        let moment = |document: &Document, clip: Option<usize>| {
            let clip = clip.and_then(|clip| document.clips.get(clip));
            clip.map_or(0.0, |clip| (clip.start + since + self.time_offset).clamp(clip.start, clip.end.max(clip.start)))
        };
        match &self.target {
            CompareTarget::File(other, _) => {
                let drive = other.driven_rig().map(|rig| {
                    if rig.flexion_range().is_some() {
                        rig.at_flexion(state.joints.drive.flexion)
                    } else {
                        rig.at_contraction(state.joints.drive.contraction)
                    }
                });
                let (clip, time) = (self.clip, moment(other, self.clip));
                PoseState {
                    clip,
                    time,
                    joints: JointControl::driven(drive.unwrap_or_default()),
                    model,
                    skinning: state.skinning,
                    skin: state.skin,
                }
            }
            CompareTarget::Clip(clip) => PoseState { clip: Some(*clip), time: moment(document, Some(*clip)), model, ..state.clone() },
            CompareTarget::Skinning => PoseState { model, skinning: other_skinning(state.skinning), ..state.clone() },
        }
    }
}

fn other_skinning(skinning: Skinning) -> Skinning {
    match skinning {
        Skinning::Linear => Skinning::DualQuaternion,
        Skinning::DualQuaternion => Skinning::Linear,
    }
}

/// Pairs of joints of both documents with the same name, else with the same id.
fn joint_pairs(document: &Document, other: &Document) -> Vec<(NodeId, NodeId)> {
    let joints = |document: &Document| -> Vec<NodeId> {
        document.scene.graph.iter().filter(|(_, node)| node.kind == NodeKind::Joint).map(|(id, _)| id).collect()
    };
    let (mut names, mut ids) = (HashMap::new(), HashMap::new());
    for id in joints(other) {
        let node = other.scene.graph.node(id);
        names.entry(other.scene.graph.label(id)).or_insert(id);
        ids.entry(node.id.as_str()).or_insert(id);
    }
    let same = |id: NodeId| {
        let node = document.scene.graph.node(id);
        let found = names.get(&document.scene.graph.label(id)).or_else(|| ids.get(node.id.as_str()).filter(|_| !node.id.is_empty()));
        found.map(|other| (id, *other))
    };
    joints(document).into_iter().filter_map(same).collect()
}

impl SavedComparison {
    /// The target of a session file that lies in the document itself: another clip, or the other skinning method.
    pub fn target_within(&self, document: &Document) -> Option<CompareTarget> {
        let clip = self.clip.as_ref().and_then(|name| document.clip_named(name));
        clip.map(CompareTarget::Clip).or(self.skinning.then_some(CompareTarget::Skinning))
    }
}
