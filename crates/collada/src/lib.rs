//! The reader of COLLADA 1.4.0, 1.4.1 and 1.5.0 (`.dae`) and of `.zae` archives.
//!
//! ```
//! use sinew_collada::{ReadErrorKind, read};
//! use sinew_scene::progress::Progress;
//!
//! let error = read(b"<html/>", "page.dae", &Progress::default()).err().unwrap();
//! assert!(matches!(error.kind, ReadErrorKind::NotCollada(_)));
//! ```
//!
//! # How a file is read
//!
//! 1. **Bytes become text** (`archive`, `bundle`, `decode_text`). A `.zae` is told by its content. All documents of an archive that refer to each other are
//!    put together as one text, so that there is one tree; ids and units are looked up in the document that an element belongs to. Byte order marks,
//!    UTF-16 and named encodings end here.
//! 2. **The text is looked over before the XML parser runs** (`xml`, `undeclared_prefixes`). The parser builds its whole tree at once, so one pass over the
//!    tags, which skips text at memory speed, tells first how much that tree will take: a document of nothing but tags is refused before it fills the memory.
//! 3. **Long lists are set aside** (`list_extraction`). Nearly all of a document is lists of numbers, which the parser would go through character by
//!    character only to hand them on. It gets the document with a stand-in for each, and lines stay those of the file.
//! 4. **A second thread reads the lists** (`parallel_lists`, `numbers`), from the last to the first, while the first thread is busy with the rest. What a list
//!    holds follows from its text alone, so it makes no difference who reads it.
//! 5. **Libraries are assembled in the order in which they need each other**: `asset` (unit, axes), `image`, `effect`, `material`; the tree of `nodes`;
//!    then what hangs on the nodes (`instances`, `geometry`, `primitive`, `triangulate`, `vertex_dedup`, `controller`, `skin`, `morph`, `light_camera`), so that
//!    geometry that nothing instantiates costs nothing; last `animation` and `channel_target`, which need all of it.
//! 6. **Findings add up** (`report`, `finding`). A part that is broken is left out with a [`Diagnostic`](sinew_scene::diagnostics::Diagnostic); reading ends early only for what makes the whole
//!    file useless.
//!
//! What that replaced: the parser got the document as it stands and numbers were read digit by digit, which took a third longer; and the thread that
//! builds the scene read all lists by itself.
//!
//! # What a file may ask for
//!
//! Depth, nodes, attributes, entities, instances, the steps of triangulation and what all of it takes in memory are bounded by
//! [`limits`], most of them in proportion to the size of the file. Work is counted before it is done.
//!
//! # What is not read
//!
//! Physics, kinematics, formulas, shaders, splines and B-rep. Where a file has them, a finding says so. Images are named, or handed over as bytes where they
//! lie in the archive; decoding them is the business of others.

mod animation;
mod archive;
mod asset;
mod bind_pose;
mod bundle;
mod channel_target;
mod context;
mod controller;
mod decode_text;
pub mod diagnostic_codes;
mod effect;
mod error;
mod finding;
mod geometry;
mod image;
mod instances;
mod light_camera;
mod list_extraction;
mod lookup;
mod material;
mod morph;
mod morph_target;
mod nodes;
mod numbers;
mod parallel_lists;
mod primitive;
mod report;
mod scene_reader;
mod skin;
mod source;
mod triangulate;
mod undeclared_prefixes;
mod vertex_dedup;
mod xml;

pub use error::{ReadError, ReadErrorKind};
pub use finding::Finding;
pub use scene_reader::ColladaReader;
pub use sinew_scene::import::Asset;

use std::borrow::Cow;

use sinew_scene::Scene;
use sinew_scene::import::ImportedScene;
use sinew_scene::limits;
use sinew_scene::progress::Progress;

use bundle::Bundle;
use channel_target::Aims;
use context::Context;
use controller::Controllers;
use geometry::Geometries;
use image::Images;
use instances::{Libraries, Sharing};
use light_camera::LightsAndCameras;
use material::Materials;
use nodes::Tree;
use parallel_lists::Ahead;
use report::Report;

/// An element of the document.
type El<'a> = roxmltree::Node<'a, 'a>;

/// The name of the format.
const FORMAT: &str = "COLLADA";

/// Everything read from one file. Its graph has one root, the asset node; images inside a `.zae` are by their path in the archive.
pub type ColladaScene = ImportedScene<Finding>;

/// Reads a document from its bytes, a `.dae` or a `.zae`, told apart by content. `name` is the file's name: it stands in messages, on the root node, and
/// tells references to the file itself from those to other files.
///
/// # Errors
/// [`ReadError`] where nothing of the file can be shown: not XML, not COLLADA, a limit broken, cancelled.
pub fn read(bytes: &[u8], name: &str, progress: &Progress) -> Result<ColladaScene, ReadError> {
    progress.set_share(0.0);
    if bytes.len() as u64 > limits::FILE_BYTES {
        return Err(ReadErrorKind::TooLarge.into());
    }
    if archive::is_archive(bytes) {
        return archive::read(bytes, name, progress);
    }
    read_document(bytes, name, Bundle::alone(name), progress, None)
}

/// Reads one document with what is bundled with it; `room` is what it may take in bytes where that does not follow from its size.
fn read_document(
    bytes: &[u8],
    name: &str,
    mut bundle: Bundle,
    progress: &Progress,
    room: Option<usize>,
) -> Result<ColladaScene, ReadError> {
    let mut decoded = decode_text::decode(bytes);
    let mut stretches = Vec::new();
    if let Some((whole, parts)) = bundle.compose(&decoded.text, decoded.lines_before) {
        (decoded.text, stretches) = (Cow::Owned(whole), parts);
    }
    let text = decoded.text.as_ref();
    let shift = |mut error: ReadError| {
        error.line = error.line.map(|line| line + decoded.lines_before);
        error
    };
    // Other encodings are held a second time, as UTF-8.
    let decoded_size = if matches!(decoded.text, Cow::Owned(_)) { text.len() } else { 0 };
    let room = room.map(|room| room.saturating_sub(decoded_size));
    let surveyed = xml::look_at(text, room).map_err(shift)?;
    let parsed = xml::parse(&surveyed).map_err(shift)?;
    let paths: Vec<String> = std::iter::once(bundle.path.clone()).chain(stretches.iter().map(|part| part.path.clone())).collect();
    let mut report = Report::new(parsed.lists, decoded.lines_before, stretches);
    report.bring(bundle.findings);
    let root = parsed.document.root_element();
    if root.tag_name().name() != "COLLADA" {
        let kind = ReadErrorKind::NotCollada(context::shortened(root.tag_name().name()));
        return Err(ReadError::in_line(report.line(root), kind));
    }
    if let Some(named) = &decoded.misfit {
        report.report_file(Finding::WrongEncoding(named.clone()));
    }
    for undeclared in &surveyed.undeclared {
        report.report_at(parsed.lists.place(undeclared.at), Finding::UndeclaredPrefix(context::shortened(&undeclared.prefix)));
    }
    let ahead = Ahead::of(root, parsed.lists);
    let mut context = Context::new(&parsed, &ahead, report, paths, &bundle.files, progress);
    context.advance(0.2)?;
    ahead.while_doing(|| assemble(&mut context, name))
}

/// Reads the libraries in the order in which they need each other.
fn assemble(context: &mut Context<'_>, name: &str) -> Result<ColladaScene, ReadError> {
    let asset = asset::read(context)?;
    skipped_libraries(context);
    let mut scene = Scene::default();
    let mut images = Images::read(context, &mut scene);
    let materials = Materials::read(context, &mut scene, &mut images)?;
    context.advance(0.3)?;
    let tree = Tree::read(context, &mut scene, &asset, file_stem(name))?;
    context.advance(0.4)?;
    let mut geometries = Geometries::new(context.root.descendants().any(|element| element.tag_name().name() == "morph"));
    let (mut controllers, mut lights) = (Controllers::default(), LightsAndCameras::default());
    let mut libraries = Libraries {
        geometries: &mut geometries,
        controllers: &mut controllers,
        materials: &materials,
        lights: &mut lights,
        tree: &tree,
        asset: &asset,
        rest: bind_pose::rest(&scene.graph),
        sharing: Sharing::default(),
    };
    libraries.hang_all(context, &mut scene)?;
    drop(geometries);
    context.advance(0.8)?;
    let clips = animation::read(context, &Aims::new(&tree, &materials, &lights, &controllers))?;
    // Last, so that a flood of them keeps nothing else from being told.
    for repeated in context.lookup.repeated() {
        context.report.report(repeated, Finding::RepeatedId);
    }
    context.advance(1.0)?;
    Ok(ColladaScene { asset, scene, clips, findings: context.report.finish(), archived: images.embedded })
}

/// Names the parts of the format that are not shown, where a file has any.
fn skipped_libraries(context: &mut Context<'_>) {
    let skipped =
        ["library_formulas", "library_joints", "library_kinematics_models", "library_kinematics_scenes", "library_articulated_systems"];
    for library in skipped.iter().flat_map(|tag| context.libraries(tag)).collect::<Vec<_>>() {
        let has_content =
            |library: &El<'_>| library.children().any(|child| child.is_element() && !matches!(child.tag_name().name(), "asset" | "extra"));
        if has_content(&library) {
            context.report.report(library, Finding::UnsupportedElement(library.tag_name().name().to_owned()));
        }
    }
}

/// A file's name without folder and ending.
fn file_stem(name: &str) -> &str {
    let last = lookup::last_segment(name);
    match last.rsplit_once('.') {
        Some((stem, _)) if !stem.is_empty() => stem,
        _ => last,
    }
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
