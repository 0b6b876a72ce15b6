//! Small icons that the icon themes lack, drawn as lines in the text's colour on a square of 16 units.

use gtk::cairo::{Context, LineCap, LineJoin};
use gtk::prelude::*;
use gtk4 as gtk;

use super::drawing_area::{PaintWidget, cairo, set_color};

/// What an icon shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Glyph {
    /// A file.
    File,
    /// An ordinary node.
    Node,
    /// A bone.
    Bone,
    /// A mesh.
    Mesh,
    /// A muscle.
    Muscle,
    /// A camera.
    Camera,
    /// A light.
    Light,
    /// The tool that moves the camera.
    Navigate,
    /// The tool that moves the model.
    Move,
    /// The tool that turns the model.
    Rotate,
    /// The tool that scales the model.
    Scale,
    /// To the previous key.
    PreviousKey,
    /// To the next key.
    NextKey,
    /// One frame back.
    FrameBack,
    /// One frame on.
    FrameForward,
    /// The dope sheet.
    Sheet,
}

/// A canvas of 16 × 16 that shows a glyph.
pub(super) fn image(glyph: Glyph) -> PaintWidget {
    let canvas = PaintWidget::new(16, 16);
    set(&canvas, glyph);
    canvas.set_valign(gtk::Align::Center);
    canvas.set_halign(gtk::Align::Center);
    canvas
}

/// Makes a canvas show a glyph.
pub(super) fn set(canvas: &PaintWidget, glyph: Glyph) {
    canvas.set_painter(move |canvas, snapshot, width, height| {
        let context = cairo(snapshot, width, height);
        let side = width.min(height);
        context.translate((width - side) / 2.0, (height - side) / 2.0);
        context.scale(side / 16.0, side / 16.0);
        set_color(&context, &canvas.text_color(), 1.0);
        context.set_line_width(1.3);
        context.set_line_cap(LineCap::Round);
        context.set_line_join(LineJoin::Round);
        // Cairo fails only where memory is gone; an icon is not worth more than the attempt.
        let _ = draw(&context, glyph);
    });
}

fn path(context: &Context, points: &[(f64, f64)], closed: bool) {
    for (index, (x, y)) in points.iter().enumerate() {
        if index == 0 { context.move_to(*x, *y) } else { context.line_to(*x, *y) }
    }
    if closed {
        context.close_path();
    }
}

/// An arrow head at a tip that points along (`dx`, `dy`).
fn head(context: &Context, (x, y): (f64, f64), (dx, dy): (f64, f64)) {
    path(context, &[(x - 2.2 * dx - 2.0 * dy, y - 2.2 * dy + 2.0 * dx), (x, y), (x - 2.2 * dx + 2.0 * dy, y - 2.2 * dy - 2.0 * dx)], false);
}

fn draw(context: &Context, glyph: Glyph) -> Result<(), cairo::Error> {
    let circle = std::f64::consts::TAU;
    match glyph {
        Glyph::File => {
            path(context, &[(3.5, 1.5), (9.5, 1.5), (12.5, 4.5), (12.5, 14.5), (3.5, 14.5)], true);
            path(context, &[(9.0, 2.0), (9.0, 5.0), (12.0, 5.0)], false);
        }
        Glyph::Node => context.arc(8.0, 8.0, 2.5, 0.0, circle),
        Glyph::Bone => {
            path(context, &[(2.5, 13.5), (4.0, 8.5), (13.5, 2.5), (7.5, 12.0)], true);
            path(context, &[(4.0, 8.5), (7.5, 12.0)], false);
        }
        Glyph::Mesh => {
            path(context, &[(8.0, 2.0), (14.0, 13.5), (2.0, 13.5)], true);
            path(context, &[(5.0, 7.75), (11.0, 7.75), (8.0, 13.5)], true);
        }
        Glyph::Muscle => {
            context.move_to(1.5, 14.5);
            context.curve_to(2.0, 6.0, 6.0, 2.0, 14.5, 1.5);
            context.curve_to(14.0, 10.0, 10.0, 14.0, 1.5, 14.5);
            path(context, &[(5.0, 11.0), (11.0, 5.0)], false);
        }
        Glyph::Camera => {
            context.rectangle(1.5, 4.5, 8.5, 7.0);
            path(context, &[(10.0, 7.5), (14.5, 5.0), (14.5, 11.0), (10.0, 8.5)], false);
        }
        Glyph::Light => {
            context.arc(8.0, 8.0, 2.8, 0.0, circle);
            for step in 0..8 {
                let (sin, cos) = (f64::from(step) * circle / 8.0).sin_cos();
                context.move_to(8.0 + cos * 5.2, 8.0 + sin * 5.2);
                context.line_to(8.0 + cos * 6.8, 8.0 + sin * 6.8);
            }
        }
        Glyph::Navigate => {
            context.arc(8.0, 8.0, 2.2, 0.0, circle);
            context.new_sub_path();
            context.save()?;
            context.translate(8.0, 8.0);
            context.scale(1.0, 0.5);
            context.arc(0.0, 0.0, 6.5, -0.6, circle - 1.6);
            context.restore()?;
        }
        Glyph::Move => {
            path(context, &[(8.0, 1.5), (8.0, 14.5)], false);
            path(context, &[(1.5, 8.0), (14.5, 8.0)], false);
            for (tip, way) in [((8.0, 1.5), (0.0, -1.0)), ((8.0, 14.5), (0.0, 1.0)), ((1.5, 8.0), (-1.0, 0.0)), ((14.5, 8.0), (1.0, 0.0))] {
                head(context, tip, way);
            }
        }
        Glyph::Rotate => {
            context.arc(8.0, 8.5, 5.5, -circle / 4.0, circle * 0.6);
            head(context, (8.0, 3.0), (-1.0, 0.0));
        }
        Glyph::Scale => {
            context.rectangle(1.8, 8.2, 6.0, 6.0);
            path(context, &[(8.5, 7.5), (14.0, 2.0)], false);
            path(context, &[(9.8, 2.0), (14.0, 2.0), (14.0, 6.2)], false);
        }
        Glyph::FrameBack | Glyph::FrameForward => {
            if glyph == Glyph::FrameForward {
                context.translate(16.0, 0.0);
                context.scale(-1.0, 1.0);
            }
            path(context, &[(8.5, 3.5), (8.5, 12.5), (2.5, 8.0)], true);
            context.fill()?;
            context.rectangle(10.5, 3.5, 2.0, 9.0);
            context.fill()?;
        }
        Glyph::Sheet => {
            for (y, keys) in [(3.5, [4.0, 11.0]), (8.0, [7.0, 13.0]), (12.5, [3.0, 9.0])] {
                path(context, &[(0.8, y), (15.2, y)], false);
                context.set_line_width(0.7);
                context.stroke()?;
                for x in keys {
                    path(context, &[(x, y - 2.2), (x + 2.2, y), (x, y + 2.2), (x - 2.2, y)], true);
                    context.fill()?;
                }
            }
        }
        Glyph::PreviousKey | Glyph::NextKey => {
            if glyph == Glyph::NextKey {
                context.translate(16.0, 0.0);
                context.scale(-1.0, 1.0);
            }
            path(context, &[(4.5, 4.5), (8.0, 8.0), (4.5, 11.5), (1.0, 8.0)], true);
            context.fill()?;
            path(context, &[(13.5, 4.0), (9.5, 8.0), (13.5, 12.0)], false);
        }
    }
    context.stroke()
}
