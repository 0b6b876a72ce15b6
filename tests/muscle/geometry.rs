//! Muscles in a scene: the arm against the law of cosines, the sliders, the drawn surface against the volume it stands for.

use std::f64::consts::PI;

use glam::{DMat4, DVec3, Vec3};
use sinew::animation::Pose;
use sinew::muscle::{Arm, MuscleFile, MuscleRig, SolvedMuscle};
use sinew::scene::{Mesh, MuscleId, NodeKind, Scene};

const BICEPS: &str = include_str!("../../configs/biceps.yaml");
const MEASURED: &str = include_str!("../../configs/biceps-measured.yaml");
const HUMAN: &str = include_str!("../../configs/biceps-human.yaml");
const WRAPPED: &str = include_str!("../../configs/biceps-human-wrapped.yaml");
const EXAMPLE: &str = include_str!("../../configs/example.yaml");
const ALL: [&str; 5] = [BICEPS, MEASURED, HUMAN, WRAPPED, EXAMPLE];

struct Stage {
    scene: Scene,
    rig: MuscleRig,
}

impl Stage {
    fn new(yaml: &str) -> Self {
        let mut scene = Scene::default();
        let rig = MuscleRig::build(&MuscleFile::parse(yaml).unwrap(), "stage", &mut scene, MuscleId(0));
        Self { scene, rig }
    }

    fn world(&self, angle: f64) -> Vec<DMat4> {
        let mut pose = Pose::rest(&self.scene);
        self.rig.apply(self.rig.at_flexion(angle), &mut pose);
        let (mut local, mut world) = (Vec::new(), Vec::new());
        pose.locals(&mut local);
        self.scene.graph.world_from_local(&local, &mut world);
        world
    }

    fn solved(&self, index: usize, angle: f64) -> SolvedMuscle {
        self.rig.solve(index, self.rig.at_flexion(angle), &self.world(angle))
    }

    fn surface(&self, index: usize, angle: f64) -> (SolvedMuscle, Vec<Vec3>, Vec<Vec3>) {
        let (world, solved) = (self.world(angle), self.solved(index, angle));
        let (mut positions, mut normals) = (Vec::new(), Vec::new());
        self.rig.deform(index, &solved, &world, &mut positions, &mut normals);
        (solved, positions, normals)
    }

    fn angles(&self) -> impl Iterator<Item = f64> + use<> {
        let range = self.rig.flexion_range().unwrap();
        (0..=12).map(move |i| range.start() + (range.end() - range.start()) * f64::from(i) / 12.0)
    }
}

/// Volume that a part of a mesh encloses, by the divergence theorem.
fn enclosed(mesh: &Mesh, part: usize, positions: &[Vec3]) -> f64 {
    let range = &mesh.parts[part].triangles;
    let triangles = &mesh.triangles[range.start as usize..range.end as usize];
    let corner = |v: u32| positions[v as usize].as_dvec3();
    triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0).sum()
}

fn distance(point: DVec3, from: DVec3, to: DVec3) -> f64 {
    let along = to - from;
    point.distance(from + along * ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0))
}

#[test]
fn length_and_moment_arm_follow_the_law_of_cosines() {
    let (p, d) = (230.0, 30.0);
    let stage = Stage::new(BICEPS);
    let angles: Vec<f64> = (0..=36).map(|i| f64::from(i) * 5.0).collect();
    let range = stage.rig.flexion_range().unwrap();
    assert!(*range.start() == 0.0 && (120.0..=150.0).contains(range.end()));
    for sample in stage.rig.measure(0, &angles) {
        let (sin, cos) = sample.angle.unwrap().to_radians().sin_cos();
        let length = f64::sqrt(p * p + d * d + 2.0 * p * d * cos);
        assert!((sample.solved.length - length).abs() < 1e-10, "length at {}°", sample.angle.unwrap());
        assert!((sample.moment_arm.unwrap() - p * d * sin / length).abs() < 1e-10, "moment arm at {}°", sample.angle.unwrap());
        // The posed nodes say the same as the formula.
        if range.contains(&sample.angle.unwrap()) {
            assert!((stage.solved(0, sample.angle.unwrap()).length - length).abs() < 1e-9);
        }
        assert!(sample.solved.volume_error.abs() < 1e-12);
    }
}

#[test]
fn moment_arms_are_the_slope_of_the_length_also_round_a_wrap() {
    for yaml in ALL {
        let stage = Stage::new(yaml);
        for index in 0..stage.rig.len() {
            for angle in [7.0, 33.0, 61.0, 95.0, 118.0] {
                const H: f64 = 1e-4;
                let rows = stage.rig.measure(index, &[angle - H, angle, angle + H]);
                let slope = -(rows[2].solved.path_length - rows[0].solved.path_length) / (2.0 * H).to_radians();
                assert!((rows[1].moment_arm.unwrap() - slope).abs() < 1e-4, "{} at {angle}°", stage.rig.label(index).plain());
            }
        }
    }
}

#[test]
fn round_a_wrap_the_length_is_tangents_and_an_arc() {
    // p and d on the axes, radius R about the elbow: √(p² − R²) + √(d² − R²) + R (π − φ − acos(R / p) − acos(R / d)) until the arc is used up.
    let (p, d, r) = (300.0_f64, 49.0_f64, 14.0_f64);
    let stage = Stage::new(WRAPPED);
    for angle in [0.0, 5.0, 10.0, 15.0, 25.0, 60.0, 120.0] {
        let arc = PI - f64::to_radians(angle) - (r / p).acos() - (r / d).acos();
        let length = if arc > 0.0 {
            f64::sqrt(p * p - r * r) + f64::sqrt(d * d - r * r) + r * arc
        } else {
            f64::sqrt(p * p + d * d + 2.0 * p * d * f64::to_radians(angle).cos())
        };
        let sample = &stage.rig.measure(0, &[angle])[0];
        assert!((sample.solved.path_length - length).abs() < 1e-9, "{} is not {length} at {angle}°", sample.solved.path_length);
        if arc > 0.05 {
            assert!((sample.moment_arm.unwrap() - r).abs() < 1e-6, "on the wrap the moment arm is its radius");
        }
    }
}

#[test]
fn the_human_biceps_have_the_published_moment_arms() {
    // Arm26, as given with Murray, Buchanan and Delp 2000: centimetres at elbow angles.
    const ARM26: [(f64, f64); 6] = [(40.0, 3.16), (60.0, 4.05), (80.0, 4.69), (90.0, 4.88), (100.0, 4.94), (130.0, 4.03)];
    for (yaml, least_at_straight) in [(HUMAN, 0.0), (WRAPPED, 1.0)] {
        let stage = Stage::new(yaml);
        let sweep: Vec<f64> = (0..=130).map(f64::from).collect();
        let rows = stage.rig.measure(0, &sweep);
        let peak = rows.iter().max_by(|a, b| a.moment_arm.unwrap().total_cmp(&b.moment_arm.unwrap())).unwrap();
        assert!((45.0..=50.0).contains(&peak.moment_arm.unwrap()), "peak {}", peak.moment_arm.unwrap());
        assert!((85.0..=110.0).contains(&peak.angle.unwrap()), "peak at {}°", peak.angle.unwrap());
        let shortening = rows[0].solved.length - rows[130].solved.length;
        assert!((70.0..=85.0).contains(&shortening), "shortens by {shortening}");
        let cubic_centimetres = rows[0].solved.volume / 1000.0;
        assert!((130.0..=160.0).contains(&cubic_centimetres), "{cubic_centimetres} cm³");
        let squares: f64 = ARM26.iter().map(|(angle, cm)| (rows[*angle as usize].moment_arm.unwrap() / 10.0 - cm).powi(2)).sum();
        let rms = (squares / ARM26.len() as f64).sqrt();
        assert!(rms < 0.5, "RMS to Arm26 is {rms} cm");
        let straight = rows[0].moment_arm.unwrap() / 10.0;
        assert!((least_at_straight - 1e-9..=2.0).contains(&straight), "{straight} cm on the straight arm");
    }
}

#[test]
fn the_sliders_are_each_others_inverse() {
    for yaml in ALL {
        let stage = Stage::new(yaml);
        let rig = &stage.rig;
        let range = rig.flexion_range().unwrap();
        let mut last = f64::NEG_INFINITY;
        for step in 0..=200 {
            let angle = range.start() + (range.end() - range.start()) * f64::from(step) / 200.0;
            let drive = rig.at_flexion(angle);
            assert!(drive.contraction > last, "contraction rises with flexion");
            last = drive.contraction;
            let back = rig.at_contraction(drive.contraction);
            // Where the length hardly changes with the angle, the angle is known to the square root of rounding only.
            assert!((back.flexion - angle).abs() < 1e-5, "{angle}° came back as {}°", back.flexion);
            assert!((rig.at_flexion(back.flexion).contraction - drive.contraction).abs() < 1e-9);
        }
        assert_eq!(rig.at_contraction(0.0).flexion, *range.start());
        assert_eq!(rig.at_contraction(100.0).flexion, *range.end());
        assert_eq!(rig.at_flexion(-1e9).contraction, 0.0);
        assert_eq!(rig.at_flexion(1e9).contraction, 100.0);
        for nonsense in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(range.contains(&rig.at_flexion(nonsense).flexion) && range.contains(&rig.at_contraction(nonsense).flexion));
        }
    }
}

#[test]
fn the_drawn_volume_is_the_volume_of_the_ledger() {
    for yaml in ALL {
        let stage = Stage::new(yaml);
        for index in 0..stage.rig.len() {
            for angle in stage.angles() {
                let (solved, positions, _) = stage.surface(index, angle);
                let caps: f64 = [solved.radii.first(), solved.radii.last()].map(|r| 2.0 / 3.0 * PI * r.unwrap().powi(3)).iter().sum();
                let expected = (solved.volume + caps) * 1e-9;
                let drawn = enclosed(&stage.rig.mesh(index), 0, &positions);
                // A 36-sided prism holds sin(10°) / 10° of its cylinder: half a per cent less; the bend between rings costs a little more.
                let polygon = (PI / 18.0).sin() / (PI / 18.0);
                assert!(
                    (drawn / (expected * polygon) - 1.0).abs() < 3e-3,
                    "{} at {angle}°: {drawn} is not {expected}",
                    stage.rig.label(index).plain()
                );
            }
        }
    }
}

#[test]
fn round_a_bent_line_the_volume_is_that_round_a_straight_one() {
    // Pappus, by numbers: fine slices perpendicular to the drawn line, each the area π r² times its own thickness at the centroid.
    let stage = Stage::new(BICEPS);
    let solved = stage.solved(0, 100.0);
    let path = solved.centerline();
    assert!((path.length() - solved.path_length).abs() < 1e-9, "the drawn line is as long as the line of action");
    const STEPS: usize = 20_000;
    let (mut walked, mut volume) = (0.0, 0.0);
    let mut before = path.frame_at(0.0);
    for step in 1..=STEPS {
        let at = path.length() * step as f64 / STEPS as f64;
        let here = path.frame_at(at);
        assert!(here.tangent.is_normalized() && here.u.is_normalized());
        assert!(here.u.dot(here.tangent).abs() < 1e-9 && here.v.dot(here.u).abs() < 1e-9);
        let chord = here.position.distance(before.position);
        let place = (at / path.length() * (solved.radii.len() - 1) as f64).min(solved.radii.len() as f64 - 1.000_001);
        let node = place as usize;
        let radius = solved.radii[node] + (solved.radii[node + 1] - solved.radii[node]) * (place - node as f64);
        assert!(radius * here.curvature < 1.0, "bent tighter than it is thick");
        walked += chord;
        volume += PI * radius * radius * chord;
        before = here;
    }
    assert!((walked / path.length() - 1.0).abs() < 1e-6);
    assert!((volume / solved.volume - 1.0).abs() < 1e-3);
}

#[test]
fn normals_are_unit_vectors_that_point_outward() {
    for yaml in ALL {
        let stage = Stage::new(yaml);
        for index in 0..stage.rig.len() {
            let mesh = stage.rig.mesh(index);
            let (_, positions, normals) = stage.surface(index, 70.0);
            assert_eq!(positions.len(), mesh.positions.len());
            assert_eq!(mesh.uv_sets[0].len(), positions.len());
            assert!(normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-4));
            let agree = mesh.triangles.iter().filter(|&&[a, b, c]| {
                let [p, q, r] = [a, b, c].map(|v| positions[v as usize]);
                (q - p).cross(r - p).dot(normals[a as usize] + normals[b as usize] + normals[c as usize]) > 0.0
            });
            assert_eq!(agree.count(), mesh.triangles.len(), "a triangle is turned inside out");
        }
    }
}

#[test]
fn the_surface_is_closed() {
    let stage = Stage::new(HUMAN);
    let mesh = stage.rig.mesh(0);
    let (_, positions, _) = stage.surface(0, 90.0);
    // Seam and poles stand more than once: weld by position, then every edge has its opposite.
    let key = |v: u32| positions[v as usize].to_array().map(f32::to_bits);
    let mut edges = std::collections::HashMap::new();
    for part in &mesh.parts {
        for triangle in &mesh.triangles[part.triangles.start as usize..part.triangles.end as usize] {
            for side in 0..3 {
                let (a, b) = (key(triangle[side]), key(triangle[(side + 1) % 3]));
                *edges.entry((a.min(b), a.max(b))).or_insert(0_i32) += if a < b { 1 } else { -1 };
            }
        }
    }
    assert!(edges.values().all(|count| *count == 0), "an edge has no opposite");
}

#[test]
fn the_belly_keeps_off_the_rods_and_its_ends_touch_them() {
    for yaml in ALL {
        let file = MuscleFile::parse(yaml).unwrap();
        let Arm { upper, lower, thickness, .. } = file.arm.unwrap();
        let stage = Stage::new(yaml);
        // Only the muscle that decides the range; the triceps of the example is thin enough to be looked at instead.
        let tendons = file.muscles[0].tendons;
        for angle in stage.angles() {
            let (solved, positions, _) = stage.surface(0, angle);
            let turn = angle.to_radians();
            let (shoulder, elbow) = (DVec3::Y * (upper + lower), DVec3::Y * lower);
            let wrist = elbow + DVec3::new(turn.sin(), -turn.cos(), 0.0) * lower;
            let path = solved.centerline();
            for (at, end) in [(0.0, 0), (path.length(), 1)] {
                let centre = path.frame_at(at).position;
                let rod = if end == 0 { distance(centre, shoulder, elbow) } else { distance(centre, elbow, wrist) };
                let belly = if end == 0 { solved.radii.first() } else { solved.radii.last() };
                let radius = if tendons[end].length > 0.0 { tendons[end].radius } else { *belly.unwrap() };
                assert!((rod - thickness - radius).abs() < 1e-9, "end {end} is {rod} from the rod's axis at {angle}°");
            }
            let mesh = stage.rig.mesh(0);
            let belly = &mesh.triangles[mesh.parts[0].triangles.start as usize..mesh.parts[0].triangles.end as usize];
            let deepest = belly
                .iter()
                .flatten()
                .map(|v| positions[*v as usize].as_dvec3() * 1000.0)
                .map(|point| distance(point, shoulder, elbow).min(distance(point, elbow, wrist)) - thickness)
                .fold(f64::INFINITY, f64::min);
            // The hemispheres touch the rods, and the polygons of the rings lie inside their circles.
            assert!(deepest > -0.6, "{deepest} mm inside a rod at {angle}° of {:?}: {}", stage.rig.flexion_range(), &yaml[..60]);
        }
    }
}

#[test]
fn the_arm_is_a_skeleton_of_ordinary_nodes() {
    let stage = Stage::new(MEASURED);
    let graph = &stage.scene.graph;
    let root = stage.rig.root.unwrap();
    assert_eq!(graph.node(root).kind, NodeKind::Asset);
    let joints: Vec<&str> = graph.iter().filter(|(_, node)| node.kind == NodeKind::Joint).map(|(_, node)| node.id.as_str()).collect();
    assert_eq!(joints, ["upper arm", "elbow", "wrist"]);
    let world = stage.world(90.0);
    let place = |id: &str| {
        let (node, _) = graph.iter().find(|(_, node)| node.id == id).unwrap();
        world[node.index()].w_axis.truncate()
    };
    // Metres, +Y up, the forearm bent towards +X.
    assert!((place("upper arm") - DVec3::new(0.0, 0.4, 0.0)).length() < 1e-12);
    assert!((place("elbow") - DVec3::new(0.0, 0.15, 0.0)).length() < 1e-12);
    assert!((place("wrist") - DVec3::new(0.15, 0.15, 0.0)).length() < 1e-12);
}

#[test]
fn moving_and_scaling_the_model_changes_no_measure() {
    let stage = Stage::new(BICEPS);
    let world = stage.world(60.0);
    let plain = stage.rig.solve(0, stage.rig.at_flexion(60.0), &world);
    let model = DMat4::from_scale_rotation_translation(DVec3::splat(3.0), glam::DQuat::from_rotation_x(1.0), DVec3::new(5.0, -2.0, 1.0));
    let moved: Vec<DMat4> = world.iter().map(|matrix| model * *matrix).collect();
    let after = stage.rig.solve(0, stage.rig.at_flexion(60.0), &moved);
    assert!((after.length - plain.length).abs() < 1e-9);
    let (mut a, mut b, mut normals) = (Vec::new(), Vec::new(), Vec::new());
    stage.rig.deform(0, &plain, &world, &mut a, &mut normals);
    stage.rig.deform(0, &after, &moved, &mut b, &mut normals);
    for (a, b) in a.iter().zip(&b) {
        assert!((model.transform_point3(a.as_dvec3()) - b.as_dvec3()).length() < 1e-5);
    }
    // A model flattened to nothing draws something finite or nothing, and does not panic.
    let flat: Vec<DMat4> = world.iter().map(|matrix| DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0)) * *matrix).collect();
    let solved = stage.rig.solve(0, stage.rig.at_flexion(60.0), &flat);
    stage.rig.deform(0, &solved, &flat, &mut b, &mut normals);
    stage.rig.deform(0, &solved, &[], &mut b, &mut normals);
    stage.rig.deform(0, &SolvedMuscle::default(), &world, &mut b, &mut normals);
    stage.rig.deform(99, &solved, &world, &mut b, &mut normals);
}

#[test]
fn without_an_arm_contraction_runs_the_length() {
    let yaml = "muscle_config:\n  radiuses: [2.0, 5.0, 2.0]\n  grow_mults: [1.0, 2.0, 1.0]\n  len: 100.0\n";
    let stage = Stage::new(yaml);
    let rig = &stage.rig;
    assert_eq!(rig.flexion_range(), None);
    let world = stage.world(0.0);
    let valid = rig.profile(0).unwrap().length_range();
    let long = rig.solve(0, rig.at_contraction(0.0), &world);
    assert!((long.length - 250.0_f64.min(*valid.end())).abs() < 1e-9);
    let short = rig.solve(0, rig.at_contraction(100.0), &world);
    assert!((short.length - 40.0_f64.max(*valid.start())).abs() < 1e-9);
    let rest = rig.solve(0, rig.at_flexion(0.0), &world);
    assert!((rest.length - 100.0).abs() < 1e-9 && rest.delta.abs() < 1e-9);
    for step in 0..=20 {
        let solved = rig.solve(0, rig.at_contraction(f64::from(step) * 5.0), &world);
        assert!(!solved.held && solved.volume_error.abs() < 1e-12);
    }
}

#[test]
fn the_human_biceps_keeps_to_the_published_figures() {
    use sinew::muscle::literature_data::{ARM26_BICEPS, ARM26_SHORTENING, BICEPS_PEAK, BICEPS_SHORTENING, BICEPS_VOLUME};
    for (name, text) in [
        ("straight", include_str!("../../configs/biceps-human.yaml")),
        ("wrapped", include_str!("../../configs/biceps-human-wrapped.yaml")),
    ] {
        let rig = MuscleRig::build(&MuscleFile::parse(text).unwrap(), name, &mut Scene::default(), MuscleId(0));
        let arm = |angle: f64| rig.measure(0, &[angle])[0].moment_arm.unwrap() / 10.0;
        let rms = ARM26_BICEPS.rms([30.0, 130.0], arm).unwrap();
        assert!(rms < 0.5, "{name}: {rms} cm RMS from Arm26");
        let peak = (0..=1300).map(|step| f64::from(step) / 10.0).max_by(|a, b| arm(*a).total_cmp(&arm(*b))).unwrap();
        assert!((BICEPS_PEAK[0][0]..=BICEPS_PEAK[0][1]).contains(&arm(peak)), "{name}: peak {}", arm(peak));
        assert!((BICEPS_PEAK[1][0]..=BICEPS_PEAK[1][1]).contains(&peak), "{name}: peak at {peak}°");
        let length = |angle: f64| rig.measure(0, &[angle])[0].solved.path_length;
        let shorter = (length(0.0) - length(130.0)) / 10.0;
        assert!((BICEPS_SHORTENING[0]..=BICEPS_SHORTENING[1]).contains(&shorter), "{name}: {shorter} cm; Arm26 {ARM26_SHORTENING}");
        let cm3 = rig.measure(0, &[0.0])[0].solved.volume / 1000.0;
        assert!((BICEPS_VOLUME[0]..=BICEPS_VOLUME[1]).contains(&cm3), "{name}: {cm3} cm³");
        assert!(rig.spec(0).unwrap().source.contains("Holzbaur"));
        if name == "wrapped" {
            assert!((1.0..=2.0).contains(&arm(0.0)), "the straight arm's moment arm is {} cm", arm(0.0));
        }
    }
}

#[test]
fn ready_muscles_have_the_published_volumes_and_say_so() {
    use sinew::muscle::{literature_data::VOLUMES, presets::Preset};
    for (id, [mean, deviation]) in VOLUMES {
        let file = Preset::by_id(id).unwrap().file();
        let muscle = &file.muscles[0];
        let cm3 = muscle.profile.volume() / 1000.0;
        assert!((cm3 / mean - 1.0).abs() < 0.1, "{id}: {cm3} cm³ beside {mean}");
        let says = format!("Volume {cm3:.0} cm³; mean of ten adults {mean} (SD {deviation}) cm³: Holzbaur");
        assert!(muscle.source.starts_with(&says), "{} does not begin with “{says}”", muscle.source);
    }
}
