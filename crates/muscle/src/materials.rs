//! Materials of muscles, tendons and bones, in the colours of the palette.

use std::sync::Arc;

use sinew_scene::{BodyPart, Fibers, Material, MaterialId, Mesh, Paint, Scene, ShadingModel, Unnamed};

/// Flesh without a colour of its own, sRGB: #B8322E.
pub(super) const FLESH: [u8; 3] = [0xB8, 0x32, 0x2E];
/// Tendon, sRGB: #E8DFC8.
pub(super) const TENDON: [u8; 3] = [0xE8, 0xDF, 0xC8];
/// The symbol of the parts of a muscle's mesh that are tendons.
pub(super) const TENDON_PART: &str = "tendon";
/// Bone, sRGB: #E9E2D0.
const BONE: [u8; 3] = [0xE9, 0xE2, 0xD0];

/// How the parts of a muscle's mesh are drawn: flesh as fibres that pass into tendon at both ends, a tendon as fibres all along.
pub fn fibers(mesh: &Mesh) -> Arc<[Fibers]> {
    let number = |[red, green, blue]: [u8; 3]| u32::from_be_bytes([0, red, green, blue]);
    let (flesh, tendon) = (number(FLESH), number(TENDON));
    let of_part = |symbol: &str| {
        if symbol == TENDON_PART { Fibers { color: tendon, ends: None } } else { Fibers { color: flesh, ends: Some(tendon) } }
    };
    mesh.parts.iter().map(|part| of_part(&part.symbol)).collect()
}

/// A new material for a muscle of this name, or at this place in its file where it has none.
pub(super) fn muscle(scene: &mut Scene, name: &str, number: u32, color: Option<[u8; 3]>) -> MaterialId {
    let id = if name.is_empty() { Unnamed::muscle_id(number) } else { "muscle".to_owned() };
    add(scene, name, &id, color.unwrap_or(FLESH), 0.16, 24.0)
}

/// A new material for tendons.
pub(super) fn tendon(scene: &mut Scene) -> MaterialId {
    add(scene, "", BodyPart::Tendon.id(), TENDON, 0.14, 30.0)
}

/// A new material for rods and balls.
pub(super) fn bone(scene: &mut Scene) -> MaterialId {
    add(scene, "", BodyPart::Bone.id(), BONE, 0.10, 30.0)
}

fn add(scene: &mut Scene, name: &str, id: &str, color: [u8; 3], shine: f32, shininess: f32) -> MaterialId {
    let material = MaterialId(scene.materials.len() as u32);
    let [red, green, blue] = color.map(|part| f32::from(part) / 255.0);
    scene.materials.push(Material {
        name: name.to_owned(),
        id: id.to_owned(),
        model: ShadingModel::Blinn,
        diffuse: Paint::color(red, green, blue),
        specular: Paint::color(shine, shine, shine),
        shininess,
        ..Material::default()
    });
    material
}
