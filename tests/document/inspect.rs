//! What the inspector tells, held against the frame that is drawn and against closed forms: a vertex explained, a joint turned by hand, angles and
//! paths over a clip.

use crate::support::models;
use glam::{DMat4, DVec3};
use sinew::document::{Document, JointControl, PoseBuffers, PoseState, Skinning, angle_at};
use sinew::formats::SCENE_READERS;
use sinew::progress::Progress;
use sinew::scene::{Frame, NodeId};

struct WorldMesh {
    document: Document,
    state: PoseState,
    buffers: PoseBuffers,
    frame: Frame,
}

impl WorldMesh {
    /// The bending column at a time.
    fn column(time: f64) -> Self {
        let folder = crate::support::folder();
        let path = models::write(folder.path(), "column.dae", &models::column());
        let document = Document::open(&[path], SCENE_READERS, &Progress::default()).expect("the column opens");
        let state = PoseState { time, ..document.start_state() };
        let mut posed = Self { document, state, buffers: PoseBuffers::default(), frame: Frame::default() };
        posed.pose();
        posed
    }

    fn pose(&mut self) {
        self.document.pose(&self.state, &mut self.buffers, &mut self.frame);
    }

    fn node(&self, name: &str) -> NodeId {
        self.document.scene.graph.find(name).expect("the node is there")
    }

    fn vertices(&self) -> std::ops::Range<u32> {
        0..self.frame.surfaces[0].mesh.positions.len() as u32
    }
}

#[test]
fn the_parts_of_every_vertex_add_up_to_where_it_is_drawn() {
    let posed = WorldMesh::column(1.2);
    let mut shared = 0;
    for vertex in posed.vertices() {
        let told = posed.document.vertex_influences(&posed.buffers, &posed.frame, 0, vertex).expect("a vertex of a mesh");
        let sum: DVec3 = told.influences.iter().map(|share| share.contribution).sum();
        let weights: f64 = told.influences.iter().map(|share| share.weight).sum();
        assert!((weights - 1.0).abs() < 1e-6);
        assert!((sum - told.sum).length() < 1e-12);
        assert!((told.drawn - told.sum).length() < 1e-5, "{vertex}: {} drawn, {} explained", told.drawn, told.sum);
        shared += usize::from(told.influences.len() == 2);
        for share in &told.influences {
            assert!((share.full_weight_position * share.weight - share.contribution).length() < 1e-12);
            assert_eq!(share.node.map(|node| posed.document.scene.graph.node(node).sid.clone()).as_deref(), Some(share.joint.as_str()));
        }
    }
    assert!(shared >= 4, "the middle ring follows both bones");
}

#[test]
fn dual_quaternions_draw_a_shared_vertex_elsewhere_than_the_linear_sum() {
    let mut posed = WorldMesh::column(1.5);
    posed.state.skinning = Skinning::DualQuaternion;
    posed.pose();
    let apart = |told: &sinew::document::VertexInfluences| (told.drawn - told.sum).length();
    for vertex in posed.vertices() {
        let told = posed.document.vertex_influences(&posed.buffers, &posed.frame, 0, vertex).expect("a vertex");
        assert_eq!(apart(&told) > 1e-3, told.influences.len() == 2, "vertex {vertex}: {}", apart(&told));
    }
}

#[test]
fn what_is_not_there_is_not_explained() {
    let posed = WorldMesh::column(0.5);
    assert!(posed.document.vertex_influences(&posed.buffers, &posed.frame, 0, 1_000_000).is_none());
    assert!(posed.document.vertex_influences(&posed.buffers, &posed.frame, 9, 0).is_none());
    let biceps = Document::built_in();
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    biceps.pose(&biceps.start_state(), &mut buffers, &mut frame);
    let muscle = frame.surfaces.iter().position(|surface| surface.muscle.is_some()).expect("a muscle");
    assert!(biceps.vertex_influences(&buffers, &frame, muscle, 0).is_none());
}

#[test]
fn a_turn_by_hand_does_what_the_clip_does_and_comes_on_top_of_it() {
    // At its end the clip has turned the upper bone by 90° about X; at its start a hand does the same.
    let mut posed = WorldMesh::column(0.5);
    let upper = posed.node("upper");
    let rest = posed.frame.world.clone();
    posed.state.joints.set_override(upper, DVec3::new(90.0, 0.0, 0.0));
    posed.pose();
    let by_hand = posed.frame.world.clone();
    let mut clip = WorldMesh::column(1.5);
    for (ours, theirs) in by_hand.iter().zip(&clip.frame.world) {
        assert!(ours.abs_diff_eq(*theirs, 1e-9), "{ours} is not {theirs}");
    }
    for vertex in posed.vertices() {
        let (ours, theirs) = (posed.frame.surfaces[0].position(vertex), clip.frame.surfaces[0].position(vertex));
        assert!((ours - theirs).length() < 1e-5);
    }
    // On top of the clip: 90° and −90° are nothing.
    clip.state.joints.set_override(upper, DVec3::new(-90.0, 0.0, 0.0));
    clip.pose();
    assert!(clip.frame.world[upper.index()].abs_diff_eq(rest[upper.index()], 1e-9));
    // Taken away, nothing is left; what is no number or not there does nothing.
    posed.state.joints.set_override(upper, DVec3::ZERO);
    posed.state.joints.set_override(upper, DVec3::NAN);
    assert!(posed.state.joints.overrides().is_empty());
    posed.state.joints.set_override(NodeId(999), DVec3::X);
    posed.pose();
    assert_eq!(posed.frame.world, rest);
}

#[test]
fn turns_are_about_the_joints_own_axes_x_first() {
    let mut joints = JointControl::default();
    joints.set_override(NodeId(0), DVec3::new(90.0, 90.0, 0.0));
    let matrix = joints.overrides()[0].matrix();
    // X turns +Y to +Z, then Y turns +Z to +X.
    assert!((matrix.transform_vector3(DVec3::Y) - DVec3::X).length() < 1e-12);
    assert!((matrix.determinant() - 1.0).abs() < 1e-12);
    joints.set_override(NodeId(0), DVec3::new(0.0, 0.0, 30.0));
    assert_eq!(joints.overrides().len(), 1);
    assert!(joints.overrides()[0].matrix().abs_diff_eq(DMat4::from_rotation_z(30f64.to_radians()), 1e-12));
}

#[test]
fn angles_and_paths_follow_the_clip() {
    let posed = WorldMesh::column(0.5);
    let (lower, upper) = (posed.node("lower"), posed.node("upper"));
    let path = posed.document.node_path(&posed.state, upper, 11);
    assert_eq!((path.len(), path[0].0, path[10].0), (11, 0.5, 1.5));
    assert!(path.iter().all(|(_, place)| (*place - path[0].1).length() < 1e-9), "the joint itself stays where it is");
    assert_eq!(angle_at(&posed.frame, lower, lower, upper), None);
    // Three places whose angle is known: 60° between (1, 0) and (cos 60°, sin 60°), however far away.
    let places = [DVec3::X * 4.0, DVec3::ZERO, DVec3::new(0.5, 0.75f64.sqrt(), 0.0) * 1e-3];
    let frame = Frame { world: places.map(DMat4::from_translation).to_vec(), ..Frame::default() };
    let angle = angle_at(&frame, NodeId(0), NodeId(1), NodeId(2)).expect("an angle");
    assert!((angle - 60.0).abs() < 1e-9, "{angle}");
    assert_eq!(angle_at(&frame, NodeId(0), NodeId(1), NodeId(77)), None);
    let still = Document::built_in();
    assert!(still.angle_curve(&still.start_state(), [NodeId(0); 3], 9).is_empty());
}
