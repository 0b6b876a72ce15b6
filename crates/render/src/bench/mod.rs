//! How fast the rasterizer is on this machine: spheres that every renderer can draw, and the floor that no program gets below.
//!
//! The sphere has radius 1 and is lit by one far light, back faces are left out, and the picture is 1280 × 720 with a vertical field of view
//! of 45°. "Fill" stands 2.6 in front of the camera and covers 411 thousand pixels, "figure" stands at 5.0. The sphere turns by 0.01 rad a frame. A frame is
//! everything from clearing to finished pixels in memory.

mod bench_scene;
mod floor;

use std::hint::black_box;
use std::time::{Duration, Instant};

use glam::Vec3;

use super::{Background, Display, Renderer, Samples, Shading, Stats};
use bench_scene::BenchScene;
pub use floor::BenchFloor;
use sinew_scene::{Camera, Frame, Scene};

const WIDTH: u32 = 1280;
const HEIGHT: u32 = 720;
/// Frames of a scene, at most.
const FRAMES: usize = 400;

/// How many pixels the 10k sphere covers in the view "fill".
const LIT: usize = 411_000;

/// One scene that was measured.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchRow {
    /// What stands there: `sphere-10k`, …
    pub scene: String,
    /// From where it is seen.
    pub view: &'static str,
    /// Size of the picture, pixels.
    pub width: u32,
    /// See `width`.
    pub height: u32,
    /// Triangles that were given, before any is left out.
    pub triangles: u64,
    /// Pixels that are not background.
    pub lit_pixels: u64,
    /// `gouraud`, `phong`, `flat` or `textured`.
    pub shading: &'static str,
    /// Samples a pixel.
    pub samples: u32,
    /// How long frames took.
    pub times: BenchTimes,
}

/// How long the frames of a scene took.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BenchTimes {
    /// The fastest, milliseconds.
    pub min_ms: f64,
    /// The median, milliseconds.
    pub median_ms: f64,
    /// Medians of the stages.
    pub stages: Stages,
}

/// Milliseconds of the stages of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stages {
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
    pub fn of(stats: Stats, pose_ms: f64) -> Self {
        Self { pose_ms, vertex_ms: stats.vertex_ms, raster_ms: stats.raster_ms, resolve_ms: stats.resolve_ms }
    }
}

/// A closure that measures may return what its stages took, or nothing.
pub trait StageTimings {
    /// The stages of the frame that was just made.
    fn stages(self) -> Stages;
}

impl StageTimings for () {
    fn stages(self) -> Stages {
        Stages::default()
    }
}

impl StageTimings for Stages {
    fn stages(self) -> Stages {
        self
    }
}

/// Runs `frame` with a growing number, for at most `budget` or 400 frames and at least 5, and says how long it took.
pub fn time<S: StageTimings>(budget: Duration, mut frame: impl FnMut(u32) -> S) -> BenchTimes {
    // The first frames make buffers and warm caches.
    for warm in 0..3 {
        frame(warm);
    }
    let (begin, mut all, mut stages) = (Instant::now(), Vec::new(), Vec::new());
    while all.len() < 5 || (all.len() < FRAMES && begin.elapsed() < budget) {
        let start = Instant::now();
        let staged = frame(all.len() as u32);
        all.push(start.elapsed().as_secs_f64() * 1e3);
        stages.push(staged.stages());
    }
    let min_ms = all.iter().copied().fold(f64::INFINITY, f64::min);
    let of = |stage: fn(&Stages) -> f64| median(stages.iter().map(stage).collect());
    let stages = Stages {
        pose_ms: of(|s| s.pose_ms),
        vertex_ms: of(|s| s.vertex_ms),
        raster_ms: of(|s| s.raster_ms),
        resolve_ms: of(|s| s.resolve_ms),
    };
    BenchTimes { min_ms, median_ms: median(all), stages }
}

/// The middle one; 0 of none.
fn median(mut all: Vec<f64>) -> f64 {
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(0.0)
}

/// Pixels that something stands on.
pub fn lit_pixels(
    renderer: &mut Renderer,
    scene: &Scene,
    frame: &Frame,
    camera: &Camera,
    display: &Display,
    (width, height): (u32, u32),
) -> u64 {
    let display = Display { background: Background::Transparent, ..display.clone() };
    let picture = renderer.draw(scene, frame, camera, &display, width, height);
    picture.pixels.iter().filter(|pixel| **pixel != 0).count() as u64
}

/// Measures the floor with this renderer's instruction set.
pub fn floor(renderer: &Renderer, budget: Duration) -> BenchFloor {
    floor::measure(renderer.level, LIT, budget)
}

/// How the yardstick is shown.
fn plain() -> Display {
    Display {
        samples: Samples::One,
        grid: false,
        background: Background::Solid(0x20242C),
        cull_back_faces: true,
        ambient: 0.15,
        light: Some(Vec3::new(0.4, 0.6, 0.7).normalize() * 1e4),
        ..Display::default()
    }
}

/// Measures the spheres whose label (`sphere-10k fill gouraud`, …) `wanted` says yes to.
pub fn spheres(renderer: &mut Renderer, budget: Duration, wanted: impl Fn(&str) -> bool) -> Vec<BenchRow> {
    let plain = plain();
    let phong = Display { shading: Shading::Phong, ..plain.clone() };
    let flat = Display { shading: Shading::Flat, ..plain.clone() };
    let four = Display { samples: Samples::Four, ..plain.clone() };
    const FILL: (&str, f32) = ("fill", 2.6);
    const FIGURE: (&str, f32) = ("figure", 5.0);
    const TEN: (&str, u32, u32) = ("sphere-10k", 100, 51);
    const HUNDRED: (&str, u32, u32) = ("sphere-100k", 316, 159);
    const MILLION: (&str, u32, u32) = ("sphere-1m", 1000, 501);
    let list = [
        (TEN, FILL, "gouraud", &plain),
        (TEN, FILL, "flat", &flat),
        (TEN, FILL, "phong", &phong),
        (TEN, FILL, "textured", &plain),
        (TEN, FILL, "gouraud", &four),
        (TEN, FIGURE, "gouraud", &plain),
        (HUNDRED, FILL, "gouraud", &plain),
        (HUNDRED, FILL, "gouraud", &four),
        (HUNDRED, FIGURE, "gouraud", &plain),
        (MILLION, FILL, "gouraud", &plain),
    ];
    let mut rows = Vec::new();
    for ((scene, segments, rings), (view, distance), shading, display) in list {
        let samples = if display.samples == Samples::Four { 4 } else { 1 };
        if !wanted(&label(scene, view, shading, samples)) {
            continue;
        }
        let mut bench_scene = BenchScene::sphere(segments, rings, shading == "textured");
        let camera = bench_scene::camera(distance);
        let times = time(budget, |turn| {
            bench_scene.turn(turn as f32 * 0.01);
            black_box(renderer.draw(&bench_scene.scene, &bench_scene.frame, &camera, display, WIDTH, HEIGHT));
            Stages::of(renderer.stats(), 0.0)
        });
        let triangles = renderer.stats().triangles;
        let lit_pixels = lit_pixels(renderer, &bench_scene.scene, &bench_scene.frame, &camera, display, (WIDTH, HEIGHT));
        rows.push(BenchRow { scene: scene.into(), view, width: WIDTH, height: HEIGHT, triangles, lit_pixels, shading, samples, times });
    }
    rows
}

/// What a row is called: scene, view, shading, and samples where there are more than one.
pub fn label(scene: &str, view: &str, shading: &str, samples: u32) -> String {
    let many = if samples > 1 { " ×4" } else { "" };
    format!("{scene} {view} {shading}{many}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_measures_what_it_is_asked_for() {
        let mut renderer = Renderer::new(Some(1));
        let rows = spheres(&mut renderer, Duration::ZERO, |label| label.starts_with("sphere-10k fill"));
        assert_eq!(rows.len(), 5);
        for row in rows {
            assert!(row.times.min_ms > 0.0 && row.times.min_ms <= row.times.median_ms && row.triangles == 10_000);
            // The disc that a sphere of radius 1 makes at a distance of 2.6, less what the flat sides of its triangles cut away.
            let radius = 1.0 / f64::sqrt(2.6f64.powi(2) - 1.0) / (22.5f64.to_radians()).tan() * 360.0;
            let disc = std::f64::consts::PI * radius * radius;
            assert!((0.985..1.02).contains(&(row.lit_pixels as f64 / disc)), "{} of {disc}", row.lit_pixels);
        }
        let floor = floor(&renderer, Duration::ZERO);
        assert!(floor.clear_ms > 0.0 && floor.z_pass_ms > 0.0 && floor.memcpy_ms > 0.0);
    }
}
