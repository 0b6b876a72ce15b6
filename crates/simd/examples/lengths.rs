//! Lengths of vectors, on every instruction set that this processor has: the bits are the same.

use sinew_simd::{Simd, SimdLevel, kernel};

kernel! {
    /// Writes the length of each vector (x, y) to `lengths`. The slices are equally long, a multiple of 16.
    fn lengths(x: &[f32], y: &[f32], lengths: &mut [f32]) = lengths_in_lanes
}

// Everything between a kernel's entry and its operations has to be inlined, or the operations become calls.
#[inline(always)]
fn lengths_in_lanes<L: Simd>(l: L, x: &[f32], y: &[f32], lengths: &mut [f32]) {
    for ((x, y), to) in x.chunks_exact(L::N).zip(y.chunks_exact(L::N)).zip(lengths.chunks_exact_mut(L::N)) {
        let (x, y) = (l.load(x), l.load(y));
        l.store(l.sqrt(x * x + y * y), to);
    }
}

/// The name of each instruction set with the lengths that it computed.
pub(crate) fn on_every_level(x: &[f32], y: &[f32]) -> Vec<(&'static str, Vec<f32>)> {
    let computed = |level: SimdLevel| {
        let mut all = vec![0.0; x.len()];
        lengths(level, x, y, &mut all);
        (level.name(), all)
    };
    SimdLevel::all().into_iter().map(computed).collect()
}

fn main() {
    let (x, y): (Vec<f32>, Vec<f32>) = (0..32_u8).map(|i| (f32::from(i), f32::from(i) * 0.75)).unzip();
    for (name, lengths) in on_every_level(&x, &y) {
        println!("{name}: … {:?}", &lengths[28..]);
    }
}
