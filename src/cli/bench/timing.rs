//! How long frames take.

use std::time::{Duration, Instant};

use crate::render::Stats;

/// Frames of a scene, at most.
const FRAMES: usize = 400;

/// How long the frames of a scene took.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct BenchTimes {
    /// The fastest, milliseconds.
    pub min_ms: f64,
    /// The median, milliseconds.
    pub median_ms: f64,
    /// Medians of the stages.
    pub stages: Stages,
}

/// Milliseconds of the stages of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Stages {
    /// Curves, matrices, skinning, muscles; nothing moves in a sphere.
    pub pose_ms: f64,
    /// See [`Stats::vertex_ms`].
    pub vertex_ms: f64,
    /// See [`Stats::raster_ms`].
    pub raster_ms: f64,
    /// See [`Stats::resolve_ms`].
    pub resolve_ms: f64,
}

impl Stages {
    /// What the renderer says about its last frame, and the time that the pose took before.
    pub(super) fn of(stats: Stats, pose_ms: f64) -> Self {
        Self { pose_ms, vertex_ms: stats.vertex_ms, raster_ms: stats.raster_ms, resolve_ms: stats.resolve_ms }
    }
}

/// Runs `frame` with a growing number, for at most `budget` or 400 frames and at least 5, and says how long it took. The first frame that fails ends it.
pub(super) fn time<E>(budget: Duration, mut frame: impl FnMut(u32) -> Result<Stages, E>) -> Result<BenchTimes, E> {
    // The first frames make buffers and warm caches.
    for warm in 0..3 {
        frame(warm)?;
    }
    let (begin, mut all, mut stages) = (Instant::now(), Vec::new(), Vec::new());
    while all.len() < 5 || (all.len() < FRAMES && begin.elapsed() < budget) {
        let start = Instant::now();
        let staged = frame(all.len() as u32)?;
        all.push(start.elapsed().as_secs_f64() * 1e3);
        stages.push(staged);
    }
    let min_ms = all.iter().copied().fold(f64::INFINITY, f64::min);
    let of = |stage: fn(&Stages) -> f64| median(stages.iter().map(stage).collect());
    let stages = Stages {
        pose_ms: of(|s| s.pose_ms),
        vertex_ms: of(|s| s.vertex_ms),
        raster_ms: of(|s| s.raster_ms),
        resolve_ms: of(|s| s.resolve_ms),
    };
    Ok(BenchTimes { min_ms, median_ms: median(all), stages })
}

/// The middle one; 0 of none.
fn median(mut all: Vec<f64>) -> f64 {
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(0.0)
}
