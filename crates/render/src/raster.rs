//! Kernels that fill triangles: coverage, depth test, shading.

// Several arrays are walked with one index; iterators would hide that and have to be trusted to dissolve.
#![allow(clippy::needless_range_loop, reason = "the index counts lanes of several arrays at once")]

use super::draw_data::{DrawCall, FrameData, WorkUnit};
use super::material_state::ShaderKind;
use super::projection::ScreenVertex;
use super::setup::{AttributePlanes, BLOCK, EdgeStepper, Edges, Rect, area};
use super::shade::{
    AnyTextured, Gouraud, Gradients, OpaqueTextured, Phong, PhongTextured, Shader, ShaderAttributes, TriangleAttributes, is_opaque_textured,
};
use super::small_triangles::{TriangleBatch, premultiply_inv_w};
use super::tile_buffer::BandBuffer;
use sinew_simd::{Scalar, Simd, SimdLevel, always, each, kernel, map};

/// One stretch of triangles of one item.
#[derive(Clone, Copy)]
pub(super) struct DrawRun<'a> {
    pub frame_data: &'a FrameData<'a>,
    pub item: &'a DrawCall,
    /// Where cut pieces are.
    pub unit: &'a WorkUnit,
    /// What to fill, as [`FrameData::clipped_triangle`] understands it.
    pub entries: &'a [u32],
}

/// One function for each way of shading and number of samples: as one function they would take the optimizer too long.
macro_rules! kernels {
    ($($(($narrow:ident))? $name:ident = $shader:ident, $attributes:literal, $samples:literal;)*) => { $(
        kernel! {
            $($narrow)? fn $name<'a>(run: &DrawRun<'a>, plane: &mut BandBuffer) = triangles::<_, $shader<'_>, $attributes, $samples>
        }
    )* };
}
kernels! {
    gouraud = Gouraud, 4, 1;
    gouraud_4 = Gouraud, 4, 4;
    (narrow) glass = Gouraud, 8, 1;
    (narrow) glass_4 = Gouraud, 8, 4;
    plain = OpaqueTextured, 8, 1;
    textured = AnyTextured, 8, 1;
    textured_4 = AnyTextured, 8, 4;
    phong = Phong, 12, 1;
    (narrow) phong_4 = Phong, 12, 4;
    (narrow) phong_textured = PhongTextured, 12, 1;
    (narrow) phong_textured_4 = PhongTextured, 12, 4;
}

/// Fills a stretch of triangles into the rows of `plane`.
pub(super) fn fill(level: SimdLevel, run: &DrawRun<'_>, plane: &mut BandBuffer) {
    let kernel = match (run.item.material.shader, plane.samples) {
        (ShaderKind::Gouraud, 1) if run.item.is_blended() => glass,
        (ShaderKind::Gouraud, _) if run.item.is_blended() => glass_4,
        (ShaderKind::Gouraud, 1) => gouraud,
        (ShaderKind::Gouraud, _) => gouraud_4,
        (ShaderKind::Textured, 1) if is_opaque_textured(run.frame_data, &run.item.material) => plain,
        (ShaderKind::Textured, 1) => textured,
        (ShaderKind::Textured, _) => textured_4,
        (ShaderKind::Phong, 1) => phong,
        (ShaderKind::Phong, _) => phong_4,
        (ShaderKind::PhongTextured, 1) => phong_textured,
        (ShaderKind::PhongTextured, _) => phong_textured_4,
    };
    kernel(level, run, plane);
}

#[inline(always)]
fn triangles<'a, L: Simd, S, const K: usize, const M: usize>(l: L, run: &DrawRun<'a>, plane: &mut BandBuffer)
where
    S: Shader<'a> + ShaderAttributes<K>,
{
    let DrawRun { frame_data, item, unit, entries } = *run;
    let reader = frame_data.reader(item);
    let shader = S::new(frame_data, item);
    let blended = S::BLENDED.unwrap_or(item.is_blended());
    let mut batch = TriangleBatch::<K>::new();
    for &entry in entries {
        let Some(part) = FrameData::clipped_triangle(item, &reader, unit, entry) else { continue };
        let mut screen = part.screen;
        let mut size = area(&screen);
        if size == 0 {
            continue;
        }
        let other_side = (size > 0) != item.material.mirrored;
        let mut values = shader.corners(&reader, part.triangle, other_side);
        if let Some(mixture) = part.barycentric {
            let whole = values;
            for (value, share) in values.iter_mut().zip(mixture) {
                for k in 0..K {
                    value[k] = whole[0][k] * share[0] + whole[1][k] * share[1] + whole[2][k] * share[2];
                }
            }
        }
        for (value, corner) in values.iter_mut().zip(&screen) {
            value[0] = corner.q;
        }
        if size < 0 {
            size = -size;
            screen.swap(1, 2);
            values.swap(1, 2);
        }
        if !blended && TriangleBatch::<K>::fits(&screen, size) {
            let rect = Rect::of(&screen, M > 1, frame_data.view.size);
            if !rect.is_empty() {
                batch.push(S::USED, &screen, &values, &rect, other_side);
            }
            if batch.is_full() {
                batch.flush::<L, S, M>(l, &shader, frame_data.view.perspective, item.material.depth_test, plane);
            }
            continue;
        }
        // What came before has to be drawn before.
        if !blended {
            batch.flush::<L, S, M>(l, &shader, frame_data.view.perspective, item.material.depth_test, plane);
        }
        let curved = premultiply_inv_w(frame_data, &mut values, item.material.shader == ShaderKind::Gouraud);
        let triangle = Triangle { screen, area: size, values, curved, away: other_side, depth_test: item.material.depth_test, blended };
        raster::<L, S, K, M>(l, &shader, &triangle, plane, frame_data.view.size);
    }
    if !blended {
        batch.flush::<L, S, M>(l, &shader, frame_data.view.perspective, item.material.depth_test, plane);
    }
}

/// Linear interpolation is accurate enough where the nearness's change times the colours' is no more than this share of the nearness: see [`needs_perspective`].
pub(super) const STRAIGHT: f32 = 0.4;

/// Whether straight interpolation on the picture would be off by more than a tenth of a 255th anywhere. Between corners whose nearness has the
/// ratio k the two ways differ by at most (√k − 1)/(√k + 1) of the corners' difference, which is less than (k − 1)/4.
#[inline(always)]
pub(super) fn needs_perspective<const K: usize>(values: &[[f32; K]; 3], colors: bool) -> bool {
    // Compared by hand: `f32::max` spends half its time on NaN, which no corner holds that got here.
    let spread = always!(|k: usize| {
        let (a, b, c) = (values[0][k], values[1][k], values[2][k]);
        let (high, low) = if a > b { (a, b) } else { (b, a) };
        (if high > c { high } else { c }, if low < c { low } else { c })
    });
    let (near, far) = spread(0);
    // Only colours are known to be within 0 to 255; other attributes always use perspective interpolation.
    if !colors {
        return near != far;
    }
    let mut widest = 0.0f32;
    for k in 1..K {
        let (high, low) = spread(k);
        widest = if high - low > widest { high - low } else { widest };
    }
    (near - far) * widest > STRAIGHT * far
}

struct Triangle<const K: usize> {
    screen: [ScreenVertex; 3],
    area: i64,
    values: [[f32; K]; 3],
    /// Whether attributes were multiplied with the nearness and have to be divided again.
    curved: bool,
    /// Whether it faces away.
    away: bool,
    depth_test: bool,
    blended: bool,
}

/// The inner loops. `M` is the number of samples.
#[inline(always)]
fn raster<'a, L: Simd, S, const K: usize, const M: usize>(l: L, shader: &S, triangle: &Triangle<K>, plane: &mut BandBuffer, size: [u32; 2])
where
    S: Shader<'a> + ShaderAttributes<K>,
{
    let rect = Rect::of(&triangle.screen, M > 1, size);
    let (top, bottom) = (rect.y0.max(plane.top), rect.y1.min(plane.top + plane.rows as i32 - 1));
    if rect.is_empty() || top > bottom || plane.samples != M {
        return;
    }
    let edges = Edges::new(&triangle.screen, rect.x0, rect.y0);
    let planes = AttributePlanes::new(&triangle.screen, triangle.area, &triangle.values, rect.x0, rect.y0);
    let corners = TriangleAttributes { values: triangle.values, right: planes.right, below: planes.below, curved: triangle.curved };
    let [a, b, c] = shader.levels(Scalar, &corners);
    let levels = [a.value(), b.value(), c.value()];
    let gradients = Gradients { right: planes.right, below: planes.below, curved: triangle.curved, levels };
    // Pixel centres inside cannot get values beyond the corners', but for the rounding of steep slopes; samples reach outside.
    let in_range = M == 1 && S::BOUNDED && !triangle.curved && planes.is_well_conditioned(rect.x1 - rect.x0);
    let right = map(planes.right, always!(|slope: f32| l.splat(slope)));
    let retreat = if triangle.away { planes.retreat(map(triangle.screen, always!(|corner: ScreenVertex| corner.q))) } else { 0.0 };
    // From the nearness at the centre to the depth of each sample.
    let sample_depth: [L::F; M] = each(always!(|s: usize| {
        if M == 1 {
            return l.splat(-retreat);
        }
        let [x, y] = super::setup::SAMPLES[s];
        l.splat(planes.right[0] * (x as f32 / 256.0) + planes.below[0] * (y as f32 / 256.0) - retreat)
    }));
    let ramp = l.float(l.iota());
    let stride = l.splat(L::N as f32);
    let mut left = rect.x0;
    while left <= rect.x1 {
        let width = (rect.x1 - left + 1).min(BLOCK);
        let Some(stepper) = edges.block::<M>(left - rect.x0, top - rect.y0, width, bottom - top + 1) else {
            left += BLOCK;
            continue;
        };
        let across = map(stepper.a, always!(|a: i32| l.imul(l.isplat(a), l.iota())));
        let jump = map(stepper.a, always!(|a: i32| l.isplat(a.wrapping_mul(L::N as i32))));
        let mut start = stepper.start;
        let mut span = PixelRun::new(&stepper, width, bottom - top + 1, width > L::N as i32);
        for y in top..=bottom {
            let (mut x, end) = span.next();
            let first = plane.index(y, left);
            assert!(plane.contains(first, width as usize), "a row reaches beyond its band");
            if x < end {
                let row = planes.row(y - rect.y0);
                let row = map(row, always!(|value: f32| l.splat(value)));
                let mut inside_of: [[L::I; 3]; M] = each(always!(|s: usize| each(always!(|i: usize| l
                    .isplat(start[s][i].wrapping_add(stepper.a[i].wrapping_mul(x)))
                    + across[i]))));
                let mut offset = ramp + l.splat((left - rect.x0 + x) as f32);
                while x < end {
                    let outside: [L::I; M] = each(always!(|s: usize| inside_of[s][0] | inside_of[s][1] | inside_of[s][2]));
                    for edge in &mut inside_of {
                        for i in 0..3 {
                            edge[i] = edge[i] + jump[i];
                        }
                    }
                    let here = first + x as usize;
                    let ours = l.isplat(width - x);
                    let distance = offset;
                    offset = offset + stride;
                    x += L::N as i32;
                    let q = row[0] + right[0] * distance;
                    let sample = always!(|s: usize| q + sample_depth[s]);
                    let mut any = 0;
                    let covered: [L::M; M] = each(always!(|s: usize| {
                        let mut inside = l.ilt(l.isplat(-1), outside[s]);
                        // The last vector of a block reaches into the next one, which comes to the same pixels again: the depth test keeps an opaque
                        // surface from being drawn twice there, but nothing would keep a blended one.
                        if triangle.blended {
                            inside = inside & l.ilt(l.iota(), ours);
                        }
                        if triangle.depth_test {
                            // SAFETY: `x` was below `width`, and the plane holds that many from `first` on.
                            inside = inside & l.lt(unsafe { plane.depth(l, s, here) }, sample(s));
                        }
                        any |= l.mask_bits(inside);
                        inside
                    }));
                    if any == 0 {
                        continue;
                    }
                    if !triangle.blended {
                        for s in 0..M {
                            // SAFETY: as for reading.
                            unsafe { plane.set_depth(l, s, here, covered[s], sample(s)) };
                        }
                    }
                    let value = always!(|k: usize| if k < S::USED { row[k] + right[k] * distance } else { l.splat(0.0) });
                    let mut values: [L::F; K] = each(value);
                    if triangle.curved {
                        let inverse = l.splat(1.0) / l.max(q, l.splat(1e-30));
                        values[0] = inverse;
                        for value in &mut values[1..S::USED] {
                            *value = *value * inverse;
                        }
                    }
                    let color = shader.shade(l, &values, &gradients);
                    if triangle.blended {
                        for s in 0..M {
                            // SAFETY: as for reading.
                            unsafe { plane.blend(l, s, here, covered[s], color) };
                        }
                    } else {
                        let packed = super::tile_buffer::pack(l, color, in_range);
                        for s in 0..M {
                            // SAFETY: as for reading.
                            unsafe { plane.set_color(l, s, here, covered[s], packed) };
                        }
                    }
                }
            }
            for edge in &mut start {
                for i in 0..3 {
                    edge[i] = edge[i].wrapping_add(stepper.b[i]);
                }
            }
        }
        left += BLOCK;
    }
}

/// Finds, row by row, the stretch that can be inside all edges, so that the empty half of a wide triangle's box is not walked.
struct PixelRun {
    /// Where the edges on the left cross the row, in columns from the block's first; at most two edges are on one side.
    left: [f32; 2],
    left_step: [f32; 2],
    right: [f32; 2],
    right_step: [f32; 2],
    width: i32,
    wide: bool,
}

impl PixelRun {
    #[inline(always)]
    fn new<const M: usize>(stepper: &EdgeStepper<M>, width: i32, rows: i32, wide: bool) -> Self {
        let far = 1e6;
        let mut span = Self { left: [-far; 2], left_step: [0.0; 2], right: [far; 2], right_step: [0.0; 2], width, wide };
        if wide {
            let (mut lefts, mut rights) = (0, 0);
            for i in 0..3 {
                let a = stepper.a[i];
                // The sample for which the edge reaches furthest out.
                let mut value = stepper.start[0][i];
                for sample in &stepper.start[1..] {
                    value = value.max(sample[i]);
                }
                if a != 0 {
                    let inverse = -1.0 / a as f32;
                    let (cross, step) = (value as f32 * inverse, stepper.b[i] as f32 * inverse);
                    // Where an edge is nearly level, its crossings are too far apart for `f32`; such an edge is not used.
                    if cross.abs().max((cross + step * rows as f32).abs()) > 65_536.0 {
                        continue;
                    }
                    if a > 0 && lefts < 2 {
                        (span.left[lefts], span.left_step[lefts]) = (cross, step);
                        lefts += 1;
                    } else if a < 0 && rights < 2 {
                        (span.right[rights], span.right_step[rights]) = (cross, step);
                        rights += 1;
                    }
                }
            }
        }
        span
    }

    /// First column of the next row and one past its last. May be two pixels too much on either side, never too little: crossings are below 2¹⁶, so
    /// that all the rounding over the rows of a band stays below half a pixel.
    #[inline(always)]
    fn next(&mut self) -> (i32, i32) {
        if !self.wide {
            return (0, self.width);
        }
        let from = self.left[0].max(self.left[1]).min(1e6) as i32 - 1;
        let to = self.right[0].min(self.right[1]).max(-1e6) as i32 + 2;
        for i in 0..2 {
            self.left[i] += self.left_step[i];
            self.right[i] += self.right_step[i];
        }
        (from.max(0), to.min(self.width))
    }
}
