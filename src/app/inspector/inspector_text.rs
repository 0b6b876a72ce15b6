//! Texts of the inspector, without widgets.

use glam::{DMat4, DQuat, DVec3, EulerRot, Vec3};

use crate::app::format;
use crate::document::VertexInfluences;
use crate::i18n;
use crate::scene::{Deformer, Material, MeshInstance, Scene};
use crate::session::{Matrices, Session};
use crate::tr;

/// Which of a node's matrices is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Space {
    /// Under the node above.
    Local,
    /// In the world.
    World,
    /// Where the skin was bound.
    Bind,
    /// Its inverse.
    InverseBind,
}

impl Space {
    /// All, in the order of the list.
    pub(crate) const ALL: [Self; 4] = [Self::Local, Self::World, Self::Bind, Self::InverseBind];

    /// What a person calls it.
    pub(crate) fn label(self) -> String {
        tr!(match self {
            Self::Local => "app-space-local",
            Self::World => "app-space-world",
            Self::Bind => "app-space-bind",
            Self::InverseBind => "app-space-inverse-bind",
        })
    }

    /// The matrix; `None` for the bind matrices of what no skin is bound to.
    pub(crate) fn of(self, matrices: &Matrices) -> Option<DMat4> {
        match self {
            Self::Local => Some(matrices.local),
            Self::World => Some(matrices.world),
            Self::Bind => matrices.bind,
            Self::InverseBind => matrices.inverse_bind,
        }
    }
}

/// A rotation as turns about X, then Y, then Z, degrees.
pub(crate) fn degrees(rotation: DQuat) -> DVec3 {
    let (z, y, x) = rotation.to_euler(EulerRot::ZYX);
    DVec3::new(x.to_degrees(), y.to_degrees(), z.to_degrees())
}

/// Everything about the selection's place as text, for programs: decimal points, full precision.
pub(crate) fn report(session: &mut Session) -> String {
    let Some(node) = session.selected() else { return String::new() };
    let Some(matrices) = session.matrices(node) else { return String::new() };
    let mut text = format!("{}, t = {} s\n", i18n::label(session.document().scene.graph.label(node)), session.playback().time);
    for space in Space::ALL {
        let Some(matrix) = space.of(&matrices) else { continue };
        let (scale, rotation, place) = matrix.to_scale_rotation_translation();
        text += &format!("\n{}\n", space.label());
        for (name, values) in [("translation", place), ("rotation XYZ, degrees", degrees(rotation)), ("scale", scale)] {
            let [x, y, z] = values.to_array().map(unsigned);
            text += &format!("{name}: {x} {y} {z}\n");
        }
        for row in 0..4 {
            let [x, y, z, w] = matrix.row(row).to_array().map(unsigned);
            text += &format!("{x} {y} {z} {w}\n");
        }
    }
    text
}

/// The number, zero without a sign.
fn unsigned(value: f64) -> f64 {
    value + 0.0
}

/// How large a mesh is, and what bends it.
pub(crate) fn mesh(scene: &Scene, instance: &MeshInstance) -> String {
    let Some(mesh) = scene.meshes.get(instance.mesh.index()) else { return String::new() };
    let count = |value: usize| format::group_digits(value as u64);
    let mut lines = vec![
        tr!("app-mesh-points", points = count(mesh.source_count as usize), vertices = count(mesh.positions.len())),
        tr!("app-mesh-triangles", triangles = count(mesh.triangles.len()), sets = mesh.uv_sets.len()),
    ];
    for deformer in &instance.deformers {
        match deformer {
            Deformer::Skin { skin, joints } => {
                let Some(skin) = scene.skins.get(skin.index()) else { continue };
                let most = (0..mesh.source_count as usize).map(|point| skin.influences_of(point).len()).max().unwrap_or(0);
                lines.push(tr!("app-mesh-skin", joints = joints.len(), influences = count(skin.influences.len()), most = most));
            }
            Deformer::Morph(morph) => {
                let Some(morph) = scene.morphs.get(morph.index()) else { continue };
                lines.push(tr!("app-mesh-morph", targets = morph.targets.len()));
            }
        }
    }
    lines.join("\n")
}

/// A material in a line or two.
pub(crate) fn material(scene: &Scene, material: &Material) -> String {
    let texture = material.diffuse.texture.as_ref().and_then(|texture| scene.images.get(texture.image.index()));
    match texture {
        Some(image) if image.pixels.is_none() => tr!("app-material-lost", name = i18n::label(material.label()), image = image.uri.as_str()),
        Some(image) => tr!("app-material-texture", name = i18n::label(material.label()), image = image.uri.as_str()),
        None => i18n::label(material.label()).into_owned(),
    }
}

/// The rows of a vertex' bones: name, weight, x, y, z of the part, and last the sum.
pub(crate) fn shares(told: &VertexInfluences, most: usize) -> Vec<[String; 5]> {
    let row = |name: String, weight: String, part: DVec3| {
        let [x, y, z] = part.to_array().map(|value| format::number(value, 4));
        [name, weight, x, y, z]
    };
    let mut rows: Vec<_> = told
        .influences
        .iter()
        .take(most)
        .map(|share| {
            let name = if share.joint.is_empty() { tr!("app-vertex-bind") } else { share.joint.clone() };
            row(name, format::number(share.weight, 3), share.contribution)
        })
        .collect();
    let weights: f64 = told.influences.iter().map(|share| share.weight).sum();
    let weights = if told.influences.is_empty() { String::new() } else { format::number(weights, 3) };
    rows.push(row(tr!("app-vertex-sum"), weights, told.sum));
    rows
}

/// How the sum and the picture compare.
pub(crate) fn vertex_note(told: &VertexInfluences) -> String {
    let apart = (told.sum - told.drawn).length();
    if told.influences.is_empty() {
        tr!("app-vertex-rigid")
    } else if apart > 1e-4 {
        tr!("app-vertex-dual-quaternions", apart = format::number(apart, 4))
    } else {
        tr!("app-vertex-note")
    }
}

/// How far the last two points are apart.
pub(crate) fn distance(pinned: [Option<Vec3>; 2]) -> String {
    match pinned {
        [Some(a), Some(b)] => tr!("app-distance", distance = format::number(f64::from(a.distance(b)), 4)),
        _ => tr!("app-distance-one"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::JointContribution;

    #[test]
    fn rotations_read_as_degrees_about_the_axes() {
        let turned = degrees(DQuat::from_rotation_y(0.5));
        assert!((turned - DVec3::new(0.0, 0.5f64.to_degrees(), 0.0)).length() < 1e-9);
    }

    #[test]
    fn the_last_row_is_the_sum() {
        let share = |weight: f64, alone: DVec3| JointContribution {
            node: None,
            joint: "hip".into(),
            weight,
            full_weight_position: alone,
            contribution: alone * weight,
        };
        let shares = vec![share(0.25, DVec3::X), share(0.75, DVec3::Y)];
        let sum = DVec3::new(0.25, 0.75, 0.0);
        let told = VertexInfluences { vertex: 0, point: 0, base: DVec3::ZERO, influences: shares, sum, drawn: sum };
        let rows = super::shares(&told, 12);
        assert_eq!(rows.len(), 3);
        assert_eq!(rows[2][1..], ["1.000", "0.2500", "0.7500", "0.0000"]);
        assert_eq!(vertex_note(&told), tr!("app-vertex-note"));
        assert_ne!(vertex_note(&VertexInfluences { drawn: DVec3::Z, ..told }), tr!("app-vertex-note"));
    }

    #[test]
    fn two_points_have_a_distance() {
        assert!(distance([Some(Vec3::ZERO), Some(Vec3::new(3.0, 4.0, 0.0))]).contains("5.0000"));
        assert_eq!(distance([None, Some(Vec3::X)]), tr!("app-distance-one"));
    }
}
