//! What is drawn, and into what.

use sinew_scene::limits::PICTURE_SIDE;
use sinew_scene::{Camera, Frame, Scene};

use super::Display;

/// All that a picture depends on: the same job makes the same bits, whatever the instruction set and the number of threads.
#[derive(Debug, Clone, Copy)]
pub struct RenderJob<'a> {
    /// The scene: images, skins, and which nodes are shown.
    pub scene: &'a Scene,
    /// The scene posed at one moment.
    pub frame: &'a Frame,
    /// From where it is seen. Where this is no camera, such as one with an eye that is not a number, the picture is the background.
    pub camera: &'a Camera,
    /// How it looks.
    pub display: &'a Display,
    /// Columns of the picture; more than [`PICTURE_SIDE`] are not drawn.
    pub width: u32,
    /// Rows, likewise.
    pub height: u32,
}

impl RenderJob<'_> {
    /// The job with no side longer than [`PICTURE_SIDE`].
    pub(super) fn within_limits(self) -> Self {
        Self { width: self.width.min(PICTURE_SIDE), height: self.height.min(PICTURE_SIDE), ..self }
    }
}

/// Memory of the caller's that a picture is drawn into, in the pixel format of [`Framebuffer`](super::Framebuffer).
#[derive(Debug)]
pub struct RenderTarget<'a> {
    /// The rows, from the top. Rows or pixels that do not fit are left out.
    pub bytes: &'a mut [u8],
    /// From row to row, bytes; at least four times the picture's columns for whole rows.
    pub stride: usize,
}
