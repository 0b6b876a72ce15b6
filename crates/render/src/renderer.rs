//! Draws frames.

use super::frame_stages::Buffers;
use super::pool::Pool;
use super::{Framebuffer, PickHit, PickJob, RenderError, RenderJob, RenderTarget, SimdError};
use sinew_scene::limits;
use sinew_simd::SimdLevel;

/// Milliseconds that each stage of the last frame took, and what it drew.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stats {
    /// Transforming and lighting vertices.
    pub vertex_ms: f64,
    /// Clipping, binning, filling triangles and lines.
    pub raster_ms: f64,
    /// Anti-aliasing, background, and handing over the pixels.
    pub resolve_ms: f64,
    /// Triangles that were given.
    pub triangles: u64,
}

/// Draws frames. Keeps its buffers and worker threads between frames.
///
/// ```
/// use sinew_render::{Background, Display, PickJob, RenderJob, Renderer};
/// use sinew_scene::{Frame, OrbitCamera, Scene};
///
/// let (scene, frame, camera) = (Scene::default(), Frame::default(), OrbitCamera::default().camera());
/// let display = Display { background: Background::Solid(0x336699), grid: false, ..Display::default() };
/// let job = RenderJob { scene: &scene, frame: &frame, camera: &camera, display: &display, width: 4, height: 2 };
/// let mut renderer = Renderer::new(Some(2));
/// assert_eq!(renderer.draw(&job)?.pixels, [0xFF33_6699; 8]);
/// assert_eq!(renderer.pick(&PickJob { picture: job, x: 2.5, y: 0.5 })?, None);
/// # Ok::<(), sinew_render::RenderError>(())
/// ```
#[derive(Debug)]
pub struct Renderer {
    framebuffer: Framebuffer,
    stats: Stats,
    pool: Pool,
    level: SimdLevel,
    buffers: Buffers,
}

impl Default for Renderer {
    fn default() -> Self {
        Self::new(None)
    }
}

impl Renderer {
    /// A renderer with this many threads; `None` = one a core.
    pub fn new(threads: Option<usize>) -> Self {
        let threads = threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
        let pool = Pool::new(threads.clamp(1, limits::THREADS));
        Self { framebuffer: Framebuffer::default(), stats: Stats::default(), pool, level: SimdLevel::detect(), buffers: Buffers::default() }
    }

    /// Draws a picture, which is kept until the next one. The same job gives the same bits for any number of threads.
    ///
    /// # Errors
    /// [`RenderError::OutOfMemory`] where the system gives no memory for the picture or for what it is made from.
    pub fn draw(&mut self, job: &RenderJob<'_>) -> Result<&Framebuffer, RenderError> {
        let RenderJob { width, height, .. } = job.within_limits();
        let mut framebuffer = std::mem::take(&mut self.framebuffer);
        framebuffer.resize(width, height)?;
        let bytes = bytemuck::cast_slice_mut(&mut framebuffer.pixels);
        self.draw_into(job, RenderTarget { bytes, stride: width as usize * 4 })?;
        self.framebuffer = framebuffer;
        Ok(&self.framebuffer)
    }

    /// Like [`Renderer::draw`], straight into memory of the caller's.
    ///
    /// # Errors
    /// As for [`Renderer::draw`]; what the target holds then is of no use.
    pub fn draw_into(&mut self, job: &RenderJob<'_>, target: RenderTarget<'_>) -> Result<(), RenderError> {
        let drawn = self.buffers.draw(&self.pool, self.level, &job.within_limits(), target);
        self.stats = *drawn.as_ref().unwrap_or(&Stats::default());
        self.forget_after_failure(drawn).map(drop)
    }

    /// What lies under a pixel; nothing is drawn.
    ///
    /// # Errors
    /// As for [`Renderer::draw`].
    pub fn pick(&mut self, job: &PickJob<'_>) -> Result<Option<PickHit>, RenderError> {
        let picked = self.buffers.pick(&self.pool, self.level, job);
        self.forget_after_failure(picked)
    }

    /// Lets go of all buffers where there was no memory for some: what is kept from frame to frame may be half made, and others need the memory.
    fn forget_after_failure<T>(&mut self, result: Result<T, RenderError>) -> Result<T, RenderError> {
        if result.is_err() {
            self.buffers = Buffers::default();
        }
        result
    }

    /// The last frame's times.
    pub fn stats(&self) -> Stats {
        self.stats
    }

    /// The instruction set that the kernels use: `scalar`, `sse2`, `avx2` or `avx512`.
    pub fn simd(&self) -> &'static str {
        self.level.name()
    }

    /// Whether this processor has the instruction set that the environment variable `SINEW_SIMD` asks for; a renderer takes the widest where it has not.
    ///
    /// # Errors
    /// [`SimdError`] says what is wrong with the value.
    pub fn asked_simd() -> Result<(), SimdError> {
        let Err(value) = SimdLevel::asked() else { return Ok(()) };
        Err(match &value[..] {
            "" => SimdError::Empty,
            name if SimdLevel::NAMES.contains(&name) => SimdError::Missing(value),
            _ => SimdError::Unknown(value),
        })
    }

    /// The instruction sets that there are, whether this processor has them or not.
    pub fn known_simd() -> [&'static str; 4] {
        SimdLevel::NAMES
    }

    /// Chooses an instruction set by that name; whether this processor has it.
    pub fn set_simd(&mut self, name: &str) -> bool {
        SimdLevel::named(name).map(|level| self.level = level).is_some()
    }

    /// The instruction sets that this processor has, slowest first.
    pub fn simd_names() -> Vec<&'static str> {
        SimdLevel::all().into_iter().map(SimdLevel::name).collect()
    }

    /// Number of threads that draw, the caller counted.
    pub fn threads(&self) -> usize {
        self.pool.workers()
    }
}
