//! The volume round any line: random arms, poses, via points and wraps. The ledger keeps it to rounding, and what is drawn converges to π∫r²ds.

use std::f64::consts::{PI, TAU};

use glam::{DMat4, DVec3};
use proptest::prelude::*;
use sinew::animation::Pose;
use sinew::muscle::{Centerline, MuscleFile, MuscleRig, Solved};
use sinew::scene::{MuscleId, Scene};

/// Corners of a ring of the test's own surface.
const CORNERS: usize = 24;

#[derive(Debug, Clone)]
struct Case {
    yaml: String,
    angle: f64,
}

fn cases() -> impl Strategy<Value = Case> {
    let offset = |reach: f64| (15.0..70.0_f64, -reach..-5.0, -40.0..40.0_f64);
    let via = prop_oneof![offset(280.0).prop_map(|at| ("upper arm", at)), offset(60.0).prop_map(|at| ("forearm", at)),];
    let wrap = prop::option::of((12.0..45.0_f64, -1.0..1.0_f64, any::<bool>()));
    let radii = prop::collection::vec((1.0..11.0_f64, 0.0..2.0_f64), 3..9);
    (prop::collection::vec(via, 0..5), wrap, radii, 0.0..140.0_f64, (0.0..25.0_f64, 0.0..45.0_f64), any::<bool>()).prop_map(
        |(mut via, wrap, nodes, angle, tendons, twice)| {
            // The same point twice is no reason for anything to break.
            if let (true, Some(first)) = (twice, via.first().copied()) {
                via.insert(0, first);
            }
            let (radii, mut growth): (Vec<f64>, Vec<f64>) = nodes.into_iter().unzip();
            growth[1] += 0.5;
            let points: Vec<String> = via.iter().map(|(bone, (x, y, z))| format!("{{bone: {bone}, offset: [{x:?}, {y:?}, {z:?}]}}")).collect();
            let wrap = wrap.map_or_else(String::new, |(radius, z, back)| {
                let x = if back { -1.0 } else { 1.0 };
                format!("    wrap: {{bone: upper arm, offset: [0, -330, 0], radius: {radius:?}, side: [{x:?}, 0, {z:?}]}}\n")
            });
            let yaml = format!(
                "arm: {{upper: 330, forearm: 260, thickness: 8, flexion: [0, 150]}}\nmuscles:\n  - length: 240\n    radii: {radii:?}\n    \
                 growth: {growth:?}\n    origin: {{bone: upper arm, offset: [4, -30, 0]}}\n    insertion: {{bone: forearm, offset: [6, -47, 3]}}\n    \
                 via: [{}]\n{wrap}    tendons: {{origin: {{length: {:?}, radius: 3}}, insertion: {{length: {:?}, radius: 3}}}}\n",
                points.join(", "),
                tendons.0,
                tendons.1
            );
            Case { yaml, angle }
        },
    )
}

/// The muscle in its pose, and the line that it is drawn along.
fn posed(case: &Case) -> (MuscleFile, Solved, Centerline) {
    let file = MuscleFile::parse(&case.yaml).unwrap_or_else(|error| panic!("{error}\n{}", case.yaml));
    let mut scene = Scene::default();
    let rig = MuscleRig::build(&file, "arm", &mut scene, MuscleId(0));
    let (mut pose, mut local, mut world) = (Pose::rest(&scene), Vec::new(), Vec::<DMat4>::new());
    let drive = rig.at_flexion(case.angle);
    rig.apply(drive, &mut pose);
    pose.locals(&mut local);
    scene.graph.world_from_local(&local, &mut world);
    let solved = rig.solve(0, drive, &world);
    let path = solved.centerline();
    let path = path.clone();
    (file, solved.shape, path)
}

/// π∫r²ds of truncated cones, summed here and not by the library.
fn by_cones(radii: &[f64], length: f64) -> f64 {
    let spacing = length / (radii.len() - 1) as f64;
    radii.windows(2).map(|pair| PI * spacing * (pair[0] * pair[0] + pair[0] * pair[1] + pair[1] * pair[1]) / 3.0).sum()
}

/// Volume within a closed surface of `rings` rings perpendicular to the line, by the divergence theorem; and the greatest radius × curvature.
fn by_surface(path: &Centerline, solved: &Solved, start: f64, rings: usize) -> (f64, f64) {
    let (mut bend, mut before) = (0.0_f64, Vec::new());
    let mut volume = 0.0;
    let flat = |ring: &[DVec3], middle: DVec3, out: f64| -> f64 {
        (0..CORNERS).map(|corner| out * middle.dot(ring[corner].cross(ring[(corner + 1) % CORNERS])) / 6.0).sum()
    };
    for step in 0..=rings {
        let share = step as f64 / rings as f64;
        let place = share * (solved.radii.len() - 1) as f64;
        let node = (place as usize).min(solved.radii.len() - 2);
        let radius = solved.radii[node] + (solved.radii[node + 1] - solved.radii[node]) * (place - node as f64);
        let station = path.frame_at(start + share * solved.length);
        if step > 0 {
            bend = bend.max(radius * path.sharpest(start + (share - 1.0 / rings as f64) * solved.length, start + share * solved.length));
        }
        let corner = |corner: usize| {
            let (sin, cos) = (corner as f64 / CORNERS as f64 * TAU).sin_cos();
            station.position + (station.u * cos + station.v * sin) * radius
        };
        let ring: Vec<DVec3> = (0..CORNERS).map(corner).collect();
        if step == 0 {
            volume += flat(&ring, station.position, -1.0);
        } else {
            for corner in 0..CORNERS {
                let next = (corner + 1) % CORNERS;
                let (a, b, c, d): (DVec3, DVec3, DVec3, DVec3) = (before[corner], before[next], ring[corner], ring[next]);
                volume += (a.dot(b.cross(c)) + b.dot(d.cross(c))) / 6.0;
            }
        }
        if step == rings {
            volume += flat(&ring, station.position, 1.0);
        }
        before = ring;
    }
    (volume, bend)
}

/// Share of a circle that a polygon of [`CORNERS`] corners in it has.
fn polygon() -> f64 {
    (TAU / CORNERS as f64).sin() / (TAU / CORNERS as f64)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn volume_is_kept_along_any_line(case in cases()) {
        let (file, solved, path) = posed(&case);
        let profile = &file.muscles[0].profile;
        let rest = by_cones(profile.radii(), profile.rest_length());
        prop_assert!(solved.radii.iter().all(|radius| radius.is_finite() && *radius >= 0.0), "{solved:?}");
        prop_assert!((by_cones(&solved.radii, solved.length) / rest - 1.0).abs() < 1e-12, "{solved:?}");
        prop_assert!(solved.volume_error.abs() < 1e-12, "{}", solved.volume_error);
        // The line is one curve: no jump, no kink, as long as it says.
        const STEPS: usize = 1200;
        let mut before = path.frame_at(0.0);
        prop_assert!(path.length().is_finite() && path.length() > 0.0, "{}", case.yaml);
        let long = path.length() / STEPS as f64;
        for step in 1..=STEPS {
            let at = path.length() * step as f64 / STEPS as f64;
            let here = path.frame_at(at);
            prop_assert!(here.position.is_finite() && here.position.distance(before.position) <= long * (1.0 + 1e-9) + 1e-9, "{}", case.yaml);
            let turn = here.tangent.angle_between(before.tangent);
            prop_assert!(turn <= long * path.sharpest(at - long, at) + 1e-6, "a kink of {turn} at {step}\n{}", case.yaml);
            before = here;
        }
    }

    #[test]
    fn what_is_drawn_converges_to_the_volume(case in cases()) {
        let (file, solved, path) = posed(&case);
        let start = file.muscles[0].tendons[0].length;
        // Rings at all nodes, so that the cones themselves are met, and several in the sharpest arc.
        let spans = solved.radii.len() - 1;
        let turn = path.sharpest(start, start + solved.length) * solved.length / spans as f64;
        let rings = spans * (turn / 0.15).ceil().clamp(20.0, 4000.0) as usize;
        let (coarse, bend) = by_surface(&path, &solved, start, rings);
        // Pappus needs a line that is bent less than the muscle is thick.
        prop_assume!(bend < 1.0);
        let (fine, _) = by_surface(&path, &solved, start, 2 * rings);
        let expected = by_cones(&solved.radii, solved.length) * polygon();
        let (far, near) = ((coarse / expected - 1.0).abs(), (fine / expected - 1.0).abs());
        prop_assert!(near < 1e-3, "{near}\n{}", case.yaml);
        // Twice as many rings are four times as near; where an arc begins between two rings, nearly so.
        prop_assert!(near < 0.5 * far + 1e-9, "{far} {near}\n{}", case.yaml);
    }
}

#[test]
fn most_random_muscles_are_bent_no_tighter_than_they_are_thick() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let fit = (0..100).filter(|_| {
        let case = cases().new_tree(&mut runner).unwrap().current();
        let (file, solved, path) = posed(&case);
        by_surface(&path, &solved, file.muscles[0].tendons[0].length, 200).1 < 1.0
    });
    assert!(fit.count() > 60, "the property above would say nothing about the others");
}
