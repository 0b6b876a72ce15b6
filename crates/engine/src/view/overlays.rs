//! What is drawn with the scene: onion skins, motion path, comparison, lines of action.

use super::comparison::{CompareTarget, PoseComparison};
use super::frames::infer_frame_rate;
use super::lines_of_action;
use super::motion_path::MotionPath;
use super::onion_skin::OnionSkins;
use super::pose_context::PoseContext;
use super::{OnionSkinSettings, SessionState};
use crate::document::{Document, PoseState};
use sinew_scene::{Bounds, Frame};

/// Overlays of a scene. Their surfaces are part of the scene's frame from [`SceneOverlays::append_to`] to [`SceneOverlays::remove_from`].
#[derive(Debug, Default)]
pub struct SceneOverlays {
    onion_skin_settings: OnionSkinSettings,
    onion_skins: OnionSkins,
    motion_path: Option<MotionPath>,
    comparison: Option<Box<PoseComparison>>,
}

impl SceneOverlays {
    /// The overlays that a session file describes, and the frame rate; `other` is the file that it compares with.
    pub fn from_session(saved: &SessionState, document: &Document, other: Option<(String, Document)>) -> (Self, f64) {
        let clip = saved.pose_state(document).clip.and_then(|clip| document.clips.get(clip));
        let rate = saved.display.frame_rate.unwrap_or_else(|| infer_frame_rate(&clip.map_or_else(Vec::new, |clip| clip.key_times(None))));
        let target = match other {
            Some((name, other)) => Some(CompareTarget::File(Box::new(other), name)),
            None => saved.compared.as_ref().and_then(|compared| compared.target_within(document)),
        };
        let yaw = saved.camera.map_or(sinew_scene::ViewDirection::Start.angles().0, |camera| camera.yaw);
        let mut comparison = target.and_then(|target| PoseComparison::new(target, document, yaw));
        if let (Some(comparison), Some(compared)) = (&mut comparison, &saved.compared) {
            comparison.apply_saved(compared);
        }
        (Self { onion_skin_settings: saved.onion_skins.clamped(), comparison: comparison.map(Box::new), ..Self::default() }, rate)
    }

    /// The same overlays for another frame, such as that of an export.
    pub fn clone_for_frame(&self) -> Self {
        let comparison = self.comparison.as_ref().map(|comparison| Box::new(comparison.clone_for_frame()));
        Self { onion_skin_settings: self.onion_skin_settings, comparison, ..Self::default() }
    }

    /// Whether anything is drawn.
    pub fn is_active(&self) -> bool {
        self.onion_skin_settings.shown || self.onion_skin_settings.path || self.comparison.is_some()
    }

    /// Settings of the onion skins.
    pub fn onion_skin_settings(&self) -> OnionSkinSettings {
        self.onion_skin_settings
    }

    /// Sets the settings of the onion skins; returns whether they changed.
    pub fn set_onion_skin_settings(&mut self, settings: OnionSkinSettings) -> bool {
        let settings = settings.clamped();
        std::mem::replace(&mut self.onion_skin_settings, settings) != settings
    }

    /// The comparison.
    pub fn comparison(&self) -> Option<&PoseComparison> {
        self.comparison.as_deref()
    }

    /// The comparison, to change it.
    pub fn comparison_mut(&mut self) -> Option<&mut PoseComparison> {
        self.comparison.as_deref_mut()
    }

    /// Replaces the comparison. Surfaces must have been removed from the frame.
    pub fn compare(&mut self, comparison: Option<PoseComparison>) {
        self.comparison = comparison.map(Box::new);
    }

    /// Drops what was made for the previous document, and the comparison unless `keep_comparison`.
    pub fn rebind(&mut self, document: &Document, keep_comparison: bool) {
        self.onion_skins = OnionSkins::default();
        self.motion_path = None;
        self.comparison =
            self.comparison.take().filter(|_| keep_comparison).and_then(|comparison| comparison.rebound(document).map(Box::new));
    }

    /// Drops the cached motion path, because the selection or its movement changed.
    pub fn clear_motion_path(&mut self) {
        self.motion_path = None;
    }

    /// Bounding box of the whole movement of the compared document.
    pub fn motion_bounds(&self, context: &Document, state: &PoseState) -> Option<Bounds> {
        self.comparison.as_ref().map(|comparison| comparison.motion_bounds(context, state))
    }

    /// Removes the overlays from a frame, before it is posed.
    pub fn remove_from(&mut self, frame: &mut Frame) {
        if let Some(comparison) = &mut self.comparison {
            comparison.remove_from(frame);
        }
        self.onion_skins.remove_from(frame);
        frame.overlay_lines.clear();
    }

    /// Poses the overlays and appends them to the frame, which has just been posed as `context` says.
    pub fn append_to(&mut self, context: &PoseContext<'_>, frame: &mut Frame) {
        if let Some(comparison) = &mut self.comparison {
            comparison.pose(context, frame);
        }
        self.onion_skins.append_to(context, self.onion_skin_settings, frame);
        if let Some(node) = context.selected.filter(|_| self.onion_skin_settings.path) {
            MotionPath::draw(&mut self.motion_path, context, node, frame);
        }
        if let Some(comparison) = &mut self.comparison {
            comparison.append_to(context, frame);
        }
        if context.lines_of_action {
            lines_of_action::append_to(context, frame);
        }
    }
}
