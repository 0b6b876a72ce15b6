//! `cargo bench --bench render [-- THREADS [SIMD]]`: the rasterizer's yardstick, see `sinew::render::bench`.

use std::time::Duration;

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|argument| !argument.starts_with("--"));
    let threads = arguments.next().and_then(|n| n.parse().ok());
    let simd = arguments.next();
    let report = sinew::render::bench::run(threads, simd.as_deref(), Duration::from_secs(2));
    println!("{} threads, {}", report.threads, report.simd);
    for row in &report.rows {
        println!("{:<42} {:>8.3} min {:>8.3} median, ms", row.name, row.min_ms, row.median_ms);
    }
}
