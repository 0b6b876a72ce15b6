//! Paints the dots by which a muscle's ends, the points that it passes and the ball that it goes round can be dragged, and the outline of that ball.

use gtk::cairo::Context;
use gtk4 as gtk;

use super::ignore;
use crate::app::widgets::drawing_area::{Align, PaintWidget, cairo, rgb, set_color, write};
use crate::muscle::AttachmentPoint;
use crate::session::{AttachmentHandle, WrapSphereCircle};
use crate::tr;

/// Radius, logical pixels.
const RADIUS: f64 = 5.0;

/// Lengths of a dash and of a gap in the outline of a ball, logical pixels.
const DASHES: [f64; 2] = [6.0, 4.0];

/// Paints them: the origin full, the insertion hollow, points on the way and the middle of a ball small. The one under the pointer (`lit`) says what
/// it is.
pub(super) fn draw(
    handles: &[AttachmentHandle],
    ring: Option<WrapSphereCircle>,
    lit: Option<AttachmentPoint>,
    canvas: &PaintWidget,
    snapshot: &gtk::Snapshot,
    (width, height): (f64, f64),
) {
    let context = cairo(snapshot, width, height);
    if let Some(ring) = ring {
        outline(&context, &ring);
    }
    for grip in handles {
        let held = lit == Some(grip.attachment);
        let radius = if let AttachmentPoint::End(_) = grip.attachment { RADIUS } else { 0.7 * RADIUS } + if held { 2.0 } else { 0.0 };
        // A dark edge round a light dot is legible over anything.
        disc(&context, grip, radius + 2.0, 0x10_1010, 0.55);
        disc(&context, grip, radius, 0xFF_FFFF, 0.95);
        if grip.attachment == AttachmentPoint::End(1) {
            disc(&context, grip, radius - 2.5, 0x10_1010, 0.8);
        }
    }
    drop(context);
    if let Some(grip) = handles.iter().find(|grip| Some(grip.attachment) == lit) {
        let name = match grip.attachment {
            AttachmentPoint::End(0) => tr!("app-origin"),
            AttachmentPoint::End(_) => tr!("app-insertion"),
            AttachmentPoint::Via(number) => tr!("app-via-number", number = number + 1),
            AttachmentPoint::Wrap => tr!("app-wrap-centre"),
        };
        for (dx, dy, color) in [(1.0, 1.0, 0x10_1010), (0.0, 0.0, 0xFF_FFFF)] {
            write(
                canvas,
                snapshot,
                &name,
                grip.screen_position.x + 13.0 + dx,
                grip.screen_position.y - 9.0 + dy,
                Align::Left,
                0.9,
                &rgb(color),
            );
        }
    }
}

/// A ball: a broken circle, and the radius on the side on which the muscle passes.
fn outline(context: &Context, ring: &WrapSphereCircle) {
    // A dark line under a light one is legible over anything.
    for (line, color, opacity) in [(3.5, 0x10_1010, 0.45), (1.5, 0xFF_FFFF, 0.9)] {
        set_color(context, &rgb(color), opacity);
        context.set_line_width(line);
        context.set_dash(&DASHES, 0.0);
        context.new_path();
        context.arc(ring.middle.x, ring.middle.y, ring.radius, 0.0, std::f64::consts::TAU);
        ignore(context.stroke());
        context.set_dash(&[], 0.0);
        context.move_to(ring.middle.x, ring.middle.y);
        context.line_to(ring.top.x, ring.top.y);
        ignore(context.stroke());
    }
}

fn disc(context: &Context, grip: &AttachmentHandle, radius: f64, color: u32, opacity: f64) {
    set_color(context, &rgb(color), opacity);
    context.arc(grip.screen_position.x, grip.screen_position.y, radius, 0.0, std::f64::consts::TAU);
    ignore(context.fill());
}
