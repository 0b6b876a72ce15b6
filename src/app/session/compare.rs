//! Two things in one view: another file, another clip, or the same skin bent the other way.

use std::collections::HashMap;

use glam::{DMat4, DVec3, Vec3};

use super::ghosts::color;
use super::{Arrival, Changes, Session};
use crate::document::{Companion, Document, PoseState, Skinning};
use crate::scene::{Bounds, Frame, Ghost, NodeId, NodeKind};

/// The tint of the second one.
pub const TINT: u32 = 0x53_9BF5;

/// What is compared with what is open.
#[derive(Debug)]
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

/// What a comparison shows and found out.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared {
    /// Seconds that the second one is ahead.
    pub later: f64,
    /// Metres that it stands aside.
    pub aside: f64,
    /// The joint that is farthest from its counterpart, and how far, metres; of two ways to bend a skin the farthest vertex, which has no joint.
    /// `None` where the two have no joint in common.
    pub farthest: Option<(Option<NodeId>, f64)>,
    /// The boxes round the first and the second one, world.
    pub boxes: [Bounds; 2],
}

impl Comparison {
    /// Takes surfaces back from the main frame.
    pub(super) fn recall(&mut self, frame: &mut Frame) {
        self.companion.take_back(frame);
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

impl Session {
    /// Compares with something; `None` ends it. A clip that is not there is none.
    pub fn compare(&mut self, with: Option<With>) {
        self.recall_company();
        self.stale = true;
        self.comparison = None;
        let with = with.filter(|with| !matches!(with, With::Clip(clip) if *clip >= self.document.clips.len()));
        if let Some(with) = with {
            let other = match &with {
                With::File(other, _) => other,
                With::Clip(_) | With::Skinning => &self.document,
            };
            let pairs = pairs(&self.document, other);
            let clip = other.start_state().clip;
            // Aside means to the right as one looks now, along the nearer axis.
            let yaw = f64::from(self.eye.orbit().yaw).to_radians();
            let right = DVec3::new(yaw.cos(), 0.0, -yaw.sin());
            let direction = if right.x.abs() >= right.z.abs() { DVec3::X * right.x.signum() } else { DVec3::Z * right.z.signum() };
            let size = self.frame().bounds.size();
            let width = if direction.x == 0.0 { size.z } else { size.x };
            let aside = if matches!(with, With::Skinning) && width.is_finite() { f64::from(width) * 1.15 } else { 0.0 };
            let (companion, farthest) = (Companion::default(), None);
            self.comparison = Some(Box::new(Comparison { with, clip, later: 0.0, aside, direction, companion, pairs, farthest }));
            self.stale = true;
            if aside != 0.0 {
                self.fit();
            }
        }
        self.changed(Changes::GHOSTS);
    }

    /// Whether there are skins to bend.
    pub fn has_skins(&self) -> bool {
        !self.document.scene.skins.is_empty()
    }

    /// What is compared with, if anything is.
    pub fn compared_with(&self) -> Option<&With> {
        self.comparison.as_ref().map(|comparison| &comparison.with)
    }

    /// Seconds that the second one is ahead and metres that it stands aside, while something is compared.
    pub fn compared_shift(&self) -> Option<(f64, f64)> {
        self.comparison.as_ref().map(|comparison| (comparison.later, comparison.aside))
    }

    /// Seconds that the second one is ahead; 0 without a comparison.
    pub fn compared_later(&self) -> f64 {
        self.comparison.as_ref().map_or(0.0, |comparison| comparison.later)
    }

    /// Moves the second one in time (seconds ahead) and in space (metres aside).
    pub fn shift_compared(&mut self, later: f64, aside: f64) {
        let Some(comparison) = &mut self.comparison else { return };
        if later.is_finite() && aside.is_finite() && (comparison.later, comparison.aside) != (later, aside) {
            (comparison.later, comparison.aside) = (later, aside);
            self.changed(Changes::GHOSTS);
        }
    }

    /// What the comparison shows and found out at the present moment.
    pub fn compared(&mut self) -> Option<Compared> {
        self.frame();
        let comparison = self.comparison.as_ref()?;
        let Comparison { later, aside, farthest, .. } = **comparison;
        let first = self.frame.surfaces.iter().filter(|surface| surface.ghost.is_none() && surface.visible);
        let mut own = Bounds::EMPTY;
        first.for_each(|surface| surface.mesh.triangles.iter().flatten().step_by(7).for_each(|vertex| own.add(surface.position(*vertex))));
        if own.is_empty() {
            own = Bounds::of(self.frame.joints.iter().map(|joint| self.frame.position(joint.node)));
        }
        Some(Compared { later, aside, farthest, boxes: [own, comparison.companion.bounds()] })
    }

    /// The box round everything that the second one covers.
    pub(super) fn compared_reach(&self) -> Option<Bounds> {
        let comparison = self.comparison.as_ref()?;
        Some(comparison.other(&self.document).reach(&comparison.state(&self.document, &self.state())))
    }

    /// After another document came: a comparison within the old one, or with a file beside it, goes on only where the same files came again.
    pub(super) fn compare_anew(&mut self, arrival: Arrival) {
        let Some(mut comparison) = self.comparison.take().filter(|_| arrival == Arrival::Again) else { return };
        comparison.companion = Companion::default();
        comparison.pairs = pairs(&self.document, comparison.other(&self.document));
        let lost = matches!(&comparison.with, With::Clip(clip) if *clip >= self.document.clips.len());
        self.comparison = Some(comparison).filter(|_| !lost);
    }

    /// Poses the second one and finds the joint that is farthest off.
    pub(super) fn measure_comparison(&mut self, state: &PoseState) {
        let Some(comparison) = &mut self.comparison else { return };
        let theirs = comparison.state(&self.document, state);
        let shift = comparison.shift();
        let other = match &comparison.with {
            With::File(other, _) => other,
            With::Clip(_) | With::Skinning => &self.document,
        };
        comparison.companion.pose(other, &theirs);
        let there = &comparison.companion.frame().world;
        comparison.farthest = if let With::Skinning = comparison.with {
            Some((None, f64::from(comparison.companion.farthest_vertex(&self.frame, shift.as_vec3()))))
        } else {
            let distance = |(own, other): &(NodeId, NodeId)| {
                let (a, b) = (self.frame.world.get(own.index())?, there.get(other.index())?);
                Some((Some(*own), a.w_axis.truncate().distance(b.w_axis.truncate() - shift)))
            };
            comparison.pairs.iter().filter_map(distance).filter(|(_, far)| far.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1))
        };
    }

    /// Puts the second one into the frame.
    pub(super) fn lend_comparison(&mut self, bones: bool) {
        let Some(comparison) = &mut self.comparison else { return };
        let tint = color(TINT);
        let beside = comparison.aside != 0.0;
        let opacity = if beside { 1.0 } else { 0.6 };
        let (share, materials) = match comparison.with {
            With::Skinning => (0.0, true),
            With::Clip(_) => (0.45, true),
            With::File(..) => (0.45, false),
        };
        let other = match &comparison.with {
            With::File(other, _) => other,
            With::Clip(_) | With::Skinning => &self.document,
        };
        if bones || !other.shows_surface() {
            comparison.companion.sketch_bones(&other.scene, tint, 0.9, &mut self.frame.marks);
        }
        let bounds = comparison.companion.bounds();
        comparison.companion.lend(&mut self.frame, Ghost { tint, share, opacity, materials, behind: 0.0 });
        if !bounds.is_empty() {
            self.frame.bounds.merge(&bounds);
        }
    }
}

/// Where a label stands over a box: the middle of its upper side.
pub fn top_of(bounds: &Bounds) -> Vec3 {
    let middle = bounds.center();
    Vec3::new(middle.x, bounds.max.y, middle.z)
}

#[cfg(test)]
mod tests {
    use super::super::tests::swinging;
    use super::*;

    #[test]
    fn the_farthest_joint_of_another_file_is_named() {
        let mut other = swinging();
        let arm = other.scene.graph.find("arm").expect("an arm");
        other.scene.graph.node_mut(arm).name = "arm".into();
        let mut session = Session::new(swinging());
        let own = session.frame().surfaces.len();
        session.compare(Some(With::File(Box::new(other), "other".into())));
        let told = session.compared().expect("compared");
        assert!(told.farthest.is_some_and(|(joint, far)| joint.is_some() && far < 1e-9), "{told:?}");
        assert_eq!(session.frame().surfaces.len(), own * 2);
        // Half a second ahead it is elsewhere; aside does not count as distance.
        session.shift_compared(0.5, 3.0);
        let (joint, far) = session.compared().and_then(|told| told.farthest).expect("joints in common");
        let mut alone = Session::new(swinging());
        let joint = joint.expect("a joint");
        let place = |session: &mut Session, time: f64| {
            session.time(|cursor| cursor.seek(time));
            session.frame().world[joint.index()].w_axis.truncate()
        };
        let expected = place(&mut alone, 0.0).distance(place(&mut alone, 0.5));
        assert!(expected > 0.1 && (far - expected).abs() < 1e-9, "{far} {expected}");
        session.compare(None);
        assert_eq!((session.frame().surfaces.len(), session.compared()), (own, None));
    }

    #[test]
    fn a_comparison_ends_with_its_document() {
        let mut session = Session::new(swinging());
        session.compare(Some(With::Clip(0)));
        session.frame();
        session.show(swinging(), Arrival::Again);
        assert!(session.compared().is_some());
        session.show(swinging(), Arrival::New);
        assert!(session.compared().is_none());
        session.compare(Some(With::Clip(99)));
        assert!(session.compared().is_none());
    }
}
