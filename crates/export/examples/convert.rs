//! Writes a document as glTF 2.0: `cargo run --example convert -- walk.glb walk.dae` (without a file, the built-in arm).

use std::error::Error;
use std::path::Path;

use sinew_collada::ColladaReader;
use sinew_engine::document::{Document, SceneReaders};
use sinew_engine::output::OverwriteGuard;
use sinew_export::gltf::{self, GltfContainer};
use sinew_scene::message::ToMessage;

/// Writes the file; returns what the format could not hold, as a log would have it.
pub(crate) fn convert(document: &Document, to: &Path) -> Result<Vec<String>, Box<dyn Error>> {
    let container = GltfContainer::of(to).ok_or("the file is to end in .glb or .gltf")?;
    let output = OverwriteGuard::of_document(document).output(to)?;
    let unsupported = gltf::save(&output, container, document)?;
    Ok(unsupported.iter().map(|feature| feature.message().to_string()).collect())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let to = arguments.next().ok_or("the name of the glTF file is missing")?;
    let document = match arguments.next() {
        Some(file) => Document::open(&[file], SceneReaders::new(&[&ColladaReader]), &Default::default())?,
        None => Document::built_in(),
    };
    convert(&document, Path::new(&to))?.iter().for_each(|lost| println!("left out: {lost}"));
    Ok(())
}
