//! `sinew bench`: speed of the rasterizer on this machine, with the floor that no program gets below.

mod bench_scene;
mod floor;
mod spheres;
mod timing;

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::{Duration, Instant};

use clap::ArgMatches;
use serde::Serialize;

use super::output::{Failure, display_name, print_json, print_result};
use super::text_table::columns;
use super::{files, value};
use crate::document::{Document, PoseBuffers};
use crate::formats::SCENE_READERS;
use crate::i18n::decimal;
use crate::progress::Progress;
use crate::render::{Display, RenderError, RenderJob, Renderer, Samples};
use crate::scene::{Frame, OrbitCamera};
use crate::tr;
use spheres::{BenchRow, label, lit_pixels};
use timing::{Stages, time};

/// Sizes that models are drawn in.
const SIZES: [(u32, u32); 2] = [(800, 600), (1920, 1080)];
/// Moments of a movement that frames are taken from in turn.
const MOMENTS: u32 = 97;

/// What was measured, for a program.
#[derive(Debug, Serialize)]
struct BenchReport {
    simd: &'static str,
    threads: usize,
    floor: FloorReport,
    scenes: Vec<BenchSceneReport>,
}

#[derive(Debug, Serialize)]
struct FloorReport {
    clear_ms: f64,
    z_pass_ms: f64,
    memcpy_ms: f64,
}

#[derive(Debug, Serialize)]
struct BenchSceneReport {
    scene: String,
    view: &'static str,
    width: u32,
    height: u32,
    triangles: u64,
    lit_pixels: u64,
    shading: &'static str,
    samples: u32,
    min_ms: f64,
    median_ms: f64,
    stages: StageTimes,
}

#[derive(Debug, Serialize)]
struct StageTimes {
    pose_ms: f64,
    vertex_ms: f64,
    raster_ms: f64,
    resolve_ms: f64,
}

impl From<BenchRow> for BenchSceneReport {
    fn from(row: BenchRow) -> Self {
        let Stages { pose_ms, vertex_ms, raster_ms, resolve_ms } = row.times.stages;
        Self {
            scene: row.scene,
            view: row.view,
            width: row.width,
            height: row.height,
            triangles: row.triangles,
            lit_pixels: row.lit_pixels,
            shading: row.shading,
            samples: row.samples,
            min_ms: row.times.min_ms,
            median_ms: row.times.median_ms,
            stages: StageTimes { pose_ms, vertex_ms, raster_ms, resolve_ms },
        }
    }
}

/// Runs the subcommand.
pub(super) fn run(given: &ArgMatches) -> Result<(), Failure> {
    let budget = Duration::from_secs_f64(value::<f64>(given, "seconds").unwrap_or(1.0));
    let only = value::<String>(given, "scene");
    let wanted = |label: &str| only.as_deref().is_none_or(|part| label.contains(part));
    // Files are opened first: a wrong name should not cost half a minute.
    let mut models = vec![("biceps".to_owned(), Document::built_in())];
    for file in files(given) {
        let name = file.file_name().map_or_else(|| display_name(&file), |name| name.to_string_lossy().into_owned());
        models.push((name, Document::open(&[file], SCENE_READERS, &Progress::default())?));
    }
    let mut renderer = Renderer::new(value(given, "threads"));
    let mut rows = spheres::spheres(&mut renderer, budget, wanted)?;
    for (name, document) in &models {
        for size in SIZES {
            for samples in [Samples::One, Samples::Four] {
                let display = Display { samples, ..Display::default() };
                let size_too = format!("{} {}×{}", label(name, "moving", "gouraud", count(samples)), size.0, size.1);
                if wanted(&size_too) {
                    rows.push(model(&mut renderer, name, document, &display, size, budget)?);
                }
            }
        }
    }
    if let Some(text) = only.filter(|_| rows.is_empty()) {
        return Err(Failure::usage(tr!("cli-bench-no-scene", text = text)));
    }
    let floor = floor::measure(&renderer, budget);
    let report = BenchReport {
        simd: renderer.simd(),
        threads: renderer.threads(),
        floor: FloorReport { clear_ms: floor.clear_ms, z_pass_ms: floor.z_pass_ms, memcpy_ms: floor.memcpy_ms },
        scenes: rows.into_iter().map(BenchSceneReport::from).collect(),
    };
    if given.get_flag("json") { print_json(&report) } else { print_result(&report.text()) }
}

fn count(samples: Samples) -> u32 {
    if samples == Samples::Four { 4 } else { 1 }
}

/// Poses, deforms and draws a document at another moment of its movement each frame, as the window shows it when it opens.
fn model(
    renderer: &mut Renderer,
    name: &str,
    document: &Document,
    display: &Display,
    (width, height): (u32, u32),
    budget: Duration,
) -> Result<BenchRow, RenderError> {
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let start = document.start_state();
    let mut orbit = OrbitCamera::default();
    let reach = document.motion_bounds(&start);
    orbit.fit(&reach, width as f32 / height as f32);
    let display = &Display { ground: Some(reach), ..display.clone() };
    let camera = orbit.camera();
    let duration = document.clips.first().map_or(0.0, |clip| clip.duration());
    let mut draw = |renderer: &mut Renderer, step: u32| {
        let share = f64::from(step % MOMENTS) / f64::from(MOMENTS);
        let drive = document.driven_rig().map_or(start.joints.drive, |rig| rig.at_contraction(share * 100.0));
        let begin = Instant::now();
        document.pose(&start.at_time(start.time + share * duration).with_drive(drive), &mut buffers, &mut frame);
        let pose_ms = begin.elapsed().as_secs_f64() * 1e3;
        let job = RenderJob { scene: &document.scene, frame: &frame, camera: &camera, display, width, height };
        black_box(renderer.draw(&job)?);
        Ok::<_, RenderError>(Stages::of(renderer.stats(), pose_ms))
    };
    let times = time(budget, |step| draw(renderer, step))?;
    let triangles = renderer.stats().triangles;
    let bare = Display { grid: false, ..display.clone() };
    let job = RenderJob { scene: &document.scene, frame: &frame, camera: &camera, display: &bare, width, height };
    let lit_pixels = lit_pixels(renderer, &job)?;
    Ok(BenchRow {
        scene: name.to_owned(),
        view: "moving",
        width,
        height,
        triangles,
        lit_pixels,
        shading: "gouraud",
        samples: count(display.samples),
        times,
    })
}

impl BenchReport {
    fn text(&self) -> String {
        let ms = |value: f64| decimal(value, 3);
        let mut rows = vec![vec![
            tr!("cli-bench-scene"),
            tr!("cli-bench-size"),
            tr!("cli-bench-triangles"),
            tr!("cli-bench-median"),
            tr!("cli-bench-min"),
            tr!("cli-bench-pose"),
            tr!("cli-bench-vertices"),
            tr!("cli-bench-raster"),
            tr!("cli-bench-resolve"),
        ]];
        rows.extend(self.scenes.iter().map(|scene| {
            let StageTimes { pose_ms, vertex_ms, raster_ms, resolve_ms } = scene.stages;
            let mut row = vec![
                label(&scene.scene, scene.view, scene.shading, scene.samples),
                format!("{}×{}", scene.width, scene.height),
                scene.triangles.to_string(),
            ];
            row.extend([scene.median_ms, scene.min_ms, pose_ms, vertex_ms, raster_ms, resolve_ms].map(ms));
            row
        }));
        let mut text = columns(&rows);
        let FloorReport { clear_ms, z_pass_ms, memcpy_ms } = self.floor;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", tr!("cli-bench-floor", clear = ms(clear_ms), pass = ms(z_pass_ms), copy = ms(memcpy_ms)));
        let _ = writeln!(text, "{}", tr!("cli-bench-made", simd = self.simd, threads = self.threads));
        text
    }
}
