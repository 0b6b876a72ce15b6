//! The model's own transform: what the tools Move, Rotate and Scale change, as opposed to the camera.

use glam::{DMat4, DQuat, DVec3, EulerRot};

/// Translation, rotation and scale of the whole model about its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelTransform {
    /// Metres.
    pub translation: DVec3,
    /// A unit quaternion.
    pub rotation: DQuat,
    /// Above 0.
    pub scale: f64,
    /// Fixed point of rotation and scale, metres: the middle of the model at rest.
    pub pivot: DVec3,
}

impl Default for ModelTransform {
    fn default() -> Self {
        Self { translation: DVec3::ZERO, rotation: DQuat::IDENTITY, scale: 1.0, pivot: DVec3::ZERO }
    }
}

impl ModelTransform {
    /// Smallest scale; the largest is its inverse.
    pub const MIN_SCALE: f64 = 1e-3;

    /// As a matrix, applied after everything in the file.
    pub fn matrix(&self) -> DMat4 {
        DMat4::from_scale_rotation_translation(DVec3::splat(self.scale), self.rotation, self.pivot + self.translation)
            * DMat4::from_translation(-self.pivot)
    }

    /// Whether it leaves everything where it is.
    pub fn is_identity(&self) -> bool {
        *self == Self { pivot: self.pivot, ..Self::default() }
    }

    /// Back to where the file has it.
    pub fn reset(&mut self) {
        *self = Self { pivot: self.pivot, ..Self::default() };
    }

    /// Translates by metres.
    pub fn translate(&mut self, by: DVec3) {
        if by.is_finite() {
            self.translation += by;
        }
    }

    /// Rotates by radians about an axis, world.
    pub fn rotate(&mut self, axis: DVec3, radians: f64) {
        if let Some(axis) = axis.try_normalize()
            && radians.is_finite()
        {
            self.rotation = (DQuat::from_axis_angle(axis, radians) * self.rotation).normalize();
        }
    }

    /// Multiplies the scale, within its limits.
    pub fn scale_by(&mut self, factor: f64) {
        self.set_scale(self.scale * factor);
    }

    /// Sets the scale, within its limits.
    pub fn set_scale(&mut self, scale: f64) {
        if scale.is_finite() && scale > 0.0 {
            self.scale = scale.clamp(Self::MIN_SCALE, 1.0 / Self::MIN_SCALE);
        }
    }

    /// Rotation about X, then Y, then Z (world axes), degrees.
    pub fn degrees(&self) -> DVec3 {
        let (z, y, x) = self.rotation.to_euler(EulerRot::ZYX);
        DVec3::new(x, y, z) * (180.0 / std::f64::consts::PI)
    }

    /// Sets the rotation from degrees about X, Y, Z.
    pub fn set_degrees(&mut self, degrees: DVec3) {
        if degrees.is_finite() {
            let radians = degrees * (std::f64::consts::PI / 180.0);
            self.rotation = DQuat::from_euler(EulerRot::ZYX, radians.z, radians.y, radians.x).normalize();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_and_scaling_keep_the_middle() {
        let mut model = ModelTransform { pivot: DVec3::new(1.0, 2.0, 3.0), ..ModelTransform::default() };
        model.rotate(DVec3::Y, 1.0);
        model.rotate(DVec3::X, -0.4);
        model.scale_by(3.0);
        assert!((model.matrix().transform_point3(model.pivot) - model.pivot).length() < 1e-12);
        model.translate(DVec3::X);
        assert!((model.matrix().transform_point3(model.pivot) - model.pivot - DVec3::X).length() < 1e-12);
        assert!(!model.is_identity());
        model.reset();
        assert!(model.is_identity() && model.pivot.y == 2.0);
        assert_eq!(model.matrix(), DMat4::IDENTITY);
    }

    #[test]
    fn degrees_come_back() {
        let mut model = ModelTransform::default();
        let degrees = DVec3::new(20.0, -35.0, 110.0);
        model.set_degrees(degrees);
        assert!((model.degrees() - degrees).length() < 1e-9);
        let about_y = ModelTransform { rotation: DQuat::from_rotation_y(0.5), ..ModelTransform::default() };
        assert!((about_y.degrees() - DVec3::new(0.0, 0.5_f64.to_degrees(), 0.0)).length() < 1e-9);
    }

    #[test]
    fn senseless_numbers_change_nothing() {
        let mut model = ModelTransform::default();
        model.translate(DVec3::NAN);
        model.rotate(DVec3::ZERO, 1.0);
        model.rotate(DVec3::X, f64::INFINITY);
        model.set_scale(-1.0);
        model.scale_by(f64::NAN);
        model.set_degrees(DVec3::INFINITY);
        assert!(model.is_identity());
        model.scale_by(1e300);
        assert_eq!(model.scale, 1e3);
    }
}
