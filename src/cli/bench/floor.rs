//! What any program that makes this picture has to do at least, on one thread and with the widest vectors that the kernels use.

use std::convert::Infallible;
use std::hint::black_box;
use std::time::Duration;

use super::spheres::{HEIGHT, WIDTH};
use super::timing::{Stages, time};
use crate::render::Renderer;
use sinew_simd::{Simd, SimdLevel, kernel};

/// Medians, milliseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BenchFloor {
    /// Writing every colour and every depth of the picture once.
    pub clear_ms: f64,
    /// Comparing the depth of as many pixels as the sphere covers, and writing colour and depth of each.
    pub z_pass_ms: f64,
    /// Copying the picture.
    pub memcpy_ms: f64,
}

/// How many pixels the 10k sphere covers in the view "fill".
const LIT: usize = 411_000;

/// Measures it with a renderer's instruction set.
pub(super) fn measure(renderer: &Renderer, budget: Duration) -> BenchFloor {
    let level = SimdLevel::named(renderer.simd()).unwrap_or_else(SimdLevel::detect);
    let time = |frame: &mut dyn FnMut(u32)| {
        let staged = |turn| {
            frame(turn);
            Ok::<_, Infallible>(Stages::default())
        };
        let Ok(times) = time(budget, staged);
        times
    };
    let pixels = (WIDTH * HEIGHT) as usize;
    let (mut color, mut depth, mut copy) = (vec![0u32; pixels], vec![0f32; pixels], vec![0u32; pixels]);
    let clear = time(&mut |turn| {
        color.fill(turn);
        depth.fill(1.0);
        black_box((&mut color, &mut depth));
    });
    let lit = LIT.min(pixels);
    let pass = time(&mut |turn| {
        z_pass(level, turn, &mut color[..lit], &mut depth[..lit]);
        black_box((&mut color, &mut depth));
    });
    let memcpy = time(&mut |_| {
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
