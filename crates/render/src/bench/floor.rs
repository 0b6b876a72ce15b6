//! What any program that makes this picture has to do at least, on one thread and with the widest vectors that the kernels use.

use std::hint::black_box;
use std::time::Duration;

use super::{HEIGHT, WIDTH, time};
use sinew_simd::{Simd, SimdLevel, kernel};

/// Medians, milliseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BenchFloor {
    /// Writing every colour and every depth of the picture once.
    pub clear_ms: f64,
    /// Comparing the depth of as many pixels as the sphere covers, and writing colour and depth of each.
    pub z_pass_ms: f64,
    /// Copying the picture.
    pub memcpy_ms: f64,
}

impl BenchFloor {
    /// What a sphere that covers those pixels costs at least.
    pub fn frame_ms(&self) -> f64 {
        self.clear_ms + self.z_pass_ms
    }
}

/// Measures it, for a picture in which `lit` pixels are covered.
pub(super) fn measure(level: SimdLevel, lit: usize, budget: Duration) -> BenchFloor {
    let pixels = (WIDTH * HEIGHT) as usize;
    let (mut color, mut depth, mut copy) = (vec![0u32; pixels], vec![0f32; pixels], vec![0u32; pixels]);
    let clear = time(budget, |turn| {
        color.fill(turn);
        depth.fill(1.0);
        black_box((&mut color, &mut depth));
    });
    let lit = lit.min(pixels);
    let pass = time(budget, |turn| {
        z_pass(level, turn, &mut color[..lit], &mut depth[..lit]);
        black_box((&mut color, &mut depth));
    });
    let memcpy = time(budget, |_| {
        copy.copy_from_slice(&color);
        black_box(&mut copy);
    });
    BenchFloor { clear_ms: clear.median_ms, z_pass_ms: pass.median_ms, memcpy_ms: memcpy.median_ms }
}

kernel! {
    /// Brings every pixel a step nearer.
    fn z_pass(turn: u32, color: &mut [u32], depth: &mut [f32]) = nearer
}

#[inline(always)]
fn nearer<L: Simd>(l: L, turn: u32, color: &mut [u32], depth: &mut [f32]) {
    let (new_depth, new_color) = (l.splat(turn as f32), l.isplat(turn as i32));
    for (color, depth) in color.chunks_exact_mut(L::N).zip(depth.chunks_exact_mut(L::N)) {
        let old = l.load(depth);
        let front = l.lt(old, new_depth);
        l.store(l.select(front, new_depth, old), depth);
        l.istore(l.iselect(front, new_color, l.iload(color)), color);
    }
}
