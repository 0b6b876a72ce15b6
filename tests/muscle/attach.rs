//! Muscles on the bones of a scene: the same code as on the arm, by name, wherever the bones go.

use std::path::Path;

use glam::{DMat4, DVec3};
use sinew::animation::Pose;
use sinew::diagnostics::Diagnostic;
use sinew::document::{Document, PoseBuffers};
use sinew::formats::SCENE_READERS;
use sinew::muscle::{Finding, MuscleFile, MuscleRig};
use sinew::progress::Progress;
use sinew::scene::{Frame, MuscleId, Node, NodeId, NodeKind, Scene, Transform, TransformOp};

/// A hip and a knee in centimetres under a Z-up root, the shank turned by `angle` about X.
fn leg(angle: f64) -> (Scene, [NodeId; 2]) {
    let mut scene = Scene::default();
    let mut asset = Node::new("leg.dae");
    asset.kind = NodeKind::Asset;
    asset.transform = Transform { ops: vec![TransformOp::Rotate { axis: DVec3::X, angle: -90.0 }, TransformOp::Scale(DVec3::splat(0.01))] };
    let root = scene.graph.add(None, asset);
    let mut bone = |parent, id: &str, ops| {
        let mut node = Node::new(id.to_uppercase());
        node.id = id.to_owned();
        node.kind = NodeKind::Joint;
        node.transform = Transform { ops };
        scene.graph.add(Some(parent), node)
    };
    let thigh = bone(root, "thigh", vec![TransformOp::Translate(DVec3::new(7.0, 3.0, 90.0)), TransformOp::Scale(DVec3::splat(2.0))]);
    let shank = bone(thigh, "shank", vec![TransformOp::Translate(DVec3::NEG_Z * 20.0), TransformOp::Rotate { axis: DVec3::X, angle }]);
    (scene, [thigh, shank])
}

const MUSCLE: &str = "unit: mm\njoint: {bone: shank, axis: [2, 0, 0], range: [-30, 120]}\nmuscles:\n  - name: Hamstring\n    length: 350\n    \
    radii: [5, 20, 5]\n    growth: [0, 1, 0]\n    origin: {bone: thigh, offset: [0, 0, -30]}\n    insertion: {bone: SHANK, offset: [0, 0, -60]}\n";

/// Between two points on the bones' axes a line bends the joint one way or the other, on either side of the straight leg, and nothing else is odd.
fn only_turns(findings: &[Diagnostic<Finding>]) -> bool {
    findings.iter().all(|finding| finding.code() == "moment-arm-changes-sign")
}

fn world(scene: &Scene) -> Vec<DMat4> {
    let mut world = Vec::new();
    scene.graph.world_from_local(&scene.graph.rest_locals(), &mut world);
    world
}

#[test]
fn length_is_the_distance_of_the_attachments_whatever_unit_and_scale() {
    for angle in [0.0_f64, 40.0, 100.0] {
        let (mut scene, _) = leg(angle);
        let mut rig = MuscleRig::build(&MuscleFile::parse(MUSCLE).unwrap(), "muscles", &mut scene, MuscleId(0));
        assert!(!rig.is_attached(0));
        assert!(only_turns(&rig.attach(&scene)) && rig.is_attached(0));
        let world = world(&scene);
        let solved = rig.solve(0, rig.at_flexion(0.0), &world);
        // Knee 400 mm below the hip (20 cm, twice as large by the thigh's scale); attached 30 mm below the hip and 60 mm below the knee.
        let (p, d, turn) = (370.0, 60.0, angle.to_radians());
        let length = f64::sqrt(p * p + d * d + 2.0 * p * d * turn.cos());
        assert!((solved.path_length - length).abs() < 1e-9, "{} is not {length} at {angle}°", solved.path_length);
        // Measured from its rest pose, the joint adds to the angle it has there.
        if angle == 0.0 {
            for sample in rig.measure(0, &[0.0, 30.0, 90.0]) {
                let (sin, cos) = sample.angle.unwrap().to_radians().sin_cos();
                let length = f64::sqrt(p * p + d * d + 2.0 * p * d * cos);
                assert!((sample.solved.path_length - length).abs() < 1e-9);
                assert!((sample.moment_arm.unwrap() - p * d * sin / length).abs() < 1e-9);
            }
        }
        // The surface begins and ends at the attachments, give or take its own end radius.
        let (mut positions, mut normals) = (Vec::new(), Vec::new());
        rig.deform(0, &solved, &world, &mut positions, &mut normals);
        let (_, nodes) = leg(angle);
        for (node, depth, vertex) in [(nodes[0], -0.030, 0), (nodes[1], -0.060, positions.len() - 1)] {
            let matrix = world[node.index()];
            let place = matrix.w_axis.truncate() + matrix.z_axis.truncate().normalize() * depth;
            assert!((positions[vertex].as_dvec3().distance(place) - 0.005).abs() < 1e-5);
        }
    }
}

#[test]
fn a_bone_that_is_missing_is_a_finding_and_the_muscle_lies_on_its_own() {
    let (mut scene, _) = leg(0.0);
    let file = MuscleFile::parse(&MUSCLE.replace("SHANK", "calf").replace("bone: shank", "bone: ankle")).unwrap();
    let mut rig = MuscleRig::build(&file, "muscles", &mut scene, MuscleId(0));
    let findings = rig.attach(&scene);
    let codes: Vec<&str> = findings.iter().map(Diagnostic::code).collect();
    assert_eq!(codes, ["muscle-bone-not-found", "muscle-joint-not-found"]);
    assert_eq!(
        (&findings[0].finding, findings[0].element.to_string().as_str()),
        (&Finding::BoneNotFound { bone: "calf".to_owned() }, "Hamstring")
    );
    let solved = rig.solve(0, rig.at_flexion(0.0), &world(&scene));
    assert!((solved.length - 350.0).abs() < 1e-9);
    // Attached again to a scene that has it, all is well.
    let mut rig = MuscleRig::build(&MuscleFile::parse(MUSCLE).unwrap(), "muscles", &mut scene, MuscleId(0));
    rig.attach(&scene);
    assert!(rig.is_attached(0) && only_turns(rig.findings()));
    assert_eq!(rig.measured_range(), Some(-30.0..=120.0));
    rig.apply(rig.at_flexion(90.0), &mut Pose::rest(&scene));
}

#[test]
fn via_points_are_passed_in_straight_stretches_and_drawn_rounded_at_the_same_length() {
    let (mut scene, [thigh, _]) = leg(0.0);
    let yaml = MUSCLE
        .replace("    insertion", "    via: [{bone: thigh, offset: [0, 100, -200]}]\n    insertion")
        .replace("[5, 20, 5]", "[5, 8, 5]");
    let mut rig = MuscleRig::build(&MuscleFile::parse(&yaml).unwrap(), "muscles", &mut scene, MuscleId(0));
    assert!(only_turns(&rig.attach(&scene)));
    let before = world(&scene);
    let solved = rig.solve(0, rig.at_flexion(0.0), &before);
    // The line of action is the broken line itself; what is drawn has an arc of 1.25 times the thickest radius for a corner, and is as long.
    let (a, via, b) = (DVec3::new(0.0, 0.0, -30.0), DVec3::new(0.0, 100.0, -200.0), DVec3::new(0.0, 0.0, -460.0));
    let length = a.distance(via) + via.distance(b);
    assert!((solved.path_length - length).abs() < 1e-9, "{} is not {length}", solved.path_length);
    let path = solved.centerline();
    assert!((path.length() - length).abs() < 1e-9);
    assert!((path.sharpest(0.0, length) * 10.0 - 1.0).abs() < 1e-9);
    let bone = before[thigh.index()];
    let axes = [bone.x_axis, bone.y_axis, bone.z_axis].map(|axis| axis.truncate().normalize());
    let place = bone.w_axis.truncate() * 1000.0 + axes[0] * via.x + axes[1] * via.y + axes[2] * via.z;
    let nearest =
        (0..=1000).map(|step| path.frame_at(length * f64::from(step) / 1000.0).position.distance(place)).fold(f64::INFINITY, f64::min);
    assert!(nearest < 2.0, "{nearest} mm past the via point");
    // A thick belly makes a wide arc, not another line of action.
    let thick = yaml.replace("[5, 8, 5]", "[5, 200, 5]");
    let mut rig = MuscleRig::build(&MuscleFile::parse(&thick).unwrap(), "muscles", &mut scene, MuscleId(1));
    rig.attach(&scene);
    let world = world(&scene);
    let solved = rig.solve(0, rig.at_flexion(0.0), &world);
    assert!((solved.path_length - length).abs() < 1e-9);
    let path = solved.centerline();
    assert!((path.length() - length).abs() < 1e-9);
    let sharpest = path.sharpest(0.0, path.length()) * 200.0;
    assert!(sharpest < 1.0, "{sharpest}");
    // One for which no arc of this length is wide enough is told.
    let thicker = yaml.replace("[5, 8, 5]", "[5, 300, 5]");
    let findings = MuscleRig::build(&MuscleFile::parse(&thicker).unwrap(), "muscles", &mut scene, MuscleId(2)).attach(&scene);
    assert!(findings.iter().any(|finding| finding.code() == "muscle-bent-too-tight"), "{findings:?}");
}

#[test]
fn biceps_and_triceps_follow_the_shipped_clip() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/curl-muscles.yaml");
    let document = Document::open(&[&path], SCENE_READERS, &Progress::default()).unwrap();
    assert_eq!(document.sources.len(), 2, "the clip that the file names is opened too");
    assert!(!document.diagnostics.iter().any(|finding| finding.code().starts_with("muscle-")), "{:?}", document.diagnostics);
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let mut lengths = Vec::new();
    for time in [0.05, 1.0, 2.0] {
        let mut state = document.start_state();
        state.time = time;
        document.pose(&state, &mut buffers, &mut frame);
        let solved = buffers.solved();
        assert!(solved.iter().all(|solved| !solved.held && solved.volume_error.abs() < 1e-12));
        lengths.push([solved[0].length, solved[1].length]);
    }
    assert!(lengths.windows(2).all(|pair| pair[1][0] < pair[0][0] && pair[1][1] > pair[0][1]), "co-contraction: {lengths:?}");
}
