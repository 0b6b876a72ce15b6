//! Bad input of every kind: one line that names the file, exit code 1, no panic, no wait.

use std::path::Path;

use crate::support::{arg, call, folder, models, run, sinew, sinew_ru};

/// Calls each command on `file`.
fn refused_by_all(file: &Path, place: &str, part: &str) {
    let out = folder();
    let (picture, object) = (out.path().join("out.png"), out.path().join("out.obj"));
    let file = arg(file);
    for arguments in [
        vec!["info", file],
        vec!["info", file, "--json"],
        vec!["check", file],
        vec!["render", file, "-o", arg(&picture)],
        vec!["export", file, "-o", arg(&object)],
        vec!["measure", file],
    ] {
        let said = sinew(&arguments).refused(1);
        assert!(said.starts_with(&format!("{file}{place}: ")), "{arguments:?}: {said}");
        assert!(said.contains(part), "{arguments:?}: {said}");
    }
    assert_eq!(std::fs::read_dir(out.path()).expect("readable").count(), 0, "nothing is written for a bad file");
}

#[test]
fn what_is_no_file() {
    let folder = folder();
    refused_by_all(&folder.path().join("missing.dae"), "", "no such file");
    refused_by_all(folder.path(), "", "folder");
    refused_by_all(Path::new("/dev/zero"), "", "regular file");
}

#[cfg(unix)]
#[test]
fn a_named_pipe_keeps_nobody_waiting() {
    let folder = folder();
    let pipe = folder.path().join("pipe.dae");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo is part of every Unix");
    assert!(made.success());
    refused_by_all(&pipe, "", "regular file");
}

#[test]
fn what_is_no_model() {
    let folder = folder();
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("a writable folder");
        path
    };
    refused_by_all(&write("empty.dae", b""), "", "empty");
    refused_by_all(&write("blank.yaml", b" \n\t\n"), "", "empty");
    let noise: Vec<u8> = (0..4096_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    for (name, bytes) in [
        ("noise.dae", &noise[..]),
        ("noise.yaml", &noise[..]),
        ("noise.zae", &noise[..]),
        ("other.dae", b"<html><body/></html>"),
        ("cut.dae", b"<COLLADA version=\"1.4.1\"><library_geom"),
        ("list.yaml", b"- 1\n- 2\n"),
        ("number.yaml", b"42\n"),
    ] {
        let path = write(name, bytes);
        let said = sinew(["info", arg(&path)]).refused(1);
        assert!(said.starts_with(arg(&path)), "{said}");
        let russian = sinew_ru(["info", arg(&path)]).refused(1);
        assert!(russian.chars().any(|c| ('а'..='я').contains(&c)), "{russian}");
    }
}

#[test]
fn broken_yaml_has_line_and_column() {
    let folder = folder();
    let wrong = models::BICEPS.replace("12.0, 5.0]\n  grow", "-12.0, 5.0]\n  grow");
    let path = models::write(folder.path(), "negative.yaml", &wrong);
    let said = sinew(["measure", arg(&path)]).refused(1);
    assert!(said.starts_with(&format!("{}:2:", arg(&path))), "{said}");
    let path = models::write(folder.path(), "syntax.yaml", "muscle_config:\n  radiuses: [1, 2\n  len: 3\n");
    let said = sinew(["measure", arg(&path)]).refused(1);
    let place = said.strip_prefix(arg(&path)).expect("the file first");
    assert_eq!(place.split(':').take(3).filter(|part| part.parse::<u32>().is_ok()).count(), 2, "{said}");
}

#[test]
fn hostile_numbers_harm_nobody() {
    let folder = folder();
    let (picture, object) = (folder.path().join("out.png"), folder.path().join("out.obj"));
    let plain = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1";
    for (points, transform) in [
        ("NaN 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1", ""),
        ("0 0 INF 1 0 0 1 -INF 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1", ""),
        ("0 0 0 3e38 0 0 3e38 3e38 0 0 3e38 0 0 0 -3e38 1 0 1 1 1 1 0 1 1", ""),
        ("0 0 0 1e-45 0 0 1e-45 1e-45 0 0 1e-45 0 0 0 1e-45 1e-45 0 1e-45 1e-45 1e-45 1e-45 0 1e-45 1e-45", ""),
        (plain, "<scale>0 0 0</scale>"),
        (plain, "<scale>1e300 1e300 1e300</scale>"),
        (plain, "<translate>1e39 0 0</translate>"),
        (plain, "<rotate>0 1 0 1e308</rotate>"),
        (plain, "<matrix>NaN 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>"),
        (plain, "<matrix>0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0</matrix>"),
    ] {
        let file = models::write(folder.path(), "hostile.dae", &models::cube(transform).replace(plain, points));
        for arguments in [
            vec!["info", arg(&file), "--json"],
            vec!["check", arg(&file)],
            vec!["render", arg(&file), "-o", arg(&picture), "--size", "64x48", "--bones", "--wireframe"],
            vec!["export", arg(&file), "-o", arg(&object)],
        ] {
            let ended = sinew(&arguments);
            assert!(matches!(ended.code, 0 | 1) && !ended.err.contains("panicked"), "{arguments:?} {transform}: {}", ended.err);
            if arguments[0] == "info" && ended.code == 0 {
                serde_json::from_str::<serde_json::Value>(&ended.out).expect("JSON knows no NaN");
            }
        }
        if let Ok(text) = std::fs::read_to_string(&object) {
            assert!(!text.contains("NaN") && !text.contains("inf"), "{points} {transform}");
        }
    }
}

#[test]
fn check_goes_on_after_a_bad_file() {
    let folder = folder();
    let good = models::write(folder.path(), "good.dae", &models::column());
    let bad = models::write(folder.path(), "bad.dae", "<COLLADA");
    let ended = sinew(["check", arg(&bad), arg(&good), arg(&folder.path().join("none.dae"))]);
    assert_eq!(ended.code, 1);
    assert_eq!(ended.err.lines().count(), 2, "{}", ended.err);
    assert!(ended.out.contains(arg(&good)), "{}", ended.out);
    let ended = sinew(["check", "--json", arg(&bad), arg(&good)]);
    assert_eq!(ended.code, 1);
    let report: serde_json::Value = serde_json::from_str(&ended.out).expect("JSON");
    assert_eq!(report["files"][0]["usable"], false);
    assert!(report["files"][0]["error"]["message"].is_string());
    assert_eq!(report["files"][1]["usable"], true);
}

#[test]
fn standard_input_is_a_file() {
    let column = models::column();
    let ended = run(call(["info", "-", "--json"]), column.as_bytes());
    assert_eq!(ended.json()["meshes"][0]["name"], "column");
    let ended = run(call(["measure", "-", "--json"]), models::BICEPS.as_bytes());
    assert_eq!(ended.json()["unit"], "mm");
    let said = run(call(["info", "-"]), b"").refused(1);
    assert!(said.starts_with("standard input: "), "{said}");
    // A file of that name is opened by its path.
    let folder = folder();
    models::write(folder.path(), "info", &column);
    let mut by_path = call(["check", "./info"]);
    by_path.current_dir(folder.path());
    run(by_path, b"").well();
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_is_no_panic() {
    use std::io::Read;
    use std::process::Stdio;
    let folder = folder();
    let muscle = models::write(folder.path(), "biceps.yaml", models::BICEPS);
    let mut child = call(["measure", arg(&muscle), "--sweep", "0:100:0.01", "--csv"])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut first = [0; 10];
    let mut out = child.stdout.take().expect("piped");
    out.read_exact(&mut first).expect("some output");
    drop(out);
    let mut said = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut said).expect("text");
    let status = child.wait().expect("ours");
    assert_eq!((status.code(), said.as_str()), (Some(0), ""));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_said() {
    let folder = folder();
    let path = models::write(folder.path(), "biceps.yaml", models::BICEPS);
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
    let ended = call(["info", arg(&path)]).stdin(std::process::Stdio::null()).stdout(full).output().expect("the program starts");
    assert_eq!(ended.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&ended.stderr).contains("the disk is full"));
}
