//! The stages of a frame in order.

use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use super::background::BackgroundRows;
use super::band_raster::{BandJob, WorkerScratch, XRAY, draw_band};
use super::binning::BandLayout;
use super::draw_list::DrawList;
use super::line::LineSegments;
use super::pool::{Pool, take};
use super::resolve::SampleRows;
use super::static_layer_cache::BackgroundCache;
use super::triangle_bins::TriangleBins;
use super::vertex_arrays::VertexArrays;
use super::{Display, RenderError, RenderJob, RenderTarget, Samples, Stats};
use sinew_simd::SimdLevel;

/// Rows of a band: enough for a small triangle to touch one band mostly, few enough for its pixels to stay in the second-level cache.
const BAND_ROWS: usize = 48;
/// The same with four samples a pixel.
const BAND_ROWS_MULTI: usize = 32;
const _: () = assert!(BAND_ROWS <= super::setup::ROWS && BAND_ROWS_MULTI <= super::setup::ROWS);

/// What is kept from frame to frame, in the order in which the stages fill it: each reads what those before it made.
#[derive(Debug, Default)]
pub(super) struct Buffers {
    pub list: DrawList,
    segments: LineSegments,
    pub vertices: VertexArrays,
    bins: TriangleBins,
    background: BackgroundCache,
    /// One a worker.
    scratch: Vec<Mutex<WorkerScratch>>,
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
    /// Draws one frame.
    pub(super) fn draw(
        &mut self,
        pool: &Pool,
        level: SimdLevel,
        job: &RenderJob<'_>,
        target: RenderTarget<'_>,
    ) -> Result<Stats, RenderError> {
        let RenderJob { frame, camera, display, width, height, .. } = *job;
        let RenderTarget { bytes: target, stride } = target;
        let mut stats = Stats::default();
        if width == 0 || height == 0 || stride < 4 {
            return Ok(stats);
        }
        let layout = TargetLayout::new(display, width, height);
        let start = Instant::now();
        let (view, lights) = self.list.build(job, &layout, false)?;
        let band_rows = layout.bands.rows;
        let bands = target.len().div_ceil(stride * band_rows).min(layout.bands.count);
        self.background.begin(camera, display, frame.bounds, [width, height], [band_rows, bands]);
        self.list.lines(job, &view, &layout.bands, lights.position, self.background.is_new(), &mut self.segments)?;
        self.vertices.fill((pool, level), &self.list, frame, &view, &lights)?;
        stats.vertex_ms = milliseconds(start);
        let start = Instant::now();
        let frame_data = self.list.frame_data(&self.vertices, frame, view, lights);
        self.bins.fill(pool, &frame_data, &layout.bands)?;
        let xray = if !display.depth_test {
            1.0
        } else if display.xray {
            XRAY
        } else {
            0.0
        };
        let picture = BandJob {
            frame_data: &frame_data,
            target: &layout,
            units: self.bins.units(),
            sorted: &self.bins.sorted,
            sorted_bins: &self.bins.sorted_bins,
            segments: &self.segments,
            xray,
        };
        let scratch = &mut self.scratch;
        scratch.resize_with(pool.workers().max(scratch.len()), Mutex::default);
        // Here, not by the workers: one that comes late to the first frames would make its room in a later one.
        for local in scratch.iter_mut() {
            local.get_mut().unwrap_or_else(PoisonError::into_inner).reserve(&picture)?;
        }
        let rows = Mutex::new(target.chunks_mut(stride * band_rows).take(bands).zip(self.background.bands()).enumerate());
        pool.run(&|worker| {
            // Each worker has its own, so the lock is free.
            let mut local = scratch[worker].lock().unwrap_or_else(PoisonError::into_inner);
            local.resolve_ms = 0.0;
            while let Some((band, (bytes, piece))) = take(&rows) {
                draw_band(level, &picture, band, &mut local, piece, SampleRows { bytes, stride });
            }
        });
        drop(rows);
        let workers = pool.workers() as f64;
        stats.resolve_ms =
            scratch.iter_mut().map(|local| local.get_mut().unwrap_or_else(PoisonError::into_inner).resolve_ms).sum::<f64>() / workers;
        stats.raster_ms = (milliseconds(start) - stats.resolve_ms).max(0.0);
        stats.triangles = self.list.draw_calls.last().map_or(0, |item| u64::from(item.triangles.end));
        Ok(stats)
    }
}

fn milliseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}
