//! Smooth lines with depth: a stroke covers a pixel by how far the pixel's centre is from it. A stroke without length is a dot.
//!
//! Strokes are blended and write no depth into the picture, so their order among each other shows only where they cross. In the overlay they do write
//! depth, because that decides whether a dot is in front of the surface.

use glam::Vec3;

use super::bin_lists::{BinLists, ColumnRange};
use super::binning::BandLayout;
use super::clip::clip_line;
use super::memory::push;
use super::projection::ViewTransform;
use super::setup::Rect;
use super::tile_buffer::BandBuffer;
use sinew_simd::{Simd, always, kernel, map};

/// When strokes are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LinePass {
    /// On the background, and over opaque surfaces before the transparent ones are drawn.
    Under,
    /// After all surfaces.
    Over,
    /// In the overlay.
    Overlay,
}

/// How a stroke looks.
#[derive(Debug, Clone, Copy)]
pub(super) struct LineStyle {
    /// 0 to 1.
    pub color: [f32; 3],
    /// Opacity at the two ends.
    pub alpha: [f32; 2],
    /// Pixels.
    pub width: f32,
    pub pass: LinePass,
    pub depth_test: bool,
    /// How far it is brought nearer, so that it wins against the surface it lies on: 1 is enough for that.
    pub depth_bias: f32,
}

/// What a stroke is drawn on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LineTarget {
    /// The bare background.
    BackgroundCache,
    /// Surfaces alone; the background between them has the strokes already.
    Surfaces,
    /// All that is there.
    All,
    /// A layer that is laid over the picture, whose depths count.
    Overlay,
}

#[derive(Debug, Clone, Copy)]
struct LineSegment {
    /// Pixel coordinates and nearness.
    from: [f32; 3],
    to: [f32; 3],
    /// 0 to 255.
    color: [f32; 3],
    alpha: [f32; 2],
    /// Half the width in pixels.
    half: f32,
    depth_test: bool,
}

/// The line segments of a picture, by pass and band.
#[derive(Debug, Default)]
pub(super) struct LineSegments {
    all: [Vec<LineSegment>; 3],
    bins: [BinLists; 3],
    incomplete: bool,
}

impl LineSegments {
    /// Whether there was no memory for some segments.
    pub(super) fn is_incomplete(&self) -> bool {
        self.incomplete || self.bins.iter().any(BinLists::is_incomplete)
    }

    /// Removes the segments of a pass.
    pub(super) fn reset(&mut self, pass: LinePass, bands: &BandLayout) {
        self.all[pass as usize].clear();
        self.bins[pass as usize].reset(bands.count);
    }

    /// Whether nothing is drawn in `band` in this pass.
    pub(super) fn is_empty(&self, pass: LinePass, band: usize) -> bool {
        self.bins[pass as usize].is_empty(band)
    }

    /// The columns that are drawn on in `band` in this pass.
    pub(super) fn columns(&self, pass: LinePass, band: usize) -> ColumnRange {
        self.bins[pass as usize].columns(band)
    }

    /// Adds the line from `a` to `b` in the world.
    pub(super) fn line(&mut self, view: &ViewTransform, bands: &BandLayout, a: Vec3, b: Vec3, line_style: &LineStyle) {
        let (part, ends) = if a == b {
            let clip = view.clip(a);
            if !clip.iter().all(|x| x.is_finite()) || clip[3] < f64::from(view.near) {
                return;
            }
            ([0.0, 1.0], [clip, clip])
        } else if let Some(found) = clip_line(view, a, b) {
            found
        } else {
            return;
        };
        let factor = view.depth_bias(line_style.depth_bias);
        let [from, to] = ends.map(|end| {
            let [x, y, q] = view.project(end);
            [x as f32, y as f32, q as f32 * factor[0] + factor[1]]
        });
        let alpha = part.map(|t| line_style.alpha[0] + (line_style.alpha[1] - line_style.alpha[0]) * t as f32);
        // A line thinner than a pixel is drawn a pixel wide and fainter.
        let width = line_style.width.max(1.0);
        let thin = (line_style.width / width).clamp(0.0, 1.0);
        let segment = LineSegment {
            from,
            to,
            color: line_style.color.map(|c| c * 255.0),
            alpha: alpha.map(|a| (a * thin).clamp(0.0, 1.0)),
            half: width * 0.5,
            depth_test: line_style.depth_test,
        };
        let reach = segment.half + 1.0;
        let [w, h] = view.size.map(|side| side as i32);
        let low = |i: usize| (from[i].min(to[i]) - reach).max(-1.0) as i32;
        let high = |i: usize, side: i32| ((from[i].max(to[i]) + reach).clamp(-1.0, side as f32) as i32).min(side - 1);
        let rect = Rect { x0: low(0).max(0), y0: low(1).max(0), x1: high(0, w), y1: high(1, h) };
        let visible = from.iter().chain(&to).all(|x| x.is_finite()) && from[0].max(to[0]) + reach > 0.0 && from[1].max(to[1]) + reach > 0.0;
        if visible && !rect.is_empty() && (segment.alpha[0] > 0.0 || segment.alpha[1] > 0.0) {
            let all = &mut self.all[line_style.pass as usize];
            bands.push_to_bands(&mut self.bins[line_style.pass as usize], &rect, all.len() as u32);
            self.incomplete |= push(all, segment).is_err();
        }
    }
}

kernel! {
    /// Draws the line segments of a pass into the rows of a band, within the columns that the buffer uses.
    pub(super) fn segments(all: &LineSegments, pass: LinePass, target: LineTarget, band: usize, plane: &mut BandBuffer) = rasterize_segments
}

#[inline(always)]
fn rasterize_segments<L: Simd>(l: L, all: &LineSegments, pass: LinePass, target: LineTarget, band: usize, plane: &mut BandBuffer) {
    for run in all.bins[pass as usize].of(band) {
        for &index in run {
            if let Some(segment) = all.all[pass as usize].get(index as usize) {
                rasterize_segment(l, segment, plane, target);
            }
        }
    }
}

#[inline(always)]
fn rasterize_segment<L: Simd>(l: L, segment: &LineSegment, plane: &mut BandBuffer, target: LineTarget) {
    let [ax, ay, aq] = segment.from;
    let (dx, dy) = (segment.to[0] - ax, segment.to[1] - ay);
    let squared = dx * dx + dy * dy;
    let inverse = if squared > 1e-12 { 1.0 / squared } else { 0.0 };
    let reach = segment.half + 0.5;
    let (low, high) = (ay.min(ay + dy) - reach, ay.max(ay + dy) + reach);
    let last = plane.top + plane.rows as i32 - 1;
    let top = (low.max(-1.0) as i32).max(plane.top);
    let bottom = (high.min(2e6) as i32).min(last);
    let (zero, one) = (l.splat(0.0), l.splat(1.0));
    let color = map(segment.color, always!(|c: f32| l.splat(c)));
    let [first, end] = plane.used.map(|x| x as i32);
    let depth_test = segment.depth_test && target != LineTarget::BackgroundCache;
    for y in top..=bottom {
        assert!(plane.contains(plane.index(y, 0), plane.width), "a row reaches beyond its band");
        let cy = y as f32 + 0.5 - ay;
        // Where along the stroke it is within reach of this row; a little too much does no harm, since coverage is worked out exactly.
        let (mut from, mut to) = (0.0f32, 1.0f32);
        if dy.abs() > 1e-3 {
            let (t0, t1) = ((cy - reach) / dy, (cy + reach) / dy);
            // On a long line that is nearly level the rounding of `cy` is many pixels.
            let slack = 4.0 * f32::EPSILON * (ay.abs() + y as f32 + reach) / dy.abs();
            from = (t0.min(t1) - slack).clamp(0.0, 1.0);
            to = (t0.max(t1) + slack).clamp(0.0, 1.0);
        }
        let (x0, x1) = (ax + dx * from, ax + dx * to);
        let left = ((x0.min(x1) - reach - 1.0).max(0.0) as i32).max(first);
        let right = ((x0.max(x1) + reach + 1.0).clamp(-1.0, 2e6) as i32).min(end - 1);
        let py = l.splat(cy);
        let mut x = left;
        while x <= right {
            let px = l.float(l.iota() + l.isplat(x)) + l.splat(0.5 - ax);
            let t = l.clamp((px * l.splat(dx) + py * l.splat(dy)) * l.splat(inverse), 0.0, 1.0);
            let (ex, ey) = (px - l.splat(dx) * t, py - l.splat(dy) * t);
            let distance = l.sqrt(ex * ex + ey * ey);
            let cover = l.clamp(l.splat(segment.half + 0.5) - distance, 0.0, 1.0);
            let alpha = cover * (l.splat(segment.alpha[0]) + l.splat(segment.alpha[1] - segment.alpha[0]) * t);
            // No column past the last, however many lanes there are.
            let visible = l.lt(zero, alpha) & l.ilt(l.iota() + l.isplat(x), l.isplat(right + 1));
            let at = plane.index(y, x);
            x += L::N as i32;
            if !l.any(visible) {
                continue;
            }
            let q = l.splat(aq) + l.splat(segment.to[2] - aq) * t;
            let full = l.min(alpha, one) * l.splat(255.0);
            for s in 0..plane.samples {
                let mut shown = visible;
                // SAFETY: `x` was from 0 to the last column, and the plane holds that row.
                unsafe {
                    if depth_test {
                        shown = shown & l.lt(plane.depth(l, s, at), q);
                    }
                    if target == LineTarget::Surfaces {
                        shown = shown & l.lt(l.splat(f32::NEG_INFINITY), plane.depth(l, s, at));
                    }
                    if target == LineTarget::Overlay {
                        plane.set_depth(l, s, at, shown, q);
                    }
                    plane.blend(l, s, at, shown, [color[0], color[1], color[2], full]);
                }
            }
        }
    }
}
