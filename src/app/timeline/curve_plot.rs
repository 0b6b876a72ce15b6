//! Drawing of the curve editor: curves with keys and tangents on the time axis of the timeline.

use gtk::cairo::{Context, LineJoin};
use gtk4 as gtk;

use super::timeline_ruler::Track;
use crate::app::format;
use crate::app::widgets::drawing_area::{Align, PaintWidget, cairo, rgb, set_color, write};
use crate::session::{CurveGraph, ValueGraph};

/// Room above the highest and below the lowest value, logical pixels.
const AIR: f64 = 14.0;
/// Steps of the value axis are these times a power of ten.
const STEPS: [f64; 3] = [1.0, 2.0, 5.0];
/// Keys nearer than this, logical pixels, are drawn as small dots without tangents.
const DENSE: f64 = 7.0;

/// What the curve view shows.
#[derive(Debug, Clone, Default)]
pub(crate) struct CurvePlot {
    /// The graph; none where nothing is animated.
    pub graph: Option<CurveGraph>,
    /// Colours of X, Y, Z.
    pub colors: [u32; 3],
    /// What stands there without a graph.
    empty: String,
    /// Lowest and highest value.
    range: (f64, f64),
}

impl CurvePlot {
    /// One without a graph, which says so.
    pub(crate) fn new(empty: String) -> Self {
        Self { empty, ..Self::default() }
    }

    /// Shows another graph over a stretch of time.
    pub(crate) fn set(&mut self, graph: Option<CurveGraph>, (start, end): (f64, f64)) {
        let mut range = (f64::INFINITY, f64::NEG_INFINITY);
        let mut see = |value: f64| {
            if value.is_finite() {
                range = (range.0.min(value), range.1.max(value));
            }
        };
        for line in graph.iter().flat_map(|graph| &graph.lines) {
            (0..=400).for_each(|step| see(line.value(start + (end - start) * f64::from(step) / 400.0)));
            line.keys().iter().filter(|key| (start..=end).contains(*key)).take(2000).for_each(|key| see(line.value(*key)));
        }
        // A level line stands in the middle.
        let flat = (range.1 - range.0).abs() <= 1e-9 * range.0.abs().max(range.1.abs()).max(1e-6);
        if flat && range.0.is_finite() {
            let room = (range.0.abs() * 0.5).max(0.5);
            range = (range.0 - room, range.1 + room);
        }
        self.range = if range.0 < range.1 { range } else { (-1.0, 1.0) };
        self.graph = graph;
    }

    fn y(&self, value: f64, height: f64) -> f64 {
        let (low, high) = self.range;
        height - AIR - (value - low) / (high - low) * (height - 2.0 * AIR).max(1.0)
    }

    fn color(&self, line: &ValueGraph) -> gtk::gdk::RGBA {
        rgb(self.colors.get(line.axis % 3).copied().unwrap_or(0x88_8888))
    }

    /// Paints it; the time axis is that of `track`, which is `width` wide and starts at `left`.
    pub(crate) fn paint(
        &self,
        canvas: &PaintWidget,
        snapshot: &gtk::Snapshot,
        (full, height): (f64, f64),
        track: &Track,
        (left, width): (f64, f64),
    ) {
        let text = canvas.text_color();
        let Some(graph) = self.graph.as_ref().filter(|_| track.range.1 > track.range.0) else {
            write(canvas, snapshot, &self.empty, full / 2.0, height / 2.0 - 9.0, Align::Centre, 1.0, &text.with_alpha(0.55));
            return;
        };
        let ticks = self.ticks(height);
        let context = cairo(snapshot, full, height);
        for (value, _) in &ticks {
            set_color(&context, &text, if *value == 0.0 { 0.25 } else { 0.1 });
            context.rectangle(left, self.y(*value, height).round(), width, 1.0);
            fill(&context);
        }
        context.rectangle(left, 0.0, width, height);
        context.clip();
        for line in &graph.lines {
            set_color(&context, &self.color(line), 1.0);
            self.curve(&context, line, height, track, (left, width));
            self.keys(&context, line, height, track, (left, width));
        }
        drop(context);
        for (value, label) in &ticks {
            write(canvas, snapshot, label, 8.0, self.y(*value, height) - 8.0, Align::Left, 0.8, &text.with_alpha(0.65));
        }
    }

    /// Round values with their labels, far enough apart to be read.
    fn ticks(&self, height: f64) -> Vec<(f64, String)> {
        let (low, high) = self.range;
        let least = (high - low) * 26.0 / (height - 2.0 * AIR).max(26.0);
        let power = 10f64.powf(least.log10().floor());
        let step = STEPS.iter().map(|step| step * power).find(|step| *step >= least).unwrap_or(10.0 * power);
        let digits = (-step.log10().floor()).clamp(0.0, 6.0) as usize;
        let (first, last) = ((low / step).ceil(), (high / step).floor());
        let count = (last - first + 1.0).clamp(0.0, 20.0) as u32;
        (0..count).map(|index| (first + f64::from(index)) * step).map(|value| (value, format::number(value, digits))).collect()
    }

    fn curve(&self, context: &Context, line: &ValueGraph, height: f64, track: &Track, (left, width): (f64, f64)) {
        let (start, end) = (track.x(track.range.0, width), track.x(track.range.1, width));
        context.set_line_width(1.5);
        context.set_line_join(LineJoin::Round);
        let mut before: Option<f64> = None;
        let mut x = start;
        while x <= end {
            let value = line.value(track.time_at(x, width));
            // A turn that goes past 180° goes on at −180°: there is no line between.
            let joins = before.is_some_and(|before| (before - value).abs() < 300.0 || self.range.1 - self.range.0 < 300.0);
            let y = self.y(value, height);
            if joins {
                context.line_to(left + x, y)
            } else {
                context.move_to(left + x, y)
            }
            before = Some(value);
            x += 1.0;
        }
        stroke(context);
    }

    fn keys(&self, context: &Context, line: &ValueGraph, height: f64, track: &Track, (left, width): (f64, f64)) {
        let times = line.keys();
        let (start, end) = track.range;
        let shown = times.iter().filter(|time| (start..=end).contains(*time)).count();
        let spread = (track.x(end, width) - track.x(start, width)) / shown.max(1) as f64;
        let place = |(time, value): (f64, f64)| (left + track.x(time, width), self.y(value, height));
        let mut last = f64::NEG_INFINITY;
        for (index, time) in times.iter().enumerate().filter(|(_, time)| (start..=end).contains(*time)) {
            let key = place((*time, line.value(*time)));
            if key.0 < last + 2.0 {
                continue;
            }
            last = key.0;
            let half = if spread < DENSE { 1.5 } else { 3.5 };
            diamond(context, key, half);
            fill(context);
            if spread < DENSE * 3.0 {
                continue;
            }
            let next = times.get(index + 1).map(|next| (*next, line.value(*next)));
            if let (Some([out, into]), Some(next)) = (line.tangents(index), next) {
                context.set_line_width(1.0);
                for (from, to) in [(key, place(out)), (place(next), place(into))] {
                    context.move_to(from.0, from.1);
                    context.line_to(to.0, to.1);
                    stroke(context);
                    context.arc(to.0, to.1, 2.5, 0.0, std::f64::consts::TAU);
                    stroke(context);
                }
            }
        }
    }
}

/// A diamond about a point.
pub(crate) fn diamond(context: &Context, (x, y): (f64, f64), half: f64) {
    context.move_to(x, y - half);
    context.line_to(x + half, y);
    context.line_to(x, y + half);
    context.line_to(x - half, y);
    context.close_path();
}

fn fill(context: &Context) {
    // Cairo fails only where memory is gone, and the next change draws again.
    let _ = context.fill();
}

fn stroke(context: &Context) {
    let _ = context.stroke();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_round_ticks_inside_the_range() {
        for range in [(-1.0, 1.0), (0.0, 0.004), (-187.0, 92.0), (1e6, 1.5e6)] {
            let plot = CurvePlot { range, ..CurvePlot::default() };
            let ticks = plot.ticks(150.0);
            assert!((2..=8).contains(&ticks.len()), "{range:?}: {ticks:?}");
            for (value, _) in &ticks {
                assert!(*value >= range.0 - 1e-9 && *value <= range.1 + 1e-9);
                let y = plot.y(*value, 150.0);
                assert!((AIR - 1e-6..=150.0 - AIR + 1e-6).contains(&y));
            }
        }
    }

    #[test]
    fn nothing_animated_has_a_range_too() {
        let mut plot = CurvePlot::default();
        plot.set(None, (0.0, 0.0));
        assert_eq!(plot.range, (-1.0, 1.0));
    }
}
