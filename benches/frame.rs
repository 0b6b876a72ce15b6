//! Whole frames: pose, skin, draw. Prints medians in milliseconds and the share of each stage, beside copying the same picture.

mod support;

use std::hint::black_box;
use std::path::{Path, PathBuf};

use sinew::document::{Document, PoseBuffers};
use sinew::formats::SCENE_READERS;
use sinew::progress::Progress;
use sinew::render::{Display, RenderJob, Renderer, Samples};
use sinew::scene::{Frame, OrbitCamera};

/// The files to draw: those that ship, and larger ones beside the checkout where they are.
fn files() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let shared = std::env::var_os("SINEW_SHARED").map_or_else(|| root.join("../shared"), PathBuf::from);
    let shipped = ["biceps.yaml", "biceps-measured.yaml", "curl.dae", "walker.dae"].map(|name| root.join("configs").join(name));
    let others = ["walk.dae", "raptor_attack.dae", "tethys_fbx.dae"].map(|name| shared.join("models").join(name));
    shipped.into_iter().chain(others).filter(|path| path.exists()).collect()
}

fn main() {
    println!("file, size: ms a frame (pose + draw), 1 and 4 samples a pixel; × copying the picture");
    for path in files() {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let document = match Document::open(&[&path], SCENE_READERS, &Progress::default()) {
            Ok(document) => document,
            Err(error) => {
                println!("{error}");
                continue;
            }
        };
        for (width, height) in [(800, 600), (1280, 720), (1920, 1080)] {
            let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
            let start = document.start_state();
            document.pose(&start, &mut buffers, &mut frame);
            let mut orbit = OrbitCamera::default();
            orbit.fit(&frame.bounds, width as f32 / height as f32);
            let camera = orbit.camera();
            let mut renderer = Renderer::new(None);
            let duration = document.clips.first().map_or(0.0, |clip| clip.duration());
            let floor = support::copy_time(width * height * 4);
            let mut step = 0u32;
            let mut medians = [Samples::One, Samples::Four].map(|samples| {
                let display = Display { samples, ..Display::default() };
                support::median(|| {
                    step += 1;
                    // A different moment every time, so that nothing is drawn from memory.
                    let share = f64::from(step % 97) / 97.0;
                    let drive = document.driven_rig().map_or(start.joints.drive, |rig| rig.at_contraction(share * 100.0));
                    let state = start.at_time(start.time + share * duration).with_drive(drive);
                    document.pose(&state, &mut buffers, &mut frame);
                    let (scene, width, height) = (&document.scene, width as u32, height as u32);
                    let job = RenderJob { scene, frame: &frame, camera: &camera, display: &display, width, height };
                    black_box(renderer.draw(&job).expect("there is memory for the picture"));
                })
            });
            let pose = support::median(|| document.pose(black_box(&start), &mut buffers, &mut frame));
            let ratios = medians.map(|median| median / floor);
            medians.iter_mut().for_each(|median| *median *= 1e3);
            println!(
                "{name}, {width}×{height}: {:.2} and {:.2} ms, of which the pose {:.2} ms; {:.0} × and {:.0} × the copy",
                medians[0],
                medians[1],
                pose * 1e3,
                ratios[0],
                ratios[1]
            );
        }
    }
}
