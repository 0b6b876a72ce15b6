//! Posing, skinning and morphing held against a second implementation in f64 and against closed forms.

use std::sync::Arc;

use glam::{DMat4, DQuat, DVec3, Vec3};
use proptest::prelude::*;
use sinew::document::{Document, PoseBuffers, PoseState, Skinning};
use sinew::scene::{
    Content, Deformer, Frame, Influence, Mesh, MeshId, MeshInstance, Morph, MorphId, MorphTarget, Node, NodeId, NodeKind, Part, Scene,
    Skin, SkinId, SkinJoint, SurfaceGeometry, Transform, smooth_normals,
};

/// A grid in the XY plane, `n` × `n` points, one vertex a point.
fn sheet(n: u32) -> Mesh {
    let positions: Vec<Vec3> = (0..n * n).map(|i| Vec3::new((i % n) as f32 / n as f32, (i / n) as f32 / n as f32, 0.0)).collect();
    let mut triangles = Vec::new();
    for y in 0..n - 1 {
        for x in 0..n - 1 {
            let a = y * n + x;
            triangles.extend([[a, a + 1, a + n], [a + 1, a + n + 1, a + n]]);
        }
    }
    let mut normals = Vec::new();
    smooth_normals(&positions, &triangles, |v| v, positions.len(), &mut normals);
    let count = positions.len() as u32;
    let parts = vec![Part { symbol: String::new(), triangles: 0..triangles.len() as u32, lines: 0..0 }];
    Mesh { positions, normals, triangles, parts, source_vertex: (0..count).collect(), source_count: count, ..Mesh::default() }
}

fn document(scene: Scene) -> Document {
    let mut document = Document::default();
    document.scene = scene;
    document.bump_revision();
    document
}

struct Skinned {
    document: Document,
    node: NodeId,
}

/// A sheet on a node, skinned to joints with these (local, inverse bind) matrices, all children of one asset root.
fn skinned(root: DMat4, node: DMat4, bind_shape: DMat4, joints: &[(DMat4, DMat4)], weights: &[Vec<(i32, f32)>]) -> Skinned {
    let mut scene = Scene::default();
    let mesh = sheet(4);
    assert_eq!(mesh.source_count as usize, weights.len());
    let top = scene.graph.add(None, Node::new("asset").with_kind(NodeKind::Asset).with_transform(Transform::from_matrix(root)));
    let mut bone = |local: &DMat4| {
        let node = Node::new("joint").with_kind(NodeKind::Joint).with_transform(Transform::from_matrix(*local));
        Some(scene.graph.add(Some(top), node))
    };
    let bones: Vec<_> = joints.iter().map(|(local, _)| bone(local)).collect();
    let mut skin = Skin { bind_shape, offsets: vec![0], ..Skin::default() };
    skin.joints = joints.iter().map(|(_, inverse_bind)| SkinJoint { name: "j".into(), inverse_bind: *inverse_bind }).collect();
    for point in weights {
        skin.influences.extend(point.iter().map(|(joint, weight)| Influence { joint: *joint, weight: *weight }));
        skin.offsets.push(skin.influences.len() as u32);
    }
    scene.skins.push(skin);
    scene.meshes.push(Arc::new(mesh));
    let deformers = vec![Deformer::Skin { skin: SkinId(0), joints: bones }];
    let instance = MeshInstance { mesh: MeshId(0), deformers, materials: vec![None].into(), skinned_targets: Vec::new() };
    let holder = Node::new("holder").with_transform(Transform::from_matrix(node)).with_content(Content::Mesh(instance));
    let node = scene.graph.add(Some(top), holder);
    Skinned { document: document(scene), node }
}

fn deformed(document: &Document, state: &PoseState) -> (Vec<Vec3>, Vec<Vec3>) {
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    document.pose(state, &mut buffers, &mut frame);
    match &frame.surfaces[0].geometry {
        SurfaceGeometry::Deformed { positions, normals } => (positions.clone(), normals.clone()),
        SurfaceGeometry::Rigid(_) => panic!("the surface is not deformed"),
    }
}

fn dual() -> PoseState {
    PoseState { skinning: Skinning::DualQuaternion, ..PoseState::default() }
}

fn matrix() -> impl Strategy<Value = DMat4> {
    let (number, part) = (-2.0..2.0f64, 0.3..2.0f64);
    (prop::array::uniform3(number), prop::array::uniform4(-1.0..1.0f64), prop::array::uniform3(part)).prop_map(|(t, q, s)| {
        let rotation = DQuat::from_array(q);
        let rotation = if rotation.length() > 1e-3 { rotation.normalize() } else { DQuat::IDENTITY };
        DMat4::from_scale_rotation_translation(DVec3::from_array(s), rotation, DVec3::from_array(t))
    })
}

/// For each of 16 points one to five of three joints, −1 among them, weights adding up to 1.
fn weights() -> impl Strategy<Value = Vec<Vec<(i32, f32)>>> {
    prop::collection::vec(prop::collection::vec((-1..3i32, 0.05..1.0f32), 1..6), 16).prop_map(|points| {
        let normalised = |point: Vec<(i32, f32)>| {
            let sum: f32 = point.iter().map(|(_, weight)| weight).sum();
            point.into_iter().map(|(joint, weight)| (joint, weight / sum)).collect()
        };
        points.into_iter().map(normalised).collect()
    })
}

proptest! {
    #[test]
    fn linear_skinning_agrees_with_the_formula_in_f64(
        root in matrix(), node in matrix(), bind in matrix(), locals in prop::array::uniform3(matrix()),
        binds in prop::array::uniform3(matrix()), weights in weights(),
    ) {
        let joints: Vec<_> = locals.into_iter().zip(binds).collect();
        let model = skinned(root, node, bind, &joints, &weights);
        let (positions, _) = deformed(&model.document, &PoseState::default());
        let mesh = sheet(4);
        for (v, influences) in weights.iter().enumerate() {
            let at = bind.transform_point3(mesh.positions[v].as_dvec3());
            let (mut want, mut size) = (DVec3::ZERO, 1.0f64);
            for (joint, weight) in influences {
                let matrix = usize::try_from(*joint).map_or(root, |joint| root * joints[joint].0 * joints[joint].1);
                want += matrix.transform_point3(at) * f64::from(*weight);
                // Rounding grows with the largest term of the sums.
                size = size.max((matrix * bind).to_cols_array().iter().fold(0.0, |most, x| most.max(x.abs())));
            }
            let error = (positions[v].as_dvec3() - want).length();
            prop_assert!(error <= 4e-6 * size, "vertex {v}: {} is not {want}", positions[v]);
        }
    }

    #[test]
    fn normals_stay_at_right_angles_to_a_surface_that_is_scaled_unevenly(local in matrix(), mirrored: bool) {
        let matrix = if mirrored { local * DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0)) } else { local };
        let everything = vec![vec![(0, 1.0)]; 16];
        let model = skinned(DMat4::IDENTITY, DMat4::IDENTITY, DMat4::IDENTITY, &[(matrix, DMat4::IDENTITY)], &everything);
        let (_, normals) = deformed(&model.document, &PoseState::default());
        let outward = matrix.transform_vector3(DVec3::X).cross(matrix.transform_vector3(DVec3::Y)) * matrix.determinant().signum();
        for normal in normals {
            prop_assert!((normal.length() - 1.0).abs() < 1e-5);
            prop_assert!((normal.as_dvec3() - outward.normalize()).length() < 1e-4, "{normal} is not along {outward}");
        }
    }

    #[test]
    fn one_joint_moves_alike_in_both_kinds_of_skinning(local in matrix(), bind in matrix()) {
        let everything = vec![vec![(0, 1.0)]; 16];
        let model = skinned(DMat4::IDENTITY, DMat4::IDENTITY, bind, &[(local, DMat4::IDENTITY)], &everything);
        let (linear, _) = deformed(&model.document, &PoseState::default());
        let (dual, _) = deformed(&model.document, &dual());
        for (a, b) in linear.iter().zip(&dual) {
            prop_assert!((*a - *b).length() <= 2e-5 * (1.0 + a.length()), "{a} is not {b}");
        }
    }
}

#[test]
fn a_half_turned_joint_keeps_its_girth_with_dual_quaternions_and_loses_it_with_matrices() {
    let twist = DMat4::from_rotation_x(180f64.to_radians() * 0.999);
    let weights = vec![vec![(0, 0.5), (1, 0.5)]; 16];
    let bones = [(DMat4::IDENTITY, DMat4::IDENTITY), (twist, DMat4::IDENTITY)];
    let model = skinned(DMat4::IDENTITY, DMat4::IDENTITY, DMat4::IDENTITY, &bones, &weights);
    let girth = |positions: &[Vec3]| positions[15].with_x(0.0).length();
    let rest = girth(&sheet(4).positions);
    assert!(girth(&deformed(&model.document, &PoseState::default()).0) < 0.01 * rest);
    assert!((girth(&deformed(&model.document, &dual()).0) - rest).abs() < 1e-5);
}

#[test]
fn a_point_without_influences_and_a_lost_joint_stay_in_the_bind_shape() {
    let (root, node, bind) = (DMat4::from_scale(DVec3::splat(2.0)), DMat4::from_translation(DVec3::Y), DMat4::from_translation(DVec3::Z));
    let mut weights = vec![vec![(0, 1.0)]; 16];
    weights[3].clear();
    let mut model = skinned(root, node, bind, &[(DMat4::from_translation(DVec3::X * 9.0), DMat4::IDENTITY)], &weights);
    if let Content::Mesh(instance) = &mut model.document.scene.graph.node_mut(model.node).contents[0] {
        instance.deformers = vec![Deformer::Skin { skin: SkinId(0), joints: vec![None] }];
    }
    model.document.bump_revision();
    let (positions, _) = deformed(&model.document, &PoseState::default());
    let rest = sheet(4).positions;
    assert!((positions[3] - (rest[3] + Vec3::Z) * 2.0).length() < 1e-6);
    assert!((positions[5] - (rest[5] + Vec3::Z) * 2.0).length() < 1e-6);
}

#[test]
fn morphs_add_their_weighted_deltas_and_get_new_normals() {
    let mut scene = Scene::default();
    let mesh = sheet(4);
    let lift = mesh.positions.iter().map(|p| Vec3::Z * p.x).collect();
    let target = MorphTarget { name: "lift".into(), position_deltas: lift, normal_deltas: Vec::new() };
    scene.morphs.push(Morph { targets: vec![target], weights: vec![0.5], ..Morph::default() });
    scene.meshes.push(Arc::new(mesh));
    let instance = MeshInstance {
        mesh: MeshId(0),
        deformers: vec![Deformer::Morph(MorphId(0))],
        materials: vec![None].into(),
        skinned_targets: Vec::new(),
    };
    let transform = Transform::from_translation(DVec3::Y);
    scene.graph.add(None, Node::new("face").with_transform(transform).with_content(Content::Mesh(instance)));
    let (positions, normals) = deformed(&document(scene), &PoseState::default());
    let want = Vec3::new(-0.5, 0.0, 1.0).normalize();
    for ((position, normal), rest) in positions.iter().zip(&normals).zip(&sheet(4).positions) {
        assert!((*position - (*rest + Vec3::Y + Vec3::Z * 0.5 * rest.x)).length() < 1e-6);
        assert!((*normal - want).length() < 1e-5, "{normal} is not {want}");
    }
}

#[test]
fn the_model_matrix_moves_everything_and_the_bounds_follow() {
    let mut scene = Scene::default();
    scene.meshes.push(Arc::new(sheet(3)));
    let instance = MeshInstance { mesh: MeshId(0), deformers: vec![], materials: vec![None].into(), skinned_targets: Vec::new() };
    scene.graph.add(None, Node::new("sheet").with_content(Content::Mesh(instance)));
    let document = document(scene);
    let (mut buffers, mut frame) = (PoseBuffers::default(), Frame::default());
    let state = PoseState { model: DMat4::from_translation(DVec3::X * 5.0), ..PoseState::default() };
    document.pose(&state, &mut buffers, &mut frame);
    assert!((frame.bounds.min.x - 5.0).abs() < 1e-6 && frame.bounds.min.y.abs() < 1e-6);
    document.pose(&PoseState::default(), &mut buffers, &mut frame);
    assert!(frame.bounds.min.x.abs() < 1e-6);
    let mirrored = PoseState { model: DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0)), ..PoseState::default() };
    document.pose(&mirrored, &mut buffers, &mut frame);
    assert!(frame.surfaces[0].mirrored);
}
