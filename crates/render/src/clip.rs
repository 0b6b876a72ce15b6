//! Clipping of the few triangles that reach beyond the near plane or the guard band.
//!
//! Works on homogeneous coordinates in `f64`, one plane after the other (Sutherland and Hodgman, 1974). A new corner is always computed from
//! the end of its edge that is inside, so two triangles that share the edge get the same corner and no gap opens between them. A corner that stays is
//! where the vertex stage put it, to the bit: its other triangles may be whole, and would else part from this one, or lie over it, by a sub-pixel.

use glam::Vec3;

use super::projection::{ScreenVertex, ViewTransform};

/// A triangle cut out of another one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Clipped {
    /// The triangle it is a part of, by its number in the picture.
    pub triangle: u32,
    /// Its corners.
    pub screen: [ScreenVertex; 3],
    /// Each corner as a mixture of the three corners of the whole.
    pub barycentric: [[f32; 3]; 3],
}

#[derive(Clone, Copy, Default)]
struct ClipVertex {
    clip: [f64; 5],
    mixture: [f64; 3],
    /// Where the vertex stage put it, if it is a corner of the whole that can be used as it is.
    original: Option<ScreenVertex>,
}

/// Three corners and one more for each plane.
const MAX_VERTICES: usize = 3 + PLANES;

/// The near plane and the four sides of the guard band.
const PLANES: usize = 5;

/// A function that tells on which side of each plane a point is; inside is ≥ 0.
fn planes(view: &ViewTransform) -> impl Fn(&[f64; 5]) -> [f64; PLANES] {
    let [gx, gy] = view.guard().map(f64::from);
    let near = f64::from(view.near);
    move |c| [c[3] - near, gx * c[2] + c[0], gx * c[2] - c[0], gy * c[2] - c[1], gy * c[2] + c[1]]
}

/// Cuts the triangle with these corners in the world, which are on the picture as `whole` says, and hands each piece to `emit`.
pub(super) fn clip(view: &ViewTransform, corners: [Vec3; 3], whole: &[ScreenVertex; 3], triangle: u32, mut emit: impl FnMut(Clipped)) {
    let mut polygon = [ClipVertex::default(); MAX_VERTICES];
    for (k, corner) in corners.into_iter().enumerate() {
        polygon[k] = ClipVertex {
            clip: view.clip(corner),
            mixture: std::array::from_fn(|i| f64::from(u8::from(i == k))),
            original: Some(whole[k]).filter(|screen| screen.code == 0),
        };
        if !polygon[k].clip.iter().all(|x| x.is_finite()) {
            return;
        }
    }
    let distances = planes(view);
    let mut count = 3;
    for plane in 0..PLANES {
        let mut kept = [ClipVertex::default(); MAX_VERTICES];
        let mut n = 0;
        for k in 0..count {
            let (a, b) = (polygon[k], polygon[(k + 1) % count]);
            let (da, db) = (distances(&a.clip)[plane], distances(&b.clip)[plane]);
            if da >= 0.0 && n < MAX_VERTICES {
                kept[n] = a;
                n += 1;
            }
            if (da >= 0.0) != (db >= 0.0) && n < MAX_VERTICES {
                let (from, to, d_from, d_to) = if da >= 0.0 { (a, b, da, db) } else { (b, a, db, da) };
                let t = d_from / (d_from - d_to);
                kept[n] = ClipVertex {
                    clip: std::array::from_fn(|i| from.clip[i] + (to.clip[i] - from.clip[i]) * t),
                    mixture: std::array::from_fn(|i| from.mixture[i] + (to.mixture[i] - from.mixture[i]) * t),
                    original: None,
                };
                n += 1;
            }
        }
        (polygon, count) = (kept, n);
        if count < 3 {
            return;
        }
    }
    let mut screen = [ScreenVertex::default(); MAX_VERTICES];
    for (screen, corner) in screen.iter_mut().zip(&polygon[..count]) {
        let Some(point) = corner.original.or_else(|| view.snap(corner.clip)) else { return };
        *screen = point;
    }
    for k in 1..count - 1 {
        let chosen = [0, k, k + 1];
        emit(Clipped { triangle, screen: chosen.map(|i| screen[i]), barycentric: chosen.map(|i| polygon[i].mixture.map(|x| x as f32)) });
    }
}

/// Cuts a line in the world at the near plane and the guard band: the part of it that is left, as `(from, to)` between 0 and 1, and its ends.
pub(super) fn clip_line(view: &ViewTransform, a: Vec3, b: Vec3) -> Option<([f64; 2], [[f64; 5]; 2])> {
    let (ca, cb) = (view.clip(a), view.clip(b));
    if !ca.iter().chain(&cb).all(|x| x.is_finite()) {
        return None;
    }
    let distances = planes(view);
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (da, db) in distances(&ca).into_iter().zip(distances(&cb)) {
        if da < 0.0 && db < 0.0 {
            return None;
        }
        if da < 0.0 {
            from = from.max(da / (da - db));
        } else if db < 0.0 {
            to = to.min(da / (da - db));
        }
    }
    if from >= to {
        return None;
    }
    let at = |t: f64| -> [f64; 5] { std::array::from_fn(|i| ca[i] + (cb[i] - ca[i]) * t) };
    Some(([from, to], [at(from), at(to)]))
}
