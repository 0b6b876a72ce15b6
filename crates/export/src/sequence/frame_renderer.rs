//! Poses and draws the frames of a sequence.

use super::{FrameSpec, Sequence};
use sinew_engine::document::{Document, PoseBuffers};
use sinew_engine::view::{DEFAULT_FRAME_RATE, PoseContext, SceneOverlays, ViewState};
use sinew_render::{Background, Framebuffer, RenderError, RenderJob, RenderTarget, Renderer};
use sinew_scene::Frame;

/// Durations of one frame's stages, milliseconds: pose, deform, vertex, raster, resolve.
pub type FrameTimes = [f64; 5];

/// Draws the frames of a sequence; its buffers are reused from frame to frame.
pub struct SequenceRenderer<'a> {
    document: &'a Document,
    /// The sequence.
    pub sequence: Sequence,
    /// How it is looked at.
    view: ViewState,
    renderer: Renderer,
    buffers: PoseBuffers,
    frame: Frame,
    times: Vec<FrameTimes>,
    /// Overlays, with the frame rate that onion skins use.
    overlays: Option<(SceneOverlays, f64)>,
}

impl<'a> SequenceRenderer<'a> {
    /// A renderer that draws `sequence` looked at as `view` says, with `threads` threads (`None`: one per core). The light stands where
    /// [`ViewState::place_light`] has put it.
    pub fn new(document: &'a Document, sequence: Sequence, view: ViewState, threads: Option<usize>) -> Self {
        let renderer = Renderer::new(threads);
        let (buffers, frame) = (PoseBuffers::default(), Frame::default());
        let overlays = view.display.lines_of_action.then(|| (SceneOverlays::default(), DEFAULT_FRAME_RATE));
        Self { document, sequence, view, renderer, buffers, frame, times: Vec::new(), overlays }
    }

    /// Draws overlays too; `frame_rate` = frames per second of the document's frame numbers.
    pub fn with_overlays(mut self, overlays: SceneOverlays, frame_rate: f64) -> Self {
        let lines = self.view.display.lines_of_action;
        self.overlays = Some((overlays, frame_rate)).filter(|(overlays, _)| overlays.is_active() || lines);
        self
    }

    /// The document.
    pub fn document(&self) -> &'a Document {
        self.document
    }

    /// Whether the frames have an alpha channel.
    pub fn is_transparent(&self) -> bool {
        self.view.display.background == Background::Transparent
    }

    /// Poses and draws frame `index` into `picture`, in its size.
    ///
    /// # Errors
    /// [`RenderError::OutOfMemory`] where the system gives no memory for what the picture is made from.
    pub fn draw(&mut self, index: usize, picture: &mut Framebuffer) -> Result<FrameSpec, RenderError> {
        let spec = self.sequence.frame_spec(self.document, index);
        if let Some((overlays, _)) = &mut self.overlays {
            overlays.remove_from(&mut self.frame);
        }
        self.document.pose(&spec.state, &mut self.buffers, &mut self.frame);
        if let Some((overlays, frame_rate)) = &mut self.overlays {
            overlays.append_to(&PoseContext::new(self.document, spec.state.clone(), *frame_rate, &self.view.display), &mut self.frame);
        }
        let camera = self.view.camera(&self.document.scene, &self.frame, spec.turntable);
        let Framebuffer { width, height, pixels } = picture;
        let target = RenderTarget { bytes: bytemuck::cast_slice_mut(pixels), stride: *width as usize * 4 };
        let (scene, frame, display) = (&self.document.scene, &self.frame, &self.view.display);
        self.renderer.draw_into(&RenderJob { scene, frame, camera: &camera, display, width: *width, height: *height }, target)?;
        let (posed, drawn) = (self.buffers.times(), self.renderer.stats());
        self.times.push([posed.pose_ms, posed.deform_ms, drawn.vertex_ms, drawn.raster_ms, drawn.resolve_ms]);
        Ok(spec)
    }

    /// The durations of the frames drawn since the last call.
    pub fn take_times(&mut self) -> Vec<FrameTimes> {
        std::mem::take(&mut self.times)
    }
}
