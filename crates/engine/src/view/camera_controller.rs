//! The camera of the window: orbit, free flight or a camera of the file, with animated transitions between views.

use glam::{Quat, Vec3};

use super::file_camera;
use sinew_scene::{Bounds, Camera, CameraId, Frame, NodeId, OrbitCamera, Projection, Scene, ViewDirection};

/// Seconds that a jump of the camera takes.
const ANIMATION_SECONDS: f64 = 0.15;

/// A fly camera: rotates freely and moves along its view direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlyCamera {
    /// Where the eye is, metres.
    pub eye: Vec3,
    /// Degrees round +Y, as the orbit's.
    pub yaw: f32,
    /// Degrees below the horizon, −90 to 90, as the orbit's.
    pub pitch: f32,
    /// Metres a second.
    pub speed: f32,
}

impl FlyCamera {
    /// Turns by degrees.
    pub fn rotate(&mut self, yaw: f32, pitch: f32) {
        self.yaw = (self.yaw + yaw).rem_euclid(360.0);
        self.pitch = (self.pitch + pitch).clamp(-90.0, 90.0);
    }

    /// Moves for `seconds` along (right, up, into the picture).
    pub fn move_by(&mut self, direction: Vec3, seconds: f32) {
        let offset = self.rotation() * Vec3::new(direction.x, direction.y, -direction.z) * self.speed * seconds;
        if offset.is_finite() {
            self.eye += offset;
        }
    }

    fn rotation(&self) -> Quat {
        Quat::from_rotation_y(self.yaw.to_radians()) * Quat::from_rotation_x(-self.pitch.to_radians())
    }
}

/// The active camera.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Viewpoint {
    /// Round the model.
    #[default]
    Orbit,
    /// Free flight.
    Fly(FlyCamera),
    /// A camera of the file, on its node.
    File(NodeId, CameraId),
}

/// A jump under way.
#[derive(Debug, Clone, Copy, PartialEq)]
struct CameraAnimation {
    from: OrbitCamera,
    to: OrbitCamera,
    seconds: f64,
}

/// The camera of the window.
#[derive(Debug, Clone, Default)]
pub struct CameraController {
    /// The orbit; during an animated transition its end is in `animation`.
    orbit: OrbitCamera,
    viewpoint: Viewpoint,
    animation: Option<CameraAnimation>,
    /// Whether jumps are eased; the desktop may ask for no animation.
    pub animated: bool,
}

impl CameraController {
    /// The orbit as it stands.
    pub fn orbit(&self) -> &OrbitCamera {
        &self.orbit
    }

    /// The active camera.
    pub fn viewpoint(&self) -> Viewpoint {
        self.viewpoint
    }

    /// Changes the orbit at once, for interaction. An animation ends; flight and file cameras are left.
    pub fn change(&mut self, change: impl FnOnce(&mut OrbitCamera)) {
        self.animation = None;
        self.viewpoint = Viewpoint::Orbit;
        change(&mut self.orbit);
    }

    /// Jumps to what `change` makes of the orbit, eased where that is wanted.
    pub fn animate_to(&mut self, change: impl FnOnce(&mut OrbitCamera)) {
        let mut to = self.animation.map_or(self.orbit, |animation| animation.to);
        change(&mut to);
        self.viewpoint = Viewpoint::Orbit;
        if self.animated {
            // The yaw takes the short way round.
            let mut from = self.orbit;
            from.yaw = to.yaw + (from.yaw - to.yaw + 180.0).rem_euclid(360.0) - 180.0;
            from.scene_radius = to.scene_radius;
            from.orthographic = to.orthographic;
            self.animation = Some(CameraAnimation { from, to, seconds: 0.0 });
        } else {
            self.animation = None;
            self.orbit = to;
        }
    }

    /// Moves the orbit, and the target of an animation, by metres of the world; this is no interaction.
    pub fn move_by(&mut self, offset: Vec3) {
        self.orbit.target += offset;
        if let Some(animation) = &mut self.animation {
            animation.from.target += offset;
            animation.to.target += offset;
        }
    }

    /// Lets time go by for a jump; whether anything moved.
    pub fn advance(&mut self, seconds: f64) -> bool {
        let Some(animation) = &mut self.animation else { return false };
        animation.seconds += seconds;
        let part = (animation.seconds / ANIMATION_SECONDS).clamp(0.0, 1.0) as f32;
        let part = part * part * (3.0 - 2.0 * part);
        let (from, to) = (animation.from, animation.to);
        self.orbit = OrbitCamera {
            target: from.target.lerp(to.target, part),
            yaw: from.yaw + (to.yaw - from.yaw) * part,
            pitch: from.pitch + (to.pitch - from.pitch) * part,
            distance: from.distance * (to.distance / from.distance).powf(part),
            ..to
        };
        if part >= 1.0 {
            self.orbit = to;
            self.animation = None;
        }
        true
    }

    /// Whether a jump is under way.
    pub fn is_animating(&self) -> bool {
        self.animation.is_some()
    }

    /// Jumps so that `bounds` fill a picture of this aspect.
    pub fn fit(&mut self, bounds: &Bounds, aspect: f32) {
        self.animate_to(|orbit| orbit.fit(bounds, aspect));
    }

    /// Jumps to a named direction.
    pub fn look_from(&mut self, view: ViewDirection) {
        self.animate_to(|orbit| orbit.look_from(view));
    }

    /// Takes off from where the eye is; where rays were parallel, from where they meet with the middle as large as it was.
    pub fn fly(&mut self) {
        self.orbit.orthographic = false;
        let camera = self.orbit.camera();
        self.animation = None;
        self.viewpoint = Viewpoint::Fly(FlyCamera {
            eye: camera.eye,
            yaw: self.orbit.yaw,
            pitch: self.orbit.pitch,
            speed: self.orbit.scene_radius.max(1e-6),
        });
    }

    /// The flying camera, to move it.
    pub fn flying(&mut self) -> Option<&mut FlyCamera> {
        match &mut self.viewpoint {
            Viewpoint::Fly(fly) => Some(fly),
            Viewpoint::Orbit | Viewpoint::File(..) => None,
        }
    }

    /// Lands: the orbit goes on from where the flight ended, round a point ahead.
    pub fn exit_fly(&mut self) {
        if let Viewpoint::Fly(fly) = self.viewpoint {
            let ahead = fly.rotation() * Vec3::NEG_Z;
            self.orbit.target = fly.eye + ahead * self.orbit.distance;
            (self.orbit.yaw, self.orbit.pitch) = (fly.yaw, fly.pitch);
            self.viewpoint = Viewpoint::Orbit;
        }
    }

    /// Looks through a camera of the file.
    pub fn look_through(&mut self, node: NodeId, camera: CameraId) {
        self.animation = None;
        self.viewpoint = Viewpoint::File(node, camera);
    }

    /// Puts the orbit, under what it is at present, where `camera` looks from, with the same size of what is as far ahead as `middle`, the middle of the
    /// scene. The turntable has no roll: the horizon becomes level.
    pub fn place_at(&mut self, camera: &Camera, middle: Vec3) {
        let (right, back) = (camera.rotation * Vec3::X, camera.rotation * Vec3::Z);
        let ahead = (middle - camera.eye).dot(camera.forward());
        let depth = if ahead.is_finite() && ahead > 0.0 { ahead } else { self.orbit.scene_radius };
        let half = (OrbitCamera::FOV_Y * 0.5).tan();
        let (distance, orthographic) = match camera.projection {
            Projection::Perspective { fov_y } => (depth * (fov_y * 0.5).tan() / half, false),
            Projection::Orthographic { height } => (height * 0.5 / half, true),
        };
        if !(distance.is_finite() && distance > 0.0) {
            return;
        }
        // Straight up and down nothing is behind but what is beside still tells the yaw.
        let upright = back.y.abs() > 0.9999;
        let yaw = if upright { (-right.z).atan2(right.x) } else { back.x.atan2(back.z) };
        self.orbit = OrbitCamera {
            target: camera.eye + camera.forward() * depth,
            yaw: yaw.to_degrees(),
            pitch: back.y.clamp(-1.0, 1.0).asin().to_degrees(),
            orthographic,
            ..self.orbit
        };
        self.orbit.distance = distance;
        self.orbit.zoom(1.0);
        self.animation = None;
    }

    /// The camera to draw with.
    pub fn camera(&self, scene: &Scene, frame: &Frame) -> Camera {
        self.fixed_camera(scene, frame).unwrap_or_else(|| self.orbit.camera())
    }

    /// The camera of a flight or of the file; `None` where the orbit is looked from, also for a camera of the file that is not usable.
    pub(super) fn fixed_camera(&self, scene: &Scene, frame: &Frame) -> Option<Camera> {
        match self.viewpoint {
            Viewpoint::Orbit => None,
            Viewpoint::Fly(fly) => Some(Camera { eye: fly.eye, rotation: fly.rotation(), ..self.flight_planes(&fly) }),
            Viewpoint::File(node, id) => file_camera(scene, frame, node, id),
        }
    }

    fn flight_planes(&self, fly: &FlyCamera) -> Camera {
        let radius = self.orbit.scene_radius.max(1e-9);
        let far = (fly.eye - self.orbit.target).length() + radius * 12.0;
        let projection = Projection::Perspective { fov_y: OrbitCamera::FOV_Y };
        Camera { eye: fly.eye, rotation: Quat::IDENTITY, projection, near: (radius * 0.002).max(far * 1e-5), far }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_ends_exactly_where_it_should_and_turns_the_short_way() {
        let mut eye = CameraController { animated: true, ..CameraController::default() };
        eye.change(|orbit| orbit.yaw = 350.0);
        eye.look_from(ViewDirection::Front);
        eye.advance(ANIMATION_SECONDS / 2.0);
        assert!(eye.orbit().yaw < 0.0 && eye.orbit().yaw > -10.0, "{}", eye.orbit().yaw);
        assert!(eye.advance(1.0) && !eye.advance(1.0));
        assert_eq!((eye.orbit().yaw, eye.orbit().pitch), (0.0, 0.0));
    }

    #[test]
    fn without_animation_a_jump_is_at_once() {
        let mut eye = CameraController::default();
        eye.look_from(ViewDirection::Top);
        assert_eq!(eye.orbit().pitch, 90.0);
        assert!(!eye.is_animating());
    }

    #[test]
    fn the_orbit_goes_on_from_where_a_camera_looks() {
        // Any orbit's own camera is taken over as it is, whatever the orbit was before.
        for (yaw, pitch, distance, orthographic) in
            [(200.0, -30.0, 3.0, false), (-75.0, 89.0, 0.7, false), (40.0, 90.0, 2.0, false), (130.0, 20.0, 5.0, true)]
        {
            let target = Vec3::new(1.0, 2.0, -0.5);
            let wanted = OrbitCamera { target, yaw, pitch, distance, orthographic, scene_radius: 1.0 };
            let camera = wanted.camera();
            let mut eye = CameraController::default();
            eye.place_at(&camera, target);
            let taken = eye.orbit().camera();
            assert!(taken.rotation.angle_between(camera.rotation) < 2e-3, "{wanted:?}: {:?}", eye.orbit());
            assert!((eye.orbit().target - target).length() < 1e-3 && (eye.orbit().distance - distance).abs() < 1e-3, "{:?}", eye.orbit());
            assert_eq!(eye.orbit().orthographic, orthographic);
        }
    }

    #[test]
    fn another_field_of_view_keeps_the_size_of_the_middle() {
        let fov_y = 1.2_f32;
        let projection = Projection::Perspective { fov_y };
        let camera = Camera { eye: Vec3::new(0.0, 1.0, 6.0), rotation: Quat::from_rotation_z(0.4), projection, near: 0.1, far: 100.0 };
        let mut eye = CameraController::default();
        eye.place_at(&camera, Vec3::ZERO);
        let seen = 2.0 * 6.0 * (fov_y * 0.5).tan();
        let shown = 2.0 * eye.orbit().distance * (OrbitCamera::FOV_Y * 0.5).tan();
        assert!((seen - shown).abs() < 1e-4 && (eye.orbit().target - Vec3::new(0.0, 1.0, 0.0)).length() < 1e-5);
        // Level, though the camera was rolled.
        assert!((eye.orbit().camera().rotation * Vec3::X).y.abs() < 1e-6);
    }

    #[test]
    fn a_flight_from_parallel_rays_begins_with_the_middle_as_large_as_it_was() {
        let (scene, frame) = (Scene::default(), Frame::default());
        let mut eye = CameraController::default();
        eye.change(|orbit| (orbit.orthographic, orbit.distance) = (true, 5.0));
        let seen = eye.camera(&scene, &frame).height_at(eye.orbit().target);
        eye.fly();
        assert!((eye.camera(&scene, &frame).height_at(eye.orbit().target) - seen).abs() < 1e-4 * seen);
        eye.exit_fly();
        assert!((eye.camera(&scene, &frame).height_at(eye.orbit().target) - seen).abs() < 1e-4 * seen);
    }

    #[test]
    fn landing_keeps_what_one_sees() {
        let (scene, frame) = (Scene::default(), Frame::default());
        let mut eye = CameraController::default();
        eye.change(|orbit| orbit.orbit(20.0, 10.0));
        let before = eye.camera(&scene, &frame);
        eye.fly();
        let flying = eye.camera(&scene, &frame);
        assert!((flying.eye - before.eye).length() < 1e-5 && flying.rotation.angle_between(before.rotation) < 1e-3);
        let fly = eye.flying().expect("it flies");
        fly.move_by(Vec3::new(0.5, 0.2, 1.0), 0.5);
        fly.rotate(33.0, -12.0);
        let there = eye.camera(&scene, &frame);
        eye.exit_fly();
        let landed = eye.camera(&scene, &frame);
        assert!((landed.eye - there.eye).length() < 1e-4 && landed.rotation.angle_between(there.rotation) < 1e-3);
    }
}
