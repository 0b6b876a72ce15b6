//! The line of action: what is shipped keeps the sign of its moment arm, random muscles on random rigs measure what they draw, and what is wrong is said.

use std::path::{Path, PathBuf};

use glam::{DMat3, DMat4, DQuat, DVec3};
use proptest::prelude::*;
use sinew::animation::Pose;
use sinew::document::Document;
use sinew::formats::SCENE_READERS;
use sinew::i18n::{Language, Sentence, finding_line};
use sinew::muscle::presets::{PRESETS, Preset};
use sinew::muscle::{Finding, MuscleFile, MuscleRig};
use sinew::progress::Progress;
use sinew::scene::{Label, MuscleId, Node, NodeId, NodeKind, Scene, Transform, TransformOp, Unnamed};

use crate::in_each_language;

/// A muscle file alone in a scene.
fn alone(yaml: &str) -> MuscleRig {
    let file = MuscleFile::parse(yaml).unwrap_or_else(|error| panic!("{error}\n{yaml}"));
    MuscleRig::build(&file, "file", &mut Scene::default(), MuscleId(0))
}

fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    // The muscles of the walker are those of published models, whose moment arms change their sign where theirs do: see `sets`.
    files.retain(|path| path.extension().is_some_and(|ending| ending == "yaml") && !path.ends_with("walker-muscles.yaml"));
    files.sort();
    files
}

/// Angles from `low` to `high`, a quarter of a degree apart.
fn quarters(low: f64, high: f64) -> Vec<f64> {
    (0..=((high - low) / 0.25).round() as u32).map(|step| low + 0.25 * f64::from(step)).collect()
}

/// The moment arm is the slope of the length, and the length has no jump.
fn assert_smooth(rig: &MuscleRig, index: usize, angles: &[f64], what: &str) {
    const H: f64 = 1e-6;
    let mut before: Option<(f64, f64, f64)> = None;
    for &angle in angles {
        let h = H.to_degrees();
        let rows = rig.measure(index, &[angle - h, angle, angle + h]);
        let slope = (rows[0].solved.path_length - rows[2].solved.path_length) / (2.0 * H);
        let (length, arm) = (rows[1].solved.path_length, rows[1].moment_arm.unwrap());
        // Where a line leaves a ball its arm has a corner, and what is differenced across it is off by that.
        assert!((slope - arm).abs() < 1e-6 * arm.abs() + 1e-4, "{what}: {arm} is not {slope} at {angle}°");
        if let Some((last, long, lever)) = before {
            let missed = length - long + 0.5 * (arm + lever) * (angle - last).to_radians();
            assert!(missed.abs() < 2e-3, "{what}: the length jumps by {missed} at {angle}°");
        }
        before = Some((angle, length, arm));
    }
}

#[test]
fn every_shipped_muscle_keeps_the_sign_of_its_moment_arm_and_has_no_jump() {
    let mut muscles = 0;
    for path in shipped() {
        let document = Document::open(std::slice::from_ref(&path), SCENE_READERS, &Progress::default()).unwrap();
        let odd: Vec<String> = document
            .diagnostics
            .iter()
            .filter(|finding| finding.code().contains("muscle") || finding.code().contains("moment"))
            .map(finding_line)
            .collect();
        assert!(odd.is_empty(), "{odd:?}");
        for (rig, _) in document.rigs() {
            let range = rig.measured_range().unwrap();
            let angles = quarters(*range.start(), *range.end());
            for index in 0..rig.len() {
                let what = format!("{} of {}", rig.label(index).plain(), path.display());
                let arms: Vec<f64> = rig.measure(index, &angles).iter().map(|row| row.moment_arm.unwrap()).collect();
                let (least, most) = arms.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), arm| (arm.min(l), arm.max(m)));
                assert!(least >= -1e-9 || most <= 1e-9, "{what}: {least} to {most}");
                assert!(least.abs().max(most.abs()) > 5.0, "{what}: {least} to {most}");
                assert_smooth(rig, index, &angles, &what);
                muscles += 1;
            }
        }
    }
    assert!(muscles >= 12, "{muscles}");
}

#[test]
fn the_triceps_straightens_the_elbow_at_every_angle() {
    // Arm26: −2.0 to −2.4 cm.
    let preset = Preset::by_id("triceps").unwrap();
    assert!(preset.yaml.contains("Arm26") && preset.yaml.contains("Murray"));
    for row in alone(preset.yaml).measure(0, &quarters(0.0, 150.0)) {
        assert!((-24.0..=-20.0).contains(&row.moment_arm.unwrap()), "{} at {}°", row.moment_arm.unwrap(), row.angle.unwrap());
    }
    for preset in PRESETS {
        assert!(alone(preset.yaml).findings().is_empty(), "{}", preset.id);
    }
}

/// An arm with a ball in the elbow, beside which both ends lie off by `z`.
fn beside_the_ball(z: f64, radius: f64) -> String {
    format!(
        "arm: {{upper: 330, forearm: 260, thickness: 5, flexion: [0, 130]}}\nmuscles:\n  - {{length: 340, radii: [3, 5, 3], growth: [0, 1, 0], \
         origin: {{bone: upper arm, offset: [0, -30, {z:?}]}}, insertion: {{bone: forearm, offset: [0, -47, {z:?}]}}, \
         wrap: {{bone: upper arm, offset: [0, -330, 0], radius: {radius:?}, side: [1, 0, 0]}}}}\n"
    )
}

#[test]
fn over_a_ball_the_line_takes_the_shortest_path() {
    for z in [0.5, 8.0, 13.0, 18.5, 26.0] {
        let (yaml, r) = (beside_the_ball(z, 20.0), 20.0_f64);
        let rig = alone(&yaml);
        // At 0° both ways round the ball are as long, and before it the other one is the shorter.
        let angles = quarters(0.25, 130.0);
        for row in rig.measure(0, &angles) {
            // Both ends from the ball's centre, which is the elbow.
            let (sin, cos) = row.angle.unwrap().to_radians().sin_cos();
            let (a, b) = (DVec3::new(0.0, 300.0, z), DVec3::new(47.0 * sin, -47.0 * cos, z));
            let arc = a.angle_between(b) - (r / a.length()).acos() - (r / b.length()).acos();
            let length =
                if arc > 0.0 { (a.length_squared() - r * r).sqrt() + (b.length_squared() - r * r).sqrt() + r * arc } else { a.distance(b) };
            assert!(
                (row.solved.path_length - length).abs() < 1e-9,
                "{z}: {} is not {length} at {}°",
                row.solved.path_length,
                row.angle.unwrap()
            );
        }
        assert_smooth(&rig, 0, &angles, &format!("{z} mm beside the ball"));
    }
}

#[test]
fn via_points_make_no_jump_however_near_they_come() {
    let yaml = "arm: {upper: 310, forearm: 250, thickness: 8, flexion: [0, 150]}\nmuscles:\n  - {length: 290, radii: [4, 12, 16, 12, 4], growth: [0, 1, 1, 1, 0], \
                origin: {bone: upper arm, offset: [0, -30, 0]}, insertion: {bone: forearm, offset: [0, -45, 0]}, via: [{bone: upper arm, offset: \
                [38, -140, 0]}, {bone: upper arm, offset: [24, -285, 0]}, {bone: forearm, offset: [26, -18, 0]}]}\n";
    let rig = alone(yaml);
    assert_smooth(&rig, 0, &quarters(0.0, 150.0), "three via points");
    // The points themselves, by hand.
    let row = &rig.measure(0, &[90.0])[0];
    let elbow = [(0.0, 280.0), (38.0, 170.0), (24.0, 25.0), (18.0, 26.0), (45.0, 0.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
    let length: f64 = elbow.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    assert!((row.solved.path_length - length).abs() < 1e-9, "{} is not {length}", row.solved.path_length);
}

/// A rig of two bones under a node with any matrix at all, and a muscle on it.
#[derive(Debug, Clone)]
struct Limb {
    above: DMat4,
    own: [DVec3; 2],
    rest: f64,
    unit: f64,
    yaml: String,
    angle: f64,
}

fn limbs() -> impl Strategy<Value = Limb> {
    let spread = |most: f64| (-most..most, -most..most, -most..most).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    let factor = || (prop_oneof![Just(-1.0), Just(1.0)], 0.5..2.0_f64).prop_map(|(sign, size)| sign * size);
    let above = (factor(), factor(), factor(), spread(0.3), spread(3.0)).prop_map(|(x, y, z, shear, turn)| {
        let skewed = DMat3::from_cols(DVec3::new(x, shear.x, 0.0), DVec3::new(0.0, y, shear.y), DVec3::new(shear.z, 0.0, z));
        DMat4::from_mat3(DMat3::from_quat(DQuat::from_scaled_axis(turn)) * skewed)
    });
    let own = (0.6..1.6_f64, 0.6..1.6_f64, 0.6..1.6_f64).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    let point = |near: f64, far: f64| (10.0..40.0_f64, -far..-near, -30.0..30.0_f64);
    let muscle =
        (point(20.0, 60.0), point(30.0, 80.0), prop::option::of(point(100.0, 200.0)), prop::option::of(8.0..30.0_f64), 0.0..60.0_f64);
    (above, [own.clone(), own], -30.0..60.0_f64, prop_oneof![Just(0.01), Just(1.0), Just(0.0254)], muscle, -20.0..140.0_f64, any::<bool>()).prop_map(
        |(above, own, rest, unit, (from, to, via, ball, tendon), angle, scaled)| {
            let at = |bone: &str, (x, y, z): (f64, f64, f64)| format!("{{bone: {bone}, offset: [{x:?}, {y:?}, {z:?}]}}");
            let via = via.map_or_else(String::new, |via| format!("    via: [{}]\n", at("upper", via)));
            let ball = ball.map_or_else(String::new, |radius| {
                format!("    wrap: {{bone: upper, offset: [0, -300, 0], radius: {radius:?}, side: [1, 0, 0]}}\n")
            });
            let scale = if scaled { "scale: with bones\n" } else { "" };
            let yaml = format!(
                "joint: {{bone: fore, axis: [0, 0, 1], range: [-20, 140]}}\n{scale}muscles:\n  - length: 200\n    radii: [4, 12, 16, 4]\n    growth: [0, 1, 1.5, 0]\n    \
                 origin: {}\n    insertion: {}\n{via}{ball}    tendons: {{origin: {{length: {tendon:?}, radius: 2}}, insertion: {{length: {:?}, radius: 2}}}}\n",
                at("upper", from),
                at("fore", to),
                2.0 * tendon
            );
            Limb { above, own, rest, unit, yaml, angle }
        },
    )
}

impl Limb {
    fn scene(&self) -> (Scene, [NodeId; 2]) {
        let mut scene = Scene::default();
        let mut asset = Node::new("limb.dae").with_kind(NodeKind::Asset);
        asset.transform = Transform { ops: vec![TransformOp::Scale(DVec3::splat(self.unit))] };
        let root = scene.graph.add(None, asset);
        let above = scene.graph.add(Some(root), Node::new("above").with_transform(Transform::from_matrix(self.above)));
        let long = DVec3::NEG_Y * (0.3 / self.unit);
        let mut bone = |parent, name: &str, ops| {
            scene.graph.add(Some(parent), Node::new(name).with_kind(NodeKind::Joint).with_transform(Transform { ops }))
        };
        let upper = bone(above, "upper", vec![TransformOp::Scale(self.own[0])]);
        let turn = TransformOp::Rotate { axis: DVec3::new(0.1, 0.2, 1.0), angle: self.rest };
        let fore = bone(upper, "fore", vec![TransformOp::Translate(long), turn, TransformOp::Scale(self.own[1])]);
        bone(fore, "hand", vec![TransformOp::Translate(long)]);
        (scene, [upper, fore])
    }
}

fn grid() -> impl Strategy<Value = [i32; 3]> {
    (-1..3_i32, -6..0_i32, -1..2_i32).prop_map(|(x, y, z)| [x * 10, y * 40, z * 10])
}

#[test]
fn a_belly_that_leaves_the_bone_bow_strings_and_a_via_point_holds_it() {
    let found = |via: &str| {
        let yaml = format!(
            "joint: {{bone: fore, axis: [0, 0, 1], range: [0, 120]}}\nmuscles:\n  - {{length: 200, radii: [4, 12, 16, 4], growth: [0, 1, 1.5, 0], \
             origin: {{bone: upper, offset: [25, -20, 0]}}, insertion: {{bone: fore, offset: [10, -60, 0]}}{via}, \
             tendons: {{origin: {{length: 40, radius: 3}}, insertion: {{length: 100, radius: 3}}}}}}\n"
        );
        let limb = Limb { above: DMat4::IDENTITY, own: [DVec3::ONE; 2], rest: 0.0, unit: 1.0, yaml, angle: 0.0 };
        let (mut scene, _) = limb.scene();
        let mut rig = MuscleRig::build(&MuscleFile::parse(&limb.yaml).unwrap(), "muscle", &mut scene, MuscleId(0));
        rig.attach(&scene).into_iter().filter(|found| found.code() == "muscle-bow-strings").map(|found| found.finding).collect::<Vec<_>>()
    };
    let [Finding::BowStrings { rest, most, angle }] = found("")[..] else { panic!("one finding") };
    assert!(most > rest + 15.0 && (0.0..=120.0).contains(&angle) && angle > 60.0, "{rest} to {most} mm at {angle}°");
    // 25 mm beside the bone at rest, and so all the time where a point above the elbow holds the line there.
    assert!((15.0..30.0).contains(&rest), "{rest}");
    assert!(found(", via: [{bone: upper, offset: [25, -240, 0]}]").is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn what_is_measured_is_what_is_drawn_on_any_rig(limb in limbs()) {
        let (mut scene, [_, fore]) = limb.scene();
        let mut rig = MuscleRig::build(&MuscleFile::parse(&limb.yaml).unwrap(), "muscle", &mut scene, MuscleId(0));
        rig.attach(&scene);
        let joint = rig.joint().unwrap();
        let posed = |degrees: f64| {
            let mut local = scene.graph.rest_locals();
            local[fore.index()] = joint.absolute(degrees).apply(local[fore.index()], local[fore.index()]);
            let mut world = Vec::new();
            scene.graph.world_from_local(&local, &mut world);
            world
        };
        let world = posed(limb.angle);
        let measured = &rig.measure(0, &[limb.angle])[0];
        let drawn = rig.solve(0, rig.at_flexion(0.0), &world);
        prop_assert!((drawn.path_length / measured.solved.path_length - 1.0).abs() < 1e-9, "{} {}\n{}", drawn.path_length, measured.solved.path_length, limb.yaml);
        let path = drawn.centerline();
        prop_assert!((path.length() / drawn.path_length - 1.0).abs() < 1e-9, "{} {}\n{}", path.length(), drawn.path_length, limb.yaml);
        // The same arm from the pose as from the sweep, and both are the slope of what is drawn.
        let arm = rig.moment_arm(0, &scene, &world).unwrap();
        prop_assert!((arm - measured.moment_arm.unwrap()).abs() < 1e-6 * (1.0 + arm.abs()), "{arm} {}", measured.moment_arm.unwrap());
        const H: f64 = 1e-5;
        let length = |by: f64| rig.solve(0, rig.at_flexion(0.0), &posed((limb.angle + by.to_degrees()).clamp(-20.0, 140.0))).path_length;
        prop_assume!(limb.angle > -19.9 && limb.angle < 139.9);
        let slope = (length(-H) - length(H)) / (2.0 * H);
        prop_assert!((slope - arm).abs() < 1e-3 + 1e-5 * arm.abs(), "{slope} {arm}\n{}", limb.yaml);
        prop_assert!(drawn.length >= 0.4 * rig.profile(0).unwrap().rest_length() * (1.0 - 1e-12), "{}", drawn.length);
        prop_assert!(drawn.volume_error.abs() < 1e-12);
    }

    /// Points on a coarse grid: lines that run back on themselves and points that fall together are common.
    #[test]
    fn a_line_over_any_via_points_is_drawn_as_long_as_it_is(
        ends in [grid(), grid()],
        via in prop::collection::vec((any::<bool>(), grid()), 1..5),
        tendon in prop_oneof![Just(0.0), 0.0..30.0_f64],
        angle in prop_oneof![Just(0.0), 0.0..140.0_f64],
    ) {
        let bone = |upper: bool| if upper { "upper arm" } else { "forearm" };
        let via: Vec<String> = via.iter().map(|(upper, at)| format!("{{bone: {}, offset: {at:?}}}", bone(*upper))).collect();
        let yaml = format!("arm: {{upper: 300, forearm: 260, thickness: 8, flexion: [0, 140]}}\nmuscles:\n  - {{length: 100, radii: [4, 12, 4], growth: [0, 1, 0], \
            origin: {{bone: upper arm, offset: {:?}}}, insertion: {{bone: forearm, offset: {:?}}}, via: [{}], \
            tendons: {{origin: {{length: {tendon:?}, radius: 3}}, insertion: {{length: {tendon:?}, radius: 3}}}}}}\n", ends[0], ends[1], via.join(", "));
        let mut scene = Scene::default();
        let rig = MuscleRig::build(&MuscleFile::parse(&yaml).unwrap(), "via", &mut scene, MuscleId(0));
        let mut pose = Pose::rest(&scene);
        rig.apply(rig.at_flexion(angle), &mut pose);
        let (mut local, mut world) = (Vec::new(), Vec::new());
        pose.locals(&mut local);
        scene.graph.world_from_local(&local, &mut world);
        let drawn = rig.solve(0, rig.at_flexion(angle), &world);
        let path = drawn.centerline();
        prop_assert!((path.length() - drawn.path_length).abs() < 1e-9 * drawn.path_length, "{} {}\n{yaml}", path.length(), drawn.path_length);
    }

    #[test]
    fn no_belly_is_shorter_than_two_fifths_of_its_rest(tendon in 0.0..400.0_f64, near in 5.0..200.0_f64, angle in 0.0..180.0_f64, growth in prop::collection::vec(-1.0..2.0_f64, 4)) {
        let mut growth = growth;
        growth[1] = growth[1].abs() + 0.5;
        let yaml = format!("arm: {{upper: 330, forearm: 260, thickness: 8}}\nmuscles:\n  - {{length: 260, radii: [4, 14, 15, 4], growth: {growth:?}, \
            origin: {{bone: upper arm, offset: [0, {:?}, 0]}}, insertion: {{bone: forearm, offset: [0, -{near:?}, 0]}}, \
            tendons: {{origin: {{length: {tendon:?}, radius: 3}}, insertion: {{length: {tendon:?}, radius: 3}}}}}}\n", near - 330.0);
        let rig = alone(&yaml);
        let row = &rig.measure(0, &[angle])[0];
        prop_assert!(row.solved.length >= 104.0 - 1e-9, "{}", row.solved.length);
        prop_assert!(row.solved.volume_error.abs() < 1e-12 && row.solved.radii.iter().all(|radius| *radius < 60.0), "{:?}", row.solved);
    }
}

#[test]
fn slack_tendons_end_where_they_are_attached() {
    let yaml = "arm: {upper: 330, forearm: 260, thickness: 8, flexion: [0, 120]}\nmuscles:\n  - {length: 250, radii: [4, 12, 4], growth: [0, 1, 0], origin: {bone: upper arm, \
                offset: [0, -30, 0]}, insertion: {bone: forearm, offset: [0, -47, 0]}, tendons: {origin: {length: 190, radius: 3}, insertion: {length: 210, radius: 3}}}\n";
    let mut scene = Scene::default();
    let rig = MuscleRig::build(&MuscleFile::parse(yaml).unwrap(), "slack", &mut scene, MuscleId(0));
    let mut world = Vec::new();
    scene.graph.world_from_local(&scene.graph.rest_locals(), &mut world);
    let solved = rig.solve(0, rig.at_flexion(0.0), &world);
    assert!(solved.held && (solved.length - 100.0).abs() < 1e-9, "{}", solved.length);
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    rig.deform(0, &solved, &world, &mut positions, &mut normals);
    let (low, high) = positions.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), at| (low.min(at.y), high.max(at.y)));
    // From the rod of the shoulder, 0.56 m up, to the forearm, 0.213 m up; as wide as a belly of that volume and length is.
    assert!(low > 0.2 && high < 0.57, "{low} {high}");
    assert!(positions.iter().all(|at| at.x.abs() < 0.09 && at.z.abs() < 0.04));
}

/// Codes and sentences of a file's findings.
fn said(yaml: &str) -> Vec<(&'static str, String)> {
    alone(yaml).findings().iter().map(|found| (found.code(), format!("{}: {}", found.element, found.finding.sentence()))).collect()
}

#[test]
fn what_is_wrong_over_the_range_of_the_joint_is_said_with_muscle_and_angle() {
    let muscle = |origin: &str, insertion: &str, more: &str| {
        format!(
            "arm: {{upper: 330, forearm: 260, thickness: 8, flexion: [0, 140]}}\nmuscles:\n  - {{name: Odd, length: 240, origin: {{bone: upper arm, offset: {origin}}}, \
             insertion: {{bone: forearm, offset: {insertion}}}, {more}}}\n"
        )
    };
    let thin = "radii: [3, 8, 3], growth: [0, 1, 0]";
    let cases = [
        // An end that comes into the ball, one that never meets it, one that the joint carries to the other side.
        (
            muscle(
                "[0, -40, 0]",
                "[-20, -10, 0]",
                &format!("{thin}, wrap: {{bone: upper arm, offset: [0, -336, 0], radius: 20, side: [-1, 0, 0]}}"),
            ),
            "muscle-wrap-inert",
        ),
        (
            muscle(
                "[20, -60, 0]",
                "[20, -47, 0]",
                &format!("{thin}, wrap: {{bone: upper arm, offset: [-200, -200, 0], radius: 5, side: [1, 0, 0]}}"),
            ),
            "muscle-wrap-inert",
        ),
        (muscle("[-10, -40, 0]", "[-20, 8, 0]", thin), "moment-arm-changes-sign"),
        (muscle("[0, -150, 0]", "[0, -160, 0]", &format!("{thin}, tendons: {{insertion: {{length: 30, radius: 2}}}}")), "muscle-too-short"),
        (
            muscle("[0, -30, 0]", "[0, -47, 0]", &format!("{thin}, tendons: {{insertion: {{length: 390, radius: 2}}}}")),
            "muscle-shorter-than-tendons",
        ),
        (muscle("[0, -30, 0]", "[0, -47, 0]", "radii: [4, 80, 80, 80, 4], growth: [0, 1, 1, 1, 0]"), "muscle-too-thick"),
        (
            muscle(
                "[-25, -20, 0]",
                "[10, -47, 0]",
                "radii: [4, 14, 18, 14, 4], growth: [0, 1, 1, 1, 0], via: [{bone: upper arm, offset: [2, -120, 0]}, {bone: upper arm, offset: [2, -260, 0]}]",
            ),
            "muscle-through-bone",
        ),
        (
            muscle(
                "[0, -40, 12]",
                "[-1, -47, 12]",
                &format!("{thin}, via: [{{bone: upper arm, offset: [40, -150, 12], active: {{joint: elbow, range: [30, 90]}}}}]"),
            ),
            "muscle-path-jumps",
        ),
        (
            muscle(
                "[0, -40, 300]",
                "[0, -47, 300]",
                &format!("{thin}, wraps: [{{shape: cylinder, bone: upper arm, offset: [0, -330, 0], radius: 20, length: 60, side: +x}}]"),
            ),
            "muscle-wrap-beyond-end",
        ),
    ];
    in_each_language(|_| {
        for (yaml, code) in &cases {
            let found = said(yaml);
            let message = found.iter().find(|(found, _)| found == code).unwrap_or_else(|| panic!("{code}: {found:?}\n{yaml}"));
            assert!(message.1.starts_with("Odd: ") && message.1.ends_with('.') && !message.1.contains("muscle-"), "{message:?}");
            assert!(message.1.contains('°') || *code == "muscle-shorter-than-tendons", "{message:?}");
        }
    });
    assert_eq!(said(&muscle("[0, -30, 0]", "[0, -47, 0]", thin)), []);
}

#[test]
fn muscles_without_a_name_are_called_by_their_place_and_a_single_one_like_its_file() {
    let muscle = "  - {length: 100, radii: [3, 80, 3], growth: [0, 1, 0], origin: {bone: upper arm, offset: [0, -40, 0]}, insertion: {bone: forearm, offset: [0, -60, 0]}}\n";
    let yaml = |count: usize| format!("arm: {{upper: 330, forearm: 260, thickness: 8}}\nmuscles:\n{}", muscle.repeat(count));
    assert_eq!(alone(&yaml(1)).label(0), Label::Name("file"));
    let file = MuscleFile::parse(&yaml(2)).unwrap();
    let mut scene = Scene::default();
    let rig = MuscleRig::build(&file, "file", &mut scene, MuscleId(0));
    let second = Label::Unnamed(Unnamed::Muscle(2));
    assert_eq!(rig.label(1), second);
    assert_eq!(scene.graph.find("Muscle 2").map(|node| scene.graph.label(node)), Some(second));
    assert!(scene.materials.iter().any(|material| material.label() == second));
    assert!(rig.findings().iter().any(|found| found.element.as_label() == second), "{:?}", rig.findings());
    assert!(!file.to_yaml().contains("name"), "{}", file.to_yaml());
    in_each_language(|language| {
        let found = rig.findings().iter().find(|found| found.element.as_label() == second).unwrap();
        let (muscle, bone) =
            if language == Language::English { ("Muscle 2: ", "“Upper arm”") } else { ("Мышца 2: ", "«Плечо»") };
        let said = finding_line(found);
        assert!(said.starts_with(muscle) && said.contains(bone), "{said}");
    });
}

#[test]
fn muscles_scale_with_the_bones_where_the_file_says_so() {
    let limb = |size: f64| {
        let mut scene = Scene::default();
        let mut asset = Node::new("limb.dae").with_kind(NodeKind::Asset);
        asset.transform = Transform { ops: vec![TransformOp::Scale(DVec3::splat(0.01))] };
        let root = scene.graph.add(None, asset);
        let mut bone = |parent, name: &str, ops| {
            scene.graph.add(Some(parent), Node::new(name).with_kind(NodeKind::Joint).with_transform(Transform { ops }))
        };
        let upper = bone(root, "upper", vec![TransformOp::Scale(DVec3::splat(size))]);
        bone(upper, "fore", vec![TransformOp::Translate(DVec3::NEG_Y * 30.0)]);
        scene
    };
    let yaml = "unit: mm\njoint: {bone: fore, axis: [0, 0, 1], range: [0, 140]}\nscale: with bones\nmuscles:\n  - {length: 270, radii: [4, 16, 4], growth: [0, 1, 0], origin: \
                {bone: upper, offset: [0, -20, 0]}, insertion: {bone: fore, offset: [0, -45, 0]}, wrap: {bone: upper, offset: [0, -300, 0], radius: 14, side: [1, 0, 0]}, \
                tendons: {insertion: {length: 50, radius: 3}}}\n";
    let measured = |yaml: &str, size: f64| {
        let mut scene = limb(size);
        let mut rig = MuscleRig::build(&MuscleFile::parse(yaml).unwrap(), "m", &mut scene, MuscleId(0));
        let found = rig.attach(&scene);
        assert!(found.is_empty() || yaml.contains(&format!("scale: {size:?}")), "{found:?}");
        (rig.scale(0), rig.measure(0, &[0.0, 50.0, 110.0]))
    };
    let (one, plain) = measured(yaml, 1.0);
    assert_eq!(one, 1.0);
    let without = measured(&yaml.replace("scale: with bones\n", ""), 1.0).1;
    for size in [2.0, 0.3] {
        for (text, reference) in [("with bones".to_owned(), 1.0), (format!("{size:?}"), size)] {
            let (scale, rows) = measured(&yaml.replace("with bones", &text), size);
            let by = size / reference;
            assert!((scale - by).abs() < 1e-12);
            for ((row, plain), without) in rows.iter().zip(&plain).zip(&without) {
                assert!((plain.solved.path_length - without.solved.path_length).abs() < 1e-9);
                // A number says what the bones' scale was when the lengths held: at that, offsets are what the file has, and the bones are longer.
                if reference == 1.0 {
                    assert!((row.solved.path_length - by * plain.solved.path_length).abs() < 1e-9 * by, "{row:?}");
                    assert!((row.solved.length - by * plain.solved.length).abs() < 1e-9 * by);
                    assert!((row.moment_arm.unwrap() - by * plain.moment_arm.unwrap()).abs() < 1e-9 * by);
                    assert!((row.solved.volume / plain.solved.volume / by.powi(3) - 1.0).abs() < 1e-12);
                    assert!(row.solved.radii.iter().zip(&plain.solved.radii).all(|(a, b)| (a - by * b).abs() < 1e-9));
                }
                assert!(row.solved.volume_error.abs() < 1e-12);
            }
        }
    }
    // Saved and read again it is the same; comments stay when it changes.
    for text in ["with bones", "0.01"] {
        let file = MuscleFile::parse(&yaml.replace("with bones", text)).unwrap();
        assert_eq!(MuscleFile::parse(&file.to_yaml()).unwrap(), file);
    }
    for bad in ["bones", "0.0", "-1.0", "[1.0]"] {
        let error = MuscleFile::parse(&yaml.replace("with bones", bad)).unwrap_err();
        assert_eq!(error.line, Some(3), "{error}");
    }
    let on_arm = MuscleFile::parse(&format!("scale: with bones\n{}", beside_the_ball(0.0, 20.0))).unwrap_err();
    assert_eq!(on_arm.line, Some(1));
}
