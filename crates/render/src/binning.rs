//! Binning: culls back faces, clips where needed, and lists the triangles of each band.

use super::bin_lists::{BinLists, ColumnRange};
use super::clip::clip;
use super::draw_data::{CLIPPED_FLAG, DrawCall, FrameData, WorkUnit};
use super::memory::push;
use super::projection::{BAD, ScreenVertex};
use super::setup::{Rect, area};

/// The division of the picture into bands.
#[derive(Debug, Clone, Copy)]
pub(super) struct BandLayout {
    /// Rows of a band.
    pub rows: usize,
    pub count: usize,
    /// Whether there are four samples a pixel.
    pub multi: bool,
}

impl BandLayout {
    /// Puts `value` into every band that the rectangle touches.
    #[inline(always)]
    pub(super) fn push_to_bands(&self, bins: &mut BinLists, rect: &Rect, value: u32) {
        let (from, to) = (rect.y0 as usize / self.rows, (rect.y1 as usize / self.rows).min(self.count - 1));
        for band in from..=to {
            bins.push(band, ColumnRange { first: rect.x0, last: rect.x1 }, value);
        }
    }
}

/// Goes through the triangles of `unit` and fills its bins (or, for blended ones, its list).
pub(super) fn bin(frame_data: &FrameData<'_>, bands: &BandLayout, unit: &mut WorkUnit) {
    unit.bins.reset(bands.count);
    unit.clipped.clear();
    unit.blended.clear();
    unit.incomplete = false;
    let mut number = unit.range.start;
    while number < unit.range.end {
        let Some(item) = frame_data.draw_call_of(number) else { break };
        let end = item.triangles.end.min(unit.range.end);
        bin_draw_call(frame_data, bands, unit, item, number..end);
        number = end;
    }
    unit.incomplete |= unit.bins.is_incomplete();
}

fn bin_draw_call(frame_data: &FrameData<'_>, bands: &BandLayout, unit: &mut WorkUnit, item: &DrawCall, numbers: std::ops::Range<u32>) {
    let reader = frame_data.reader(item);
    let size = frame_data.view.size;
    let keep = |t: usize, screen: &[ScreenVertex; 3]| -> Option<Rect> {
        if item.culls(t, area(screen)) {
            return None;
        }
        let rect = Rect::of(screen, bands.multi, size);
        (!rect.is_empty()).then_some(rect)
    };
    for number in numbers {
        let t = (number - item.triangles.start) as usize;
        let Some(screen) = reader.screen_vertices(t) else { continue };
        let [a, b, c] = [screen[0].code, screen[1].code, screen[2].code];
        if a | b | c == 0 {
            if let Some(rect) = keep(t, &screen) {
                push_triangle(unit, bands, item, &rect, &screen, number);
            }
            continue;
        }
        // All corners beyond the same plane, or one that is not a number.
        if a & b & c != 0 || (a | b | c) & BAD != 0 {
            continue;
        }
        let corners = reader.geometry.triangles[t].map(|v| reader.geometry.world(v as usize));
        clip(&frame_data.view, corners, &screen, number, |piece| {
            if let Some(rect) = keep(t, &piece.screen) {
                let entry = CLIPPED_FLAG | unit.clipped.len() as u32;
                if push(&mut unit.clipped, piece).is_err() {
                    unit.incomplete = true;
                    return;
                }
                push_triangle(unit, bands, item, &rect, &piece.screen, entry);
            }
        });
    }
}

#[inline(always)]
fn push_triangle(unit: &mut WorkUnit, bands: &BandLayout, item: &DrawCall, rect: &Rect, screen: &[ScreenVertex; 3], entry: u32) {
    if item.is_blended() {
        unit.incomplete |= push(&mut unit.blended, (screen[0].q + screen[1].q + screen[2].q, entry)).is_err();
    } else {
        bands.push_to_bands(&mut unit.bins, rect, entry);
    }
}
