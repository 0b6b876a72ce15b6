//! Where the vertices of a posed document are: `cargo run --example pose_vertices -- walk.dae 0.5` (without a file, the built-in arm).

use std::error::Error;

use glam::Vec3;
use sinew_collada::ColladaReader;
use sinew_engine::document::{Document, PoseBuffers, SceneReaders};
use sinew_scene::Frame;

/// Surface by surface: what its node is called, and its vertices in the world, metres.
pub(crate) fn vertices(document: &Document, time: Option<f64>) -> Vec<(String, Vec<Vec3>)> {
    let mut state = document.start_state();
    state.time = time.unwrap_or(state.time);
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    document.pose(&state, &mut buffers, &mut frame);
    let of_surface = |surface: &sinew_scene::Surface| {
        let count = surface.mesh.positions.len() as u32;
        (document.scene.graph.label(surface.node).plain().into_owned(), (0..count).map(|v| surface.position(v)).collect())
    };
    frame.surfaces.iter().map(of_surface).collect()
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let document = match arguments.next() {
        Some(file) => Document::open(&[file], SceneReaders::new(&[&ColladaReader]), &Default::default())?,
        None => Document::built_in(),
    };
    let time = arguments.next().map(|time| time.parse()).transpose()?;
    for (name, vertices) in vertices(&document, time) {
        println!("{name}: {} vertices, the first at {:?}", vertices.len(), vertices.first());
    }
    Ok(())
}
