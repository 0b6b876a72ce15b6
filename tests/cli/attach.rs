//! `sinew attach`.

use std::fs;
use std::path::Path;

use crate::support::humanoid::{Figure, t_pose};
use crate::support::{arg, folder, models, sinew, sinew_ru};

fn shipped(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("configs").join(name)
}

#[test]
fn the_muscles_of_the_walker_come_out_as_they_are_shipped() {
    let folder = folder();
    for name in ["walker.dae", "walker.png"] {
        fs::copy(shipped(name), folder.path().join(name)).expect("a copy");
    }
    let (clip, out) = (folder.path().join("walker.dae"), folder.path().join("walker-muscles.yaml"));
    assert_eq!(sinew(["attach", arg(&clip), "--set", "body", "-o", arg(&out)]).well(), "");
    assert_eq!(fs::read_to_string(&out).expect("a file"), fs::read_to_string(shipped("walker-muscles.yaml")).expect("a file"));
    // What it says opens with its clip, every muscle on its bones.
    let info: serde_json::Value = serde_json::from_str(&sinew(["info", arg(&out), "--json"]).well()).expect("JSON");
    assert_eq!(info["muscles"].as_array().map(Vec::len), Some(76));
    let checked = sinew(["check", arg(&out)]).well();
    for code in ["muscle-bone-not-found", "muscle-joint-not-found", "muscle-wrap-inert", "muscle-too-short", "muscle-path-not-found"] {
        assert!(!checked.contains(code), "{checked}");
    }
}

#[test]
fn a_set_names_its_clip_from_where_it_lies_and_its_models() {
    let folder = folder();
    fs::create_dir(folder.path().join("out")).expect("a folder");
    let clip = models::write(folder.path(), "figure.dae", &Figure::new(t_pose(), "Mixamo").dae());
    let out = folder.path().join("out/arm.yaml");
    sinew(["attach", arg(&clip), "--set", "arm", "--side", "left", "-o", arg(&out)]).well();
    let text = fs::read_to_string(&out).expect("a file");
    assert!(text.contains("clip: \"../figure.dae\"") && text.contains("CC BY 3.0") && text.starts_with("# "), "{text}");
    assert!(text.contains("name: \"BIClong_l\"") && !text.contains("_r\"") && !text.contains("Gait2392"), "{text}");
    let table = sinew(["measure", arg(&out), "--joint", "elbow_flexion_l", "--angles", "0,60", "--csv"]).well();
    assert!(table.contains("BIClong_l"), "{table}");
}

#[test]
fn what_cannot_get_muscles_says_so_in_one_sentence() {
    let folder = folder();
    let out = folder.path().join("out.yaml");
    let whole = models::write(folder.path(), "whole.dae", &Figure::new(t_pose(), "VRM").dae());
    let lame = models::write(folder.path(), "lame.dae", &Figure::new(t_pose(), "VRM").without(&[18]).dae());
    let column = models::write(folder.path(), "column.dae", &models::column());
    let line = sinew(["attach", arg(&lame), "--set", "leg", "-o", arg(&out)]).refused(1);
    assert!(line.contains("lame.dae: The figure lacks joints") && line.contains("right ankle"), "{line}");
    let line = sinew_ru(["attach", arg(&lame), "--set", "leg", "-o", arg(&out)]).refused(1);
    assert!(line.contains("голеностопный сустав справа"), "{line}");
    let line = sinew(["attach", arg(&column), "--set", "body", "-o", arg(&out)]).refused(1);
    assert!(line.contains("No figure of human build"), "{line}");
    for wrong in [
        vec!["attach", arg(&whole), "-o", arg(&out)],
        vec!["attach", arg(&whole), "--set", "tail", "-o", arg(&out)],
        vec!["attach", arg(&whole), "--set", "arm", "--side", "up", "-o", arg(&out)],
        vec!["attach", arg(&whole), "--set", "arm", "-o", "out.txt"],
    ] {
        assert!(!sinew(wrong).refused(2).is_empty());
    }
    assert!(!out.exists());
    // The other leg is whole.
    sinew(["attach", arg(&lame), "--set", "leg", "--side", "left", "-o", arg(&out)]).well();
    let two = Figure::new(t_pose(), "VRM");
    let both = crate::support::humanoid::file(1.0, false, &format!("{}{}", two.scene_nodes("a-"), two.scene_nodes("b-")));
    let both = models::write(folder.path(), "both.dae", &both);
    let notice = sinew(["attach", arg(&both), "--set", "arm", "-o", arg(&out), "--force"]).err;
    assert!(notice.contains("2 figures"), "{notice}");
}
