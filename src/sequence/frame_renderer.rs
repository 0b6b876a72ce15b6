//! Poses and draws one picture of a film after the other.

use super::{FrameSpec, Sequence};
use crate::document::{Document, PoseBuffers};
use crate::render::{Background, Display, Framebuffer, Renderer};
use crate::scene::{Camera, Frame, Scene};
use crate::view::{PoseContext, SceneOverlays};

/// Milliseconds of one frame's stages: pose, deform, vertex, raster, resolve.
pub type Times = [f64; 5];

/// The camera for a posed scene that was turned by some degrees.
pub type Look<'a> = Box<dyn Fn(&Scene, &Frame, f32) -> Camera + Send + 'a>;

/// Everything that is used again from picture to picture.
pub struct SequenceRenderer<'a> {
    document: &'a Document,
    /// What is drawn.
    pub sequence: Sequence,
    look: Look<'a>,
    /// How it looks.
    pub display: Display,
    renderer: Renderer,
    buffers: PoseBuffers,
    frame: Frame,
    times: Vec<Times>,
    /// What accompanies the document, with the frame rate that it goes by.
    company: Option<(SceneOverlays, f64)>,
}

impl<'a> SequenceRenderer<'a> {
    /// A studio that draws `sequence` through the camera that `look` gives, with `threads` threads (`None`: one a core).
    pub fn new(document: &'a Document, sequence: Sequence, display: Display, threads: Option<usize>, look: Look<'a>) -> Self {
        let renderer = Renderer::new(threads);
        let (buffers, frame) = (PoseBuffers::default(), Frame::default());
        Self { document, sequence, look, display, renderer, buffers, frame, times: Vec::new(), company: None }
    }

    /// Draws other moments, paths and what is compared too; `rate` = frames a second of the document's frame numbers.
    pub fn accompanied(mut self, company: SceneOverlays, rate: f64) -> Self {
        self.company = Some((company, rate)).filter(|(company, _)| company.is_active());
        self
    }

    /// The document.
    pub fn document(&self) -> &'a Document {
        self.document
    }

    /// Whether pictures have an alpha channel.
    pub fn is_transparent(&self) -> bool {
        self.display.background == Background::Transparent
    }

    /// Poses and draws picture `index` into `picture`, whose size it has.
    pub fn draw(&mut self, index: usize, picture: &mut Framebuffer) -> FrameSpec {
        let shot = self.sequence.shot(self.document, index);
        if let Some((company, _)) = &mut self.company {
            company.remove_from(&mut self.frame);
        }
        self.document.pose(&shot.state, &mut self.buffers, &mut self.frame);
        if let Some((company, rate)) = &mut self.company {
            company.append_to(&PoseContext::new(self.document, shot.state, *rate, &self.display), &mut self.frame);
        }
        let camera = (self.look)(&self.document.scene, &self.frame, shot.turn);
        let Framebuffer { width, height, pixels } = picture;
        let target = bytemuck::cast_slice_mut(pixels);
        let stride = *width as usize * 4;
        self.renderer.draw_into(&self.document.scene, &self.frame, &camera, &self.display, *width, *height, target, stride);
        let (posed, drawn) = (self.buffers.times(), self.renderer.stats());
        self.times.push([posed.pose_ms, posed.deform_ms, drawn.vertex_ms, drawn.raster_ms, drawn.resolve_ms]);
        shot
    }

    /// How long each picture since the last call took.
    pub fn take_times(&mut self) -> Vec<Times> {
        std::mem::take(&mut self.times)
    }
}
