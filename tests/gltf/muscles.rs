//! Muscles in glTF files: vertex by vertex where Sinew draws them, between keys too, in files of few bytes.

use std::fmt::Write as _;
use std::path::Path;

use sinew::document::{Document, PoseBuffers, PoseState, SkinMotion};
use sinew::export::gltf::{GltfContainer, save};
use sinew::formats::SCENE_READERS;
use sinew::output::Output;
use sinew::progress::Progress;
use sinew::scene::{Frame, SurfaceGeometry};

use crate::reader::Glb;
use crate::support;

/// Largest distance of a vertex, metres; rounding of positions to 32 bits comes on top.
const APART: f64 = 5e-4 + 1e-6;

fn open(file: &Path) -> Document {
    Document::open(&[file], SCENE_READERS, &Progress::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Writes a document; nothing of it may be lost.
fn written(document: &Document, folder: &Path) -> Vec<u8> {
    let out = folder.join("muscles.glb");
    let unsupported = save(&Output::of_program(&out), GltfContainer::Binary, document).expect("written");
    assert!(unsupported.is_empty(), "{unsupported:?}");
    std::fs::read(out).expect("there")
}

/// Names of the animations, and for so many moments, spread unevenly over each, the time in the file and the document's state.
fn moments(document: &Document, count: usize) -> Vec<(String, f64, PoseState)> {
    let start = document.start_state();
    // The golden ratio puts no two of them on the same part of a key's interval.
    let parts: Vec<f64> = (0..count).map(|number| (number as f64 * 0.618_033_988_75).fract()).chain([1.0]).collect();
    if document.clips.is_empty() {
        let rig = document.driven_rig().expect("muscles on an arm");
        let state = |part: f64| match rig.flexion_range() {
            Some(range) => start.with_drive(rig.at_flexion(range.start() + (range.end() - range.start()) * part)),
            None => start.with_drive(rig.at_contraction(100.0 * part)),
        };
        let name = if rig.flexion_range().is_some() { "Elbow angle" } else { "Contraction" };
        return parts.iter().map(|part| (name.to_owned(), 2.0 * part, state(*part))).collect();
    }
    let of = |(number, clip): (usize, &sinew::animation::Clip)| {
        let at = |part: &f64| {
            let time = clip.start + clip.duration() * part;
            let state = PoseState { clip: Some(number), ..start.at_time(time) };
            (clip.label().plain().into_owned(), time - clip.start.min(0.0), state)
        };
        parts.iter().map(at).collect::<Vec<_>>()
    };
    document.clips.iter().enumerate().flat_map(of).collect()
}

/// How far vertices and normals of muscles are off in a file.
#[derive(Debug, Default)]
struct Error {
    /// Metres.
    distance: f64,
    /// Degrees.
    largest_angle: f64,
    /// Degrees, root mean square.
    angle: f64,
}

/// Holds the file against the document at so many moments of each animation.
fn error(document: &Document, file: &[u8], count: usize) -> Error {
    let glb = Glb::read(file);
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let (mut found, mut squares, mut normals) = (Error::default(), 0.0, 0_u32);
    for (animation, time, state) in moments(document, count) {
        document.pose(&state, &mut buffers, &mut frame);
        let animation = glb.animation(&animation).expect("muscles move");
        let mut parts = glb.parts(Some(animation), time);
        // All parts of a mesh have the same vertices. Muscles are written behind everything else, in the order in which they are drawn.
        parts.dedup_by_key(|part| part.node);
        let muscles: Vec<_> = frame.surfaces.iter().filter(|surface| surface.muscle.is_some()).collect();
        assert!(!muscles.is_empty());
        for (surface, part) in muscles.iter().zip(&parts[parts.len() - muscles.len()..]) {
            let SurfaceGeometry::Deformed { positions, normals: directions } = &surface.geometry else {
                panic!("a muscle is no rigid body")
            };
            assert!(part.placed.len() == positions.len() && part.normals.len() == directions.len());
            let distances = part.placed.iter().zip(positions).map(|(position, wanted)| position.distance(wanted.as_dvec3()));
            found.distance = distances.fold(found.distance, f64::max);
            for (normal, wanted) in part.normals.iter().zip(directions) {
                let angle = normal.angle_between(wanted.as_dvec3()).to_degrees();
                found.largest_angle = found.largest_angle.max(angle);
                squares += angle * angle;
                normals += 1;
            }
        }
    }
    found.angle = (squares / f64::from(normals)).sqrt();
    found
}

/// Holds the skins of a file that follow muscles against the document at so many moments of each animation. Also returns how far following moves a vertex
/// at most, metres, without which they would be bent by their skeletons alone.
fn skin_error(document: &Document, file: &[u8], count: usize) -> (Error, f64) {
    let glb = Glb::read(file);
    let bound = document.bound_surfaces();
    let (mut buffers, mut frame, mut alone) = (PoseBuffers::default(), Frame::default(), Frame::default());
    let (mut found, mut squares, mut normals, mut followed) = (Error::default(), 0.0, 0_u32, 0.0_f64);
    for (animation, time, state) in moments(document, count) {
        document.pose(&PoseState { skin: SkinMotion::Skeleton, ..state.clone() }, &mut buffers, &mut alone);
        document.pose(&state, &mut buffers, &mut frame);
        let mut parts = glb.parts(Some(glb.animation(&animation).expect("a skeleton moves")), time);
        parts.dedup_by_key(|part| part.node);
        parts.retain(|part| part.skinned);
        // Skins are written in the order in which they are drawn.
        let bent =
            |surface: &sinew::scene::Surface| surface.muscle.is_none() && matches!(surface.geometry, SurfaceGeometry::Deformed { .. });
        let skins: Vec<usize> = (0..frame.surfaces.len()).filter(|index| bent(&frame.surfaces[*index])).collect();
        assert_eq!(skins.len(), parts.len());
        for (index, part) in skins.into_iter().zip(&parts) {
            let surfaces = [&frame, &alone].map(|frame| &frame.surfaces[index].geometry);
            let [SurfaceGeometry::Deformed { positions, normals: directions }, SurfaceGeometry::Deformed { positions: unmoved, .. }] =
                surfaces
            else {
                panic!("a skin is no rigid body")
            };
            assert!(part.placed.len() == positions.len() && part.normals.len() == directions.len());
            let distances = part.placed.iter().zip(positions).map(|(position, wanted)| position.distance(wanted.as_dvec3()));
            found.distance = distances.fold(found.distance, f64::max);
            followed = positions.iter().zip(unmoved).map(|(a, b)| f64::from(a.distance(*b))).fold(followed, f64::max);
            let Some((_, vertices)) = bound.iter().find(|(surface, _)| *surface == index) else { continue };
            for vertex in vertices.iter().map(|vertex| *vertex as usize) {
                let angle = part.normals[vertex].angle_between(directions[vertex].as_dvec3()).to_degrees();
                found.largest_angle = found.largest_angle.max(angle);
                squares += angle * angle;
                normals += 1;
            }
        }
    }
    found.angle = (squares / f64::from(normals.max(1))).sqrt();
    (found, followed)
}

#[test]
fn skin_follows_the_muscles_within_half_a_millimetre_between_keys() {
    let folder = support::folder();
    for name in ["atlas-muscles.yaml", "curl-muscles.yaml"] {
        let document = open(&support::config(name));
        let file = written(&document, folder.path());
        let (error, followed) = skin_error(&document, &file, 97);
        assert!(followed > 10.0 * APART, "{name}: {followed}");
        assert!(error.distance <= APART && error.angle <= 1.0, "{name}: {error:?}");
    }
}

#[test]
fn demo_muscles_are_within_half_a_millimetre_between_keys_in_small_files() {
    let folder = support::folder();
    for (name, kilobytes) in [
        ("atlas-muscles.yaml", 2_000),
        ("curl-muscles.yaml", 1_400),
        ("example.yaml", 700),
        ("biceps.yaml", 300),
        ("biceps-measured.yaml", 300),
        ("biceps-human.yaml", 420),
        ("biceps-human-wrapped.yaml", 450),
        ("triceps-human.yaml", 360),
        ("brachialis-human.yaml", 380),
    ] {
        let document = open(&support::config(name));
        let file = written(&document, folder.path());
        assert!(file.len() <= kilobytes * 1_000, "{name}: {} bytes", file.len());
        let error = error(&document, &file, 97);
        assert!(error.distance <= APART && error.angle <= 1.0 && error.largest_angle <= 12.0, "{name}: {error:?}");
    }
}

/// So many muscles on the bones of the demo arm, every second one a biceps and the others triceps, no two of them alike.
fn many(count: usize, folder: &Path) -> Document {
    std::fs::copy(support::config("atlas.dae"), folder.join("atlas.dae")).expect("copied");
    let mut text =
        String::from("unit: mm\nclip: atlas.dae\njoint: {bone: forearm, axis: [0.0, 0.0, -1.0], range: [0.0, 140.0]}\nmuscles:\n");
    for number in 0..count {
        let (side, shift) = (0.4 * ((number * 7) % 61) as f64 - 12.0, 0.3 * ((number * 5) % 53) as f64);
        let muscle = if number % 2 == 0 {
            format!(
                "length: {}, radii: [4.0, 8.0, 13.0, 16.5, 18.0, 18.5, 17.5, 15.0, 11.0, 7.0, 3.5], growth: [0.0, 0.4, 1.0, 1.5, 1.9, 2.0, 1.9, 1.5, 1.0, 0.4, 0.0], \
                 origin: {{bone: upper_arm, offset: [26.0, {}, {side}]}}, via: [{{bone: upper_arm, offset: [27.0, 190.0, {side}]}}], \
                 insertion: {{bone: forearm, offset: [10.0, 45.0, {side}]}}, \
                 wrap: {{bone: upper_arm, offset: [0.0, 300.0, 0.0], radius: 16.0, side: [1.0, 0.0, 0.0]}}, \
                 tendons: {{origin: {{length: 20.0, radius: 3.5}}, insertion: {{length: 50.0, radius: 3.0}}}}",
                265.0 - shift,
                10.0 + shift,
            )
        } else {
            format!(
                "length: {}, radii: [5.0, 10.0, 15.0, 18.0, 18.0, 15.0, 10.0, 5.0], growth: [0.0, 0.8, 1.6, 2.0, 2.0, 1.4, 0.6, 0.0], \
                 origin: {{bone: upper_arm, offset: [-26.0, {}, {side}]}}, insertion: {{bone: forearm, offset: [-22.0, -10.0, {side}]}}, \
                 wrap: {{bone: upper_arm, offset: [0.0, 300.0, 0.0], radius: 22.0, side: [-1.0, 0.0, 0.0]}}, \
                 tendons: {{insertion: {{length: 45.0, radius: 4.0}}}}",
                225.0 - shift,
                20.0 + shift,
            )
        };
        writeln!(text, "  - {{name: Muscle {number}, {muscle}}}").expect("a string takes all");
    }
    let file = folder.join("many.yaml");
    std::fs::write(&file, text).expect("written");
    // `SINEW_KEEP=folder` keeps the muscles for the command line: `sinew convert many.yaml many.glb`.
    if let Some(keep) = std::env::var_os("SINEW_KEEP") {
        for name in ["atlas.dae", "many.yaml"] {
            std::fs::copy(folder.join(name), Path::new(&keep).join(name)).expect("copied");
        }
    }
    open(&file)
}

#[test]
fn many_muscles_are_as_exact_and_share_their_triangles() {
    many_are_exact(20);
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn a_hundred_and_twenty_muscles_are_as_exact_and_share_their_triangles() {
    many_are_exact(120);
}

/// Half a megabyte a muscle and four for the skin over them, and every second muscle with the same triangles.
fn many_are_exact(count: usize) {
    let folder = support::folder();
    let document = many(count, folder.path());
    let file = written(&document, folder.path());
    assert!(file.len() <= 4_000_000 + count * 500_000, "{} bytes", file.len());
    let glb = Glb::read(&file);
    let meshes = glb.root()["meshes"].as_array().expect("meshes");
    let indices = |mesh: &serde_json::Value| mesh["primitives"][0]["indices"].as_u64();
    let named = |name: &str| meshes.iter().find(|mesh| mesh["name"] == name).and_then(indices);
    assert!(named("Muscle 0").is_some() && named("Muscle 0") == named("Muscle 18") && named("Muscle 0") != named("Muscle 1"));
    let error = error(&document, &file, 4);
    assert!(error.distance <= APART && error.angle <= 1.0, "{error:?}");
}

#[test]
fn the_same_muscles_give_the_same_bytes() {
    let folder = support::folder();
    let document = open(&support::config("atlas-muscles.yaml"));
    let first = written(&document, folder.path());
    assert!(first == written(&document, folder.path()));
}

#[test]
fn clips_share_the_shapes_of_muscles_and_have_weights_of_their_own() {
    let folder = support::folder();
    let clip = std::fs::read_to_string(support::config("atlas.dae")).expect("there");
    let id = clip.split("<animation id=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("an animation");
    let halves = |(name, start, end): (&str, f64, f64)| {
        format!(
            "<animation_clip id=\"{name}\" name=\"{name}\" start=\"{start}\" end=\"{end}\"><instance_animation url=\"#{id}\"/></animation_clip>"
        )
    };
    let clips: String = [("up", 0.0, 1.7), ("down", 1.7, 4.0)].map(halves).concat();
    let clips = format!("</library_animations><library_animation_clips>{clips}</library_animation_clips>");
    std::fs::write(folder.path().join("atlas.dae"), clip.replace("</library_animations>", &clips)).expect("written");
    let whole = open(&support::config("atlas-muscles.yaml"));
    let muscles = folder.path().join("muscles.yaml");
    std::fs::copy(support::config("atlas-muscles.yaml"), &muscles).expect("copied");
    let document = open(&muscles);
    assert_eq!(document.clips.len(), 2);
    let file = written(&document, folder.path());
    let error = error(&document, &file, 47);
    assert!(error.distance <= APART && error.angle <= 1.0, "{error:?}");
    let one = written(&whole, folder.path()).len();
    assert!(file.len() * 5 <= one * 6, "the shapes of one clip do for both: {} and {one} bytes", file.len());
}

#[test]
fn a_muscle_that_keeps_to_its_bone_has_no_shapes() {
    let folder = support::folder();
    let text = "unit: mm\nclip: atlas.dae\njoint: {bone: forearm, axis: [0.0, 0.0, -1.0], range: [0.0, 140.0]}\nmuscles:\n  - {name: Flat, \
                length: 100.0, radii: [4.0, 8.0, 4.0], growth: [0.0, 1.0, 0.0], origin: {bone: upper_arm, offset: [26.0, 40.0, 0.0]}, \
                insertion: {bone: upper_arm, offset: [26.0, 140.0, 0.0]}}\n";
    std::fs::copy(support::config("atlas.dae"), folder.path().join("atlas.dae")).expect("copied");
    let muscles = folder.path().join("muscles.yaml");
    std::fs::write(&muscles, text).expect("written");
    let document = open(&muscles);
    let file = written(&document, folder.path());
    let glb = Glb::read(&file);
    let mesh = glb.root()["meshes"].as_array().expect("meshes").iter().find(|mesh| mesh["name"] == "Flat").expect("written");
    assert!(mesh.get("weights").is_none() && mesh["primitives"][0].get("targets").is_none());
    let error = error(&document, &file, 12);
    assert!(error.distance <= APART && error.largest_angle < 0.1, "{error:?}");
}
