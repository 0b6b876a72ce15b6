//! From three corners on the picture plane to edge functions and attribute planes.
//!
//! An edge function is a·x + b·y + c in sub-pixels: 16 bits of fraction. Pixel centres stand 256 sub-pixels apart, so the low 8 bits of its
//! value are the same at all of them and can be dropped without changing any sign: what is left is stepped in 32 bits and is still exact.
//! With the guard band |a| and |b| are below 2²³, and the fill walks wide triangles in blocks of [`BLOCK`] pixels; an edge that crosses
//! a block of at most `BLOCK + 16` by `ROWS` pixels stays below 2³¹ in it, and one that does not cross is left out.
//!
//! Attributes are planes through the snapped corners, so no pixel centre inside can get a value beyond its corners' range. They are set up
//! in `f64` from the first pixel of the box that lies in the picture, which is the same whatever the bands are; a row starts from `f64` and steps in `f32`.

// Several arrays are walked with one index.
#![allow(clippy::needless_range_loop, reason = "the index counts lanes of several arrays at once")]

use super::projection::{SUB, ScreenVertex};

/// Width of the blocks that wide triangles are walked in.
pub(super) const BLOCK: i32 = 256;
/// Most rows of a band.
pub(super) const ROWS: usize = 64;
/// A box up to this size needs no blocks.
const SMALL: i32 = 64;

/// Where the four samples of a pixel are, in sub-pixels from its centre: a rotated grid.
pub(super) const SAMPLES: [[i64; 2]; 4] = [[-32, -96], [96, -32], [-96, 32], [32, 96]];
/// How far samples reach from the centre.
const REACH: i32 = 96;

/// Twice the signed area in square sub-pixels, y downward: positive is clockwise as seen.
#[inline(always)]
pub(super) fn area(s: &[ScreenVertex; 3]) -> i64 {
    let [x0, y0] = [i64::from(s[0].x), i64::from(s[0].y)];
    (i64::from(s[1].x) - x0) * (i64::from(s[2].y) - y0) - (i64::from(s[2].x) - x0) * (i64::from(s[1].y) - y0)
}

/// A rectangle of pixels, ends included; empty where `x1 < x0` or `y1 < y0`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rect {
    pub x0: i32,
    pub y0: i32,
    pub x1: i32,
    pub y1: i32,
}

impl Rect {
    /// The pixels whose centres (with `multi`: whose samples) may be inside the triangle, within a picture of this size.
    #[inline(always)]
    pub(super) fn of(s: &[ScreenVertex; 3], multi: bool, size: [u32; 2]) -> Self {
        let reach = if multi { REACH } else { 0 };
        let low = |a: i32, b: i32, c: i32| (a.min(b).min(c) - reach + 127) >> 8;
        let high = |a: i32, b: i32, c: i32| (a.max(b).max(c) + reach - 128) >> 8;
        Self {
            x0: low(s[0].x, s[1].x, s[2].x).max(0),
            y0: low(s[0].y, s[1].y, s[2].y).max(0),
            x1: high(s[0].x, s[1].x, s[2].x).min(size[0] as i32 - 1),
            y1: high(s[0].y, s[1].y, s[2].y).min(size[1] as i32 - 1),
        }
    }

    #[inline(always)]
    pub(super) fn is_empty(&self) -> bool {
        self.x1 < self.x0 || self.y1 < self.y0
    }
}

/// The three edges of a triangle whose area is positive.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edges {
    /// Change a pixel to the right (with the low 8 bits dropped).
    pub a: [i32; 3],
    /// Change a pixel downward.
    pub b: [i32; 3],
    /// Value at the centre of the pixel (`x0`, `y0`) of the box, in full, with the fill rule's bias: inside is ≥ 0.
    pub origin: [i64; 3],
}

impl Edges {
    /// Edges of the corners `s` (clockwise as seen), their origin at pixel (`x0`, `y0`).
    #[inline(always)]
    pub(super) fn new(s: &[ScreenVertex; 3], x0: i32, y0: i32) -> Self {
        let (cx, cy) = (i64::from(x0) * SUB + SUB / 2, i64::from(y0) * SUB + SUB / 2);
        let mut edges = Self { a: [0; 3], b: [0; 3], origin: [0; 3] };
        for i in 0..3 {
            let (p, q) = (&s[i], &s[(i + 1) % 3]);
            let (a, b) = (p.y - q.y, q.x - p.x);
            // Top-left rule: a centre on a left or top edge belongs to the triangle, on a right or bottom edge to its neighbour.
            let bias = i64::from(!(a > 0 || (a == 0 && b > 0)));
            edges.a[i] = a;
            edges.b[i] = b;
            edges.origin[i] = i64::from(a) * (cx - i64::from(p.x)) + i64::from(b) * (cy - i64::from(p.y)) - bias;
        }
        edges
    }

    /// Whether the sample at this offset in sub-pixels from the centre of pixel (`dx`, `dy`), counted from the origin, is inside.
    pub(super) fn covers(&self, dx: i64, dy: i64, offset: [i64; 2]) -> bool {
        (0..3).all(|i| self.at(i, dx, dy, offset) >= 0)
    }

    #[inline(always)]
    fn at(&self, i: usize, dx: i64, dy: i64, offset: [i64; 2]) -> i64 {
        self.origin[i] + i64::from(self.a[i]) * (dx * SUB + offset[0]) + i64::from(self.b[i]) * (dy * SUB + offset[1])
    }

    /// Starting values for a block at (`dx`, `dy`) from the origin, `w` × `h` pixels: for each sample and edge the value with the low
    /// bits dropped, and the steps. `None` where nothing in the block can be inside.
    #[inline(always)]
    pub(super) fn block<const S: usize>(&self, dx: i32, dy: i32, w: i32, h: i32) -> Option<EdgeStepper<S>> {
        let (dx, dy) = (i64::from(dx), i64::from(dy));
        let mut stepper = EdgeStepper { start: [[0; 3]; S], a: self.a, b: self.b };
        // Lanes may reach 15 pixels past the end.
        let (last_x, last_y) = (i64::from(w + 15), i64::from(h - 1));
        let small = w <= SMALL && h <= SMALL && self.a.iter().chain(&self.b).all(|step| step.abs() <= SMALL * SUB as i32 * 4);
        for i in 0..3 {
            let offset = |s: usize| if S == 1 { [0, 0] } else { SAMPLES[s] };
            if !small {
                let (ax, by) = (i64::from(self.a[i]) * last_x * SUB, i64::from(self.b[i]) * last_y * SUB);
                let (mut lowest, mut highest) = (i64::MAX, i64::MIN);
                for s in 0..S {
                    let here = self.at(i, dx, dy, offset(s));
                    lowest = lowest.min(here);
                    highest = highest.max(here);
                }
                if highest + ax.max(0) + by.max(0) < 0 {
                    return None;
                }
                if lowest + ax.min(0) + by.min(0) >= 0 {
                    (stepper.a[i], stepper.b[i]) = (0, 0);
                    continue;
                }
            }
            for s in 0..S {
                stepper.start[s][i] = (self.at(i, dx, dy, offset(s)) >> 8) as i32;
            }
        }
        Some(stepper)
    }
}

/// Edge values that fit in 32 bits, for one block.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeStepper<const S: usize> {
    pub start: [[i32; 3]; S],
    pub a: [i32; 3],
    pub b: [i32; 3],
}

/// What faces away is moved back by this share of what its nearness changes from pixel to pixel, and by [`ROUNDING`] of the nearness itself.
///
/// Of two faces that lie on each other the one that faces the viewer is to win. They need not have the same depth to the bit: along another diagonal, planes
/// go through other corners, and each corner was moved by up to half a sub-pixel when it was snapped. Between the corners two planes so differ by no
/// more than the change over a sub-pixel, a 256th of a pixel, to the right and one downward. A quarter more is for rounding. On the picture this is as
/// if what faces away were moved aside by as little, which cannot be seen, and it never comes to the front by it.
pub(super) const SNAPPED: f32 = 1.25 / 256.0;
/// See [`SNAPPED`]: four times what a float rounds by.
pub(super) const ROUNDING: f32 = 1.0 / (1 << 21) as f32;

/// Attributes as planes over the picture; attribute 0 is the nearness.
#[derive(Debug, Clone, Copy)]
pub(super) struct AttributePlanes<const K: usize> {
    base: [f64; K],
    down: [f64; K],
    /// Change a pixel to the right.
    pub right: [f32; K],
    /// Change a pixel downward.
    pub below: [f32; K],
}

impl<const K: usize> AttributePlanes<K> {
    /// Planes through the corners, from the centre of pixel (`x0`, `y0`); `area` is that of the corners and not 0.
    #[inline(always)]
    pub(super) fn new(s: &[ScreenVertex; 3], area: i64, values: &[[f32; K]; 3], x0: i32, y0: i32) -> Self {
        let scale = 256.0 / area as f64;
        let (x10, y10) = (f64::from(s[1].x - s[0].x) * scale, f64::from(s[1].y - s[0].y) * scale);
        let (x20, y20) = (f64::from(s[2].x - s[0].x) * scale, f64::from(s[2].y - s[0].y) * scale);
        let to_x = (f64::from(x0) + 0.5) - f64::from(s[0].x) / 256.0;
        let to_y = (f64::from(y0) + 0.5) - f64::from(s[0].y) / 256.0;
        let mut planes = Self { base: [0.0; K], down: [0.0; K], right: [0.0; K], below: [0.0; K] };
        for k in 0..K {
            let f0 = f64::from(values[0][k]);
            let (d1, d2) = (f64::from(values[1][k]) - f0, f64::from(values[2][k]) - f0);
            let right = d1 * y20 - d2 * y10;
            let down = d2 * x10 - d1 * x20;
            planes.base[k] = f0 + right * to_x + down * to_y;
            planes.down[k] = down;
            planes.right[k] = right as f32;
            planes.below[k] = down as f32;
        }
        planes
    }

    /// Whether stepping over `width` pixels in `f32` keeps every attribute but the nearness within a quarter of what it should be.
    #[inline(always)]
    pub(super) fn is_well_conditioned(&self, width: i32) -> bool {
        let mut steepest = 0.0f32;
        for slope in &self.right[1..] {
            steepest = steepest.max(slope.abs());
        }
        // Half a unit in the last place of the product and of the sum, and the slope's own rounding.
        steepest * (width + 16) as f32 * f32::EPSILON < 0.05
    }

    /// How far a triangle that faces away is moved back, for the nearness of its corners: see [`SNAPPED`].
    #[inline(always)]
    pub(super) fn retreat(&self, corners: [f32; 3]) -> f32 {
        let [a, b, c] = corners;
        let (near, far) = (a.max(b).max(c), a.min(b).min(c));
        ((self.right[0].abs() + self.below[0].abs()) * SNAPPED).min(near - far) + near.abs() * ROUNDING
    }

    /// Values in the first column, `row` rows below the first.
    #[inline(always)]
    pub(super) fn row(&self, row: i32) -> [f32; K] {
        let row = f64::from(row);
        let mut values = [0.0; K];
        for (k, value) in values.iter_mut().enumerate() {
            *value = (self.base[k] + self.down[k] * row) as f32;
        }
        values
    }
}
