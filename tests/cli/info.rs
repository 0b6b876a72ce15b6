//! `sinew info` and `sinew check`.

use crate::support::{arg, folder, models, sinew, sinew_ru};

/// The keys of an object in the order in which they stand in the text.
fn keys_in_order(text: &str, indent: usize) -> Vec<String> {
    let margin = " ".repeat(indent);
    text.lines()
        .filter_map(|line| line.strip_prefix(&margin)?.strip_prefix('"')?.split_once("\":").map(|(key, _)| key.to_owned()))
        .collect()
}

#[test]
fn json_has_every_field_of_the_contract() {
    let folder = folder();
    let file = models::write(folder.path(), "column.dae", &models::column());
    let text = sinew(["info", arg(&file), "--json"]).well();
    assert_eq!(
        keys_in_order(&text, 2),
        [
            "file",
            "format",
            "version",
            "authoring_tool",
            "up_axis",
            "unit_metres",
            "nodes",
            "joints",
            "meshes",
            "clips",
            "materials",
            "images",
            "muscles",
            "bounds",
            "warnings"
        ]
    );
    let info: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(info["format"], "collada");
    assert_eq!(info["version"], "1.4.1");
    assert_eq!(info["authoring_tool"], "Sinew's tests");
    assert_eq!(info["up_axis"], "Z_UP");
    assert_eq!(info["unit_metres"], 0.01);
    assert_eq!(info["nodes"], 3);
    assert_eq!(info["joints"], 2);
    assert_eq!(info["materials"], 1);
    let mesh = &info["meshes"][0];
    assert_eq!(mesh["name"], "column");
    assert_eq!(mesh["vertices"], 12);
    assert_eq!(mesh["triangles"], 20);
    assert_eq!(mesh["skinned"], true);
    assert_eq!(mesh["joints"], 2);
    assert_eq!(mesh["morph_targets"], 0);
    let clip = &info["clips"][0];
    assert!(clip["name"].as_str().is_some_and(|name| !name.is_empty()));
    assert_eq!(clip["start"], 0.5);
    assert_eq!(clip["duration"], 1.0);
    assert_eq!(clip["channels"], 1);
    assert_eq!(clip["keyframes"], 2);
    assert_eq!(info["images"], serde_json::json!([]));
    assert_eq!(info["muscles"], serde_json::json!([]));
    assert_eq!(info["warnings"], serde_json::json!([]));
    // Metres, Y up, at the start of the clip: the straight column.
    for (corner, wanted) in [("min", [-0.1, 0.0, -0.1]), ("max", [0.1, 2.0, 0.1])] {
        for (i, wanted) in wanted.iter().enumerate() {
            let got = info["bounds"][corner][i].as_f64().expect("a number");
            assert!((got - wanted).abs() < 1e-6, "{corner} {i}: {got}");
        }
    }
}

#[test]
fn a_muscle_file_says_rest_length_and_volume() {
    let folder = folder();
    let file = models::write(folder.path(), "arm.yaml", models::BICEPS);
    let info = sinew(["info", arg(&file), "--json"]).json();
    assert_eq!(info["format"], "muscle");
    assert_eq!(info["unit_metres"], 0.001);
    let muscle = &info["muscles"][0];
    assert_eq!(muscle["nodes"], 4);
    assert_eq!(muscle["rest_length"], 250.0);
    let volume = muscle["volume"].as_f64().expect("a number");
    let wanted = models::cones(&models::BICEPS_RADII, 250.0);
    assert!((volume / wanted - 1.0).abs() < 1e-12, "{volume} {wanted}");
}

#[test]
fn the_text_for_people_speaks_their_language() {
    let folder = folder();
    let file = models::write(folder.path(), "column.dae", &models::column());
    let english = sinew(["info", arg(&file)]).well();
    for part in ["collada 1.4.1", "Sinew's tests", "Z_UP", "0.01 m", "12 vertices, 20 triangles", "0.500 s to 1.500 s", "2.000"] {
        assert!(english.contains(part), "{part}:\n{english}");
    }
    let russian = sinew_ru(["info", arg(&file)]).well();
    for part in ["Полигональная сетка", "Клип", "0,01 м", "вершин 12", "0,500 с"] {
        assert!(russian.contains(part), "{part}:\n{russian}");
    }
    assert!(!english.contains("cli-") && !russian.contains("cli-") && !english.contains("NUMBER"));
}

#[test]
fn a_missing_image_is_told_everywhere() {
    let folder = folder();
    let text = models::column()
        .replace(
            "<library_effects>",
            "<library_images><image id=\"skin\"><init_from>skin.png</init_from></image></library_images><library_effects>",
        )
        .replace("<color>0.8 0.1 0.1 1</color>", "<texture texture=\"skin\" texcoord=\"UV\"/>");
    let file = models::write(folder.path(), "column.dae", &text);
    let info = sinew(["info", arg(&file), "--json"]).json();
    assert_eq!(info["images"], serde_json::json!([{ "uri": "skin.png", "found": false }]));
    let warning =
        info["warnings"].as_array().expect("a list").iter().find(|w| w["message"].as_str().is_some_and(|m| m.contains("skin.png")));
    let warning = warning.expect("a warning about the image");
    assert!(warning["code"].is_string() && warning["line"].is_u64(), "{warning}");
    let report = sinew(["check", arg(&file)]).well();
    let line = report.lines().find(|line| line.contains("skin.png")).expect("a line about the image");
    assert!(line.starts_with(&format!("{}:", arg(&file))), "{line}");
    let json = sinew(["check", arg(&file), "--json"]).json();
    assert!(!json["files"][0]["findings"].as_array().expect("a list").is_empty());
    // Now it is there.
    let white = png_file(2, 2);
    std::fs::write(folder.path().join("skin.png"), white).expect("writable");
    let info = sinew(["info", arg(&file), "--json"]).json();
    assert_eq!(info["images"][0]["found"], true);
}

fn png_file(width: u32, height: u32) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("memory is writable");
    writer.write_image_data(&vec![255; (width * height * 3) as usize]).expect("memory is writable");
    writer.finish().expect("memory is writable");
    file
}

#[test]
fn a_clean_file_has_a_clean_report() {
    let folder = folder();
    let file = models::write(folder.path(), "column.dae", &models::column());
    assert_eq!(sinew(["check", arg(&file)]).well(), format!("{}: no problems.\n", arg(&file)));
    assert_eq!(sinew_ru(["check", arg(&file)]).well(), format!("{}: проблем нет.\n", arg(&file)));
}

#[test]
fn a_session_file_tells_of_its_files() {
    let folder = folder();
    models::write(folder.path(), "column.dae", &models::column());
    let session = models::write(folder.path(), "look.session.yaml", "sinew_session:\n  files: [column.dae]\n  time: 1\n");
    let info: serde_json::Value = serde_json::from_str(&sinew(["info", arg(&session), "--json"]).well()).expect("JSON");
    assert_eq!((info["format"].as_str(), info["joints"].as_u64()), (Some("collada"), Some(2)));
    assert!(info["file"].as_str().is_some_and(|file| file.ends_with("look.session.yaml")));
    let missing = models::write(folder.path(), "gone.session.yaml", "sinew_session:\n  files: [gone.dae]\n");
    assert!(sinew(["info", arg(&missing)]).refused(1).contains("gone.dae"));
}
