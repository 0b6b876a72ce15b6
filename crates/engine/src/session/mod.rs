//! What is open and how it is looked at: document, moment, selection, camera, light, switches. No widgets: the window shows a
//! session and passes user actions to it, and the session returns what changed.

mod attach_to_skeleton;
mod change_set;
mod compare;
mod display_state;
mod dope_sheet;
mod follow;
mod gizmo;
mod history;
mod isolate;
mod joint_control;
mod manipulators;
mod measure;
mod muscle_commands;
mod muscle_edit;
mod muscle_sets;
mod overlays;
mod pick_mode;
mod presets;
mod probe;
mod session_state;
mod timeline_state;
mod tool;
mod undoable;
mod via_points;
mod view_settings;

pub use crate::view::{
    BackgroundPreset, COMPARED_TINT, CameraController, CompareTarget, DEFAULT_FRAME_RATE, FlyCamera, LightDirection, ModelTransform,
    OnionSkinSettings, ViewState, Viewpoint, file_cameras,
};
pub use attach_to_skeleton::AttachResult;
pub use change_set::ChangeSet;
pub use compare::{ComparisonState, top_of};
pub use dope_sheet::{AnimatedItem, CurveGraph, GraphKind, SheetRow, ValueGraph};
pub use gizmo::{Gizmo, GizmoHandle, ModelDrag};
pub use history::UndoStep;
pub use joint_control::{JointAxis, SliderState};
pub use manipulators::{AttachmentDrag, AttachmentHandle, WrapOutline};
pub use measure::{MeasureAxis, csv};
pub use muscle_sets::AttachSetError;
pub use pick_mode::{PickMode, PickTarget};
pub use presets::DisplayPreset;
pub use probe::Matrices;
pub use timeline_state::RangeMark;
pub use tool::Tool;
pub use view_settings::SavedViewSettings;

use std::cell::OnceCell;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use history::History;
use joint_control::JointController;
use probe::Probe;

use crate::document::{Document, PoseBuffers, PoseState, SourceKind};
use crate::output::OverwriteGuard;
use crate::view::{self, SceneOverlays};
use sinew_muscle::MuscleFile;
use sinew_render::Display;
use sinew_scene::animation::Playback;
use sinew_scene::{Bounds, Camera, Frame, MuscleId, NodeId, Scene, ViewDirection};

/// How another document comes in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadMode {
    /// From the start: camera fitted, clip at its start, nothing selected.
    New,
    /// The same files again: moment, camera, selection and model stay, as far as they still exist.
    Again,
}

/// Everything that the window shows.
#[derive(Debug)]
pub struct Session {
    document: Document,
    state: PoseState,
    playback: Playback,
    /// Whether the user drags the time cursor.
    time_held: bool,
    frame_rate: f64,
    sheet_rows: OnceCell<Arc<Vec<SheetRow>>>,
    keys: Vec<f64>,
    own_keys: Vec<f64>,
    /// How it is looked at. The ground is laid out for what was in the picture when it was last fitted, so that it lies still while a clip plays.
    view: ViewState,
    /// The time at which the followed node was looked for.
    followed_at: f64,
    model: ModelTransform,
    tool: Tool,
    history: History,
    /// What the muscle files said when they were read or saved last.
    saved_files: Vec<MuscleFile>,
    /// The muscle that panels and handles show.
    shown_muscle: MuscleId,
    joint: JointController,
    picking: Option<PickMode>,
    aspect: f32,
    fit_on_resize: bool,
    probe: Probe,
    overlays: SceneOverlays,
    /// What was hidden before the selection was shown alone.
    isolated: Option<Vec<NodeId>>,
    frame: Frame,
    buffers: PoseBuffers,
    needs_posing: bool,
    posing_ms: f64,
    changes: ChangeSet,
}

impl Default for Session {
    fn default() -> Self {
        Self::new(Document::default())
    }
}

impl Session {
    /// A session that shows `document`.
    pub fn new(document: Document) -> Self {
        let mut session = Self {
            document: Document::default(),
            state: PoseState::default(),
            playback: Playback::default(),
            time_held: false,
            frame_rate: DEFAULT_FRAME_RATE,
            sheet_rows: OnceCell::new(),
            keys: Vec::new(),
            own_keys: Vec::new(),
            view: ViewState::default(),
            followed_at: 0.0,
            model: ModelTransform::default(),
            tool: Tool::default(),
            history: History::default(),
            saved_files: Vec::new(),
            shown_muscle: MuscleId(0),
            joint: JointController::default(),
            picking: None,
            aspect: 1.5,
            fit_on_resize: true,
            probe: Probe::default(),
            overlays: SceneOverlays::default(),
            isolated: None,
            frame: Frame::default(),
            buffers: PoseBuffers::default(),
            needs_posing: true,
            posing_ms: 0.0,
            changes: ChangeSet::ALL,
        };
        session.show(document, LoadMode::New);
        session
    }

    /// Shows another document.
    pub fn show(&mut self, document: Document, arrival: LoadMode) {
        let (old_state, old_playback, old_model) = (self.state.clone(), self.playback, self.model);
        let old_clip = self.clip_index().and_then(|index| self.document.clip_key(index));
        let name_of = |document: &Document, node: Option<NodeId>| {
            node.filter(|id| id.index() < document.scene.graph.len()).map(|id| document.scene.graph.label(id).plain().into_owned())
        };
        let selected = name_of(&self.document, self.view.display.highlight.selected);
        let lens = match self.view.camera.viewpoint() {
            Viewpoint::File(node, _) => name_of(&self.document, Some(node)),
            Viewpoint::Orbit | Viewpoint::Fly(_) => None,
        };
        let turned: Vec<_> = self
            .state
            .joints
            .overrides()
            .iter()
            .map(|turn| (self.document.scene.graph.label(turn.node).plain().into_owned(), turn.degrees))
            .collect();
        let joint = self.joint_for_reload();
        let followed = name_of(&self.document, self.followed());
        self.view.follow = None;
        self.stop_picking();
        self.time_held = false;
        self.document = document;
        self.clear_joint();
        self.probe = Probe::default();
        // Buffers made for another scene are of no use.
        (self.frame, self.buffers) = (Frame::default(), PoseBuffers::default());
        self.isolated = None;
        self.overlays.rebind(&self.document, arrival == LoadMode::Again);
        (self.view.display.highlight.selected, self.view.display.highlight.hovered, self.view.display.highlight.weights) =
            (None, None, None);
        self.state = PoseState { skinning: old_state.skinning, skin: old_state.skin, ..self.document.start_state() };
        self.history = History::default();
        self.saved_files = self.document.muscle_files().cloned().collect();
        self.model = ModelTransform::default();
        self.needs_posing = true;
        self.take_clip(self.state.clip);
        match arrival {
            LoadMode::New => {
                self.view.light = None;
                self.shown_muscle = MuscleId(0);
                // A file of bones alone is shown as far as it goes.
                self.view.display.bones |= !self.is_empty() && !self.document.shows_surface();
                self.model.pivot = self.bounds().center().as_dvec3();
                let eased = std::mem::take(&mut self.view.camera.animated);
                self.view.camera.animate_to(|orbit| orbit.look_from(ViewDirection::Start));
                self.fit();
                self.view.camera.animated = eased;
            }
            LoadMode::Again => {
                let same = old_clip.and_then(|key| self.document.clip_named(&key));
                self.take_clip(same.or(self.state.clip));
                let range = Playback { start: self.playback.start, end: self.playback.end, ..old_playback };
                self.playback = range;
                self.playback.time = old_playback.time.clamp(range.start, range.end);
                self.playback.playing &= range.duration() > 0.0;
                self.state.time = self.playback.time;
                self.state.joints.drive = match self.document.driven_rig() {
                    Some(rig) => rig.at_contraction(old_state.joints.drive.contraction),
                    None => self.state.joints.drive,
                };
                self.model = old_model;
                self.shown_muscle.0 = self.shown_muscle.0.min((self.document.muscle_count() as u32).saturating_sub(1));
                self.restore_joint(joint);
                for (name, degrees) in turned {
                    if let Some(node) = self.document.scene.graph.find(&name) {
                        self.state.joints.set_override(node, degrees);
                    }
                }
                self.view.display.highlight.selected = selected.and_then(|name| self.document.scene.graph.find(&name));
                self.follow_node(followed.and_then(|name| self.document.scene.graph.find(&name)));
                if let Some(lens) = lens {
                    let same = |(node, _): &(NodeId, _)| self.document.scene.graph.label(*node).is(&lens);
                    match file_cameras(&self.document.scene).into_iter().find(same) {
                        Some((node, camera)) => self.view.camera.look_through(node, camera),
                        None => self.view.camera.change(|_| ()),
                    }
                }
            }
        }
        self.changes = ChangeSet::ALL;
    }

    /// How the document is looked at, for pictures that are made elsewhere: the camera follows from the present moment on, the light stands still.
    pub fn view_state(&mut self) -> ViewState {
        self.picture();
        self.view.clone()
    }

    /// What changed since this was last asked.
    pub fn take_changes(&mut self) -> ChangeSet {
        std::mem::take(&mut self.changes)
    }

    fn changed(&mut self, what: ChangeSet) {
        self.changes |= what;
        let moves = ChangeSet::DOCUMENT
            | ChangeSet::TIME
            | ChangeSet::DRIVE
            | ChangeSet::MODEL
            | ChangeSet::EDIT
            | ChangeSet::JOINT_OVERRIDES
            | ChangeSet::OVERLAYS;
        let accompanied = self.overlays.is_active() || self.view.display.lines_of_action || !self.frame.overlay_lines.is_empty();
        self.needs_posing |= what.any(moves) || (accompanied && what.any(ChangeSet::SELECTION | ChangeSet::DISPLAY | ChangeSet::PLAYBACK));
        if what.any(ChangeSet::SELECTION | ChangeSet::JOINT_OVERRIDES | ChangeSet::EDIT | ChangeSet::PLAYBACK) {
            self.overlays.clear_motion_path();
        }
    }

    /// The document.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The files that are open, in their order; empty for the built-in scene.
    pub fn files(&self) -> Vec<PathBuf> {
        self.document.sources.iter().filter_map(|source| source.path.clone()).collect()
    }

    /// Holds every file that is open, with what belongs to it: clips that muscles name, images, the file that is compared with and what belongs to that.
    pub fn guard(&self) -> OverwriteGuard {
        let compared = match self.compare_target() {
            Some(CompareTarget::File(document, name)) => Some((Path::new(name), &**document)),
            _ => None,
        };
        view::guard_of(&self.document, compared)
    }

    /// Those of the open files that are clips.
    pub fn clip_files(&self) -> Vec<PathBuf> {
        let clips = self.document.sources.iter().filter(|source| matches!(source.kind, SourceKind::Scene(_)));
        clips.filter_map(|source| source.path.clone()).collect()
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.document.sources.is_empty() && self.document.scene.graph.is_empty()
    }

    /// Whether something is open of which nothing can be drawn, hidden or not: no bone, no triangle, no line.
    pub fn has_nothing_to_draw(&mut self) -> bool {
        let frame = self.frame();
        let bare = frame.joints.is_empty()
            && frame.surfaces.iter().all(|surface| surface.mesh.triangles.is_empty() && surface.mesh.lines.is_empty());
        bare && !self.is_empty()
    }

    /// The moment that is shown.
    pub fn state(&self) -> PoseState {
        PoseState { time: self.playback.time, model: self.model.matrix(), ..self.state.clone() }
    }

    /// The scene posed at the present moment.
    pub fn frame(&mut self) -> &Frame {
        if std::mem::take(&mut self.needs_posing) {
            let begun = std::time::Instant::now();
            self.remove_overlays();
            self.document.pose(&self.state(), &mut self.buffers, &mut self.frame);
            self.update_follow();
            self.append_overlays();
            self.posing_ms += begun.elapsed().as_secs_f64() * 1e3;
        }
        &self.frame
    }

    /// Milliseconds spent on posing since the last call.
    pub fn take_posing_ms(&mut self) -> f64 {
        std::mem::take(&mut self.posing_ms)
    }

    /// The frame as it was last posed; [`Session::frame`] makes it true.
    pub fn posed(&self) -> &Frame {
        &self.frame
    }

    /// Everything that a picture is made of.
    pub fn picture(&mut self) -> (&Scene, &Frame, Camera, Display) {
        self.frame();
        let mut camera = self.view.camera(&self.document.scene, &self.frame, 0.0);
        if matches!(self.view.camera.viewpoint(), Viewpoint::Orbit) {
            let mut shown = self.frame.bounds;
            if let Some(comparison) = self.overlays.comparison() {
                shown.merge(&comparison.bounds());
            }
            camera = camera.moved_back(&shown);
        }
        self.view.place_light(&self.frame.bounds);
        (&self.document.scene, &self.frame, camera, self.view.display.clone())
    }

    /// The box round everything that the clip, or the arm's swing, covers.
    pub fn motion_bounds(&self) -> Bounds {
        let mut reach = self.document.motion_bounds(&self.state());
        if let Some(other) = self.compared_motion_bounds() {
            reach.merge(&other);
        }
        reach
    }

    /// The box round what is shown.
    pub fn bounds(&mut self) -> Bounds {
        self.frame().bounds
    }
}

#[cfg(test)]
mod tests;
