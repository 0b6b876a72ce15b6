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
    /// Shear in the RenderMan form: turns what points along `translation` by `angle` degrees away from `rotation`.
    Skew {
        /// Degrees.
        angle: f64,
        /// Axis that is turned about.
        rotation: DVec3,
        /// Direction along which points move.
        translation: DVec3,
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
            Self::Skew { angle, rotation, translation } => skew(angle, rotation, translation),
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

/// RenderMan's `Skew angle [rotation] [translation]`: in the plane of the two vectors the component along `rotation`'s normal part is kept and
/// points are shifted along `translation` so that the direction of `rotation` turns by `angle` towards it.
fn skew(angle: f64, rotation: DVec3, translation: DVec3) -> DMat4 {
    let (Some(along), Some(from)) = (translation.try_normalize(), rotation.try_normalize()) else {
        return DMat4::IDENTITY;
    };
    let cos = from.dot(along);
    let Some(across) = (from - along * cos).try_normalize() else {
        return DMat4::IDENTITY;
    };
    let sin = from.dot(across);
    let turned = angle.to_radians();
    // Where the tip of `rotation` lands after the turn, seen in (across, along); the shift is linear in the height over the line.
    let (height, lean) = (sin * turned.cos() - cos * turned.sin(), sin * turned.sin() + cos * turned.cos());
    if height.abs() < 1e-12 {
        return DMat4::IDENTITY;
    }
    let slope = lean / height - cos / sin;
    let shear = DMat3::from_cols(
        DVec3::X + along * (slope * across.x),
        DVec3::Y + along * (slope * across.y),
        DVec3::Z + along * (slope * across.z),
    );
    DMat4::from_mat3(shear)
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
    fn skew_turns_the_rotation_vector_by_its_angle_towards_the_translation() {
        let op = TransformOp::Skew { angle: 45.0, rotation: DVec3::Y, translation: DVec3::X };
        near(op.matrix().transform_vector3(DVec3::Y), DVec3::new(1.0, 1.0, 0.0));
        near(op.matrix().transform_vector3(DVec3::X), DVec3::X);
        near(op.matrix().transform_vector3(DVec3::Z), DVec3::Z);
    }

    #[test]
    fn directions_that_are_none_do_nothing() {
        assert_eq!(TransformOp::Rotate { axis: DVec3::ZERO, angle: 30.0 }.matrix(), DMat4::IDENTITY);
        assert_eq!(TransformOp::Skew { angle: 30.0, rotation: DVec3::X, translation: DVec3::X }.matrix(), DMat4::IDENTITY);
    }
}
