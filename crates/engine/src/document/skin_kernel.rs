//! The inner loop of skinning: blend the matrices of a vertex, transform its position and normal.
//!
//! Written once over [`Simd`] and compiled for each instruction set. The arithmetic and its order are the same in all (no fused multiply-add), so
//! every width gives the same bits. Matrices are blended one vertex at a time, all their numbers side by side; a group's matrices are then
//! transposed, and positions and normals are worked on with one vertex a lane.

use std::ops::{Add, Mul, Sub};

use glam::{DMat4, Mat3A, Vec3, Vec3A};

use super::skin_plan::{GROUP, SkinningPlan, WeightedMatrixRef};
use sinew_scene::{Bounds, Influence};
use sinew_simd::{Simd, always, each, kernel, map};

/// An affine matrix as three rows of four, and four numbers that mean nothing, so that it fills one cache line.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(64))]
pub(super) struct Affine([f32; 16]);

impl Affine {
    /// From a matrix; its bottom row is left out.
    pub(super) fn of(matrix: &DMat4) -> Self {
        let m = matrix.as_mat4();
        Self::from_parts(Mat3A::from_mat4(m), m.w_axis.truncate())
    }

    /// From a linear part and a translation.
    pub(super) fn from_parts(linear: Mat3A, t: Vec3) -> Self {
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis].map(|axis| axis.to_array());
        Self([x[0], y[0], z[0], t.x, x[1], y[1], z[1], t.y, x[2], y[2], z[2], t.z, 0.0, 0.0, 0.0, 0.0])
    }

    /// `Σ wᵢ Mᵢ`, in the order of the influences as everywhere.
    pub(super) fn sum(influences: &[Influence], matrix: impl Fn(i32) -> Self) -> Self {
        let mut sum = [0.0; 16];
        for (place, influence) in influences.iter().enumerate() {
            for (sum, number) in sum.iter_mut().zip(matrix(influence.joint).0) {
                let term = number * influence.weight;
                *sum = if place == 0 { term } else { *sum + term };
            }
        }
        Self(sum)
    }

    /// The linear part.
    pub(super) fn linear(&self) -> Mat3A {
        let m = &self.0;
        Mat3A::from_cols(Vec3A::new(m[0], m[4], m[8]), Vec3A::new(m[1], m[5], m[9]), Vec3A::new(m[2], m[6], m[10]))
    }
}

/// The inverse transpose times the determinant's size: turns normals as the matrix turns the surface, mirrored or not.
pub(super) fn cofactor(m: &Mat3A) -> Mat3A {
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    let matrix = Mat3A::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if matrix.x_axis.dot(x) < 0.0 { matrix * -1.0 } else { matrix }
}

/// What is bent, and by what. All lists of vertices have the same length.
pub(super) struct DeformJob<'a> {
    /// Which matrices move which vertex.
    pub(super) plan: &'a SkinningPlan,
    /// The matrices that the plan picks from.
    pub(super) matrices: &'a [Affine],
    /// Whether a matrix scales unevenly, so that normals need the inverse transpose.
    pub(super) uneven: bool,
    /// The shape before.
    pub(super) from: (&'a [Vec3], &'a [Vec3]),
    /// Positions and normals after.
    pub(super) to: (&'a mut [Vec3], &'a mut [Vec3]),
    /// The box round the new positions; a coordinate that is no number is left out of it.
    pub(super) bounds: Bounds,
}

kernel! {
    /// Bends all vertices of the task.
    pub(super) fn deform(job: &mut DeformJob<'_>) = deform_with
}

#[inline(always)]
fn deform_with<L: Simd>(l: L, job: &mut DeformJob<'_>) {
    if job.uneven { deform_groups::<L, true>(l, job) } else { deform_groups::<L, false>(l, job) }
}

#[inline(always)]
fn deform_groups<L: Simd, const NONUNIFORM: bool>(l: L, job: &mut DeformJob<'_>) {
    let (positions, normals) = job.from;
    let (to_positions, to_normals) = (&mut *job.to.0, &mut *job.to.1);
    let count = positions.len();
    assert!(normals.len() == count && to_positions.len() == count && to_normals.len() == count && job.plan.vertices() == count);
    assert!(job.plan.matrix_count() <= job.matrices.len());
    let mut bounds = ([l.splat(f32::INFINITY); 3], [l.splat(f32::NEG_INFINITY); 3]);
    let mut blended = [Affine::default(); GROUP];
    for (first, picks) in job.plan.groups() {
        // SAFETY: the plan's indices are below `matrix_count`, which was compared above.
        unsafe { blend_group(l, job.matrices, picks, &mut blended) };
        if let (Some(positions), Some(normals)) = (positions[first..].first_chunk(), normals[first..].first_chunk())
            && let (Some(to_positions), Some(to_normals)) = (to_positions[first..].first_chunk_mut(), to_normals[first..].first_chunk_mut())
        {
            transform_group::<L, NONUNIFORM>(l, &blended, [positions, normals], [to_positions, to_normals], &mut bounds);
            continue;
        }
        // Places beyond the end repeat the last vertex, as the plan does, so that they change nothing in the box.
        let padded = |list: &[Vec3]| -> [Vec3; GROUP] { std::array::from_fn(|i| list[(first + i).min(count - 1)]) };
        let [mut p, mut n] = [[Vec3::ZERO; GROUP]; 2];
        transform_group::<L, NONUNIFORM>(l, &blended, [&padded(positions), &padded(normals)], [&mut p, &mut n], &mut bounds);
        to_positions[first..].copy_from_slice(&p[..count - first]);
        to_normals[first..].copy_from_slice(&n[..count - first]);
    }
    // A zero loses its sign, which would depend on the order of the comparisons.
    let ends = always!(|vectors: [L::F; 3], pick: fn(f32, f32) -> f32| {
        let coordinates = map(
            vectors,
            always!(|vector| {
                let mut lanes = [0.0; 16];
                l.store(vector, &mut lanes);
                lanes[..L::N].iter().copied().reduce(pick).unwrap_or(0.0) + 0.0
            }),
        );
        Vec3::from_array(coordinates)
    });
    job.bounds = Bounds { min: ends(bounds.0, f32::min), max: ends(bounds.1, f32::max) };
}

/// `Σ wᵢ Mᵢ` for each vertex of a group; `picks` holds equally many for each.
///
/// # Safety
/// All picks name one of `matrices`.
#[inline(always)]
unsafe fn blend_group<L: Simd>(l: L, matrices: &[Affine], picks: &[WeightedMatrixRef], blended: &mut [Affine; GROUP]) {
    // SAFETY: the caller's promise; a count that is known lets the compiler lay the sum out in a row.
    unsafe {
        match picks.len() / GROUP {
            1 => blend_each(l, matrices, picks, 1, blended),
            2 => blend_each(l, matrices, picks, 2, blended),
            3 => blend_each(l, matrices, picks, 3, blended),
            4 => blend_each(l, matrices, picks, 4, blended),
            many => blend_each(l, matrices, picks, many, blended),
        }
    }
}

/// # Safety
/// All picks name one of `matrices`.
#[inline(always)]
unsafe fn blend_each<L: Simd>(l: L, matrices: &[Affine], picks: &[WeightedMatrixRef], count: usize, blended: &mut [Affine; GROUP]) {
    for (sum, picks) in blended.iter_mut().zip(picks.chunks_exact(count)) {
        let (first, rest) = picks.split_at(1);
        for part in (0..16).step_by(L::N) {
            let term = always!(|pick: &WeightedMatrixRef| {
                // SAFETY: the caller's promise.
                let matrix = unsafe { pick.of(matrices) };
                l.load(&matrix.0[part..]) * l.splat(pick.weight)
            });
            let mut total = term(&first[0]);
            for pick in rest {
                total = total + term(pick);
            }
            l.store(total, &mut sum.0[part..]);
        }
    }
}

/// Transforms a group: positions and normals of `from` into those of `to`.
#[inline(always)]
fn transform_group<L: Simd, const NONUNIFORM: bool>(
    l: L,
    blended: &[Affine; GROUP],
    from: [&[Vec3; GROUP]; 2],
    to: [&mut [Vec3; GROUP]; 2],
    bounds: &mut ([L::F; 3], [L::F; 3]),
) {
    let [from_positions, from_normals] = from.map(|list| bytemuck::cast_slice::<Vec3, [f32; 3]>(list));
    let [to_positions, to_normals] = to.map(|list| bytemuck::cast_slice_mut::<Vec3, [f32; 3]>(list));
    for part in (0..GROUP).step_by(L::N) {
        let first = blended[part..part + L::N].as_ptr().cast::<f32>();
        // SAFETY: a matrix has 16 floats, of which three times four are read.
        let [x, y, z] = unsafe { each::<_, 3>(always!(|k| l.quads(first.add(k * 4), 16))) };
        let (position, normal) = (l.triples(&from_positions[part..]), l.triples(&from_normals[part..]));
        let rows = map([x, y, z], always!(|m: [L::F; 4]| [m[0], m[1], m[2]]));
        let rows = if NONUNIFORM { cofactors(l, rows) } else { rows };
        let turned = map(rows, always!(|row: [L::F; 3]| dot(row, normal)));
        let square = dot(turned, turned);
        // Roots and quotients take long: the positions are worked on meanwhile.
        let scale = l.splat(1.0) / l.sqrt(square);
        let moved = map([x, y, z], always!(|m: [L::F; 4]| m[0] * position[0] + m[1] * position[1] + m[2] * position[2] + m[3]));
        // Keeps the old value where the new one is no number.
        bounds.0 = each(always!(|k| l.min(moved[k], bounds.0[k])));
        bounds.1 = each(always!(|k| l.max(moved[k], bounds.1[k])));
        l.set_triples(moved, &mut to_positions[part..]);
        let good = l.lt(l.splat(0.0), square) & l.lt(square, l.splat(f32::INFINITY));
        let up = [0.0, 1.0, 0.0];
        l.set_triples(each(always!(|k| l.select(good, turned[k] * scale, l.splat(up[k])))), &mut to_normals[part..]);
    }
}

/// [`cofactor`] of many, by rows: the cofactors of a transposed matrix are the transposed cofactors.
#[inline(always)]
fn cofactors<L: Simd>(l: L, [x, y, z]: [[L::F; 3]; 3]) -> [[L::F; 3]; 3] {
    let (a, b, c) = (cross(y, z), cross(z, x), cross(x, y));
    let mirrored = l.lt(dot(a, x), l.splat(0.0));
    let sign = l.select(mirrored, l.splat(-1.0), l.splat(1.0));
    map([a, b, c], always!(|column: [L::F; 3]| map(column, always!(|x| x * sign))))
}

#[inline(always)]
fn cross<F: Copy + Mul<Output = F> + Sub<Output = F>>(a: [F; 3], b: [F; 3]) -> [F; 3] {
    [a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]]
}

#[inline(always)]
fn dot<F: Copy + Mul<Output = F> + Add<Output = F>>(a: [F; 3], b: [F; 3]) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;
    use proptest::prelude::*;
    use sinew_scene::{Mesh, Skin, SkinJoint};
    use sinew_simd::SimdLevel;

    /// Bends by `level` and returns positions, normals and box.
    fn bent(level: SimdLevel, plan: &SkinningPlan, matrices: &[Affine], uneven: bool, shape: &[Vec3]) -> (Vec<Vec3>, Vec<Vec3>, Bounds) {
        let (mut positions, mut normals) = (vec![Vec3::NAN; shape.len()], vec![Vec3::NAN; shape.len()]);
        let to = (positions.as_mut_slice(), normals.as_mut_slice());
        let mut job = DeformJob { plan, matrices, uneven, from: (shape, shape), to, bounds: Bounds::EMPTY };
        deform(level, &mut job);
        let bounds = job.bounds;
        (positions, normals, bounds)
    }

    fn affine() -> impl Strategy<Value = Affine> {
        prop::array::uniform16(-3.0..3.0f32).prop_map(Affine)
    }

    proptest! {
        #[test]
        fn every_width_gives_the_same_bits_and_they_are_the_formula(
            matrices in prop::collection::vec(affine(), 6), uneven: bool,
            points in prop::collection::vec(prop::collection::vec((-1..6i32, 0.0..1.0f32), 0..8), 1..70),
            shape in prop::collection::vec(prop::array::uniform3(-2.0..2.0f32), 70),
        ) {
            let joints = vec![SkinJoint { name: String::new(), inverse_bind: DMat4::IDENTITY }; 4];
            let mut skin = Skin { offsets: vec![0], joints, ..Skin::default() };
            for point in &points {
                skin.influences.extend(point.iter().map(|(joint, weight)| Influence { joint: *joint, weight: *weight }));
                skin.offsets.push(skin.influences.len() as u32);
            }
            let source_count = points.len() as u32;
            let shape: Vec<Vec3> = shape.iter().take(points.len()).map(|p| Vec3::from_array(*p)).collect();
            let source_vertex = (0..source_count).rev().collect();
            let mesh = Mesh { positions: shape.clone(), source_vertex, source_count, ..Mesh::default() };
            let plan = SkinningPlan::of_skin(&skin, &mesh);
            let bits = |v: &[Vec3]| v.iter().map(|v| v.to_array().map(f32::to_bits)).collect::<Vec<_>>();
            let plain = bent(SimdLevel::Scalar(sinew_simd::Scalar), &plan, &matrices, uneven, &shape);
            for level in SimdLevel::all() {
                let wide = bent(level, &plan, &matrices, uneven, &shape);
                prop_assert_eq!((bits(&plain.0), bits(&plain.1), plain.2), (bits(&wide.0), bits(&wide.1), wide.2), "{}", level.name());
            }
            // In double precision, straight from the skin.
            for (v, (position, normal)) in plain.0.iter().zip(&plain.1).enumerate() {
                let of = |index: usize| DMat4::from_cols_array(&matrices[index].0.map(f64::from)).transpose();
                let influences = skin.influences_of(points.len() - 1 - v);
                let mut sum = DMat4::ZERO;
                for Influence { joint, weight } in influences {
                    sum += of(if (0..4).contains(joint) { *joint as usize } else { 5 }) * f64::from(*weight);
                }
                if influences.is_empty() {
                    sum = of(4);
                }
                let (linear, shift) = (DMat3::from_mat4(sum), sum.w_axis.truncate());
                prop_assert!((linear * shape[v].as_dvec3() + shift - position.as_dvec3()).length() < 1e-4);
                let turn = if uneven { linear.inverse().transpose() * linear.determinant().abs() } else { linear };
                let exact = turn * shape[v].as_dvec3();
                // Nearly nothing has no direction.
                if exact.length() > 0.1 && linear.determinant().abs() > 1e-2 {
                    prop_assert!((exact.normalize() - normal.as_dvec3()).length() < 1e-3, "{exact} {normal}");
                }
            }
        }
    }

    #[test]
    fn a_normal_that_vanishes_points_up_and_a_coordinate_that_is_no_number_stays_out_of_the_box() {
        let mesh = Mesh { positions: vec![Vec3::ONE; 2], source_vertex: vec![0; 2], source_count: 1, ..Mesh::default() };
        for level in SimdLevel::all() {
            let (_, normals, bounds) = bent(level, &SkinningPlan::of_points(&mesh), &[Affine::default()], false, &[Vec3::ONE, Vec3::NAN]);
            assert_eq!(normals, [Vec3::Y; 2]);
            assert_eq!((bounds.min, bounds.max), (Vec3::ZERO, Vec3::ZERO));
        }
    }
}
