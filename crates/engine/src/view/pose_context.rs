//! The main pose, as overlays see it.

use glam::Vec3;

use crate::document::{Document, PoseState};
use sinew_render::Display;
use sinew_scene::NodeId;

/// The main pose that overlays are added to.
#[derive(Debug, Clone)]
pub struct PoseContext<'a> {
    /// The document.
    pub document: &'a Document,
    /// Its pose state.
    pub state: PoseState,
    /// Frames per second of its frame numbers, above 0.
    pub frame_rate: f64,
    /// The selected node, whose motion path is drawn.
    pub selected: Option<NodeId>,
    /// Colour of the selection, `0xRRGGBB`.
    pub selection_color: u32,
    /// Whether bones are drawn.
    pub bones: bool,
    /// Whether lines of action of muscles are drawn.
    pub lines_of_action: bool,
}

impl<'a> PoseContext<'a> {
    /// A document in a state, looked at through `display`.
    pub fn new(document: &'a Document, state: PoseState, rate: f64, display: &Display) -> Self {
        let bones = display.bones || !document.shows_surface();
        Self {
            document,
            state,
            frame_rate: rate,
            selected: display.highlight.selected,
            selection_color: display.palette.selected,
            bones,
            lines_of_action: display.lines_of_action && display.muscle,
        }
    }
}

/// `0xRRGGBB` as components from 0 to 1.
pub(super) fn color(value: u32) -> Vec3 {
    let part = |shift: u32| (value >> shift & 255) as f32 / 255.0;
    Vec3::new(part(16), part(8), part(0))
}
