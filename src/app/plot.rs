//! A plot of one quantity against the elbow angle: thin axes, a few ticks, the present angle marked, the value under the pointer.

use gtk::cairo::Context;
use gtk4 as gtk;

use super::canvas::{Align, Canvas, cairo, rgb, set_color, write};
use super::format;

/// Room left of the plot for numbers, and on its other sides, logical pixels.
const LEFT: f64 = 46.0;
const RIGHT: f64 = 10.0;
const TOP: f64 = 22.0;
const BOTTOM: f64 = 36.0;

/// A curve with its axes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Plot {
    /// Name and unit of what goes right.
    pub across: String,
    /// Name and unit of what goes up.
    pub up: String,
    /// The curve, ascending in x.
    pub points: Vec<(f64, f64)>,
    /// The present x.
    pub cursor: f64,
    /// Colour of the curve.
    pub color: u32,
    /// Where the pointer is, logical pixels.
    pub pointer: Option<f64>,
    /// What others published, drawn behind, in the units of the plot.
    pub published: Vec<Series>,
    /// Colour of that.
    pub published_color: u32,
}

/// Published points: a dashed line through several, a dot for one.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Series {
    /// What the legend calls it.
    pub name: String,
    /// The points, ascending in x.
    pub points: Vec<(f64, f64)>,
}

impl Plot {
    fn bounds(&self) -> ((f64, f64), (f64, f64)) {
        let range = |values: &mut dyn Iterator<Item = f64>| {
            values
                .filter(|value| value.is_finite())
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
        };
        let across = range(&mut self.points.iter().map(|point| point.0));
        let all = self.points.iter().chain(self.published.iter().flat_map(|series| &series.points));
        let (low, high) = range(&mut all.map(|point| point.1));
        // A level line gets room above and below; any other one a little air.
        let air = if high - low > 1e-9 * high.abs().max(1e-9) { (high - low) * 0.08 } else { high.abs().max(1e-6) * 0.5 };
        (across, (low - air, high + air))
    }

    /// The x under a place of a plot of this width.
    pub fn x_at(&self, pixel: f64, width: f64) -> Option<f64> {
        let ((from, to), _) = self.bounds();
        let part = ((pixel - LEFT) / (width - LEFT - RIGHT).max(1.0)).clamp(0.0, 1.0);
        (from < to).then_some(from + part * (to - from))
    }

    /// The curve's value at x, straight between its points.
    pub fn value(&self, x: f64) -> Option<f64> {
        let after = self.points.iter().position(|point| point.0 >= x)?;
        let (x1, y1) = *self.points.get(after)?;
        let Some((x0, y0)) = after.checked_sub(1).and_then(|before| self.points.get(before)).copied() else { return Some(y1) };
        Some(if x1 > x0 { y0 + (y1 - y0) * (x - x0) / (x1 - x0) } else { y1 })
    }

    /// Paints it.
    pub fn paint(&self, canvas: &Canvas, snapshot: &gtk::Snapshot, width: f64, height: f64) {
        let ((from, to), (low, high)) = self.bounds();
        if from.partial_cmp(&to) != Some(std::cmp::Ordering::Less) {
            return;
        }
        let (right, bottom) = (width - RIGHT, height - BOTTOM);
        let x = |value: f64| LEFT + (value - from) / (to - from) * (right - LEFT);
        let y = |value: f64| bottom - (value - low) / (high - low) * (bottom - TOP);
        let text = canvas.text_color();
        let dim = text.with_alpha(0.65);
        let (across, up) = (ticks(from, to, 5), ticks(low, high, 4));
        let context = cairo(snapshot, width, height);
        set_color(&context, &text, 0.12);
        for tick in &up {
            context.rectangle(LEFT, y(*tick).round(), right - LEFT, 1.0);
        }
        fill(&context);
        set_color(&context, &text, 0.45);
        context.rectangle(LEFT, bottom.round(), right - LEFT, 1.0);
        for tick in &across {
            context.rectangle(x(*tick).round(), bottom.round(), 1.0, 4.0);
        }
        fill(&context);
        self.paint_published(&context, &x, &y, right);
        set_color(&context, &text, 0.8);
        context.rectangle(x(self.cursor.clamp(from, to)).round(), TOP, 1.0, bottom - TOP);
        fill(&context);
        set_color(&context, &rgb(self.color), 1.0);
        context.set_line_width(2.0);
        let mut pen_down = false;
        for (px, py) in &self.points {
            if !py.is_finite() {
                pen_down = false;
            } else if pen_down {
                context.line_to(x(*px), y(*py));
            } else {
                context.move_to(x(*px), y(*py));
                pen_down = true;
            }
        }
        // Cairo fails only where memory is gone, and the next change draws again.
        let _ = context.stroke();
        let shown = self.pointer.and_then(|pixel| self.x_at(pixel, width)).unwrap_or(self.cursor.clamp(from, to));
        let value = self.value(shown).filter(|value| value.is_finite());
        if let Some(value) = value {
            context.arc(x(shown), y(value), 3.5, 0.0, std::f64::consts::TAU);
            fill(&context);
        }
        drop(context);
        let names = self.published.iter().map(|series| format!("{} {}", if series.points.len() > 1 { "- -" } else { "○" }, series.name));
        let grey = rgb(self.published_color);
        for (row, name) in names.enumerate() {
            write(canvas, snapshot, &name, LEFT + 8.0, TOP + 2.0 + 15.0 * row as f64, Align::Left, 0.8, &grey);
        }
        let digits = digits_of(&up);
        for tick in &up {
            let label = format::number(*tick, digits);
            write(canvas, snapshot, &label, LEFT - 6.0 - label.chars().count() as f64 * 6.0, y(*tick) - 7.0, Align::Left, 0.8, &dim);
        }
        for tick in &across {
            write(canvas, snapshot, &format::number(*tick, 0), x(*tick), bottom + 4.0, Align::Centre, 0.8, &dim);
        }
        write(canvas, snapshot, &self.across, (LEFT + right) / 2.0, bottom + 18.0, Align::Centre, 0.8, &dim);
        write(canvas, snapshot, &self.up, 0.0, 1.0, Align::Left, 0.8, &dim);
        if let Some(value) = value {
            // The unit stands behind the name of the axis.
            let unit = self.across.rsplit_once(", ").map_or("", |(_, unit)| unit);
            let (digits_across, gap) = if unit == "°" { (1, "") } else { (2, "\u{2009}") };
            let told = format!("{}{gap}{unit}: {}", format::number(shown, digits_across), format::number(value, digits + 1));
            write(canvas, snapshot, &told, width - RIGHT - told.chars().count() as f64 * 6.2, 1.0, Align::Left, 0.8, &text);
        }
    }
}

impl Plot {
    /// Published series: dashed where there are several points, with a dot each; the last one is larger and hollow, to be told from the others.
    fn paint_published(&self, context: &Context, x: &dyn Fn(f64) -> f64, y: &dyn Fn(f64) -> f64, right: f64) {
        set_color(context, &rgb(self.published_color), 1.0);
        context.set_line_width(1.5);
        let inside = |px: f64| (LEFT - 0.5..=right + 0.5).contains(&px);
        for series in &self.published {
            let points: Vec<(f64, f64)> = series.points.iter().map(|(px, py)| (x(*px), y(*py))).filter(|point| inside(point.0)).collect();
            context.set_dash(&[5.0, 4.0], 0.0);
            for (px, py) in &points {
                context.line_to(*px, *py);
            }
            let _ = context.stroke();
            context.set_dash(&[], 0.0);
            for (px, py) in &points {
                context.new_sub_path();
                context.arc(*px, *py, if points.len() > 1 { 2.5 } else { 4.5 }, 0.0, std::f64::consts::TAU);
                if points.len() > 1 {
                    fill(context);
                } else {
                    let _ = context.stroke();
                }
            }
        }
    }
}

fn fill(context: &Context) {
    let _ = context.fill();
}

/// Round numbers within a range, about `count` of them.
fn ticks(from: f64, to: f64, count: u32) -> Vec<f64> {
    let rough = (to - from) / f64::from(count.max(1));
    if !(rough.is_finite() && rough > 0.0) {
        return Vec::new();
    }
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 3.0, 5.0, 10.0].map(|factor| factor * power).into_iter().find(|step| *step >= rough).unwrap_or(power * 10.0);
    let first = (from / step - 1e-9).ceil();
    (0..20).map(|index| (first + f64::from(index)) * step).take_while(|tick| *tick <= to + step * 1e-9).collect()
}

/// Decimals that tell ticks apart.
fn digits_of(ticks: &[f64]) -> usize {
    match ticks {
        [a, b, ..] => (-(b - a).log10().floor()).clamp(0.0, 9.0) as usize,
        _ => 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_few() {
        assert_eq!(ticks(0.0, 150.0, 5), [0.0, 30.0, 60.0, 90.0, 120.0, 150.0]);
        for (from, to) in [(-3.2, 7.9), (1e-6, 3e-6), (199.0, 201.0)] {
            let found = ticks(from, to, 4);
            assert!((2..=6).contains(&found.len()), "{found:?}");
            assert!(found.iter().all(|tick| *tick >= from - 1e-9 && *tick <= to + 1e-9));
        }
        assert!(ticks(1.0, 1.0, 4).is_empty() && ticks(f64::NAN, 1.0, 4).is_empty());
        assert_eq!((digits_of(&[0.0, 0.5]), digits_of(&[0.0, 30.0])), (1, 0));
    }

    #[test]
    fn the_curve_is_read_between_its_points() {
        let plot = Plot { points: vec![(0.0, 1.0), (10.0, 3.0), (20.0, f64::NAN)], ..Plot::default() };
        assert_eq!((plot.value(5.0), plot.value(0.0), plot.value(99.0)), (Some(2.0), Some(1.0), None));
        assert_eq!(plot.x_at(-100.0, 300.0), Some(0.0));
        assert_eq!(Plot::default().x_at(50.0, 300.0), None);
    }
}
