//! The stages of a frame in order.

use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use glam::Vec4;

use super::background::BackgroundRows;
use super::band_raster::{BandJob, WorkerScratch, XRAY, draw_band};
use super::bin_lists::BinLists;
use super::binning::{BandLayout, bin};
use super::draw_data::{DrawCall, FrameData, GeneratedMesh, WorkUnit, geometry};
use super::draw_list::{DrawListBuilder, light_position};
use super::light::Lights;
use super::line::{LinePass, LineSegments};
use super::material_state::RenderPass;
use super::pool::Pool;
use super::projection::{ScreenVertex, ViewTransform};
use super::resolve::SampleRows;
use super::static_layer_cache::BackgroundCache;
use super::texture::TextureCache;
use super::vertex::{CHUNK, Quad, VertexBuffers, vertices};
use super::{Display, Samples, Stats};
use sinew_scene::limits;
use sinew_scene::{Camera, Frame, Scene};
use sinew_simd::SimdLevel;

/// Rows of a band: enough for a small triangle to touch one band mostly, few enough for its pixels to stay in the second-level cache.
const BAND_ROWS: usize = 48;
/// The same with four samples a pixel.
const BAND_ROWS_MULTI: usize = 32;
const _: () = assert!(BAND_ROWS <= super::setup::ROWS && BAND_ROWS_MULTI <= super::setup::ROWS);
/// Triangles in a unit of binning, at least.
const UNIT: u32 = 2048;
/// Most units a layer, so that the lists of a picture stay few.
const UNITS: u32 = 64;

/// What is kept from frame to frame.
#[derive(Debug, Default)]
pub(super) struct Buffers {
    pub collector: DrawListBuilder,
    pub items: Vec<DrawCall>,
    pub bones: GeneratedMesh,
    pub weight_colors: Vec<Vec4>,
    pub cache: TextureCache,
    pub segments: LineSegments,
    pub ground: BackgroundCache,
    screen: Vec<ScreenVertex>,
    front: Vec<Quad>,
    back: Vec<Quad>,
    units: Vec<WorkUnit>,
    sorted: Vec<Sorted>,
    sorted_bins: BinLists,
    locals: Vec<Mutex<WorkerScratch>>,
}

/// A blended triangle in drawing order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sorted {
    nearness: f32,
    pub unit: u32,
    pub entry: u32,
}

/// Distributes the parts of a slice to the workers, each part once.
fn take<T>(from: &Mutex<impl Iterator<Item = T>>) -> Option<T> {
    from.lock().unwrap_or_else(PoisonError::into_inner).next()
}

/// Cuts the vertex arrays into chunks.
struct Chunks<'a> {
    items: std::slice::Iter<'a, DrawCall>,
    now: Option<&'a DrawCall>,
    start: usize,
    screen: &'a mut [ScreenVertex],
    front: &'a mut [Quad],
    back: &'a mut [Quad],
}

impl<'a> Iterator for Chunks<'a> {
    type Item = (&'a DrawCall, usize, VertexBuffers<'a>);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let Some(item) = self.now else {
                self.now = Some(self.items.next()?);
                self.start = 0;
                continue;
            };
            let n = (item.vertices.len() - self.start).min(CHUNK);
            if n == 0 {
                self.now = None;
                continue;
            }
            let start = self.start;
            self.start += n;
            let out = VertexBuffers {
                screen: self.screen.split_off_mut(..n)?,
                front: self.front.split_off_mut(..n)?,
                back: self.back.split_off_mut(..n)?,
            };
            return Some((item, start, out));
        }
    }
}

/// A picture's size, its bands, and its background.
pub(super) struct TargetLayout {
    pub width: u32,
    pub height: u32,
    pub samples: usize,
    pub bands: BandLayout,
    pub background: BackgroundRows,
}

impl TargetLayout {
    pub(super) fn new(display: &Display, width: u32, height: u32) -> Self {
        let multi = display.samples == Samples::Four;
        let rows = if multi { BAND_ROWS_MULTI } else { BAND_ROWS };
        let bands = BandLayout { rows, count: (height as usize).div_ceil(rows).max(1), multi };
        Self { width, height, samples: if multi { 4 } else { 1 }, bands, background: BackgroundRows::new(display.background, height) }
    }
}

impl Buffers {
    /// Draws one frame into `target`, rows of `stride` bytes.
    #[allow(clippy::too_many_arguments, reason = "parts of the renderer that are borrowed apart from each other")]
    pub(super) fn draw(
        &mut self,
        pool: &Pool,
        level: SimdLevel,
        (scene, frame, camera, display): (&Scene, &Frame, &Camera, &Display),
        (width, height): (u32, u32),
        target: &mut [u8],
        stride: usize,
    ) -> Stats {
        let (width, height) = (width.min(limits::PICTURE_SIDE), height.min(limits::PICTURE_SIDE));
        let mut stats = Stats::default();
        if width == 0 || height == 0 || stride < 4 {
            return stats;
        }
        let canvas = TargetLayout::new(display, width, height);
        let start = Instant::now();
        let (view, lights) = self.prepare(scene, frame, camera, display, &canvas, false);
        let band_rows = canvas.bands.rows;
        let bands = target.len().div_ceil(stride * band_rows).min(canvas.bands.count);
        self.ground.begin(camera, display, frame.bounds, [width, height], [band_rows, bands]);
        self.lines(scene, frame, &view, &canvas.bands, display, &lights);
        self.vertex_stage(pool, level, frame, &view, &lights);
        stats.vertex_ms = milliseconds(start);
        let start = Instant::now();
        let mut units = std::mem::take(&mut self.units);
        let mut locals = std::mem::take(&mut self.locals);
        let mut sorted = std::mem::take(&mut self.sorted);
        let mut sorted_bins = std::mem::take(&mut self.sorted_bins);
        let mut ground = std::mem::take(&mut self.ground);
        let frame_data = self.frame_data(frame, view, lights);
        let unit_count = divide(&self.items, &mut units);
        let jobs = Mutex::new(units[..unit_count].iter_mut());
        pool.run(&|_| {
            while let Some(unit) = take(&jobs) {
                bin(&frame_data, &canvas.bands, unit);
            }
        });
        let units_now = &units[..unit_count];
        sort_blended(&frame_data, &canvas.bands, units_now, &mut sorted, &mut sorted_bins);
        let xray = if !display.depth_test {
            1.0
        } else if display.xray {
            XRAY
        } else {
            0.0
        };
        let picture = BandJob {
            frame_data: &frame_data,
            target: &canvas,
            units: units_now,
            sorted: &sorted,
            sorted_bins: &sorted_bins,
            segments: &self.segments,
            xray,
        };
        locals.resize_with(pool.workers().max(locals.len()), Mutex::default);
        // Here, not by the workers: one that comes late to the first frames would make its room in a later one.
        for local in &mut locals {
            local.get_mut().unwrap_or_else(PoisonError::into_inner).reserve(&picture);
        }
        let rows = Mutex::new(target.chunks_mut(stride * band_rows).take(bands).zip(ground.bands()).enumerate());
        pool.run(&|worker| {
            // Each worker has its own, so the lock is free.
            let mut local = locals[worker].lock().unwrap_or_else(PoisonError::into_inner);
            local.resolve_ms = 0.0;
            while let Some((band, (bytes, piece))) = take(&rows) {
                draw_band(level, &picture, band, &mut local, piece, SampleRows { bytes, stride });
            }
        });
        drop(rows);
        let workers = pool.workers() as f64;
        stats.resolve_ms =
            locals.iter_mut().map(|local| local.get_mut().unwrap_or_else(PoisonError::into_inner).resolve_ms).sum::<f64>() / workers;
        stats.raster_ms = (milliseconds(start) - stats.resolve_ms).max(0.0);
        stats.triangles = self.items.last().map_or(0, |item| u64::from(item.triangles.end));
        (self.units, self.locals, self.sorted, self.sorted_bins, self.ground) = (units, locals, sorted, sorted_bins, ground);
        stats
    }

    /// Makes the list of the triangles that are to be drawn, or that can be picked.
    #[allow(clippy::too_many_arguments, reason = "parts of the renderer that are borrowed apart from each other")]
    pub(super) fn prepare(
        &mut self,
        scene: &Scene,
        frame: &Frame,
        camera: &Camera,
        display: &Display,
        canvas: &TargetLayout,
        picking: bool,
    ) -> (ViewTransform, Lights) {
        let view = ViewTransform::new(camera, canvas.width, canvas.height);
        // Without a camera nothing is drawn but the background.
        let seen = view.is_some();
        let view = view.unwrap_or_else(ViewTransform::degenerate);
        let position = light_position(frame, &view, display);
        self.items.clear();
        if seen {
            let mut cache = std::mem::take(&mut self.cache);
            cache.begin();
            self.build(&mut cache, (scene, frame), &view, display, picking);
            self.cache = cache;
        }
        (view, Lights::new(position, display.ambient, &view))
    }

    /// Makes the lists of lines.
    fn lines(&mut self, scene: &Scene, frame: &Frame, view: &ViewTransform, bands: &BandLayout, display: &Display, lights: &Lights) {
        if view.is_somewhere() {
            self.add_lines(scene, frame, view, bands, display, lights.position);
        } else {
            [LinePass::Under, LinePass::Over, LinePass::Overlay].into_iter().for_each(|stage| self.segments.reset(stage, bands));
        }
    }

    /// What the stages after the vertex stage read.
    pub(super) fn frame_data<'a>(&'a self, frame: &'a Frame, view: ViewTransform, lights: Lights) -> FrameData<'a> {
        FrameData {
            view,
            lights,
            frame,
            bones: &self.bones,
            draw_calls: &self.items,
            textures: self.cache.textures(),
            weight_colors: &self.weight_colors,
            screen: &self.screen,
            front: &self.front,
            back: &self.back,
        }
    }

    /// Transforms and lights the vertices of all items.
    pub(super) fn vertex_stage(&mut self, pool: &Pool, level: SimdLevel, frame: &Frame, view: &ViewTransform, lights: &Lights) {
        let total = self.items.last().map_or(0, |item| item.vertices.end);
        // Never shrunk: a smaller frame uses the front of the arrays.
        if self.screen.len() < total {
            self.screen.resize(total, ScreenVertex::default());
            self.front.resize(total, Quad::default());
            self.back.resize(total, Quad::default());
        }
        let (bones, weight_colors) = (&self.bones, &self.weight_colors);
        let chunks = Mutex::new(Chunks {
            items: self.items.iter(),
            now: None,
            start: 0,
            screen: &mut self.screen,
            front: &mut self.front,
            back: &mut self.back,
        });
        pool.run(&|_| {
            while let Some((item, start, out)) = take(&chunks) {
                vertices(level, view, lights, &item.material, &geometry(frame, bones, weight_colors, item), start, out);
            }
        });
        for item in self.items.iter().filter(|item| item.material.depth_offset > 0.0) {
            let [factor, summand] = view.depth_bias(-item.material.depth_offset);
            self.screen.get_mut(item.vertices.clone()).into_iter().flatten().for_each(|corner| corner.q = corner.q * factor + summand);
        }
    }
}

fn milliseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}

/// Divides the triangles into units; none holds triangles of two layers. Returns how many there are.
fn divide(items: &[DrawCall], units: &mut Vec<WorkUnit>) -> usize {
    let mut count = 0;
    for layer in [RenderPass::Opaque, RenderPass::Blended, RenderPass::Overlay] {
        let from = items.partition_point(|item| item.material.pass < layer);
        let to = items.partition_point(|item| item.material.pass <= layer);
        let Some((first, last)) = items[from..to].first().zip(items[from..to].last()) else { continue };
        let (start, end) = (first.triangles.start, last.triangles.end);
        let size = (end - start).div_ceil(UNITS).max(UNIT);
        for at in (start..end).step_by(size as usize) {
            if units.len() == count {
                units.push(WorkUnit::default());
            }
            units[count].range = at..end.min(at + size);
            count += 1;
        }
    }
    count
}

/// Puts the blended triangles of all units in order, the farthest first, and into bands.
fn sort_blended(frame_data: &FrameData<'_>, bands: &BandLayout, units: &[WorkUnit], sorted: &mut Vec<Sorted>, bins: &mut BinLists) {
    sorted.clear();
    for (index, unit) in units.iter().enumerate() {
        sorted.extend(unit.blended.iter().map(|&(nearness, entry)| Sorted { nearness, unit: index as u32, entry }));
    }
    bins.reset(bands.count);
    sorted.sort_unstable_by(|a, b| a.nearness.total_cmp(&b.nearness).then(a.unit.cmp(&b.unit)).then(a.entry.cmp(&b.entry)));
    for (index, triangle) in sorted.iter().enumerate() {
        let unit = &units[triangle.unit as usize];
        let Some(item) = frame_data.draw_call_of(FrameData::triangle_number(unit, triangle.entry)) else { continue };
        if let Some(part) = FrameData::clipped_triangle(item, &frame_data.reader(item), unit, triangle.entry) {
            bands.push_to_bands(bins, &super::setup::Rect::of(&part.screen, bands.multi, frame_data.view.size), index as u32);
        }
    }
}
