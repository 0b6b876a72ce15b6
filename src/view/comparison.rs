//! Two things in one view: another file, another clip, or the same skin bent the other way.

use std::collections::HashMap;

use glam::{DMat4, DVec3};

use super::overlays::{PoseContext, color};
use super::session_file::SavedComparison;
use crate::document::{Companion, Document, PoseState, Skinning};
use crate::scene::{Bounds, Frame, Ghost, NodeId, NodeKind};

/// The tint of the second one.
pub const TINT: u32 = 0x53_9BF5;

/// Thousandths of its distance by which the second one is pushed back in depth.
const BEHIND: f32 = 0.1;

/// What is compared with what is open.
#[derive(Debug, Clone)]
pub enum With {
    /// Another file.
    File(Box<Document>, String),
    /// Another clip of the same file, by its place.
    Clip(usize),
    /// The same, its skins bent the other way: linear blend against dual quaternions.
    Skinning,
}

/// A comparison under way.
#[derive(Debug)]
pub struct Comparison {
    with: With,
    /// What the compared clip is found by after the file came again.
    key: Option<String>,
    /// The clip of another file that plays.
    clip: Option<usize>,
    later: f64,
    aside: f64,
    /// Unit direction in which the second one is moved aside.
    direction: DVec3,
    companion: Companion,
    /// The same joint here and there.
    pairs: Vec<(NodeId, NodeId)>,
    farthest: Option<(Option<NodeId>, f64)>,
}

impl Comparison {
    /// A comparison of `own` with something; `yaw` = the camera's, degrees, for what is aside stands to the right as one looks. `None` where it is with a
    /// clip that is not there.
    pub fn new(with: With, own: &Document, yaw: f32) -> Option<Self> {
        if matches!(with, With::Clip(clip) if clip >= own.clips.len()) {
            return None;
        }
        let other = match &with {
            With::File(other, _) => other,
            With::Clip(_) | With::Skinning => own,
        };
        let (pairs, clip) = (pairs(own, other), other.start_state().clip);
        let yaw = f64::from(yaw).to_radians();
        // Along the nearer axis.
        let right = DVec3::new(yaw.cos(), 0.0, -yaw.sin());
        let direction = if right.x.abs() >= right.z.abs() { DVec3::X * right.x.signum() } else { DVec3::Z * right.z.signum() };
        let key = match &with {
            With::Clip(clip) => own.clip_key(*clip),
            With::File(..) | With::Skinning => None,
        };
        Some(Self { with, key, clip, later: 0.0, aside: 0.0, direction, companion: Companion::default(), pairs, farthest: None })
    }

    /// What is compared with.
    pub fn with(&self) -> &With {
        &self.with
    }

    /// Seconds that the second one is ahead and metres that it stands aside.
    pub fn shifted(&self) -> (f64, f64) {
        (self.later, self.aside)
    }

    /// Unit direction in which the second one is moved aside.
    pub fn toward(&self) -> DVec3 {
        self.direction
    }

    /// Moves the second one as a session file says; numbers that are none change nothing.
    pub fn shift_as(&mut self, saved: &SavedComparison) {
        self.direction = saved.toward.and_then(|toward| DVec3::from_array(toward).try_normalize()).unwrap_or(self.direction);
        self.shift_to(saved.later, saved.aside);
    }

    /// Moves the second one in time (seconds ahead) and in space (metres aside); whether that changes anything. Numbers that are none do not.
    pub fn shift_to(&mut self, later: f64, aside: f64) -> bool {
        let moved = later.is_finite() && aside.is_finite() && (self.later, self.aside) != (later, aside);
        if moved {
            (self.later, self.aside) = (later, aside);
        }
        moved
    }

    /// Where both are the same but for their skins, puts the second one beside the first, whose box is given; whether it did.
    pub fn stand_beside(&mut self, bounds: &Bounds) -> bool {
        let size = bounds.size();
        let width = if self.direction.x == 0.0 { size.z } else { size.x };
        let beside = matches!(self.with, With::Skinning) && width.is_finite() && width != 0.0;
        if beside {
            self.aside = f64::from(width) * 1.15;
        }
        beside
    }

    /// The joint that is farthest from its counterpart, and how far, metres; of two ways to bend a skin the farthest vertex, which has no joint.
    /// `None` where the two have no joint in common.
    pub fn farthest(&self) -> Option<(Option<NodeId>, f64)> {
        self.farthest
    }

    /// The box round the second one.
    pub fn bounds(&self) -> Bounds {
        self.companion.bounds()
    }

    /// The box round everything that the second one covers.
    pub fn reach(&self, own: &Document, state: &PoseState) -> Bounds {
        self.other(own).reach(&self.state(own, state))
    }

    /// The same for another frame.
    pub(super) fn anew(&self) -> Self {
        let Self { with, key, clip, later, aside, direction, pairs, .. } = self;
        let (companion, farthest) = (Companion::default(), None);
        let (with, key, pairs) = (with.clone(), key.clone(), pairs.clone());
        Self { with, key, clip: *clip, later: *later, aside: *aside, direction: *direction, companion, pairs, farthest }
    }

    /// Compares with what the other file holds now; anything else than a file stays.
    pub fn take_file(&mut self, document: Document, own: &Document) {
        if let With::File(other, _) = &mut self.with {
            (self.clip, self.pairs) = (document.start_state().clip, pairs(own, &document));
            **other = document;
            (self.companion, self.farthest) = (Companion::default(), None);
        }
    }

    /// The same comparison after the same files came again as `own`; `None` where its clip is lost.
    pub(super) fn renewed(mut self, own: &Document) -> Option<Self> {
        if let (With::Clip(clip), Some(key)) = (&mut self.with, &self.key) {
            *clip = own.clip_named(key)?;
        }
        let pairs = pairs(own, self.other(own));
        Some(Self { companion: Companion::default(), pairs, ..self })
    }

    /// Takes surfaces back from the main frame.
    pub(super) fn recall(&mut self, frame: &mut Frame) {
        self.companion.take_back(frame);
    }

    /// Poses the second one and finds the joint that is farthest off; `frame` is the first one's.
    pub(super) fn pose(&mut self, host: &PoseContext<'_>, frame: &Frame) {
        let theirs = self.state(host.document, &host.state);
        let shift = self.shift();
        let other = match &self.with {
            With::File(other, _) => other,
            With::Clip(_) | With::Skinning => host.document,
        };
        self.companion.pose(other, &theirs);
        let there = &self.companion.frame().world;
        self.farthest = if let With::Skinning = self.with {
            Some((None, f64::from(self.companion.farthest_vertex(frame, shift.as_vec3()))))
        } else {
            let distance = |(own, other): &(NodeId, NodeId)| {
                let (a, b) = (frame.world.get(own.index())?, there.get(other.index())?);
                Some((Some(*own), a.w_axis.truncate().distance(b.w_axis.truncate() - shift)))
            };
            self.pairs.iter().filter_map(distance).filter(|(_, far)| far.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1))
        };
    }

    /// Puts the second one into the frame.
    pub(super) fn lend(&mut self, host: &PoseContext<'_>, frame: &mut Frame) {
        let tint = color(TINT);
        let beside = self.aside != 0.0;
        let opacity = if beside { 1.0 } else { 0.6 };
        let (share, materials) = match self.with {
            With::Skinning => (0.0, true),
            With::Clip(_) => (0.45, true),
            With::File(..) => (0.45, false),
        };
        let other = match &self.with {
            With::File(other, _) => other,
            With::Clip(_) | With::Skinning => host.document,
        };
        if host.bones || !other.shows_surface() {
            self.companion.sketch_bones(&other.scene, tint, 0.9, &mut frame.marks);
        }
        let bounds = self.companion.bounds();
        // Where both are the same the first one is seen, clean.
        let behind = if beside { 0.0 } else { BEHIND };
        self.companion.lend(frame, Ghost { tint, share, opacity, materials, behind });
        if !bounds.is_empty() {
            frame.bounds.merge(&bounds);
        }
    }

    fn other<'a>(&'a self, own: &'a Document) -> &'a Document {
        match &self.with {
            With::File(document, _) => document,
            With::Clip(_) | With::Skinning => own,
        }
    }

    fn shift(&self) -> DVec3 {
        self.direction * self.aside
    }

    /// The state of the second one while the first one is in `state`.
    fn state(&self, own: &Document, state: &PoseState) -> PoseState {
        let model = DMat4::from_translation(self.shift()) * state.model;
        let start = |document: &Document, clip: Option<usize>| clip.and_then(|clip| document.clips.get(clip)).map(|clip| clip.start);
        let since = state.time - start(own, state.clip).unwrap_or(0.0);
        let moment = |document: &Document, clip: Option<usize>| {
            let clip = clip.and_then(|clip| document.clips.get(clip));
            clip.map_or(0.0, |clip| (clip.start + since + self.later).clamp(clip.start, clip.end.max(clip.start)))
        };
        match &self.with {
            With::File(other, _) => {
                let drive = other.driven_rig().map(|rig| {
                    if rig.flexion_range().is_some() {
                        rig.at_flexion(state.drive.flexion)
                    } else {
                        rig.at_contraction(state.drive.contraction)
                    }
                });
                let (clip, time) = (self.clip, moment(other, self.clip));
                PoseState { clip, time, drive: drive.unwrap_or_default(), turn: None, model, skinning: state.skinning }
            }
            With::Clip(clip) => PoseState { clip: Some(*clip), time: moment(own, Some(*clip)), model, ..*state },
            With::Skinning => PoseState { model, skinning: other_way(state.skinning), ..*state },
        }
    }
}

fn other_way(skinning: Skinning) -> Skinning {
    match skinning {
        Skinning::Linear => Skinning::DualQuaternion,
        Skinning::DualQuaternion => Skinning::Linear,
    }
}

/// Joints of the same name (else of the same id) here and there.
fn pairs(own: &Document, other: &Document) -> Vec<(NodeId, NodeId)> {
    let joints = |document: &Document| -> Vec<NodeId> {
        document.scene.graph.iter().filter(|(_, node)| node.kind == NodeKind::Joint).map(|(id, _)| id).collect()
    };
    let (mut names, mut ids) = (HashMap::new(), HashMap::new());
    for id in joints(other) {
        let node = other.scene.graph.node(id);
        names.entry(node.name.as_str()).or_insert(id);
        ids.entry(node.id.as_str()).or_insert(id);
    }
    let same = |id: NodeId| {
        let node = own.scene.graph.node(id);
        let found = names.get(node.name.as_str()).or_else(|| ids.get(node.id.as_str()).filter(|_| !node.id.is_empty()));
        found.map(|other| (id, *other))
    };
    joints(own).into_iter().filter_map(same).collect()
}

impl SavedComparison {
    /// What a session file compares with that is in the document itself: a clip, the other way to bend a skin.
    pub fn within(&self, document: &Document) -> Option<With> {
        let clip = self.clip.as_ref().and_then(|name| document.clip_named(name));
        clip.map(With::Clip).or(self.skinning.then_some(With::Skinning))
    }
}
