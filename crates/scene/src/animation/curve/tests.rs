//! Curves against closed forms.

use glam::{DMat4, DQuat, DVec3, EulerRot};
use proptest::prelude::*;

use super::*;

fn numbers(times: &[f64], values: &[f64], mode: Interpolation) -> Keys {
    Keys { times: times.to_vec(), dimension: 1, values: values.to_vec(), modes: vec![mode; times.len()], ..Keys::default() }
}

fn matrices(keys: &[(f64, DMat4)]) -> Curve {
    Curve::new(Keys {
        times: keys.iter().map(|(time, _)| *time).collect(),
        dimension: 16,
        values: keys.iter().flat_map(|(_, matrix)| matrix.to_cols_array()).collect(),
        matrix: true,
        ..Keys::default()
    })
}

fn tangents(stride: usize, values: &[f64]) -> Tangents {
    Tangents { stride, values: values.to_vec() }
}

#[test]
fn straight_lines_steps_and_held_ends() {
    let mut keys = numbers(&[1.0, 2.0, 4.0], &[10.0, 20.0, 0.0], Interpolation::Linear);
    keys.modes = vec![Interpolation::Linear, Interpolation::Step];
    let curve = Curve::new(keys);
    for (time, value) in [(-9.0, 10.0), (1.0, 10.0), (1.25, 12.5), (2.0, 20.0), (3.999, 20.0), (4.0, 0.0), (99.0, 0.0)] {
        assert_eq!(curve.value(time, 0), value, "at {time}");
    }
    assert_eq!(curve.time_range(), Some((1.0, 4.0)));
    assert_eq!(Curve::default().value(1.0, 0), 0.0);
}

#[test]
fn keys_may_be_unsorted_repeated_single_or_broken() {
    let curve = Curve::new(numbers(&[2.0, -1.0, f64::NAN, 2.0, 3.0], &[5.0, 1.0, 7.0, 6.0, f64::INFINITY], Interpolation::Linear));
    assert_eq!((curve.times.as_slice(), curve.values.as_slice()), (&[-1.0, 2.0, 2.0][..], &[1.0, 5.0, 6.0][..]));
    assert!((curve.value(1.999_999, 0) - 5.0).abs() < 1e-5);
    assert_eq!(curve.value(2.0, 0), 6.0);
    let single = Curve::new(numbers(&[0.5], &[3.0], Interpolation::Bezier));
    assert_eq!([single.value(0.0, 0), single.value(0.5, 0), single.value(9.0, 0)], [3.0; 3]);
}

#[test]
fn bezier_with_values_alone_stands_at_thirds() {
    let mut keys = numbers(&[0.0, 2.0], &[1.0, 5.0], Interpolation::Bezier);
    (keys.out_tangents, keys.in_tangents) = (tangents(1, &[2.0, 0.0]), tangents(1, &[0.0, 9.0]));
    let curve = Curve::new(keys);
    for i in 0..=20 {
        let s = f64::from(i) / 20.0;
        let r = 1.0 - s;
        let wanted = r.powi(3) + 3.0 * r * r * s * 2.0 + 3.0 * r * s * s * 9.0 + s.powi(3) * 5.0;
        assert!((curve.value(2.0 * s, 0) - wanted).abs() < 1e-12);
    }
}

#[test]
fn hermite_vectors_are_thirds_of_the_way_to_the_controls() {
    let mut keys = numbers(&[0.0, 1.0], &[0.0, 1.0], Interpolation::Hermite);
    (keys.out_tangents, keys.in_tangents) = (tangents(2, &[1.0, 3.0, 0.0, 0.0]), tangents(2, &[0.0, 0.0, 1.0, 0.0]));
    let curve = Curve::new(keys);
    // The cubic Hermite basis with slopes 3 and 0.
    for i in 0..=10 {
        let s = f64::from(i) / 10.0;
        let wanted = 3.0 * (s.powi(3) - 2.0 * s * s + s) + (-2.0 * s.powi(3) + 3.0 * s * s);
        assert!((curve.value(s, 0) - wanted).abs() < 1e-12);
    }
}

#[test]
fn curved_keys_without_tangents_go_straight() {
    let curve = Curve::new(numbers(&[0.0, 1.0], &[0.0, 4.0], Interpolation::Bezier));
    assert_eq!(curve.value(0.25, 0), 1.0);
}

#[test]
fn tangents_of_vectors_come_in_three_layouts() {
    let keys = |out: Tangents, arriving: Tangents| Keys {
        times: vec![0.0, 3.0],
        dimension: 2,
        values: vec![0.0, 10.0, 3.0, 40.0],
        modes: vec![Interpolation::Bezier; 2],
        out_tangents: out,
        in_tangents: arriving,
        ..Keys::default()
    };
    let alone = Curve::new(keys(tangents(2, &[1.0, 20.0, 0.0, 0.0]), tangents(2, &[0.0, 0.0, 2.0, 30.0])));
    let shared = Curve::new(keys(tangents(3, &[1.0, 1.0, 20.0, 0.0, 0.0, 0.0]), tangents(3, &[0.0, 0.0, 0.0, 2.0, 2.0, 30.0])));
    let pairs =
        Curve::new(keys(tangents(4, &[1.0, 1.0, 1.0, 20.0, 0.0, 0.0, 0.0, 0.0]), tangents(4, &[0.0, 0.0, 0.0, 0.0, 2.0, 2.0, 2.0, 30.0])));
    for curve in [alone, shared, pairs] {
        let mut values = [0.0; 2];
        curve.sample(1.5, &mut values);
        assert!((values[0] - 1.5).abs() < 1e-12 && (values[1] - 25.0).abs() < 1e-12, "{values:?}");
        assert!((curve.component(1).value(1.5, 0) - 25.0).abs() < 1e-12);
        assert!((curve.mapped(|value| 1.0 - 2.0 * value).value(1.5, 1) + 49.0).abs() < 1e-12);
    }
}

#[test]
fn rotations_take_the_shorter_arc_at_even_speed() {
    let turn = |degrees: f64| {
        DMat4::from_scale_rotation_translation(DVec3::splat(2.0), DQuat::from_rotation_z(degrees.to_radians()), DVec3::X * degrees)
    };
    let curve = matrices(&[(0.0, turn(350.0)), (1.0, turn(10.0)), (2.0, turn(190.0))]);
    assert!(!curve.is_sheared());
    for (time, degrees, x) in [(0.25, 355.0, 265.0), (0.5, 0.0, 180.0), (0.75, 5.0, 95.0)] {
        let mut wanted = turn(degrees);
        wanted.w_axis.x = x;
        assert!(curve.matrix(time).abs_diff_eq(wanted, 1e-12), "at {time}");
    }
    // On a key the file's own numbers, to the bit.
    assert_eq!(curve.matrix(1.0), turn(10.0));
    assert_eq!(curve.matrix(7.0), turn(190.0));
}

#[test]
fn mirrors_stay_mirrors_and_steps_stay_steps() {
    let mirrored = |angle: f64| DMat4::from_rotation_y(angle) * DMat4::from_scale(DVec3::new(1.0, -3.0, 2.0));
    let curve = matrices(&[(0.0, mirrored(0.2)), (1.0, mirrored(0.8))]);
    assert!(curve.matrix(0.5).abs_diff_eq(mirrored(0.5), 1e-12));
    let mut keys = Keys { times: vec![0.0, 1.0], dimension: 16, matrix: true, modes: vec![Interpolation::Step; 2], ..Keys::default() };
    keys.values = [mirrored(0.2), mirrored(0.8)].iter().flat_map(DMat4::to_cols_array).collect();
    assert_eq!(Curve::new(keys).matrix(0.99), mirrored(0.2));
}

#[test]
fn sheared_and_flat_matrices_go_element_by_element_and_the_bottom_row_is_fixed() {
    let mut sheared = DMat4::IDENTITY;
    sheared.y_axis.x = 1.0;
    let curve = matrices(&[(0.0, DMat4::IDENTITY), (1.0, sheared)]);
    assert!(curve.is_sheared());
    assert_eq!(curve.matrix(0.5).y_axis.x, 0.5);
    let flat = matrices(&[(0.0, DMat4::from_scale(DVec3::ZERO)), (1.0, DMat4::IDENTITY)]);
    assert!(!flat.is_sheared());
    assert_eq!(flat.matrix(0.5).x_axis.x, 0.5);
    let mut zeroed = DMat4::from_translation(DVec3::X);
    zeroed.w_axis.w = 0.0;
    zeroed.x_axis.w = 5.0;
    let curve = matrices(&[(0.0, zeroed), (1.0, zeroed)]);
    for time in [0.0, 0.3, 1.0] {
        assert_eq!(curve.matrix(time), DMat4::from_translation(DVec3::X));
    }
}

proptest! {
    #[test]
    fn bezier_time_is_solved_to_the_last_digits(x1 in 0.0f64..1.0, x2 in 0.0f64..1.0, x in 0.0f64..1.0) {
        let s = solve(x1, x2, x);
        let r = 1.0 - s;
        prop_assert!((0.0..=1.0).contains(&s));
        prop_assert!((3.0 * r * r * s * x1 + 3.0 * r * s * s * x2 + s * s * s - x).abs() < 1e-13);
    }

    #[test]
    fn a_curve_is_the_same_whatever_was_asked_before(times in prop::collection::vec(0.0f64..10.0, 2..20), asked in prop::collection::vec(-1.0f64..11.0, 1..20)) {
        let values: Vec<f64> = times.iter().map(|time| time.sin()).collect();
        let curve = Curve::new(numbers(&times, &values, Interpolation::Linear));
        let forward: Vec<f64> = asked.iter().map(|time| curve.value(*time, 0)).collect();
        let backward: Vec<f64> = asked.iter().rev().map(|time| curve.value(*time, 0)).collect();
        prop_assert!(forward.iter().eq(backward.iter().rev()));
        let (low, high) = (values.iter().copied().fold(f64::MAX, f64::min), values.iter().copied().fold(f64::MIN, f64::max));
        prop_assert!(forward.iter().all(|value| (low - 1e-12..=high + 1e-12).contains(value)));
    }

    #[test]
    fn decomposed_matrices_agree_with_glam(a in prop::array::uniform3(-3.0f64..3.0), b in prop::array::uniform3(-3.0f64..3.0), part in 0.0f64..1.0) {
        let [qa, qb] = [a, b].map(|[x, y, z]| DQuat::from_euler(EulerRot::XYZ, x, y, z));
        let of = |q, s: f64, x: f64| DMat4::from_scale_rotation_translation(DVec3::new(s, 1.0, 2.0), q, DVec3::X * x);
        let curve = matrices(&[(0.0, of(qa, 1.0, 0.0)), (1.0, of(qb, 3.0, 8.0))]);
        let wanted = of(qa.slerp(qb, part), 1.0 + 2.0 * part, 8.0 * part);
        // glam's own slerp turns to a straight line below a thousandth, so it is the less exact one.
        prop_assert!(curve.matrix(part).abs_diff_eq(wanted, 1e-5));
    }
}
