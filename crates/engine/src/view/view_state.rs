//! How a document is looked at: one value for the window, exports, session files and `sinew render`, so that they show the same picture of the same pose.

use super::{BackgroundPreset, CameraController, CameraFollow, DisplayOptions, LightDirection};
use sinew_render::{Display, Theme};
use sinew_scene::{Bounds, Camera, Frame, OrbitCamera, Scene};

/// How a document is looked at.
#[derive(Debug, Clone, Default)]
pub struct ViewState {
    /// What is drawn and how, and what is marked. Colours and background follow `theme` and `backdrop`: see [`ViewState::set_colors`].
    pub display: Display,
    /// Light or dark surroundings.
    pub theme: Theme,
    /// What stands behind the scene.
    pub backdrop: BackgroundPreset,
    /// Whether the names of bones are written beside them.
    pub bone_names: bool,
    /// The frame rate that a person chose; `None` = the one that the keys tell.
    pub frame_rate: Option<f64>,
    /// Where the light comes from; `None` = with the camera, high on the left.
    pub light: Option<LightDirection>,
    /// From where it is seen.
    pub camera: CameraController,
    /// The node that the orbit camera goes along with.
    pub follow: Option<CameraFollow>,
}

impl ViewState {
    /// Seen from an orbit.
    pub fn orbiting(orbit: OrbitCamera) -> Self {
        let mut view = Self::default();
        view.camera.change(|own| *own = orbit);
        view
    }

    /// What settings and session files keep of it.
    pub fn options(&self) -> DisplayOptions {
        DisplayOptions::of(&self.display, self.backdrop, self.bone_names, self.frame_rate)
    }

    /// Takes over what settings or a session file keep.
    pub fn set_options(&mut self, options: &DisplayOptions) {
        options.apply_to(&mut self.display);
        (self.bone_names, self.frame_rate) = (options.bone_names, options.frame_rate);
        self.set_colors(self.theme, options.backdrop);
    }

    /// Background and what is drawn over the model: on white, what is meant for light surroundings, whatever the window wears.
    pub fn set_colors(&mut self, theme: Theme, backdrop: BackgroundPreset) {
        (self.theme, self.backdrop) = (theme, backdrop);
        (self.display.palette, self.display.background) = backdrop.palette_and_background(theme);
    }

    /// Puts the light where its direction says, seen from the middle of `bounds`; where no direction is chosen, it stays with the camera.
    pub fn place_light(&mut self, bounds: &Bounds) {
        self.display.light = self.light.map(|direction| direction.position(bounds));
    }

    /// The camera for a posed scene, orbited by `turntable` degrees to the right. A flight and a camera of the file know neither turntable nor following.
    pub fn camera(&self, scene: &Scene, frame: &Frame, turntable: f32) -> Camera {
        self.camera.fixed_camera(scene, frame).unwrap_or_else(|| {
            let orbit = self.camera.orbit();
            let camera = OrbitCamera { yaw: orbit.yaw + turntable, ..*orbit }.camera();
            self.follow.map_or(camera, |follow| follow.moved(camera, frame))
        })
    }
}
