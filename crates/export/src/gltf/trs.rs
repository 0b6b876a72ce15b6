//! Local transforms as glTF wants them: translation, rotation, scale.

use glam::{DMat3, DMat4, DQuat, DVec3};
use serde_json::{Value, json};

/// How far from square the axes of a matrix may be before it counts as sheared (cosine of the angle between them).
const SQUARE: f64 = 1e-5;

/// A local transform without shear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placing {
    pub translation: DVec3,
    pub rotation: DQuat,
    pub scale: DVec3,
}

impl Placing {
    /// The parts of a matrix and whether shear was lost. A mirror goes into the x scale.
    pub(super) fn of(matrix: &DMat4) -> (Self, bool) {
        let axes = DMat3::from_mat4(*matrix);
        let lengths = [axes.x_axis, axes.y_axis, axes.z_axis].map(DVec3::length);
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let unit = |axis: DVec3, length: f64| if length > longest * 1e-9 { axis.try_normalize() } else { None };
        let given = [unit(axes.x_axis, lengths[0]), unit(axes.y_axis, lengths[1]), unit(axes.z_axis, lengths[2])];
        let dot = |a: Option<DVec3>, b: Option<DVec3>| a.zip(b).map_or(0.0, |(a, b)| a.dot(b).abs());
        let sheared = dot(given[0], given[1]).max(dot(given[1], given[2])).max(dot(given[2], given[0])) > SQUARE;
        // Axes without a length take what the others leave free.
        let x = given[0].unwrap_or_else(|| match (given[1], given[2]) {
            (Some(y), Some(z)) => y.cross(z).normalize_or(y.any_orthonormal_vector()),
            (Some(axis), None) | (None, Some(axis)) => axis.any_orthonormal_vector(),
            (None, None) => DVec3::X,
        });
        let y = given[1].or_else(|| given[2].map(|z| z.cross(x))).unwrap_or_else(|| x.any_orthonormal_vector());
        let y = (y - x * x.dot(y)).normalize_or(x.any_orthonormal_vector());
        let mirror = if given[2].is_some_and(|z| x.cross(y).dot(z) < 0.0) { -1.0 } else { 1.0 };
        let x = x * mirror;
        let rotation = DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y))).normalize();
        let scale = DVec3::new(lengths[0] * mirror, lengths[1], lengths[2]);
        (Self { translation: matrix.w_axis.truncate(), rotation, scale }, sheared)
    }

    /// Interpolation from `self` to `to` as a glTF player does it: linear, rotations along the shorter arc.
    pub(super) fn between(&self, to: &Self, part: f64) -> Self {
        let end = if self.rotation.dot(to.rotation) < 0.0 { -to.rotation } else { to.rotation };
        Self {
            translation: self.translation.lerp(to.translation, part),
            rotation: self.rotation.slerp(end, part),
            scale: self.scale.lerp(to.scale, part),
        }
    }

    /// Writes the parts that are not those of a node without a transform.
    pub(super) fn write(&self, node: &mut Value) {
        if self.translation != DVec3::ZERO {
            node["translation"] = json!(self.translation.as_vec3().to_array());
        }
        if self.rotation != DQuat::IDENTITY {
            node["rotation"] = json!(self.rotation.normalize().as_quat().normalize().to_array());
        }
        if self.scale != DVec3::ONE {
            node["scale"] = json!(self.scale.as_vec3().to_array());
        }
    }
}

/// Splits a linear map into `U · S · Vᵀ`, so that two nodes, one under the other, can stand for it: the outer one `U · S`, the inner one `Vᵀ`.
///
/// `V` diagonalises `MᵀM`; found by Jacobi's rotations (G. Golub, C. Van Loan, "Matrix computations", section 8.5).
pub(super) fn split(matrix: &DMat4) -> (Placing, Placing) {
    let linear = DMat3::from_mat4(*matrix);
    let mut square = linear.transpose() * linear;
    let mut v = DMat3::IDENTITY;
    for _ in 0..32 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off = square.col(q)[p];
            if off == 0.0 {
                continue;
            }
            let angle = 0.5 * (2.0 * off).atan2(square.col(q)[q] - square.col(p)[p]);
            let (sin, cos) = angle.sin_cos();
            let mut turn = DMat3::IDENTITY;
            turn.col_mut(p)[p] = cos;
            turn.col_mut(p)[q] = -sin;
            turn.col_mut(q)[p] = sin;
            turn.col_mut(q)[q] = cos;
            square = turn.transpose() * square * turn;
            v *= turn;
        }
    }
    let mut outer = DMat4::from_mat3(linear * v);
    outer.w_axis = matrix.w_axis;
    let inner = Placing { translation: DVec3::ZERO, rotation: DQuat::from_mat3(&v.transpose()).normalize(), scale: DVec3::ONE };
    (Placing::of(&outer).0, inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(placing: &Placing) -> DMat4 {
        DMat4::from_scale_rotation_translation(placing.scale, placing.rotation, placing.translation)
    }

    fn near(a: &DMat4, b: &DMat4) {
        assert!(a.abs_diff_eq(*b, 1e-9), "{a} is not {b}");
    }

    #[test]
    fn parts_make_the_matrix_again_also_mirrored_or_flat() {
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 2.0);
        for scale in [DVec3::ONE, DVec3::new(2.0, -3.0, 0.5), DVec3::new(0.0, 1.0, 2.0), DVec3::new(1.0, 2.0, 0.0), DVec3::ZERO] {
            let whole = DMat4::from_scale_rotation_translation(scale, turn, DVec3::new(1.0, 2.0, 3.0));
            let (placing, sheared) = Placing::of(&whole);
            assert!(!sheared);
            near(&matrix(&placing), &whole);
        }
    }

    #[test]
    fn a_sheared_matrix_is_two_nodes() {
        let shear = DMat4::from_cols_array(&[1.0, 0.2, 0.0, 0.0, 0.7, 2.0, 0.1, 0.0, -0.3, 0.4, 1.5, 0.0, 5.0, 6.0, 7.0, 1.0]);
        assert!(Placing::of(&shear).1);
        let (outer, inner) = split(&shear);
        near(&(matrix(&outer) * matrix(&inner)), &shear);
    }
}
