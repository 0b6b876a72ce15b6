//! Legend of the weight colours.

use gtk4 as gtk;

use crate::app::format;
use crate::app::widgets::drawing_area::{Align, PaintWidget, cairo, set_color, write};
use crate::i18n;
use crate::render::weight_color;
use crate::session::Session;
use crate::tr;

/// Size of the ramp and its distance from the picture's right and lower edge, logical pixels.
const WIDTH: f64 = 160.0;
const THICK: f64 = 10.0;
const RIGHT: f64 = 24.0;
const BELOW: f64 = 96.0;

/// Draws the ramp with the bone's name, while weights are painted.
pub(super) fn draw(session: &Session, canvas: &PaintWidget, snapshot: &gtk::Snapshot, width: f64, height: f64) {
    let Some(bone) = session.display().highlight.weights else { return };
    let (x, y) = (width - RIGHT - WIDTH, height - BELOW);
    if x < 60.0 || y < 60.0 {
        return;
    }
    let text = canvas.text_color();
    let name = i18n::label(session.document().scene.graph.label(bone));
    let context = cairo(snapshot, width, height);
    for step in 0..WIDTH as i32 {
        let [red, green, blue] = weight_color(step as f32 / (WIDTH as f32 - 1.0));
        context.set_source_rgb(red.into(), green.into(), blue.into());
        context.rectangle(x + f64::from(step), y, 1.0, THICK);
        super::ignore(context.fill());
    }
    set_color(&context, &text, 0.5);
    context.set_line_width(1.0);
    context.rectangle(x - 0.5, y - 0.5, WIDTH + 1.0, THICK + 1.0);
    super::ignore(context.stroke());
    drop(context);
    write(canvas, snapshot, &tr!("app-weights-of", name = name), x + WIDTH / 2.0, y - 20.0, Align::Centre, 0.85, &text);
    for (part, digits) in [(0.0, 0), (0.5, 1), (1.0, 0)] {
        let place = x + part * WIDTH;
        write(canvas, snapshot, &format::number(part, digits), place, y + THICK + 2.0, Align::Centre, 0.8, &text);
    }
}
