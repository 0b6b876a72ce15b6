//! Bone names, drawn beside the bones in the viewport.

use glam::Vec2;
use gtk4 as gtk;

use crate::app::widgets::drawing_area::{PaintWidget, rgb, write_with_background};
use crate::i18n;
use crate::render::Background;
use crate::session::Session;

/// Most names that are written; more would be a grey cloud.
const MOST: usize = 400;

/// Writes the names of the bones of a picture of this size, logical pixels. Names that would lie over one another are left out, the nearer bone first.
pub(super) fn write_all(session: &mut Session, canvas: &PaintWidget, snapshot: &gtk::Snapshot, width: f64, height: f64) {
    let (scene, frame, camera, display) = session.picture();
    let size = Vec2::new(width as f32, height as f32);
    let mut names: Vec<_> = frame
        .joints
        .iter()
        .filter_map(|joint| camera.project(frame.position(joint.node), size).map(|place| (place, joint.node)))
        .filter(|(_, node)| scene.graph.is_shown(*node))
        .filter(|(place, _)| place.z <= 1.0 && place.x > 0.0 && place.y > 0.0 && place.x < size.x && place.y < size.y)
        .collect();
    // The selected one is never left out, and the one under the pointer neither.
    let rank = |node| {
        u8::from(display.highlight.selected != Some(node))
            + u8::from(display.highlight.selected != Some(node) && display.highlight.hovered != Some(node))
    };
    names.sort_by(|(a, one), (b, other)| rank(*one).cmp(&rank(*other)).then(a.z.total_cmp(&b.z)));
    let mut taken: Vec<(f64, f64, f64)> = Vec::new();
    for (place, node) in names.into_iter().take(MOST) {
        let (x, y) = (f64::from(place.x) + 6.0, f64::from(place.y) - 7.0);
        let name = &i18n::label(scene.graph.label(node));
        let length = name.chars().count() as f64 * 7.0;
        if taken.iter().any(|(left, right, top)| x < *right && x + length > *left && (y - top).abs() < 12.0) {
            continue;
        }
        let ground = rgb(match display.background {
            Background::Gradient(above, _) => above,
            Background::Solid(color) => color,
            Background::Transparent => display.palette.background.0,
        });
        let color = if display.highlight.selected == Some(node) { display.palette.selected } else { display.palette.bone };
        let written = write_with_background(canvas, snapshot, name, (x, y), 0.8, &rgb(color), &ground.with_alpha(0.8));
        taken.push((x, x + written, y));
    }
}
