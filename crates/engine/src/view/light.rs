//! The movable light: a direction on a sphere round the scene.

use glam::Vec3;

use sinew_scene::Bounds;

/// Direction from the middle of the scene to the light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightDirection {
    /// Degrees round +Y; 0 = from +Z, 90 = from +X, as the camera's yaw.
    pub yaw: f32,
    /// Degrees above the horizon, −90 to 90.
    pub pitch: f32,
}

impl LightDirection {
    /// High on the left of a camera with this yaw.
    pub fn beside_camera(yaw: f32) -> Self {
        Self { yaw: yaw - 40.0, pitch: 45.0 }
    }

    /// Rotates by degrees; the pitch stops at the poles.
    pub fn rotate(&mut self, yaw: f32, pitch: f32) {
        if yaw.is_finite() && pitch.is_finite() {
            self.yaw = (self.yaw + yaw).rem_euclid(360.0);
            self.pitch = (self.pitch + pitch).clamp(-90.0, 90.0);
        }
    }

    /// Where the light stands, world, metres: well outside of what is shown.
    pub fn position(&self, bounds: &Bounds) -> Vec3 {
        let (sin_yaw, cos_yaw) = self.yaw.to_radians().sin_cos();
        let (sin_pitch, cos_pitch) = self.pitch.to_radians().sin_cos();
        let direction = Vec3::new(sin_yaw * cos_pitch, sin_pitch, cos_yaw * cos_pitch);
        bounds.center() + direction * (bounds.diagonal() * 1.5).max(1e-3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_light_goes_where_the_angles_say() {
        let bounds = Bounds { min: Vec3::splat(-1.0), max: Vec3::splat(1.0) };
        let mut light = LightDirection { yaw: 0.0, pitch: 0.0 };
        let far = bounds.diagonal() * 1.5;
        assert!((light.position(&bounds) - Vec3::Z * far).length() < 1e-4);
        light.rotate(90.0, 0.0);
        assert!((light.position(&bounds) - Vec3::X * far).length() < 1e-4);
        light.rotate(0.0, 400.0);
        assert!((light.position(&bounds) - Vec3::Y * far).length() < 1e-4);
        light.rotate(f32::NAN, 0.0);
        assert_eq!(light.pitch, 90.0);
    }

    #[test]
    fn an_empty_scene_has_a_light_too() {
        assert!(LightDirection::beside_camera(30.0).position(&Bounds::EMPTY).is_finite());
    }
}
