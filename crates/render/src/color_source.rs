//! What the colours of a surface say under the display options: the one place that decides between them.

use glam::Vec4;

use super::weight_colormap::append_weight_colors;
use super::{Display, RenderError};
use sinew_scene::{NodeId, Scene, Surface};

/// Where the colours of a surface come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ColorSource {
    /// Its materials, with the colours of its vertices and the texture of fibres.
    Materials,
    /// The neutral material, whatever is bound.
    Neutral,
    /// The weights of a joint, a colour a vertex.
    Weights(NodeId),
}

impl ColorSource {
    /// The source for a surface. Weights are those of skins: fibres have none, and a secondary pose keeps the colours that tell it from the first.
    pub(super) fn of(display: &Display, surface: &Surface) -> Self {
        match display.highlight.weights {
            Some(joint) if !surface.is_fibrous() && surface.ghost.is_none() => Self::Weights(joint),
            _ if display.materials && surface.ghost.is_none_or(|ghost| ghost.materials) => Self::Materials,
            _ => Self::Neutral,
        }
    }

    /// Whether colours of vertices that the source computes stand in for those of the mesh.
    pub(super) fn replaces_vertex_colors(self) -> bool {
        matches!(self, Self::Weights(_))
    }

    /// Adds the colours of vertices that the source computes, and tells where they begin; `None` where it computes none.
    pub(super) fn append_vertex_colors(self, scene: &Scene, surface: &Surface, out: &mut Vec<Vec4>) -> Result<Option<usize>, RenderError> {
        let Self::Weights(joint) = self else { return Ok(None) };
        let first = out.len();
        append_weight_colors(scene, surface, joint, out)?;
        Ok(Some(first))
    }

    /// Whether a skin that is drawn so may let the fibres beneath it be seen: a colour that stands for a number is not mixed with what lies behind.
    pub(super) fn allows_see_through(self) -> bool {
        !self.replaces_vertex_colors()
    }
}
