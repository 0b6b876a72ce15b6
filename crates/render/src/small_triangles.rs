//! Small triangles, the common case: set up sixteen at a time in vectors, then rasterized one by one.
//!
//! A triangle whose box is at most [`MAX_SIDE`] pixels wide and high has edge functions that fit in 32 bits with all their fraction, and planes that `f32`
//! carries well as long as it is not a sliver. Set up one at a time in `i64` and `f64`, as large ones are, a triangle of a few pixels costs ten times as
//! much as its pixels do. Whether a triangle is small depends on its corners alone, so the picture stays the same for all vector widths and bands.

// Several arrays are walked with one index.
#![allow(clippy::needless_range_loop, reason = "the index counts lanes of several arrays at once")]

use super::draw_data::FrameData;
use super::projection::ScreenVertex;
use super::raster::{STRAIGHT, needs_perspective};
use super::setup::{ROUNDING, Rect, SAMPLES, SNAPPED};
use super::shade::{Gradients, Shader, ShaderAttributes, TriangleAttributes};
use super::tile_buffer::{BandBuffer, pack};
use sinew_simd::{Simd, always, each, map};

/// Triangles that are set up together.
const BATCH: usize = 16;
/// Most columns and rows of a small triangle.
const MAX_SIDE: i32 = 64;
/// A box may have so many times the triangle's doubled area; beyond, differences of products lose what `f32` has.
const SLIVER: i32 = 32;
/// Where the nearness of the corners is no further than this share from the middle between them, two of Newton's steps from there give one over the nearness
/// to the precision of `f32`: each squares the error. A division takes four times as long.
const MIN_INV_W_RATIO: f32 = 1.0 / 64.0;

type Ints = [i32; BATCH];
type Floats = [f32; BATCH];

/// Triangles that wait to be filled. `K` attributes, of which the first is the nearness.
pub(super) struct TriangleBatch<const K: usize> {
    count: usize,
    x: [Ints; 3],
    y: [Ints; 3],
    values: [[Floats; 3]; K],
    left: Ints,
    top: Ints,
    right: Ints,
    bottom: Ints,
    /// 1 for yes.
    perspective: Ints,
    /// 1 for what faces away.
    back_facing: Ints,
    /// How far that is moved back.
    retreat: Floats,
    /// Change of each edge function a pixel to the right and a pixel downward, and its value at the centre of the box's first pixel, with the fill rule's bias.
    across: [Ints; 3],
    down: [Ints; 3],
    start: [Ints; 3],
    /// The same of the attributes.
    slope: [Floats; K],
    fall: [Floats; K],
    base: [Floats; K],
    /// See [`Gradients::levels`].
    levels: [Ints; 3],
    /// About one over the nearness, where that hardly changes; see [`MIN_INV_W_RATIO`]. Else 0.
    guess: Floats,
}

impl<const K: usize> TriangleBatch<K> {
    #[inline(always)]
    pub(super) fn new() -> Self {
        let (ints, floats) = ([0; BATCH], [0.0; BATCH]);
        Self {
            count: 0,
            x: [ints; 3],
            y: [ints; 3],
            values: [[floats; 3]; K],
            left: ints,
            top: ints,
            right: ints,
            bottom: ints,
            perspective: ints,
            back_facing: ints,
            retreat: floats,
            across: [ints; 3],
            down: [ints; 3],
            start: [ints; 3],
            slope: [floats; K],
            fall: [floats; K],
            base: [floats; K],
            levels: [ints; 3],
            guess: floats,
        }
    }

    /// Whether there is no room for another.
    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.count == BATCH
    }

    /// Whether a triangle with these corners, clockwise as seen, and this doubled area is small.
    #[inline(always)]
    pub(super) fn fits(screen: &[ScreenVertex; 3], area: i64) -> bool {
        let side = |a: i32, b: i32, c: i32| a.max(b).max(c) - a.min(b).min(c);
        let (w, h) = (side(screen[0].x, screen[1].x, screen[2].x), side(screen[0].y, screen[1].y, screen[2].y));
        // Corners are inside the guard band, so the differences fit.
        w < (MAX_SIDE - 1) * 256 && h < (MAX_SIDE - 1) * 256 && i64::from(w * h) <= area * i64::from(SLIVER)
    }

    /// Adds a triangle that fits, with the first `used` of its attributes. Corners clockwise as seen.
    #[inline(always)]
    pub(super) fn push(&mut self, used: usize, screen: &[ScreenVertex; 3], values: &[[f32; K]; 3], rect: &Rect, away: bool) {
        let i = self.count;
        if i >= BATCH {
            return;
        }
        for corner in 0..3 {
            self.x[corner][i] = screen[corner].x;
            self.y[corner][i] = screen[corner].y;
            for k in 0..used {
                self.values[k][corner][i] = values[corner][k];
            }
        }
        (self.left[i], self.top[i], self.right[i], self.bottom[i]) = (rect.x0, rect.y0, rect.x1, rect.y1);
        self.back_facing[i] = i32::from(away);
        self.count = i + 1;
    }

    /// Fills all that wait into the rows of `plane`; `perspective` as in the view.
    #[inline(always)]
    pub(super) fn flush<'a, L: Simd, S, const M: usize>(
        &mut self,
        l: L,
        shader: &S,
        perspective: bool,
        depth_test: bool,
        plane: &mut BandBuffer,
    ) where
        S: Shader<'a> + ShaderAttributes<K>,
    {
        let count = std::mem::take(&mut self.count).min(BATCH);
        let mut from = 0;
        while from < count {
            if perspective {
                self.premultiply_batch::<L, S>(l, from, count);
            }
            self.set_up(l, shader, from);
            from += L::N;
        }
        // A tile has fewer lanes outside the triangle than a row, but takes longer to read and write: worth it for narrow triangles or costly pixels.
        for i in 0..count {
            if L::TALL && (S::COSTLY || self.right[i] - self.left[i] < L::TILE[0] as i32) {
                self.rasterize_one::<L, S, M, true>(l, shader, i, depth_test, plane);
            } else if !(L::TALL && S::COSTLY) {
                self.rasterize_one::<L, S, M, false>(l, shader, i, depth_test, plane);
            }
        }
    }

    /// The same as [`premultiply_inv_w`] for the triangles from number `from` on, one a lane. What is left in the lanes behind the last of `count` stays as it is:
    /// multiplied again and again it would become too small to be quick.
    #[inline(always)]
    fn premultiply_batch<'a, L: Simd, S>(&mut self, l: L, from: usize, count: usize)
    where
        S: Shader<'a> + ShaderAttributes<K>,
    {
        let (far, near) = self.spread(l, 0, from);
        let curved = if S::BOUNDED {
            let mut widest = l.splat(0.0);
            for k in 1..S::USED {
                let (low, high) = self.spread(l, k, from);
                widest = l.max(widest, high - low);
            }
            l.lt(far * l.splat(STRAIGHT), (near - far) * widest)
        } else {
            l.lt(far, near)
        };
        let curved = curved & l.ilt(l.iota() + l.isplat(from as i32), l.isplat(count as i32));
        l.istore(l.iselect(curved, l.isplat(1), l.isplat(0)), bytemuck::cast_slice_mut(&mut self.perspective[from..]));
        let factors: [L::F; 3] = each(always!(|c: usize| l.select(curved, l.load(&self.values[0][c][from..]), l.splat(1.0))));
        for k in 1..S::USED {
            for c in 0..3 {
                let slot = &mut self.values[k][c][from..];
                l.store(l.load(slot) * factors[c], slot);
            }
        }
    }

    /// Edge functions and planes of the triangles from number `from` on, one a lane.
    #[inline(always)]
    fn set_up<'a, L: Simd, S>(&mut self, l: L, shader: &S, from: usize)
    where
        S: Shader<'a> + ShaderAttributes<K>,
    {
        let load = always!(|of: &Ints| l.iload(bytemuck::cast_slice(&of[from..])));
        let x: [L::I; 3] = each(always!(|c: usize| load(&self.x[c])));
        let y: [L::I; 3] = each(always!(|c: usize| load(&self.y[c])));
        let middle = always!(|of: &Ints| l.shl::<8>(load(of)) + l.isplat(128));
        let (cx, cy) = (middle(&self.left), middle(&self.top));
        let zero = l.isplat(0);
        for i in 0..3 {
            let j = (i + 1) % 3;
            let (a, b) = (y[i] - y[j], x[j] - x[i]);
            // Top-left rule, as for large triangles.
            let level = l.ilt(l.isplat(-1), a) & l.ilt(a, l.isplat(1));
            let ours = l.ilt(zero, a) | (level & l.ilt(zero, b));
            let bias = l.iselect(ours, zero, l.isplat(1));
            let start = l.imul(a, cx - x[i]) + l.imul(b, cy - y[i]) - bias;
            l.istore(l.shl::<8>(a), bytemuck::cast_slice_mut(&mut self.across[i][from..]));
            l.istore(l.shl::<8>(b), bytemuck::cast_slice_mut(&mut self.down[i][from..]));
            l.istore(start, bytemuck::cast_slice_mut(&mut self.start[i][from..]));
        }
        let (x10, y10, x20, y20) = (x[1] - x[0], y[1] - y[0], x[2] - x[0], y[2] - y[0]);
        let area = l.imul(x10, y20) - l.imul(x20, y10);
        let scale = l.splat(256.0) / l.float(area);
        let [x10, y10, x20, y20] = map([x10, y10, x20, y20], always!(|d: L::I| l.float(d) * scale));
        let to_x = l.float(cx - x[0]) * l.splat(1.0 / 256.0);
        let to_y = l.float(cy - y[0]) * l.splat(1.0 / 256.0);
        for k in 0..S::USED {
            let v = each::<_, 3>(always!(|c: usize| l.load(&self.values[k][c][from..])));
            let (d1, d2) = (v[1] - v[0], v[2] - v[0]);
            let slope = d1 * y20 - d2 * y10;
            let fall = d2 * x10 - d1 * x20;
            l.store(slope, &mut self.slope[k][from..]);
            l.store(fall, &mut self.fall[k][from..]);
            l.store(v[0] + slope * to_x + fall * to_y, &mut self.base[k][from..]);
        }
        let (low, high) = self.spread(l, 0, from);
        let slant = l.abs(l.load(&self.slope[0][from..])) + l.abs(l.load(&self.fall[0][from..]));
        let retreat = l.min(slant * l.splat(SNAPPED), high - low) + l.abs(high) * l.splat(ROUNDING);
        l.store(l.select(l.ilt(zero, load(&self.back_facing)), retreat, l.splat(0.0)), &mut self.retreat[from..]);
        if S::COSTLY {
            let middle = (low + high) * l.splat(0.5);
            // Neither the square of a guess nor that of what it is a guess at may leave the range.
            let usual = l.lt(l.splat(1e-15), middle) & l.lt(middle, l.splat(1e15));
            let narrow = l.lt(high - middle, middle * l.splat(MIN_INV_W_RATIO)) & usual;
            l.store(l.select(narrow, l.splat(1.0) / middle, l.splat(0.0)), &mut self.guess[from..]);
            let corners = TriangleAttributes {
                values: each(always!(|c: usize| each(always!(|k: usize| l.load(&self.values[k][c][from..]))))),
                right: each(always!(|k: usize| l.load(&self.slope[k][from..]))),
                below: each(always!(|k: usize| l.load(&self.fall[k][from..]))),
                curved: l.ilt(zero, load(&self.perspective)),
            };
            let levels = shader.levels(l, &corners);
            for (level, slots) in levels.into_iter().zip(&mut self.levels) {
                l.istore(level, bytemuck::cast_slice_mut(&mut slots[from..]));
            }
        }
    }

    /// Least and greatest value of attribute `k` at the corners of the triangles from number `from` on.
    #[inline(always)]
    fn spread<L: Simd>(&self, l: L, k: usize, from: usize) -> (L::F, L::F) {
        let [a, b, c]: [L::F; 3] = each(always!(|corner: usize| l.load(&self.values[k][corner][from..])));
        (l.min(l.min(a, b), c), l.max(l.max(a, b), c))
    }

    /// Fills triangle `i`, in rows of vectors or, with `TILED`, in tiles that are as wide as its box or wider.
    #[inline(always)]
    fn rasterize_one<'a, L: Simd, S, const M: usize, const TILED: bool>(
        &self,
        l: L,
        shader: &S,
        i: usize,
        depth_test: bool,
        plane: &mut BandBuffer,
    ) where
        S: Shader<'a> + ShaderAttributes<K>,
    {
        let [columns, rows] = if TILED { L::TILE } else { [L::N, 1] };
        let (left, right) = (self.left[i], self.right[i]);
        let (first, bottom) = (self.top[i].max(plane.top), self.bottom[i].min(plane.top + plane.rows as i32 - 1));
        if first > bottom {
            return;
        }
        assert!(plane.contains(plane.index(bottom, left), (right - left + 1) as usize), "a row reaches beyond its band");
        // Lanes count from left to right, in a tile row by row; rows have a power of two of them.
        let lane = l.iota();
        let (column, row) = if TILED {
            (lane & l.isplat(columns as i32 - 1), if columns == 4 { l.shr::<2>(lane) } else { lane })
        } else {
            (lane, l.isplat(0))
        };
        let edge = always!(|e: usize| {
            let start = self.start[e][i] + self.down[e][i] * (first - self.top[i]);
            let along = l.isplat(start) + l.imul(l.isplat(self.across[e][i]), column);
            if TILED && rows > 1 { along + l.imul(l.isplat(self.down[e][i]), row) } else { along }
        });
        let mut line: [L::I; 3] = each(edge);
        // From the centre to each sample.
        let shift: [[L::I; 3]; M] = each(always!(|s: usize| each(always!(|e: usize| {
            let [x, y] = if M == 1 { [0, 0] } else { SAMPLES[s] };
            l.isplat((self.across[e][i] >> 8) * x as i32 + (self.down[e][i] >> 8) * y as i32)
        }))));
        let right_by: [L::I; 3] = each(always!(|e: usize| l.isplat(self.across[e][i] * columns as i32)));
        let down_by: [L::I; 3] = each(always!(|e: usize| l.isplat(self.down[e][i] * rows as i32)));
        let slope = always!(|k: usize| l.splat(self.slope[k][i]));
        let sample_depth: [L::F; M] = each(always!(|s: usize| {
            if M == 1 {
                return l.splat(-self.retreat[i]);
            }
            let [x, y] = SAMPLES[s];
            l.splat(self.slope[0][i] * (x as f32 / 256.0) + self.fall[0][i] * (y as f32 / 256.0) - self.retreat[i])
        }));
        let curved = self.perspective[i] != 0;
        let tame = M == 1 && S::BOUNDED && !curved;
        let mut gradients = Gradients { right: [0.0; K], below: [0.0; K], curved, levels: [Gradients::<K>::MIXED; 3] };
        if S::COSTLY {
            gradients.right = each(always!(|k: usize| self.slope[k][i]));
            gradients.below = each(always!(|k: usize| self.fall[k][i]));
            gradients.levels = each(always!(|t: usize| self.levels[t][i]));
        }
        let columns_f = l.float(column);
        let guess = if S::COSTLY { self.guess[i] } else { 0.0 };
        let (twice, squared) = (l.splat(guess + guess), l.splat(guess * guess));
        let mut y = first;
        while y <= bottom {
            let dy = l.float(row + l.isplat(y - self.top[i]));
            let at = always!(|k: usize, dx: L::F| (l.splat(self.base[k][i]) + l.splat(self.fall[k][i]) * dy) + slope(k) * dx);
            let mut inside_of = line;
            let mut x = left;
            while x <= right {
                let here = plane.index(y, x);
                let dx = columns_f + l.splat((x - left) as f32);
                x += columns as i32;
                let e = inside_of;
                let within: [L::M; M] = each(always!(|s: usize| {
                    let outside =
                        if M == 1 { e[0] | e[1] | e[2] } else { (e[0] + shift[s][0]) | (e[1] + shift[s][1]) | (e[2] + shift[s][2]) };
                    l.ilt(l.isplat(-1), outside)
                }));
                for e in 0..3 {
                    inside_of[e] = inside_of[e] + right_by[e];
                }
                // A tile's depth takes several loads: about half of them in a box are beside the triangle.
                if TILED {
                    let mut any = 0;
                    for inside in within {
                        any |= l.mask_bits(inside);
                    }
                    if any == 0 {
                        continue;
                    }
                }
                let q = at(0, dx);
                let sample = always!(|s: usize| q + sample_depth[s]);
                let mut any = 0;
                let covered: [L::M; M] = each(always!(|s: usize| {
                    let mut inside = within[s];
                    if depth_test {
                        // SAFETY: the plane holds this stretch in its last row and so in those before; tiles may reach into rows that it keeps beyond.
                        inside = inside & l.lt(unsafe { plane.depth_at::<L, TILED>(l, s, here) }, sample(s));
                    }
                    any |= l.mask_bits(inside);
                    inside
                }));
                if any == 0 {
                    continue;
                }
                let mut values: [L::F; K] = each(always!(|k: usize| if k < S::USED { at(k, dx) } else { l.splat(0.0) }));
                if curved {
                    let inverse = if guess == 0.0 {
                        l.splat(1.0) / l.max(q, l.splat(1e-30))
                    } else {
                        let near = twice - squared * q;
                        near * (l.splat(2.0) - near * q)
                    };
                    values[0] = inverse;
                    for value in &mut values[1..S::USED] {
                        *value = *value * inverse;
                    }
                }
                let packed = pack(l, shader.shade(l, &values, &gradients), tame);
                for s in 0..M {
                    // SAFETY: as for reading.
                    unsafe { plane.write::<L, TILED>(l, s, here, covered[s], packed, sample(s)) };
                }
            }
            for e in 0..3 {
                line[e] = line[e] + down_by[e];
            }
            y += rows as i32;
        }
    }
}

/// Multiplies attributes by 1/w where linear interpolation would deviate too much; returns whether it did.
#[inline(always)]
pub(super) fn premultiply_inv_w<const K: usize>(frame_data: &FrameData<'_>, values: &mut [[f32; K]; 3], colors: bool) -> bool {
    let curved = frame_data.view.perspective && needs_perspective(values, colors);
    if curved {
        for value in values {
            let q = value[0];
            for v in &mut value[1..] {
                *v *= q;
            }
        }
    }
    curved
}
