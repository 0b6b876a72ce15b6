//! Timing for benches that print ratios: medians over many runs, and the machine's memory bandwidth in the same run.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// Median seconds of one call of `work`, over up to 400 calls or one second after a warm-up.
pub(crate) fn median(mut work: impl FnMut()) -> f64 {
    for _ in 0..5 {
        work();
    }
    let (mut times, start) = (Vec::new(), Instant::now());
    while times.len() < 400 && (start.elapsed() < Duration::from_secs(1) || times.len() < 10) {
        let begun = Instant::now();
        work();
        times.push(begun.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Seconds that copying `bytes` bytes takes on one thread.
pub(crate) fn copy_time(bytes: usize) -> f64 {
    let (from, mut to) = (vec![1u8; bytes], vec![0u8; bytes]);
    median(|| {
        to.copy_from_slice(black_box(&from));
        black_box(&mut to);
    })
}
