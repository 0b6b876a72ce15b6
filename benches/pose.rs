//! Posing and skinning: nanoseconds a vertex, beside copying the same bytes in the same run.

mod support;

use std::hint::black_box;
use std::sync::Arc;

use glam::{DMat4, DVec3, Vec3};
use sinew::document::{Document, PoseBuffers, PoseState, Skinning};
use sinew::scene::{
    Content, Deformer, Frame, Influence, Mesh, MeshId, MeshInstance, Node, NodeKind, Scene, Skin, SkinId, SkinJoint, Transform,
};

const VERTICES: usize = 20_000;
const JOINTS: usize = 32;

/// 20,000 vertices, each its own point, with four influences of 32 joints in a chain.
fn skinned() -> Document {
    let mut scene = Scene::default();
    let mut parent = None;
    let mut bones = Vec::new();
    for i in 0..JOINTS {
        let turn = DMat4::from_rotation_z(0.1 * i as f64) * DMat4::from_translation(DVec3::Y * 0.1);
        let id = scene.graph.add(parent, Node::new("joint").with_kind(NodeKind::Joint).with_transform(Transform::from_matrix(turn)));
        bones.push(Some(id));
        parent = Some(id);
    }
    let positions: Vec<Vec3> = (0..VERTICES).map(|i| Vec3::new((i % 100) as f32, (i / 100) as f32, 0.5) * 0.01).collect();
    let mut skin = Skin { bind_shape: DMat4::IDENTITY, ..Skin::default() };
    skin.joints =
        (0..JOINTS).map(|i| SkinJoint { name: i.to_string(), inverse_bind: DMat4::from_translation(DVec3::Y * i as f64 * -0.1) }).collect();
    skin.offsets = (0..=VERTICES as u32).map(|i| i * 4).collect();
    let weights = [0.4, 0.3, 0.2, 0.1];
    skin.influences = (0..VERTICES * 4).map(|i| Influence { joint: ((i / 4 * 7 + i) % JOINTS) as i32, weight: weights[i % 4] }).collect();
    let mesh = Mesh {
        normals: vec![Vec3::Z; VERTICES],
        source_vertex: (0..VERTICES as u32).collect(),
        source_count: VERTICES as u32,
        positions,
        ..Mesh::default()
    };
    scene.meshes.push(Arc::new(mesh));
    scene.skins.push(skin);
    let instance =
        MeshInstance { mesh: MeshId(0), deformers: vec![Deformer::Skin { skin: SkinId(0), joints: bones }], materials: Vec::new() };
    scene.graph.add(None, Node::new("skin").with_content(Content::Mesh(instance)));
    let mut document = Document::default();
    document.scene = scene;
    document.touch();
    document
}

fn main() {
    let document = skinned();
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let copy = support::copy_time(VERTICES * 24);
    for (name, skinning) in [("linear blend", Skinning::Linear), ("dual quaternions", Skinning::DualQuaternion)] {
        let state = PoseState { skinning, ..PoseState::default() };
        let time = support::median(|| document.pose(black_box(&state), &mut buffers, &mut frame));
        let each = time * 1e9 / VERTICES as f64;
        println!("skinning, {name}, 4 influences, position and normal: {each:.2} ns a vertex, {:.1} × copying the bytes", time / copy);
    }
}
