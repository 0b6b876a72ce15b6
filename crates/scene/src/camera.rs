//! Cameras: a posed camera, the cameras of files, and the interactive orbit camera.

use glam::camera::rh::proj::directx;
use glam::{Mat4, Quat, Vec2, Vec3, Vec4};

use super::{Bounds, Label, Unnamed};

/// Projection of camera space onto the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Vertical field of view, radians.
    Perspective {
        /// Radians, between 0 and π.
        fov_y: f32,
    },
    /// Parallel rays; height of the picture in metres.
    Orthographic {
        /// Metres.
        height: f32,
    },
}

/// A camera of the file, in its node's space: looks along −Z, +Y up.
#[derive(Debug, Clone, PartialEq)]
pub struct FileCamera {
    /// The name in its file; empty where it has none.
    pub name: String,
    /// The id in the file.
    pub id: String,
    /// Its projection; orthographic heights are in the file's unit.
    pub projection: Projection,
    /// Width over height, where the file says.
    pub aspect: Option<f32>,
    /// Near plane, in the file's unit.
    pub near: f32,
    /// Far plane, in the file's unit.
    pub far: f32,
}

impl FileCamera {
    /// What it is called.
    pub fn label(&self) -> Label<'_> {
        Label::of(&self.name, Unnamed::Camera)
    }
}

/// A camera in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Position of the camera, metres.
    pub eye: Vec3,
    /// Rotation from camera space (right, up, towards the viewer) to the world.
    pub rotation: Quat,
    /// Perspective or parallel.
    pub projection: Projection,
    /// Near plane, metres from the eye; above 0 for perspective.
    pub near: f32,
    /// Far plane, metres from the eye.
    pub far: f32,
}

impl Camera {
    /// World to camera space.
    pub fn view(&self) -> Mat4 {
        Mat4::from_rotation_translation(self.rotation, self.eye).inverse()
    }

    /// Camera to clip space, depth from 0 (near) to 1 (far), for a picture `aspect` = width / height.
    pub fn projection_matrix(&self, aspect: f32) -> Mat4 {
        let aspect = if aspect.is_finite() && aspect > 0.0 { aspect } else { 1.0 };
        match self.projection {
            Projection::Perspective { fov_y } => directx::perspective(fov_y, aspect, self.near, self.far),
            Projection::Orthographic { height } => {
                let (x, y) = (height * aspect * 0.5, height * 0.5);
                directx::orthographic(-x, x, -y, y, self.near, self.far)
            }
        }
    }

    /// World to clip space.
    pub fn view_projection(&self, aspect: f32) -> Mat4 {
        self.projection_matrix(aspect) * self.view()
    }

    /// Where a world point falls on a picture of `size` pixels (x right, y down) and its depth from 0 to 1; `None` behind the eye.
    pub fn project(&self, point: Vec3, size: Vec2) -> Option<Vec3> {
        let clip: Vec4 = self.view_projection(size.x / size.y) * point.extend(1.0);
        (clip.w > 0.0 && clip.is_finite()).then(|| {
            let ndc = clip.truncate() / clip.w;
            Vec3::new((ndc.x + 1.0) * 0.5 * size.x, (1.0 - ndc.y) * 0.5 * size.y, ndc.z)
        })
    }

    /// The world point under `pixel` (x right, y down) at `depth` from 0 to 1, the inverse of [`Camera::project`].
    pub fn unproject(&self, pixel: Vec2, depth: f32, size: Vec2) -> Vec3 {
        let ndc = Vec3::new(pixel.x / size.x * 2.0 - 1.0, 1.0 - pixel.y / size.y * 2.0, depth);
        self.view_projection(size.x / size.y).inverse().project_point3(ndc)
    }

    /// An orthographic camera moved back until all of `bounds` lies in front of it; the picture stays the same. A perspective camera is unchanged.
    pub fn moved_back(mut self, bounds: &Bounds) -> Self {
        if matches!(self.projection, Projection::Orthographic { .. }) && !bounds.is_empty() {
            let forward = self.forward();
            let nearest = bounds.corners().iter().map(|corner| (*corner - self.eye).dot(forward)).fold(f32::INFINITY, f32::min);
            let back = (self.near - nearest) * 1.01;
            if back.is_finite() && back > 0.0 {
                self.eye -= forward * back;
                self.far += back;
            }
        }
        self
    }

    /// Direction to the right of the picture.
    pub fn right(&self) -> Vec3 {
        self.rotation * Vec3::X
    }

    /// Direction to the top of the picture.
    pub fn up(&self) -> Vec3 {
        self.rotation * Vec3::Y
    }

    /// Direction into the picture.
    pub fn forward(&self) -> Vec3 {
        self.rotation * Vec3::NEG_Z
    }

    /// Height in metres that the picture spans at the distance of `point`.
    pub fn height_at(&self, point: Vec3) -> f32 {
        match self.projection {
            Projection::Perspective { fov_y } => 2.0 * (point - self.eye).dot(self.forward()).max(self.near) * (fov_y * 0.5).tan(),
            Projection::Orthographic { height } => height,
        }
    }
}

/// A named view direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ViewDirection {
    /// From +Z.
    Front,
    /// From −Z.
    Back,
    /// From +X.
    Right,
    /// From −X.
    Left,
    /// From +Y.
    Top,
    /// From −Y.
    Bottom,
    /// From the upper right front, all axes alike.
    Iso,
    /// The start view: a little from above and the side.
    Start,
}

impl ViewDirection {
    /// Yaw and pitch, degrees, as [`OrbitCamera`] has them.
    pub fn angles(self) -> (f32, f32) {
        match self {
            Self::Front => (0.0, 0.0),
            Self::Back => (180.0, 0.0),
            Self::Right => (90.0, 0.0),
            Self::Left => (-90.0, 0.0),
            Self::Top => (0.0, 90.0),
            Self::Bottom => (0.0, -90.0),
            Self::Iso => (45.0, 35.264_39),
            Self::Start => (30.0, 18.0),
        }
    }
}

/// A camera that orbits a target point, without roll.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrbitCamera {
    /// The point it looks at.
    pub target: Vec3,
    /// Degrees round +Y; 0 = from +Z, 90 = from +X.
    pub yaw: f32,
    /// Degrees above the horizon, −90 to 90.
    pub pitch: f32,
    /// Metres from the target.
    pub distance: f32,
    /// Orthographic projection, with the same size as perspective at the target.
    pub orthographic: bool,
    /// Radius of the scene, metres: sets near and far planes and the limits of the zoom.
    pub scene_radius: f32,
}

impl Default for OrbitCamera {
    fn default() -> Self {
        let (yaw, pitch) = ViewDirection::Start.angles();
        Self { target: Vec3::ZERO, yaw, pitch, distance: 4.0, orthographic: false, scene_radius: 1.0 }
    }
}

impl OrbitCamera {
    /// Vertical field of view, radians.
    pub const FOV_Y: f32 = 35.0 * std::f32::consts::PI / 180.0;

    /// Looks at `bounds` from the present direction, near enough that it fills a picture of `aspect` = width / height.
    pub fn fit(&mut self, bounds: &Bounds, aspect: f32) {
        self.target = bounds.center();
        let radius = bounds.diagonal() * 0.5;
        self.scene_radius = if radius.is_finite() && radius > 1e-9 { radius } else { 1.0 };
        let aspect = if aspect.is_finite() && aspect > 0.0 { aspect } else { 1.0 };
        if bounds.is_empty() || radius <= 1e-9 {
            self.distance = self.scene_radius * 4.0;
            return;
        }
        // The smallest distance at which every corner of the box is inside the picture, with a margin.
        let tan_y = (Self::FOV_Y * 0.5).tan() * 0.88;
        let tan_x = tan_y * aspect;
        let rotation = self.rotation();
        let (right, up, back) = (rotation * Vec3::X, rotation * Vec3::Y, rotation * Vec3::Z);
        self.distance = bounds
            .corners()
            .iter()
            .map(|corner| {
                let offset = *corner - self.target;
                let (x, y, z) = (offset.dot(right).abs(), offset.dot(up).abs(), offset.dot(back));
                if self.orthographic { (x / tan_x).max(y / tan_y) } else { z + (x / tan_x).max(y / tan_y) }
            })
            .fold(self.scene_radius * 0.05, f32::max);
    }

    /// Sets yaw and pitch to a named view direction.
    pub fn look_from(&mut self, view: ViewDirection) {
        (self.yaw, self.pitch) = view.angles();
    }

    /// Orbits by degrees; the pitch stops at the poles.
    pub fn orbit(&mut self, yaw: f32, pitch: f32) {
        self.yaw = (self.yaw + yaw).rem_euclid(360.0);
        self.pitch = (self.pitch + pitch).clamp(-90.0, 90.0);
    }

    /// Moves the target with the picture plane by a part of the picture's height.
    pub fn pan(&mut self, right: f32, up: f32) {
        let height = 2.0 * self.distance * (Self::FOV_Y * 0.5).tan();
        let rotation = self.rotation();
        self.target += (rotation * Vec3::X * right + rotation * Vec3::Y * up) * height;
    }

    /// Divides the distance by `factor` (2 = twice as near), within what the near and far planes allow.
    pub fn zoom(&mut self, factor: f32) {
        if factor.is_finite() && factor > 0.0 {
            self.distance = (self.distance / factor).clamp(self.scene_radius * 1e-3, self.scene_radius * 1e3);
        }
    }

    fn rotation(&self) -> Quat {
        Quat::from_rotation_y(self.yaw.to_radians()) * Quat::from_rotation_x(-self.pitch.to_radians())
    }

    /// The camera.
    pub fn camera(&self) -> Camera {
        let rotation = self.rotation();
        let (distance, radius) = (self.distance.max(1e-6), self.scene_radius.max(1e-9));
        let projection = if self.orthographic {
            Projection::Orthographic { height: 2.0 * distance * (Self::FOV_Y * 0.5).tan() }
        } else {
            Projection::Perspective { fov_y: Self::FOV_Y }
        };
        // A parallel camera stands far enough away that nothing of the scene is behind it.
        let eye_distance = if self.orthographic { distance + radius * 10.0 } else { distance };
        let far = eye_distance + radius * 12.0;
        let near = if self.orthographic { 0.0 } else { (distance * 0.02).min(radius * 0.02).max(far * 1e-5) };
        Camera { eye: self.target + rotation * Vec3::Z * eye_distance, rotation, projection, near, far }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fitting_keeps_every_corner_inside() {
        let bounds = Bounds { min: Vec3::new(-3.0, 0.0, -0.2), max: Vec3::new(1.0, 2.0, 0.4) };
        let size = Vec2::new(800.0, 600.0);
        for orthographic in [false, true] {
            for view in [ViewDirection::Front, ViewDirection::Right, ViewDirection::Top, ViewDirection::Iso, ViewDirection::Start] {
                let mut orbit = OrbitCamera { orthographic, ..OrbitCamera::default() };
                orbit.look_from(view);
                orbit.fit(&bounds, size.x / size.y);
                for corner in bounds.corners() {
                    let p = orbit.camera().project(corner, size).expect("in front of the eye");
                    assert!(p.x > 0.0 && p.x < size.x && p.y > 0.0 && p.y < size.y && p.z > 0.0 && p.z < 1.0, "{view:?} {p}");
                }
            }
        }
    }

    #[test]
    fn unproject_undoes_project() {
        let camera = OrbitCamera::default().camera();
        let size = Vec2::new(640.0, 480.0);
        let point = Vec3::new(0.3, -0.2, 0.1);
        let pixel = camera.project(point, size).expect("in front of the eye");
        assert!((camera.unproject(pixel.truncate(), pixel.z, size) - point).length() < 1e-3);
    }

    #[test]
    fn yaw_and_pitch_go_where_they_say() {
        let mut orbit = OrbitCamera { target: Vec3::ZERO, distance: 2.0, ..OrbitCamera::default() };
        for (view, eye) in [(ViewDirection::Front, Vec3::Z), (ViewDirection::Right, Vec3::X), (ViewDirection::Top, Vec3::Y)] {
            orbit.look_from(view);
            assert!((orbit.camera().eye - eye * 2.0).length() < 1e-5, "{view:?}");
        }
    }
}
