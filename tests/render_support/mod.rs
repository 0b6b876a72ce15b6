//! Scenes and helpers of the rasterizer's tests. Everything is made here; no file is needed.
#![allow(dead_code, reason = "each test target uses a part of it")]

pub(crate) mod golden;
pub(crate) mod models;
pub(crate) mod reference;
pub(crate) mod rng;

use glam::{Quat, Vec3};
use sinew::render::{Background, Display, PickHit, PickJob, RenderJob, Renderer, Samples};
use sinew::scene::{Camera, Frame, Projection, Scene};

/// A scene with its frame.
#[derive(Default)]
pub(crate) struct World {
    pub scene: Scene,
    pub frame: Frame,
}

impl World {
    /// The picture of this world.
    pub(crate) fn job<'a>(&'a self, camera: &'a Camera, display: &'a Display, size: [u32; 2]) -> RenderJob<'a> {
        RenderJob { scene: &self.scene, frame: &self.frame, camera, display, width: size[0], height: size[1] }
    }

    /// What lies under a pixel of it.
    pub(crate) fn pick(
        &self,
        renderer: &mut Renderer,
        camera: &Camera,
        display: &Display,
        size: [u32; 2],
        x: f32,
        y: f32,
    ) -> Option<PickHit> {
        renderer.pick(&PickJob { picture: self.job(camera, display, size), x, y }).expect("there is memory for picking")
    }

    /// Draws into a fresh vector of pixels.
    pub(crate) fn draw(&self, renderer: &mut Renderer, camera: &Camera, display: &Display, size: [u32; 2]) -> Vec<u32> {
        renderer.draw(&self.job(camera, display, size)).expect("there is memory for the picture").pixels.clone()
    }
}

/// A camera on +Z that looks at the origin from this far.
pub(crate) fn camera_at(distance: f32) -> Camera {
    Camera {
        eye: Vec3::Z * distance,
        rotation: Quat::IDENTITY,
        projection: Projection::Perspective { fov_y: 45f32.to_radians() },
        near: 0.1,
        far: 100.0,
    }
}

/// A camera under which world x and y *are* pixel coordinates (y upward from the bottom edge) of a picture of this size.
pub(crate) fn pixel_camera(size: [u32; 2]) -> Camera {
    let [w, h] = size.map(|side| side as f32);
    Camera {
        eye: Vec3::new(w * 0.5, h * 0.5, 10.0),
        rotation: Quat::IDENTITY,
        projection: Projection::Orthographic { height: h },
        near: 0.0,
        far: 20.0,
    }
}

/// Nothing but the surfaces: black background, one sample, no grid.
pub(crate) fn plain() -> Display {
    Display { background: Background::Solid(0), samples: Samples::One, grid: false, ..Display::default() }
}
