//! The quadratic: closed forms, the report's tables, and volume kept on muscles of every kind.

use std::f64::consts::PI;

use proptest::prelude::*;
use sinew::muscle::{MuscleFile, MuscleRig, Profile, ProfileError};
use sinew::scene::{MuscleId, Scene};

fn measured() -> Profile {
    let radii = vec![5.0, 7.6, 18.2, 20.7, 21.2, 21.7, 24.3, 25.7, 20.7, 13.2, 5.0];
    let growth = vec![0.0, 1.9, -3.0, 2.7, 5.5, 13.5, 11.5, 10.9, 3.5, 3.5, 0.0];
    Profile::new(radii, growth, 250.0).unwrap()
}

/// Volume of the truncated cones, written out without any of the program's own sums.
fn cones(radii: &[f64], length: f64) -> f64 {
    let height = length / (radii.len() - 1) as f64;
    radii.windows(2).map(|r| PI * height / 3.0 * (r[0] * r[0] + r[0] * r[1] + r[1] * r[1])).sum()
}

/// Every coefficient from its definition: F(r + m δ) expanded by three evaluations.
fn coefficients(radii: &[f64], growth: &[f64]) -> [f64; 3] {
    let f = |delta: f64| {
        let grown: Vec<f64> = radii.iter().zip(growth).map(|(r, m)| r + m * delta).collect();
        cones(&grown, (radii.len() - 1) as f64) / PI
    };
    let (zero, plus, minus) = (f(0.0), f(1.0), f(-1.0));
    [0.5 * (plus + minus) - zero, 0.5 * (plus - minus), zero]
}

#[test]
fn a_cylinder_follows_the_closed_form() {
    // All radii r, all growth 1: r' = r √(L / L').
    let profile = Profile::new(vec![2.0; 5], vec![1.0; 5], 10.0).unwrap();
    for length in [4.0, 7.0, 10.0, 16.0, 25.0] {
        let solved = profile.solve(length);
        let radius = 2.0 * (10.0_f64 / length).sqrt();
        assert!(!solved.held);
        for r in &solved.radii {
            assert!((r - radius).abs() < 1e-14 * radius, "{r} is not {radius} at {length}");
        }
        assert!((solved.volume - PI * 4.0 * 10.0).abs() < 1e-12);
    }
}

#[test]
fn coefficients_are_those_of_the_expanded_volume() {
    let profile = measured();
    let [a, b, f] = coefficients(profile.radii(), profile.growth());
    let solved = profile.solve(222.0);
    let c = f * (1.0 - 250.0 / 222.0);
    for (ours, expected) in solved.quadratic.iter().zip([a, b, c]) {
        assert!((ours - expected).abs() < 1e-9 * expected.abs(), "{ours} is not {expected}");
    }
    assert!((solved.discriminant - (b * b - 4.0 * a * c)).abs() < 1e-6);
    for root in solved.roots {
        assert!(((a * root + b) * root + c).abs() < 1e-8, "{root} is no root");
    }
}

#[test]
fn at_rest_nothing_changes_whatever_the_sign_of_growth() {
    for growth in [vec![1.0, 2.0, 1.0], vec![-1.0, -2.0, -1.0], vec![1.0, -2.0, 1.0], vec![-2.0, 1.0, -2.0]] {
        let profile = Profile::new(vec![3.0, 5.0, 4.0], growth.clone(), 20.0).unwrap();
        let solved = profile.solve(20.0);
        assert_eq!(solved.delta, 0.0, "{growth:?}");
        assert_eq!(solved.radii, [3.0, 5.0, 4.0]);
        assert!(!solved.held);
        // Near rest the change is small: no jump to the other root.
        assert!(profile.solve(20.0001).delta.abs() < 1e-2, "{growth:?}");
    }
}

#[test]
fn growth_without_a_first_order_takes_the_positive_root() {
    // B = 0: two cones whose changes cancel to first order.
    let profile = Profile::new(vec![2.0, 2.0], vec![1.0, -1.0], 10.0).unwrap();
    assert_eq!(profile.solve(10.0).quadratic[1], 0.0);
    assert_eq!(*profile.length_range().end(), 10.0, "it can only shorten");
    let solved = profile.solve(9.9);
    assert!(solved.delta > 0.0 && solved.volume_error.abs() < 1e-13);
}

#[test]
fn beyond_its_limits_a_muscle_is_held_and_says_so() {
    let profile = measured();
    let range = profile.length_range();
    assert!(*range.start() < 250.0 && 250.0 < *range.end());
    for length in [0.0, -5.0, 1e9, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let solved = profile.solve(length);
        assert!(solved.held, "{length}");
        assert!(solved.radii.iter().all(|r| *r > 0.0 && r.is_finite()), "{length}: {:?}", solved.radii);
        assert!(solved.volume_error.abs() < 1e-12, "{length}: {}", solved.volume_error);
    }
    // No belly gets shorter than 40 % of its rest, although its node of negative growth would still have a radius.
    assert_eq!(*range.start(), 100.0);
    // Of one that shrinks faster there, the shortest length is where it reaches zero: δ = 18.2 / 30.
    let mut growth = profile.growth().to_vec();
    growth[2] = -30.0;
    let profile = Profile::new(profile.radii().to_vec(), growth, 250.0).unwrap();
    let range = profile.length_range();
    let [a, b, f] = coefficients(profile.radii(), profile.growth());
    let delta: f64 = 18.2 / 30.0;
    let shortest = 250.0 * f / ((a * delta + b) * delta + f);
    assert!(shortest > 100.0 && (range.start() - shortest).abs() < 1e-6 * shortest, "{shortest}");
    assert!(!profile.solve(shortest * 1.001).held && profile.solve(shortest * 0.999).held);
}

#[test]
fn the_longest_length_may_be_the_double_root() {
    // Large growth against a thin wide pair: the discriminant ends before any radius does.
    let profile = Profile::new(vec![10.0, 1.0, 10.0], vec![-1.0, 5.0, -1.0], 30.0).unwrap();
    let range = profile.length_range();
    let [a, b, f] = coefficients(profile.radii(), profile.growth());
    let limit = 30.0 * f / (f - b * b / (4.0 * a));
    let at_limit = profile.solve(*range.end());
    assert!(at_limit.volume_error.abs() < 1e-12);
    if (range.end() - limit).abs() < 1e-9 * limit {
        assert!(at_limit.discriminant.abs() < 1e-6 * b * b);
    } else {
        assert!(at_limit.radii.iter().any(|r| *r < 1e-6), "the limit is neither the double root nor a vanishing radius");
    }
}

#[test]
fn what_makes_no_muscle_is_refused() {
    let new = |r: &[f64], m: &[f64], l: f64| Profile::new(r.to_vec(), m.to_vec(), l).unwrap_err();
    assert_eq!(new(&[1.0], &[1.0], 1.0), ProfileError::TooFewNodes(1));
    assert_eq!(new(&[], &[], 1.0), ProfileError::TooFewNodes(0));
    assert_eq!(new(&[1.0, 2.0], &[1.0], 1.0), ProfileError::LengthsDiffer { radii: 2, growth: 1 });
    assert_eq!(new(&[1.0, -2.0], &[1.0, 1.0], 1.0), ProfileError::BadRadius(1));
    assert_eq!(new(&[f64::NAN, 2.0], &[1.0, 1.0], 1.0), ProfileError::BadRadius(0));
    assert_eq!(new(&[1.0, 2.0], &[1.0, f64::INFINITY], 1.0), ProfileError::BadGrowth(1));
    assert_eq!(new(&[1.0, 2.0], &[0.0, 0.0], 1.0), ProfileError::NoGrowth);
    assert_eq!(new(&[0.0, 0.0], &[1.0, 0.0], 1.0), ProfileError::NoRadius);
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(new(&[1.0, 2.0], &[1.0, 1.0], length), ProfileError::BadLength);
    }
    assert!(matches!(Profile::new(vec![1.0; 20_000], vec![1.0; 20_000], 1.0), Err(ProfileError::TooManyNodes(20_000))));
}

/// Table 4.2 of Perestoronin (2020): radii of the nine inner nodes as printed, millimetres, at 0°, 30°, 60° and 90°. Its own solver used
/// slightly wrong coefficients in small steps, so an exact one differs by up to 0.1 mm.
const REPORT: [[f64; 4]; 9] = [
    [7.6, 7.7, 7.8, 8.0],
    [18.2, 18.1, 17.9, 17.6],
    [20.7, 20.8, 21.0, 21.2],
    [21.2, 21.3, 21.7, 22.3],
    [21.7, 22.1, 23.0, 24.4],
    [24.3, 24.6, 25.4, 26.6],
    [25.7, 26.0, 26.7, 27.9],
    [20.7, 20.8, 21.0, 21.4],
    [13.2, 13.3, 13.5, 13.9],
];

#[test]
fn the_measured_biceps_agrees_with_the_reports_table() {
    let file = MuscleFile::parse(include_str!("../../configs/biceps-measured.yaml")).unwrap();
    let rig = MuscleRig::build(&file, "measured", &mut Scene::default(), MuscleId(0));
    for (column, sample) in rig.measure(0, &[0.0, 30.0, 60.0, 90.0]).iter().enumerate() {
        for (row, printed) in REPORT.iter().enumerate() {
            let ours = sample.solved.radii[row + 1];
            assert!(
                (ours - printed[column]).abs() <= 0.1,
                "node {} at {}°: {ours} is not {}",
                row + 1,
                sample.angle.unwrap(),
                printed[column]
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn volume_is_kept_over_the_whole_range(
        nodes in prop::collection::vec((0.01..50.0_f64, -10.0..20.0_f64), 2..24),
        length in 1.0..1000.0_f64,
        shares in prop::collection::vec(0.0..=1.0_f64, 8),
    ) {
        let (radii, growth): (Vec<f64>, Vec<f64>) = nodes.into_iter().unzip();
        let profile = Profile::new(radii.clone(), growth, length).unwrap();
        let volume = cones(&radii, length);
        let range = profile.length_range();
        for share in shares.into_iter().chain([0.0, 1.0]) {
            // Even steps in the logarithm, so that short lengths get their share.
            let at = (range.start().ln() * (1.0 - share) + range.end().ln() * share).exp().clamp(*range.start(), *range.end());
            let solved = profile.solve(at);
            prop_assert!(!solved.held);
            prop_assert!(solved.radii.iter().all(|r| *r > 0.0), "radii {:?} at {at}", solved.radii);
            let error = cones(&solved.radii, at) / volume - 1.0;
            prop_assert!(error.abs() < 1e-12, "volume is off by {error:e} at {at} of {range:?}");
            prop_assert!((solved.volume_error - error).abs() < 1e-13);
        }
    }

    #[test]
    fn radii_change_steadily_with_the_length(
        nodes in prop::collection::vec((0.1..50.0_f64, -5.0..10.0_f64), 2..16),
        length in 1.0..1000.0_f64,
    ) {
        // δ is monotone over the valid range: no step jumps to the other branch.
        let (radii, growth): (Vec<f64>, Vec<f64>) = nodes.into_iter().unzip();
        let profile = Profile::new(radii, growth, length).unwrap();
        let range = profile.length_range();
        let deltas: Vec<f64> = (0..=100)
            .map(|i| profile.solve(range.start() * (range.end() / range.start()).powf(f64::from(i) / 100.0)).delta)
            .collect();
        let rising = deltas[100] > deltas[0];
        let slack = 1e-9 * deltas.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
        for pair in deltas.windows(2) {
            let step = if rising { pair[1] - pair[0] } else { pair[0] - pair[1] };
            prop_assert!(step > -slack, "{deltas:?}");
        }
    }
}

#[test]
fn poses_that_fit_no_muscle_are_refused() {
    use sinew::muscle::Pose;
    let poses =
        |list: &[(f64, &[f64])]| list.iter().map(|(length, radii)| Pose { length: *length, radii: radii.to_vec() }).collect::<Vec<_>>();
    let refused = |list: &[(f64, &[f64])], length| Profile::of_poses(poses(list), length).unwrap_err();
    assert_eq!(refused(&[], 5.0), ProfileError::TooFewNodes(0));
    assert_eq!(refused(&[(5.0, &[1.0])], 5.0), ProfileError::NoRadius);
    assert_eq!(refused(&[(5.0, &[1.0, 2.0]), (6.0, &[1.0])], 5.0), ProfileError::PoseNodes { pose: 1, nodes: 1, wanted: 2 });
    assert_eq!(refused(&[(5.0, &[1.0, 2.0]), (5.0, &[1.0, 3.0])], 5.0), ProfileError::PosesCoincide(0));
    assert_eq!(refused(&[(5.0, &[1.0, 2.0]), (-1.0, &[1.0, 3.0])], 5.0), ProfileError::PoseLength(1));
    assert_eq!(refused(&[(5.0, &[1.0, f64::NAN])], 5.0), ProfileError::BadRadius(1));
    assert_eq!(refused(&[(5.0, &[1.0, 2.0])], 0.0), ProfileError::BadLength);
}

proptest! {
    #[test]
    fn posed_muscles_keep_their_volume_too(
        shapes in prop::collection::vec((1.0..500.0_f64, prop::collection::vec(0.01..50.0_f64, 7)), 1..6),
        rest in 1.0..500.0_f64,
        at in prop::collection::vec(0.4..50.0_f64, 12),
    ) {
        let poses: Vec<_> = shapes.into_iter().map(|(length, radii)| sinew::muscle::Pose { length, radii }).collect();
        let Ok(profile) = Profile::of_poses(poses, rest) else { return Ok(()) };
        let volume = cones(profile.radii(), rest);
        prop_assert!(profile.is_posed() && profile.solve(rest).delta.abs() < 1e-12);
        for share in at {
            let solved = profile.solve(share * rest);
            prop_assert!(!solved.held);
            prop_assert!((cones(&solved.radii, share * rest) / volume - 1.0).abs() < 1e-12);
            prop_assert!(solved.volume_error.abs() < 1e-12 && solved.radii.iter().all(|radius| *radius > 0.0));
        }
    }
}
