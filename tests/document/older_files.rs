//! Files that version 0.1 wrote (commit 3da9ed8) open as they did, and what is written now says the same.

use std::fs;
use std::path::{Path, PathBuf};

use glam::DVec3;

use sinew::animation::LoopMode;
use sinew::document::{Document, OpenOptions, Skinning};
use sinew::formats::SCENE_READERS;
use sinew::muscle::Edit;
use sinew::progress::Progress;
use sinew::render::{Samples, Shading};
use sinew::scene::{MuscleId, NodeId};
use sinew::session::{BackgroundPreset, CompareTarget, Session, UndoStep};
use sinew::view::{self, Opened, RecoveryFile, SessionState, Settings};

fn older(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/document/older_files").join(name)).expect(name)
}

fn configs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("configs")
}

/// The lines in alphabetical order: keys may come in another order.
fn sorted(text: &str) -> Vec<&str> {
    let mut lines: Vec<&str> = text.lines().collect();
    lines.sort_unstable();
    lines
}

/// Opens a session file as the window and the command line do, from a folder in which its files lie.
fn opened(name: &str) -> (Session, SessionState, Opened) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for file in ["walker.dae", "walker.png", "biceps.yaml"] {
        fs::copy(configs().join(file), folder.path().join(file)).expect(file);
    }
    let path = folder.path().join(name);
    fs::write(&path, older(name)).expect("written");
    let opened = view::open(&[&path], OpenOptions::new(SCENE_READERS), &Progress::default()).expect(name);
    let saved = opened.session.clone().expect("a session file");
    let mut session = Session::default();
    session.show_session(opened.document.clone(), &saved);
    let again = session.session_state(folder.path());
    assert_eq!(sorted(&again.to_yaml().expect("written")), sorted(&older(name)), "{name}");
    (session, *saved, opened)
}

#[test]
fn a_session_of_a_clip_opens_as_it_did() {
    let (mut session, saved, opened) = opened("walker.session.yaml");
    let time = *session.playback();
    assert_eq!((time.time, time.speed, time.mode, time.mark_a, time.mark_b), (0.4, -0.5, LoopMode::PingPong, Some(0.2), Some(0.8)));
    let hand = session.document().scene.graph.find("hand.L").expect("a hand");
    assert_eq!((session.selected(), session.followed()), (Some(hand), Some(hand)));
    assert_eq!(session.joint_control().joint_override(hand), DVec3::new(10.0, -20.0, 30.0));
    assert!(!session.document().scene.graph.node(NodeId(3)).visible);
    let skins = session.onion_skin_settings();
    assert_eq!((skins.shown, skins.before, skins.after, skins.step, skins.path), (true, 1, 3, 2, true));
    assert!(matches!(session.compare_target(), Some(CompareTarget::Skinning)));
    assert_eq!((session.state().skinning, session.frame_rate(), session.model().scale), (Skinning::DualQuaternion, 50.0, 2.0));
    let display = session.display().clone();
    assert_eq!((display.shading, display.samples, display.line_width), (Shading::Phong, Samples::One, 2.5));
    assert_eq!((display.ambient, display.grid_cell, display.bones, display.grid), (0.5, Some(0.25), true, false));
    assert_eq!((session.backdrop(), session.bone_names(), display.highlight.weights), (BackgroundPreset::Grey, true, Some(hand)));
    let orbit = *session.camera_controller().orbit();
    assert_eq!((orbit.yaw, orbit.pitch, orbit.orthographic), (63.0, 14.0, true));
    // The command line looks at the same thing from the same place.
    let (document, state) = (&opened.document, saved.pose_state(&opened.document));
    let bounds = document.motion_bounds(&state);
    let view = saved.view_state(document, &state, &bounds, &bounds);
    assert_eq!((view.camera.orbit().target, view.options()), (orbit.target, session.display_options()));
    assert_eq!(view.display.highlight, display.highlight);
    assert_eq!((state.joints, state.time), (session.joint_control().clone(), 0.4));
    assert!(!session.frame().surfaces.is_empty());
}

#[test]
fn a_session_of_an_arm_opens_as_it_did() {
    let (session, saved, opened) = opened("arm.session.yaml");
    assert!((session.drive().flexion - 72.5).abs() < 1e-9);
    assert_eq!(saved.pose_state(&opened.document).joints.drive, session.drive());
}

#[test]
fn settings_are_taken_over() {
    let settings = Settings::parse(&older("settings.yaml")).expect("settings");
    assert_eq!((settings.display.shading, settings.display.line_width, settings.width), (Shading::Flat, 1.5, 1280));
    assert!(settings.display.shown.iter().any(|flag| flag == "wireframe") && !settings.display.shown.iter().any(|flag| flag == "grid"));
    assert_eq!(sorted(&settings.to_yaml().expect("written")), sorted(&older("settings.yaml")));
}

#[test]
fn what_was_not_saved_is_offered_again() {
    let text = older("recovery.yaml");
    let unsaved = RecoveryFile::parse(&text).expect("a recovery file");
    let mut session =
        Session::new(Document::open(&[configs().join("biceps.yaml")], SCENE_READERS, &Progress::default()).expect("biceps.yaml"));
    let mut edited = Session::new(session.document().clone());
    edited.edit_muscle(MuscleId(0), &Edit::Radius(2, 33.0), UndoStep::New).expect("a radius");
    session.set_carried_files(unsaved.muscle_files().expect("sound muscles"));
    assert!(session.is_unsaved() && session.document().muscle_files().eq(edited.document().muscle_files()));
    assert_eq!(sorted(&unsaved.to_yaml().expect("written")), sorted(&text));
}
