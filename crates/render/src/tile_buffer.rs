//! The rows of a band while they are drawn: colour and depth for each sample.
//!
//! Only the columns in use are cleared, filled and handed on. What stands in the others is left over from earlier bands: vectors that reach there
//! read it and write it back, but no lane of theirs is ever covered.

use super::RenderError;
use super::bin_lists::ColumnRange;
use super::memory::zeroed;
use sinew_simd::{Simd, always, map};

/// Columns beyond the right edge that a vector may touch.
const MARGIN: usize = 16;
/// Rows beyond the last that a tile may touch.
const TRAILING_ROWS: usize = 3;

/// Colour and depth of some rows. Sample planes stand one after the other.
#[derive(Debug, Default)]
pub(super) struct BandBuffer {
    /// First row.
    pub top: i32,
    /// Number of rows.
    pub rows: usize,
    /// Columns of the picture.
    pub width: usize,
    /// Which of them are in use: first, and one past the last.
    pub used: [usize; 2],
    /// 1 or 4.
    pub samples: usize,
    /// From row to row.
    pub pitch: usize,
    /// From sample to sample.
    area: usize,
    color: Vec<u32>,
    depth: Vec<f32>,
}

impl BandBuffer {
    /// Takes this shape, for which [`BandBuffer::reserve`] made room; what is in it stays as it was until [`BandBuffer::clear_depth`] and the rows are written.
    pub(super) fn resize(&mut self, top: i32, rows: usize, width: usize, used: ColumnRange, samples: usize) {
        (self.top, self.rows, self.width, self.samples) = (top, rows, width, samples);
        let end = (used.last + 1).clamp(0, width as i32) as usize;
        self.used = [(used.first.max(0) as usize).min(end), end];
        self.pitch = width + MARGIN;
        self.area = self.pitch * (rows + TRAILING_ROWS) + MARGIN;
    }

    /// Makes room for a shape.
    pub(super) fn reserve(&mut self, rows: usize, width: usize, samples: usize) -> Result<(), RenderError> {
        let needed = ((width + MARGIN) * (rows + TRAILING_ROWS) + MARGIN) * samples;
        if self.color.len() < needed {
            // Fresh zeros, not a longer copy: the system hands them out only as they are touched.
            self.color = zeroed(needed)?;
            self.depth = zeroed(needed)?;
        }
        Ok(())
    }

    /// The columns in use of row `row` (from the band's first) of sample `s`.
    #[inline(always)]
    fn run(&self, s: usize, row: usize) -> std::ops::Range<usize> {
        let at = s * self.area + row * self.pitch;
        at + self.used[0]..at + self.used[1]
    }

    /// Infinitely far everywhere.
    pub(super) fn clear_depth(&mut self) {
        for s in 0..self.samples {
            for row in 0..self.rows {
                let run = self.run(s, row);
                self.depth[run].fill(f32::NEG_INFINITY);
            }
        }
    }

    /// One colour everywhere.
    pub(super) fn clear_color(&mut self, color: u32) {
        for s in 0..self.samples {
            for row in 0..self.rows {
                self.row_mut(s, row).fill(color);
            }
        }
    }

    /// Row `row` (from the band's first) of sample `s`, colours of the columns in use.
    pub(super) fn row(&self, s: usize, row: usize) -> &[u32] {
        &self.color[self.run(s, row)]
    }

    /// The same, to write.
    pub(super) fn row_mut(&mut self, s: usize, row: usize) -> &mut [u32] {
        let run = self.run(s, row);
        &mut self.color[run]
    }

    /// The same, depths.
    pub(super) fn depth_row(&self, s: usize, row: usize) -> &[f32] {
        &self.depth[self.run(s, row)]
    }

    /// Colours to write and depths to read of one row.
    pub(super) fn row_and_depth(&mut self, s: usize, row: usize) -> (&mut [u32], &[f32]) {
        let run = self.run(s, row);
        (&mut self.color[run.clone()], &self.depth[run])
    }

    /// Where pixel `x` of picture row `y` stands in a sample plane.
    #[inline(always)]
    pub(super) fn index(&self, y: i32, x: i32) -> usize {
        (y - self.top) as usize * self.pitch + x as usize
    }

    /// Whether a vector that starts at any of `count` pixels from index `at` on stays inside all sample planes: asked once a row, so that the loops
    /// need not ask for every vector.
    #[inline(always)]
    pub(super) fn contains(&self, at: usize, count: usize) -> bool {
        let end = at + count + MARGIN + TRAILING_ROWS * self.pitch;
        end <= self.area && self.area * self.samples <= self.color.len().min(self.depth.len())
    }

    /// # Safety
    /// [`BandBuffer::contains`] said yes to a stretch that `at` is in, and `s` is below the number of samples.
    #[inline(always)]
    pub(super) unsafe fn depth<L: Simd>(&self, l: L, s: usize, at: usize) -> L::F {
        let from = s * self.area + at;
        // SAFETY: the caller's promise: `N` ≤ `MARGIN` elements from here on are inside.
        l.load(unsafe { self.depth.get_unchecked(from..from + L::N) })
    }

    /// # Safety
    /// As for [`BandBuffer::depth`].
    #[inline(always)]
    pub(super) unsafe fn set_depth<L: Simd>(&mut self, l: L, s: usize, at: usize, mask: L::M, depth: L::F) {
        let from = s * self.area + at;
        // SAFETY: as above.
        let slot = unsafe { self.depth.get_unchecked_mut(from..from + L::N) };
        let old = l.load(slot);
        // As integers: the compiler turns a select of floats into a masked store, which the next triangle's load would have to wait for.
        l.store(l.float_bits(l.iselect(mask, l.bits(depth), l.bits(old))), slot);
    }

    /// # Safety
    /// As for [`BandBuffer::depth`].
    #[inline(always)]
    pub(super) unsafe fn set_color<L: Simd>(&mut self, l: L, s: usize, at: usize, mask: L::M, color: L::I) {
        let from = s * self.area + at;
        // SAFETY: as above.
        let slot = unsafe { self.color.get_unchecked_mut(from..from + L::N) };
        let old = l.iload(slot);
        l.istore(l.iselect(mask, color, old), slot);
    }

    /// Depths of a vector, or with `TILED` of a tile, from index `at` on.
    ///
    /// # Safety
    /// As for [`BandBuffer::depth`].
    #[inline(always)]
    pub(super) unsafe fn depth_at<L: Simd, const TILED: bool>(&self, l: L, s: usize, at: usize) -> L::F {
        if TILED {
            // SAFETY: `contains` counted the rows and columns that a tile reaches beyond.
            l.float_bits(unsafe { l.tile(self.depth.as_ptr().add(s * self.area + at).cast(), self.pitch) })
        } else {
            // SAFETY: the caller's promise.
            unsafe { self.depth(l, s, at) }
        }
    }

    /// Writes colour and depth where `mask` says so, into a vector or a tile.
    ///
    /// # Safety
    /// As for [`BandBuffer::depth`].
    #[inline(always)]
    pub(super) unsafe fn write<L: Simd, const TILED: bool>(&mut self, l: L, s: usize, at: usize, mask: L::M, color: L::I, depth: L::F) {
        // SAFETY: the caller's promise, and for tiles as in `depth_at`.
        unsafe {
            if TILED {
                let depths: *mut u32 = self.depth.as_mut_ptr().add(s * self.area + at).cast();
                l.set_tile(l.iselect(mask, l.bits(depth), l.tile(depths, self.pitch)), depths, self.pitch);
                let colors = self.color.as_mut_ptr().add(s * self.area + at);
                l.set_tile(l.iselect(mask, color, l.tile(colors, self.pitch)), colors, self.pitch);
            } else {
                self.set_depth(l, s, at, mask, depth);
                self.set_color(l, s, at, mask, color);
            }
        }
    }

    /// Lays a colour with opacity (0 to 255 each, not premultiplied) over what is there.
    ///
    /// # Safety
    /// As for [`BandBuffer::depth`].
    #[inline(always)]
    pub(super) unsafe fn blend<L: Simd>(&mut self, l: L, s: usize, at: usize, mask: L::M, color: [L::F; 4]) {
        let from = s * self.area + at;
        // SAFETY: as above.
        let slot = unsafe { self.color.get_unchecked_mut(from..from + L::N) };
        let old = l.iload(slot);
        let color = map(color, always!(|c: L::F| l.clamp(c, 0.0, 255.0)));
        let share = color[3] * l.splat(1.0 / 255.0);
        let keep = l.splat(1.0) - share;
        let byte = l.isplat(255);
        let channel = always!(|value: L::F, old: L::I| l.trunc(value * share + l.float(old & byte) * keep + l.splat(0.5)));
        let red = channel(color[0], l.shr::<16>(old));
        let green = channel(color[1], l.shr::<8>(old));
        let blue = channel(color[2], old);
        let alpha = channel(l.splat(255.0), l.shr::<24>(old));
        let new = l.shl::<24>(alpha) | l.shl::<16>(red) | l.shl::<8>(green) | blue;
        l.istore(l.iselect(mask, new, old), slot);
    }
}

/// Opaque pixels from red, green and blue. `in_range` promises that no channel is further than a quarter beyond 0 to 255, so none has to be held back.
#[inline(always)]
pub(super) fn pack<L: Simd>(l: L, color: [L::F; 4], in_range: bool) -> L::I {
    let half = l.splat(0.5);
    let [r, g, b, _] = if in_range { color } else { map(color, always!(|c: L::F| l.clamp(c, 0.0, 255.0))) };
    let alpha = l.isplat(0xFF00_0000u32 as i32);
    (alpha | l.trunc(b + half)) | (l.shl::<16>(l.trunc(r + half)) | l.shl::<8>(l.trunc(g + half)))
}
