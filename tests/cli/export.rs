//! `sinew export` against closed forms.

use std::path::Path;

use crate::support::obj::{Group, read, whole};
use crate::support::{arg, config, folder, models, sinew};
use glam::DVec3;

fn export(file: &Path, options: &[&str]) -> Vec<Group> {
    let folder = folder();
    let out = folder.path().join("out.obj");
    let mut arguments = vec!["export", arg(file), "-o", arg(&out)];
    arguments.extend(options);
    assert_eq!(sinew(&arguments).well(), "");
    let left = std::fs::read_dir(folder.path()).expect("readable").map(|entry| entry.expect("readable").file_name());
    assert!(left.into_iter().all(|name| name == "out.obj" || name == "out.mtl"), "no temporary file stays");
    read(&out)
}

#[track_caller]
fn has_corner(group: &Group, wanted: DVec3) {
    let nearest = group.triangles.iter().flatten().map(|(point, _)| point.distance(wanted)).fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-6, "no corner at {wanted}, the nearest is {nearest} away");
}

#[test]
fn a_skin_stands_where_its_bones_say() {
    let folder = folder();
    let file = models::write(folder.path(), "column.dae", &models::column());
    for (time, degrees) in [("0.5", 0.0), ("1", 45.0), ("1.25", 67.5), ("1.5", 90.0), ("-3", 0.0), ("99", 90.0)] {
        let column = whole(&export(&file, &["--time", time]));
        assert_eq!(column.triangles.len(), 20);
        for (x, y) in [(-10.0, -10.0), (10.0, -10.0), (10.0, 10.0), (-10.0, 10.0)] {
            has_corner(&column, models::column_top(x, y, degrees));
            has_corner(&column, DVec3::new(x, 0.0, -y) * 0.01);
        }
        assert!(column.volume() > 0.0, "faces look outward");
    }
    // Without a time: the start of the clip. The volume of the straight column is that of the box.
    let column = whole(&export(&file, &[]));
    assert!((column.volume() - 0.2 * 0.2 * 2.0).abs() < 1e-7);
    assert!(column.normals_point_out());
}

#[test]
fn mirrored_and_stretched_boxes_face_outward() {
    let folder = folder();
    for (name, transform, volume) in [
        ("plain", "", 1.0),
        ("mirrored", "<scale>-1 1 1</scale>", 1.0),
        ("turned", "<rotate>1 1 0 77</rotate><scale>1 -2 0.5</scale>", 1.0),
        ("sheared", "<matrix>1 0.5 0 0 0 1 0 0 0 0 -3 0 0 0 0 1</matrix>", 3.0),
        ("inside out", "<scale>-1 -1 -1</scale>", 1.0),
    ] {
        let file = models::write(folder.path(), "box.dae", &models::cube(transform));
        let groups = export(&file, &[]);
        assert_eq!(groups.len(), 1);
        assert_eq!(groups[0].name, "box");
        assert!((groups[0].volume() - volume).abs() < 1e-6, "{name}: {}", groups[0].volume());
        assert!(groups[0].normals_point_out(), "{name}");
    }
}

/// Volume between the first and the last ring of a muscle's cones, from its measured radii; the drawn hemispheres are added.
#[test]
fn a_muscles_surface_encloses_its_volume() {
    let folder = folder();
    let file = models::write(folder.path(), "arm.yaml", models::BICEPS);
    let (_, alone) = (0, models::BICEPS.split("\n\n").next().expect("the muscle alone"));
    let free = models::write(folder.path(), "alone.yaml", alone);
    for file in [&file, &free, &config("biceps-measured.yaml")] {
        let measured = sinew(["measure", arg(file), "--json"]).json();
        let name = measured["muscles"][0]["name"].as_str().expect("a name").to_owned();
        let sample = &measured["muscles"][0]["samples"][1];
        let given = match sample["angle"].as_f64() {
            Some(angle) => ["--angle".to_owned(), angle.to_string()],
            None => ["--contraction".to_owned(), "25".to_owned()],
        };
        let groups = export(file, &[&given[0], &given[1]]);
        let muscle = groups.iter().find(|group| group.name == name.replace(' ', "_")).expect("a group named as the muscle");
        let radii: Vec<f64> = sample["radii"].as_array().expect("a list").iter().filter_map(serde_json::Value::as_f64).collect();
        let ends: f64 = [radii[0], radii[radii.len() - 1]].iter().map(|r| 2.0 / 3.0 * std::f64::consts::PI * r.powi(3)).sum();
        let wanted = (models::cones(&radii, sample["length"].as_f64().expect("a number")) + ends) * 1e-9;
        // A ring of 36 corners has 99.5 % of its circle's area; hemispheres of a few rings lose a little more of their small part.
        let ratio = muscle.volume() / wanted;
        assert!((0.985..1.003).contains(&ratio), "{}: {ratio}", file.display());
    }
}

#[test]
fn wrong_targets_are_refused_and_nothing_is_lost() {
    let folder = folder();
    let file = models::write(folder.path(), "column.dae", &models::column());
    let said = sinew(["export", arg(&file), "-o", arg(&folder.path().join("none/out.obj"))]).refused(1);
    assert!(said.contains("folder does not exist"), "{said}");
    let taken = folder.path().join("taken.obj");
    std::fs::create_dir(&taken).expect("writable");
    let said = sinew(["export", arg(&file), "-o", arg(&taken)]).refused(1);
    assert!(said.contains("folder"), "{said}");
    // The file itself under a name that would do, through a link.
    let disguised = folder.path().join("column.obj");
    std::fs::rename(&file, &disguised).expect("ours");
    let said = sinew(["export", arg(&disguised), "-o", arg(&disguised)]).refused(2);
    assert!(said.contains("another name"), "{said}");
    assert_eq!(std::fs::read_to_string(&disguised).expect("still there"), models::column());
    let said = sinew(["export", arg(&disguised), "-o", "x.obj", "--clip", "Jump"]).refused(2);
    assert!(said.contains("Jump"), "{said}");
    let said = sinew(["export", arg(&disguised), "-o", "x.obj", "--angle", "30"]).refused(2);
    assert!(said.contains("--angle"), "{said}");
}

#[test]
fn a_time_without_a_clip_means_the_clip_that_holds_it() {
    let folder = folder();
    let text = models::column();
    let id = text.split("<animation id=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("an animation with an id");
    let clip = |name: &str, start: f64, end: f64| {
        format!("<animation_clip id=\"{name}\" start=\"{start}\" end=\"{end}\"><instance_animation url=\"#{id}\"/></animation_clip>")
    };
    let clips = format!("<library_animation_clips>{}{}</library_animation_clips><scene>", clip("early", 0.5, 0.75), clip("late", 1.0, 1.5));
    let file = models::write(folder.path(), "clips.dae", &text.replace("<scene>", &clips));
    // Between the two the nearer one's end holds.
    for (time, degrees) in [("0.625", 11.25), ("1.25", 67.5), ("0.9", 45.0), ("0.8", 22.5), ("9", 90.0)] {
        has_corner(&whole(&export(&file, &["--time", time])), models::column_top(10.0, 10.0, degrees));
    }
    let early = whole(&export(&file, &["--clip", "early", "--time", "1.25"]));
    has_corner(&early, models::column_top(10.0, 10.0, 22.5));
}

#[test]
fn a_file_without_a_surface_has_nothing_to_export() {
    let folder = folder();
    let bare = models::cube("").replace("<instance_geometry url=\"#cube\"/>", "");
    let file = models::write(folder.path(), "bare.dae", &bare);
    let said = sinew(["export", arg(&file), "-o", arg(&folder.path().join("bare.obj"))]).refused(1);
    assert!(said.contains("no surface"), "{said}");
}

#[test]
fn a_dash_is_no_name_to_write_to_and_is_not_taken_for_standard_input() {
    let clip = config("lamp.dae");
    for call in [&["export", arg(&clip), "-o", "-"][..], &["render", arg(&clip), "-o", "-"], &["convert", arg(&clip), "-"]] {
        let ended = sinew(call);
        assert_eq!(ended.code, 2, "{}", ended.err);
        assert!(ended.err.starts_with("sinew: -: the name must end in"), "{}", ended.err);
    }
}

#[test]
fn clips_are_called_by_their_name_or_their_id() {
    let folder = folder();
    let text = std::fs::read_to_string(config("lamp.dae")).expect("it is shipped");
    let renamed = text.replace("id=\"settle\" name=\"settle\"", "id=\"take-2\" name=\"settle down\"");
    assert_ne!(renamed, text);
    let file = models::write(folder.path(), "lamp.dae", &renamed);
    let at = |clip: &str| export(&file, &["--clip", clip, "--time", "3"]).iter().map(Group::volume).collect::<Vec<_>>();
    assert_eq!(at("settle down"), at("take-2"));
    let out = folder.path().join("out.obj");
    assert_eq!(sinew(["export", arg(&file), "-o", arg(&out), "--clip", "settle"]).code, 2);
}
