//! The triangles of a picture by band: opaque ones in the order in which they were given, blended ones the farthest first.

use std::sync::Mutex;

use super::RenderError;
use super::bin_lists::BinLists;
use super::binning::{BandLayout, bin};
use super::draw_data::{DrawCall, FrameData, WorkUnit};
use super::material_state::RenderPass;
use super::pool::{Pool, take};

/// Triangles in a unit of binning, at least.
const UNIT: u32 = 2048;
/// Most units a layer, so that the lists of a picture stay few.
const UNITS: u32 = 64;

/// A blended triangle in drawing order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sorted {
    nearness: f32,
    pub unit: u32,
    pub entry: u32,
}

/// The lists of all bands.
#[derive(Debug, Default)]
pub(super) struct TriangleBins {
    units: Vec<WorkUnit>,
    /// How many of the units this picture has; the others are kept for pictures with more.
    count: usize,
    pub sorted: Vec<Sorted>,
    pub sorted_bins: BinLists,
}

impl TriangleBins {
    /// Culls, clips and bins all triangles.
    pub(super) fn fill(&mut self, pool: &Pool, frame_data: &FrameData<'_>, bands: &BandLayout) -> Result<(), RenderError> {
        self.count = divide(frame_data.draw_calls, &mut self.units);
        let jobs = Mutex::new(self.units[..self.count].iter_mut());
        pool.run(&|_| {
            while let Some(unit) = take(&jobs) {
                bin(frame_data, bands, unit);
            }
        });
        let units = &self.units[..self.count];
        if units.iter().any(|unit| unit.incomplete) {
            return Err(RenderError::OutOfMemory);
        }
        sort_blended(frame_data, bands, units, &mut self.sorted, &mut self.sorted_bins)
    }

    /// The units of this picture.
    pub(super) fn units(&self) -> &[WorkUnit] {
        &self.units[..self.count]
    }
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
fn sort_blended(
    frame_data: &FrameData<'_>,
    bands: &BandLayout,
    units: &[WorkUnit],
    sorted: &mut Vec<Sorted>,
    bins: &mut BinLists,
) -> Result<(), RenderError> {
    sorted.clear();
    sorted.try_reserve(units.iter().map(|unit| unit.blended.len()).sum())?;
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
    if bins.is_incomplete() { Err(RenderError::OutOfMemory) } else { Ok(()) }
}
