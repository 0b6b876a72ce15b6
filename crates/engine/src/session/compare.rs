//! Comparison of two files, two clips or two kinds of skinning: choice and offset.

use std::path::PathBuf;

use glam::Vec3;

use super::{ChangeSet, Session};
use crate::document::Document;
use crate::view::{CompareTarget, PoseComparison, SavedComparison};
use sinew_scene::{Bounds, NodeId};

/// What a comparison shows and found out.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparisonState {
    /// Seconds that the second one is ahead.
    pub time_offset: f64,
    /// Metres that it stands aside.
    pub offset: f64,
    /// The joint that is farthest from its counterpart, and how far, metres; of two ways to bend a skin the farthest vertex, which has no joint.
    /// `None` where the two have no joint in common.
    pub farthest: Option<(Option<NodeId>, f64)>,
    /// The boxes round the first and the second one, world.
    pub boxes: [Bounds; 2],
}

impl Session {
    /// Compares with something; `None` ends it. A clip that is not there is none.
    pub fn compare(&mut self, target: Option<CompareTarget>) {
        // A view that shows both, and that no hand has touched since, goes back to the first one.
        let alone = self.fit_on_resize && self.compare_offset().is_some_and(|(_, offset)| offset != 0.0);
        if self.set_comparison(target) || alone {
            self.fit();
        }
        self.changed(ChangeSet::OVERLAYS);
    }

    /// The file that is compared with, if one is.
    pub fn compared_file(&self) -> Option<PathBuf> {
        match self.compare_target()? {
            CompareTarget::File(_, name) => Some(name.into()),
            CompareTarget::Clip(_) | CompareTarget::Skinning => None,
        }
    }

    /// The file that is compared with was read again; where it stands and how far ahead it is stay.
    pub fn replace_compared_file(&mut self, document: Document) {
        self.remove_overlays();
        if let Some(comparison) = self.overlays.comparison_mut() {
            comparison.replace_file(document, &self.document);
        }
        self.changed(ChangeSet::OVERLAYS);
    }

    /// Compares, and leaves the eye where it is; whether the second one stands beside the first.
    pub(super) fn set_comparison(&mut self, target: Option<CompareTarget>) -> bool {
        self.remove_overlays();
        self.overlays.compare(None);
        self.needs_posing = true;
        let yaw = self.view.camera.orbit().yaw;
        let Some(mut comparison) = target.and_then(|target| PoseComparison::new(target, &self.document, yaw)) else { return false };
        let beside = comparison.place_beside(&self.frame().bounds);
        self.remove_overlays();
        self.overlays.compare(Some(comparison));
        self.needs_posing = true;
        beside
    }

    /// Whether there are skins to bend.
    pub fn has_skins(&self) -> bool {
        !self.document.scene.skins.is_empty()
    }

    /// What is compared with, if anything is.
    pub fn compare_target(&self) -> Option<&CompareTarget> {
        self.overlays.comparison().map(PoseComparison::target)
    }

    /// Seconds that the second one is ahead and metres that it stands aside, while something is compared.
    pub fn compare_offset(&self) -> Option<(f64, f64)> {
        self.overlays.comparison().map(PoseComparison::offsets)
    }

    /// Seconds that the second one is ahead; 0 without a comparison.
    pub fn compare_time_offset(&self) -> f64 {
        self.compare_offset().map_or(0.0, |(time_offset, _)| time_offset)
    }

    /// Moves the second one in time (seconds ahead) and in space (metres aside).
    pub fn set_compare_offsets(&mut self, time_offset: f64, offset: f64) {
        if self.overlays.comparison_mut().is_some_and(|comparison| comparison.set_offsets(time_offset, offset)) {
            self.changed(ChangeSet::OVERLAYS);
        }
    }

    /// Moves the second one as a session file says.
    pub fn apply_saved_comparison(&mut self, saved: &SavedComparison) {
        if let Some(comparison) = self.overlays.comparison_mut() {
            comparison.apply_saved(saved);
            self.changed(ChangeSet::OVERLAYS);
        }
    }

    /// What the comparison shows and found out at the present moment.
    pub fn compared(&mut self) -> Option<ComparisonState> {
        self.frame();
        let comparison = self.overlays.comparison()?;
        let ((time_offset, offset), farthest) = (comparison.offsets(), comparison.max_deviation());
        let first = self.frame.surfaces.iter().filter(|surface| surface.ghost.is_none() && surface.visible);
        let mut own = Bounds::EMPTY;
        first.for_each(|surface| surface.mesh.triangles.iter().flatten().step_by(7).for_each(|vertex| own.add(surface.position(*vertex))));
        if own.is_empty() {
            own = Bounds::of(self.frame.joints.iter().map(|joint| self.frame.position(joint.node)));
        }
        Some(ComparisonState { time_offset, offset, farthest, boxes: [own, comparison.bounds()] })
    }

    /// The box round everything that the second one covers.
    pub(super) fn compared_motion_bounds(&self) -> Option<Bounds> {
        self.overlays.motion_bounds(&self.document, &self.state())
    }
}

/// Where a label stands over a box: the middle of its upper side.
pub fn top_of(bounds: &Bounds) -> Vec3 {
    let middle = bounds.center();
    Vec3::new(middle.x, bounds.max.y, middle.z)
}

#[cfg(test)]
mod tests {
    use super::super::LoadMode;
    use super::super::tests::swinging;
    use super::*;

    #[test]
    fn what_stands_far_aside_is_before_the_eye() {
        let mut session = Session::new(swinging());
        session.change_camera(|eye| {
            eye.look_from(sinew_scene::ViewDirection::Front);
            eye.change(|orbit| orbit.orthographic = true);
        });
        session.compare(Some(CompareTarget::File(Box::new(swinging()), "other.dae".into())));
        session.change_camera(|eye| eye.change(|orbit| orbit.yaw = 90.0));
        for offset in [0.0, 1.0, 1e3, -1e3] {
            session.set_compare_offsets(0.0, offset);
            let (_, _, camera, _) = session.picture();
            let boxes = session.compared().expect("compared").boxes;
            for corner in boxes.iter().flat_map(Bounds::corners) {
                let ahead = (corner - camera.eye).dot(camera.forward());
                assert!(ahead >= camera.near, "{offset}: {ahead}");
            }
        }
    }

    #[test]
    fn the_farthest_joint_of_another_file_is_named() {
        let mut other = swinging();
        let arm = other.scene.graph.find("arm").expect("an arm");
        other.scene.graph.node_mut(arm).name = "arm".into();
        let mut session = Session::new(swinging());
        let own = session.frame().surfaces.len();
        session.compare(Some(CompareTarget::File(Box::new(other), "other".into())));
        let told = session.compared().expect("compared");
        assert!(told.farthest.is_some_and(|(joint, far)| joint.is_some() && far < 1e-9), "{told:?}");
        assert_eq!(session.frame().surfaces.len(), own * 2);
        // Half a second ahead it is elsewhere; aside does not count as distance.
        session.set_compare_offsets(0.5, 3.0);
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
    fn a_file_compared_with_itself_looks_as_without_it() {
        use sinew_render::{RenderJob, Renderer};
        let mut session = super::super::tests::clip();
        let mut renderer = Renderer::new(Some(1));
        let mut pixels = |session: &mut Session| {
            let (scene, frame, camera, display) = session.picture();
            let job = RenderJob { scene, frame, camera: &camera, display: &display, width: 320, height: 240 };
            renderer.draw(&job).expect("there is memory for it").pixels.clone()
        };
        let alone = pixels(&mut session);
        session.compare(Some(CompareTarget::File(Box::new(session.document().clone()), "same.dae".into())));
        assert!(pixels(&mut session) == alone, "no stripes where both are the same");
        session.set_compare_offsets(0.5, 0.0);
        assert!(pixels(&mut session) != alone);
    }

    #[test]
    fn a_comparison_ends_with_its_document() {
        let mut session = Session::new(swinging());
        session.compare(Some(CompareTarget::Clip(0)));
        session.frame();
        session.show(swinging(), LoadMode::Again);
        assert!(session.compared().is_some());
        session.show(swinging(), LoadMode::New);
        assert!(session.compared().is_none());
        session.compare(Some(CompareTarget::Clip(99)));
        assert!(session.compared().is_none());
    }
}
