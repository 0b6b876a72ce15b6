//! What is open and how it is looked at: document, moment, selection, camera, light, switches. No widgets: the window shows a
//! session and hands it what the user does, and the session says what changed.

mod changes;
mod eye;
mod frames;
mod history;
mod light;
mod model;
mod tool;

pub use changes::Changes;
pub use eye::{Eye, FlyCamera, Viewpoint, file_cameras};
pub use frames::DEFAULT_RATE;
pub use light::LightAim;
pub use model::ModelTransform;
pub use tool::Tool;

use std::path::PathBuf;

use glam::Vec3;
use history::{History, Snapshot};

use crate::animation::{Clip, LoopMode, Playback};
use crate::document::{Document, PoseBuffers, PoseState, Skinning};
use crate::muscle::Drive;
use crate::render::{Background, Display, Palette, Theme};
use crate::scene::{Bounds, Camera, Frame, NodeId, Scene, View};

/// How another document comes in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arrival {
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
    frame_rate: f64,
    keys: Vec<f64>,
    own_keys: Vec<f64>,
    display: Display,
    theme: Theme,
    bone_names: bool,
    eye: Eye,
    light: Option<LightAim>,
    model: ModelTransform,
    tool: Tool,
    history: History,
    aspect: f32,
    fit_on_resize: bool,
    frame: Frame,
    buffers: PoseBuffers,
    stale: bool,
    changes: Changes,
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
            frame_rate: DEFAULT_RATE,
            keys: Vec::new(),
            own_keys: Vec::new(),
            display: Display::default(),
            theme: Theme::Dark,
            bone_names: false,
            eye: Eye::default(),
            light: None,
            model: ModelTransform::default(),
            tool: Tool::default(),
            history: History::default(),
            aspect: 1.5,
            fit_on_resize: true,
            frame: Frame::default(),
            buffers: PoseBuffers::default(),
            stale: true,
            changes: Changes::ALL,
        };
        session.show(document, Arrival::New);
        session
    }

    /// Shows another document.
    pub fn show(&mut self, document: Document, arrival: Arrival) {
        let (old_state, old_playback, old_model) = (self.state, self.playback, self.model);
        let old_clip = self.clip().map(|clip| clip.name.clone());
        let name_of = |document: &Document, node: Option<NodeId>| {
            node.filter(|id| id.index() < document.scene.graph.len()).map(|id| document.scene.graph.node(id).name.clone())
        };
        let selected = name_of(&self.document, self.display.selected);
        self.document = document;
        // Buffers made for another scene are of no use.
        (self.frame, self.buffers) = (Frame::default(), PoseBuffers::default());
        (self.display.selected, self.display.hovered, self.display.weights) = (None, None, None);
        self.state = PoseState { skinning: old_state.skinning, ..self.document.start_state() };
        self.history = History::default();
        self.model = ModelTransform::default();
        self.stale = true;
        self.take_clip(self.state.clip);
        match arrival {
            Arrival::New => {
                self.light = None;
                self.model.pivot = self.bounds().center().as_dvec3();
                let eased = std::mem::take(&mut self.eye.eased);
                self.eye.jump(|orbit| orbit.look_from(View::Start));
                self.fit();
                self.eye.eased = eased;
                self.fit_on_resize = true;
            }
            Arrival::Again => {
                let same = self.document.clips.iter().position(|clip| Some(&clip.name) == old_clip.as_ref());
                self.take_clip(same.or(self.state.clip));
                let range = Playback { start: self.playback.start, end: self.playback.end, ..old_playback };
                self.playback = range;
                self.playback.time = old_playback.time.clamp(range.start, range.end);
                self.playback.playing &= range.duration() > 0.0;
                self.state.time = self.playback.time;
                self.state.drive = match self.document.driven_rig() {
                    Some(rig) => rig.at_contraction(old_state.drive.contraction),
                    None => self.state.drive,
                };
                self.model = old_model;
                self.display.selected = selected.and_then(|name| self.document.scene.graph.find(&name));
                if let Viewpoint::File(..) = self.eye.viewpoint() {
                    self.eye.handle(|_| ());
                }
            }
        }
        self.changes = Changes::ALL;
    }

    /// What changed since this was last asked.
    pub fn take_changes(&mut self) -> Changes {
        std::mem::take(&mut self.changes)
    }

    fn changed(&mut self, what: Changes) {
        self.changes |= what;
        let moves = Changes::DOCUMENT | Changes::TIME | Changes::DRIVE | Changes::MODEL;
        self.stale |= what.any(moves);
    }

    // ---- what is open -------------------------------------------------------------------------------------------------------

    /// The document.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The files that are open, in their order; empty for the built-in scene.
    pub fn files(&self) -> Vec<PathBuf> {
        self.document.sources.iter().filter_map(|source| source.path.clone()).collect()
    }

    /// Whether there is nothing to look at.
    pub fn is_empty(&self) -> bool {
        self.document.sources.is_empty() && self.document.scene.graph.is_empty()
    }

    /// The moment that is shown.
    pub fn state(&self) -> PoseState {
        PoseState { time: self.playback.time, model: self.model.matrix(), ..self.state }
    }

    /// The scene posed at the present moment.
    pub fn frame(&mut self) -> &Frame {
        if std::mem::take(&mut self.stale) {
            self.document.pose(&self.state(), &mut self.buffers, &mut self.frame);
        }
        &self.frame
    }

    /// The frame as it was last posed; [`Session::frame`] makes it true.
    pub fn posed(&self) -> &Frame {
        &self.frame
    }

    /// Everything that a picture is made of.
    pub fn picture(&mut self) -> (&Scene, &Frame, Camera, Display) {
        self.frame();
        let camera = self.eye.camera(&self.document.scene, &self.frame);
        let light = self.light.map(|aim| aim.position(&self.frame.bounds));
        (&self.document.scene, &self.frame, camera, Display { light, ..self.display.clone() })
    }

    /// The box round what is shown.
    pub fn bounds(&mut self) -> Bounds {
        self.frame().bounds
    }

    // ---- time ---------------------------------------------------------------------------------------------------------------

    /// The clip that plays.
    pub fn clip(&self) -> Option<&Clip> {
        self.state.clip.and_then(|index| self.document.clips.get(index))
    }

    /// Its index.
    pub fn clip_index(&self) -> Option<usize> {
        self.state.clip
    }

    /// The time cursor.
    pub fn playback(&self) -> &Playback {
        &self.playback
    }

    /// Frames a second of the frame numbers.
    pub fn frame_rate(&self) -> f64 {
        self.frame_rate
    }

    /// Key times of everything that the clip moves; seconds, ascending.
    pub fn all_keys(&self) -> &[f64] {
        &self.keys
    }

    /// Key times of the selected node; empty where it has none.
    pub fn own_keys(&self) -> &[f64] {
        &self.own_keys
    }

    /// Chooses the clip; the cursor goes to its start.
    pub fn set_clip(&mut self, index: Option<usize>) {
        if index != self.state.clip && index.is_none_or(|index| index < self.document.clips.len()) {
            let playing = self.playback.playing;
            self.take_clip(index);
            if playing {
                self.playback.play();
            }
            self.changed(Changes::TIME | Changes::PLAYBACK);
        }
    }

    /// The clip `by` places further on, round the end.
    pub fn next_clip(&mut self, by: isize) {
        let count = self.document.clips.len() as isize;
        if count > 0 {
            let now = self.state.clip.map_or(0, |index| index as isize);
            self.set_clip(Some((now + by).rem_euclid(count) as usize));
        }
    }

    fn take_clip(&mut self, index: Option<usize>) {
        self.state.clip = index;
        let (start, end) = self.clip().map_or((0.0, 0.0), |clip| (clip.start, clip.end));
        let Playback { speed, mode, .. } = self.playback;
        self.playback = Playback { speed: speed.abs(), mode, ..Playback::new(start, end) };
        self.find_keys();
        self.frame_rate = frames::guess_rate(&self.keys);
        self.stale = true;
    }

    fn find_keys(&mut self) {
        self.keys = self.clip().map_or_else(Vec::new, |clip| clip.key_times(None));
        self.find_own_keys();
    }

    fn find_own_keys(&mut self) {
        let own = self.clip().zip(self.display.selected).map(|(clip, node)| clip.key_times(Some(node)));
        self.own_keys = own.unwrap_or_default();
    }

    /// Changes the cursor and notices what came of it.
    pub fn time(&mut self, change: impl FnOnce(&mut Playback)) {
        let before = self.playback;
        change(&mut self.playback);
        let after = self.playback;
        if after.time != before.time {
            self.changed(Changes::TIME);
        }
        if (Playback { time: before.time, ..after }) != before {
            self.changed(Changes::PLAYBACK);
        }
    }

    /// Plays, or stops.
    pub fn toggle_playing(&mut self) {
        self.time(|time| if time.playing { time.pause() } else { time.play() });
    }

    /// Goes whole frames on or back, and stops.
    pub fn step_frames(&mut self, frames: i32) {
        let rate = self.frame_rate;
        self.time(|time| {
            time.pause();
            time.step(frames, rate);
        });
    }

    /// Goes to the next key (or the previous one) of the selection, or of everything where it has none, and stops.
    pub fn step_key(&mut self, forward: bool) {
        let keys = if self.own_keys.is_empty() { &self.keys } else { &self.own_keys };
        let key = if forward { self.playback.next_key(keys) } else { self.playback.previous_key(keys) };
        if let Some(key) = key {
            self.time(|time| {
                time.pause();
                time.seek(key);
            });
        }
    }

    /// Loop, once, ping-pong, loop …
    pub fn next_loop_mode(&mut self) {
        self.time(|time| {
            time.mode = match time.mode {
                LoopMode::Loop => LoopMode::Once,
                LoopMode::Once => LoopMode::PingPong,
                LoopMode::PingPong => LoopMode::Loop,
            };
        });
    }

    /// Lets `seconds` of the display's clock go by.
    pub fn advance(&mut self, seconds: f64) {
        self.time(|time| {
            time.advance(seconds);
        });
        if self.eye.advance(seconds) {
            self.changed(Changes::CAMERA);
        }
    }

    /// Whether something moves by itself, so that another frame is wanted.
    pub fn is_moving(&self) -> bool {
        self.playback.playing || self.eye.is_jumping()
    }

    // ---- muscle -------------------------------------------------------------------------------------------------------------

    /// Elbow angle and contraction.
    pub fn drive(&self) -> Drive {
        self.state.drive
    }

    /// Sets the elbow angle, degrees; the contraction follows.
    pub fn set_flexion(&mut self, degrees: f64) {
        let drive = self.document.driven_rig().filter(|_| degrees.is_finite()).map(|rig| rig.at_flexion(degrees));
        self.set_drive(drive);
    }

    /// Sets the contraction, per cent; the elbow angle follows.
    pub fn set_contraction(&mut self, per_cent: f64) {
        let drive = self.document.driven_rig().filter(|_| per_cent.is_finite()).map(|rig| rig.at_contraction(per_cent.clamp(0.0, 100.0)));
        self.set_drive(drive);
    }

    fn set_drive(&mut self, drive: Option<Drive>) {
        if let Some(drive) = drive.filter(|drive| *drive != self.state.drive) {
            self.state.drive = drive;
            self.changed(Changes::DRIVE);
        }
    }

    // ---- selection ----------------------------------------------------------------------------------------------------------

    /// The selected node.
    pub fn selected(&self) -> Option<NodeId> {
        self.display.selected
    }

    /// Selects a node, or none.
    pub fn select(&mut self, node: Option<NodeId>) {
        let node = node.filter(|id| id.index() < self.document.scene.graph.len());
        if node != self.display.selected {
            self.display.selected = node;
            if self.display.weights.is_some() {
                self.display.weights = node;
            }
            self.find_own_keys();
            self.changed(Changes::SELECTION);
        }
    }

    /// The ledger shows another muscle.
    pub fn show_other_muscle(&mut self) {
        self.changed(Changes::MUSCLE);
    }

    /// The scene tree lists something else: another search.
    pub fn list_anew(&mut self) {
        self.changed(Changes::LIST);
    }

    /// Marks the node under the pointer.
    pub fn hover(&mut self, node: Option<NodeId>) {
        if node != self.display.hovered {
            self.display.hovered = node;
            self.changed(Changes::HOVER);
        }
    }

    /// Shows or hides a node with everything below it.
    pub fn set_visible(&mut self, node: NodeId, visible: bool) {
        if node.index() < self.document.scene.graph.len() && self.document.scene.graph.node(node).visible != visible {
            self.remember();
            self.document.scene.graph.node_mut(node).visible = visible;
            self.stale = true;
            self.changed(Changes::DISPLAY);
        }
    }

    // ---- looks --------------------------------------------------------------------------------------------------------------

    /// The switches.
    pub fn display(&self) -> &Display {
        &self.display
    }

    /// Changes switches.
    pub fn change_display(&mut self, change: impl FnOnce(&mut Display)) {
        let before = self.display.clone();
        change(&mut self.display);
        if before != self.display {
            self.changed(Changes::DISPLAY);
        }
    }

    /// The colours of the surroundings.
    pub fn theme(&self) -> Theme {
        self.theme
    }

    /// Follows the desktop's light or dark.
    pub fn set_theme(&mut self, theme: Theme) {
        self.theme = theme;
        let palette = Palette::of(theme);
        self.change_display(|display| {
            display.palette = palette;
            display.background = Background::Gradient(palette.background.0, palette.background.1);
        });
    }

    /// Whether the names of bones are written beside them.
    pub fn bone_names(&self) -> bool {
        self.bone_names
    }

    /// Writes the names of bones, or no longer.
    pub fn set_bone_names(&mut self, shown: bool) {
        self.bone_names = shown;
        self.changed(Changes::DISPLAY);
    }

    /// How joints bend skins.
    pub fn set_skinning(&mut self, skinning: Skinning) {
        if skinning != self.state.skinning {
            self.state.skinning = skinning;
            self.stale = true;
            self.changed(Changes::DISPLAY);
        }
    }

    /// Paints the weights of the selected node, or no longer.
    pub fn set_weights(&mut self, shown: bool) {
        let selected = self.display.selected;
        self.change_display(|display| display.weights = selected.filter(|_| shown));
    }

    // ---- camera and light ---------------------------------------------------------------------------------------------------

    /// The eye.
    pub fn eye(&self) -> &Eye {
        &self.eye
    }

    /// Whether jumps of the camera are eased.
    pub fn set_eased(&mut self, eased: bool) {
        self.eye.eased = eased;
    }

    /// Nothing changed but what surrounds the document, such as a reading that ended without one.
    pub fn touch(&mut self) {
        self.changed(Changes::SURROUNDINGS);
    }

    /// Changes the eye.
    pub fn change_eye(&mut self, change: impl FnOnce(&mut Eye)) {
        change(&mut self.eye);
        self.fit_on_resize = false;
        self.changed(Changes::CAMERA);
    }

    /// The picture's width over its height. A view that no hand has touched is fitted anew.
    pub fn set_aspect(&mut self, aspect: f32) {
        if aspect.is_finite() && aspect > 0.0 && aspect != self.aspect {
            self.aspect = aspect;
            if self.fit_on_resize {
                let eased = std::mem::take(&mut self.eye.eased);
                self.fit();
                self.eye.eased = eased;
                self.fit_on_resize = true;
            }
        }
    }

    /// Fits everything into the picture.
    pub fn fit(&mut self) {
        let (bounds, aspect) = (self.bounds(), self.aspect);
        self.change_eye(|eye| eye.fit(&bounds, aspect));
    }

    /// Back to the start view, fitted.
    pub fn reset_camera(&mut self) {
        let (bounds, aspect) = (self.bounds(), self.aspect);
        self.change_eye(|eye| {
            eye.jump(|orbit| {
                orbit.orthographic = false;
                orbit.look_from(View::Start);
                orbit.fit(&bounds, aspect);
            });
        });
    }

    /// Puts a node into the middle of the picture.
    pub fn centre_on(&mut self, node: NodeId) {
        let target = self.node_centre(node);
        if target.is_finite() {
            self.change_eye(|eye| eye.jump(|orbit| orbit.target = target));
        }
    }

    /// The middle of what hangs on a node, else its origin; world, metres.
    fn node_centre(&mut self, node: NodeId) -> Vec3 {
        let frame = self.frame();
        let mut bounds = Bounds::EMPTY;
        for surface in frame.surfaces.iter().filter(|surface| surface.node == node) {
            for vertex in 0..surface.mesh.positions.len() as u32 {
                bounds.add(surface.position(vertex));
            }
        }
        if bounds.is_empty() { frame.position(node) } else { bounds.center() }
    }

    /// Where the light comes from; `None` = with the camera, high on the left.
    pub fn light(&self) -> Option<LightAim> {
        self.light
    }

    /// Moves the light by degrees.
    pub fn turn_light(&mut self, yaw: f32, pitch: f32) {
        let mut aim = self.light.unwrap_or_else(|| LightAim::beside_camera(self.eye.orbit().yaw));
        aim.turn(yaw, pitch);
        self.light = Some(aim);
        self.changed(Changes::LIGHT);
    }

    /// The light goes back to its place beside the camera.
    pub fn reset_light(&mut self) {
        if self.light.is_some() {
            self.remember();
            self.light = None;
            self.changed(Changes::LIGHT);
        }
    }

    // ---- model and history --------------------------------------------------------------------------------------------------

    /// The model's transform.
    pub fn model(&self) -> &ModelTransform {
        &self.model
    }

    /// Changes the model's transform. Call [`Session::remember`] before the first change of a gesture.
    pub fn change_model(&mut self, change: impl FnOnce(&mut ModelTransform)) {
        let before = self.model;
        change(&mut self.model);
        if before != self.model {
            self.changed(Changes::MODEL);
        }
    }

    /// The tool in hand.
    pub fn tool(&self) -> Tool {
        self.tool
    }

    /// Takes a tool.
    pub fn set_tool(&mut self, tool: Tool) {
        if tool != self.tool {
            self.tool = tool;
            self.changed(Changes::TOOL);
        }
    }

    /// Drags the model with the tool in hand by a part of the picture's height (right, down).
    pub fn drag_model(&mut self, dx: f64, dy: f64) {
        self.frame();
        let camera = self.eye.camera(&self.document.scene, &self.frame);
        let tool = self.tool;
        self.change_model(|model| tool.drag(model, &camera, dx, dy));
    }

    /// Makes the present state a step that can be gone back to.
    pub fn remember(&mut self) {
        self.history.remember(self.snapshot());
        self.changed(Changes::HISTORY);
    }

    /// Whether there is a step back, and one forward.
    pub fn steps(&self) -> (bool, bool) {
        (self.history.can_undo(), self.history.can_redo())
    }

    /// Goes back one step.
    pub fn undo(&mut self) {
        let step = self.history.undo(self.snapshot());
        self.restore(step);
    }

    /// Goes forward one step.
    pub fn redo(&mut self) {
        let step = self.history.redo(self.snapshot());
        self.restore(step);
    }

    fn snapshot(&self) -> Snapshot {
        let hidden = self.document.scene.graph.iter().filter(|(_, node)| !node.visible).map(|(id, _)| id).collect();
        Snapshot { model: self.model, light: self.light, hidden }
    }

    fn restore(&mut self, step: Option<Snapshot>) {
        if let Some(step) = step {
            if step.hidden != self.snapshot().hidden {
                self.changed(Changes::LIST);
            }
            (self.model, self.light) = (step.model, step.light);
            for index in 0..self.document.scene.graph.len() as u32 {
                let id = NodeId(index);
                self.document.scene.graph.node_mut(id).visible = step.hidden.binary_search(&id).is_err();
            }
            self.changed(Changes::MODEL | Changes::LIGHT | Changes::DISPLAY);
        }
        self.changed(Changes::HISTORY);
    }
}

#[cfg(test)]
mod tests;
