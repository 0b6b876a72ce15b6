//! Rasterizes one band of the picture, from the background to the finished rows: the job of one worker.
//!
//! Only the columns that something touches pass through the band's buffer; the others go straight from the background to the target. A figure in
//! the middle of a wide picture would else pay for four samples of nothing on either side.

use std::time::Instant;

use super::RenderError;
use super::bin_lists::{BinLists, ColumnRange};
use super::binning::BandLayout;
use super::draw_data::{DrawCall, FrameData, WorkUnit};
use super::frame_stages::TargetLayout;
use super::line::{self, LinePass, LineSegments, LineTarget};
use super::material_state::RenderPass;
use super::memory::grow;
use super::raster::{DrawRun, fill};
use super::resolve::{SampleRows, copy_row, lay_over, resolve};
use super::static_layer_cache::BandPixels;
use super::tile_buffer::BandBuffer;
use super::triangle_bins::Sorted;
use sinew_simd::SimdLevel;

/// Opacity of bones behind a surface, where they show through it.
pub(super) const XRAY: f32 = 0.45;

/// Columns in use begin and end at multiples of this, so that copies start where vectors and the background's pattern do.
const STEP: i32 = 16;

/// All that a band is drawn from.
pub(super) struct BandJob<'a> {
    pub frame_data: &'a FrameData<'a>,
    pub target: &'a TargetLayout,
    pub units: &'a [WorkUnit],
    pub sorted: &'a [Sorted],
    pub sorted_bins: &'a BinLists,
    pub segments: &'a LineSegments,
    /// Opacity of the overlay behind a surface.
    pub xray: f32,
}

/// What each worker has of its own.
#[derive(Debug, Default)]
pub(super) struct WorkerScratch {
    buffer: BandBuffer,
    overlay: BandBuffer,
    static_layer: BandBuffer,
    entries: Vec<u32>,
    row: Vec<u32>,
    pub resolve_ms: f64,
}

impl WorkerScratch {
    /// Makes room for any band of a picture, so that drawing one asks for no memory.
    pub(super) fn reserve(&mut self, job: &BandJob<'_>) -> Result<(), RenderError> {
        let TargetLayout { width, samples, bands: BandLayout { rows, .. }, .. } = *job.target;
        let bands = 0..job.target.bands.count;
        let any = |stage: LinePass| bands.clone().any(|band| !job.segments.is_empty(stage, band));
        self.row.clear();
        grow(&mut self.row, width as usize)?;
        self.buffer.reserve(rows, width as usize, samples)?;
        if any(LinePass::Under) {
            self.static_layer.reserve(rows, width as usize, 1)?;
        }
        if any(LinePass::Overlay) || job.units.iter().any(|unit| job.is_overlay(unit)) {
            self.overlay.reserve(rows, width as usize, samples)?;
        }
        self.entries.clear();
        Ok(self.entries.try_reserve(job.units.iter().map(|unit| unit.bins.max_len()).max().unwrap_or(0))?)
    }
}

impl BandJob<'_> {
    fn is_overlay(&self, unit: &WorkUnit) -> bool {
        self.frame_data.draw_call_of(unit.range.start).is_some_and(|item| item.material.pass == RenderPass::Overlay)
    }

    /// The columns that surfaces, and that surfaces, lines and bones touch in a band.
    fn columns(&self, band: usize) -> [ColumnRange; 2] {
        let (mut surfaces, mut all) = (self.sorted_bins.columns(band), ColumnRange::NONE);
        for unit in self.units.iter().filter(|unit| !unit.bins.is_empty(band)) {
            let columns = unit.bins.columns(band);
            if self.is_overlay(unit) {
                all = all.union(columns);
            } else {
                surfaces = surfaces.union(columns);
            }
        }
        for stage in [LinePass::Over, LinePass::Overlay] {
            all = all.union(self.segments.columns(stage, band));
        }
        let end = self.target.width as i32 - 1;
        let whole = |of: ColumnRange| {
            if of.is_empty() { of } else { ColumnRange { first: of.first & -STEP, last: (of.last | (STEP - 1)).min(end) } }
        };
        [surfaces, surfaces.union(all)].map(whole)
    }
}

/// Draws one band from the background to the finished rows.
pub(super) fn draw_band(
    level: SimdLevel,
    job: &BandJob<'_>,
    band: usize,
    scratch: &mut WorkerScratch,
    mut piece: BandPixels<'_>,
    mut target: SampleRows<'_>,
) {
    let BandJob { frame_data, target: canvas, units, sorted, sorted_bins, segments, xray } = *job;
    let (top, width) = ((band * canvas.bands.rows) as i32, canvas.width as usize);
    let rows = canvas.bands.rows.min(canvas.height as usize - top as usize);
    let WorkerScratch { buffer: plane, overlay, static_layer: ground, entries, row, resolve_ms } = scratch;
    let lined = !segments.is_empty(LinePass::Under, band);
    if lined && !matches!(piece, BandPixels::Kept(_)) {
        ground.resize(top, rows, width, ColumnRange { first: 0, last: width as i32 - 1 }, 1);
        for y in 0..rows {
            canvas.background.row(top + y as i32, ground.row_mut(0, y));
        }
        line::segments(level, segments, LinePass::Under, LineTarget::BackgroundCache, band, ground);
        if let BandPixels::Room(room) = &mut piece {
            room.chunks_mut(width).enumerate().for_each(|(y, to)| to.copy_from_slice(ground.row(0, y)));
        }
    }
    let [surfaces, used] = job.columns(band);
    let start = Instant::now();
    plane.resize(top, rows, width, used, canvas.samples);
    let [left, right] = plane.used;
    for y in 0..rows {
        let behind = match &piece {
            BandPixels::Kept(pixels) if lined => &pixels[y * width..][..width],
            _ if lined => ground.row(0, y),
            _ => {
                if y == 0 || !canvas.background.is_uniform() {
                    canvas.background.row(top + y as i32, row);
                }
                &row[..]
            }
        };
        let to = target.row(y);
        copy_row(&behind[..left], to, 0);
        copy_row(&behind[right..], to, right);
        for s in 0..canvas.samples {
            plane.row_mut(s, y).copy_from_slice(&behind[left..right]);
        }
    }
    *resolve_ms += milliseconds(start);
    if left == right {
        return;
    }
    plane.clear_depth();
    for unit in units.iter().filter(|unit| !unit.bins.is_empty(band) && !job.is_overlay(unit)) {
        fill_unit(level, frame_data, unit, band, entries, plane);
    }
    if lined && !surfaces.is_empty() {
        line::segments(level, segments, LinePass::Under, LineTarget::Surfaces, band, plane);
    }
    // Blended triangles come one by one: neighbours in depth are rarely of one item.
    for run in sorted_bins.of(band) {
        for triangle in run.iter().filter_map(|&index| sorted.get(index as usize)) {
            let unit = &units[triangle.unit as usize];
            if let Some(item) = frame_data.draw_call_of(FrameData::triangle_number(unit, triangle.entry)) {
                fill(level, &DrawRun { frame_data, item, unit, entries: &[triangle.entry] }, plane);
            }
        }
    }
    line::segments(level, segments, LinePass::Over, LineTarget::All, band, plane);
    let bones = || units.iter().filter(|unit| !unit.bins.is_empty(band) && job.is_overlay(unit));
    if bones().next().is_some() || !segments.is_empty(LinePass::Overlay, band) {
        overlay.resize(top, rows, width, used, canvas.samples);
        overlay.clear_depth();
        overlay.clear_color(0);
        for unit in bones() {
            fill_unit(level, frame_data, unit, band, entries, overlay);
        }
        line::segments(level, segments, LinePass::Overlay, LineTarget::Overlay, band, overlay);
        lay_over(plane, overlay, xray);
    }
    let start = Instant::now();
    for y in 0..rows {
        copy_row(resolve(plane, y, row), target.row(y), left);
    }
    *resolve_ms += milliseconds(start);
}

fn milliseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}

/// Fills what a unit has for a band, item by item.
fn fill_unit(level: SimdLevel, frame_data: &FrameData<'_>, unit: &WorkUnit, band: usize, entries: &mut Vec<u32>, plane: &mut BandBuffer) {
    let mut item: Option<&DrawCall> = None;
    entries.clear();
    for &entry in unit.bins.of(band).flatten() {
        let number = FrameData::triangle_number(unit, entry);
        if !item.is_some_and(|item| item.triangles.contains(&number)) {
            if let Some(item) = item {
                fill(level, &DrawRun { frame_data, item, unit, entries }, plane);
            }
            entries.clear();
            item = frame_data.draw_call_of(number);
        }
        entries.push(entry);
    }
    if let Some(item) = item {
        fill(level, &DrawRun { frame_data, item, unit, entries }, plane);
    }
}
