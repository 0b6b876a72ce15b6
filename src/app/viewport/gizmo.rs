//! The small axes in the corner: how the world lies in the picture.

use gtk::cairo::LineCap;
use gtk4 as gtk;

use super::ignore;
use crate::app::canvas::{Align, Canvas, cairo, rgb, set_color, write};
use crate::app::session::Session;
use glam::Vec3;

/// Length of an arm, logical pixels.
const ARM: f64 = 24.0;
/// Distance of the origin from the picture's left and lower edge.
const INSET: f64 = 42.0;

/// Draws the axes into the lower left corner.
pub fn draw(session: &mut Session, canvas: &Canvas, snapshot: &gtk::Snapshot, height: f64) {
    let (_, _, camera, display) = session.picture();
    let (right, up, back) = (camera.right(), camera.up(), -camera.forward());
    let mut arms: Vec<(f32, Vec3, u32, &str)> = [(Vec3::X, "X"), (Vec3::Y, "Y"), (Vec3::Z, "Z")]
        .into_iter()
        .zip(display.palette.axes)
        .map(|((axis, name), color)| (axis.dot(back), axis, color, name))
        .collect();
    // The one that points away is drawn first.
    arms.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (x, y) = (INSET, height - INSET);
    let tip = |axis: Vec3| (x + f64::from(axis.dot(right)) * ARM, y - f64::from(axis.dot(up)) * ARM);
    let context = cairo(snapshot, 2.0 * INSET, height);
    context.set_line_width(2.0);
    context.set_line_cap(LineCap::Round);
    for (_, axis, color, _) in &arms {
        set_color(&context, &rgb(*color), 1.0);
        context.move_to(x, y);
        let (to_x, to_y) = tip(*axis);
        context.line_to(to_x, to_y);
        ignore(context.stroke());
    }
    drop(context);
    for (_, axis, color, name) in &arms {
        let (to_x, to_y) = tip(*axis * 1.38);
        write(canvas, snapshot, name, to_x, to_y - 8.0, Align::Centre, 0.8, &rgb(*color));
    }
}
