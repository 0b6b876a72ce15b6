//! Drives the real window on a display of its own: the drivers in `tests/window` through the accessibility tree, the mouse and the keyboard.
//!
//! Needs Xvfb, dbus-run-session, xdotool, ImageMagick's `import` and the system's Python with `gi` and Atspi (`make test` installs them); where
//! one of them is missing it says so and passes.
#![cfg(feature = "gui")]

mod support;

use std::io::{BufRead, BufReader};
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
        let mut server = Command::new("Xvfb")
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

fn works(program: &str, arguments: &[&str]) -> bool {
    Command::new(program).args(arguments).stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|status| status.success())
}

/// Whether a program is there at all; xdotool fails without a display even when asked for its version.
fn is_there(program: &str) -> bool {
    Command::new(program).arg("-version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
}

/// What the test needs and the machine lacks.
fn missing() -> Option<&'static str> {
    let atspi = "import gi; gi.require_version('Atspi', '2.0'); from gi.repository import Atspi";
    [
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
#[ignore = "makes pictures to look at; `make shots` runs it"]
fn main_views_come_up_in_both_languages_and_styles() {
    drive("shots.py");
}

#[test]
fn a_muscle_is_edited_saved_and_read_again() {
    drive("drive_muscle.py");
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
fn a_muscle_gets_via_points_and_a_ball_to_go_round() {
    drive("drive_way.py");
}

#[test]
fn joints_of_a_clip_are_bent_about_any_axis_with_the_clip_or_without() {
    drive("drive_joint.py");
}

#[test]
fn muscles_are_copied_renamed_and_deleted() {
    drive("drive_several.py");
}

#[test]
fn what_is_open_is_never_replaced() {
    drive("guard.py");
}

/// Runs a driver of `tests/window` on a display, a bus and a home of its own.
fn drive(script: &str) {
    if let Some(what) = missing() {
        eprintln!("SKIPPED: the window is not tested, because {what} is missing");
        return;
    }
    let Some(display) = Display::start() else {
        eprintln!("SKIPPED: the window is not tested, because Xvfb is missing");
        return;
    };
    let (home, files) = (support::folder(), support::folder());
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let ended = Command::new("dbus-run-session")
        .args(["--", "/usr/bin/python3"])
        .arg(root.join("tests/window").join(script))
        .arg(env!("CARGO_BIN_EXE_sinew"))
        .arg(files.path())
        .arg(root.join("configs"))
        .env("DISPLAY", &display.name)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .env_remove("WAYLAND_DISPLAY")
        .env("LANG", "C.UTF-8")
        .env("LC_ALL", "C.UTF-8")
        .env("XDG_CONFIG_HOME", home.path())
        .env("XDG_DATA_HOME", home.path())
        .env("XDG_STATE_HOME", home.path().join("state"))
        .output()
        .expect("the driver starts");
    let told = String::from_utf8_lossy(&ended.stdout);
    println!("{told}");
    assert!(ended.status.success() && told.contains("all is so"), "{told}\n{}", String::from_utf8_lossy(&ended.stderr));
}
