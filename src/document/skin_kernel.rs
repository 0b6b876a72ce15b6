//! The two inner loops of skinning: blend a palette, transform vertices.
//!
//! Each loop is one plain function, compiled a second and third time for wider vectors and chosen at run time. The arithmetic and its order
//! are the same in all (no fused multiply-add), so every width gives the same bits.

use glam::{DMat4, Mat3A, Vec3, Vec3A, Vec4};

use crate::scene::{Bounds, Skin};

/// An affine matrix as four columns of four, so that a whole matrix fills one cache line. The fourth lane means nothing.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(64))]
pub(super) struct Columns([f32; 16]);

impl Columns {
    /// From a matrix; its bottom row is left out.
    pub(super) fn of(matrix: &DMat4) -> Self {
        Self(matrix.as_mat4().to_cols_array())
    }

    /// From a linear part and a translation.
    pub(super) fn from_parts(linear: Mat3A, translation: Vec3) -> Self {
        let (x, y, z, t) = (linear.x_axis.to_array(), linear.y_axis.to_array(), linear.z_axis.to_array(), translation.to_array());
        Self([x[0], x[1], x[2], 0.0, y[0], y[1], y[2], 0.0, z[0], z[1], z[2], 0.0, t[0], t[1], t[2], 1.0])
    }

    /// The four columns.
    #[inline(always)]
    fn vectors(&self) -> [Vec3A; 4] {
        let column = |i: usize| Vec3A::from_vec4(Vec4::new(self.0[i], self.0[i + 1], self.0[i + 2], self.0[i + 3]));
        [column(0), column(4), column(8), column(12)]
    }

    /// The linear part.
    #[inline(always)]
    pub(super) fn linear(&self) -> Mat3A {
        let m = &self.0;
        Mat3A::from_cols(Vec3A::new(m[0], m[1], m[2]), Vec3A::new(m[4], m[5], m[6]), Vec3A::new(m[8], m[9], m[10]))
    }
}

/// The inverse transpose times the determinant's size: turns normals as the matrix turns the surface, mirrored or not.
#[inline(always)]
pub(super) fn cofactor(m: &Mat3A) -> Mat3A {
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    let matrix = Mat3A::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if matrix.x_axis.dot(x) < 0.0 { matrix * -1.0 } else { matrix }
}

/// Compiles `$body` for the baseline, AVX2 and AVX-512 and defines `$name` to run the widest that this machine has.
macro_rules! for_every_width {
    ($(#[$doc:meta])* $name:ident => $body:ident ( $($argument:ident : $type:ty),* ) $(-> $result:ty)?) => {
        $(#[$doc])*
        #[allow(unsafe_code)]
        pub(super) fn $name($($argument: $type),*) $(-> $result)? {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx512f,avx512vl,avx512dq")]
                fn avx512($($argument: $type),*) $(-> $result)? { $body($($argument),*) }
                #[target_feature(enable = "avx2")]
                fn avx2($($argument: $type),*) $(-> $result)? { $body($($argument),*) }
                let wide = is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl") && is_x86_feature_detected!("avx512dq");
                if wide {
                    // SAFETY: the processor has just said that it knows these instructions.
                    return unsafe { avx512($($argument),*) };
                }
                if is_x86_feature_detected!("avx2") {
                    // SAFETY: as above.
                    return unsafe { avx2($($argument),*) };
                }
            }
            $body($($argument),*)
        }
    };
}

for_every_width! {
    /// Appends one blended matrix a point: `Σ wᵢ joints[jᵢ]`, `loose` for a point without influences, `bind` for an influence of no joint.
    blend => blend_body(skin: &Skin, points: usize, joints: &[Columns], loose: &Columns, bind: &Columns, blended: &mut Vec<Columns>)
}

#[inline(always)]
fn blend_body(skin: &Skin, points: usize, joints: &[Columns], loose: &Columns, bind: &Columns, blended: &mut Vec<Columns>) {
    blended.reserve(points);
    for range in skin.offsets.windows(2).take(points) {
        let influences = skin.influences.get(range[0] as usize..range[1] as usize).unwrap_or(&[]);
        let Some((first, rest)) = influences.split_first() else {
            blended.push(*loose);
            continue;
        };
        // −1 becomes a number far beyond the joints.
        let of = |joint: i32| joints.get(joint as usize).unwrap_or(bind);
        let mut sum = Columns::default();
        let matrix = of(first.joint);
        for lane in 0..16 {
            sum.0[lane] = matrix.0[lane] * first.weight;
        }
        for influence in rest {
            let matrix = of(influence.joint);
            for lane in 0..16 {
                sum.0[lane] += matrix.0[lane] * influence.weight;
            }
        }
        blended.push(sum);
    }
}

for_every_width! {
    /// Transforms positions and normals in place, each vertex by the matrix of its point, and returns the box round the positions.
    transform => transform_body(
        blended: &[Columns], loose: &Columns, source: &[u32], uneven: bool, positions: &mut [Vec3], normals: &mut [Vec3]
    ) -> Bounds
}

/// Vertices that are worked on together, so that the square roots and divisions of their normals run side by side.
const TOGETHER: usize = 16;

#[inline(always)]
fn transform_body(
    blended: &[Columns],
    loose: &Columns,
    source: &[u32],
    uneven: bool,
    positions: &mut [Vec3],
    normals: &mut [Vec3],
) -> Bounds {
    if uneven {
        transform_with(blended, loose, source, positions, normals, |m, normal| cofactor(&m.linear()) * normal)
    } else {
        transform_with(blended, loose, source, positions, normals, |m, normal| {
            let [x, y, z, _] = m.vectors();
            x * normal.x + y * normal.y + z * normal.z
        })
    }
}

#[inline(always)]
fn transform_with(
    blended: &[Columns],
    loose: &Columns,
    source: &[u32],
    positions: &mut [Vec3],
    normals: &mut [Vec3],
    turn: impl Fn(&Columns, Vec3A) -> Vec3A,
) -> Bounds {
    let (mut min, mut max) = (Vec3A::INFINITY, Vec3A::NEG_INFINITY);
    let groups = positions.chunks_mut(TOGETHER).zip(normals.chunks_mut(TOGETHER)).zip(source.chunks(TOGETHER));
    for ((positions, normals), source) in groups {
        let mut squares = [1.0f32; TOGETHER];
        for (((position, normal), square), source) in positions.iter_mut().zip(normals.iter_mut()).zip(&mut squares).zip(source) {
            let m = blended.get(*source as usize).unwrap_or(loose);
            let [x, y, z, t] = m.vectors();
            let moved = x * position.x + y * position.y + z * position.z + t;
            // Keeps the old value where the new one is no number.
            (min, max) = (moved.min(min), moved.max(max));
            *position = moved.into();
            let turned = turn(m, Vec3A::from(*normal));
            *normal = turned.into();
            *square = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z;
        }
        let mut scales = [0.0f32; TOGETHER];
        for (scale, square) in scales.iter_mut().zip(&squares) {
            *scale = 1.0 / square.sqrt();
        }
        for (normal, scale) in normals.iter_mut().zip(&scales) {
            *normal = if scale.is_finite() { *normal * *scale } else { Vec3::Y };
        }
    }
    Bounds { min: min.into(), max: max.into() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Influence;
    use proptest::prelude::*;

    fn columns() -> impl Strategy<Value = Columns> {
        prop::array::uniform16(-3.0..3.0f32).prop_map(Columns)
    }

    proptest! {
        #[test]
        fn every_width_gives_the_bits_of_the_plain_loop(
            joints in prop::collection::vec(columns(), 1..5), loose in columns(), bind in columns(), uneven: bool,
            points in prop::collection::vec(prop::collection::vec((-1..6i32, 0.0..1.0f32), 0..6), 1..70),
            shape in prop::collection::vec(prop::array::uniform3(-2.0..2.0f32), 70),
        ) {
            let mut skin = Skin { offsets: vec![0], ..Skin::default() };
            for point in &points {
                skin.influences.extend(point.iter().map(|(joint, weight)| Influence { joint: *joint, weight: *weight }));
                skin.offsets.push(skin.influences.len() as u32);
            }
            let (mut plain, mut wide) = (Vec::new(), Vec::new());
            blend_body(&skin, points.len(), &joints, &loose, &bind, &mut plain);
            blend(&skin, points.len(), &joints, &loose, &bind, &mut wide);
            prop_assert_eq!(plain.iter().map(|m| m.0).collect::<Vec<_>>(), wide.iter().map(|m| m.0).collect::<Vec<_>>());
            let source: Vec<u32> = (0..points.len() as u32).rev().collect();
            let at: Vec<Vec3> = shape.iter().take(points.len()).map(|p| Vec3::from_array(*p)).collect();
            let (mut p1, mut n1, mut p2, mut n2) = (at.clone(), at.clone(), at.clone(), at);
            let one = transform_body(&plain, &loose, &source, uneven, &mut p1, &mut n1);
            let two = transform(&wide, &loose, &source, uneven, &mut p2, &mut n2);
            let bits = |v: &[Vec3]| v.iter().map(|v| v.to_array().map(f32::to_bits)).collect::<Vec<_>>();
            prop_assert_eq!((bits(&p1), bits(&n1), one), (bits(&p2), bits(&n2), two));
        }
    }

    #[test]
    fn a_normal_that_vanishes_points_up_and_a_coordinate_that_is_no_number_stays_out_of_the_box() {
        let flat = Columns::default();
        let (mut positions, mut normals) = ([Vec3::ONE, Vec3::NAN], [Vec3::X; 2]);
        let bounds = transform(&[flat], &flat, &[0, 0], false, &mut positions, &mut normals);
        assert_eq!(normals, [Vec3::Y; 2]);
        assert_eq!((bounds.min, bounds.max), (Vec3::ZERO, Vec3::ZERO));
    }
}
