//! Figures that the tests make, in the names of usual rigs and without names.

use glam::DVec3;
use sinew_scene::{Node, NodeId, NodeKind, Scene, Transform, TransformOp};

use super::{BodySide, Humanoid, Limb, LimbJoint};

/// Where the bones of one figure begin, metres: Y up, looking along +Z, its left at +X. A name has `<` and `>` around what the two sides say in its place.
const PLACES: [(&str, Option<usize>, [f64; 3]); 24] = [
    ("pelvis", None, [0.0, 1.0, 0.0]),
    ("spine", Some(0), [0.0, 1.15, 0.0]),
    ("chest", Some(1), [0.0, 1.35, 0.0]),
    ("neck", Some(2), [0.0, 1.5, 0.0]),
    ("head", Some(3), [0.0, 1.6, 0.0]),
    ("head end", Some(4), [0.0, 1.8, 0.0]),
    ("clavicle", Some(2), [0.03, 1.45, 0.0]),
    ("upper arm", Some(6), [0.18, 1.45, 0.0]),
    ("forearm", Some(7), [0.46, 1.45, 0.0]),
    ("hand", Some(8), [0.71, 1.45, 0.0]),
    ("finger", Some(9), [0.80, 1.45, 0.0]),
    ("thigh", Some(0), [0.09, 0.95, 0.0]),
    ("shin", Some(11), [0.09, 0.52, 0.01]),
    ("foot", Some(12), [0.09, 0.09, -0.02]),
    ("toes", Some(13), [0.09, 0.02, 0.12]),
    ("clavicle", Some(2), [-0.03, 1.45, 0.0]),
    ("upper arm", Some(15), [-0.18, 1.45, 0.0]),
    ("forearm", Some(16), [-0.46, 1.45, 0.0]),
    ("hand", Some(17), [-0.71, 1.45, 0.0]),
    ("finger", Some(18), [-0.80, 1.45, 0.0]),
    ("thigh", Some(0), [-0.09, 0.95, 0.0]),
    ("shin", Some(20), [-0.09, 0.52, 0.01]),
    ("foot", Some(21), [-0.09, 0.09, -0.02]),
    ("toes", Some(22), [-0.09, 0.02, 0.12]),
];

/// What rigs call pelvis, clavicle, upper arm, forearm, hand, thigh, shin, foot, toes.
const CONVENTIONS: [(&str, [&str; 2], [&str; 9]); 12] = [
    (
        "Mixamo",
        ["Left", "Right"],
        [
            "mixamorig:Hips",
            "mixamorig:#Shoulder",
            "mixamorig:#Arm",
            "mixamorig:#ForeArm",
            "mixamorig:#Hand",
            "mixamorig:#UpLeg",
            "mixamorig:#Leg",
            "mixamorig:#Foot",
            "mixamorig:#ToeBase",
        ],
    ),
    (
        "Biped",
        ["L", "R"],
        [
            "Bip01 Pelvis",
            "Bip01 # Clavicle",
            "Bip01 # UpperArm",
            "Bip01 # Forearm",
            "Bip01 # Hand",
            "Bip01 # Thigh",
            "Bip01 # Calf",
            "Bip01 # Foot",
            "Bip01 # Toe0",
        ],
    ),
    (
        "Rigify",
        ["L", "R"],
        [
            "DEF-spine",
            "DEF-shoulder.#",
            "DEF-upper_arm.#",
            "DEF-forearm.#",
            "DEF-hand.#",
            "DEF-thigh.#",
            "DEF-shin.#",
            "DEF-foot.#",
            "DEF-toe.#",
        ],
    ),
    ("Daz Genesis 8", ["l", "r"], ["pelvis", "#Collar", "#ShldrBend", "#ForearmBend", "#Hand", "#ThighBend", "#Shin", "#Foot", "#Toe"]),
    ("Daz Genesis 9", ["l", "r"], ["pelvis", "#_shoulder", "#_upperarm", "#_forearm", "#_hand", "#_thigh", "#_shin", "#_foot", "#_toes"]),
    (
        "VRM",
        ["L", "R"],
        [
            "J_Bip_C_Hips",
            "J_Bip_#_Shoulder",
            "J_Bip_#_UpperArm",
            "J_Bip_#_LowerArm",
            "J_Bip_#_Hand",
            "J_Bip_#_UpperLeg",
            "J_Bip_#_LowerLeg",
            "J_Bip_#_Foot",
            "J_Bip_#_ToeBase",
        ],
    ),
    ("Unreal", ["l", "r"], ["pelvis", "clavicle_#", "upperarm_#", "lowerarm_#", "hand_#", "thigh_#", "calf_#", "foot_#", "ball_#"]),
    ("HumanIK", ["Left", "Right"], ["Hips", "#Shoulder", "#Arm", "#ForeArm", "#Hand", "#UpLeg", "#Leg", "#Foot", "#ToeBase"]),
    ("Biovision", ["Left", "Right"], ["Hips", "#Collar", "#Shoulder", "#Elbow", "#Wrist", "#Hip", "#Knee", "#Ankle", "#Toe"]),
    ("Poser", ["l", "r"], ["hip", "#Collar", "#Shldr", "#ForeArm", "#Hand", "#Thigh", "#Shin", "#Foot", "#Toe"]),
    (
        "Maya joints",
        ["L", "R"],
        [
            "C_root_JNT",
            "#_clavicle_JNT",
            "#_shoulder_JNT",
            "#_elbow_JNT",
            "#_wrist_JNT",
            "#_hip_JNT",
            "#_knee_JNT",
            "#_ankle_JNT",
            "#_ball_JNT",
        ],
    ),
    ("Russian", ["Л", "П"], ["Таз", "Ключица_#", "Плечо_#", "Предплечье_#", "Кисть_#", "Бедро_#", "Голень_#", "Стопа_#", "Носок_#"]),
];

const PARTS: [&str; 9] = ["pelvis", "clavicle", "upper arm", "forearm", "hand", "thigh", "shin", "foot", "toes"];

/// A figure whose bones are called by `name` (part, whether it is on the right) and put by `place`.
fn figure(scene: &mut Scene, mut name: impl FnMut(&str, bool) -> String, place: impl Fn(DVec3) -> DVec3) -> Vec<NodeId> {
    let mut ids: Vec<NodeId> = Vec::new();
    for (number, (part, parent, at)) in PLACES.iter().enumerate() {
        let from = parent.map_or(DVec3::ZERO, |parent| place(DVec3::from_array(PLACES[parent].2)));
        let offset = place(DVec3::from_array(*at)) - from;
        let node = Node::new(name(part, number >= 15))
            .with_kind(NodeKind::Joint)
            .with_transform(Transform { ops: vec![TransformOp::Translate(offset)] });
        ids.push(scene.graph.add(parent.map(|parent| ids[parent]), node));
    }
    ids
}

fn joints(limb: &Limb) -> [Option<NodeId>; 4] {
    [LimbJoint::Root, LimbJoint::Middle, LimbJoint::End, LimbJoint::Tip].map(|joint| limb.joint(joint))
}

/// Holds a figure that was found against the nodes of [`PLACES`].
fn assert_found(figure: &Humanoid, ids: &[NodeId], exchanged: bool, what: &str) {
    for side in BodySide::BOTH {
        let right = (side == BodySide::Right) != exchanged;
        let id = |left: usize| Some(ids[if right { left + 9 } else { left }]);
        let (arm, leg) = (figure.arms[side as usize], figure.legs[side as usize]);
        assert_eq!((arm.girdle, leg.girdle), (id(6), Some(ids[0])), "{what} {side:?}");
        assert_eq!(joints(&arm)[..3], [id(7), id(8), id(9)], "{what} {side:?}");
        assert_eq!(joints(&leg), [id(11), id(12), id(13), id(14)], "{what} {side:?}");
    }
}

fn named(convention: &str, part: &str, right: bool) -> String {
    let (_, sides, words) = CONVENTIONS.iter().find(|(name, ..)| *name == convention).unwrap();
    match PARTS.iter().position(|known| *known == part) {
        Some(at) => words[at].replace('#', sides[usize::from(right)]),
        None => format!("{part}{}", if right { "2" } else { "1" }),
    }
}

#[test]
fn limbs_are_found_in_the_names_of_usual_rigs() {
    for (convention, ..) in CONVENTIONS {
        let mut scene = Scene::default();
        let ids = figure(&mut scene, |part, right| named(convention, part, right), |at| at);
        let found = Humanoid::find(&scene, &[]);
        assert_eq!(found.len(), 1, "{convention}");
        assert_found(&found[0], &ids, false, convention);
        let axes = found[0].axes;
        assert!(axes.front.distance(DVec3::Z) < 0.05 && axes.up.distance(DVec3::Y) < 0.05, "{convention}: {axes:?}");
        assert!(axes.right.distance(DVec3::NEG_X) < 1e-9 && !axes.is_mirrored());
    }
}

#[test]
fn limbs_are_found_without_names_wherever_the_figure_stands() {
    let turn = glam::DQuat::from_rotation_y(2.0) * glam::DQuat::from_rotation_z(0.3);
    type Move = Box<dyn Fn(DVec3) -> DVec3>;
    let moves: [(&str, Move); 4] = [
        ("as it is", Box::new(|at| at)),
        ("turned", Box::new(move |at| turn * at + DVec3::new(3.0, -2.0, 5.0))),
        ("small", Box::new(|at| at * 0.01)),
        ("lying", Box::new(|at| glam::DQuat::from_rotation_x(-1.5) * at)),
    ];
    for (what, place) in &moves {
        let mut scene = Scene::default();
        let mut number = 0;
        let ids = figure(
            &mut scene,
            |_, _| {
                number += 1;
                format!("bone{number:03}")
            },
            place,
        );
        let found = Humanoid::find(&scene, &[]);
        assert_eq!(found.len(), 1, "{what}");
        assert_found(&found[0], &ids, false, what);
        let (front, up) = (place(DVec3::Z) - place(DVec3::ZERO), place(DVec3::Y) - place(DVec3::ZERO));
        assert!(found[0].axes.front.dot(front.normalize()) > 0.99 && found[0].axes.up.dot(up.normalize()) > 0.99, "{what}");
    }
}

#[test]
fn helpers_and_copies_beside_the_bones_are_passed_over() {
    let mut scene = Scene::default();
    let ids = figure(&mut scene, |part, right| named("Unreal", part, right), |at| at);
    let helper = |scene: &mut Scene, parent: NodeId, name: &str, at: DVec3| {
        let node = Node::new(name).with_kind(NodeKind::Joint).with_transform(Transform { ops: vec![TransformOp::Translate(at)] });
        scene.graph.add(Some(parent), node)
    };
    helper(&mut scene, ids[7], "upperarm_twist_01_l", DVec3::X * 0.14);
    helper(&mut scene, ids[8], "lowerarm_twist_01_l", DVec3::X * 0.2);
    helper(&mut scene, ids[11], "thigh_twist_01_l", DVec3::Y * -0.2);
    helper(&mut scene, ids[0], "ik_foot_root", DVec3::ZERO);
    let found = Humanoid::find(&scene, &[]);
    assert_found(&found[0], &ids, false, "Unreal");
}

#[test]
fn two_figures_are_two_and_a_mirrored_one_looks_the_same_way() {
    let mut scene = Scene::default();
    let first = figure(&mut scene, |part, right| named("Mixamo", part, right), |at| at);
    let second = figure(&mut scene, |part, right| named("Biped", part, right), |at| at * DVec3::new(-1.0, 1.0, 1.0) + DVec3::X);
    let found = Humanoid::find(&scene, &[]);
    assert_eq!(found.len(), 2);
    assert_found(&found[0], &first, false, "first");
    assert_found(&found[1], &second, false, "second");
    assert!(!found[0].axes.is_mirrored() && found[1].axes.is_mirrored());
    assert!(found[1].axes.front.distance(DVec3::Z) < 0.05);
}

#[test]
fn what_a_rig_lacks_stays_empty() {
    let mut scene = Scene::default();
    let ids = figure(&mut scene, |part, right| named("Mixamo", part, right), |at| at);
    // The same rig without its left foot.
    let mut cut = Scene::default();
    let mut moved: Vec<Option<NodeId>> = Vec::new();
    for (id, node) in scene.graph.iter() {
        let kept = ![ids[13], ids[14]].contains(&id);
        let parent = node.parent().and_then(|parent| moved[parent.index()]);
        let copy = Node::new(node.name.clone()).with_kind(NodeKind::Joint).with_transform(node.transform.clone());
        moved.push(kept.then(|| cut.graph.add(parent, copy)));
    }
    let found = Humanoid::find(&cut, &[]);
    assert_eq!(joints(&found[0].legs[0]), [moved[11], moved[12], None, None]);
    assert!(found[0].legs[1].joint(LimbJoint::End).is_some());
    assert!(Humanoid::find(&Scene::default(), &[]).is_empty());
    let mut ball = Scene::default();
    ball.graph.add(None, Node::new("ball"));
    assert!(Humanoid::find(&ball, &[]).is_empty());
}

#[test]
fn thousands_of_bones_with_the_names_of_limbs_are_no_figure() {
    let mut scene = Scene::default();
    let mut bone = |parent: Option<NodeId>, name: &str, at: DVec3| {
        let node = Node::new(name).with_kind(NodeKind::Joint).with_transform(Transform { ops: vec![TransformOp::Translate(at)] });
        scene.graph.add(parent, node)
    };
    let mut spine = None;
    for number in 0..4000 {
        spine = Some(bone(spine, if number % 2 == 0 { "forearm" } else { "l_shin" }, DVec3::Y * 0.1));
        bone(spine, "l_leg", DVec3::X * 0.1);
    }
    let found = Humanoid::find(&scene, &[]);
    assert!(found.iter().all(|figure| figure.legs.iter().chain(&figure.arms).any(|limb| !limb.is_whole())));
}
