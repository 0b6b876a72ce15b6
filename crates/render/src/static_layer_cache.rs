//! The background together with the lines that lie under everything: the same from frame to frame while the camera rests, so it is drawn once and kept.
//!
//! Lines of the ground are drawn on the background first. Surfaces then cover it, and the lines are drawn once more where a surface is behind them. Kept or
//! not, a pixel goes through the same steps, so its bits are the same.

use super::memory::zeroed;
use super::{Background, Display};
use sinew_scene::{Bounds, Camera};

/// Pictures of more pixels are not kept; 4K has 8.3 million.
const MAX_PIXELS: usize = 9 << 20;

/// Everything that the static layer depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
struct StaticLayerKey {
    camera: Camera,
    size: [u32; 2],
    /// Rows of a band, and how many bands the target has room for: no others are drawn.
    bands: [usize; 2],
    background: Background,
    /// Box, cell, colour and opacity.
    grid: Option<(Bounds, Option<f32>, (u32, f32))>,
    /// Scale and width of lines.
    widths: [f32; 2],
    depth_test: bool,
}

/// Where the pixels of the static layer come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum CacheState {
    /// It differs from the one before and may well differ again.
    #[default]
    New,
    /// It is the same a second time: worth keeping.
    Same,
    /// It was kept.
    Kept,
}

/// The static layer of the last frame.
#[derive(Debug, Default)]
pub(super) struct BackgroundCache {
    key: Option<StaticLayerKey>,
    state: CacheState,
    pixels: Vec<u32>,
}

/// The static layer's pixels of a band.
pub(super) enum BandPixels<'a> {
    /// Nothing: it has to be drawn.
    None,
    /// Room to keep it once it is drawn.
    Room(&'a mut [u32]),
    /// All of it.
    Kept(&'a [u32]),
}

impl BackgroundCache {
    /// Begins a frame; `bounds` are the frame's.
    pub(super) fn begin(&mut self, camera: &Camera, display: &Display, bounds: Bounds, size: [u32; 2], bands: [usize; 2]) {
        let grid = display.grid.then_some((display.ground.unwrap_or(bounds), display.grid_cell, display.palette.grid));
        let widths = [display.scale, display.line_width];
        let key =
            StaticLayerKey { camera: *camera, size, bands, background: display.background, grid, widths, depth_test: display.depth_test };
        // What is not a number differs from itself and is drawn anew each time.
        let same = self.key.as_ref() == Some(&key);
        let room = size[0] as usize * size[1] as usize;
        self.state = match self.state {
            CacheState::Kept | CacheState::Same if same && room <= MAX_PIXELS => CacheState::Kept,
            CacheState::New if same && room <= MAX_PIXELS => CacheState::Same,
            _ => CacheState::New,
        };
        self.key = Some(key);
        if room <= MAX_PIXELS && self.pixels.len() < room && grid.is_some() {
            // In the first frame already, though only the second may write it: the system hands memory out only as it is touched. Where it refuses, the
            // static layer is drawn in each frame.
            self.pixels = Vec::new();
            self.pixels = zeroed(room).unwrap_or_default();
        }
    }

    /// Whether the lines have to be made again.
    pub(super) fn is_new(&self) -> bool {
        self.state == CacheState::New
    }

    /// The bands' parts.
    pub(super) fn bands(&mut self) -> impl Iterator<Item = BandPixels<'_>> {
        let (width, height, rows) = self.key.map_or((0, 0, 0), |key| (key.size[0] as usize, key.size[1] as usize, key.bands[0]));
        let (state, room) = (self.state, width * height);
        let grid = self.key.is_some_and(|key| key.grid.is_some());
        let end = if state == CacheState::New || !grid { 0 } else { room.min(self.pixels.len()) };
        let parts = self.pixels[..end].chunks_mut((width * rows).max(1)).map(move |part| match state {
            CacheState::Kept => BandPixels::Kept(part),
            _ => BandPixels::Room(part),
        });
        parts.chain(std::iter::repeat_with(|| BandPixels::None))
    }
}
