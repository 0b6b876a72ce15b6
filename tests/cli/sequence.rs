//! Sequences and surfaces from the command line: every frame is the single picture, delays are exact, and what fails leaves nothing behind.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::picture::read;
use crate::support::{arg, call, config, folder, models, run, sinew, sinew_ru};

fn column(folder: &Path) -> PathBuf {
    models::write(folder, "column.dae", &models::column())
}

/// The files of a folder by name.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        fs::read_dir(folder).expect("readable").map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The frames of an APNG as they are shown, with their delays.
fn apng(file: &Path) -> Vec<(Vec<u8>, (u16, u16))> {
    let bytes = fs::read(file).expect("there");
    let mut reader = png::Decoder::new(Cursor::new(&bytes)).read_info().expect("a PNG");
    let (width, height, count) = {
        let info = reader.info();
        (info.width as usize, info.height as usize, info.animation_control().expect("an animation").num_frames)
    };
    let mut screen = vec![0; width * height * 3];
    (0..count)
        .map(|_| {
            let mut buffer = vec![0; width * height * 3];
            reader.next_frame(&mut buffer).expect("complete");
            let frame = *reader.info().frame_control().expect("a frame");
            let row = frame.width as usize * 3;
            for y in 0..frame.height as usize {
                let to = ((frame.y_offset as usize + y) * width + frame.x_offset as usize) * 3;
                screen[to..to + row].copy_from_slice(&buffer[y * row..(y + 1) * row]);
            }
            (screen.clone(), (frame.delay_num, frame.delay_den))
        })
        .collect()
}

#[test]
fn apng_frames_are_the_single_pictures_with_exact_delays() {
    let folder = folder();
    let file = column(folder.path());
    let out = folder.path().join("bend.apng");
    sinew(["render", arg(&file), "-o", arg(&out), "--size", "96x72", "--fps", "12"]).well();
    let frames = apng(&out);
    assert_eq!(frames.len(), 13);
    let single = folder.path().join("single.png");
    for (index, (pixels, delay)) in frames.iter().enumerate() {
        assert_eq!(*delay, (1, 12));
        let time = (0.5 + index as f64 / 12.0).to_string();
        sinew(["render", arg(&file), "-o", arg(&single), "--size", "96x72", "--time", &time]).well();
        assert!(*pixels == read(&single).bytes, "frame {index}");
    }
}

#[test]
fn sweeps_go_from_one_end_to_the_other() {
    let folder = folder();
    let muscle = config("biceps-measured.yaml");
    let single = folder.path().join("single.png");
    for (sweep, option, ends) in [("--sweep-angle", "--angle", ["20", "90"]), ("--sweep-contraction", "--contraction", ["100", "0"])] {
        let pattern = folder.path().join("s-%d.png");
        let range = ends.join(":");
        let call = ["render", arg(&muscle), "-o", arg(&pattern), sweep, &range, "--duration", "1", "--fps", "4", "--size", "80x60"];
        sinew(call).well();
        for (frame, value) in [("s-0.png", ends[0]), ("s-4.png", ends[1])] {
            sinew(["render", arg(&muscle), "-o", arg(&single), option, value, "--size", "80x60"]).well();
            assert!(read(&folder.path().join(frame)).bytes == read(&single).bytes, "{sweep} {value}");
        }
        assert!(!folder.path().join("s-5.png").exists());
    }
    // An arm of a clip bends too.
    let out = folder.path().join("curl.gif");
    let curl = config("curl.dae");
    sinew(["render", arg(&curl), "-o", arg(&out), "--sweep-angle", "0:90", "--duration", "0.5", "--fps", "10", "--size", "64x48"]).well();
    assert_eq!(crate::support::picture::play(&out).1.len(), 6);
    let said = sinew(["render", arg(&column(folder.path())), "-o", arg(&out), "--sweep-contraction", "0:100"]).refused(2);
    assert!(said.contains("no muscle"), "{said}");
}

#[test]
fn a_scaled_picture_has_more_pixels_and_the_same_view() {
    let folder = folder();
    let file = column(folder.path());
    let (one, two) = (folder.path().join("1.png"), folder.path().join("2.png"));
    sinew(["render", arg(&file), "-o", arg(&one), "--size", "96x72", "--background", "black"]).well();
    sinew(["render", arg(&file), "-o", arg(&two), "--size", "96x72", "--background", "black", "--scale", "2"]).well();
    let (one, two) = (read(&one), read(&two));
    assert_eq!((one.size, two.size), ((96, 72), (192, 144)));
    let (a, b) = (one.unlike(&[0, 0, 0]), two.unlike(&[0, 0, 0]));
    assert!((b as f64 / a as f64 - 4.0).abs() < 0.5, "{a} {b}");
    let said = sinew(["render", arg(&file), "-o", arg(folder.path()), "--size", "9000x10", "--scale", "2"]).refused(2);
    assert!(said.contains("ending"), "{said}");
    let never = folder.path().join("never.png");
    let said = sinew(["render", arg(&file), "-o", arg(&never), "--size", "9000x10", "--scale", "2"]).refused(2);
    assert!(said.contains("16384"), "{said}");
    // What helps on the screen can be had in the picture.
    let plain = read(&folder.path().join("1.png")).bytes;
    for overlay in ["--grid", "--axes", "--bounding-box"] {
        let out = folder.path().join("overlay.png");
        sinew(["render", arg(&file), "-o", arg(&out), "--size", "96x72", "--background", "black", overlay]).well();
        assert!(read(&out).bytes != plain, "{overlay} changes nothing");
    }
}

#[test]
fn films_are_made_by_ffmpeg_where_it_is() {
    let folder = folder();
    let file = column(folder.path());
    let there = Command::new("ffmpeg").arg("-version").output().is_ok_and(|output| output.status.success());
    if !there {
        crate::support::left_out("ffmpeg is not here, so videos are not made");
        return;
    }
    for name in ["bend.mp4", "bend.webm"] {
        let out = folder.path().join(name);
        sinew(["render", arg(&file), "-o", arg(&out), "--size", "97x71", "--fps", "12"]).well();
        // Decoded again: as many frames, of even sides.
        let output = Command::new("ffprobe")
            .args([
                "-v",
                "error",
                "-count_frames",
                "-select_streams",
                "v:0",
                "-show_entries",
                "stream=width,height,nb_read_frames",
                "-of",
                "csv=p=0",
            ])
            .arg(&out)
            .output()
            .expect("ffprobe comes with ffmpeg");
        assert_eq!(String::from_utf8_lossy(&output.stdout).trim().trim_end_matches(','), "98,72,13", "{name}");
    }
    assert_eq!(names(folder.path()), ["bend.mp4", "bend.webm", "column.dae"]);
}

#[test]
fn without_ffmpeg_one_sentence_says_so() {
    let folder = folder();
    let file = column(folder.path());
    let out = folder.path().join("bend.mp4");
    fs::write(&out, "old").expect("writable");
    let mut command = call(["render", arg(&file), "-o", arg(&out), "--size", "32x32"]);
    command.env("PATH", folder.path());
    let said = run(command, b"").refused(1);
    assert!(said.contains("ffmpeg") && said.contains("not installed"), "{said}");
    assert_eq!(fs::read_to_string(&out).expect("there"), "old");
    assert_eq!(names(folder.path()), ["bend.mp4", "column.dae"]);
}

#[cfg(unix)]
#[test]
fn an_ffmpeg_that_fails_leaves_the_old_film() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let file = column(folder.path());
    let tools = folder.path().join("tools");
    fs::create_dir(&tools).expect("writable");
    let fake = tools.join("ffmpeg");
    let script = |encoders: &str| {
        format!(
            "#!/bin/sh\nfor word; do case \"$word\" in -encoders) echo ' V....D {encoders} x'; exit 0;; esac; last=$word; done\n\
                 echo half > \"$last\"; head -c 3000 > /dev/null; echo 'no luck today' >&2; exit 1\n"
        )
    };
    let out = folder.path().join("bend.mp4");
    fs::write(&out, "old").expect("writable");
    for (encoders, part) in [("libx264", "no luck today"), ("none", "libx264")] {
        fs::write(&fake, script(encoders)).expect("writable");
        fs::set_permissions(&fake, fs::Permissions::from_mode(0o755)).expect("ours");
        let mut command = call(["render", arg(&file), "-o", arg(&out), "--size", "64x64"]);
        command.env("PATH", format!("{}:/usr/bin:/bin", tools.display()));
        let said = run(command, b"").refused(1);
        assert!(said.contains(part), "{said}");
        assert_eq!(fs::read_to_string(&out).expect("there"), "old");
        assert_eq!(names(folder.path()), ["bend.mp4", "column.dae", "tools"]);
    }
}

/// A file system of 200 kB, gone when the test is over.
#[cfg(target_os = "linux")]
struct Small(tempfile::TempDir);

#[cfg(target_os = "linux")]
impl Small {
    fn mount() -> Option<Self> {
        let folder = folder();
        let mounted = Command::new("mount").args(["-t", "tmpfs", "-o", "size=200k", "tmpfs"]).arg(folder.path()).output();
        mounted.is_ok_and(|output| output.status.success()).then_some(Self(folder))
    }
}

#[cfg(target_os = "linux")]
impl Drop for Small {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.0.path()).status();
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_what_was_there() {
    let elsewhere = folder();
    let file = column(elsewhere.path());
    let Some(small) = Small::mount() else {
        crate::support::left_out("only root can mount a small disk");
        return;
    };
    let at = |name: &str| small.0.path().join(name);
    for name in ["a.png", "f-0000.png", "a.gif", "a.apng", "a.obj", "a.ply", "a.stl"] {
        fs::write(at(name), "old").expect("room for a few");
    }
    let before = names(small.0.path());
    let noisy = ["--size", "900x700", "--fps", "25", "--wireframe", "--bones"];
    for name in ["f-%04d.png", "a.gif", "a.apng"] {
        let out = at(name);
        let mut arguments = vec!["render", arg(&file), "-o", arg(&out), "--turntable"];
        arguments.extend(noisy);
        let said = sinew(&arguments).refused(1);
        assert!(said.contains("disk is full"), "{name}: {said}");
        assert_eq!(names(small.0.path()), before, "{name}");
    }
    let muscle = config("atlas.dae");
    for name in ["a.obj", "a.ply", "a.stl"] {
        let out = at(name);
        let said = sinew(["export", arg(&muscle), "-o", arg(&out)]).refused(1);
        assert!(said.contains("disk is full"), "{name}: {said}");
        assert_eq!(names(small.0.path()), before, "{name}");
    }
    for name in before {
        assert_eq!(fs::read_to_string(at(&name)).expect("there"), "old", "{name}");
    }
}

#[test]
fn nonsense_is_refused_before_anything_is_written() {
    let folder = folder();
    let file = column(folder.path());
    for (name, options, code) in [
        ("x.gif", &["--size", "0x10"][..], 2),
        ("x.gif", &["--size", "1000000x1000000"], 2),
        ("x.apng", &["--from", "2", "--to", "1"], 2),
        ("x.apng", &["--duration", "-1"], 2),
        ("x.apng", &["--duration", "1", "--to", "2"], 2),
        ("x.apng", &["--sweep-angle", "0:90", "--angle", "3"], 2),
        ("x.avi", &[], 2),
        ("no/x.apng", &["--size", "8x8"], 1),
        ("no/f-%d.png", &["--size", "8x8"], 1),
    ] {
        let out = folder.path().join(name);
        let mut arguments = vec!["render", arg(&file), "-o", arg(&out)];
        arguments.extend(options);
        sinew(&arguments).refused(code);
        let said = sinew_ru(&arguments).refused(code);
        assert!(said.chars().any(|c| ('а'..='я').contains(&c)), "{said}");
    }
    assert_eq!(names(folder.path()), ["column.dae"]);
}

#[cfg(unix)]
#[test]
fn ctrl_c_leaves_nothing_behind() {
    let folder = folder();
    let file = column(folder.path());
    let out = folder.path().join("f-%05d.png");
    let mut command = call(["render", arg(&file), "-o", arg(&out), "--turntable", "--duration", "900", "--size", "64x64"]);
    let mut child = command.spawn().expect("starts");
    // As soon as the first frames lie there.
    let begun = std::time::Instant::now();
    while names(folder.path()).len() < 3 {
        assert!(begun.elapsed().as_secs() < 60, "nothing is drawn");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill is everywhere");
    assert_eq!(child.wait().expect("a child of ours").code(), Some(130));
    assert_eq!(names(folder.path()), ["column.dae"]);
}

#[test]
fn quiet_and_verbose_say_less_and_more() {
    let folder = folder();
    let muscle = config("biceps-measured.yaml");
    let out = folder.path().join("x.png");
    let ended = |more: &[&str]| {
        let mut arguments = vec!["render", arg(&muscle), "-o", arg(&out), "--size", "8x8", "--angle", "500"];
        arguments.extend(more);
        sinew(&arguments)
    };
    assert!(ended(&[]).err.contains("clamped to this range"));
    assert_eq!(ended(&["--quiet"]).well(), "");
    assert!(ended(&["-v"]).err.contains("8 × 8"));
    assert!(ended(&["-v", "-q"]).refused(2).contains("contradict"));
}

#[test]
fn surfaces_agree_between_the_formats() {
    let folder = folder();
    let file = config("atlas.dae");
    let out = |ending: &str| folder.path().join(format!("s.{ending}"));
    for ending in ["obj", "ply", "stl"] {
        sinew(["export", arg(&file), "-o", arg(&out(ending)), "--time", "0.7"]).well();
    }
    let obj = fs::read_to_string(out("obj")).expect("there");
    let points: Vec<[f32; 3]> = obj.lines().filter_map(|line| line.strip_prefix("v ")).map(three).collect();
    let faces: Vec<Vec<usize>> = obj.lines().filter_map(|line| line.strip_prefix("f ")).map(corners).collect();
    assert!(points.len() > 100 && faces.len() > 100);
    // Materials: each that is used is there.
    let mtl = fs::read_to_string(out("mtl")).expect("beside it");
    assert!(obj.contains("mtllib s.mtl\n"));
    let used = obj.lines().filter_map(|line| line.strip_prefix("usemtl ")).collect::<Vec<_>>();
    assert!(!used.is_empty() && used.iter().all(|name| mtl.contains(&format!("newmtl {name}\n"))), "{used:?}");

    let number = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().expect("four bytes"));
    let ply = fs::read(out("ply")).expect("there");
    let end = ply.windows(11).position(|window| window == b"end_header\n").expect("a header") + 11;
    let header = String::from_utf8_lossy(&ply[..end]).into_owned();
    assert!(header.contains(&format!("element vertex {}\n", points.len())) && header.contains(&format!("element face {}\n", faces.len())));
    assert_eq!(ply.len() - end, points.len() * 27 + faces.len() * 13);
    for (i, point) in points.iter().enumerate() {
        let at = end + i * 27;
        assert_eq!([0, 4, 8].map(|k| number(&ply[at + k..at + k + 4])), *point);
    }
    for (i, face) in faces.iter().enumerate() {
        let at = end + points.len() * 27 + i * 13;
        let index = |k: usize| u32::from_le_bytes(ply[at + 1 + k * 4..at + 5 + k * 4].try_into().expect("four bytes")) as usize;
        assert_eq!((ply[at], [index(0), index(1), index(2)].to_vec()), (3, face.clone()));
    }
    let stl = fs::read(out("stl")).expect("there");
    assert_eq!(stl.len(), 84 + faces.len() * 50);
    for (i, face) in faces.iter().enumerate() {
        for (k, corner) in face.iter().enumerate() {
            let at = 84 + i * 50 + 12 + k * 12;
            assert_eq!([0, 4, 8].map(|j| number(&stl[at + j..at + j + 4])), points[*corner]);
        }
    }
}

fn three(text: &str) -> [f32; 3] {
    let numbers: Vec<f32> = text.split(' ').map(|x| x.parse().expect("a number")).collect();
    numbers.try_into().expect("three")
}

fn corners(text: &str) -> Vec<usize> {
    text.split(' ').map(|corner| corner.split('/').next().expect("a number").parse::<usize>().expect("a number") - 1).collect()
}

#[test]
fn shells_take_their_completions() {
    let folder = folder();
    for shell in ["bash", "zsh", "fish"] {
        let script = sinew(["completions", shell]).well();
        for option in ["sweep-angle", "render", "export"] {
            assert!(script.contains(option), "{shell} lacks {option}");
        }
        let file = folder.path().join(shell);
        fs::write(&file, script).expect("writable");
        match Command::new(shell).arg("-n").arg(&file).output() {
            Ok(output) => {
                assert!(output.status.success() && output.stderr.is_empty(), "{shell}: {}", String::from_utf8_lossy(&output.stderr))
            }
            Err(_) => crate::support::left_out(&format!("{shell} is not here, so its completions are not checked")),
        }
    }
    assert!(sinew(["completions", "tcsh"]).refused(2).contains("tcsh"));
}
