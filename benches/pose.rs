//! Posing and skinning: nanoseconds a vertex, beside copying the same bytes in the same run.

mod support;

use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;

use glam::{DMat4, DVec3, Vec3};
use sinew::document::{Document, PoseBuffers, PoseState, SkinMotion, Skinning};
use sinew::formats::SCENE_READERS;
use sinew::progress::Progress;
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
    let instance = MeshInstance {
        mesh: MeshId(0),
        deformers: vec![Deformer::Skin { skin: SkinId(0), joints: bones }],
        materials: Vec::new().into(),
        skinned_targets: Vec::new(),
    };
    scene.graph.add(None, Node::new("skin").with_content(Content::Mesh(instance)));
    let mut document = Document::default();
    document.scene = scene;
    document.bump_revision();
    document
}

/// Skin over muscles: what following them takes on top of the skeleton, over the range of the joint.
fn following(path: &Path) {
    let Ok(document) = Document::open(&[path], SCENE_READERS, &Progress::default()) else { return };
    let Some(joint) = document.joint() else { return };
    let median = |skin| {
        let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
        let mut times = Vec::new();
        for step in 0..600 {
            let share = f64::from(step) * 0.618_034 % 1.0;
            let turn = joint.absolute(joint.range[0] + share * (joint.range[1] - joint.range[0]));
            let state = PoseState { skin, ..PoseState::default().with_rotation(Some(turn)) };
            document.pose(&state, &mut buffers, &mut frame);
            times.push(buffers.times().deform_ms);
        }
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let took = median(SkinMotion::FollowsMuscles) - median(SkinMotion::Skeleton);
    let bound = document.bound_vertices();
    println!(
        "{}: {took:.3} ms for {bound} vertices that follow muscles, {:.2} µs each",
        path.file_name().unwrap_or_default().display(),
        1e3 * took / bound.max(1) as f64
    );
}

/// A figure as an exporter wrote it, at moments all over its clip: the time of the deformation alone, so that its few vertices don't carry the bones.
fn figure(path: &Path) {
    let Ok(document) = Document::open(&[path], SCENE_READERS, &Progress::default()) else { return };
    let (mut buffers, mut frame, mut state) = (PoseBuffers::default(), Frame::default(), document.start_state());
    let length = document.clips.first().map_or(0.0, |clip| clip.duration());
    let mut times = Vec::new();
    for step in 0..2_000 {
        state.time = f64::from(step) * 0.618_034 % 1.0 * length;
        document.pose(&state, &mut buffers, &mut frame);
        times.push(buffers.times().deform_ms);
    }
    times.sort_by(f64::total_cmp);
    let vertices: usize = document.scene.meshes.iter().map(|mesh| mesh.positions.len()).sum();
    let points: u32 = document.scene.meshes.iter().map(|mesh| mesh.source_count).sum();
    let influences: usize = document.scene.skins.iter().map(|skin| skin.influences.len()).sum();
    println!(
        "{}, {vertices} vertices of {points} points, {:.1} influences each: {:.2} ns a vertex",
        path.file_name().unwrap_or_default().display(),
        influences as f64 / f64::from(points.max(1)),
        times[times.len() / 2] * 1e6 / vertices.max(1) as f64
    );
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
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let shared = std::env::var_os("SINEW_SHARED").map_or_else(|| root.join("../shared"), Into::into).join("models");
    for name in ["curl-muscles.yaml", "atlas-muscles.yaml"] {
        following(&root.join("configs").join(name));
    }
    figure(&root.join("configs/walker.dae"));
    for name in ["walk.dae", "raptor_attack.dae", "cowboy.dae"] {
        figure(&shared.join(name));
    }
}
