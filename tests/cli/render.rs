//! `sinew render`: pictures, sequences, animations.

use std::fs;
use std::path::{Path, PathBuf};

use crate::support::picture::{Picture, play, read};
use crate::support::{arg, call, config, folder, models, run, sinew};

/// Renders to a PNG in a folder of its own and reads it.
fn render(file: &Path, options: &[&str]) -> Picture {
    let folder = folder();
    let out = folder.path().join("out.png");
    let mut arguments = vec!["render", arg(file), "-o", arg(&out)];
    arguments.extend(options);
    assert_eq!(sinew(&arguments).well(), "");
    read(&out)
}

fn column(folder: &Path) -> PathBuf {
    models::write(folder, "column.dae", &models::column())
}

const SMALL: [&str; 2] = ["--size", "96x72"];

fn small<'a>(more: &[&'a str]) -> Vec<&'a str> {
    SMALL.iter().chain(more).copied().collect()
}

#[test]
fn a_picture_has_the_size_asked_for_and_shows_the_model() {
    let folder = folder();
    let file = column(folder.path());
    let picture = render(&file, &["--size", "101x67", "--background", "#102030"]);
    assert_eq!((picture.size, picture.channels), ((101, 67), 3));
    assert_eq!(picture.pixel(0, 0), [0x10, 0x20, 0x30]);
    let covered = picture.unlike(&[0x10, 0x20, 0x30]);
    assert!((100..4000).contains(&covered), "{covered} pixels");
    assert_eq!(render(&file, &["--size", "1x1"]).size, (1, 1));
    let (_, note) = picture.notes.iter().find(|(keyword, _)| keyword == "Comment").expect("how it was made");
    assert!(note.starts_with("sinew render ") && note.contains("--size 101x67") && note.contains("--time 0.5"), "{note}");
}

#[test]
fn without_a_background_the_picture_is_transparent() {
    let folder = folder();
    let picture = render(&column(folder.path()), &small(&["--background", "none"]));
    assert_eq!(picture.channels, 4);
    assert_eq!(picture.pixel(0, 0), [0, 0, 0, 0]);
    let solid = picture.bytes.chunks_exact(4).filter(|pixel| pixel[3] == 255).count();
    assert!(solid > 100, "{solid}");
}

#[test]
fn the_picture_is_the_same_for_any_number_of_threads() {
    let folder = folder();
    let file = column(folder.path());
    for shading in ["flat", "gouraud", "phong"] {
        for samples in ["1", "4"] {
            let options = |threads| small(&["--shading", shading, "--samples", samples, "--bones", "--wireframe", "--threads", threads]);
            let one = render(&file, &options("1"));
            for threads in ["2", "3", "7"] {
                assert!(one == render(&file, &options(threads)), "{shading} {samples} {threads}");
            }
        }
    }
}

#[test]
fn options_change_the_picture() {
    let folder = folder();
    let file = column(folder.path());
    let base = ["--time", "1", "--background", "black"];
    let draw = |file: &Path, options: &[&str]| render(file, &small(options)).bytes;
    let plain = draw(&file, &base);
    for more in [
        &["--bones"][..],
        &["--wireframe"],
        &["--no-materials"],
        &["--shading", "flat"],
        &["--samples", "1"],
        &["--light", "-5,0,0"],
        &["--yaw", "-30"],
        &["--pitch", "-10.5"],
        &["--zoom", "1.5"],
        &["--camera", "front"],
        &["--camera", "right"],
        &["--camera", "top"],
        &["--camera", "iso"],
    ] {
        let options: Vec<_> = base.iter().chain(more).copied().collect();
        assert!(plain != draw(&file, &options), "{more:?} changes nothing");
    }
    // Smooth normals of a muscle against flat triangles.
    let muscle = models::write(folder.path(), "arm.yaml", models::BICEPS);
    assert!(draw(&muscle, &[]) != draw(&muscle, &["--no-normals"]));
    assert!(draw(&muscle, &["--angle", "0"]) != draw(&muscle, &["--angle", "90"]));
    assert!(draw(&muscle, &["--contraction", "0"]) == draw(&muscle, &["--angle", "0"]));
    // Muscles under the skin of a clip show through it; the rods of an arm cover nothing.
    let covered = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/curl-muscles.yaml");
    assert!(draw(&covered, &[]) != draw(&covered, &["--no-see-through"]));
    // On a clip the joint that the muscle crosses is bent; the biceps is longest at one end of its range and shortest at the other.
    assert!(draw(&covered, &["--contraction", "0"]) == draw(&covered, &["--angle", "0"]));
    assert!(draw(&covered, &["--contraction", "100"]) == draw(&covered, &["--angle", "140"]));
    assert!(draw(&muscle, &[]) == draw(&muscle, &["--no-see-through"]));
    // The default, said aloud.
    assert!(plain == draw(&file, &["--time", "1", "--background", "black", "--camera", "orbit", "--shading", "gouraud", "--samples", "4"]));
}

#[test]
fn parallel_views_show_true_proportions() {
    let folder = folder();
    // 1 × 1 × 1 stretched to 3 wide, 1 high, 0.5 deep.
    let file = models::write(folder.path(), "box.dae", &models::cube("<scale>3 1 0.5</scale>"));
    for (camera, ratio) in [("front", 3.0), ("right", 0.5), ("top", 6.0)] {
        let picture = render(&file, &["--size", "400x400", "--camera", camera, "--background", "black", "--samples", "1"]);
        let [left, right, top, bottom] = picture.extent(&[0, 0, 0]).expect("the box is in the picture");
        assert!(left > 0 && right < 399 && top > 0 && bottom < 399, "{camera}: all of it is in the picture");
        let (width, height) = (f64::from(right - left + 1), f64::from(bottom - top + 1));
        assert!((width - ratio * height).abs() <= 1.0 + ratio, "{camera}: {width} × {height}");
        // In the middle.
        assert!((left + right).abs_diff(399) <= 2 && (top + bottom).abs_diff(399) <= 2, "{camera}");
    }
}

#[test]
fn frames_of_a_sequence_are_the_single_pictures() {
    let folder = folder();
    let file = column(folder.path());
    let pattern = folder.path().join("frame-%04d.png");
    let call = ["render", arg(&file), "-o", arg(&pattern), "--from", "0.5", "--to", "1.5", "--fps", "4", "--size", "96x72"];
    assert_eq!(sinew(call).well(), "");
    for (number, time) in ["0.5", "0.75", "1", "1.25", "1.5"].iter().enumerate() {
        let frame = read(&folder.path().join(format!("frame-{number:04}.png")));
        assert!(frame == render(&file, &small(&["--time", time])), "frame {number}");
    }
    assert!(!folder.path().join("frame-0005.png").exists());
    // Without a range: the whole clip.
    let all = folder.path().join("all-%d.png");
    sinew(["render", arg(&file), "-o", arg(&all), "--fps", "4", "--size", "96x72"]).well();
    assert!(read(&folder.path().join("all-4.png")) == render(&file, &small(&["--time", "1.5"])));
    // An arm without a clip swings, and each picture says how to make it again.
    let muscle = models::write(folder.path(), "arm.yaml", models::BICEPS);
    let swing = folder.path().join("swing-%d.png");
    sinew(["render", arg(&muscle), "-o", arg(&swing), "--from", "0", "--to", "1", "--fps", "8", "--size", "96x72"]).well();
    let bent = read(&folder.path().join("swing-4.png"));
    assert!(bent == render(&muscle, &small(&["--contraction", "100"])));
    assert!(read(&folder.path().join("swing-0.png")).bytes == read(&folder.path().join("swing-8.png")).bytes);
}

#[test]
fn an_animation_has_its_frames_and_delays() {
    let folder = folder();
    let file = column(folder.path());
    let out = folder.path().join("bend.gif");
    let call = ["render", arg(&file), "-o", arg(&out), "--size", "96x72", "--fps", "12", "--background", "#204060"];
    assert_eq!(sinew(call).well(), "");
    let (size, frames) = play(&out);
    assert_eq!((size, frames.len()), ((96, 72), 13));
    assert_eq!(frames.iter().map(|frame| u32::from(frame.delay)).sum::<u32>(), 108);
    for (frame, time) in [(0, "0.5"), (6, "1"), (12, "1.5")] {
        let single = render(&file, &small(&["--background", "#204060", "--time", time]));
        let pairs = frames[frame].rgba.chunks_exact(4).zip(single.bytes.chunks_exact(3));
        let worst = pairs.map(|(a, b)| (0..3).map(|i| u32::from(a[i].abs_diff(b[i]))).sum::<u32>()).max().expect("pixels");
        assert!(worst < 72, "frame {frame} is off by {worst}");
        assert_eq!(frames[frame].rgba[..4], [0x20, 0x40, 0x60, 255]);
    }
}

#[test]
fn a_turntable_goes_round_once() {
    let folder = folder();
    let file = models::write(folder.path(), "box.dae", &models::cube(""));
    let out = folder.path().join("turn.gif");
    let call = ["render", arg(&file), "-o", arg(&out), "--turntable", "--fps", "5", "--size", "96x72", "--background", "none"];
    sinew(call).well();
    let (_, frames) = play(&out);
    assert_eq!(frames.len(), 20, "four seconds, and the first frame does not come again");
    assert_eq!(frames[0].rgba[..4], [0; 4]);
    assert!(frames[0].rgba != frames[5].rgba);
    // The cube looks alike after each quarter, up to its light.
    let covered = |frame: usize| frames[frame].rgba.chunks_exact(4).filter(|pixel| pixel[3] != 0).count();
    assert!(covered(0).abs_diff(covered(10)) <= covered(0) / 50);
}

#[test]
fn stats_name_every_stage() {
    let folder = folder();
    let file = column(folder.path());
    let ended = sinew(["render", arg(&file), "-o", arg(&folder.path().join("a-%d.png")), "--fps", "10", "--size", "64x64", "--stats"]);
    assert_eq!((ended.code, ended.out.as_str()), (0, ""));
    let stages: Vec<_> = ended.err.lines().map(|line| line.split(' ').collect::<Vec<_>>()).collect();
    assert_eq!(stages.iter().map(|words| words[0]).collect::<Vec<_>>(), ["pose", "deform", "vertex", "raster", "resolve"]);
    for words in stages {
        assert!(words[1].parse::<f64>().is_ok_and(|ms| (0.0..1e4).contains(&ms)) && words[2] == "ms", "{words:?}");
    }
}

#[test]
fn wrong_calls_about_the_file_are_refused() {
    let folder = folder();
    let file = column(folder.path());
    let out = folder.path().join("x.png");
    let refused = |options: &[&str], code, part: &str| {
        let mut arguments = vec!["render", arg(&file), "-o", arg(&out)];
        arguments.extend(options);
        let said = sinew(&arguments).refused(code);
        assert!(said.contains(part), "{options:?}: {said}");
        assert!(!out.exists());
    };
    refused(&["--clip", "Jump"], 2, "Jump");
    refused(&["--angle", "30"], 2, "No elbow");
    refused(&["--from", "1"], 2, "frame-%04d.png");
    refused(&["--fps", "10"], 2, "frame-%04d.png");
    refused(&["--turntable"], 2, ".gif");
    let gif = folder.path().join("x.gif");
    for (options, part) in
        [(&["--from", "2", "--to", "1"][..], "no frame to draw"), (&["--fps", "60"], "50"), (&["--from", "0", "--to", "1e9"], "100000")]
    {
        let mut arguments = vec!["render", arg(&file), "-o", arg(&gif)];
        arguments.extend(options);
        let said = sinew(&arguments).refused(2);
        assert!(said.contains(part), "{options:?}: {said}");
    }
    let said = sinew(["render", arg(&file), "-o", arg(&folder.path().join("none/x.png"))]).refused(1);
    assert!(said.contains("folder does not exist"), "{said}");
    assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 1, "nothing but the model is left");
}

#[test]
fn a_picture_never_replaces_what_it_was_made_from() {
    let folder = folder();
    let disguised = folder.path().join("column.png");
    fs::write(&disguised, models::column()).expect("writable");
    let said = sinew(["render", arg(&disguised), "-o", arg(&disguised)]).refused(2);
    assert!(said.contains("another name"), "{said}");
    // Nor a texture of the model.
    let text = models::column()
        .replace(
            "<library_effects>",
            "<library_images><image id=\"skin\"><init_from>skin.png</init_from></image></library_images><library_effects>",
        )
        .replace("<color>0.8 0.1 0.1 1</color>", "<texture texture=\"skin\" texcoord=\"UV\"/>");
    let file = models::write(folder.path(), "textured.dae", &text);
    let texture = folder.path().join("skin.png");
    sinew(["render", arg(&config("biceps.yaml")), "-o", arg(&texture), "--size", "8x8"]).well();
    let before = fs::read(&texture).expect("there");
    sinew(["render", arg(&file), "-o", arg(&texture)]).refused(2);
    assert_eq!(fs::read(&texture).expect("there"), before);
}

#[test]
fn files_are_drawn_side_by_side_and_standard_input_is_one() {
    let folder = folder();
    let file = column(folder.path());
    let out = folder.path().join("both.png");
    sinew(["render", arg(&file), arg(&config("biceps.yaml")), "-o", arg(&out), "--size", "64x64"]).well();
    assert_eq!(read(&out).size, (64, 64));
    run(call(["render", "-", "-o", arg(&out), "--size", "32x32"]), models::column().as_bytes()).well();
    assert_eq!(read(&out).size, (32, 32));
}

#[cfg(unix)]
#[test]
fn a_new_picture_has_the_usual_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let file = column(folder.path());
    let out = folder.path().join("x.png");
    sinew(["render", arg(&file), "-o", arg(&out), "--size", "8x8"]).well();
    let model = fs::metadata(&file).expect("there").permissions().mode();
    assert_eq!(fs::metadata(&out).expect("there").permissions().mode() & 0o777, model & 0o777);
}

#[test]
fn a_session_is_drawn_as_it_was_looked_at() {
    let folder = folder();
    column(folder.path());
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, format!("sinew_session:\n  files: [column.dae]\n  shown: [mesh, materials, smooth-normals, depth-test]\n{text}"))
            .expect("written");
        path
    };
    let session = write("a.session.yaml", "  time: 1.0\n  shading: flat\n  smooth-edges: false\n  backdrop: black\n");
    let options = small(&["--time", "1.0", "--shading", "flat", "--samples", "1", "--background", "#000000"]);
    let plain = render(&folder.path().join("column.dae"), &options);
    assert_eq!(render(&session, &SMALL).bytes, plain.bytes);
    // Options of the call go before what the session says, and its camera and hidden nodes count.
    assert_ne!(render(&session, &small(&["--time", "0.5"])).bytes, plain.bytes);
    let camera = "  camera: {target: [0, 0, 0], yaw: 90, pitch: 0, distance: 3}\n";
    let from_the_side = write("b.session.yaml", camera);
    assert_ne!(render(&from_the_side, &SMALL).bytes, render(&write("c.session.yaml", ""), &SMALL).bytes);
    assert_eq!(render(&from_the_side, &small(&["--yaw", "30", "--pitch", "18"])).bytes, render(&write("c.session.yaml", ""), &SMALL).bytes);
    let hidden = write("d.session.yaml", "  hidden: [{node: 0, name: column}]\n  backdrop: black\n  smooth-edges: false\n");
    assert_eq!(render(&hidden, &SMALL).unlike(&[0, 0, 0]), 0);
    // Other moments and what is compared are drawn as the window draws them: more than the scene alone, and all of it.
    fs::copy(folder.path().join("column.dae"), folder.path().join("other.dae")).expect("copied");
    let alone = render(&write("f.session.yaml", "  time: 0.5\n  backdrop: black\n"), &SMALL).unlike(&[0, 0, 0]);
    for (name, text) in [
        ("ghosts", "  ghosts: {shown: true, before: 1, after: 1, step: 12}\n  frame-rate: 24\n"),
        ("file", "  compared: {file: other.dae, later: 0.5, aside: 0.0}\n"),
        ("skinning", "  compared: {skinning: true, later: 0.0, aside: 0.4}\n"),
    ] {
        let session = write(&format!("{name}.session.yaml"), &format!("  time: 0.5\n  backdrop: black\n{text}"));
        let shown = render(&session, &SMALL).unlike(&[0, 0, 0]);
        assert!(shown > alone + alone / 20, "{name}: {shown} against {alone}");
    }
    let out = folder.path().join("x.png");
    let line = sinew(["render", arg(&write("e.session.yaml", "  time: soon\n")), "-o", arg(&out)]).refused(1);
    assert!(line.contains("e.session.yaml") && line.contains('4'), "{line}");
}
