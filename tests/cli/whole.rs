//! Whole files or none: whatever goes wrong while one is written, one sentence says so, the old file stays, and nothing lies beside it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::{arg, call, config, folder, run, sinew};

/// Every kind of file that is made: the call with `OUT` for its name, that name, and the first file that comes of it.
const KINDS: &[(&[&str], &str, &str)] = &[
    (&["render", "curl.dae", "-o", "OUT", "--size", "900x700"], "a.png", "a.png"),
    (&["render", "curl.dae", "-o", "OUT", "--size", "900x700", "--to", "0.5"], "f-%02d.png", "f-00.png"),
    (&["render", "curl.dae", "-o", "OUT", "--size", "900x700"], "a.gif", "a.gif"),
    (&["render", "curl.dae", "-o", "OUT", "--size", "900x700", "--to", "0.5"], "a.apng", "a.apng"),
    (&["render", "curl.dae", "-o", "OUT", "--size", "900x700"], "a.mp4", "a.mp4"),
    (&["render", "curl.dae", "-o", "OUT", "--size", "900x700"], "a.webm", "a.webm"),
    (&["export", "curl.dae", "-o", "OUT"], "a.obj", "a.obj"),
    (&["export", "curl.dae", "-o", "OUT"], "a.ply", "a.ply"),
    (&["export", "curl.dae", "-o", "OUT"], "a.stl", "a.stl"),
    (&["convert", "curl.dae", "OUT"], "a.glb", "a.glb"),
    (&["convert", "curl.dae", "OUT"], "a.gltf", "a.gltf"),
    (&["measure", "biceps.yaml", "--plot", "OUT"], "p.svg", "p.svg"),
    (&["fit", "biceps-radii.csv", "-o", "OUT"], "a.yaml", "a.yaml"),
];

/// What lies in a folder, by name, with its contents.
fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found: Vec<_> = fs::read_dir(folder)
        .expect("readable")
        .flatten()
        .map(|entry| (entry.file_name().to_string_lossy().into_owned(), fs::read(entry.path()).unwrap_or_default()))
        .collect();
    found.sort();
    found
}

/// The kinds that can be made here: videos need `ffmpeg`.
fn kinds() -> impl Iterator<Item = &'static (&'static [&'static str], &'static str, &'static str)> {
    let videos = Command::new("ffmpeg").arg("-version").output().is_ok_and(|output| output.status.success());
    if !videos {
        crate::support::left_out("ffmpeg is not here, so videos are not made");
    }
    KINDS.iter().filter(move |(_, name, _)| videos || !(name.ends_with(".mp4") || name.ends_with(".webm")))
}

/// The call that writes into `folder`.
fn arguments(words: &[&str], out: &Path) -> Vec<String> {
    let word = |word: &&str| match *word {
        "OUT" => arg(out).to_owned(),
        name if name.contains('.') && !name.starts_with(|c: char| c.is_ascii_digit()) => arg(&config(name)).to_owned(),
        other => other.to_owned(),
    };
    words.iter().map(word).collect()
}

/// A file system in memory, gone when the test is over; `None` where one may not mount one.
#[cfg(target_os = "linux")]
struct Disk(tempfile::TempDir);

#[cfg(target_os = "linux")]
impl Disk {
    fn mount(size: &str) -> Option<Self> {
        let folder = folder();
        let mounted = Command::new("mount").args(["-t", "tmpfs", "-o", &format!("size={size}"), "tmpfs"]).arg(folder.path()).output();
        if !mounted.is_ok_and(|output| output.status.success()) {
            crate::support::left_out("only root can mount a small disk");
            return None;
        }
        Some(Self(folder))
    }

    fn make_read_only(&self) -> bool {
        let remounted = Command::new("mount").args(["-o", "remount,ro"]).arg(self.0.path()).output();
        remounted.is_ok_and(|output| output.status.success())
    }
}

#[cfg(target_os = "linux")]
impl Drop for Disk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.0.path()).status();
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_the_old_file_whatever_is_written() {
    let Some(disk) = Disk::mount("64k") else { return };
    for (words, name, first) in kinds() {
        fs::write(disk.0.path().join(first), "old").expect("room for a word");
        // Not a page is left.
        let filled = (0..64).any(|page| fs::write(disk.0.path().join(format!("stuffing-{page}")), [1; 4096]).is_err());
        assert!(filled);
        let before = contents(disk.0.path());
        let ended = sinew(arguments(words, &disk.0.path().join(name)));
        assert_eq!((ended.code, ended.err.lines().count()), (1, 1), "{name}: {}", ended.err);
        assert!(ended.err.contains("disk is full"), "{name}: {}", ended.err);
        assert!(contents(disk.0.path()) == before, "{name}");
        for left in contents(disk.0.path()) {
            fs::remove_file(disk.0.path().join(left.0)).expect("ours");
        }
    }
}

/// A folder that nobody may write in: by its permissions, or for root, whom those do not hold, by its file system.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_written_is_one_sentence_whatever_is_written() {
    use std::os::unix::fs::PermissionsExt;
    let plain = folder();
    let lock = |mode| fs::set_permissions(plain.path(), fs::Permissions::from_mode(mode)).expect("ours");
    for (_, _, first) in KINDS {
        fs::write(plain.path().join(first), "old").expect("writable");
    }
    lock(0o555);
    let is_root = fs::write(plain.path().join("probe"), "").is_ok();
    let disk = if is_root { Disk::mount("1m") } else { None };
    let place = disk.as_ref().map_or(plain.path(), |disk| disk.0.path());
    if let Some(disk) = &disk {
        for (_, _, first) in KINDS {
            fs::write(place.join(first), "old").expect("writable");
        }
        assert!(disk.make_read_only());
    } else if is_root {
        lock(0o755);
        return;
    }
    let before = contents(place);
    for (words, name, _) in kinds() {
        let said = sinew(arguments(words, &place.join(name))).refused(1);
        assert!(said.contains("read-only") || said.contains("may not write"), "{name}: {said}");
        assert!(contents(place) == before, "{name}");
    }
    lock(0o755);
}

#[test]
fn a_folder_that_is_not_there_or_is_a_file_is_one_sentence_whatever_is_written() {
    let folder = folder();
    fs::write(folder.path().join("file"), "old").expect("writable");
    fs::create_dir(folder.path().join("dir")).expect("writable");
    let before = contents(folder.path());
    for (words, name, _) in kinds() {
        for place in ["nowhere", "file"] {
            let said = sinew(arguments(words, &folder.path().join(place).join(name))).refused(1);
            assert!(said.contains(place) && said.contains("folder"), "{said}");
        }
        assert!(contents(folder.path()) == before, "{name}");
    }
}

#[test]
fn an_output_that_is_a_folder_is_one_sentence_whatever_is_written() {
    let folder = folder();
    for (words, name, first) in kinds() {
        let inside = folder.path().join(first).join("inside");
        fs::create_dir_all(inside.parent().expect("a folder")).expect("writable");
        fs::write(&inside, "old").expect("writable");
        let said = sinew(arguments(words, &folder.path().join(name))).refused(1);
        assert!(said.contains("folder"), "{name}: {said}");
        assert_eq!(fs::read_to_string(&inside).expect("there"), "old");
        assert_eq!(contents(inside.parent().expect("a folder")).len(), 1, "{name}");
        fs::remove_dir_all(inside.parent().expect("a folder")).expect("ours");
        assert!(contents(folder.path()).is_empty(), "{name}");
    }
}

/// Waits until something beside `known` files lies in the folder.
fn wait_for_more(folder: &Path, known: usize) {
    let begun = Instant::now();
    while fs::read_dir(folder).expect("readable").count() <= known {
        assert!(begun.elapsed() < Duration::from_secs(60), "nothing is written");
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[cfg(unix)]
fn tell(child: &std::process::Child, signal: &str) {
    Command::new("kill").args([&format!("-{signal}"), &child.id().to_string()]).status().expect("kill is everywhere");
}

#[cfg(unix)]
#[test]
fn whoever_stops_a_film_or_a_large_picture_finds_nothing_of_it() {
    let muscle = config("biceps-measured.yaml");
    let long = ["--turntable", "--duration", "900", "--size", "320x240"];
    for (name, options) in [
        ("f-%05d.png", &long[..]),
        ("a.gif", &long),
        ("a.apng", &long),
        ("a.mp4", &long),
        ("a.webm", &long),
        // Takes seconds to pack.
        ("a.png", &["--size", "9000x9000", "--samples", "1"]),
    ] {
        if !kinds().any(|(_, other, _)| other.split('.').next_back() == name.split('.').next_back()) {
            continue;
        }
        for signal in ["INT", "TERM"] {
            let folder = folder();
            let old = folder.path().join(name.replace("%05d", "00000"));
            fs::write(&old, "old").expect("writable");
            let out = folder.path().join(name);
            let mut command = call([&["render", arg(&muscle), "-o", arg(&out)], options].concat());
            let mut child = command.stdin(Stdio::null()).stderr(Stdio::null()).spawn().expect("starts");
            wait_for_more(folder.path(), 1);
            tell(&child, signal);
            assert_eq!(child.wait().expect("ours").code(), Some(130), "{name} {signal}");
            assert_eq!(contents(folder.path()), [(old.file_name().expect("a name").to_string_lossy().into_owned(), b"old".to_vec())]);
        }
    }
}

/// A square sheet of `side · side` quads.
#[cfg(unix)]
fn sheet(side: usize) -> String {
    let row = side + 1;
    let points: String = (0..row * row).map(|i| format!("{} {} {} ", i % row, i / row, i % 7)).collect();
    let corners: String = (0..side * side)
        .map(|i| i / side * row + i % side)
        .map(|corner| format!("{corner} {} {} {} ", corner + 1, corner + row + 1, corner + row))
        .collect();
    crate::support::models::cube("")
        .replace("count=\"24\"", &format!("count=\"{}\"", row * row * 3))
        .replace("0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1", &points)
        .replace("count=\"8\"", &format!("count=\"{}\"", row * row))
        .replace("<polylist count=\"6\">", &format!("<polylist count=\"{}\">", side * side))
        .replace("4 4 4 4 4 4", &"4 ".repeat(side * side))
        .replace("0 3 2 1 4 5 6 7 0 1 5 4 1 2 6 5 2 3 7 6 3 0 4 7", &corners)
}

/// Wherever the signal meets the program, there is the old file or the whole new one.
#[cfg(unix)]
#[test]
fn whoever_stops_a_conversion_finds_the_old_file_or_the_new_one() {
    let folder = folder();
    let input = crate::support::models::write(folder.path(), "sheet.dae", &sheet(300));
    for name in ["a.glb", "a.gltf", "a.obj", "a.ply", "a.stl"] {
        let out = folder.path().join(name);
        let words =
            if name.starts_with("a.gl") { ["convert", arg(&input), arg(&out), "-q"] } else { ["export", arg(&input), "-o", arg(&out)] };
        let begun = Instant::now();
        sinew(words).well();
        let (whole, took) = (fs::read(&out).expect("there"), begun.elapsed());
        fs::write(&out, "old").expect("ours");
        let before = contents(folder.path()).len();
        for part in [0.3, 0.6, 0.8, 0.9, 1.0] {
            let mut child = call(words).stdin(Stdio::null()).stderr(Stdio::null()).spawn().expect("starts");
            std::thread::sleep(took.mul_f64(part));
            tell(&child, "TERM");
            child.wait().expect("ours");
            let found = fs::read(&out).expect("there");
            assert!(found == b"old" || found == whole, "{name} at {part}: {} bytes", found.len());
            assert_eq!(contents(folder.path()).len(), before, "{name} at {part}");
        }
        fs::remove_file(&out).expect("ours");
    }
}

/// The bytes of a sequence do not depend on what else the machine does.
#[test]
fn the_same_call_makes_the_same_bytes() {
    let made = || {
        kinds()
            .filter(|(_, name, _)| !name.ends_with(".mp4") && !name.ends_with(".webm"))
            .map(|(words, name, first)| {
                let folder = folder();
                let ended = run(call(arguments(words, &folder.path().join(name))), b"");
                assert_eq!(ended.code, 0, "{name}: {}", ended.err);
                (*name, fs::read(folder.path().join(first)).expect("there"))
            })
            .collect::<Vec<(&str, Vec<u8>)>>()
    };
    let (first, second) = (made(), made());
    for ((name, first), (_, second)) in first.iter().zip(&second) {
        assert!(first == second, "{name}");
    }
}

/// What only `PathBuf` can say about a name that is no text.
#[cfg(target_os = "linux")]
#[test]
fn names_that_are_no_text_are_names_too() {
    use std::os::unix::ffi::OsStrExt;
    let folder = folder();
    for ending in ["png", "gif", "obj", "glb"] {
        let mut name = b"\xff\xfe.".to_vec();
        name.extend_from_slice(ending.as_bytes());
        let out: PathBuf = folder.path().join(std::ffi::OsStr::from_bytes(&name));
        let clip = config("lamp.dae");
        let mut command = match ending {
            "glb" => call(["convert", arg(&clip)]),
            "obj" => call(["export", arg(&clip), "-o"]),
            _ => call(["render", arg(&clip), "--size", "16x16", "-o"]),
        };
        command.arg(&out);
        let ended = run(command, b"");
        assert_eq!(ended.code, 0, "{}", ended.err);
        assert!(out.is_file());
    }
}
