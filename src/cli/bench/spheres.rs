//! The spheres of the benchmark, which every renderer can draw.
//!
//! The sphere has radius 1 and is lit by one far light, back faces are left out, and the picture is 1280 × 720 with a vertical field of view
//! of 45°. "Fill" stands 2.6 in front of the camera and covers 411 thousand pixels, "figure" stands at 5.0. The sphere turns by 0.01 rad a frame. A frame is
//! everything from clearing to finished pixels in memory.

use std::hint::black_box;
use std::time::Duration;

use glam::Vec3;

use super::bench_scene::{self, BenchScene};
use super::timing::{BenchTimes, Stages, time};
use crate::render::{Background, Display, RenderError, RenderJob, Renderer, Samples, Shading};

/// Size of the picture, pixels.
pub(super) const WIDTH: u32 = 1280;
/// See [`WIDTH`].
pub(super) const HEIGHT: u32 = 720;
/// One scene that was measured.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BenchRow {
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

/// Pixels that something stands on.
pub(super) fn lit_pixels(renderer: &mut Renderer, job: &RenderJob<'_>) -> Result<u64, RenderError> {
    let display = Display { background: Background::Transparent, ..job.display.clone() };
    let picture = renderer.draw(&RenderJob { display: &display, ..*job })?;
    Ok(picture.pixels.iter().filter(|pixel| **pixel != 0).count() as u64)
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
pub(super) fn spheres(renderer: &mut Renderer, budget: Duration, wanted: impl Fn(&str) -> bool) -> Result<Vec<BenchRow>, RenderError> {
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
            black_box(renderer.draw(&bench_scene.job(&camera, display))?);
            Ok::<_, RenderError>(Stages::of(renderer.stats(), 0.0))
        })?;
        let triangles = renderer.stats().triangles;
        let lit_pixels = lit_pixels(renderer, &bench_scene.job(&camera, display))?;
        rows.push(BenchRow { scene: scene.into(), view, width: WIDTH, height: HEIGHT, triangles, lit_pixels, shading, samples, times });
    }
    Ok(rows)
}

/// What a row is called: scene, view, shading, and samples where there are more than one.
pub(super) fn label(scene: &str, view: &str, shading: &str, samples: u32) -> String {
    let many = if samples > 1 { " ×4" } else { "" };
    format!("{scene} {view} {shading}{many}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_measures_what_it_is_asked_for() {
        let mut renderer = Renderer::new(Some(1));
        let rows = spheres(&mut renderer, Duration::ZERO, |label| label.starts_with("sphere-10k fill")).expect("there is memory for it");
        assert_eq!(rows.len(), 5);
        for row in rows {
            assert!(row.times.min_ms > 0.0 && row.times.min_ms <= row.times.median_ms && row.triangles == 10_000);
            // The disc that a sphere of radius 1 makes at a distance of 2.6, less what the flat sides of its triangles cut away.
            let radius = 1.0 / f64::sqrt(2.6f64.powi(2) - 1.0) / (22.5f64.to_radians()).tan() * 360.0;
            let disc = std::f64::consts::PI * radius * radius;
            assert!((0.985..1.02).contains(&(row.lit_pixels as f64 / disc)), "{} of {disc}", row.lit_pixels);
        }
        let floor = super::super::floor::measure(&renderer, Duration::ZERO);
        assert!(floor.clear_ms > 0.0 && floor.z_pass_ms > 0.0 && floor.memcpy_ms > 0.0);
    }
}
