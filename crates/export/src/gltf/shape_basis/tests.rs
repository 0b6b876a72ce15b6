//! Shapes of sequences whose rank is known, and of random ones.

use super::*;
use proptest::prelude::*;

const TIGHT: ShapeTolerance = ShapeTolerance { projection: 1e-4, omission: 1e-4, normal: 1e-4 };

fn basis(moments: &[Vec<Vec3>], tolerance: ShapeTolerance, most: usize) -> ShapeBasis {
    let mut builder = ShapeBasisBuilder::new(moments.first().map_or(0, Vec::len), tolerance, most);
    moments.iter().for_each(|moment| builder.add(moment, moment, 1.0));
    builder.finish()
}

/// What shapes and weights make of a vertex at a moment.
fn made(basis: &ShapeBasis, part: fn(&Shape) -> &[[f32; 3]], moment: usize, vertex: usize) -> Vec3 {
    basis.shapes.iter().zip(&basis.weights[moment]).map(|(shape, weight)| Vec3::from_array(part(shape)[vertex]) * *weight).sum()
}

fn worst(basis: &ShapeBasis, moments: &[Vec<Vec3>]) -> f32 {
    let vertices = |(number, moment): (usize, &Vec<Vec3>)| -> f32 {
        let off = |(vertex, delta): (usize, &Vec3)| made(basis, |shape| &shape.positions, number, vertex).distance(*delta);
        moment.iter().enumerate().map(off).fold(0.0, f32::max)
    };
    moments.iter().enumerate().map(vertices).fold(0.0, f32::max)
}

/// Moments that are sums of `rank` independent shapes with independent weights.
fn of_rank(rank: usize, vertices: usize, moments: usize) -> Vec<Vec<Vec3>> {
    let wave = |a: usize, b: usize, c: usize| ((a * 7 + 3) as f32 * 0.37 * (b + 1) as f32 + c as f32).sin();
    let shape = |rank: usize, vertex: usize| Vec3::new(wave(rank, vertex, 0), wave(rank, vertex, 1), wave(rank, vertex, 2));
    let delta = |moment: usize, vertex: usize| (0..rank).map(|rank| shape(rank, vertex) * wave(rank, moment, 5)).sum();
    (0..moments).map(|moment| (0..vertices).map(|vertex| delta(moment, vertex)).collect()).collect()
}

#[test]
fn a_sequence_of_known_rank_gives_exactly_that_many_shapes() {
    for rank in 0..6 {
        let moments = of_rank(rank, 40, 30);
        let found = basis(&moments, TIGHT, 64);
        assert_eq!(found.shapes.len(), rank);
        assert!(!found.exceeded && worst(&found, &moments) <= 2.1e-4, "{rank}: {}", worst(&found, &moments));
        // Normals that move as the positions do come out as they do.
        for (number, moment) in moments.iter().enumerate() {
            for (vertex, delta) in moment.iter().enumerate() {
                assert!(made(&found, |shape| &shape.normals, number, vertex).distance(*delta) <= 1e-3);
            }
        }
    }
}

#[test]
fn what_moves_less_than_the_tolerance_has_no_shapes() {
    let moments: Vec<Vec<Vec3>> =
        of_rank(3, 40, 30).into_iter().map(|moment| moment.into_iter().map(|delta| delta * 1e-5).collect()).collect();
    assert!(basis(&moments, TIGHT, 64).shapes.is_empty());
}

#[test]
fn the_same_movement_in_a_larger_scale_is_held_as_closely() {
    let moments = of_rank(5, 40, 30);
    let loose = ShapeTolerance { projection: 0.2, omission: 0.2, normal: 0.2 };
    let mut builder = ShapeBasisBuilder::new(40, loose, 64);
    moments.iter().for_each(|moment| builder.add(moment, &[], 100.0));
    let found = builder.finish();
    assert!(worst(&found, &moments) <= 0.41 / 100.0);
    assert!(found.shapes.iter().all(|shape| shape.normals.iter().all(|normal| *normal == [0.0; 3])));
}

#[test]
fn few_or_strange_moments_are_no_trouble() {
    assert_eq!(basis(&[], TIGHT, 64), ShapeBasis { shapes: Vec::new(), weights: Vec::new(), exceeded: false });
    let one = basis(&of_rank(1, 5, 1), TIGHT, 64);
    assert_eq!((one.shapes.len(), one.weights.len()), (1, 1));
    assert!((one.weights[0][0] - 1.0).abs() < 1e-6);
    assert!(basis(&vec![Vec::new(); 3], TIGHT, 64).shapes.is_empty());
    assert!(basis(&[vec![Vec3::ONE], vec![Vec3::X]], TIGHT, 0).exceeded);
    let mut strange = of_rank(2, 5, 4);
    strange[1][2] = Vec3::NAN;
    strange[2][3] = Vec3::INFINITY;
    strange[3].truncate(1);
    let found = basis(&strange, TIGHT, 64);
    let numbers = found.shapes.iter().flat_map(|shape| shape.positions.iter().chain(&shape.normals)).flatten();
    assert!(numbers.chain(found.weights.iter().flatten()).all(|number| number.is_finite()));
    assert!(made(&found, |shape| &shape.positions, 1, 2).length() <= 2.1e-4);
}

#[test]
fn a_vertex_is_only_in_the_shapes_that_it_needs() {
    // Every vertex goes to and fro along one line, and the last one along two others as well, each in a rhythm of its own over a whole period.
    let wave = |moment: u8, rhythm: f32| (f32::from(moment) * rhythm * std::f32::consts::TAU / 60.0).sin();
    let of = |moment: u8| -> Vec<Vec3> {
        let last = Vec3::new(0.0, wave(moment, 2.0), 0.5 * wave(moment, 3.0));
        (0..50).map(|vertex| Vec3::X * wave(moment, 1.0) + if vertex == 49 { last } else { Vec3::ZERO }).collect()
    };
    let moments: Vec<Vec<Vec3>> = (0..60).map(of).collect();
    let found = basis(&moments, TIGHT, 64);
    assert_eq!(found.shapes.len(), 3);
    let used = |shape: &Shape| shape.positions.iter().filter(|delta| **delta != [0.0; 3]).count();
    assert_eq!(found.shapes.iter().map(used).collect::<Vec<_>>(), [50, 1, 1]);
}

#[test]
fn a_half_way_moment_is_straight_where_it_is_the_mean() {
    let mut builder = ShapeBasisBuilder::new(2, TIGHT, 64);
    for x in [0.0, 1.0, 2.0, 2.5] {
        builder.add(&[Vec3::X * x, Vec3::Y], &[], 1.0);
    }
    assert!(builder.is_straight([0, 1, 2], 1e-3));
    assert!(!builder.is_straight([0, 1, 3], 0.2) && builder.is_straight([0, 1, 3], 0.3));
    assert!(builder.is_straight([0, 1, 9], 1e-3));
}

proptest! {
    #[test]
    fn no_vertex_of_any_sequence_is_further_off_than_the_tolerances_allow(
        vertices in 1..12_usize, numbers in proptest::collection::vec(-1.0..1.0_f32, 0..600), projection in 0.001..0.5_f32, omission in 0.0..0.5_f32,
    ) {
        let vectors: Vec<Vec3> = numbers.as_chunks::<3>().0.iter().map(|row| Vec3::from_array(*row)).collect();
        let moments: Vec<Vec<Vec3>> = vectors.chunks_exact(vertices).map(<[Vec3]>::to_vec).collect();
        let found = basis(&moments, ShapeTolerance { projection, omission, normal: 0.02 }, 64);
        prop_assert!(!found.exceeded);
        prop_assert!(worst(&found, &moments) <= projection + omission + 1e-5);
        prop_assert!(found.weights.iter().flatten().all(|weight| weight.abs() <= 1.0));
        prop_assert!(found.shapes.len() <= moments.len().min(3 * vertices));
    }
}
