//! Plots of quantities against an angle or a time: thin axes, a few ticks, curves, published points behind them.
//!
//! One layout, [`Plot::draw`], places everything; a [`Canvas`] draws it on a widget, into an SVG document (`plot::svg`) or onto pixels (`plot::raster`), so
//! that a saved plot equals the one on the screen.

mod page;
mod raster;
mod svg;
mod ticks;

pub use page::{Page, PlotError};
use ticks::{label, ticks};

/// Room left of the plot for numbers, and on its other sides, logical pixels.
/// Text on white, `0xRRGGBB`.
const TEXT_COLOR: u32 = 0x1C_1F24;
const BACKGROUND: u32 = 0xFF_FFFF;
const LEFT: f64 = 54.0;
const RIGHT: f64 = 10.0;
const TOP: f64 = 22.0;
const BOTTOM: f64 = 36.0;
/// Height of a line of text.
const LINE_HEIGHT: f64 = 15.0;

/// A curve with its axes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Plot {
    /// Name and unit of the x axis; the unit follows the last `, `.
    pub x_label: String,
    /// Name and unit of the y axis.
    pub y_label: String,
    /// The curve that values are read from, ascending in x. A value that is not finite is a gap.
    pub points: Vec<(f64, f64)>,
    /// Name in the legend; empty = no legend.
    pub name: String,
    /// Its colour, `0xRRGGBB`.
    pub color: u32,
    /// More curves on the same axes.
    pub more_curves: Vec<PlotCurve>,
    /// Current x, marked by a line; none = not marked.
    pub cursor: Option<f64>,
    /// Position of the pointer, logical pixels from the left.
    pub pointer: Option<f64>,
    /// Published measurements, drawn behind the curves, in the units of the plot.
    pub reference_series: Vec<Series>,
    /// Colour of the published measurements.
    pub reference_color: u32,
    /// Smallest span of the y axis, so that rounding errors do not fill the plot.
    pub min_y_span: f64,
}

/// One more curve.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PlotCurve {
    /// Name in the legend.
    pub name: String,
    /// Colour, `0xRRGGBB`.
    pub color: u32,
    /// Ascending in x.
    pub points: Vec<(f64, f64)>,
}

/// Published points: a dashed line through several, a ring for one.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// The points, ascending in x.
    pub points: Vec<(f64, f64)>,
}

/// Where text stands against its point, which is on its upper edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextAnchor {
    /// The point is where it starts.
    Start,
    /// The point is in the middle.
    Middle,
    /// The point is where it ends.
    End,
}

/// A colour: that of text, or `0xRRGGBB`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Color {
    /// Whatever text has here.
    Text,
    /// A fixed one.
    Rgb(u32),
}

/// A line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub color: Color,
    /// Logical pixels.
    pub width: f64,
    /// Whether it is dashed.
    pub dashed: bool,
}

/// Target of drawing a plot. Positions are logical pixels, x right, y down.
pub trait Canvas {
    /// Fills a rectangle: left, top, width, height.
    fn rectangle(&mut self, place: [f64; 4], color: Color, opacity: f64);
    /// Draws a line through points.
    fn line(&mut self, points: &[(f64, f64)], stroke: Stroke);
    /// A disc, or a ring of this line width.
    fn disc(&mut self, centre: (f64, f64), radius: f64, color: Color, ring: Option<f64>);
    /// Small text.
    fn text(&mut self, text: &str, at: (f64, f64), anchor: TextAnchor, color: Color, opacity: f64);
}

impl Plot {
    fn bounds(&self) -> ((f64, f64), (f64, f64)) {
        let range = |values: &mut dyn Iterator<Item = f64>| {
            values
                .filter(|value| value.is_finite())
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
        };
        let curves = || self.points.iter().chain(self.more_curves.iter().flat_map(|curve| &curve.points));
        let across = range(&mut curves().map(|point| point.0));
        let (low, high) = range(&mut curves().chain(self.reference_series.iter().flat_map(|series| &series.points)).map(|point| point.1));
        // A constant curve gets a fixed padding, any other one a small share of its range.
        let padding = if high - low > 1e-9 * high.abs().max(1e-9) { (high - low) * 0.08 } else { high.abs().max(1e-6) * 0.5 };
        let missing = ((self.min_y_span - (high - low)) / 2.0).max(padding);
        let padding = if self.min_y_span > 0.0 { missing } else { padding };
        (across, (low - padding, high + padding))
    }

    /// The x under a place of a plot of this width.
    pub fn x_at(&self, pixel: f64, width: f64) -> Option<f64> {
        let ((from, to), _) = self.bounds();
        let fraction = ((pixel - LEFT) / (width - LEFT - RIGHT).max(1.0)).clamp(0.0, 1.0);
        (from < to).then_some(from + fraction * (to - from))
    }

    /// The curve's value at x, straight between its points.
    pub fn value(&self, x: f64) -> Option<f64> {
        let after = self.points.iter().position(|point| point.0 >= x)?;
        let (x1, y1) = *self.points.get(after)?;
        let Some((x0, y0)) = after.checked_sub(1).and_then(|before| self.points.get(before)).copied() else { return Some(y1) };
        Some(if x1 > x0 { y0 + (y1 - y0) * (x - x0) / (x1 - x0) } else { y1 })
    }

    /// Draws it into a rectangle of this size at the origin; nothing where there is nothing to draw.
    pub fn draw(&self, canvas: &mut dyn Canvas, width: f64, height: f64) {
        let ((from, to), (low, high)) = self.bounds();
        if from.partial_cmp(&to) != Some(std::cmp::Ordering::Less) {
            return;
        }
        let (right, bottom) = (width - RIGHT, height - BOTTOM);
        let x = |value: f64| LEFT + (value - from) / (to - from) * (right - LEFT);
        let y = |value: f64| bottom - (value - low) / (high - low) * (bottom - TOP);
        let (across, up) = (ticks(from, to, 5), ticks(low, high, 4));
        for tick in &up {
            canvas.rectangle([LEFT, y(*tick).round(), right - LEFT, 1.0], Color::Text, 0.12);
        }
        canvas.rectangle([LEFT, bottom.round(), right - LEFT, 1.0], Color::Text, 0.45);
        for tick in &across {
            canvas.rectangle([x(*tick).round(), bottom.round(), 1.0, 4.0], Color::Text, 0.45);
        }
        self.draw_reference_series(canvas, &x, &y, right);
        if let Some(cursor) = self.cursor {
            canvas.rectangle([x(cursor.clamp(from, to)).round(), TOP, 1.0, bottom - TOP], Color::Text, 0.8);
        }
        let main_curve = [(self.color, &self.points)];
        for (color, points) in self.more_curves.iter().map(|curve| (curve.color, &curve.points)).chain(main_curve) {
            for segment in points.split(|point| !point.1.is_finite()) {
                let segment: Vec<(f64, f64)> = segment.iter().map(|(px, py)| (x(*px), y(*py))).collect();
                canvas.line(&segment, Stroke { color: Color::Rgb(color), width: 2.0, dashed: false });
            }
        }
        let shown = self.pointer.and_then(|pixel| self.x_at(pixel, width)).or(self.cursor).map(|shown| shown.clamp(from, to));
        let readout = shown.and_then(|shown| Some((shown, self.value(shown).filter(|value| value.is_finite())?)));
        if let Some((shown, value)) = readout {
            canvas.disc((x(shown), y(value)), 3.5, Color::Rgb(self.color), None);
        }
        self.draw_legend(canvas);
        for tick in &up {
            canvas.text(&label(*tick, &up), (LEFT - 6.0, y(*tick) - 7.0), TextAnchor::End, Color::Text, 0.65);
        }
        for tick in &across {
            canvas.text(&label(*tick, &across), (x(*tick), bottom + 4.0), TextAnchor::Middle, Color::Text, 0.65);
        }
        canvas.text(&self.x_label, ((LEFT + right) / 2.0, bottom + 18.0), TextAnchor::Middle, Color::Text, 0.65);
        canvas.text(&self.y_label, (0.0, 1.0), TextAnchor::Start, Color::Text, 0.65);
        if let Some((shown, value)) = readout {
            let text = format!("{}: {}", ticks::with_unit_of(&self.x_label, shown), ticks::value(value, &up));
            canvas.text(&text, (right, 1.0), TextAnchor::End, Color::Text, 1.0);
        }
    }

    /// The names of the curves, where there are several, and of what was published.
    fn draw_legend(&self, canvas: &mut dyn Canvas) {
        let main_curve = Some((self.name.as_str(), self.color)).filter(|(name, _)| !name.is_empty());
        let beside = self.more_curves.iter().map(|curve| (curve.name.as_str(), curve.color));
        let curves = main_curve.into_iter().chain(beside).map(|(name, color)| (format!("— {name}"), color));
        let mark = |series: &Series| if series.points.len() > 1 { "- -" } else { "○" };
        let published = self.reference_series.iter().map(|series| (format!("{} {}", mark(series), series.name), self.reference_color));
        for (row, (name, color)) in curves.chain(published).enumerate() {
            canvas.text(&name, (LEFT + 8.0, TOP + 2.0 + LINE_HEIGHT * row as f64), TextAnchor::Start, Color::Rgb(color), 1.0);
        }
    }

    /// Published series: dashed where there are several points, with a dot each; a single one is larger and hollow, to be told from the others.
    fn draw_reference_series(&self, canvas: &mut dyn Canvas, x: &dyn Fn(f64) -> f64, y: &dyn Fn(f64) -> f64, right: f64) {
        let color = Color::Rgb(self.reference_color);
        let inside = |px: f64| (LEFT - 0.5..=right + 0.5).contains(&px);
        for series in &self.reference_series {
            let points: Vec<(f64, f64)> = series.points.iter().map(|(px, py)| (x(*px), y(*py))).filter(|point| inside(point.0)).collect();
            canvas.line(&points, Stroke { color, width: 1.5, dashed: true });
            for point in &points {
                if series.points.len() > 1 {
                    canvas.disc(*point, 2.5, color, None);
                } else {
                    canvas.disc(*point, 4.5, color, Some(1.5));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_is_read_between_its_points() {
        let plot = Plot { points: vec![(0.0, 1.0), (10.0, 3.0), (20.0, f64::NAN)], ..Plot::default() };
        assert_eq!((plot.value(5.0), plot.value(0.0), plot.value(99.0)), (Some(2.0), Some(1.0), None));
        assert_eq!(plot.x_at(-100.0, 300.0), Some(0.0));
        assert_eq!(Plot::default().x_at(50.0, 300.0), None);
    }

    /// Records what is drawn.
    #[derive(Default)]
    struct RecordingCanvas {
        lines: Vec<Vec<(f64, f64)>>,
        texts: Vec<String>,
    }

    impl Canvas for RecordingCanvas {
        fn rectangle(&mut self, [x, y, width, height]: [f64; 4], _: Color, _: f64) {
            assert!([x, y, width, height].iter().all(|value| value.is_finite()));
        }
        fn line(&mut self, points: &[(f64, f64)], _: Stroke) {
            self.lines.push(points.to_vec());
        }
        fn disc(&mut self, _: (f64, f64), _: f64, _: Color, _: Option<f64>) {}
        fn text(&mut self, text: &str, _: (f64, f64), _: TextAnchor, _: Color, _: f64) {
            self.texts.push(text.to_owned());
        }
    }

    #[test]
    fn a_gap_parts_the_line_and_every_point_lies_within_the_axes() {
        let points = vec![(0.0, -1.0), (1.0, 2.0), (2.0, f64::INFINITY), (3.0, 5.0), (4.0, 4.0)];
        let plot = Plot { points, name: "own".into(), x_label: "Time, s".into(), cursor: Some(3.5), ..Plot::default() };
        let mut recorded = RecordingCanvas::default();
        plot.draw(&mut recorded, 300.0, 200.0);
        assert_eq!(recorded.lines.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
        for (x, y) in recorded.lines.iter().flatten() {
            assert!((LEFT..=300.0 - RIGHT).contains(x) && (TOP..=200.0 - BOTTOM).contains(y), "{x} {y}");
        }
        assert!(
            recorded.texts.contains(&"— own".to_owned()) && recorded.texts.iter().any(|text| text.ends_with(": 4.5")),
            "{:?}",
            recorded.texts
        );
    }

    #[test]
    fn rounding_errors_do_not_fill_a_plot_with_a_least_span() {
        let plot = Plot { points: vec![(0.0, 0.0), (1.0, 2e-16)], min_y_span: 2e-12, ..Plot::default() };
        let (_, (low, high)) = plot.bounds();
        assert!((high - low - 2e-12).abs() < 1e-20, "{low} {high}");
    }
}
