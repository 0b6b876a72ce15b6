//! Loading documents beside the XML parser alone, and sampling a clip: MB/s, the ratio of the two, and microseconds a pose.
//!
//! Runs on a generated document and, where they are there, on the larger of the shared models. The ratio is taken in one run, so that it holds on a
//! busy machine too.

// It can also tell the memory bandwidth, which is not needed here.
#[allow(dead_code, reason = "tests use the rest of it")]
mod support;

use std::fmt::Write;
use std::hint::black_box;
use std::path::{Path, PathBuf};

use glam::{DMat4, DVec3};
use sinew::animation::Pose;
use sinew::collada::read;
use sinew::progress::Progress;

const JOINTS: usize = 70;
const KEYS: usize = 200;

/// A skinless figure: a wavy sheet of `side · side` quads with normals and texture coordinates, and a chain of 70 joints with 200 matrix keys each.
fn generated(side: usize) -> String {
    let mut points = String::new();
    let (mut normals, mut uvs, mut indices) = (String::new(), String::new(), String::new());
    let row = side + 1;
    for i in 0..row * row {
        let (x, y) = ((i % row) as f64 / side as f64, (i / row) as f64 / side as f64);
        let slope = (x * 9.0).cos();
        let length = (slope * slope + 1.0).sqrt();
        // Writing to a string cannot fail.
        let _ = write!(points, "{x:.6} {y:.6} {:.6} ", (x * 9.0).sin() / 9.0);
        let _ = write!(normals, "{:.6} 0 {:.6} ", -slope / length, 1.0 / length);
        let _ = write!(uvs, "{x:.6} {y:.6} ");
    }
    for i in 0..side * side {
        let corner = i / side * row + i % side;
        for index in [corner, corner + 1, corner + row + 1, corner + row] {
            let _ = write!(indices, "{index} {index} {index} ");
        }
    }
    let source = |id: &str, names: &str, values: &str| {
        let params: String = names.split(' ').map(|name| format!("<param name=\"{name}\" type=\"float\"/>")).collect();
        let (count, stride) = (values.split_ascii_whitespace().count(), names.split(' ').count());
        format!(
            "<source id=\"{id}\"><float_array id=\"{id}-a\" count=\"{count}\">{values}</float_array><technique_common><accessor source=\"#{id}-a\" \
             count=\"{}\" stride=\"{stride}\">{params}</accessor></technique_common></source>\n",
            count / stride
        )
    };
    let mut text =
        String::from("<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n");
    let _ = write!(
        text,
        "<library_geometries><geometry id=\"g\"><mesh>{}{}{}<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><polylist count=\"{}\">\
         <input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/><input semantic=\"TEXCOORD\" source=\"#t\" offset=\"2\"/>\
         <vcount>{}</vcount><p>{indices}</p></polylist></mesh></geometry></library_geometries>\n<library_animations>\n",
        source("p", "X Y Z", &points),
        source("n", "X Y Z", &normals),
        source("t", "S T", &uvs),
        side * side,
        "4 ".repeat(side * side)
    );
    let times: String = (0..KEYS).map(|key| format!("{:.6} ", key as f64 / 30.0)).collect();
    for joint in 0..JOINTS {
        let mut keys = String::new();
        for key in 0..KEYS {
            let turn = DMat4::from_rotation_y((key * (joint + 3)) as f64 * 0.01) * DMat4::from_rotation_x(key as f64 * 0.02);
            let matrix = DMat4::from_translation(DVec3::Y * 0.1) * turn;
            for value in matrix.transpose().to_cols_array() {
                let _ = write!(keys, "{value:.6} ");
            }
        }
        let _ = writeln!(
            text,
            "<animation>{}<source id=\"k{joint}\"><float_array id=\"k{joint}-a\" count=\"{}\">{keys}</float_array><technique_common><accessor source=\"#k{joint}-a\" \
             count=\"{KEYS}\" stride=\"16\"><param name=\"TRANSFORM\" type=\"float4x4\"/></accessor></technique_common></source><sampler id=\"s{joint}\">\
             <input semantic=\"INPUT\" source=\"#i{joint}\"/><input semantic=\"OUTPUT\" source=\"#k{joint}\"/></sampler><channel source=\"#s{joint}\" target=\"j{joint}/m\"/></animation>",
            source(&format!("i{joint}"), "TIME", &times),
            KEYS * 16
        );
    }
    text += "</library_animations>\n<library_visual_scenes><visual_scene id=\"s\"><node><instance_geometry url=\"#g\"/></node>";
    for joint in 0..JOINTS {
        let _ = write!(text, "<node id=\"j{joint}\" type=\"JOINT\"><matrix sid=\"m\">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>");
    }
    text += &"</node>".repeat(JOINTS);
    text + "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>"
}

fn load(name: &str, bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{FEFF}');
    let options = || roxmltree::ParsingOptions { allow_dtd: true, ..roxmltree::ParsingOptions::default() };
    let parse = support::median(|| {
        black_box(roxmltree::Document::parse_with_options(black_box(text), options()).map(|document| document.descendants().count())).ok();
    });
    let whole = support::median(|| {
        black_box(read(black_box(bytes), name, &Progress::default())).ok();
    });
    println!(
        "{name:<32} {:>6.2} MB {:>7.2} ms {:>6.0} MB/s, {:.2} times the XML parser alone",
        bytes.len() as f64 / 1e6,
        whole * 1e3,
        bytes.len() as f64 / 1e6 / whole,
        whole / parse
    );
}

fn shared() -> PathBuf {
    std::env::var_os("SINEW_SHARED").map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared"), PathBuf::from).join("models")
}

fn main() {
    let text = generated(400);
    load("generated", text.as_bytes());
    for name in ["tethys_fbx", "monster_max_opencollada", "walk", "raptor_attack", "seymour", "anims_with_full_rotations_between_keys"] {
        let file = format!("{name}.dae");
        if let Ok(bytes) = std::fs::read(shared().join(&file)) {
            load(&file, &bytes);
        }
    }
    let Ok(loaded) = read(text.as_bytes(), "generated", &Progress::default()) else { return };
    let Some(clip) = loaded.clips.first() else { return };
    let mut pose = Pose::rest(&loaded.scene);
    let (mut local, mut world, mut time) = (Vec::new(), Vec::new(), 0.0);
    let sample = support::median(|| {
        time = (time + 1.234_567) % clip.end;
        clip.sample(black_box(time), &mut pose);
    });
    let whole = support::median(|| {
        time = (time + 1.234_567) % clip.end;
        clip.sample(black_box(time), &mut pose);
        pose.locals(&mut local);
        loaded.scene.graph.world_from_local(&local, &mut world);
        black_box(&world);
    });
    println!("a clip of {JOINTS} joints: {:.2} µs to sample, {:.2} µs with the world matrices", sample * 1e6, whole * 1e6);
}
