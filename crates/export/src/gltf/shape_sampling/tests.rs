//! Sampled movement of made surfaces against the closed form that moved them.

use super::*;

/// A row of points that swings round the origin by the angle 2·at, seconds, and a point at rest; in the second range it stands at a quarter turn.
struct Pendulum;

fn at(range: usize, at: f64, radius: f64) -> Vec3 {
    let (sin, cos) = if range == 0 { (2.0 * at).sin_cos() } else { std::f64::consts::FRAC_PI_2.sin_cos() };
    glam::DVec3::new(radius * (cos - 1.0), radius * sin, 0.0).as_vec3()
}

impl MovingSurfaces for Pendulum {
    type Scratch = ();

    fn vertices(&self) -> Vec<usize> {
        vec![10, 1]
    }

    fn pose(&self, range: usize, time: f64, _: &mut ()) -> Vec<Displacements> {
        let positions = (0..10).map(|radius| at(range, time, f64::from(radius))).collect();
        let still = Displacements { positions: vec![Vec3::ZERO], normals: vec![Vec3::ZERO], scale: 1.0 };
        vec![Displacements { positions, normals: vec![Vec3::ZERO; 10], scale: 1.0 }, still]
    }
}

fn key(at: f64) -> KeyTime {
    KeyTime { at, written: at as f32 }
}

fn made(error: f32, threads: usize) -> (Vec<AnimatedShapes>, bool) {
    let sampled = sample(&Pendulum, &[vec![key(0.0), key(0.7), key(3.0)], vec![key(0.0)], Vec::new()], error, MAX_SHAPES, threads);
    let (exceeded, mut found) = (sampled.exceeded, Vec::new());
    sampled.finish(|number, shapes| {
        assert_eq!(number, found.len());
        found.push(shapes);
    });
    (found, exceeded)
}

/// Largest distance from the closed form, at moments between all keys.
fn worst(shapes: &AnimatedShapes, range: usize) -> f32 {
    let keys = &shapes.keys[range];
    let off = |step: u32| {
        let time = 3.0 * f64::from(step) / 1000.0;
        let after = keys.partition_point(|(key, _)| f64::from(*key) <= time).clamp(1, keys.len().max(2) - 1);
        let (from, to) = (keys[after - 1], keys[after.min(keys.len() - 1)]);
        let part = if to.0 > from.0 { (time as f32 - from.0) / (to.0 - from.0) } else { 0.0 };
        let weight = |shape: usize| {
            let [from, to] = [from.1, to.1].map(|moment| shapes.basis.weights[moment][shape]);
            from + (to - from) * part
        };
        let point = |vertex: usize| -> Vec3 {
            shapes.basis.shapes.iter().enumerate().map(|(number, shape)| Vec3::from_array(shape.positions[vertex]) * weight(number)).sum()
        };
        (0..10).map(|vertex| point(vertex).distance(at(range, time, vertex as f64))).fold(0.0, f32::max)
    };
    (0..=1000).map(off).fold(0.0, f32::max)
}

#[test]
fn a_pendulum_is_two_shapes_and_as_many_keys_as_the_error_asks_for() {
    let mut before = 0;
    for error in [0.5, 0.05, 0.005] {
        let (found, exceeded) = made(error, 1);
        assert!(!exceeded);
        assert_eq!(found[0].basis.shapes.len(), 2);
        assert!(worst(&found[0], 0) <= error && worst(&found[0], 1) <= error, "{error}: {}", worst(&found[0], 0));
        assert!(found[0].keys[0].len() > before && found[0].keys[2].is_empty());
        assert!(found[0].keys[0].windows(2).all(|pair| pair[0].0 < pair[1].0));
        before = found[0].keys[0].len();
        assert!(found[1].basis.shapes.is_empty());
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let [one, two, many] = [1, 2, 7].map(|threads| made(0.01, threads).0);
    for other in [two, many] {
        for (one, other) in one.iter().zip(&other) {
            assert!(one.basis == other.basis && one.keys == other.keys);
        }
    }
}

#[test]
fn nothing_to_sample_is_no_trouble() {
    let sampled = sample(&Pendulum, &[], 0.1, MAX_SHAPES, 2);
    sampled.finish(|_, shapes| assert!(shapes.basis.shapes.is_empty() && shapes.keys.is_empty()));
}

#[test]
fn too_many_keys_are_told() {
    let keys = (0..MAX_MOMENTS).map(|number| key(number as f64 * 0.001)).collect();
    let sampled = sample(&Pendulum, &[keys], 0.1, MAX_SHAPES, 2);
    assert!(sampled.exceeded);
    sampled.finish(|number, shapes| assert!(number == 1 || worst(&shapes, 0) <= 0.1));
}
