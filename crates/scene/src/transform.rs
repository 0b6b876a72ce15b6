//! Local transforms: a list of operations, composed in order, as COLLADA writes them.

use glam::{DMat3, DMat4, DQuat, DVec3};

/// One step of a local transform. Angles are degrees, as in the file, so that an animated angle can turn more than once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TransformOp {
    /// Moves by this vector.
    Translate(DVec3),
    /// Turns round `axis` (any length; a zero axis turns nothing) by `angle` degrees.
    Rotate {
        /// Axis of the turn.
        axis: DVec3,
        /// Degrees, right-handed.
        angle: f64,
    },
    /// Stretches along the axes.
    Scale(DVec3),
    /// Any matrix.
    Matrix(DMat4),
    /// Places the node at `eye`, its −Z towards `target`, +Y towards `up`.
    LookAt {
        /// Position of the node.
        eye: DVec3,
        /// Point that −Z looks at.
        target: DVec3,
        /// Direction that +Y leans to.
        up: DVec3,
    },
    /// Shear: moves points along `along` in proportion to how far they lie in the direction of `across`.
    Skew {
        /// Degrees that the direction `across` leans over.
        angle: f64,
        /// Direction along which points move, any length: the first vector of COLLADA's `skew`.
        along: DVec3,
        /// Direction that the shift grows with, any length: the second one.
        across: DVec3,
    },
}

impl TransformOp {
    /// The operation as a matrix. Never panics; parts that have no direction leave things as they are.
    pub fn matrix(&self) -> DMat4 {
        match *self {
            Self::Translate(by) => DMat4::from_translation(by),
            Self::Rotate { axis, angle } => match axis.try_normalize() {
                Some(axis) => DMat4::from_quat(DQuat::from_axis_angle(axis, angle.to_radians())),
                None => DMat4::IDENTITY,
            },
            Self::Scale(by) => DMat4::from_scale(by),
            Self::Matrix(matrix) => matrix,
            Self::LookAt { eye, target, up } => look_at(eye, target, up),
            Self::Skew { angle, along, across } => skew(angle, along, across),
        }
    }
}

/// A matrix with a bottom row of 0 0 0 1: all that places something in space has that row, whatever a file says.
pub fn affine(mut matrix: DMat4) -> DMat4 {
    matrix.x_axis.w = 0.0;
    matrix.y_axis.w = 0.0;
    matrix.z_axis.w = 0.0;
    matrix.w_axis.w = 1.0;
    matrix
}

fn look_at(eye: DVec3, target: DVec3, up: DVec3) -> DMat4 {
    let Some(forward) = (target - eye).try_normalize() else {
        return DMat4::from_translation(eye);
    };
    let side = forward.cross(up).try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
    let up = side.cross(forward);
    DMat4::from_cols(side.extend(0.0), up.extend(0.0), (-forward).extend(0.0), eye.extend(1.0))
}

/// `v′ = v + tan(angle) â (b̂·v)` with â = `along`, b̂ = `across`.
///
/// The schema's prose takes the two vectors the other way round; the pictures of Khronos' conformance suite and the exporters that write the element
/// (ColladaMaya, OpenCOLLADA) agree on this one.
fn skew(angle: f64, along: DVec3, across: DVec3) -> DMat4 {
    let (Some(along), Some(across)) = (along.try_normalize(), across.try_normalize()) else {
        return DMat4::IDENTITY;
    };
    let (sin, cos) = angle.to_radians().sin_cos();
    // A right angle would move everything to infinity.
    if !cos.is_finite() || cos.abs() < 1e-9 {
        return DMat4::IDENTITY;
    }
    let shift = along * (sin / cos);
    DMat4::from_mat3(DMat3::from_cols(DVec3::X + shift * across.x, DVec3::Y + shift * across.y, DVec3::Z + shift * across.z))
}

/// A node's local transform: operations in document order, composed left to right (`M = T₁ T₂ … Tₙ`).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Transform {
    /// The operations.
    pub ops: Vec<TransformOp>,
}

impl Transform {
    /// A transform of one matrix.
    pub fn from_matrix(matrix: DMat4) -> Self {
        Self { ops: vec![TransformOp::Matrix(matrix)] }
    }

    /// Translation, rotation, scale, in that order of writing.
    pub fn from_trs(translation: DVec3, rotation: DQuat, scale: DVec3) -> Self {
        Self { ops: vec![TransformOp::Matrix(DMat4::from_scale_rotation_translation(scale, rotation, translation))] }
    }

    /// A translation alone.
    pub fn from_translation(translation: DVec3) -> Self {
        Self { ops: vec![TransformOp::Translate(translation)] }
    }

    /// The whole as one matrix.
    pub fn matrix(&self) -> DMat4 {
        compose(&self.ops)
    }
}

/// Composes operations in order.
pub fn compose(ops: &[TransformOp]) -> DMat4 {
    match ops {
        [] => DMat4::IDENTITY,
        [only] => only.matrix(),
        [first, rest @ ..] => rest.iter().fold(first.matrix(), |matrix, op| matrix * op.matrix()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: DVec3, b: DVec3) {
        assert!((a - b).length() < 1e-12, "{a} is not {b}");
    }

    #[test]
    fn operations_compose_in_document_order() {
        let transform = Transform {
            ops: vec![
                TransformOp::Translate(DVec3::new(1.0, 2.0, 3.0)),
                TransformOp::Rotate { axis: DVec3::new(0.0, 0.0, 5.0), angle: 90.0 },
                TransformOp::Scale(DVec3::splat(2.0)),
            ],
        };
        near(transform.matrix().transform_point3(DVec3::X), DVec3::new(1.0, 4.0, 3.0));
    }

    #[test]
    fn look_at_places_the_eye_and_points_minus_z_at_the_target() {
        let op = TransformOp::LookAt { eye: DVec3::new(1.0, 0.0, 0.0), target: DVec3::new(1.0, 0.0, 5.0), up: DVec3::Y };
        near(op.matrix().transform_point3(DVec3::ZERO), DVec3::X);
        near(op.matrix().transform_vector3(DVec3::NEG_Z), DVec3::Z);
    }

    #[test]
    fn skew_moves_points_along_its_first_vector_in_proportion_to_the_second() {
        let op = TransformOp::Skew { angle: 45.0, along: DVec3::X * 3.0, across: DVec3::Z * 0.5 };
        near(op.matrix().transform_vector3(DVec3::Z), DVec3::new(1.0, 0.0, 1.0));
        near(op.matrix().transform_vector3(DVec3::X), DVec3::X);
        near(op.matrix().transform_vector3(DVec3::Y), DVec3::Y);
        let steep = TransformOp::Skew { angle: -60.0, along: DVec3::Y, across: DVec3::X };
        near(steep.matrix().transform_vector3(DVec3::X), DVec3::new(1.0, -3_f64.sqrt(), 0.0));
        // Vectors that are not at right angles stretch along the first.
        let slanted = TransformOp::Skew { angle: 45.0, along: DVec3::X, across: DVec3::new(1.0, 1.0, 0.0) };
        near(slanted.matrix().transform_vector3(DVec3::Y), DVec3::new(0.5_f64.sqrt(), 1.0, 0.0));
    }

    #[test]
    fn directions_that_are_none_do_nothing() {
        assert_eq!(TransformOp::Rotate { axis: DVec3::ZERO, angle: 30.0 }.matrix(), DMat4::IDENTITY);
        for (angle, along) in [(30.0, DVec3::ZERO), (90.0, DVec3::X), (-270.0, DVec3::X), (f64::NAN, DVec3::X)] {
            assert_eq!(TransformOp::Skew { angle, along, across: DVec3::Y }.matrix(), DMat4::IDENTITY, "{angle}");
        }
    }
}
