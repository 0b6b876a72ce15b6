//! Drives the real window on a display of its own: the drivers in `tests/window` through the accessibility tree, the mouse and the keyboard.
//!
//! Needs Xvfb, dbus-run-session, xdotool, ImageMagick's `import` and the system's Python with `gi` and Atspi (`make test` installs them); where
//! one of them is missing it says so and passes, but fails where `CI` is set: there nobody reads what was left out.
//!
//! One stray event on a busy machine is no fault of the program's, and must not be forgotten either: a driver that fails is run twice more. It passes
//! where both of these do, and is named as unsteady, at once and in `target/tmp/unsteady`, which `make test` shows at its end.
//!
//! `SINEW_TEST_ROOT` names the root of another system, in which all of this is run instead (`make test-newer`).
#![cfg(feature = "gui")]

mod support;

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// A display that ends with the test.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    /// Starts a server, which chooses a free number itself.
    fn start() -> Option<Self> {
        let mut server = command("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1400x900x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .ok()?;
        let mut number = String::new();
        let read = server.stdout.take().and_then(|out| BufReader::new(out).read_line(&mut number).ok());
        let display = Self { server, name: format!(":{}", number.trim()) };
        (read.is_some() && !number.trim().is_empty()).then_some(display)
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// A program of this system, or of the root that the drivers are pointed at.
fn command(program: &str) -> Command {
    match std::env::var_os("SINEW_TEST_ROOT").filter(|root| !root.is_empty()) {
        Some(root) => {
            let mut command = Command::new("chroot");
            command.arg(root).arg(program);
            command
        }
        None => Command::new(program),
    }
}

fn run(program: &str, arguments: &[&str]) -> Option<i32> {
    command(program).args(arguments).stdout(Stdio::null()).stderr(Stdio::null()).status().ok()?.code()
}

fn works(program: &str, arguments: &[&str]) -> bool {
    run(program, arguments) == Some(0)
}

/// Whether a program is there at all; xdotool fails without a display even when asked for its version.
fn is_there(program: &str) -> bool {
    // 127 is what `chroot` says of one that is not.
    run(program, &["-version"]).is_some_and(|code| code != 127)
}

/// What the test needs and the machine lacks.
fn missing() -> Option<&'static str> {
    let atspi = "import gi; gi.require_version('Atspi', '2.0'); from gi.repository import Atspi";
    [
        ("Xvfb", is_there("Xvfb")),
        ("dbus-run-session", works("dbus-run-session", &["--", "true"])),
        ("xdotool", is_there("xdotool")),
        ("ImageMagick", is_there("import")),
        ("python3-gi with gir1.2-atspi-2.0", works("/usr/bin/python3", &["-c", atspi])),
    ]
    .into_iter()
    .find(|(_, there)| !there)
    .map(|(name, _)| name)
}

#[test]
fn hands_on_the_window_do_what_they_should() {
    drive("drive.py");
}

#[test]
fn the_window_tells_what_is_in_a_file() {
    drive("contents.py");
}

#[test]
fn hands_on_timeline_camera_and_model_do_what_they_should() {
    drive("views.py");
}

#[test]
fn every_key_does_what_its_row_says() {
    drive("bindings.py");
}

#[test]
fn ghosts_and_comparisons_are_shown() {
    drive("ghosts.py");
}

#[test]
fn files_come_as_a_desktop_brings_them() {
    drive("desktop.py");
}

#[test]
fn habits_of_a_desktop_are_kept() {
    drive("habits.py");
}

#[test]
fn keyboard_and_names_reach_everything() {
    drive("finish.py");
}

#[test]
#[ignore = "takes minutes; `make monkey` runs it"]
fn ten_thousand_random_events_do_no_harm() {
    drive("monkey.py");
}

#[test]
#[ignore = "takes minutes; `make monkey` runs it"]
fn ten_thousand_random_events_under_a_window_manager_do_no_harm() {
    if is_there("openbox") {
        drive_under("openbox", "monkey.py");
    } else {
        left_out("openbox");
    }
}

#[test]
#[ignore = "makes pictures to look at; `make shots` runs it"]
fn main_views_come_up_in_both_languages_and_styles() {
    drive("shots.py");
}

#[test]
fn a_muscle_is_edited_saved_and_read_again() {
    drive("drive_muscle.py");
}

#[test]
fn the_skin_over_muscles_is_set_and_follows_them() {
    drive("drive_skin.py");
}

#[test]
fn exports_are_made_stopped_and_saved() {
    drive("drive_export.py");
}

#[test]
fn a_muscle_is_attached_to_a_clip_and_outlives_a_crash() {
    drive("drive_attach.py");
}

#[test]
fn a_muscle_gets_via_points_and_surfaces_to_go_round() {
    drive("drive_way.py");
}

#[test]
fn joints_of_a_clip_are_bent_about_any_axis_with_the_clip_or_without() {
    drive("drive_joint.py");
}

#[test]
fn a_set_of_muscles_is_attached_and_a_muscle_mirrored() {
    drive("drive_sets.py");
}

#[test]
fn muscles_are_copied_renamed_and_deleted() {
    drive("drive_several.py");
}

#[test]
fn what_is_open_is_never_replaced() {
    drive("guard.py");
}

#[test]
fn nothing_is_lost_and_keys_are_what_they_say() {
    drive("trust.py");
}

/// Says that something was not tested; where nobody would read it, that is a failure.
fn left_out(what: &str) {
    assert!(std::env::var_os("CI").is_none_or(|value| value.is_empty()), "the window is not tested, because {what} is missing");
    eprintln!("SKIPPED: the window is not tested, because {what} is missing");
}

/// Runs a driver of `tests/window`, without a window manager.
fn drive(script: &str) {
    drive_under("", script);
}

/// Runs a driver of `tests/window` under a window manager, "" for none.
fn drive_under(manager: &str, script: &str) {
    if let Some(what) = missing() {
        return left_out(what);
    }
    match judge(|| run_driver(manager, script)) {
        Verdict::Passed(told) => println!("{told}"),
        Verdict::Unsteady(first) => {
            println!("{first}");
            // Past the capture of the test's output, so that it is seen.
            let line = format!("UNSTEADY: {script} failed once and passed twice: {}", reason(&first));
            let _ = writeln!(std::io::stderr(), "{line}");
            let kept = std::fs::OpenOptions::new().create(true).append(true).open(concat!(env!("CARGO_TARGET_TMPDIR"), "/unsteady"));
            let _ = kept.and_then(|mut file| writeln!(file, "{line}"));
        }
        Verdict::Failed(all) => panic!("{}", all.join("\n== and again:\n")),
    }
}

/// What became of a driver.
#[derive(Debug, PartialEq)]
enum Verdict {
    /// It passed; what it told.
    Passed(String),
    /// It failed, and then passed twice; what it told when it failed.
    Unsteady(String),
    /// It failed, and at least once more; what it told each time it did.
    Failed(Vec<String>),
}

/// Runs something, and twice more where it failed.
fn judge(mut run: impl FnMut() -> Result<String, String>) -> Verdict {
    let first = match run() {
        Ok(told) => return Verdict::Passed(told),
        Err(told) => told,
    };
    let mut failed = vec![first];
    for _ in 0..2 {
        if let Err(told) = run() {
            failed.push(told);
            return Verdict::Failed(failed);
        }
    }
    Verdict::Unsteady(failed.swap_remove(0))
}

/// The line in which a driver says why it failed.
fn reason(told: &str) -> &str {
    told.lines().find(|line| line.starts_with("NOT SO:")).or_else(|| told.lines().last()).unwrap_or_default()
}

#[test]
fn a_driver_that_fails_once_is_unsteady_and_one_that_fails_twice_has_failed() {
    let verdict = |runs: &[bool]| {
        let mut runs = runs.iter().enumerate();
        let verdict = judge(|| match runs.next() {
            Some((number, true)) => Ok(number.to_string()),
            Some((number, false)) => Err(number.to_string()),
            None => panic!("run too often"),
        });
        assert_eq!(runs.next(), None, "run too seldom");
        verdict
    };
    let told = |numbers: &[&str]| numbers.iter().map(|number| (*number).to_owned()).collect::<Vec<_>>();
    assert_eq!(verdict(&[true]), Verdict::Passed("0".into()));
    assert_eq!(verdict(&[false, true, true]), Verdict::Unsteady("0".into()));
    assert_eq!(verdict(&[false, false]), Verdict::Failed(told(&["0", "1"])));
    assert_eq!(verdict(&[false, true, false]), Verdict::Failed(told(&["0", "2"])));
    assert_eq!(reason("ok: a\nNOT SO: b\ntrace"), "NOT SO: b");
}

/// Runs a driver once, on a display, a bus and a home of its own; what it told, and whether all was so.
fn run_driver(manager: &str, script: &str) -> Result<String, String> {
    let Some(display) = Display::start() else { return Err("Xvfb does not start".into()) };
    let (home, files) = (support::folder(), support::folder());
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let ended = command("env")
        .args(["-u", "WAYLAND_DISPLAY"])
        .arg(format!("DISPLAY={}", display.name))
        .args(["PYTHONDONTWRITEBYTECODE=1", "LANG=C.UTF-8", "LC_ALL=C.UTF-8"])
        .arg(format!("XDG_CONFIG_HOME={}", home.path().display()))
        .arg(format!("XDG_DATA_HOME={}", home.path().display()))
        .arg(format!("XDG_STATE_HOME={}", home.path().join("state").display()))
        .arg(format!("SINEW_WINDOW_MANAGER={manager}"))
        .args(["dbus-run-session", "--", "/usr/bin/python3"])
        .arg(root.join("tests/window").join(script))
        .arg(env!("CARGO_BIN_EXE_sinew"))
        .arg(files.path())
        .arg(root.join("configs"))
        .output()
        .map_err(|error| format!("the driver does not start: {error}"))?;
    let told = String::from_utf8_lossy(&ended.stdout).into_owned();
    if ended.status.success() && told.contains("all is so") {
        return Ok(told);
    }
    Err(format!("{told}\n{}", String::from_utf8_lossy(&ended.stderr)))
}
