//! Paints the dots by which a muscle's ends, and the points that it passes, can be dragged.

use gtk::cairo::Context;
use gtk4 as gtk;

use super::ignore;
use crate::app::canvas::{Align, Canvas, cairo, rgb, set_color, write};
use crate::app::session::Grip;
use crate::muscle::Handhold;
use crate::tr;

/// Radius, logical pixels.
const RADIUS: f64 = 5.0;

/// Paints them: the origin full, the insertion hollow, points on the way small. The one under the pointer (`lit`) says what it is.
pub fn draw(grips: &[Grip], lit: Option<Handhold>, canvas: &Canvas, snapshot: &gtk::Snapshot, (width, height): (f64, f64)) {
    let context = cairo(snapshot, width, height);
    for grip in grips {
        let held = lit == Some(grip.hold);
        let radius = if let Handhold::Via(_) = grip.hold { 0.7 * RADIUS } else { RADIUS } + if held { 2.0 } else { 0.0 };
        // A dark edge round a light dot is legible over anything.
        disc(&context, grip, radius + 2.0, 0x10_1010, 0.55);
        disc(&context, grip, radius, 0xFF_FFFF, 0.95);
        if grip.hold == Handhold::End(1) {
            disc(&context, grip, radius - 2.5, 0x10_1010, 0.8);
        }
    }
    drop(context);
    if let Some(grip) = grips.iter().find(|grip| Some(grip.hold) == lit) {
        let name = match grip.hold {
            Handhold::End(0) => tr!("app-origin"),
            Handhold::End(_) => tr!("app-insertion"),
            Handhold::Via(number) => tr!("app-via-number", number = number + 1),
        };
        for (dx, dy, color) in [(1.0, 1.0, 0x10_1010), (0.0, 0.0, 0xFF_FFFF)] {
            write(canvas, snapshot, &name, grip.place.x + 13.0 + dx, grip.place.y - 9.0 + dy, Align::Left, 0.9, &rgb(color));
        }
    }
}

fn disc(context: &Context, grip: &Grip, radius: f64, color: u32, opacity: f64) {
    set_color(context, &rgb(color), opacity);
    context.arc(grip.place.x, grip.place.y, radius, 0.0, std::f64::consts::TAU);
    ignore(context.fill());
}
