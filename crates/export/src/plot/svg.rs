//! A plot as an SVG 1.1 document, for programs that print or edit.

use std::fmt::Write as _;

use super::TEXT_COLOR;
use super::{Canvas, Color, Stroke, TextAnchor};

/// Size of text and the height of its letters above the base line, logical pixels.
const SIZE: f64 = 11.0;
const ASCENT: f64 = 10.5;

/// A document that grows.
pub(super) struct SvgCanvas {
    text: String,
}

impl SvgCanvas {
    /// An empty one of this size, logical pixels.
    pub(super) fn new(width: f64, height: f64) -> Self {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             font-family=\"sans-serif\" font-size=\"{SIZE}\">\n"
        );
        Self { text }
    }

    /// The whole.
    pub(super) fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    fn write_element(&mut self, element: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = self.text.write_fmt(element);
        self.text.push('\n');
    }
}

/// `#RRGGBB`.
fn hex(color: Color) -> String {
    match color {
        Color::Text => format!("#{TEXT_COLOR:06X}"),
        Color::Rgb(color) => format!("#{:06X}", color & 0xFF_FFFF),
    }
}

/// A place to a hundredth of a pixel.
fn round_to_hundredth(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

fn escaped(text: &str) -> String {
    sinew_scene::visible::shown(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

impl Canvas for SvgCanvas {
    fn rectangle(&mut self, [x, y, width, height]: [f64; 4], color: Color, opacity: f64) {
        let [x, y, width, height] = [x, y, width, height].map(round_to_hundredth);
        let color = hex(color);
        self.write_element(format_args!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{color}\" fill-opacity=\"{opacity}\"/>"
        ));
    }

    fn line(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        if points.len() < 2 {
            return;
        }
        let dashes = if stroke.dashed { " stroke-dasharray=\"5 4\"" } else { "" };
        let points: Vec<String> = points.iter().map(|(x, y)| format!("{},{}", round_to_hundredth(*x), round_to_hundredth(*y))).collect();
        let (points, color, width) = (points.join(" "), hex(stroke.color), stroke.width);
        self.write_element(format_args!(
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"{dashes}/>"
        ));
    }

    fn disc(&mut self, (x, y): (f64, f64), radius: f64, color: Color, ring: Option<f64>) {
        let (x, y, color) = (round_to_hundredth(x), round_to_hundredth(y), hex(color));
        let paint = match ring {
            Some(width) => format!("fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\""),
            None => format!("fill=\"{color}\""),
        };
        self.write_element(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" {paint}/>"));
    }

    fn text(&mut self, text: &str, (x, y): (f64, f64), anchor: TextAnchor, color: Color, opacity: f64) {
        let anchor = match anchor {
            TextAnchor::Start => "start",
            TextAnchor::Middle => "middle",
            TextAnchor::End => "end",
        };
        let (x, y, color, text) = (round_to_hundredth(x), round_to_hundredth(y + ASCENT), hex(color), escaped(text));
        self.write_element(format_args!(
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" fill=\"{color}\" fill-opacity=\"{opacity}\">{text}</text>"
        ));
    }
}
