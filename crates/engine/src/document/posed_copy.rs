//! A second posed scene whose surfaces are drawn with the main one: an onion skin, or the compared file.

use glam::Vec3;

use super::{Document, PoseBuffers, PoseState};
use sinew_scene::{Bounds, Frame, Ghost, OverlayLine, Scene};

/// Buffers of a pose beside the main one. Its surfaces move into the main frame for drawing and back before the next pose, so that
/// nothing is copied and nothing is allocated after the first frame.
#[derive(Debug, Default)]
pub struct PosedCopy {
    buffers: PoseBuffers,
    frame: Frame,
    appended: usize,
}

impl PosedCopy {
    /// Poses it. Its surfaces must have been removed from the main frame.
    pub fn pose(&mut self, document: &Document, state: &PoseState) {
        document.pose(state, &mut self.buffers, &mut self.frame);
    }

    /// Its frame. The surfaces are missing while they are part of the main frame.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Its bounding box.
    pub fn bounds(&self) -> Bounds {
        self.frame.bounds
    }

    /// Moves its surfaces into a frame, to be drawn as `ghost` says.
    pub fn append_to(&mut self, to: &mut Frame, ghost: Ghost) {
        for surface in &mut self.frame.surfaces {
            surface.ghost = Some(ghost);
        }
        self.appended = self.frame.surfaces.len();
        to.surfaces.append(&mut self.frame.surfaces);
    }

    /// Moves its surfaces back; several copies in the reverse order of appending. From a frame that no longer has them nothing comes, and
    /// the next pose begins anew.
    pub fn remove_from(&mut self, from: &mut Frame) {
        let appended = std::mem::take(&mut self.appended);
        match from.surfaces.len().checked_sub(appended) {
            Some(start) if from.surfaces.iter().skip(start).all(|surface| surface.ghost.is_some()) => {
                self.frame.surfaces.extend(from.surfaces.drain(start..));
            }
            _ => *self = Self::default(),
        }
    }

    /// Appends its bones as lines.
    pub fn append_bone_lines(&self, scene: &Scene, color: Vec3, opacity: f32, into: &mut Vec<OverlayLine>) {
        let frame = &self.frame;
        let shown = frame.joints.iter().filter(|joint| joint.node.index() < scene.graph.len() && scene.graph.is_shown(joint.node));
        into.extend(shown.filter_map(|joint| {
            Some(OverlayLine { from: frame.position(joint.parent?), to: frame.position(joint.node), color, opacity, width: 2.0 })
        }));
    }

    /// The greatest distance between a vertex of `other` and the same vertex here, moved by `shift`; metres. For two poses of one document,
    /// while its surfaces are not in another frame.
    pub fn max_vertex_distance(&self, other: &Frame, shift: Vec3) -> f32 {
        let mut max_distance = 0.0f32;
        for (a, b) in other.surfaces.iter().zip(&self.frame.surfaces) {
            for vertex in 0..a.mesh.positions.len() as u32 {
                let distance = (a.position(vertex) + shift).distance(b.position(vertex));
                if distance.is_finite() {
                    max_distance = max_distance.max(distance);
                }
            }
        }
        max_distance
    }
}
