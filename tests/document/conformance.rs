//! Real clips against reference figures: bounding box, area and centroid of the posed surface, free of vertex order.
//!
//! The models and figures are no part of the project; where their folder is missing the test says so and passes.

use std::path::Path;

use crate::support::obj::{Group, read, whole};
use crate::support::{arg, config, folder, shared, sinew};
use glam::DVec3;
use serde_json::Value;

/// Part of the box's diagonal, and of the area, by which figures may differ.
const TOLERANCE: f64 = 1e-3;

fn vector(value: &Value) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|i| value[i].as_f64().expect("a number")))
}

/// The worst relative difference between a surface and its reference.
fn difference(surface: &Group, wanted: &Value) -> f64 {
    let (low, high) = (vector(&wanted["bbox"][0]), vector(&wanted["bbox"][1]));
    let diagonal = low.distance(high).max(1e-12);
    let (min, max) = surface.bounds();
    let (area, centroid) = surface.area();
    let wanted_area = wanted["area"].as_f64().expect("a number");
    [
        (min - low).abs().max_element() / diagonal,
        (max - high).abs().max_element() / diagonal,
        (centroid - vector(&wanted["area_centroid"])).abs().max_element() / diagonal,
        (area - wanted_area).abs() / wanted_area.max(1e-12),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

/// Exports `model` at the sample's moment; `None` where it is refused in a proper way.
fn exported(model: &Path, sample: &Value) -> Option<Group> {
    let folder = folder();
    let out = folder.path().join("posed.obj");
    let time = sample["t"].as_f64().unwrap_or(0.0).to_string();
    let mut arguments = vec!["export", arg(model), "-o", arg(&out), "--time", &time];
    if let Some(clip) = sample["clip"].as_str() {
        arguments.extend(["--clip", clip]);
    }
    let ended = sinew(&arguments);
    assert!(matches!(ended.code, 0 | 1) && !ended.err.contains("panicked"), "{}: {} {}", model.display(), ended.code, ended.err);
    (ended.code == 0).then(|| whole(&read(&out)))
}

#[test]
fn real_clips_agree_with_their_references() {
    let Some(shared) = shared() else {
        crate::support::left_out("the folder of real-world models is not there (set SINEW_SHARED)");
        return;
    };
    let text = std::fs::read_to_string(shared.join("conformance/expected.json")).expect("the reference figures");
    let expected: Value = serde_json::from_str(&text).expect("JSON");
    let mut failures = Vec::new();
    for (name, entry) in expected.as_object().expect("a map of models") {
        let model = shared.join("models").join(name);
        for sample in entry["samples"].as_array().into_iter().flatten() {
            let surface = exported(&model, sample);
            if sample["bbox"].is_null() {
                continue;
            }
            match surface {
                None => failures.push(format!("{name}: refused")),
                Some(surface) => {
                    let worst = difference(&surface, sample);
                    // A difference that is no number is a failure too.
                    if worst.is_nan() || worst > TOLERANCE {
                        failures.push(format!("{name} at {} s: {worst:.1e}", sample["t"]));
                    }
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_command_survives_every_real_model() {
    let Some(shared) = shared() else {
        crate::support::left_out("the folder of real-world models is not there (set SINEW_SHARED)");
        return;
    };
    let folder = folder();
    let picture = folder.path().join("small.png");
    for entry in std::fs::read_dir(shared.join("models")).expect("readable").flatten() {
        let model = entry.path();
        for arguments in [
            vec!["info", arg(&model), "--json"],
            vec!["check", arg(&model)],
            vec!["render", arg(&model), "-o", arg(&picture), "--size", "160x90", "--bones"],
        ] {
            let ended = sinew(&arguments);
            assert!(matches!(ended.code, 0 | 1) && !ended.err.contains("panicked"), "{arguments:?}: {} {}", ended.code, ended.err);
        }
    }
}

#[test]
fn the_shipped_clips_are_clean_and_move() {
    let mut seen = 0;
    for entry in std::fs::read_dir(config("")).expect("configs is part of the project").flatten() {
        let file = entry.path();
        if file.extension().is_none_or(|ending| ending != "dae") {
            continue;
        }
        seen += 1;
        let info = sinew(["info", arg(&file), "--json"]).json();
        assert_eq!(info["warnings"], serde_json::json!([]), "{}", file.display());
        let clip = &info["clips"][0];
        let (start, duration) = (clip["start"].as_f64().expect("a clip"), clip["duration"].as_f64().expect("a clip"));
        let at = |part: f64| exported(&file, &serde_json::json!({ "t": start + duration * part })).expect("a surface");
        let (first, middle) = (at(0.0), at(0.4));
        let (_, before) = first.area();
        let (_, after) = middle.area();
        let size = first.bounds().1.distance(first.bounds().0);
        assert!(before.distance(after) > 1e-3 * size, "{} does not move", file.display());
    }
    assert!(seen > 0, "no clip is shipped");
}
