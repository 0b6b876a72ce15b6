//! Draws a moment of a clip: `cargo run --example render_clip -- picture.png walk.dae 0.5` (without a file, the built-in arm).

use std::error::Error;
use std::path::Path;

use sinew_collada::ColladaReader;
use sinew_engine::document::{Document, PoseBuffers, SceneReaders};
use sinew_engine::output::OverwriteGuard;
use sinew_export::png;
use sinew_render::{Display, Framebuffer, RenderJob, Renderer};
use sinew_scene::{Frame, OrbitCamera};

/// Columns and rows of the picture.
const SIZE: [u32; 2] = [640, 480];

/// The document at this moment, seconds on the axis of its file, with the camera fitted round it.
pub(crate) fn draw(document: &Document, time: Option<f64>) -> Result<Framebuffer, Box<dyn Error>> {
    let mut state = document.start_state();
    state.time = time.unwrap_or(state.time);
    // Kept from frame to frame, buffers, frame and renderer allocate nothing more.
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    document.pose(&state, &mut buffers, &mut frame);
    let mut orbit = OrbitCamera::default();
    orbit.fit(&frame.bounds, SIZE[0] as f32 / SIZE[1] as f32);
    let (camera, display) = (orbit.camera(), Display::default());
    let job = RenderJob { scene: &document.scene, frame: &frame, camera: &camera, display: &display, width: SIZE[0], height: SIZE[1] };
    Ok(Renderer::new(None).draw(&job)?.clone())
}

/// Writes the picture, but not over a file that the document is made from.
pub(crate) fn save(document: &Document, picture: &Framebuffer, to: &Path) -> Result<(), Box<dyn Error>> {
    Ok(png::save(&OverwriteGuard::of_document(document).output(to)?, picture, false, &[])?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let to = arguments.next().ok_or("the name of the picture is missing")?;
    let document = match arguments.next() {
        Some(file) => Document::open(&[file], SceneReaders::new(&[&ColladaReader]), &Default::default())?,
        None => Document::built_in(),
    };
    let time = arguments.next().map(|time| time.parse()).transpose()?;
    save(&document, &draw(&document, time)?, Path::new(&to))
}
