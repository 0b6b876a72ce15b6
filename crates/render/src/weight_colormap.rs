//! Colour map of the skin weights of one joint.

use glam::Vec4;

use super::RenderError;
use sinew_scene::{Content, Deformer, NodeId, Scene, Surface};

/// The ramp from weight 0 to 1: ordered in lightness too, so it can be read in grey.
const RAMP: [[u8; 3]; 5] = [[0x1B, 0x1F, 0x3B], [0x5A, 0x2A, 0x82], [0xC2, 0x45, 0x6B], [0xF9, 0xA2, 0x3B], [0xFC, 0xF5, 0xA8]];

/// The colour of a weight.
pub(super) fn ramp(weight: f32) -> Vec4 {
    let place = if weight.is_finite() { weight.clamp(0.0, 1.0) } else { 0.0 } * (RAMP.len() - 1) as f32;
    let lower = (place as usize).min(RAMP.len() - 2);
    let share = place - lower as f32;
    let color = |i: usize| f32::from(RAMP[lower][i]) + (f32::from(RAMP[lower + 1][i]) - f32::from(RAMP[lower][i])) * share;
    Vec4::new(color(0), color(1), color(2), 255.0) / 255.0
}

/// The colour of a weight from 0 to 1: red, green, blue, each from 0 to 1.
pub fn weight_color(weight: f32) -> [f32; 3] {
    ramp(weight).truncate().to_array()
}

/// Adds one colour for each vertex of the surface's mesh.
pub(super) fn append_weight_colors(scene: &Scene, surface: &Surface, joint: NodeId, out: &mut Vec<Vec4>) -> Result<(), RenderError> {
    let mesh = &surface.mesh;
    out.try_reserve(mesh.positions.len())?;
    let found = || {
        if surface.node.index() >= scene.graph.len() {
            return None;
        }
        let Content::Mesh(instance) = scene.graph.node(surface.node).contents.get(surface.content as usize)? else { return None };
        instance.deformers.iter().find_map(|deformer| match deformer {
            Deformer::Skin { skin, joints } => Some((scene.skins.get(skin.index())?, joints)),
            Deformer::Morph(_) => None,
        })
    };
    let Some((skin, joints)) = found() else {
        out.extend(std::iter::repeat_n(ramp(0.0), mesh.positions.len()));
        return Ok(());
    };
    let moved = |index: i32| usize::try_from(index).ok().and_then(|i| joints.get(i)) == Some(&Some(joint));
    out.extend((0..mesh.positions.len()).map(|v| {
        let point = mesh.source_vertex.get(v).map_or(v, |point| *point as usize);
        let weight: f32 = skin.influences_of(point).iter().filter(|i| moved(i.joint)).map(|i| i.weight).sum();
        ramp(weight)
    }));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ramp_gets_lighter_all_the_way() {
        let lightness = |w: f32| ramp(w).dot(Vec4::new(0.2126, 0.7152, 0.0722, 0.0));
        for i in 0..100 {
            assert!(lightness(i as f32 / 100.0) < lightness((i + 1) as f32 / 100.0), "at {i}");
        }
        assert_eq!(ramp(f32::NAN), ramp(0.0));
        assert_eq!(ramp(2.0), ramp(1.0));
    }
}
