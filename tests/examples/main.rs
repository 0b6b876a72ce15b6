//! The examples of the crates, run: what they show is true.
#![allow(dead_code, reason = "an example's own main is not called, and prints what the tests compare")]

use sinew::document::Document;
use sinew::formats::SCENE_READERS;

#[path = "../../crates/export/examples/convert.rs"]
mod convert;
#[path = "../../crates/simd/examples/lengths.rs"]
mod lengths;
#[path = "../../crates/collada/examples/list_clips.rs"]
mod list_clips;
#[path = "../../crates/engine/examples/pick.rs"]
mod pick;
#[path = "../../crates/engine/examples/pose_vertices.rs"]
mod pose_vertices;
#[path = "../../crates/export/examples/render_clip.rs"]
mod render_clip;
#[path = "../../crates/i18n/examples/sentences.rs"]
mod sentences;
#[path = "../../crates/muscle/examples/solve_muscle.rs"]
mod solve_muscle;
#[path = "../../crates/yaml/examples/source_spans.rs"]
mod source_spans;
#[path = "../../crates/scene/examples/swing.rs"]
mod swing;
#[path = "../../crates/render/examples/triangle.rs"]
mod triangle;

fn shipped(name: &str) -> Document {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("configs").join(name);
    Document::open(&[path], SCENE_READERS, &Default::default()).expect("a shipped file can be opened")
}

#[test]
fn simd_computes_lengths_with_the_same_bits_everywhere() {
    let (x, y) = (vec![3.0; 32], vec![4.0; 32]);
    let all = lengths::on_every_level(&x, &y);
    assert_eq!(all[0].0, "scalar");
    assert!(all.iter().all(|(_, lengths)| lengths.iter().all(|length| *length == 5.0)));
}

#[test]
fn scene_swings_a_pendulum() {
    let (scene, bob, clip) = swing::pendulum();
    let at = |time| swing::position(&scene, bob, &clip, time);
    assert!((at(0.0).x + 0.5).abs() < 1e-12 && at(1.0).x.abs() < 1e-12 && (at(2.0).x - 0.5).abs() < 1e-12);
    assert!((at(0.7).length() - 1.0).abs() < 1e-12);
}

#[test]
fn yaml_knows_where_values_stand() {
    let lines = source_spans::source_spans("a:\n  - 5\n  - b: six\n").expect("it is YAML");
    assert_eq!(lines, ["2:5 .a[0] = 5", "3:8 .a[1].b = six"]);
}

#[test]
fn i18n_says_a_finding_in_two_languages() {
    let finding = sentences::finding();
    let said = |language| sentences::said_in(language, &finding);
    let [english, russian] = sinew::i18n::Language::ALL.map(said);
    assert!(english.starts_with("arm.yaml:3:7: ") && russian.starts_with("arm.yaml:3:7: ") && english != russian, "{english} {russian}");
}

#[test]
fn collada_lists_a_clip_and_a_finding() {
    let file = list_clips::read_text(list_clips::LIFT.as_bytes(), "lift.dae").expect("it is COLLADA");
    let lines = list_clips::lines(&file);
    assert!(lines[0].ends_with(": 0 s to 1 s, 1 channels"), "{lines:?}");
    assert!(lines[1].starts_with("line 4: count-mismatch"), "{lines:?}");
}

#[test]
fn muscle_keeps_its_volume() {
    let solved = solve_muscle::solve("report", &[0.0, 90.0]).expect("the preset is there");
    assert!(solved[1].length < solved[0].length);
    assert!(solved.iter().all(|solved| solved.volume_error.abs() < 1e-9));
}

#[test]
fn render_draws_a_triangle_and_picks_it() {
    let (picture, hit) = triangle::draw_and_pick().expect("there is memory for it");
    let lit = picture.pixels.iter().filter(|pixel| **pixel != 0).count();
    // Half of a square of two metres, at 7.5 pixels a metre.
    assert!((105..=120).contains(&lit), "{lit}");
    let hit = hit.expect("the triangle is there");
    assert!(hit.surface == Some(0) && hit.point.z == 0.0 && (hit.barycentric.element_sum() - 1.0).abs() < 1e-6);
}

#[test]
fn engine_poses_vertices() {
    let document = shipped("curl.dae");
    let [first, later] = [None, Some(1.5)].map(|time| pose_vertices::vertices(&document, time));
    assert_eq!(first.len(), later.len());
    assert!(first[0].1.iter().all(|vertex| vertex.is_finite()) && first != later, "the arm bends");
}

#[test]
fn engine_picks() {
    let document = Document::built_in();
    // From the upper to the lower edge in the middle, which the arm crosses.
    let mut hits = (0..120).filter_map(|row| pick::pick(&document, 320.0, row as f32 * 4.0 + 2.0).expect("there is memory for picking"));
    assert!(hits.next().is_some_and(|(_, point)| point.is_finite()));
    assert_eq!(pick::pick(&document, -1.0, 5.0).expect("there is memory for picking"), None);
}

#[test]
fn engine_draws_a_clip_and_converts_it() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let document = shipped("walker.dae");
    let picture = render_clip::draw(&document, Some(0.4)).expect("there is memory for it");
    let png = folder.path().join("walker.png");
    render_clip::save(&document, &picture, &png).expect("the folder can be written");
    assert_eq!(image::open(&png).expect("it is a picture").to_rgb8().dimensions(), (640, 480));
    let glb = folder.path().join("walker.glb");
    assert_eq!(convert::convert(&document, &glb).expect("the folder can be written"), Vec::<String>::new());
    assert!(std::fs::read(&glb).expect("it is there").starts_with(b"glTF"));
}
