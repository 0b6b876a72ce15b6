//! `sinew measure` against closed forms.

mod support;

use serde_json::Value;
use support::{arg, config, folder, models, sinew, sinew_ru};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[track_caller]
fn near(got: f64, wanted: f64, tolerance: f64) {
    assert!((got - wanted).abs() <= tolerance, "{got} is not {wanted}");
}

#[test]
fn samples_follow_the_closed_forms() {
    let folder = folder();
    let file = models::write(folder.path(), "arm.yaml", models::BICEPS);
    let report = sinew(["measure", arg(&file), "--angles", "0,17.5,60,90", "--json"]).json();
    assert_eq!(report["unit"], "mm");
    assert_eq!(report["muscles"].as_array().expect("a list").len(), 1);
    let samples = report["muscles"][0]["samples"].as_array().expect("a list");
    let rest = models::cones(&models::BICEPS_RADII, 250.0);
    assert_eq!(samples.len(), 4);
    for (sample, angle) in samples.iter().zip([0.0, 17.5, 60.0, 90.0]) {
        let (length, moment_arm) = models::biceps_length(angle);
        let delta = models::biceps_delta(length);
        assert_eq!(number(&sample["angle"]), angle);
        near(number(&sample["length"]), length, 1e-9);
        near(number(&sample["moment_arm"]), moment_arm, 1e-9);
        near(number(&sample["volume"]), rest, 1e-7);
        near(number(&sample["volume_error"]), 0.0, 1e-12);
        near(number(&sample["delta"]), delta, 1e-9);
        let radii = sample["radii"].as_array().expect("a list");
        assert_eq!(radii.len(), 4);
        for (i, radius) in radii.iter().enumerate() {
            near(number(radius), models::BICEPS_RADII[i] + models::BICEPS_GROWTH[i] * delta, 1e-9);
        }
        assert_eq!(sample["held"], false);
    }
}

#[test]
fn without_angles_it_is_the_reports_experiment() {
    let folder = folder();
    let file = models::write(folder.path(), "arm.yaml", models::BICEPS);
    let report = sinew(["measure", arg(&file), "--json"]).json();
    let angles: Vec<f64> = report["muscles"][0]["samples"].as_array().expect("a list").iter().map(|s| number(&s["angle"])).collect();
    assert_eq!(angles, [0.0, 30.0, 60.0, 90.0]);
}

#[test]
fn csv_has_every_digit_and_points_in_any_language() {
    let folder = folder();
    let file = models::write(folder.path(), "arm.yaml", models::BICEPS);
    let arguments = ["measure", arg(&file), "--sweep", "0:90:22.5", "--csv"];
    let csv = sinew(arguments).well();
    assert_eq!(csv, sinew_ru(arguments).well().replace("Мышца", "Muscle"));
    let mut lines = csv.lines();
    let head: Vec<_> = lines.next().expect("a header").split(',').collect();
    assert_eq!(head[..7], ["muscle", "angle", "length", "moment_arm", "volume", "volume_error", "delta"]);
    assert_eq!(head[head.len() - 4..], ["r1", "r2", "r3", "r4"]);
    let rows: Vec<Vec<_>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.iter().map(|row| row[1]).collect::<Vec<_>>(), ["0", "22.5", "45", "67.5", "90"]);
    for row in rows {
        assert_eq!(row.len(), head.len());
        let (length, _) = models::biceps_length(row[1].parse().expect("a number"));
        near(row[2].parse().expect("a number"), length, 1e-12 * length);
    }
}

#[test]
fn the_table_for_people_speaks_their_language() {
    let folder = folder();
    let file = models::write(folder.path(), "arm.yaml", models::BICEPS);
    let english = sinew(["measure", arg(&file), "--angles", "0,90"]).well();
    assert!(english.contains("length, mm") && english.contains("250.00"), "{english}");
    let russian = sinew_ru(["measure", arg(&file), "--angles", "0,90"]).well();
    assert!(russian.contains("длина") && russian.contains("250,00"), "{russian}");
}

#[test]
fn a_muscle_on_no_arm_is_measured_over_its_contraction() {
    let folder = folder();
    let alone = models::BICEPS.split("\n\n").next().expect("the muscle alone");
    let file = models::write(folder.path(), "alone.yaml", alone);
    let report = sinew(["measure", arg(&file), "--json"]).json();
    let samples = report["muscles"][0]["samples"].as_array().expect("a list");
    assert!(samples.len() > 1);
    let rest = models::cones(&models::BICEPS_RADII, 250.0);
    for sample in samples {
        assert!(sample["angle"].is_null() && sample["moment_arm"].is_null());
        let radii: Vec<f64> = sample["radii"].as_array().expect("a list").iter().map(number).collect();
        near(models::cones(&radii, number(&sample["length"])), rest, 1e-9 * rest);
    }
    let said = sinew(["measure", arg(&file), "--angles", "0"]).refused(2);
    assert!(said.contains(arg(&file)), "{said}");
}

#[test]
fn the_shipped_muscles_keep_their_volume() {
    for name in ["biceps.yaml", "biceps-measured.yaml"] {
        let report = sinew(["measure", arg(&config(name)), "--sweep", "0:130:1", "--json"]).json();
        for muscle in report["muscles"].as_array().expect("a list") {
            let samples = muscle["samples"].as_array().expect("a list");
            let rest = number(&samples[0]["volume"]);
            for sample in samples {
                near(number(&sample["volume_error"]), 0.0, 1e-12);
                let radii: Vec<f64> = sample["radii"].as_array().expect("a list").iter().map(number).collect();
                near(models::cones(&radii, number(&sample["length"])), rest, 1e-9 * rest);
            }
        }
    }
}

#[test]
fn a_clip_has_no_muscle_to_measure() {
    let folder = folder();
    let file = models::write(folder.path(), "column.dae", &models::column());
    let said = sinew(["measure", arg(&file)]).refused(1);
    assert!(said.contains("no muscle"), "{said}");
}
