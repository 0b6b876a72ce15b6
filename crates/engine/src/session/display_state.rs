//! Display state of a session: selection, display options, camera and light.

use glam::Vec3;

use super::{CameraController, ChangeSet, LightDirection, Session, UndoStep, Viewpoint};
use crate::document::{SkinMotion, Skinning};
use crate::view::{BackgroundPreset, file_camera};
use sinew_render::{Display, Theme};
use sinew_scene::message;
use sinew_scene::{Bounds, Content, Deformer, NodeId, NodeKind, ViewDirection};

impl Session {
    /// The selected node.
    pub fn selected(&self) -> Option<NodeId> {
        self.view.display.highlight.selected
    }

    /// Selects a node, or none.
    pub fn select(&mut self, node: Option<NodeId>) {
        let node = node.filter(|id| id.index() < self.document.scene.graph.len());
        if node != self.view.display.highlight.selected {
            self.view.display.highlight.selected = node;
            // A mesh that is selected has no weights to show: those of the bone stay.
            if self.view.display.highlight.weights.is_some() && node.is_none_or(|node| self.is_bone(node)) {
                self.view.display.highlight.weights = node;
            }
            let carried = node.and_then(|node| {
                let contents = &self.document.scene.graph.node(node).contents;
                contents.iter().find_map(|content| if let Content::Muscle(muscle) = content { Some(*muscle) } else { None })
            });
            if let Some(muscle) = carried {
                self.show_muscle(muscle);
            }
            self.find_own_keys();
            self.changed(ChangeSet::SELECTION);
        }
    }

    /// A panel shows something else of the muscles.
    pub fn show_selected_muscle(&mut self) {
        self.changed(ChangeSet::MUSCLE);
    }

    /// The scene tree lists something else: another search.
    pub fn refresh_tree(&mut self) {
        self.changed(ChangeSet::TREE);
    }

    /// Marks the node under the pointer.
    pub fn hover(&mut self, node: Option<NodeId>) {
        if node != self.view.display.highlight.hovered {
            self.view.display.highlight.hovered = node;
            self.changed(ChangeSet::HOVER);
        }
    }

    /// Shows or hides a node with everything below it.
    pub fn set_visible(&mut self, node: NodeId, visible: bool) {
        if node.index() < self.document.scene.graph.len() && self.document.scene.graph.node(node).visible != visible {
            self.undoable(message!("app-edit-visible"), UndoStep::New, |session| {
                session.document.scene.graph.node_mut(node).visible = visible;
                session.needs_posing = true;
                session.changed(ChangeSet::DISPLAY);
            });
        }
    }

    /// The switches.
    pub fn display(&self) -> &Display {
        &self.view.display
    }

    /// Changes switches.
    pub fn change_display(&mut self, change: impl FnOnce(&mut Display)) {
        let before = self.view.display.clone();
        change(&mut self.view.display);
        if before != self.view.display {
            self.changed(ChangeSet::DISPLAY);
        }
    }

    /// The colours of the surroundings.
    pub fn theme(&self) -> Theme {
        self.view.theme
    }

    /// Follows the desktop's light or dark.
    pub fn set_theme(&mut self, theme: Theme) {
        self.change_colors(theme, self.view.backdrop);
    }

    /// What stands behind the scene.
    pub fn backdrop(&self) -> BackgroundPreset {
        self.view.backdrop
    }

    /// Puts something else behind the scene.
    pub fn set_backdrop(&mut self, backdrop: BackgroundPreset) {
        self.change_colors(self.view.theme, backdrop);
    }

    fn change_colors(&mut self, theme: Theme, backdrop: BackgroundPreset) {
        let before = self.view.display.background;
        self.view.set_colors(theme, backdrop);
        if before != self.view.display.background {
            self.changed(ChangeSet::DISPLAY);
        }
    }

    /// Whether the names of bones are written beside them.
    pub fn bone_names(&self) -> bool {
        self.view.bone_names
    }

    /// Writes the names of bones, or no longer.
    pub fn set_bone_names(&mut self, shown: bool) {
        if shown != self.view.bone_names {
            self.view.bone_names = shown;
            self.changed(ChangeSet::DISPLAY);
        }
    }

    /// How joints bend skins.
    pub fn set_skinning(&mut self, skinning: Skinning) {
        if skinning != self.state.skinning {
            self.state.skinning = skinning;
            self.needs_posing = true;
            self.changed(ChangeSet::DISPLAY);
        }
    }

    /// Whether muscles move the skin over them.
    pub fn skin_follows_muscles(&self) -> bool {
        self.state.skin == SkinMotion::FollowsMuscles
    }

    /// Lets muscles move the skin over them, or leaves it to the skeleton.
    pub fn set_skin_follows_muscles(&mut self, follows: bool) {
        let skin = if follows { SkinMotion::FollowsMuscles } else { SkinMotion::Skeleton };
        if skin != self.state.skin {
            self.state.skin = skin;
            self.needs_posing = true;
            self.changed(ChangeSet::DISPLAY);
        }
    }

    /// Paints the weights of the selected node, or no longer.
    pub fn set_weights(&mut self, shown: bool) {
        let selected = self.view.display.highlight.selected.filter(|node| self.is_bone(*node));
        self.change_display(|display| display.highlight.weights = selected.filter(|_| shown));
    }

    /// Whether a node is a bone, or moves a skin.
    pub fn is_bone(&self, node: NodeId) -> bool {
        let graph = &self.document.scene.graph;
        let mut moved = graph.iter().flat_map(|(_, node)| &node.contents).filter_map(|content| match content {
            Content::Mesh(instance) => Some(&instance.deformers),
            _ => None,
        });
        let by_it = |deformer: &Deformer| matches!(deformer, Deformer::Skin { joints, .. } if joints.contains(&Some(node)));
        graph.node(node).kind == NodeKind::Joint || moved.any(|deformers| deformers.iter().any(by_it))
    }

    /// The eye.
    pub fn camera_controller(&self) -> &CameraController {
        &self.view.camera
    }

    /// Whether jumps of the camera are eased.
    pub fn set_eased(&mut self, eased: bool) {
        self.view.camera.animated = eased;
    }

    /// Nothing changed but what surrounds the document, such as a reading that ended without one.
    pub fn touch(&mut self) {
        self.changed(ChangeSet::SURROUNDINGS);
    }

    /// Changes the camera. Navigation from a camera of the file continues from that camera's view.
    pub fn change_camera(&mut self, change: impl FnOnce(&mut CameraController)) {
        if let Viewpoint::File(node, camera) = self.view.camera.viewpoint() {
            self.frame();
            if let Some(camera) = file_camera(&self.document.scene, &self.frame, node, camera) {
                let middle = self.motion_bounds().center();
                self.view.camera.place_at(&camera, middle);
            }
        }
        change(&mut self.view.camera);
        self.fit_on_resize = false;
        self.changed(ChangeSet::CAMERA);
    }

    /// Sets the picture's aspect ratio, width / height. A camera that was not moved is fitted again.
    pub fn set_aspect(&mut self, aspect: f32) {
        if aspect.is_finite() && aspect > 0.0 && aspect != self.aspect {
            self.aspect = aspect;
            if self.fit_on_resize {
                let eased = std::mem::take(&mut self.view.camera.animated);
                self.fit();
                self.view.camera.animated = eased;
            }
        }
    }

    /// Fits everything into the picture, and again after a change of its size until the camera is moved.
    pub fn fit(&mut self) {
        let (bounds, aspect) = (self.motion_bounds(), self.aspect);
        self.view.display.ground = Some(bounds);
        self.change_camera(|eye| eye.fit(&bounds, aspect));
        self.fit_on_resize = true;
    }

    /// Back to the start view, fitted.
    pub fn reset_camera(&mut self) {
        let (bounds, aspect) = (self.motion_bounds(), self.aspect);
        self.view.display.ground = Some(bounds);
        self.change_camera(|eye| {
            eye.animate_to(|orbit| {
                orbit.orthographic = false;
                orbit.look_from(ViewDirection::Start);
                orbit.fit(&bounds, aspect);
            });
        });
        self.fit_on_resize = true;
    }

    /// Puts a node into the middle of the picture.
    pub fn centre_on(&mut self, node: NodeId) {
        let target = self.node_centre(node);
        self.centre_at(target);
    }

    /// Puts a point of the world, metres, into the middle of the picture; the camera orbits round it from then on.
    pub fn centre_at(&mut self, target: Vec3) {
        if target.is_finite() {
            self.change_camera(|eye| eye.animate_to(|orbit| orbit.target = target));
        }
    }

    /// The middle of what hangs on a node, else its origin; world, metres.
    fn node_centre(&mut self, node: NodeId) -> Vec3 {
        let frame = self.frame();
        let mut bounds = Bounds::EMPTY;
        for surface in frame.surfaces.iter().filter(|surface| surface.node == node && surface.ghost.is_none()) {
            for vertex in 0..surface.mesh.positions.len() as u32 {
                bounds.add(surface.position(vertex));
            }
        }
        if bounds.is_empty() { frame.position(node) } else { bounds.center() }
    }

    /// Where the light comes from; `None` = with the camera, high on the left.
    pub fn light(&self) -> Option<LightDirection> {
        self.view.light
    }

    /// Moves the light by degrees.
    pub fn rotate_light(&mut self, yaw: f32, pitch: f32) {
        let mut aim = self.light_direction();
        aim.rotate(yaw, pitch);
        self.view.light = Some(aim);
        self.changed(ChangeSet::LIGHT);
    }

    /// Puts the light where these angles say.
    pub fn set_light(&mut self, aim: LightDirection) {
        if self.view.light != Some(aim) && aim.yaw.is_finite() && aim.pitch.is_finite() {
            self.view.light = Some(aim);
            self.changed(ChangeSet::LIGHT);
        }
    }

    /// Direction to the light: the user's, else beside the camera.
    pub fn light_direction(&self) -> LightDirection {
        self.view.light.unwrap_or_else(|| LightDirection::beside_camera(self.view.camera.orbit().yaw))
    }

    /// The light goes back to its place beside the camera.
    pub fn reset_light(&mut self) {
        if self.view.light.is_some() {
            self.undoable(message!("app-edit-light"), UndoStep::New, |session| {
                session.view.light = None;
                session.changed(ChangeSet::LIGHT);
            });
        }
    }
}
