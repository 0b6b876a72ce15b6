//! Sequences and conversions: seconds of work per second of video, for a clip in 1280 × 720 at 25 frames a second, and milliseconds a conversion to glTF.
//!
//! Runs on the demos and, where they are there, on larger shared models. Every core works, so this one wants a machine that does nothing else. A ratio
//! below 1 is faster than the sequence plays.

use std::path::{Path, PathBuf};
use std::time::Instant;

use sinew::document::Document;
use sinew::export::gltf;
use sinew::formats::SCENE_READERS;
use sinew::output::OverwriteGuard;
use sinew::progress::Progress;
use sinew::scene::ViewDirection;
use sinew::sequence::{self, Direction, FittedOrbit, OutputTarget, Sequence, SequenceOptions, SequenceRenderer};
use sinew::view::ViewState;

const SIZE: (u32, u32) = (1280, 720);
/// Seconds of the sequence.
const SECONDS: f64 = 4.0;
/// Runs of each, of which the quickest counts.
const RUNS: usize = 3;

/// Draws the start of a document's clip into `out`; seconds of work, frames and seconds of the sequence. `None` for what does not move.
fn shoot(document: &Document, out: &Path) -> Option<(f64, usize, f64)> {
    let state = document.start_state();
    let clip = document.clips.get(state.clip?)?;
    let end = clip.end.min(clip.start + SECONDS - 1.0 / sequence::DEFAULT_FPS);
    let wish = SequenceOptions { from: Some(clip.start), to: Some(end), ..SequenceOptions::default() };
    let sequence = Sequence::new(&wish, document, state.clone()).ok()?;
    let (yaw, pitch) = ViewDirection::Start.angles();
    let eye = FittedOrbit::fit(
        Direction { yaw, pitch, parallel: false, zoom: 1.0 },
        &document.motion_bounds(&state),
        SIZE.0 as f32 / SIZE.1 as f32,
        false,
    );
    let target = OutputTarget::of(out)?;
    let begun = Instant::now();
    let mut studio = SequenceRenderer::new(document, sequence.clone(), ViewState::orbiting(eye.orbit()), None);
    sequence::save(&mut studio, SIZE, (&target, &OverwriteGuard::default()), &|_| String::new(), &Progress::default()).ok()?;
    Some((begun.elapsed().as_secs_f64(), sequence.count, sequence.seconds()))
}

fn sequences(name: &str, document: &Document, folder: &Path) {
    for out in ["frame-%04d.png", "film.gif", "film.apng"] {
        let runs = (0..RUNS).filter_map(|_| shoot(document, &folder.join(out)));
        if let Some((took, frames, seconds)) = runs.min_by(|a, b| a.0.total_cmp(&b.0)) {
            println!("{name:<28} {out:<15} {frames:>4} frames, {took:>6.2} s: {:.2} s a second shown", took / seconds);
        }
    }
}

fn conversion(name: &str, file: &Path, folder: &Path) {
    let once = || {
        let begun = Instant::now();
        let document = Document::open(&[file], SCENE_READERS, &Progress::default()).ok()?;
        gltf::save(&OverwriteGuard::default().output(&folder.join("out.glb")).ok()?, gltf::GltfContainer::Binary, &document).ok()?;
        Some(begun.elapsed().as_secs_f64())
    };
    let bytes = std::fs::metadata(file).map_or(0, |found| found.len());
    if let Some(took) = (0..RUNS).filter_map(|_| once()).min_by(f64::total_cmp) {
        println!("{name:<28} {:>6.2} MB to .glb in {:>6.1} ms", bytes as f64 / 1e6, took * 1e3);
    }
}

fn main() {
    let Ok(folder) = tempfile::tempdir() else { return };
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let shared = std::env::var_os("SINEW_SHARED").map_or_else(|| here.join("../shared"), PathBuf::from).join("models");
    let demos = ["walker", "atlas"].map(|name| here.join("configs").join(format!("{name}.dae")));
    let models = ["walk", "tethys_fbx", "monster_max_opencollada"].map(|name| shared.join(format!("{name}.dae")));
    for file in demos.iter().chain(&models).filter(|file| file.is_file()) {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        conversion(&name, file, folder.path());
        if let Ok(document) = Document::open(&[file], SCENE_READERS, &Progress::default()) {
            sequences(&name, &document, folder.path());
        }
    }
}
