//! Bounding box of a pose without its surfaces, for listing what is in a file.

use glam::DMat4;

use super::deform::MeshDeformer;
use super::{Document, PoseBuffers, PoseState};
use sinew_scene::{Bounds, Content, Frame};

impl Document {
    /// The box round all that a moment shows, as [`Document::pose`] finds it. One surface at a time goes through the same buffer, so that it takes no more
    /// memory than the largest.
    pub fn outline(&self, state: &PoseState) -> Bounds {
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        self.prepare_nodes(&mut buffers, &mut frame);
        self.pose_nodes(state, &mut buffers, &mut frame);
        self.solve_muscles(state, &mut buffers, &frame);
        let mut shown = Vec::new();
        self.update_visibility(&mut shown);
        let (mut positions, mut normals) = (Vec::new(), Vec::new());
        let mut bounds = Bounds::EMPTY;
        for (id, node) in self.scene.graph.iter() {
            if !shown.get(id.index()).copied().unwrap_or(true) {
                continue;
            }
            for content in &node.contents {
                let found = match content {
                    Content::Mesh(instance) => {
                        let Some(mesh) = self.scene.meshes.get(instance.mesh.index()) else { continue };
                        if instance.deformers.is_empty() {
                            let matrix = frame.world.get(id.index()).copied().unwrap_or(DMat4::IDENTITY).as_mat4();
                            Bounds::of(mesh.positions.iter().map(|point| matrix.transform_point3(*point)))
                        } else {
                            let mut bender = MeshDeformer::new(&self.scene, instance, mesh);
                            let (weights, into) = (&buffers.pose().morph_weights, (&mut positions, &mut normals));
                            bender.deform(&self.scene, (id, instance), mesh, state, &frame.world, weights, into).0
                        }
                    }
                    Content::Muscle(muscle) => {
                        let (Some((rig, index)), Some(solved)) = (self.muscle(*muscle), buffers.solved().get(muscle.index())) else {
                            continue;
                        };
                        if rig.deform(index, solved, &frame.world, &mut positions, &mut normals).is_none() {
                            continue;
                        }
                        Bounds::of(positions.iter().copied())
                    }
                    Content::Light(_) | Content::Camera(_) => continue,
                };
                bounds.merge(&found);
            }
        }
        if bounds.is_empty() { Bounds::of(frame.joints.iter().map(|joint| frame.position(joint.node))) } else { bounds }
    }
}

#[cfg(test)]
mod tests {
    use crate::document::{Document, PoseBuffers, SceneReaders};
    use sinew_scene::progress::Progress;
    use sinew_scene::{Frame, NodeId};

    #[test]
    fn the_outline_is_the_box_of_the_frame() {
        let open = |names: &[&str]| {
            let files: Vec<String> = names.iter().map(|name| format!("{}/../../configs/{name}", env!("CARGO_MANIFEST_DIR"))).collect();
            Document::open(&files, SceneReaders::TESTED, &Progress::default()).unwrap()
        };
        let mut documents = vec![Document::built_in(), open(&["walker.dae"]), open(&["curl.dae", "example.yaml"])];
        let mut hidden = Document::built_in();
        hidden.scene.graph.node_mut(NodeId(1)).visible = false;
        documents.push(hidden);
        for document in &documents {
            let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
            document.pose(&document.start_state(), &mut buffers, &mut frame);
            assert_eq!(document.outline(&document.start_state()), frame.bounds);
        }
    }
}
