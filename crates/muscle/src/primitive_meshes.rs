//! Solid shapes of the arm: rods, balls, and the feet by which a muscle's ends are rooted in a rod.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};

use sinew_scene::{BodyPart, Content, MaterialBinding, MaterialId, Mesh, MeshId, MeshInstance, NodeId, Part, Scene};

/// A row of a surface of revolution: height, radius, and the normal's components up and outward.
pub(super) type Row = (f64, f64, [f64; 2]);

/// Adds a mesh to the scene and hangs it on a node in one material.
pub(super) fn hang(scene: &mut Scene, node: NodeId, mesh: Mesh, material: MaterialId) {
    let id = MeshId(scene.meshes.len() as u32);
    let materials = vec![Some(MaterialBinding::plain(material)); mesh.parts.len()];
    scene.meshes.push(Arc::new(mesh));
    let instance = MeshInstance { mesh: id, deformers: Vec::new(), materials: materials.into(), skinned_targets: Vec::new() };
    scene.graph.node_mut(node).contents.push(Content::Mesh(instance));
}

/// Rows of a sphere about the origin, from the top down.
pub(super) fn ball(radius: f64) -> Vec<Row> {
    const ROWS: usize = 16;
    let row = |i: usize| {
        let (sin, cos) = (std::f64::consts::PI * i as f64 / ROWS as f64).sin_cos();
        (radius * cos, radius * sin, [cos, sin])
    };
    (0..=ROWS).map(row).collect()
}

/// Segments round a ball.
pub(super) const ROUND: u32 = 32;
/// Segments round a rod, whose outline is straight however many there are.
pub(super) const SLENDER: u32 = 20;

/// A surface of revolution about the Y axis, in so many segments round it. Heights fall from row to row.
pub(super) fn revolved(part: BodyPart, rows: &[Row], segments: u32) -> Mesh {
    let mut mesh = Mesh { id: part.id().to_owned(), ..Mesh::default() };
    let mut uvs = Vec::new();
    let widest = rows.iter().map(|(_, radius, _)| radius.abs()).fold(0.0, f64::max);
    let is_point = |radius: f64| radius.abs() <= 1e-12 * widest;
    for (row, &(height, radius, [up, out])) in rows.iter().enumerate() {
        for segment in 0..=segments {
            let turn = f64::from(segment) / f64::from(segments);
            let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
            mesh.positions.push(DVec3::new(radius * cos, height, radius * sin).as_vec3());
            mesh.normals.push(DVec3::new(out * cos, up, out * sin).normalize_or(DVec3::Y).as_vec3());
            uvs.push(glam::Vec2::new(turn as f32, 1.0 - row as f32 / rows.len() as f32));
        }
    }
    for (row, pair) in rows.windows(2).enumerate() {
        let (above, below) = (pair[0], pair[1]);
        // Two rows in one place have nothing between them: there the normal has a crease. A row that is a point has one triangle a segment.
        if (above.0, above.1) == (below.0, below.1) {
            continue;
        }
        for segment in 0..segments {
            let (a, b) = (row as u32 * (segments + 1) + segment, (row as u32 + 1) * (segments + 1) + segment);
            if !is_point(above.1) {
                mesh.triangles.push([a, a + 1, b]);
            }
            if !is_point(below.1) {
                mesh.triangles.push([a + 1, b + 1, b]);
            }
        }
    }
    let closed = |row: Option<&Row>| row.is_some_and(|(_, radius, _)| is_point(*radius));
    mesh.solid = closed(rows.first()) && closed(rows.last()) && mesh.positions.iter().all(|position| position.is_finite());
    mesh.source_count = mesh.positions.len() as u32;
    mesh.source_vertex = (0..mesh.source_count).collect();
    mesh.uv_sets = vec![uvs];
    mesh.parts = vec![Part { triangles: 0..mesh.triangles.len() as u32, ..Part::default() }];
    mesh
}

/// A short tapered root of tendon from `from` to `to`, with a radius at either end. Its ends are open, to be hidden inside what it joins.
pub(super) fn root(from: DVec3, to: DVec3, radii: [f64; 2]) -> Mesh {
    let length = from.distance(to);
    let lean = [(radii[1] - radii[0]) / length.max(f64::MIN_POSITIVE), 1.0];
    let mut mesh = revolved(BodyPart::Tendon, &[(0.0, radii[0], lean), (-length, radii[1], lean)], SLENDER);
    let down = (to - from).normalize_or(DVec3::NEG_Y);
    let side = down.any_orthonormal_vector();
    let place = DAffine3::from_mat3_translation(DMat3::from_cols(side, -down, side.cross(-down)), from);
    for position in &mut mesh.positions {
        *position = place.transform_point3(position.as_dvec3()).as_vec3();
    }
    for normal in &mut mesh.normals {
        *normal = place.transform_vector3(normal.as_dvec3()).as_vec3();
    }
    mesh
}
