//! glTF files against the surface that Sinew itself poses: read back by an independent reader here, and by three.js and Khronos' validator where Node is
//! installed.

mod expected;
mod muscles;
mod node;
mod reader;
#[path = "../support/mod.rs"]
mod support;
mod two_sided;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glam::DVec3;
use sinew::document::{Document, PoseBuffers, PoseState};
use sinew::export::gltf::{GltfContainer, save};
use sinew::formats::SCENE_READERS;
use sinew::output::Output;
use sinew::progress::Progress;
use sinew::scene::Frame;

use expected::Expected;
use reader::Glb;

/// Moments of a clip, parts of its length; none of them a key of most clips.
const MOMENTS: [f64; 5] = [0.0, 0.213, 0.5, 0.837, 1.0];
/// Largest distance between the surfaces, in diagonals of the scene.
const APART: f64 = 1e-4;
/// Largest distance of muscles, metres.
const MUSCLES_APART: f64 = 5e-4;

/// Largest distance between the surfaces of a document, metres, in a scene of this diagonal.
fn allowed(document: &Document, diagonal: f64) -> f64 {
    (diagonal * APART).max(if document.muscle_count() > 0 { MUSCLES_APART } else { 0.0 })
}

/// One moment of a document with its name and time in the glTF file.
struct Moment {
    animation: Option<String>,
    written: f64,
    state: PoseState,
}

fn moments(document: &Document) -> Vec<Moment> {
    let start = document.start_state();
    if document.clips.is_empty() {
        let Some(range) = document.driven_rig().and_then(|rig| rig.flexion_range()) else {
            return vec![Moment { animation: None, written: 0.0, state: start }];
        };
        let rig = document.driven_rig().expect("just seen");
        let bent = |part: f64| start.with_drive(rig.at_flexion(range.start() + (range.end() - range.start()) * part));
        // The file bends the arm over two seconds.
        return MOMENTS.map(|part| Moment { animation: Some("Elbow angle".into()), written: 2.0 * part, state: bent(part) }).into();
    }
    let clips = document.clips.iter().enumerate().take(4);
    let of = |(number, clip): (usize, &sinew::animation::Clip)| {
        MOMENTS.map(|part| {
            let time = clip.start + clip.duration() * part;
            let state = PoseState { clip: Some(number), ..start.at_time(time) };
            Moment { animation: Some(clip.label().plain().into_owned()), written: time - clip.start.min(0.0), state }
        })
    };
    clips.flat_map(of).collect()
}

/// The vertices that triangles use, as Sinew poses them.
fn posed(document: &Document, state: &PoseState) -> (Vec<DVec3>, f64) {
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    document.pose(state, &mut buffers, &mut frame);
    let mut points = Vec::new();
    for surface in &frame.surfaces {
        let finite = |vertex: &u32| surface.position(*vertex).is_finite();
        let mut used: Vec<u32> = surface.mesh.triangles.iter().filter(|corners| corners.iter().all(finite)).flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        points.extend(used.into_iter().map(|vertex| surface.position(vertex).as_dvec3()));
    }
    (points, f64::from(frame.bounds.diagonal()))
}

/// Largest distance from a point of `from` to the nearest of `to`; `cell` where it is more.
fn apart(from: &[DVec3], to: &[DVec3], cell: f64) -> f64 {
    let key = |point: DVec3| (point / cell).floor().to_array().map(|part| part as i64);
    let mut cells: HashMap<[i64; 3], Vec<DVec3>> = HashMap::new();
    for point in to {
        cells.entry(key(*point)).or_default().push(*point);
    }
    let nearest = |point: &DVec3| {
        let [x, y, z] = key(*point);
        let around = (-1..=1).flat_map(move |i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [x + i, y + j, z + k])));
        around.filter_map(|cell| cells.get(&cell)).flatten().map(|other| other.distance(*point)).fold(cell, f64::min)
    };
    from.iter().map(nearest).fold(0.0, f64::max)
}

/// Converts a file and holds every moment of it against the document.
fn agrees(file: &Path, folder: &Path) {
    let document = Document::open(&[file], SCENE_READERS, &Progress::default()).unwrap_or_else(|error| panic!("{error}"));
    let out = folder.join("out.glb");
    save(&Output::of_program(&out), GltfContainer::Binary, &document).expect("written");
    let glb = Glb::read(&std::fs::read(&out).expect("there"));
    for Moment { animation, written, state } in moments(&document) {
        // A clip that moves nothing is no animation.
        let found = animation.as_deref().and_then(|name| glb.animation(name));
        let (ours, diagonal) = posed(&document, &state);
        let theirs = glb.surface(found, written);
        let allowed = allowed(&document, diagonal);
        let cell = (4.0 * allowed).max(1e-9);
        let distance = apart(&ours, &theirs, cell).max(apart(&theirs, &ours, cell));
        assert_eq!(ours.is_empty(), theirs.is_empty(), "{}", file.display());
        assert!(distance <= allowed, "{} {animation:?} at {written}: {distance} of {diagonal}", file.display());
    }
}

fn with_ending<'a>(folder: &Path, endings: &'a [&str]) -> impl Iterator<Item = PathBuf> + use<'a> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path()).collect();
    files.sort();
    files.into_iter().filter(|file| file.extension().is_some_and(|ending| endings.iter().any(|wanted| ending == *wanted)))
}

fn configs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("configs")
}

#[test]
fn demo_clips_and_muscles_come_back_as_they_were() {
    let folder = support::folder();
    for file in with_ending(&configs(), &["dae", "yaml"]) {
        agrees(&file, folder.path());
    }
}

#[test]
fn clips_by_other_exporters_come_back_as_they_were() {
    let Some(shared) = support::shared() else {
        eprintln!("left out: the folder of real-world models is not there");
        return;
    };
    let folder = support::folder();
    for file in with_ending(&shared.join("models"), &["dae"]) {
        agrees(&file, folder.path());
    }
}

/// A document with two boxes' worth of trouble: a shear at rest, a mirrored child, Bézier keys at thirds and elsewhere, steps, a turn of two full circles,
/// and a clip that begins before zero.
const TROUBLE: &str = r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 10 0 0 0 20 0 0 0 30</float_array><technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
</mesh></geometry>
<geometry id="tall"><mesh><source id="q"><float_array id="qa" count="12">0 0 0 10 0 0 0 20 0 0 0 90</float_array><technique_common>
<accessor source="#qa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="w"><input semantic="POSITION" source="#q"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#w" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_controllers><controller id="grows"><morph source="#g" method="NORMALIZED">
<source id="mt"><IDREF_array id="mta" count="1">tall</IDREF_array><technique_common><accessor source="#mta" count="1"><param type="IDREF"/></accessor>
</technique_common></source><source id="mw"><float_array id="mwa" count="1">0.25</float_array><technique_common><accessor source="#mwa" count="1">
<param type="float"/></accessor></technique_common></source>
<targets><input semantic="MORPH_TARGET" source="#mt"/><input semantic="MORPH_WEIGHT" source="#mw"/></targets></morph></controller></library_controllers>
<library_visual_scenes><visual_scene id="s">
<node id="growing"><instance_controller url="#grows"/></node>
<node id="still"><matrix>1 0.7 0 5 0.2 2 0.4 0 0 0.1 1.5 0 0 0 0 1</matrix><instance_geometry url="#g"/><instance_geometry url="#g"/>
  <node id="mirrored"><scale>-1 2 1</scale><instance_geometry url="#g"/></node></node>
<node id="moving"><rotate sid="before">0 0 1 30</rotate><translate sid="t">0 0 0</translate><scale sid="size">1 2 1</scale><instance_geometry url="#g"/>
  <node id="turning"><rotate sid="r">1 2 3 0</rotate><translate sid="hop">0 0 5</translate><instance_geometry url="#g"/></node></node>
</visual_scene></library_visual_scenes>
<library_animations>
ANIMATIONS
</library_animations>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
"##;

fn channel(id: &str, target: &str, times: &str, values: &str, modes: &str, tangents: Option<(&str, &str)>) -> String {
    let source = |name: &str, tag: &str, text: &str, stride: usize| {
        let count = text.split_whitespace().count();
        format!(
            "<source id=\"{id}-{name}\"><{tag} id=\"{id}-{name}-a\" count=\"{count}\">{text}</{tag}><technique_common>\
             <accessor source=\"#{id}-{name}-a\" count=\"{}\" stride=\"{stride}\">{}</accessor></technique_common></source>",
            count / stride,
            "<param name=\"V\" type=\"float\"/>".repeat(stride)
        )
    };
    let (mut sources, mut inputs) = (String::new(), String::new());
    let parts =
        [("INPUT", "in", "float_array", times), ("OUTPUT", "out", "float_array", values), ("INTERPOLATION", "mode", "Name_array", modes)];
    for (semantic, name, tag, text) in parts {
        sources += &source(name, tag, text, 1);
        inputs += &format!("<input semantic=\"{semantic}\" source=\"#{id}-{name}\"/>");
    }
    if let Some((arriving, leaving)) = tangents {
        sources += &source("it", "float_array", arriving, 2);
        sources += &source("ot", "float_array", leaving, 2);
        inputs += &format!("<input semantic=\"IN_TANGENT\" source=\"#{id}-it\"/><input semantic=\"OUT_TANGENT\" source=\"#{id}-ot\"/>");
    }
    format!(
        "<animation id=\"{id}\">{sources}<sampler id=\"{id}-s\">{inputs}</sampler><channel source=\"#{id}-s\" target=\"{target}\"/></animation>\n"
    )
}

fn write(folder: &Path, name: &str, animations: &str) -> PathBuf {
    let file = folder.join(name);
    std::fs::write(&file, TROUBLE.replace("ANIMATIONS", animations)).expect("written");
    file
}

#[test]
fn shear_mirrors_steps_full_turns_and_times_below_zero_come_back_as_they_were() {
    let folder = support::folder();
    let animations =
        channel("a", "moving/t.X", "-1 0.5 2", "0 40 -10", "BEZIER BEZIER BEZIER", Some(("-1.2 0 0.4 40 1.2 -10", "-0.2 30 0.6 40 2.2 0")))
            + &channel("b", "turning/r.ANGLE", "-1 2", "0 720", "LINEAR LINEAR", None)
            + &channel("c", "turning/hop.Z", "-1 0 1 2", "5 25 -5 5", "STEP LINEAR STEP STEP", None);
    agrees(&write(folder.path(), "trouble.dae", &animations), folder.path());
}

#[test]
fn keys_stay_as_they_are_where_the_format_can_say_them() {
    let folder = support::folder();
    let thirds = Some(("-0.333333333 0 0.666666667 40 1.666666667 -10", "0.333333333 30 1.333333333 50 2.333333333 0"));
    let animations = channel("a", "moving/t.X", "0 1 2", "0 40 -10", "BEZIER BEZIER BEZIER", thirds)
        + &channel("d", "mw(0)", "0 1 2", "0 40 -10", "BEZIER BEZIER BEZIER", thirds)
        + &channel("b", "turning/r.ANGLE", "0 1 2", "0 90 30", "LINEAR LINEAR LINEAR", None)
        + &channel("c", "turning/hop.Z", "0 1 2", "5 25 5", "LINEAR LINEAR LINEAR", None);
    let file = write(folder.path(), "plain.dae", &animations);
    agrees(&file, folder.path());
    let glb = Glb::read(&std::fs::read(folder.path().join("out.glb")).expect("there"));
    let animation = glb.root()["animations"][0].clone();
    let mut seen = Vec::new();
    for channel in animation["channels"].as_array().expect("channels") {
        let sampler = &animation["samplers"][channel["sampler"].as_u64().expect("a number") as usize];
        let keys = glb.rows(sampler["input"].as_u64().expect("a number") as usize).len();
        let node = &glb.root()["nodes"][channel["target"]["node"].as_u64().expect("a number") as usize]["name"];
        seen.push(format!(
            "{} {} {} {keys}",
            node.as_str().expect("a name"),
            channel["target"]["path"].as_str().expect("a path"),
            sampler["interpolation"]
        ));
    }
    seen.sort();
    assert!(seen.contains(&"growing weights \"CUBICSPLINE\" 3".to_owned()), "{seen:?}");
    // The turn takes the hop's offset round with it, so that its translation is no straight line and gets more keys.
    assert!(seen.contains(&"moving translation \"CUBICSPLINE\" 3".to_owned()), "{seen:?}");
    assert!(seen.iter().any(|line| line.starts_with("turning rotation \"LINEAR\"")), "{seen:?}");
}

#[test]
fn weights_along_other_curves_are_sampled_as_closely_as_they_must() {
    let folder = support::folder();
    let early = Some(("-0.1 0 0.2 40 1.1 -10", "0.1 30 1.9 50 2.1 0"));
    let file = write(folder.path(), "early.dae", &channel("d", "mw(0)", "0 1 2", "0 40 -10", "BEZIER BEZIER BEZIER", early));
    agrees(&file, folder.path());
    let glb = Glb::read(&std::fs::read(folder.path().join("out.glb")).expect("there"));
    assert_eq!(glb.root()["animations"][0]["samplers"][0]["interpolation"], "LINEAR");
}

#[test]
fn a_scale_is_a_spline_where_it_stays_positive() {
    let folder = support::folder();
    let thirds = Some(("-0.333333333 0 0.666666667 0.5 1.666666667 1", "0.333333333 3 1.333333333 2.5 2.333333333 0"));
    for (values, keys) in [("1 2 0.5", Some(3)), ("1 -2 0.5", None)] {
        let file = write(folder.path(), "size.dae", &channel("a", "moving/size.X", "0 1 2", values, "BEZIER BEZIER BEZIER", thirds));
        agrees(&file, folder.path());
        let glb = Glb::read(&std::fs::read(folder.path().join("out.glb")).expect("there"));
        let sampler = &glb.root()["animations"][0]["samplers"][0];
        let cubic = sampler["interpolation"] == "CUBICSPLINE";
        let found = glb.rows(sampler["input"].as_u64().expect("a number") as usize).len();
        assert_eq!(cubic.then_some(found), keys, "{values}");
    }
}

#[test]
fn steps_are_steps() {
    let folder = support::folder();
    let file = write(folder.path(), "steps.dae", &channel("c", "moving/t.Y", "0 1 2", "5 25 5", "STEP STEP STEP", None));
    agrees(&file, folder.path());
    let glb = Glb::read(&std::fs::read(folder.path().join("out.glb")).expect("there"));
    let sampler = &glb.root()["animations"][0]["samplers"][0];
    assert_eq!(sampler["interpolation"], "STEP");
    assert_eq!(glb.rows(sampler["input"].as_u64().expect("a number") as usize).len(), 3);
}

#[test]
fn a_skin_that_mirrors_keeps_its_outside_outside() {
    let folder = support::folder();
    let column = support::models::column();
    let turned = |matrix: &str| {
        let plain = "<node id=\"lower-bone\" name=\"lower\" sid=\"lower\" type=\"JOINT\">\n        <matrix sid=\"transform\">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1<";
        assert!(column.contains(plain));
        column.replace(plain, &plain.replace(">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1<", &format!(">{matrix}<")))
    };
    let mut volumes = Vec::new();
    for matrix in ["1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "1 0 0 0 0 0 1 0 0 1 0 0 0 0 0 1"] {
        let file = support::models::write(folder.path(), "mirror.dae", &turned(matrix));
        agrees(&file, folder.path());
        let glb = Glb::read(&std::fs::read(folder.path().join("out.glb")).expect("there"));
        let obj = folder.path().join("mirror.obj");
        support::sinew(["export", support::arg(&file), "-o", support::arg(&obj)]).well();
        let (ours, theirs) = (support::obj::whole(&support::obj::read(&obj)).volume(), glb.volume(None, 0.0));
        assert!(ours > 0.0 && (ours - theirs).abs() < 1e-4 * ours, "{matrix}: {ours} and {theirs}");
        volumes.push(theirs);
    }
    assert!(volumes.iter().all(|volume| (volume - volumes[0]).abs() < 1e-6 * volumes[0]), "{volumes:?}");
}

#[test]
fn what_is_lost_is_told_once() {
    let folder = support::folder();
    let lights = r##"<library_lights>
<light id="sky" name="Sky"><technique_common><ambient><color>0.1 0.1 0.2</color></ambient></technique_common></light>
<light id="room" name="Room"><technique_common><ambient><color>0.1 0.1 0.1</color></ambient></technique_common></light>
</library_lights><library_visual_scenes>"##;
    let hung = r##"<instance_geometry url="#cube"/><node><instance_light url="#sky"/></node><node><instance_light url="#room"/></node><node><instance_light url="#sky"/></node>"##;
    let text = support::models::cube("").replace("<library_visual_scenes>", lights).replace("<instance_geometry url=\"#cube\"/>", hung);
    let file = support::models::write(folder.path(), "lit.dae", &text);
    let ended = support::sinew(["convert", support::arg(&file), support::arg(&folder.path().join("a.glb"))]);
    assert_eq!((ended.code, ended.err.lines().count()), (0, 2), "{}", ended.err);
    assert!(ended.err.contains("Sky") && ended.err.contains("Room"), "{}", ended.err);
    let document = Document::open(&[&file], SCENE_READERS, &Progress::default()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(sinew::export::gltf::unsupported_features(&document).len(), 2);
}

#[test]
fn the_command_line_writes_both_forms_and_refuses_the_rest() {
    let folder = support::folder();
    let (clip, glb, text) = (support::config("curl.dae"), folder.path().join("a.glb"), folder.path().join("a.gltf"));
    support::sinew(["convert", support::arg(&clip), support::arg(&glb)]).well();
    support::sinew(["convert", support::arg(&clip), support::arg(&text)]).well();
    let root: serde_json::Value = serde_json::from_slice(&std::fs::read(&text).expect("there")).expect("JSON");
    assert_eq!(root["accessors"], *Glb::read(&std::fs::read(&glb).expect("there")).root().get("accessors").expect("some"));
    assert!(root["buffers"][0]["uri"].as_str().expect("inside").starts_with("data:application/octet-stream;base64,"));
    let line = support::sinew(["convert", support::arg(&clip), "a.fbx"]).refused(2);
    assert!(line.contains("a.fbx") && line.contains(".glb"), "{line}");
    let line = support::sinew(["convert", support::arg(&clip), "/nowhere/at/all.glb"]).refused(1);
    assert!(line.contains("/nowhere/at/all.glb"), "{line}");
    let copy = folder.path().join("input.glb");
    std::fs::copy(&clip, &copy).expect("copied");
    support::sinew(["convert", support::arg(&copy), support::arg(&copy)]).refused(2);
    assert_eq!(std::fs::read(&copy).expect("there"), std::fs::read(&clip).expect("there"));
}

#[test]
fn the_validator_and_three_js_agree_where_node_is_installed() {
    let folder = support::folder();
    let Some(node) = node::Node::install() else { return };
    let mut files: Vec<PathBuf> = with_ending(&configs(), &["dae", "yaml"]).collect();
    if let Some(shared) = support::shared() {
        files.extend(with_ending(&shared.join("models"), &["dae"]));
    }
    let (mut written, mut cases) = (Vec::new(), Vec::new());
    for (number, file) in files.iter().enumerate() {
        let document = Document::open(&[file], SCENE_READERS, &Progress::default()).unwrap_or_else(|error| panic!("{error}"));
        let out = folder.path().join(format!("{number}.glb"));
        save(&Output::of_program(&out), GltfContainer::Binary, &document).expect("written");
        let mut poses = Vec::new();
        for (count, moment) in moments(&document).iter().enumerate() {
            let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
            document.pose(&moment.state, &mut buffers, &mut frame);
            let obj = folder.path().join(format!("{number}-{count}.obj"));
            sinew::export::obj::save(&Output::of_program(&obj), &document.scene, &frame).expect("written");
            let allowed = allowed(&document, f64::from(frame.bounds.diagonal()));
            poses.push(serde_json::json!({"clip": moment.animation, "time": moment.written, "obj": obj, "allowed": allowed}));
        }
        cases.push(serde_json::json!({"file": out, "poses": poses}));
        written.push(out);
    }
    node.validate(&written);
    let found = node.read_back(&folder.path().join("cases.json"), &cases);
    let demos = files.iter().zip(&cases).filter(|(file, _)| file.starts_with(configs()));
    let names = demos.flat_map(|(file, case)| (0..case["poses"].as_array().map_or(0, Vec::len)).map(|moment| (name(file), moment)));
    let found: Vec<Expected> = names.zip(found).map(|((file, moment), reach)| Expected { file, moment, reach }).collect();
    expected::bless(&found);
    for (found, kept) in found.iter().zip(expected::read()) {
        assert!((&found.file, found.moment) == (&kept.file, kept.moment) && expected::apart(&found.reach, &kept.reach) < 1e-6, "{found:?}");
    }
}

fn name(file: &Path) -> String {
    file.file_name().expect("a file").to_string_lossy().into_owned()
}

/// The same agreement with three.js on machines without Node: with what it was once seen to make of the demos.
#[test]
fn surfaces_are_those_that_three_js_was_seen_to_make() {
    let kept = expected::read();
    for file in with_ending(&configs(), &["dae", "yaml"]) {
        let document = Document::open(&[&file], SCENE_READERS, &Progress::default()).unwrap_or_else(|error| panic!("{error}"));
        let moments = moments(&document);
        let kept: Vec<_> = kept.iter().filter(|kept| kept.file == name(&file)).collect();
        assert_eq!(moments.len(), kept.len(), "{}: SINEW_BLESS=1 asks three.js again", file.display());
        for (moment, kept) in moments.iter().zip(kept) {
            let (points, diagonal) = posed(&document, &moment.state);
            let apart = expected::apart(&expected::reach(&points), &kept.reach);
            assert!(apart <= allowed(&document, diagonal), "{} at {}: {apart} of {diagonal}", file.display(), moment.written);
        }
    }
}
