//! What small files may ask for: memory within the bounds that the README names, time in proportion to the file and to what is made of it.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::build::*;
use crate::counting::peak;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use sinew::document::{Document, ImageLoading, OpenOptions};
use sinew::export::gltf::{self, GltfContainer};
use sinew::formats::SCENE_READERS;
use sinew::limits;
use sinew::output::Output;
use sinew::progress::Progress;
use sinew::scene::Content;

/// Opens `text` as a file and looks at no picture.
fn open(folder: &Path, text: &str) -> Document {
    let file = folder.join("a.dae");
    std::fs::write(&file, text).expect("written");
    Document::open_with(&[file], OpenOptions { images: ImageLoading::Locate, ..OpenOptions::new(SCENE_READERS) }, &Progress::default())
        .expect("usable")
}

/// Opens `text` within what reading may take: ten times the file and 64 MB.
fn open_within_bounds(folder: &Path, what: &str, text: &str) -> Document {
    let (document, held) = peak(|| open(folder, text));
    let allowed = 10 * text.len() + (64 << 20);
    println!("{what}: {} kB of file, {} MB held", text.len() >> 10, held >> 20);
    assert!(held <= allowed, "{what}: {} bytes of file took {} MB", text.len(), held >> 20);
    document
}

fn reached_limit(document: &Document) -> bool {
    document.diagnostics.iter().any(|finding| finding.code() == "limit-reached")
}

fn hung(document: &Document) -> usize {
    let meshes = document.scene.graph.iter().flat_map(|(_, node)| &node.contents);
    meshes.filter(|content| matches!(content, Content::Mesh(_))).count()
}

fn converted(folder: &Path, document: &Document) -> (Result<Vec<gltf::UnsupportedFeature>, sinew::export::ExportError>, PathBuf) {
    let file = folder.join("a.glb");
    (gltf::save(&Output::of_program(&file), GltfContainer::Binary, document), file)
}

/// Nodes of a library that hold instances of later ones: `edges[i]` are the steps forward from node i.
fn graph_of(edges: &[Vec<usize>]) -> String {
    let mut nodes = String::new();
    for (i, steps) in edges.iter().enumerate() {
        let _ = write!(nodes, "<node id='b{i}'><translate sid='t'>1 0 0</translate>");
        for step in steps.iter().filter(|step| i + **step < edges.len()) {
            let _ = write!(nodes, "<instance_node url='#b{}'/>", i + step);
        }
        nodes.push_str("<instance_geometry url='#g'/></node>");
    }
    document(&format!("{}<library_nodes>{nodes}</library_nodes>{}", triangle(), scene("<node><instance_node url='#b0'/></node>")))
}

fn instancing_of_any_shape_stays_within_bounds(folder: &Path) {
    let mut runner = TestRunner::new(Config { cases: 12, failure_persistence: None, ..Config::default() });
    let edges = proptest::collection::vec(proptest::collection::vec(1_usize..4, 0..4), 1..60);
    runner
        .run(&edges, |edges| {
            let document = open_within_bounds(folder, "random instancing", &graph_of(&edges));
            prop_assert!(document.scene.graph.len() <= limits::NODES);
            prop_assert!(hung(&document) <= document.scene.graph.len());
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
    // A tree that would have 2⁴⁰ leaves.
    let bomb = open_within_bounds(folder, "doubling instances", &graph_of(&vec![vec![1, 1]; 40]));
    assert!(reached_limit(&bomb) && bomb.scene.graph.len() > 10_000);
    let (result, file) = converted(folder, &bomb);
    assert!(result.is_ok() && std::fs::metadata(file).expect("written").len() < 64 << 20);
}

/// A mesh of `parts` parts on `count` nodes; with `colours` materials each node binds another one.
fn parts_on_nodes(parts: usize, count: usize, colours: usize) -> String {
    let mut primitives = String::new();
    for i in 0..parts {
        let _ = write!(
            primitives,
            "<triangles material='m{i}' count='1'><input semantic='VERTEX' source='#g-v' offset='0'/><p>0 1 2</p></triangles>"
        );
    }
    let mut libraries = String::from(
        "<library_effects><effect id='e'><profile_COMMON><technique><constant/></technique></profile_COMMON></effect></library_effects><library_materials>",
    );
    for i in 0..colours {
        let _ = write!(libraries, "<material id='c{i}'><instance_effect url='#e'/></material>");
    }
    libraries.push_str("</library_materials>");
    let nodes: String = (0..count)
        .map(|i| {
            let bind = format!(
                "<bind_material><technique_common><instance_material symbol='m0' target='#c{}'/></technique_common></bind_material>",
                i % colours.max(1)
            );
            format!(
                "<node><translate>{i} 0 0</translate><instance_geometry url='#g'>{}</instance_geometry></node>",
                if colours > 0 { bind } else { String::new() }
            )
        })
        .collect();
    document(&(libraries + &geometries(&geometry("g", "0 0 0 1 0 0 0 1 0", &primitives)) + &scene(&nodes)))
}

fn instances_share_what_they_have_in_common(folder: &Path) {
    let document = open_within_bounds(folder, "many parts on many nodes", &parts_on_nodes(500, 2_000, 0));
    assert!(reached_limit(&document), "two million parts are more than is drawn");
    let instances = hung(&document);
    assert!((100..2_000).contains(&instances), "{instances}");
    let (result, held) = peak(|| converted(folder, &document));
    let length = std::fs::metadata(&result.1).expect("written").len();
    assert!(result.0.is_ok() && length < 2 << 20, "one mesh on all nodes: {length}");
    assert!(held < 64 << 20, "{} MB", held >> 20);
    // Each node with a material of its own: nothing to share, so what converting takes is bounded by what is drawn.
    let document = open_within_bounds(folder, "many parts in many colours", &parts_on_nodes(500, 400, 400));
    let (result, held) = peak(|| converted(folder, &document));
    assert!(held <= limits::CONVERTED_BYTES, "{} MB", held >> 20);
    assert!(result.0.is_ok());
}

/// The shortest of three runs.
fn shortest(mut work: impl FnMut()) -> Duration {
    let mut once = || {
        let begun = Instant::now();
        work();
        begun.elapsed()
    };
    once().min(once()).min(once())
}

/// Four times as much takes about four times as long: sixteen times would be quadratic.
fn takes_linear_time(folder: &Path, what: &str, n: usize, text: impl Fn(usize) -> String) {
    let (small, large) = (text(n), text(4 * n));
    let (short, long) = (shortest(|| drop(open(folder, &small))), shortest(|| drop(open(folder, &large))));
    println!("{what}: {short:?}, four times as much {long:?}");
    // What is over in a moment is not measured.
    assert!(long < short * 9 || long < Duration::from_millis(60), "{what}: {short:?}, four times as much {long:?}");
}

fn repeated_names_take_linear_time(folder: &Path) {
    takes_linear_time(folder, "repeated ids without a scene", 4_000, |n| {
        format!(
            "<COLLADA version='1.4.1'><library_nodes>{}</library_nodes></COLLADA>",
            "<node id='x'><instance_node url='#x'/></node>".repeat(n)
        )
    });
    for (library, tag, inside) in [
        ("library_geometries", "geometry", "<mesh/>"),
        ("library_materials", "material", "<instance_effect url='#x'/>"),
        ("library_effects", "effect", "<profile_COMMON><technique><constant/></technique></profile_COMMON>"),
        ("library_images", "image", "<init_from>x.png</init_from>"),
        ("library_cameras", "camera", "<optics/>"),
        ("library_animations", "animation", "<source id='x'/>"),
    ] {
        takes_linear_time(folder, library, 3_000, |n| {
            let all = format!("<{tag} id='x'>{inside}</{tag}>").repeat(n);
            let uses = "<node><instance_geometry url='#x'/><instance_camera url='#x'/></node>".repeat(n / 2);
            document(&(format!("<{library}>{all}</{library}>") + &scene(&uses)))
        });
    }
    takes_linear_time(folder, "repeated scoped ids", 2_000, |n| {
        let transforms: String = (0..n).map(|i| format!("<translate sid='t{i}'>0 0 0</translate>")).collect();
        let channels: String = (0..n).map(|i| format!("<animation><channel source='#a-s' target='n/t{i}.X'/></animation>")).collect();
        let moved = animation("a", "n/t0.X", "0 1", "X", "0 1", "LINEAR LINEAR");
        document(&(animations(&(moved + &channels)) + &scene(&format!("<node id='n'>{transforms}</node>"))))
    });
    takes_linear_time(folder, "joints of one name", 1_500, |n| {
        let joints = "<node sid='j' name='j' type='JOINT'/>".repeat(n);
        let instances = "<node><instance_controller url='#c'/></node>".repeat(20);
        let skin = format!(
            "<library_controllers><controller id='c'><skin source='#g'>{}{}{}<joints><input semantic='JOINT' source='#cj'/><input semantic='INV_BIND_MATRIX' source='#cm'/></joints><vertex_weights count='3'><input semantic='JOINT' source='#cj' offset='0'/><input semantic='WEIGHT' source='#cw' offset='1'/><vcount>1 1 1</vcount><v>0 0 0 0 0 0</v></vertex_weights></skin></controller></library_controllers>",
            names("cj", "Name_array", "JOINT", "j"),
            matrices("cm", &[glam::DMat4::IDENTITY]),
            floats("cw", "WEIGHT", "1"),
        );
        let others: String = (0..n).map(|i| format!("<node sid='k{i}'/>")).collect();
        document(&(triangle() + &skin + &scene(&(joints + &others + &instances))))
    });
    takes_linear_time(folder, "parts and instances", 60, |n| parts_on_nodes(50, n * 10, 1));
}

pub(crate) fn small_files_ask_for_little() {
    let folder = tempfile::tempdir().expect("a folder");
    instancing_of_any_shape_stays_within_bounds(folder.path());
    instances_share_what_they_have_in_common(folder.path());
    repeated_names_take_linear_time(folder.path());
}
