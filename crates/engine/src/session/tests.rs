use super::*;
use crate::document::{SceneReaders, Skinning};
use glam::DVec3;
use sinew_muscle::AttachmentPoint;
use sinew_muscle::presets::Preset;
use sinew_scene::Node;
use sinew_scene::animation::Clip;
use sinew_scene::progress::Progress;

/// The demo's arm, whose elbow is the joint `forearm`.
pub(super) fn clip() -> Session {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../configs/curl.dae");
    Session::new(Document::open(&[path], SceneReaders::TESTED, &Progress::default()).unwrap())
}

/// A ready muscle that bends the elbow.
pub(super) fn biceps() -> Preset {
    Preset::by_id("biceps").unwrap()
}

/// The bones that a muscle's ends are on.
pub(super) fn ends(session: &Session, id: MuscleId) -> [Option<NodeId>; 2] {
    let (rig, index) = session.document().muscle(id).unwrap();
    [0, 1].map(|end| rig.hold_bone(index, AttachmentPoint::End(end)))
}

fn two_clips() -> Document {
    let mut document = Document::default();
    document.scene.graph.add(None, Node::new("root"));
    document.scene.graph.add(Some(NodeId(0)), Node::new("arm"));
    for (name, start, end) in [("walk", 0.5, 2.5), ("run", 0.0, 1.0)] {
        document.clips.push(Clip { name: name.into(), start, end, ..Clip::default() });
    }
    document
}

fn session() -> Session {
    let mut session = Session::new(two_clips());
    session.set_clip(Some(0));
    session.take_changes();
    session
}

#[test]
fn every_change_is_told_once() {
    let mut session = session();
    session.time(|time| time.seek(1.0));
    let changes = session.take_changes();
    assert!(changes.any(ChangeSet::TIME) && !changes.any(ChangeSet::PLAYBACK | ChangeSet::CAMERA));
    session.time(|time| time.seek(1.0));
    assert_eq!(session.take_changes(), ChangeSet::default());
    session.toggle_playing();
    assert_eq!(session.take_changes(), ChangeSet::PLAYBACK);
    session.change_display(|display| display.grid = !display.grid);
    assert_eq!(session.take_changes(), ChangeSet::DISPLAY);
}

#[test]
fn how_skins_are_bent_is_kept_when_another_document_comes() {
    let mut session = session();
    session.set_skinning(Skinning::DualQuaternion);
    session.set_skin_follows_muscles(false);
    for mode in [LoadMode::Again, LoadMode::New] {
        session.show(two_clips(), mode);
        assert_eq!((session.state().skinning, session.skin_follows_muscles()), (Skinning::DualQuaternion, false));
    }
}

#[test]
fn posing_counts_once_whoever_asks_for_it() {
    let mut session = session();
    session.frame();
    session.frame();
    assert!(session.take_posing_ms() > 0.0);
    session.frame();
    assert_eq!(session.take_posing_ms(), 0.0, "nothing was posed anew");
    session.time(|time| time.seek(1.0));
    session.frame();
    assert!(session.take_posing_ms() > 0.0);
}

/// A document with a camera, on a node of that name 6 m before the origin, and something to look at.
fn with_camera(name: &str) -> Document {
    use sinew_scene::{CameraId, Content, FileCamera, Projection, Transform};
    let mut document = swinging();
    let mut node = Node::new(name);
    node.contents.push(Content::Camera(CameraId(0)));
    node.transform = Transform { ops: vec![sinew_scene::TransformOp::Translate(DVec3::new(0.0, 1.0, 6.0))] };
    document.scene.graph.add(None, node);
    let projection = Projection::Perspective { fov_y: 0.7 };
    document.scene.cameras.push(FileCamera { name: String::new(), id: String::new(), projection, aspect: None, near: 0.1, far: 100.0 });
    document
}

#[test]
fn a_camera_of_the_file_outlives_a_reload_and_hands_go_on_from_it() {
    let mut session = Session::new(with_camera("lens"));
    let (node, camera) = file_cameras(&session.document().scene)[0];
    session.change_camera(|eye| eye.look_through(node, camera));
    let seen = session.picture().2;
    session.show(with_camera("lens"), LoadMode::Again);
    assert!(matches!(session.camera_controller().viewpoint(), Viewpoint::File(..)) && session.picture().2 == seen);
    // A drag that turns nothing yet: the direction and the size of the middle are what they were.
    session.change_camera(|eye| eye.change(|orbit| orbit.orbit(0.0, 0.0)));
    let taken = session.picture().2;
    assert!(matches!(session.camera_controller().viewpoint(), Viewpoint::Orbit) && taken.rotation.angle_between(seen.rotation) < 2e-3);
    let size = |camera: &Camera, depth: f32| match camera.projection {
        sinew_scene::Projection::Perspective { fov_y } => depth * (fov_y * 0.5).tan(),
        sinew_scene::Projection::Orthographic { height } => height * 0.5,
    };
    let depth = |camera: &Camera| (session.camera_controller().orbit().target - camera.eye).dot(camera.forward());
    assert!((size(&seen, depth(&seen)) - size(&taken, depth(&taken))).abs() < 1e-3);
    session.change_camera(|eye| eye.look_through(node, camera));
    session.show(with_camera("another"), LoadMode::Again);
    assert!(matches!(session.camera_controller().viewpoint(), Viewpoint::Orbit));
}

#[test]
fn the_ground_lies_still_while_a_clip_plays() {
    let mut session = Session::new(Document::built_in());
    let (_, frame, _, display) = session.picture();
    let (ground, bounds) = (display.ground, frame.bounds);
    assert!(ground.is_some(), "a new document is fitted");
    session.set_contraction(100.0);
    let (_, frame, _, display) = session.picture();
    assert_eq!(display.ground, ground);
    assert!(frame.bounds != bounds);
}

#[test]
fn playing_advances_with_the_clock_it_is_given() {
    let mut session = session();
    session.toggle_playing();
    session.advance(0.25);
    assert_eq!(session.state().time, 0.75);
    session.toggle_playing();
    session.advance(0.25);
    assert_eq!(session.state().time, 0.75);
    assert!(!session.is_moving());
}

#[test]
fn another_clip_starts_at_its_start_and_goes_on_playing() {
    let mut session = session();
    session.toggle_playing();
    session.advance(1.0);
    session.next_clip(1);
    assert_eq!((session.clip().map(|clip| clip.name.as_str()), session.state().time), (Some("run"), 0.0));
    assert!(session.playback().playing);
    session.next_clip(1);
    assert_eq!(session.clip_index(), Some(0));
    session.set_clip(Some(99));
    assert_eq!(session.clip_index(), Some(0));
}

#[test]
fn a_reload_keeps_moment_camera_selection_and_model() {
    let mut session = session();
    session.time(|time| time.seek(2.0));
    session.change_camera(|eye| eye.change(|orbit| orbit.orbit(33.0, 5.0)));
    session.select(Some(NodeId(1)));
    session.change_model(|model| model.translate(DVec3::X));
    let orbit = *session.camera_controller().orbit();
    session.show(two_clips(), LoadMode::Again);
    assert_eq!((session.state().time, session.clip_index()), (2.0, Some(0)));
    assert_eq!((*session.camera_controller().orbit(), session.selected()), (orbit, Some(NodeId(1))));
    assert_eq!(session.model().translation, DVec3::X);

    let mut shorter = two_clips();
    shorter.clips[0].end = 1.5;
    shorter.scene = Scene::default();
    session.show(shorter, LoadMode::Again);
    assert_eq!((session.state().time, session.selected()), (1.5, None));
    session.show(two_clips(), LoadMode::New);
    assert!(session.model().is_identity());
}

#[test]
fn undo_brings_back_model_light_and_visibility() {
    let mut session = session();
    session.undoable(sinew_scene::message!("app-edit-reset-model"), UndoStep::New, |session| {
        session.change_model(|model| model.scale_by(2.0))
    });
    session.undoable(sinew_scene::message!("app-edit-light"), UndoStep::New, |session| session.rotate_light(10.0, 0.0));
    session.set_visible(NodeId(1), false);
    assert!(!session.document().scene.graph.node(NodeId(1)).visible);
    session.undo();
    assert!(session.document().scene.graph.node(NodeId(1)).visible && session.light().is_some());
    session.undo();
    assert!(session.light().is_none() && session.model().scale == 2.0);
    session.undo();
    assert!(session.model().is_identity());
    assert_eq!(session.undo_counts(), (false, true));
    session.redo();
    assert_eq!(session.model().scale, 2.0);
}

#[test]
fn selecting_something_that_is_not_there_selects_nothing() {
    let mut session = session();
    session.select(Some(NodeId(77)));
    assert_eq!(session.selected(), None);
    session.set_visible(NodeId(77), false);
}

#[test]
fn a_view_that_no_hand_touched_is_fitted_to_the_picture() {
    let mut session = session();
    session.set_aspect(0.5);
    assert!(session.take_changes().any(ChangeSet::CAMERA));
    session.change_camera(|eye| eye.change(|orbit| orbit.zoom(2.0)));
    session.take_changes();
    session.set_aspect(2.0);
    assert!(!session.take_changes().any(ChangeSet::CAMERA));
    for fit in [Session::fit, Session::reset_camera] {
        fit(&mut session);
        session.take_changes();
        session.set_aspect(session.aspect * 1.5);
        assert!(session.take_changes().any(ChangeSet::CAMERA), "what was fitted stays fitted");
    }
}

#[test]
fn a_session_file_without_a_camera_is_fitted_whatever_the_window_becomes() {
    let saved = view::SessionState::parse("sinew_session:\n  compared: {skinning: true}\n").expect("a session file").expect("sound");
    let mut session = Session::default();
    session.show_session(clip().document().clone(), &saved);
    assert!(session.compared().is_some());
    session.take_changes();
    session.set_aspect(0.4);
    assert!(session.take_changes().any(ChangeSet::CAMERA));
}

#[test]
fn a_moment_in_a_hand_stays_there_while_it_plays() {
    let mut session = session();
    session.toggle_playing();
    session.time(|time| time.seek(1.0));
    session.hold_time(true);
    session.advance(0.5);
    assert_eq!((session.playback().time, session.playback().playing), (1.0, true));
    session.hold_time(false);
    session.advance(0.5);
    assert_eq!(session.playback().time, 1.5);
}

/// Clips as readers make them of a file that names them so, or not at all.
fn clips(names: [&str; 3]) -> Document {
    let mut document = swinging();
    let clip = |(place, name): (u32, &str)| Clip { name: name.into(), place: Some(place), end: 1.0, ..Clip::default() };
    document.clips = (1..).zip(names).map(clip).collect();
    document
}

#[test]
fn clips_are_found_again_whatever_the_language_and_however_they_are_called() {
    let document = clips(["", "", ""]);
    for name in ["Clip 2", "Клип 2", "#2"] {
        assert_eq!(document.clip_named(name), Some(1), "{name}");
    }
    assert_eq!((document.clip_key(1).as_deref(), document.clip_key(9)), (Some("#2"), None));
    for wrong in ["#0", "#4", "#", "#-1", "Clip 4", "Clip", ""] {
        assert_eq!(document.clip_named(wrong), None, "{wrong}");
    }
    // All animation of a file without clips.
    let mut whole = swinging();
    whole.clips = vec![Clip::default()];
    assert_eq!(["Animation", "Анимация", "#1", "Clip 1"].map(|name| whole.clip_named(name)), [Some(0), Some(0), Some(0), None]);
    // A name of the file's own is kept; the second of two that are the same is told by its place.
    let document = clips(["walk", "run", "walk"]);
    assert_eq!([0, 1, 2].map(|index| document.clip_key(index).unwrap()), ["walk", "run", "#3"]);
    let mut session = Session::new(document);
    session.set_clip(Some(2));
    session.compare(Some(CompareTarget::Clip(1)));
    let saved = session.session_state(Path::new("/somewhere"));
    assert_eq!((saved.clip.as_deref(), saved.compared.and_then(|compared| compared.clip).as_deref()), (Some("#3"), Some("run")));
    session.show(clips(["walk", "walk", "run"]), LoadMode::Again);
    assert_eq!((session.clip_index(), session.compare_target().map(|with| matches!(with, CompareTarget::Clip(2)))), (Some(2), Some(true)));
    session.show(clips(["walk", "walk", "jump"]), LoadMode::Again);
    assert!(session.compare_target().is_none(), "the clip that was compared with is gone");
}

#[test]
fn a_compared_file_that_was_written_again_keeps_its_place() {
    let mut session = Session::new(swinging());
    session.compare(Some(CompareTarget::File(Box::new(swinging()), "other.dae".into())));
    session.set_compare_offsets(0.25, 2.0);
    let mut other = swinging();
    other.scene.graph.add(None, Node::new("more"));
    session.replace_compared_file(other);
    assert_eq!((session.compare_offset(), session.compared_file()), (Some((0.25, 2.0)), Some("other.dae".into())));
    assert!(matches!(session.compare_target(), Some(CompareTarget::File(other, _)) if other.scene.graph.find("more").is_some()));
    assert!(session.compared().and_then(|told| told.farthest).is_some());
}

/// A root with an arm that swings for a second and carries a triangle and a hand; beside it another joint.
pub(super) fn swinging() -> Document {
    use sinew_scene::animation::{Channel, ChannelTarget, Components, Curve, Keys};
    use sinew_scene::{Content, Mesh, MeshId, MeshInstance, NodeKind, Part, Transform, TransformOp};

    let mut document = Document::default();
    let graph = &mut document.scene.graph;
    let mut add = |parent, name: &str, place: DVec3| {
        let mut node = Node::new(name);
        node.kind = NodeKind::Joint;
        node.transform = Transform { ops: vec![TransformOp::Rotate { axis: DVec3::Z, angle: 0.0 }, TransformOp::Translate(place)] };
        graph.add(parent, node)
    };
    let root = add(None, "root", DVec3::ZERO);
    let arm = add(Some(root), "arm", DVec3::X);
    add(Some(arm), "hand", DVec3::X);
    add(Some(root), "other", DVec3::Y);
    let mesh = Mesh {
        positions: vec![glam::Vec3::ZERO, glam::Vec3::X, glam::Vec3::Y],
        normals: vec![glam::Vec3::Z; 3],
        triangles: vec![[0, 1, 2]],
        parts: vec![Part { symbol: String::new(), triangles: 0..1, lines: 0..0 }],
        source_vertex: vec![0, 1, 2],
        source_count: 3,
        ..Mesh::default()
    };
    document.scene.meshes.push(Arc::new(mesh));
    let instance = MeshInstance { mesh: MeshId(0), deformers: Vec::new(), materials: vec![None].into(), skinned_targets: Vec::new() };
    document.scene.graph.node_mut(arm).contents.push(Content::Mesh(instance));
    let keys = Keys { times: vec![0.0, 0.5, 1.0], dimension: 1, values: vec![0.0, 60.0, 90.0], ..Keys::default() };
    let target = ChannelTarget::Transform { node: arm, op: 0, components: Components::Component(3) };
    let channels = vec![Channel { target, curve: Arc::new(Curve::new(keys)) }];
    document.clips.push(Clip { name: "swing".into(), start: 0.0, end: 1.0, channels, ..Clip::default() });
    document.bump_revision();
    document
}

#[test]
fn weights_are_those_of_a_bone_whatever_else_is_selected() {
    let mut session = clip();
    let node = |session: &Session, name: &str| session.document().scene.graph.find(name);
    let (bone, other, mesh) = (node(&session, "forearm"), node(&session, "hand"), node(&session, "arm"));
    assert!(bone.is_some() && other.is_some() && mesh.is_some());
    session.select(mesh);
    session.set_weights(true);
    assert_eq!(session.display().highlight.weights, None, "a mesh has none");
    session.select(bone);
    session.set_weights(true);
    assert_eq!(session.display().highlight.weights, bone);
    session.select(mesh);
    assert_eq!(session.display().highlight.weights, bone);
    session.select(other);
    assert_eq!(session.display().highlight.weights, other);
    session.select(None);
    assert_eq!(session.display().highlight.weights, None);
}

#[test]
fn a_file_without_anything_to_draw_is_known() {
    assert!(!clip().has_nothing_to_draw());
    assert!(!Session::new(Document::built_in()).has_nothing_to_draw());
    assert!(!Session::default().has_nothing_to_draw(), "nothing is open");
    assert!(session().has_nothing_to_draw(), "two nodes and nothing on them");
}
