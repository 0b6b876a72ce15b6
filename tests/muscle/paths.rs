//! Paths over wrap surfaces and via points as files describe them: closed forms, joints, conditional and moving points, several joints, any rig.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat3, DMat4, DQuat, DVec3};
use proptest::prelude::*;
use sinew::animation::Pose;
use sinew::muscle::{MuscleFile, MuscleRig, MuscleSample};
use sinew::scene::{MuscleId, Node, NodeId, NodeKind, Scene, Transform, TransformOp};

/// A muscle on an arm of 330 and 260 units whose elbow lies in the origin of the upper arm's bone shifted by −330 along y.
fn on_arm(keys: &str) -> MuscleRig {
    MuscleRig::build(&file_on_arm(keys), "m", &mut Scene::default(), MuscleId(0))
}

fn file_on_arm(keys: &str) -> MuscleFile {
    let yaml = format!(
        "arm: {{upper: 330, forearm: 260, thickness: 1, flexion: [0, 150]}}\nmuscles:\n  - {{length: 300, radii: [1, 2, 1], growth: [0, 1, 0], {keys}}}\n"
    );
    let file = MuscleFile::parse(&yaml).unwrap_or_else(|error| panic!("{error}\n{yaml}"));
    assert_eq!(MuscleFile::parse(&file.to_yaml()).unwrap(), file, "{}", file.to_yaml());
    file
}

fn sample(rig: &MuscleRig, angle: f64) -> MuscleSample {
    rig.measure(0, &[angle]).remove(0)
}

/// The moment arm is −dL/dφ.
fn assert_slope(rig: &MuscleRig, angle: f64) {
    const H: f64 = 1e-5;
    let rows = rig.measure(0, &[angle - H.to_degrees(), angle, angle + H.to_degrees()]);
    let slope = (rows[0].solved.path_length - rows[2].solved.path_length) / (2.0 * H);
    let arm = rows[1].moment_arm.unwrap();
    assert!((slope - arm).abs() < 1e-6 * (1.0 + arm.abs()), "{slope} {arm} at {angle}°");
}

const ENDS: &str = "origin: {bone: upper arm, offset: [0, -30, 0]}, insertion: {bone: forearm, offset: [0, -100, 0]}";

#[test]
fn over_a_cylinder_at_the_joint_the_moment_arm_is_its_radius() {
    let radius = 20.0;
    let rig = on_arm(&format!(
        "{ENDS}, wraps: [{{shape: cylinder, bone: upper arm, offset: [0, -330, 0], radius: {radius:?}, length: 80, side: -x}}]"
    ));
    let straight = |far: f64| f64::sqrt(far * far - radius * radius);
    for step in 0..=20 {
        let angle = 7.0 * f64::from(step);
        let row = sample(&rig, angle);
        // Behind the elbow: the tangents stay, the arc grows with the flexion.
        let arc = angle.to_radians() + PI - (radius / 300.0_f64).acos() - (radius / 100.0_f64).acos();
        let length = straight(300.0) + straight(100.0) + radius * arc;
        assert!((row.solved.path_length - length).abs() < 1e-9, "{} {length} at {angle}°", row.solved.path_length);
        assert!((row.moment_arm.unwrap() + radius).abs() < 1e-9, "{:?}", row.moment_arm);
    }
}

#[test]
fn a_helix_is_straight_on_the_unrolled_cylinder() {
    let keys = "origin: {bone: upper arm, offset: [0, -30, -25]}, insertion: {bone: forearm, offset: [0, -100, 40]}, wraps: [{shape: cylinder, bone: upper arm, offset: [0, -330, 0], radius: 20, length: 200, side: -x}]";
    let rig = on_arm(keys);
    for angle in [0.0, 33.0, 90.0, 140.0] {
        let arc = f64::to_radians(angle) + PI - (20.0 / 300.0_f64).acos() - (20.0 / 100.0_f64).acos();
        let flat = f64::sqrt(300.0 * 300.0 - 400.0) + f64::sqrt(100.0 * 100.0 - 400.0) + 20.0 * arc;
        assert!((sample(&rig, angle).solved.path_length - flat.hypot(65.0)).abs() < 1e-9, "{angle}°");
        assert_slope(&rig, angle);
    }
}

#[test]
fn a_quarter_of_an_ellipse_is_ramanujans_series() {
    // The path leaves the ellipsoid where its axes end, because both ends lie on the tangents there: a quarter of the ellipse in the plane z = 0.
    let (a, b) = (30.0_f64, 18.0_f64);
    let keys = format!(
        "origin: {{bone: upper arm, offset: [{a:?}, -30, 0]}}, insertion: {{bone: upper arm, offset: [-200, {:?}, 0]}}, \
         wraps: [{{shape: ellipsoid, bone: upper arm, offset: [0, -330, 0], radii: [{a:?}, {b:?}, 50], side: +x, between: [0, 1]}}]",
        -330.0 - b
    );
    let rig = on_arm(&keys);
    let h = ((a - b) / (a + b)).powi(2);
    // π(a + b) Σ C(½, n)² hⁿ
    let (mut sum, mut binomial) = (0.0, 1.0);
    for n in 0..60 {
        sum += binomial * binomial * h.powi(n);
        binomial *= (0.5 - f64::from(n)) / f64::from(n + 1);
    }
    let exact = 0.25 * PI * (a + b) * sum + 300.0 + 200.0;
    let length = sample(&rig, 0.0).solved.path_length;
    assert!((length - exact).abs() < 1e-6, "{length} {exact}");
}

#[test]
fn through_a_torus_the_path_follows_a_meridian() {
    // The tube's inner side, seen in the plane of the path: a circle of radius 6 whose centre lies 20 off the axis.
    let keys = "origin: {bone: upper arm, offset: [-40, -230, 0]}, insertion: {bone: upper arm, offset: [-40, -430, 0]}, \
                wraps: [{shape: torus, bone: upper arm, offset: [0, -330, 0], rotation: [90, 0, 0], radius: 20, tube: 6}]";
    let length = sample(&on_arm(keys), 0.0).solved.path_length;
    let far = f64::hypot(100.0, 20.0);
    let tangent = f64::sqrt(far * far - 36.0);
    // From the tube's middle, the ends lie outside; the path passes on the inner side.
    let arc = 2.0 * (FRAC_PI_2 + (20.0_f64 / 100.0).atan() - (6.0 / far).acos());
    let exact = 2.0 * tangent + 6.0 * arc;
    assert!((length - exact).abs() < 1e-9, "{length} {exact}");
}

#[test]
fn of_an_ellipsoid_and_two_wraps_the_moment_arm_is_the_slope() {
    let keys = "origin: {bone: upper arm, offset: [10, -30, 12]}, insertion: {bone: forearm, offset: [12, -100, -9]}, wraps: [\
                {shape: ellipsoid, bone: upper arm, offset: [4, -200, 3], rotation: [10, 20, 30], radii: [22, 40, 18], side: +x}, \
                {shape: cylinder, bone: forearm, offset: [2, 0, 0], rotation: [4, -8, 0], radius: 24, length: 100, side: +x}]";
    let rig = on_arm(keys);
    let mut before: Option<MuscleSample> = None;
    for step in 0..=600 {
        let angle = 0.25 * f64::from(step);
        let row = sample(&rig, angle);
        if let Some(before) = before {
            let mean = 0.5 * (row.moment_arm.unwrap() + before.moment_arm.unwrap());
            let missed = row.solved.path_length - before.solved.path_length + mean * 0.25_f64.to_radians();
            assert!(missed.abs() < 1e-3, "{missed} at {angle}°");
        }
        before = Some(row);
        if step % 40 == 0 {
            assert_slope(&rig, angle);
        }
    }
}

#[test]
fn a_via_point_is_passed_in_its_range_alone() {
    let with = |more: &str| on_arm(&format!("{ENDS}, via: [{{bone: upper arm, offset: [40, -200, 0]{more}}}]"));
    let (always, never, some) = (with(""), on_arm(ENDS), with(", active: {joint: elbow, range: [30, 90]}"));
    for (angle, reference) in
        [(0.0, &never), (29.9, &never), (30.0, &always), (60.0, &always), (90.0, &always), (90.1, &never), (140.0, &never)]
    {
        let (row, expected) = (sample(&some, angle), sample(reference, angle));
        assert_eq!((row.solved.path_length, row.moment_arm), (expected.solved.path_length, expected.moment_arm), "{angle}°");
    }
    assert!(some.findings().iter().any(|found| found.code() == "muscle-path-jumps"));
}

#[test]
fn a_via_point_moves_with_the_angle_and_the_moment_arm_knows() {
    let rig = on_arm(&format!(
        "{ENDS}, via: [{{bone: upper arm, moves: {{joint: elbow, angles: [0, 40, 100], offsets: [[20, -250, 0], [34, -260, 5], [25, -240, 0]]}}}}]"
    ));
    for (angle, at) in [(0.0, DVec3::new(20.0, -250.0, 0.0)), (40.0, DVec3::new(34.0, -260.0, 5.0)), (100.0, DVec3::new(25.0, -240.0, 0.0))]
    {
        let (sin, cos) = f64::to_radians(angle).sin_cos();
        let end = DVec3::new(100.0 * sin, -330.0 - 100.0 * cos, 0.0);
        let length = at.distance(DVec3::new(0.0, -30.0, 0.0)) + at.distance(end);
        assert!((sample(&rig, angle).solved.path_length - length).abs() < 1e-9, "{angle}°");
    }
    for angle in [5.0, 40.0, 71.0, 120.0] {
        assert_slope(&rig, angle);
    }
}

/// Three bones in a row under a node with any matrix at all, each joint about an axis of its own.
struct Chain {
    scene: Scene,
    joints: [NodeId; 2],
}

impl Chain {
    fn new(above: DMat4, scales: [DVec3; 3]) -> Self {
        let mut scene = Scene::default();
        let root = scene.graph.add(None, Node::new("above").with_transform(Transform::from_matrix(above)));
        let long = DVec3::NEG_Y * 300.0;
        let mut bone = |parent, name: &str, at: DVec3, scale: DVec3| {
            let transform = Transform { ops: vec![TransformOp::Translate(at), TransformOp::Scale(scale)] };
            scene.graph.add(Some(parent), Node::new(name).with_kind(NodeKind::Joint).with_transform(transform))
        };
        let a = bone(root, "a", DVec3::ZERO, scales[0]);
        let b = bone(a, "b", long, scales[1]);
        let c = bone(b, "c", long, scales[2]);
        Self { scene, joints: [b, c] }
    }

    /// The world with both joints turned.
    fn world(&self, rig: &MuscleRig, angles: [f64; 2]) -> Vec<DMat4> {
        let (mut local, mut world) = (self.scene.graph.rest_locals(), Vec::new());
        for ((_, joint), angle) in rig.joints().zip(angles) {
            let matrix = &mut local[joint.node.index()];
            *matrix = joint.absolute(angle).apply(*matrix, *matrix);
        }
        self.scene.graph.world_from_local(&local, &mut world);
        world
    }
}

const BIARTICULAR: &str = "unit: m
joints:
  - {name: near, bone: b, axis: [0.1, 0, 1], range: [-40, 120]}
  - {name: far, bone: c, axis: [0, 0.2, 1], range: [-60, 100]}
muscles:
  - length: 500
    radii: [4, 12, 4]
    growth: [0, 1, 0]
    origin: {bone: a, offset: [12, -40, 5]}
    insertion: {bone: c, offset: [10, -60, -4]}
    via:
      - {bone: b, offset: [26, -150, 3], active: {joint: near, range: [-40, 200]}}
      - {bone: b, moves: {joint: far, angles: [-60, 0, 100], offsets: [[20, -240, 0], [24, -250, 2], [30, -255, 0]]}}
    wraps:
      - {shape: cylinder, bone: a, offset: [0, -300, 0], rotation: [3, 5, 0], radius: 16, length: 120, side: +x, between: [0, 1]}
      - {shape: ellipsoid, bone: b, offset: [0, -300, 0], rotation: [0, 0, 8], radii: [15, 19, 24], side: +x, between: [2, 3]}
";

fn rigs() -> impl Strategy<Value = (DMat4, [DVec3; 3], [f64; 2])> {
    let factor = || (prop_oneof![Just(-1.0), Just(1.0)], 0.6..1.6_f64).prop_map(|(sign, size)| sign * size);
    let spread = |most: f64| (-most..most, -most..most, -most..most).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    let above = (factor(), factor(), factor(), spread(0.25), spread(3.0)).prop_map(|(x, y, z, shear, turn)| {
        let skewed = DMat3::from_cols(DVec3::new(x, shear.x, 0.0), DVec3::new(0.0, y, shear.y), DVec3::new(shear.z, 0.0, z));
        DMat4::from_mat3(DMat3::from_quat(DQuat::from_scaled_axis(turn)) * skewed)
    });
    let own = || (0.7..1.4_f64, 0.7..1.4_f64, 0.7..1.4_f64).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    (above, [own(), own(), own()], [-30.0..110.0_f64, -50.0..90.0_f64])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    /// About each of two joints, on mirrored, sheared and scaled rigs, in any pose: what the pose tells is the slope of what is drawn.
    #[test]
    fn a_muscle_over_two_joints_has_a_moment_arm_about_each((above, scales, angles) in rigs(), scaled in any::<bool>()) {
        let mut chain = Chain::new(above, scales);
        let yaml = if scaled { BIARTICULAR.replace("unit: m\n", "unit: m\nscale: with bones\n") } else { BIARTICULAR.to_owned() };
        let mut rig = MuscleRig::build(&MuscleFile::parse(&yaml).unwrap(), "m", &mut chain.scene, MuscleId(0));
        let found: Vec<_> = rig.attach(&chain.scene).into_iter().filter(|found| found.code().contains("not-found")).collect();
        prop_assert!(found.is_empty(), "{found:?}");
        let joints: Vec<_> = rig.joints().map(|(name, joint)| (name.to_owned(), joint)).collect();
        prop_assert_eq!(joints.iter().map(|(name, joint)| (name.as_str(), joint.node)).collect::<Vec<_>>(), [("near", chain.joints[0]), ("far", chain.joints[1])]);
        let world = chain.world(&rig, angles);
        let length = |angles: [f64; 2]| rig.solve(0, rig.at_flexion(0.0), &chain.world(&rig, angles)).path_length;
        const H: f64 = 1e-5;
        for (number, (_, joint)) in joints.iter().enumerate() {
            let arm = rig.moment_arm_about(0, joint, &chain.scene, &world).unwrap();
            let moved = |by: f64| { let mut angles = angles; angles[number] += by.to_degrees(); length(angles) };
            let slope = (moved(-H) - moved(H)) / (2.0 * H);
            prop_assert!((slope - arm).abs() < 2e-3 + 1e-5 * arm.abs(), "joint {number}: {slope} {arm}");
        }
        // What is drawn is as long as what is measured.
        let solved = rig.solve(0, rig.at_flexion(0.0), &world);
        prop_assert!((solved.centerline().length() / solved.path_length - 1.0).abs() < 1e-9);
    }

    /// Sweeping one joint while the other is at rest tells the same as poses do.
    #[test]
    fn a_sweep_of_one_joint_measures_the_moment_arms_about_all((above, scales, angles) in rigs()) {
        let mut chain = Chain::new(above, scales);
        let mut rig = MuscleRig::build(&MuscleFile::parse(BIARTICULAR).unwrap(), "m", &mut chain.scene, MuscleId(0));
        rig.attach(&chain.scene);
        let joints: Vec<_> = rig.joints().map(|(_, joint)| joint).collect();
        for (swept, angle) in angles.into_iter().enumerate() {
            let row = rig.measure_over(0, swept, &[angle]).remove(0);
            let mut pose = [0.0; 2];
            pose[swept] = angle;
            let world = chain.world(&rig, pose);
            let posed = rig.solve(0, rig.at_flexion(0.0), &world).path_length;
            prop_assert!((row.solved.path_length / posed - 1.0).abs() < 1e-9, "{} {posed}", row.solved.path_length);
            prop_assert_eq!(row.moment_arms.len(), 2);
            prop_assert_eq!(row.moment_arm, Some(row.moment_arms[swept]));
            for (joint, arm) in joints.iter().zip(&row.moment_arms) {
                let posed = rig.moment_arm_about(0, joint, &chain.scene, &world).unwrap();
                prop_assert!((posed - arm).abs() < 1e-6 * (1.0 + posed.abs()), "{posed} {arm}");
            }
        }
    }

}

proptest! {
    // Surfaces on which the path has a choice of ways take their time.
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    /// Whatever surfaces, wherever they are: a length, a line as long as that, a surface of numbers, the volume kept.
    #[test]
    fn any_wraps_have_an_answer(
        wraps in prop::collection::vec((0..4_usize, prop::array::uniform3(1.0..80.0_f64), prop::array::uniform3(-120.0..120.0_f64), prop::array::uniform3(-180.0..180.0_f64), 0..8_usize, 0..3_usize, any::<bool>()), 0..5),
        via in prop::collection::vec((prop::array::uniform3(-60.0..60.0_f64), any::<bool>(), prop::option::of(0.0..90.0_f64)), 0..4),
        angle in 0.0..150.0_f64,
    ) {
        let sides = ["+x", "-x", "+y", "-y", "+z", "-z", "[0.3, 1, -0.2]"];
        let bone = |upper: bool| if upper { "upper arm" } else { "forearm" };
        let shape = |(shape, sizes, at, rotation, side, between, upper): &(usize, [f64; 3], [f64; 3], [f64; 3], usize, usize, bool)| {
            let [a, b, c] = sizes;
            let what = match shape {
                0 => format!("shape: sphere, radius: {a:?}"),
                1 => format!("shape: cylinder, radius: {a:?}, length: {b:?}"),
                2 => format!("shape: ellipsoid, radii: [{a:?}, {b:?}, {c:?}]"),
                _ => format!("shape: torus, radius: {:?}, tube: {:?}", a.max(*b) + 0.5, a.min(*b)),
            };
            // A cylinder has no side along its axis, a torus none at all.
            let side = match (shape, sides.get(*side)) {
                (3, _) | (_, None) => String::new(),
                (1, Some(side)) if side.contains('z') => String::new(),
                (_, Some(side)) => format!(", side: {side}"),
            };
            let between = ["", ", between: joint", ", between: [0, 1]"][*between];
            format!("{{{what}, bone: {}, offset: [{:?}, {:?}, {:?}], rotation: {rotation:?}{side}{between}}}", bone(*upper), at[0], at[1] - 200.0, at[2])
        };
        let point = |(at, upper, from): &([f64; 3], bool, Option<f64>)| {
            let active = from.map_or_else(String::new, |from| format!(", active: {{joint: elbow, range: [{from:?}, {:?}]}}", from + 30.0));
            format!("{{bone: {}, offset: [{:?}, {:?}, {:?}]{active}}}", bone(*upper), at[0], at[1] - 150.0, at[2])
        };
        let file = file_on_arm(&format!(
            "origin: {{bone: upper arm, offset: [12, -30, 0]}}, insertion: {{bone: forearm, offset: [8, -47, 3]}}, via: [{}], wraps: [{}]",
            via.iter().map(point).collect::<Vec<_>>().join(", "),
            wraps.iter().map(shape).collect::<Vec<_>>().join(", ")
        ));
        let mut scene = Scene::default();
        let rig = MuscleRig::build(&file, "m", &mut scene, MuscleId(0));
        let row = sample(&rig, angle);
        prop_assert!(row.solved.path_length.is_finite() && row.solved.path_length > 0.0, "{row:?}");
        prop_assert!(row.moment_arm.unwrap().is_finite() && row.solved.volume_error.abs() < 1e-12, "{row:?}");
        let mut pose = Pose::rest(&scene);
        rig.apply(rig.at_flexion(angle), &mut pose);
        let (mut local, mut world) = (Vec::new(), Vec::new());
        pose.locals(&mut local);
        scene.graph.world_from_local(&local, &mut world);
        let solved = rig.solve(0, rig.at_flexion(angle), &world);
        prop_assert!((solved.centerline().length() / solved.path_length - 1.0).abs() < 1e-6 || rig.findings().iter().any(|found| found.code() == "muscle-path-not-found"));
        let (mut positions, mut normals) = (Vec::new(), Vec::new());
        rig.deform(0, &solved, &world, &mut positions, &mut normals);
        prop_assert!(!positions.is_empty() && positions.iter().all(|position| position.is_finite()));
    }
}
