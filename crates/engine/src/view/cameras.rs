//! The cameras of a file.

use sinew_scene::{Camera, CameraId, Content, Frame, Node, NodeId, Projection, Scene};

/// The cameras of the file with the nodes that carry them.
pub fn file_cameras(scene: &Scene) -> Vec<(NodeId, CameraId)> {
    let cameras_of = |node: &Node| -> Vec<CameraId> {
        node.contents.iter().filter_map(|content| if let Content::Camera(id) = content { Some(*id) } else { None }).collect()
    };
    scene.graph.iter().flat_map(|(id, node)| cameras_of(node).into_iter().map(move |camera| (id, camera))).collect()
}

/// A camera of the file in world space; `None` where its node is missing or its numbers are not usable.
pub fn file_camera(scene: &Scene, frame: &Frame, node: NodeId, id: CameraId) -> Option<Camera> {
    let (stored, world) = (scene.cameras.get(id.index())?, frame.world.get(node.index())?);
    let (scale, rotation, eye) = world.to_scale_rotation_translation();
    let unit = scale.abs().max_element() as f32;
    let projection = match stored.projection {
        Projection::Orthographic { height } => Projection::Orthographic { height: height * unit },
        perspective => perspective,
    };
    let camera = Camera {
        eye: eye.as_vec3(),
        rotation: rotation.as_quat().normalize(),
        projection,
        near: stored.near * unit,
        far: stored.far * unit,
    };
    let is_valid =
        camera.eye.is_finite() && camera.rotation.is_finite() && camera.near > 0.0 && camera.far > camera.near && camera.far.is_finite();
    is_valid.then_some(camera)
}

#[cfg(test)]
mod tests {
    use glam::{DMat4, DQuat, DVec3, Vec3};

    use super::*;
    use sinew_scene::FileCamera;

    fn scene(projection: Projection) -> (Scene, NodeId) {
        let mut scene = Scene::default();
        let mut node = Node::new("eye");
        node.contents.push(Content::Camera(CameraId(0)));
        let id = scene.graph.add(None, node);
        scene.cameras.push(FileCamera { name: String::new(), id: String::new(), projection, aspect: None, near: 0.1, far: 100.0 });
        (scene, id)
    }

    #[test]
    fn a_camera_looks_from_its_node_along_minus_z_and_keeps_its_roll() {
        let (scene, id) = scene(Projection::Perspective { fov_y: 0.7 });
        assert_eq!(file_cameras(&scene), [(id, CameraId(0))]);
        let rotation = DQuat::from_rotation_y(0.5) * DQuat::from_rotation_z(0.3);
        let world = DMat4::from_scale_rotation_translation(DVec3::splat(2.0), rotation, DVec3::new(1.0, 2.0, 3.0));
        let frame = Frame { world: vec![world], ..Frame::default() };
        let camera = file_camera(&scene, &frame, id, CameraId(0)).expect("a camera");
        assert!((camera.eye - Vec3::new(1.0, 2.0, 3.0)).length() < 1e-6);
        assert!((camera.forward() - (rotation * DVec3::NEG_Z).as_vec3()).length() < 1e-6);
        assert!((camera.up() - (rotation * DVec3::Y).as_vec3()).length() < 1e-6);
        // Lengths of the file grow with its unit, angles do not.
        assert_eq!((camera.projection, camera.near), (Projection::Perspective { fov_y: 0.7 }, 0.2));
    }

    #[test]
    fn a_camera_without_sense_is_none() {
        let (mut scene, id) = scene(Projection::Orthographic { height: 2.0 });
        let frame = Frame { world: vec![DMat4::IDENTITY], ..Frame::default() };
        assert!(file_camera(&scene, &frame, id, CameraId(0)).is_some());
        assert!(file_camera(&scene, &frame, id, CameraId(7)).is_none());
        scene.cameras[0].near = f32::NAN;
        assert!(file_camera(&scene, &frame, id, CameraId(0)).is_none());
    }
}
