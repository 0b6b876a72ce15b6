//! Why a vertex is where it is: its bones, their weights, and what each of them adds.

use glam::{DMat4, DVec3, Vec3};

use super::deform::{morphs_of, root_of, skin_of};
use super::{Document, PoseBuffers, mix};
use sinew_scene::{Content, Frame, NodeId};

/// One bone's share in a vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct JointContribution {
    /// The bone's node; `None` where the file names none that is there.
    pub node: Option<NodeId>,
    /// The name of the joint in the skin; empty for the bind shape itself (influence −1).
    pub joint: String,
    /// Its weight.
    pub weight: f64,
    /// Where this bone alone would put the vertex; world, metres.
    pub full_weight_position: DVec3,
    /// `weight · alone`: what it adds to the sum.
    pub contribution: DVec3,
}

/// A vertex, explained: `v' = Σ wᵢ Jᵢ IBMᵢ BSM v`.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexInfluences {
    /// The vertex of the mesh.
    pub vertex: u32,
    /// Its point in the file.
    pub point: u32,
    /// The vertex before the skin, after the morphs below it; the mesh's own space.
    pub base: DVec3,
    /// The bones; empty where no skin moves it.
    pub influences: Vec<JointContribution>,
    /// The sum of the parts: where linear blending puts the vertex; world, metres.
    pub sum: DVec3,
    /// Where it is drawn; world, metres. Differs from the sum where dual quaternions are blended, and where a morph above the skin mixes the skinned shape.
    pub drawn: DVec3,
}

impl Document {
    /// Explains vertex `vertex` of surface `surface` of the frame that was posed last with these buffers. `None` where there is no such mesh or vertex
    /// (a muscle's vertices follow its profile, not bones).
    pub fn vertex_influences(&self, buffers: &PoseBuffers, frame: &Frame, surface: usize, vertex: u32) -> Option<VertexInfluences> {
        let surface = frame.surfaces.get(surface)?;
        let Content::Mesh(instance) = self.scene.graph.node(surface.node).contents.get(surface.content as usize)? else { return None };
        let v = vertex as usize;
        let point = *surface.mesh.source_vertex.get(v)?;
        let mut base: Vec3 = *surface.mesh.positions.get(v)?;
        let skinned = skin_of(&self.scene, instance).is_some();
        for (id, morph) in morphs_of(&self.scene, instance, skinned) {
            base = mix::morph_point(morph, buffers.pose().morph_weights.get(id)?, &surface.mesh, v, base);
        }
        let base = base.as_dvec3();
        let drawn = surface.position(vertex).as_dvec3();
        let at = |node: NodeId| frame.world.get(node.index()).copied();
        let here = at(surface.node).unwrap_or(DMat4::IDENTITY);
        let Some((skin, nodes)) = skin_of(&self.scene, instance) else {
            return Some(VertexInfluences { vertex, point, base, influences: Vec::new(), sum: here.transform_point3(base), drawn });
        };
        let bind = at(root_of(&self.scene, surface.node)).unwrap_or(DMat4::IDENTITY) * skin.bind_shape;
        let shares: Vec<JointContribution> = skin
            .influences_of(point as usize)
            .iter()
            .map(|influence| {
                let index = usize::try_from(influence.joint).ok();
                let joint = index.and_then(|index| skin.joints.get(index));
                let node = index.and_then(|index| nodes.get(index).copied().flatten());
                let matrix = match (joint, node.and_then(at)) {
                    (Some(joint), Some(world)) => world * joint.inverse_bind * skin.bind_shape,
                    _ => bind,
                };
                let (weight, alone) = (f64::from(influence.weight), matrix.transform_point3(base));
                JointContribution {
                    node,
                    joint: joint.map_or_else(String::new, |joint| joint.name.clone()),
                    weight,
                    full_weight_position: alone,
                    contribution: alone * weight,
                }
            })
            .collect();
        let sum = match (shares.is_empty(), skin.has_identity_bind_shape() && instance.is_skinned()) {
            (true, true) => here.transform_point3(base),
            (true, false) => bind.transform_point3(base),
            (false, _) => shares.iter().map(|share| share.contribution).sum(),
        };
        Some(VertexInfluences { vertex, point, base, influences: shares, sum, drawn })
    }
}
