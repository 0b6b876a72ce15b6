//! The kernels that fill triangles: which pixels, which of them are in front, what colour.

// Several arrays are walked with one index; iterators would hide that and have to be trusted to dissolve.
#![allow(clippy::needless_range_loop)]

use super::drawing::{Drawing, Item, Unit};
use super::lanes::{Lanes, Level, always, each, kernel, map};
use super::plane::Plane;
use super::setup::{BLOCK, Edges, Planes, Rect, area};
use super::shade::{Attributes, Gouraud, Phong, PhongTextured, Shader, Slopes, Textured};
use super::style::Fill;
use super::view::Screen;

/// One stretch of triangles of one item.
#[derive(Clone, Copy)]
pub(super) struct Stretch<'a> {
    pub drawing: &'a Drawing<'a>,
    pub item: &'a Item,
    /// Where cut pieces are.
    pub unit: &'a Unit,
    /// What to fill, as [`Drawing::part`] understands it.
    pub entries: &'a [u32],
}

/// One function for each way of shading and number of samples: together they would be too much for the optimizer's patience.
macro_rules! kernels {
    ($($name:ident = $shader:ident, $attributes:literal, $samples:literal;)*) => { $(
        kernel! {
            fn $name<'a>(stretch: &Stretch<'a>, plane: &mut Plane) = triangles::<_, $shader<'_>, $attributes, $samples>
        }
    )* };
}
kernels! {
    gouraud = Gouraud, 5, 1;
    gouraud_4 = Gouraud, 5, 4;
    textured = Textured, 7, 1;
    textured_4 = Textured, 7, 4;
    phong = Phong, 11, 1;
    phong_4 = Phong, 11, 4;
    phong_textured = PhongTextured, 12, 1;
    phong_textured_4 = PhongTextured, 12, 4;
}

/// Fills a stretch of triangles into the rows of `plane`.
pub(super) fn fill(level: Level, stretch: &Stretch<'_>, plane: &mut Plane) {
    let kernel = match (stretch.item.style.fill, plane.samples) {
        (Fill::Gouraud, 1) => gouraud,
        (Fill::Gouraud, _) => gouraud_4,
        (Fill::Textured, 1) => textured,
        (Fill::Textured, _) => textured_4,
        (Fill::Phong, 1) => phong,
        (Fill::Phong, _) => phong_4,
        (Fill::PhongTextured, 1) => phong_textured,
        (Fill::PhongTextured, _) => phong_textured_4,
    };
    kernel(level, stretch, plane);
}

#[inline(always)]
fn triangles<'a, L: Lanes, S, const K: usize, const M: usize>(l: L, stretch: &Stretch<'a>, plane: &mut Plane)
where
    S: Shader<'a> + Attributes<K>,
{
    let Stretch { drawing, item, unit, entries } = *stretch;
    let feed = drawing.feed(item);
    let shader = S::new(drawing, item);
    for &entry in entries {
        let Some(part) = Drawing::part(item, &feed, unit, entry) else { continue };
        let mut screen = part.screen;
        let mut size = area(&screen);
        if size == 0 {
            continue;
        }
        let other_side = (size > 0) != item.style.mirrored;
        let mut values = shader.corners(&feed, part.triangle, other_side);
        if let Some(mixture) = part.mixture {
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
        let curved = drawing.view.perspective && bends(&values);
        if curved {
            for value in &mut values {
                let q = value[0];
                for v in &mut value[1..] {
                    *v *= q;
                }
            }
        }
        let triangle = Triangle { screen, area: size, values, curved, depth_test: item.style.depth_test, blended: item.blended() };
        raster::<L, S, K, M>(l, &shader, &triangle, plane, drawing.view.size);
    }
}

/// Whether straight interpolation on the picture would be off by more than a tenth of a 255th anywhere. Between corners whose nearness has the
/// ratio k the two ways differ by at most (√k − 1)/(√k + 1) of the corners' difference, which is less than (k − 1)/4.
#[inline(always)]
fn bends<const K: usize>(values: &[[f32; K]; 3]) -> bool {
    let spread = |k: usize| {
        let (a, b, c) = (values[0][k], values[1][k], values[2][k]);
        (a.max(b).max(c), a.min(b).min(c))
    };
    let (near, far) = spread(0);
    // Only colours are known to be within 0 to 255; other attributes always take the exact way.
    if K != 5 {
        return near != far;
    }
    let mut widest = 0.0f32;
    for k in 1..K {
        let (high, low) = spread(k);
        widest = widest.max(high - low);
    }
    (near - far) * widest > 0.4 * far
}

struct Triangle<const K: usize> {
    screen: [Screen; 3],
    area: i64,
    values: [[f32; K]; 3],
    /// Whether attributes were multiplied with the nearness and have to be divided again.
    curved: bool,
    depth_test: bool,
    blended: bool,
}

/// The inner loops. `M` is the number of samples.
#[inline(always)]
fn raster<'a, L: Lanes, S, const K: usize, const M: usize>(l: L, shader: &S, triangle: &Triangle<K>, plane: &mut Plane, size: [u32; 2])
where
    S: Shader<'a> + Attributes<K>,
{
    let rect = Rect::of(&triangle.screen, M > 1, size);
    let (top, bottom) = (rect.y0.max(plane.top), rect.y1.min(plane.top + plane.rows as i32 - 1));
    if rect.is_empty() || top > bottom {
        return;
    }
    let edges = Edges::new(&triangle.screen, rect.x0, rect.y0);
    let planes = Planes::new(&triangle.screen, triangle.area, &triangle.values, rect.x0, rect.y0);
    let slopes = Slopes { right: planes.right, below: planes.below, curved: triangle.curved };
    let right = map(planes.right, always!(|slope: f32| l.splat(slope)));
    // How the nearness changes from the centre to each sample.
    let lift: [L::F; M] = each(always!(|s: usize| {
        let [x, y] = if M == 1 { [0, 0] } else { super::setup::SAMPLES[s] };
        l.splat(planes.right[0] * (x as f32 / 256.0) + planes.below[0] * (y as f32 / 256.0))
    }));
    let ramp = l.float(l.iota());
    let mut left = rect.x0;
    while left <= rect.x1 {
        let width = (rect.x1 - left + 1).min(BLOCK);
        let Some(stepping) = edges.block::<M>(left - rect.x0, top - rect.y0, width, bottom - top + 1) else {
            left += BLOCK;
            continue;
        };
        let across = map(stepping.a, always!(|a: i32| l.imul(l.isplat(a), l.iota())));
        let jump = map(stepping.a, always!(|a: i32| l.isplat(a.wrapping_mul(L::N as i32))));
        let mut start = stepping.start;
        for y in top..=bottom {
            let row = planes.row(y - rect.y0);
            let row = map(row, always!(|value: f32| l.splat(value)));
            let mut inside_of: [[L::I; 3]; M] = each(always!(|s: usize| each(always!(|i: usize| l.isplat(start[s][i]) + across[i]))));
            let at = plane.index(y, left);
            let mut x = 0;
            while x < width {
                let outside: [L::I; M] = each(always!(|s: usize| inside_of[s][0] | inside_of[s][1] | inside_of[s][2]));
                for edge in &mut inside_of {
                    for i in 0..3 {
                        edge[i] = edge[i] + jump[i];
                    }
                }
                let here = at + x as usize;
                let offset = ramp + l.splat((left - rect.x0 + x) as f32);
                x += L::N as i32;
                let q = row[0] + right[0] * offset;
                let mut any = 0;
                let covered: [L::M; M] = each(always!(|s: usize| {
                    let inside = l.ilt(l.isplat(-1), outside[s]);
                    let front = l.lt(if triangle.depth_test { plane.depth(l, s, here) } else { l.splat(f32::NEG_INFINITY) }, q + lift[s]);
                    any |= l.mask_bits(inside & front);
                    inside & front
                }));
                if any == 0 {
                    continue;
                }
                if !triangle.blended {
                    for s in 0..M {
                        plane.set_depth(l, s, here, covered[s], q + lift[s]);
                    }
                }
                let mut values: [L::F; K] = each(always!(|k: usize| row[k] + right[k] * offset));
                if triangle.curved {
                    let inverse = l.splat(1.0) / l.max(q, l.splat(1e-30));
                    values[0] = inverse;
                    for value in &mut values[1..] {
                        *value = *value * inverse;
                    }
                }
                let color = shader.shade(l, &values, &slopes);
                if triangle.blended {
                    for s in 0..M {
                        plane.blend(l, s, here, covered[s], color);
                    }
                } else {
                    let packed = super::plane::pack(l, color);
                    for s in 0..M {
                        plane.set_color(l, s, here, covered[s], packed);
                    }
                }
            }
            for edge in &mut start {
                for i in 0..3 {
                    edge[i] = edge[i].wrapping_add(stepping.b[i]);
                }
            }
        }
        left += BLOCK;
    }
}
