//! Sessions and muscle files that ask for too much, or for what is no file: one sentence, at once.

use std::process::Stdio;
use std::time::{Duration, Instant};

use crate::support::{arg, call, config, folder, models, sinew};
use sinew::limits;

/// A call whose standard input never ends and never says anything.
#[track_caller]
fn without_waiting(arguments: &[&str]) -> (i32, String, String) {
    let mut command = call(arguments);
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
    let _held_open = child.stdin.take();
    let begun = Instant::now();
    while child.try_wait().expect("a child of ours").is_none() {
        if begun.elapsed() > Duration::from_secs(60) {
            child.kill().expect("a child of ours");
            panic!("{arguments:?} waits for its input");
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    let ended = child.wait_with_output().expect("a child of ours");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    (ended.status.code().unwrap_or(-1), text(ended.stdout), text(ended.stderr))
}

#[test]
fn a_dash_in_a_file_is_a_file_of_that_name() {
    let folder = folder();
    let session = models::write(folder.path(), "session.yaml", "sinew_session:\n  files: [\"-\"]\n");
    let compared = models::write(folder.path(), "compared.yaml", "sinew_session:\n  compared: {file: \"-\"}\n");
    let clip = models::write(folder.path(), "clip.yaml", "clip: \"-\"\nmuscles: [{length: 9, radii: [1, 2], growth: [1, 1]}]\n");
    // Seen from their own folder too, where no folder stands before the dash.
    let within = |name: &str, arguments: &[&str]| {
        let mut command = call(arguments.iter().copied().chain([name]));
        command.current_dir(folder.path());
        crate::support::run(command, b"<COLLADA/>")
    };
    let (code, _, err) = without_waiting(&["info", arg(&session)]);
    assert!(code == 1 && err.contains("no such file") && err.lines().count() == 1, "{err}");
    assert!(within("session.yaml", &["info"]).refused(1).contains("./-: There is no such file"));
    let (code, out, err) = without_waiting(&["check", arg(&clip)]);
    assert!(code == 0 && out.contains("clip-not-opened") && err.is_empty(), "{out}{err}");
    assert!(within("clip.yaml", &["check"]).well().contains("clip-not-opened"));
    assert_eq!(without_waiting(&["info", arg(&compared)]).0, 0);
    // A file of that name is read.
    std::fs::copy(config("curl.dae"), folder.path().join("-")).expect("copied");
    assert!(within("session.yaml", &["info"]).well().contains("collada"));
}

#[test]
fn too_much_is_refused_in_one_sentence() {
    let folder = folder();
    let session = |text: &str| format!("sinew_session:\n  {}\n", text.replace('\n', "\n  "));
    let chain: String = (1..40).map(|i| format!("a{i}: &a{i} [*a{0}, *a{0}]\n", i - 1)).collect();
    for (name, text, part) in [
        ("files", session(&format!("files: [{}]", "walker.dae,".repeat(20_000))), limits::SESSION_FILES.to_string()),
        ("deep", session(&format!("x: {}", "[".repeat(20_000))), limits::YAML_DEPTH.to_string()),
        ("hidden brackets", session(&format!("x: {}", "[ #]\n ".repeat(20_000))), limits::YAML_DEPTH.to_string()),
        ("aliases", session(&format!("a0: &a0 [1, 1]\n{chain}")), limits::YAML_VALUES.to_string()),
        ("text", format!("x: &x \"{}\"\n{}", "A".repeat(80_000), session(&format!("shown: [{}]", "*x,".repeat(20_000)))), "16".to_owned()),
        ("muscles", format!("muscles: &m [{}]\n", "{length: 9, radii: [1, 2], growth: [1, 1]},".repeat(1001)), limits::MUSCLES.to_string()),
    ] {
        let file = models::write(folder.path(), "much.yaml", &text);
        let said = sinew(["info", arg(&file)]).refused(1);
        assert!(said.contains(&part) && said.len() < 400, "{name}: {said}");
        for command in ["check", "measure"] {
            let said = sinew([command, arg(&file)]).refused(1);
            assert!((said.contains(&part) || said.contains("This is a session")) && said.len() < 400, "{name}: {said}");
        }
    }
}

#[test]
fn the_surfaces_of_several_files_are_bounded_together() {
    let folder = folder();
    let (radii, growth) = (vec!["9"; 10_000].join(","), vec!["1"; 10_000].join(","));
    let one = "  - {length: 267, radii: *r, growth: *g}\n";
    let text = format!("muscles:\n  - {{length: 267, radii: &r [{radii}], growth: &g [{growth}]}}\n{}", one.repeat(2));
    let file = models::write(folder.path(), "three.yaml", &text);
    let name = arg(&file);
    let info = sinew(["info", name, "--json"]).json();
    assert_eq!(info["muscles"].as_array().map(Vec::len), Some(3));
    let said = sinew(["render", name, name, "-o", arg(&folder.path().join("x.png"))]).refused(1);
    assert!(said.contains(&limits::MUSCLE_VERTICES.to_string()), "{said}");
    let session = models::write(folder.path(), "session.yaml", "sinew_session: {files: [three.yaml, three.yaml]}\n");
    assert!(
        sinew(["render", arg(&session), "-o", arg(&folder.path().join("x.png"))]).refused(1).contains(&limits::MUSCLE_VERTICES.to_string())
    );
}
