//! Paints the dots by which a muscle's ends, the points that it passes and the surfaces that it goes round can be dragged, the outlines of those surfaces.

use glam::DVec2;
use gtk::cairo::Context;
use gtk4 as gtk;

use super::ignore;
use crate::app::widgets::drawing_area::{Align, PaintWidget, cairo, rgb, set_color, write};
use crate::muscle::AttachmentPoint;
use crate::session::{AttachmentHandle, WrapOutline};
use crate::tr;

/// Radius, logical pixels.
const RADIUS: f64 = 5.0;

/// Opacity of the lines of a surface, which are many.
const OUTLINE: f64 = 0.55;

/// What is painted.
pub(super) struct Shown {
    /// The dots.
    pub handles: Vec<AttachmentHandle>,
    /// The surfaces that the muscle goes round.
    pub wraps: Vec<WrapOutline>,
}

/// Paints them: the origin full, the insertion hollow, points on the way and the middle of a surface small, a point that is not passed in this pose as a
/// ring. The one under the pointer (`lit`) says what it is.
pub(super) fn draw(
    shown: &Shown,
    lit: Option<AttachmentPoint>,
    canvas: &PaintWidget,
    snapshot: &gtk::Snapshot,
    (width, height): (f64, f64),
) {
    let context = cairo(snapshot, width, height);
    let numbered = shown.wraps.len() > 1;
    for wrap in &shown.wraps {
        outline(&context, wrap, lit == Some(AttachmentPoint::Wrap(wrap.number)));
    }
    let handles = &shown.handles;
    for grip in handles {
        let held = lit == Some(grip.attachment);
        let radius = if let AttachmentPoint::End(_) = grip.attachment { RADIUS } else { 0.7 * RADIUS } + if held { 2.0 } else { 0.0 };
        // A dark edge round a light dot is legible over anything.
        disc(&context, grip, radius + 2.0, 0x10_1010, 0.55);
        if !grip.passed {
            ring(&context, grip, radius);
            continue;
        }
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
            AttachmentPoint::Via(number) if !grip.passed => tr!("app-via-not-passed", number = number + 1),
            AttachmentPoint::Via(number) => tr!("app-via-number", number = number + 1),
            AttachmentPoint::Wrap(number) if numbered => tr!("app-wrap-centre", number = number + 1),
            AttachmentPoint::Wrap(_) => tr!("app-wrap-centre-only"),
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

/// A surface: the lines of its shape, and the way from its centre to the side on which the muscle passes.
fn outline(context: &Context, wrap: &WrapOutline, lit: bool) {
    let opacity = if lit { 0.95 } else { OUTLINE };
    // A dark line under a light one is legible over anything.
    strokes(context, &wrap.lines, [(2.6, 0x10_1010, 0.5 * opacity), (1.0, 0xFF_FFFF, opacity)]);
    if let Some([centre, top]) = wrap.side {
        strokes(context, &[vec![centre, top]], [(4.0, 0x10_1010, 0.5), (2.0, 0xFF_FFFF, 0.95)]);
        let along = (top - centre).normalize_or_zero();
        let (back, across) = (top - along * 7.0, along.perp() * 4.0);
        set_color(context, &rgb(0xFF_FFFF), 0.95);
        for (index, point) in [top, back + across, back - across].into_iter().enumerate() {
            if index == 0 { context.move_to(point.x, point.y) } else { context.line_to(point.x, point.y) }
        }
        ignore(context.fill());
    }
}

/// Draws lines twice: width, colour and opacity of each time.
fn strokes(context: &Context, lines: &[Vec<DVec2>], looks: [(f64, u32, f64); 2]) {
    for (width, color, opacity) in looks {
        set_color(context, &rgb(color), opacity);
        context.set_line_width(width);
        for line in lines {
            context.new_path();
            for point in line {
                context.line_to(point.x, point.y);
            }
            ignore(context.stroke());
        }
    }
}

fn disc(context: &Context, grip: &AttachmentHandle, radius: f64, color: u32, opacity: f64) {
    set_color(context, &rgb(color), opacity);
    context.arc(grip.screen_position.x, grip.screen_position.y, radius, 0.0, std::f64::consts::TAU);
    ignore(context.fill());
}

fn ring(context: &Context, grip: &AttachmentHandle, radius: f64) {
    set_color(context, &rgb(0xFF_FFFF), 0.85);
    context.set_line_width(1.5);
    context.new_path();
    context.arc(grip.screen_position.x, grip.screen_position.y, radius, 0.0, std::f64::consts::TAU);
    ignore(context.stroke());
}
