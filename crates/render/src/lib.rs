//! The rasterizer. Knows the scene alone.

mod background;
mod band_raster;
pub mod bench;
mod bin_lists;
mod binning;
mod bones;
mod clip;
mod debug_lines;
mod display;
mod draw_data;
mod draw_list;
mod edges;
mod light;
mod line;
mod material_state;
mod muscle_texture;
mod pick;
mod pool;
mod projection;
mod raster;
mod renderer;
mod resolve;
mod setup;
mod shade;
mod small_triangles;
mod srgb;
mod static_layer_cache;
mod texels;
mod texture;
mod tile_buffer;
mod vertex;
mod weight_colormap;

pub use display::{Background, Display, OverlayPalette, Samples, Shading, Theme};
pub use weight_colormap::weight_color;

use glam::Vec3;

use pool::Pool;
use renderer::Buffers;
use sinew_scene::limits;
use sinew_scene::{Camera, Frame, NodeId, Scene};
use sinew_simd::SimdLevel;

/// A finished picture: 32 bits a pixel, `0xAARRGGBB` in native byte order (cairo's ARGB32 / RGB24), premultiplied, rows from the top.
#[derive(Debug, Clone, Default)]
pub struct Framebuffer {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width · height` pixels.
    pub pixels: Vec<u32>,
}

impl Framebuffer {
    /// An empty picture.
    ///
    /// # Errors
    /// [`std::io::ErrorKind::OutOfMemory`] where the system gives no memory for it.
    pub fn new(width: u32, height: u32) -> std::io::Result<Self> {
        let count = width as usize * height as usize;
        let mut pixels = Vec::new();
        pixels.try_reserve_exact(count).map_err(|_| std::io::ErrorKind::OutOfMemory)?;
        pixels.resize(count, 0);
        Ok(Self { width, height, pixels })
    }
}

/// What lies under a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PickHit {
    /// The node that the surface or bone hangs on.
    pub node: NodeId,
    /// Index in [`Frame::surfaces`]; `None` for a bone.
    pub surface: Option<u32>,
    /// Index in the surface's mesh triangles; 0 for a bone.
    pub triangle: u32,
    /// Weights of the triangle's corners; they add up to 1.
    pub barycentric: Vec3,
    /// The point in the world, metres.
    pub point: Vec3,
}

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

/// Why the environment variable `SINEW_SIMD` cannot be followed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SimdError {
    /// It is set, to nothing.
    Empty,
    /// This is no instruction set.
    Unknown(String),
    /// This is one, but the processor does not have it.
    Missing(String),
}

/// Draws frames. Keeps its buffers and worker threads between frames.
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

    /// Draws `frame` into a picture of `width` × `height` pixels, each at most [`limits::PICTURE_SIDE`]. The same input gives the same bits for
    /// any number of threads.
    pub fn draw(&mut self, scene: &Scene, frame: &Frame, camera: &Camera, display: &Display, width: u32, height: u32) -> &Framebuffer {
        let mut framebuffer = std::mem::take(&mut self.framebuffer);
        (framebuffer.width, framebuffer.height) = (width.min(limits::PICTURE_SIDE), height.min(limits::PICTURE_SIDE));
        framebuffer.pixels.resize(framebuffer.width as usize * framebuffer.height as usize, 0);
        let stride = framebuffer.width as usize * 4;
        self.draw_into(scene, frame, camera, display, width, height, bytemuck::cast_slice_mut(&mut framebuffer.pixels), stride);
        self.framebuffer = framebuffer;
        &self.framebuffer
    }

    /// Like [`Renderer::draw`], straight into `target`: rows of `stride` bytes, the pixel format of [`Framebuffer`]. Rows or pixels that do not
    /// fit are left out.
    #[allow(clippy::too_many_arguments, reason = "what is drawn and where to, as few words for a caller as a struct would be")]
    pub fn draw_into(
        &mut self,
        scene: &Scene,
        frame: &Frame,
        camera: &Camera,
        display: &Display,
        width: u32,
        height: u32,
        target: &mut [u8],
        stride: usize,
    ) {
        self.stats = self.buffers.draw(&self.pool, self.level, (scene, frame, camera, display), (width, height), target, stride);
    }

    /// What lies under pixel (`x`, `y`) of a picture of that size; nothing is drawn.
    #[allow(clippy::too_many_arguments, reason = "what is drawn and where to, as few words for a caller as a struct would be")]
    pub fn pick(
        &mut self,
        scene: &Scene,
        frame: &Frame,
        camera: &Camera,
        display: &Display,
        width: u32,
        height: u32,
        x: f32,
        y: f32,
    ) -> Option<PickHit> {
        self.buffers.pick(&self.pool, self.level, (scene, frame, camera, display), (width, height), x, y)
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
