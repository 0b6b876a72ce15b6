//! The lines of action of all muscles, from attachment to attachment.

use super::pose_context::{PoseContext, color};
use sinew_muscle::SolvedMuscle;
use sinew_scene::{Frame, OverlayLine};

/// Colour: beside the red of muscles, the white of tendons and the colours of bones and of the selection.
const COLOR: u32 = 0xFF_D54A;

/// Adds the lines to a frame that has just been posed.
pub(super) fn append_to(context: &PoseContext<'_>, frame: &mut Frame) {
    let (tint, mut solved) = (color(COLOR), SolvedMuscle::default());
    for (rig, _) in context.document.rigs() {
        for index in 0..rig.len() {
            rig.solve_into(index, context.state.joints.drive, &frame.world, &mut solved);
            let points = rig.line_of_action(index, &solved, &frame.world).unwrap_or_default();
            let pairs = points.iter().zip(points.iter().skip(1)).map(|(from, to)| (from.as_vec3(), to.as_vec3()));
            let line = |(from, to)| OverlayLine { from, to, color: tint, opacity: 1.0, width: 1.6 };
            frame.overlay_lines.extend(pairs.filter(|(from, to)| from != to && from.is_finite() && to.is_finite()).map(line));
        }
    }
}
