//! What lies under a pixel of a picture that nobody draws: `cargo run --example pick -- 320 240 walk.dae` (without a file, the built-in arm).

use std::error::Error;

use glam::Vec3;
use sinew_collada::ColladaReader;
use sinew_engine::document::{Document, PoseBuffers, SceneReaders};
use sinew_render::{Display, PickJob, RenderJob, Renderer};
use sinew_scene::{Frame, OrbitCamera};

/// Columns and rows of the picture.
pub(crate) const SIZE: [u32; 2] = [640, 480];

/// The name of the node under a pixel, and the point of it, metres in the world.
pub(crate) fn pick(document: &Document, x: f32, y: f32) -> Result<Option<(String, Vec3)>, Box<dyn Error>> {
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    document.pose(&document.start_state(), &mut buffers, &mut frame);
    let mut orbit = OrbitCamera::default();
    orbit.fit(&frame.bounds, SIZE[0] as f32 / SIZE[1] as f32);
    let (camera, display) = (orbit.camera(), Display::default());
    let picture = RenderJob { scene: &document.scene, frame: &frame, camera: &camera, display: &display, width: SIZE[0], height: SIZE[1] };
    let hit = Renderer::new(Some(1)).pick(&PickJob { picture, x, y })?;
    Ok(hit.map(|hit| (document.scene.graph.label(hit.node).plain().into_owned(), hit.point)))
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let x = arguments.next().map_or(Ok(SIZE[0] as f32 / 2.0), |x| x.parse())?;
    let y = arguments.next().map_or(Ok(SIZE[1] as f32 / 2.0), |y| y.parse())?;
    let document = match arguments.next() {
        Some(file) => Document::open(&[file], SceneReaders::new(&[&ColladaReader]), &Default::default())?,
        None => Document::built_in(),
    };
    match pick(&document, x, y)? {
        Some((name, point)) => println!("{name} at {point:.3}"),
        None => println!("nothing"),
    }
    Ok(())
}
