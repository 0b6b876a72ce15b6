//! The elbow of a skeleton: found by name or by its movement, its angle set instead of the clip's or on top of it.

use std::path::Path;

use glam::{DMat4, DQuat, DVec3};
use sinew::document::{Document, PoseBuffers};
use sinew::formats::SCENE_READERS;
use sinew::muscle::{FoundBy, JointDof, MuscleFile, MuscleRig};
use sinew::progress::Progress;
use sinew::scene::{Frame, MuscleId, Node, NodeId, NodeKind, Scene, Transform};

/// A body of joints: name, parent, place in the world, all with axes of their own.
fn body(joints: &[(&str, Option<usize>, [f64; 3])], turned: bool) -> Scene {
    let mut scene = Scene::default();
    let mut world: Vec<DMat4> = Vec::new();
    for (index, (name, parent, at)) in joints.iter().enumerate() {
        // Every bone's axes point elsewhere, as they do in real rigs.
        let spin = if turned {
            DQuat::from_axis_angle(DVec3::new(1.0, 2.0, index as f64).normalize(), 0.7 * index as f64)
        } else {
            DQuat::IDENTITY
        };
        let matrix = DMat4::from_rotation_translation(spin, DVec3::from_array(*at));
        let above = parent.map_or(DMat4::IDENTITY, |parent| world[parent]);
        let mut node = Node::new(*name).with_kind(NodeKind::Joint).with_transform(Transform::from_matrix(above.inverse() * matrix));
        node.id = format!("id{index}");
        scene.graph.add(parent.map(|parent| NodeId(parent as u32)), node);
        world.push(matrix);
    }
    scene
}

const T_POSE: [(&str, Option<usize>, [f64; 3]); 12] = [
    ("mixamorig:Hips", None, [0.0, 1.0, 0.0]),
    ("mixamorig:Spine", Some(0), [0.0, 1.4, 0.0]),
    ("mixamorig:LeftArm", Some(1), [0.2, 1.4, 0.0]),
    ("mixamorig:LeftForeArm", Some(2), [0.5, 1.4, 0.0]),
    ("mixamorig:LeftHand", Some(3), [0.75, 1.4, 0.0]),
    ("mixamorig:RightArm", Some(1), [-0.2, 1.4, 0.0]),
    ("mixamorig:RightForeArm", Some(5), [-0.5, 1.4, 0.0]),
    ("mixamorig:RightHand", Some(6), [-0.75, 1.4, 0.0]),
    ("RightForeArmTwist", Some(6), [-0.55, 1.4, 0.0]),
    ("mixamorig:LeftUpLeg", Some(0), [0.1, 0.9, 0.0]),
    ("mixamorig:LeftLeg", Some(9), [0.1, 0.5, 0.0]),
    ("mixamorig:LeftFoot", Some(10), [0.1, 0.1, 0.0]),
];

/// Where a node is with the joint at an angle.
fn placed(scene: &Scene, joint: &JointDof, degrees: f64, node: usize) -> (DVec3, f64) {
    let turn = joint.absolute(degrees);
    let mut local = scene.graph.rest_locals();
    local[turn.node.index()] = turn.apply(local[turn.node.index()], local[turn.node.index()]);
    let mut world = Vec::new();
    scene.graph.world_from_local(&local, &mut world);
    (world[node].w_axis.truncate(), joint.angle(scene, &world).unwrap())
}

#[test]
fn a_body_in_t_pose_bends_its_forearm_to_the_front() {
    for turned in [false, true] {
        let scene = body(&T_POSE, turned);
        let joint = JointDof::elbow(&scene, &[], &[]).unwrap();
        assert_eq!((joint.node, joint.found), (NodeId(6), FoundBy::Name), "the right arm's, and no twist bone");
        assert!(joint.at_rest.abs() < 1e-9);
        for (degrees, x, z) in [(0.0, -0.75, 0.0), (90.0, -0.5, 0.25), (150.0, -0.5 + 0.25 * 30.0_f64.to_radians().cos(), 0.125)] {
            let (hand, angle) = placed(&scene, &joint, degrees, 7);
            assert!(hand.distance(DVec3::new(x, 1.4, z)) < 1e-9, "{hand} at {degrees}°");
            assert!((angle - degrees).abs() < 1e-9);
        }
    }
}

#[test]
fn an_arm_bent_at_rest_is_straightened_by_zero_degrees() {
    let bent: [(&str, Option<usize>, [f64; 3]); 3] =
        [("upper_arm.R", None, [0.0, 1.0, 0.0]), ("lower_arm.R", Some(0), [0.0, 0.7, 0.0]), ("hand.R", Some(1), [0.2, 0.5, 0.0])];
    let scene = body(&bent, true);
    let joint = JointDof::elbow(&scene, &[], &[]).unwrap();
    assert!((joint.at_rest - 45.0).abs() < 1e-9);
    let far = 0.2 * 2.0_f64.sqrt();
    assert!(placed(&scene, &joint, 0.0, 2).0.distance(DVec3::new(0.0, 0.7 - far, 0.0)) < 1e-9);
    assert!(placed(&scene, &joint, 90.0, 2).0.distance(DVec3::new(far, 0.7, 0.0)) < 1e-9);
}

#[test]
fn usual_rigs_have_their_elbow_and_others_none() {
    for name in [
        "Bip01 R Forearm",
        "forearm.R",
        "DEF-forearm.R",
        "rForearmBend",
        "R_elbow_JNT",
        "lowerarm_r",
        "Предплечье_П",
        "右ひじ",
        "J_Bip_R_LowerArm",
    ] {
        let mut joints = T_POSE;
        joints[6].0 = name;
        joints[3].0 = "x";
        let joint = JointDof::elbow(&body(&joints, true), &[], &[]).unwrap_or_else(|| panic!("{name}"));
        assert_eq!(joint.node, NodeId(6), "{name}");
    }
    let nameless: Vec<_> = T_POSE.iter().map(|(_, parent, at)| ("b", *parent, *at)).collect();
    assert_eq!(JointDof::elbow(&body(&nameless, true), &[], &[]), None);
    assert_eq!(JointDof::elbow(&Scene::default(), &[], &[]), None);
    assert_eq!(JointDof::elbow(&body(&T_POSE, true), &[], &[NodeId(0)]), None);
    // Everything in one place, and a place that is no number.
    let heap: Vec<_> = T_POSE.iter().map(|(name, parent, _)| (*name, *parent, [1.0; 3])).collect();
    assert_eq!(JointDof::elbow(&body(&heap, true), &[], &[]), None);
    let mut broken = T_POSE;
    broken[6].2 = [f64::NAN; 3];
    assert_ne!(JointDof::elbow(&body(&broken, false), &[], &[]).map(|joint| joint.node), Some(NodeId(6)));
}

fn shipped(name: &str) -> Document {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs").join(name);
    Document::open(&[&path], SCENE_READERS, &Progress::default()).unwrap()
}

#[test]
fn the_shipped_arm_bends_as_asked_at_any_time_and_on_top_of_the_clip() {
    let document = shipped("curl.dae");
    let joint = document.joint().unwrap();
    let node = document.scene.graph.node(joint.node);
    assert_eq!((node.name.as_str(), joint.found), ("forearm", FoundBy::Name));
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let mut angle = |time: f64, turn| {
        document.pose(&document.start_state().at_time(time).with_rotation(turn), &mut buffers, &mut frame);
        joint.angle(&document.scene, &frame.world).unwrap()
    };
    let (start, middle) = (angle(0.0, None), angle(2.0, None));
    assert!(middle > start + 90.0, "the clip bends the elbow: {start}° to {middle}°");
    for time in [0.0, 1.0, 2.0] {
        assert!((angle(time, Some(joint.absolute(60.0))) - 60.0).abs() < 1e-6);
        let clip = angle(time, None);
        assert!((angle(time, Some(joint.relative(15.0))) - clip - 15.0).abs() < 1e-6);
    }
    assert!((angle(0.0, Some(joint.absolute(999.0))) - 150.0).abs() < 1e-6, "held at the limit");
    let unharmed = angle(1.0, None);
    assert_eq!(angle(1.0, Some(joint.relative(f64::NAN))), unharmed);
}

#[test]
fn without_names_the_hinge_that_the_clip_bends_is_the_elbow() {
    let mut document = shipped("curl.dae");
    for index in 0..document.scene.graph.len() as u32 {
        let node = document.scene.graph.node_mut(NodeId(index));
        (node.name, node.id, node.sid) = (format!("n{index}"), format!("n{index}"), String::new());
    }
    let joint = document.joint().unwrap();
    assert_eq!(joint.found, FoundBy::Shape);
    let named = shipped("curl.dae").joint().unwrap();
    assert_eq!(joint.node, named.node);
    assert!(joint.axis.distance(named.axis) < 1e-6);
}

#[test]
fn muscles_that_name_no_joint_are_measured_about_the_elbow_that_they_cross() {
    let text = include_str!("../../configs/curl-muscles.yaml");
    let mut document = shipped("curl.dae");
    let build = |document: &mut Document, text: &str| {
        let mut rig = MuscleRig::build(&MuscleFile::parse(text).unwrap(), "muscles", &mut document.scene, MuscleId(0));
        let findings = rig.attach_moving(&document.scene, &document.clips);
        assert!(findings.is_empty(), "{findings:?}");
        rig
    };
    let named = build(&mut document, text);
    let joint_line = text.lines().find(|line| line.starts_with("joint:")).unwrap();
    let found = build(&mut document, &text.replace(joint_line, ""));
    assert_eq!(found.joint().unwrap().node, named.joint().unwrap().node);
    let at_rest = found.joint().unwrap().at_rest;
    for (a, b) in found.measure(0, &[30.0, 90.0]).iter().zip(named.measure(0, &[30.0 - at_rest, 90.0 - at_rest])) {
        assert!((a.solved.path_length - b.solved.path_length).abs() < 1e-3, "{} is not {}", a.solved.path_length, b.solved.path_length);
        assert!((a.moment_arm.unwrap() - b.moment_arm.unwrap()).abs() < 1e-3);
    }
}

#[test]
fn the_moment_arm_in_a_pose_is_that_of_the_measurement_at_its_angle() {
    let document = shipped("curl-muscles.yaml");
    let (rig, _) = document.rigs().next().unwrap();
    let joint = document.joint().unwrap();
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    for angle in [10.0, 60.0, 110.0] {
        document.pose(&document.start_state().with_rotation(Some(joint.absolute(angle))), &mut buffers, &mut frame);
        for index in 0..rig.len() {
            let sample = &rig.measure(index, &[angle])[0];
            let posed = rig.moment_arm(index, &document.scene, &frame.world).unwrap();
            assert!((posed - sample.moment_arm.unwrap()).abs() < 1e-5, "{posed} is not {}", sample.moment_arm.unwrap());
            let ledger = rig.ledger(index, &buffers.solved()[index], &document.scene, &frame.world).unwrap();
            assert!((ledger.length - sample.solved.length).abs() < 1e-5 && ledger.moment_arm == Some(posed + 0.0));
        }
    }
}
