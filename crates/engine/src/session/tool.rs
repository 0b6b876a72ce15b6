//! The tools: what a drag in the viewport does.

use glam::DVec3;

use crate::view::ModelTransform;
use sinew_scene::Camera;

/// What a drag in the viewport moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Tool {
    /// The camera.
    #[default]
    Navigate,
    /// The model, along the picture plane.
    Move,
    /// The model, about its middle.
    Rotate,
    /// The model's size.
    Scale,
}

impl Tool {
    /// All tools, in the order of their buttons.
    pub const ALL: [Self; 4] = [Self::Navigate, Self::Move, Self::Rotate, Self::Scale];

    /// The name that actions use.
    pub fn id(self) -> &'static str {
        match self {
            Self::Navigate => "navigate",
            Self::Move => "move",
            Self::Rotate => "rotate",
            Self::Scale => "scale",
        }
    }

    /// The catalogue's key for what it does to the model.
    pub fn edit(self) -> &'static str {
        match self {
            Self::Navigate => "app-edit-move",
            Self::Move => "app-edit-move",
            Self::Rotate => "app-edit-rotate",
            Self::Scale => "app-edit-scale",
        }
    }

    /// What a drag by parts of the picture's height (right, down) does to the model: moving keeps it under the pointer, a drag over the
    /// whole height turns it by 180° or makes it e² times as large.
    pub fn drag(self, model: &mut ModelTransform, camera: &Camera, dx: f64, dy: f64) {
        let (right, up) = (camera.right().as_dvec3(), camera.up().as_dvec3());
        match self {
            Self::Navigate => {}
            Self::Move => {
                let middle = (model.pivot + model.translation).as_vec3();
                let height = f64::from(camera.height_at(middle));
                model.translate((right * dx - up * dy) * height);
            }
            Self::Rotate => {
                model.rotate(DVec3::Y, dx * std::f64::consts::PI);
                model.rotate(right, dy * std::f64::consts::PI);
            }
            Self::Scale => model.scale_by(((dx - dy) * 2.0).exp()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec2, Vec3};
    use sinew_scene::{OrbitCamera, ViewDirection};

    #[test]
    fn moving_keeps_the_model_under_the_pointer() {
        let mut orbit = OrbitCamera::default();
        orbit.look_from(ViewDirection::Iso);
        let (camera, size) = (orbit.camera(), Vec2::new(900.0, 600.0));
        let mut model = ModelTransform { pivot: DVec3::new(0.3, 0.1, -0.2), ..ModelTransform::default() };
        let at = |model: &ModelTransform| {
            let middle: Vec3 = model.matrix().transform_point3(model.pivot).as_vec3();
            camera.project(middle, size).expect("before the eye").truncate()
        };
        let before = at(&model);
        Tool::Move.drag(&mut model, &camera, 60.0 / 600.0, -30.0 / 600.0);
        assert!((at(&model) - before - Vec2::new(60.0, -30.0)).length() < 0.1);
    }

    #[test]
    fn each_tool_changes_its_own_numbers() {
        let camera = OrbitCamera::default().camera();
        for tool in Tool::ALL {
            let mut model = ModelTransform::default();
            tool.drag(&mut model, &camera, 0.1, 0.05);
            assert_eq!(model.translation != DVec3::ZERO, tool == Tool::Move);
            assert_eq!(model.rotation != glam::DQuat::IDENTITY, tool == Tool::Rotate);
            assert_eq!(model.scale != 1.0, tool == Tool::Scale);
        }
    }
}
