//! A widget that draws plots.

use gtk::cairo::Context;
use gtk::gdk::RGBA;
use gtk4 as gtk;

use super::drawing_area::{Align, PaintWidget, cairo, rgb, set_color, write};
use crate::plot::{Canvas, Color, Plot, Stroke, TextAnchor};

/// Paints a plot over the whole canvas.
pub(crate) fn paint(plot: &Plot, canvas: &PaintWidget, snapshot: &gtk::Snapshot, width: f64, height: f64) {
    let text = canvas.text_color();
    let mut cairo_canvas = CairoCanvas { context: cairo(snapshot, width, height), text, texts: Vec::new() };
    plot.draw(&mut cairo_canvas, width, height);
    let CairoCanvas { context, texts, .. } = cairo_canvas;
    // The shapes are handed over when their context ends; text goes on top.
    drop(context);
    for (text, (x, y), anchor, color) in texts {
        let align = match anchor {
            TextAnchor::Start => Align::Left,
            TextAnchor::Middle => Align::Centre,
            TextAnchor::End => Align::Right,
        };
        write(canvas, snapshot, &text, x, y, align, 0.8, &color);
    }
}

/// Draws shapes at once and keeps texts for later.
struct CairoCanvas {
    context: Context,
    text: RGBA,
    texts: Vec<(String, (f64, f64), TextAnchor, RGBA)>,
}

impl CairoCanvas {
    fn color(&self, color: Color) -> RGBA {
        match color {
            Color::Text => self.text,
            Color::Rgb(color) => rgb(color),
        }
    }
}

// Cairo fails only where memory is gone, and the next change draws again.
impl Canvas for CairoCanvas {
    fn rectangle(&mut self, [x, y, width, height]: [f64; 4], color: Color, opacity: f64) {
        set_color(&self.context, &self.color(color), opacity);
        self.context.rectangle(x, y, width, height);
        let _ = self.context.fill();
    }

    fn line(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        set_color(&self.context, &self.color(stroke.color), 1.0);
        self.context.set_line_width(stroke.width);
        self.context.set_dash(if stroke.dashed { &[5.0, 4.0] } else { &[] }, 0.0);
        self.context.new_path();
        for (x, y) in points {
            self.context.line_to(*x, *y);
        }
        let _ = self.context.stroke();
        self.context.set_dash(&[], 0.0);
    }

    fn disc(&mut self, (x, y): (f64, f64), radius: f64, color: Color, ring: Option<f64>) {
        set_color(&self.context, &self.color(color), 1.0);
        self.context.new_path();
        self.context.arc(x, y, radius, 0.0, std::f64::consts::TAU);
        let _ = match ring {
            Some(width) => {
                self.context.set_line_width(width);
                self.context.stroke()
            }
            None => self.context.fill(),
        };
    }

    fn text(&mut self, text: &str, at: (f64, f64), anchor: TextAnchor, color: Color, opacity: f64) {
        let color = self.color(color);
        self.texts.push((text.to_owned(), at, anchor, color.with_alpha(color.alpha() * opacity as f32)));
    }
}
