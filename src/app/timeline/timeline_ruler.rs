//! The drawn part of the timeline: rulers, keys, marks, cursor; and the pure arithmetic of where they stand.

use gtk::cairo::Context;
use gtk4 as gtk;

use crate::app::format;
use crate::app::widgets::drawing_area::{Align, PaintWidget, cairo, rgb, set_color, write, write_centered};
use crate::session::RangeMark;

/// Room left of the first and right of the last moment, logical pixels.
const INSET: f64 = 16.0;
/// Room above the track for the frame numbers.
const TOP: f64 = 18.0;
/// Steps of the ruler, seconds.
const SECONDS: [f64; 16] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 120.0, 300.0, 600.0, 3600.0];
/// Steps of the frame ruler.
const FRAMES: [f64; 13] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 5000.0, 20_000.0, 100_000.0];
/// Keys nearer than this are drawn as ticks, not as diamonds.
const DENSE: f64 = 9.0;

/// Frames that are visible at the highest zoom.
const FEWEST: f64 = 4.0;

/// Side of the tab of a mark, logical pixels.
const TAB: f64 = 14.0;

/// What the track shows.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Track {
    /// First and last moment of the clip, seconds.
    pub whole: (f64, f64),
    /// First and last moment that are shown, seconds.
    pub range: (f64, f64),
    /// The present moment.
    pub time: f64,
    /// Frames a second.
    pub rate: f64,
    /// Marks A and B.
    pub marks: (Option<f64>, Option<f64>),
    /// All keys, ascending.
    pub keys: Vec<f64>,
    /// The keys of the selection, ascending; filled.
    pub own_keys: Vec<f64>,
    /// Where the pointer is, logical pixels.
    pub pointer: Option<f64>,
    /// Whether the keyboard is here.
    pub focused: bool,
    /// What stands there where there is no clip.
    pub empty: String,
    /// The sign of a second.
    pub second: String,
    /// Colour of the cursor.
    pub accent: u32,
}

impl Track {
    /// Shows another stretch of time, all of it; the same one stays as closely looked at as it is.
    pub(crate) fn show(&mut self, whole: (f64, f64)) {
        if self.whole != whole {
            (self.whole, self.range) = (whole, whole);
        }
    }

    /// Whether not all of it is shown.
    pub(crate) fn is_close(&self) -> bool {
        self.range != self.whole
    }

    /// Looks `factor` times as closely, a moment staying where it is; at most all of it, at least a few frames.
    pub(crate) fn zoom(&mut self, factor: f64, about: f64) {
        let (start, end) = self.range;
        let all = self.whole.1 - self.whole.0;
        if all <= 0.0 || factor.is_nan() || factor <= 0.0 || self.rate <= 0.0 {
            return;
        }
        let about = about.clamp(start, end);
        let span = ((end - start) / factor).clamp((FEWEST / self.rate).min(all), all);
        let part = if end > start { (about - start) / (end - start) } else { 0.0 };
        self.begin(about - part * span, span);
    }

    /// Moves what is shown by a part of it.
    pub(crate) fn slide(&mut self, part: f64) {
        let span = self.range.1 - self.range.0;
        self.begin(self.range.0 + part * span, span);
    }

    /// Lets a moment that is not shown come in at the near end.
    pub(crate) fn keep(&mut self, time: f64) {
        let (start, end) = self.range;
        if time > end {
            self.begin(time - 0.1 * (end - start), end - start);
        } else if time < start {
            self.begin(time - 0.9 * (end - start), end - start);
        }
    }

    fn begin(&mut self, start: f64, span: f64) {
        let (first, last) = self.whole;
        // Of all there is no rounded start.
        self.range = if span >= last - first {
            self.whole
        } else {
            let start = start.min(last - span).max(first);
            (start, start + span)
        };
    }

    /// Where a moment stands on a track of this width.
    pub(crate) fn x(&self, time: f64, width: f64) -> f64 {
        let (start, end) = self.range;
        let part = if end > start { (time - start) / (end - start) } else { 0.0 };
        INSET + part * (width - 2.0 * INSET).max(1.0)
    }

    /// Which moment stands at a place, held within the range.
    pub(crate) fn time_at(&self, x: f64, width: f64) -> f64 {
        let (start, end) = self.range;
        let part = (x - INSET) / (width - 2.0 * INSET).max(1.0);
        start + part.clamp(0.0, 1.0) * (end - start)
    }

    /// The smallest of `steps` (in units of which `rate` make a second) whose marks stand at least `room` pixels apart.
    fn step(&self, steps: &[f64], rate: f64, room: f64, width: f64) -> f64 {
        let pixels_a_second = self.x(self.range.0 + 1.0, width) - self.x(self.range.0, width);
        let fits = |step: &&f64| **step / rate * pixels_a_second >= room;
        steps.iter().find(fits).or(steps.last()).copied().unwrap_or(1.0)
    }

    /// The mark whose tab lies at a place.
    pub(crate) fn mark_at(&self, x: f64, y: f64, width: f64) -> Option<RangeMark> {
        let within = |mark: Option<f64>, from: f64, to: f64| mark.is_some_and(|mark| (from..=to).contains(&(x - self.x(mark, width))));
        if !(TOP - 2.0..=TOP + TAB + 2.0).contains(&y) || self.range.1 <= self.range.0 {
            None
        } else if within(self.marks.0, -4.0, TAB + 1.0) {
            Some(RangeMark::A)
        } else {
            within(self.marks.1, -TAB - 1.0, 4.0).then_some(RangeMark::B)
        }
    }

    /// The tabs by which the marks are dragged.
    fn tabs(&self, canvas: &PaintWidget, snapshot: &gtk::Snapshot, width: f64, height: f64) {
        let shown = |mark: Option<f64>| mark.filter(|mark| (self.range.0..=self.range.1).contains(mark));
        let tabs = [(shown(self.marks.0), 0.0, "A"), (shown(self.marks.1), -TAB, "B")].into_iter();
        for (x, letter) in tabs.filter_map(|(mark, shift, letter)| mark.map(|mark| (self.x(mark, width).round() + shift, letter))) {
            let context = cairo(snapshot, width, height);
            set_color(&context, &rgb(self.accent), 0.95);
            context.rectangle(x, TOP, TAB, TAB);
            fill(&context);
            drop(context);
            write_centered(canvas, snapshot, letter, (x + TAB / 2.0, TOP + TAB / 2.0), 0.75, &rgb(0xFF_FFFF));
        }
    }

    /// Paints it.
    pub(crate) fn paint(&self, canvas: &PaintWidget, snapshot: &gtk::Snapshot, width: f64, height: f64) {
        let text = canvas.text_color();
        let context = cairo(snapshot, width, height);
        let (top, bottom) = (TOP, height - 18.0);
        set_color(&context, &text, 0.05);
        rounded(&context, 0.5, top, width - 1.0, bottom - top, 4.0);
        fill(&context);
        if self.range.1 <= self.range.0 {
            drop(context);
            write(canvas, snapshot, &self.empty, width / 2.0, height / 2.0 - 9.0, Align::Centre, 1.0, &text.with_alpha(0.55));
            return;
        }
        rounded(&context, 0.5, top - 2.0, width - 1.0, bottom - top + 4.0, 4.0);
        context.clip();
        if let (from, to) = (self.marks.0.unwrap_or(self.whole.0), self.marks.1.unwrap_or(self.whole.1))
            && self.marks != (None, None)
        {
            set_color(&context, &rgb(self.accent), 0.18);
            context.rectangle(self.x(from, width), top, self.x(to, width) - self.x(from, width), bottom - top);
            fill(&context);
            set_color(&context, &rgb(self.accent), 0.9);
            for mark in [self.marks.0, self.marks.1].into_iter().flatten() {
                context.rectangle(self.x(mark, width).round() - 0.5, top, 1.0, bottom - top);
            }
            fill(&context);
        }
        let second_step = self.step(&SECONDS, 1.0, 64.0, width);
        let frame_step = self.step(&FRAMES, self.rate, 44.0, width);
        set_color(&context, &text, 0.22);
        for time in grid(self.range, second_step) {
            context.rectangle(self.x(time, width).round(), bottom - 6.0, 1.0, 6.0);
        }
        for frame in grid((self.range.0 * self.rate, self.range.1 * self.rate), frame_step) {
            context.rectangle(self.x(frame / self.rate, width).round(), top, 1.0, 4.0);
        }
        fill(&context);
        let middle = (top + bottom) / 2.0;
        set_color(&context, &text, 0.15);
        context.rectangle(INSET, middle.round(), width - 2.0 * INSET, 1.0);
        fill(&context);
        let filled = if self.own_keys.is_empty() { &self.keys } else { &self.own_keys };
        set_color(&context, &text, 0.6);
        if !self.own_keys.is_empty() {
            self.keys(&context, &self.keys, width, middle, false);
        }
        set_color(&context, &text, 0.85);
        self.keys(&context, filled, width, middle, true);
        if let Some(x) = self.pointer {
            set_color(&context, &text, 0.35);
            context.rectangle(self.x(self.time_at(x, width), width).round(), top, 1.0, bottom - top);
            fill(&context);
        }
        let cursor = self.x(self.time, width);
        set_color(&context, &rgb(self.accent), 1.0);
        context.rectangle(cursor.round() - 1.0, top - 2.0, 2.0, bottom - top + 4.0);
        fill(&context);
        if self.is_close() {
            // Which part of the whole it is.
            let all = (self.whole.1 - self.whole.0).max(1e-9);
            let [from, to] = [self.range.0, self.range.1].map(|time| (time - self.whole.0) / all * width);
            set_color(&context, &text, 0.45);
            context.rectangle(from, bottom - 3.0, (to - from).max(6.0), 3.0);
            fill(&context);
        }
        context.reset_clip();
        if self.focused {
            set_color(&context, &rgb(self.accent), 0.6);
            rounded(&context, 1.5, top - 1.0, width - 3.0, bottom - top + 2.0, 5.0);
            context.set_line_width(1.5);
            let _ = context.stroke();
        }
        drop(context);
        self.tabs(canvas, snapshot, width, height);
        self.labels(canvas, snapshot, width, height, second_step, frame_step);
    }

    fn keys(&self, context: &Context, keys: &[f64], width: f64, y: f64, filled: bool) {
        let spread = match (keys.first(), keys.last()) {
            (Some(first), Some(last)) if keys.len() > 1 => (self.x(*last, width) - self.x(*first, width)) / (keys.len() - 1) as f64,
            _ => f64::INFINITY,
        };
        let mut last_x = f64::NEG_INFINITY;
        for key in keys.iter().filter(|key| (self.range.0..=self.range.1).contains(*key)) {
            let x = self.x(*key, width).round() + 0.5;
            if x < last_x + 1.5 {
                continue;
            }
            last_x = x;
            if spread < DENSE {
                let half = if filled { 6.0 } else { 3.0 };
                context.rectangle(x - 0.5, y - half, 1.0, 2.0 * half);
            } else {
                for (index, (dx, dy)) in [(0.0, -3.5), (3.5, 0.0), (0.0, 3.5), (-3.5, 0.0)].into_iter().enumerate() {
                    if index == 0 { context.move_to(x + dx, y + 0.5 + dy) } else { context.line_to(x + dx, y + 0.5 + dy) }
                }
                context.close_path();
            }
        }
        if filled || spread < DENSE {
            fill(context);
        } else {
            context.set_line_width(1.0);
            let _ = context.stroke();
        }
    }

    fn labels(&self, canvas: &PaintWidget, snapshot: &gtk::Snapshot, width: f64, height: f64, second_step: f64, frame_step: f64) {
        let dim = canvas.text_color().with_alpha(0.65);
        let digits = if second_step < 0.1 { 2 } else { usize::from(second_step < 1.0) };
        // The flags of the cursor and the pointer stand in the place of ruler labels.
        let mut flags = vec![self.x(self.time, width)];
        flags.extend(self.pointer);
        let free = |x: f64, room: f64| flags.iter().all(|flag| (flag - x).abs() > room);
        for time in grid(self.range, second_step) {
            let x = self.x(time, width);
            if free(x, 34.0) {
                write(canvas, snapshot, &format::number(time, digits), x, height - 17.0, Align::Centre, 0.8, &dim);
            }
        }
        for frame in grid((self.range.0 * self.rate, self.range.1 * self.rate), frame_step) {
            let x = self.x(frame / self.rate, width);
            if free(x, 24.0) {
                write(canvas, snapshot, &format::number(frame, 0), x, 1.0, Align::Centre, 0.8, &dim);
            }
        }
        // Next to the cursor there is no room for a second flag.
        if let Some(x) = self.pointer.filter(|x| (x - self.x(self.time, width)).abs() > 52.0) {
            let time = self.time_at(x, width);
            self.flag(canvas, snapshot, time, width, height, &canvas.text_color().with_alpha(0.8));
        }
        if (self.range.0..=self.range.1).contains(&self.time) {
            self.flag(canvas, snapshot, self.time, width, height, &rgb(self.accent));
        }
    }

    /// The moment in seconds below and as a frame above.
    fn flag(&self, canvas: &PaintWidget, snapshot: &gtk::Snapshot, time: f64, width: f64, height: f64, color: &gtk::gdk::RGBA) {
        let x = self.x(time, width);
        write(canvas, snapshot, &format::with_unit(time, 2, &self.second), x, height - 17.0, Align::Centre, 0.8, color);
        write(canvas, snapshot, &format::number(frame_of(time, self.rate), 0), x, 1.0, Align::Centre, 0.8, color);
    }
}

/// The frame that is shown at a moment.
pub(crate) fn frame_of(time: f64, rate: f64) -> f64 {
    (time * rate + 1e-4).floor()
}

fn fill(context: &Context) {
    // Cairo fails only where memory is gone, and the next change draws again.
    let _ = context.fill();
}

fn rounded(context: &Context, x: f64, y: f64, width: f64, height: f64, radius: f64) {
    let quarter = std::f64::consts::FRAC_PI_2;
    context.new_sub_path();
    context.arc(x + width - radius, y + radius, radius, -quarter, 0.0);
    context.arc(x + width - radius, y + height - radius, radius, 0.0, quarter);
    context.arc(x + radius, y + height - radius, radius, quarter, 2.0 * quarter);
    context.arc(x + radius, y + radius, radius, 2.0 * quarter, 3.0 * quarter);
    context.close_path();
}

/// Multiples of `step` within a range, at most a thousand.
fn grid((from, to): (f64, f64), step: f64) -> impl Iterator<Item = f64> {
    let first = (from / step - 1e-6).ceil();
    let count = ((to / step + 1e-6).floor() - first + 1.0).clamp(0.0, 1000.0) as u32;
    (0..count).map(move |index| (first + f64::from(index)) * step)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track() -> Track {
        let mut track = Track { rate: 24.0, ..Track::default() };
        track.show((0.5, 4.5));
        track
    }

    #[test]
    fn a_closer_look_keeps_the_moment_and_stays_within_the_clip() {
        let mut track = track();
        let before = track.x(1.5, 800.0);
        track.zoom(2.0, 1.5);
        assert!(track.is_close() && (track.x(1.5, 800.0) - before).abs() < 1e-9);
        assert!((track.range.1 - track.range.0 - 2.0).abs() < 1e-12);
        track.zoom(1e9, 1.5);
        assert!((track.range.1 - track.range.0 - FEWEST / 24.0).abs() < 1e-9, "{:?}", track.range);
        track.slide(1e9);
        assert_eq!(track.range.1, 4.5);
        track.keep(1.0);
        assert!(track.range.0 <= 1.0 && track.range.1 >= 1.0);
        // The same clip stays as close; all of it is all of it to the bit; another clip is shown whole.
        track.show((0.5, 4.5));
        assert!(track.is_close());
        track.zoom(1e-9, 1.0);
        assert_eq!((track.range, track.is_close()), ((0.5, 4.5), false));
        track.zoom(4.0, 2.0);
        track.show((0.0, 1.0));
        assert_eq!(track.range, (0.0, 1.0));
        for factor in [0.0, -1.0, f64::NAN] {
            track.zoom(factor, 0.5);
        }
        Track::default().zoom(2.0, 0.0);
        assert_eq!(track.range, (0.0, 1.0));
    }

    #[test]
    fn places_and_moments_are_inverse_and_held_at_the_ends() {
        let track = track();
        for time in [0.5, 1.0, 4.5] {
            assert!((track.time_at(track.x(time, 800.0), 800.0) - time).abs() < 1e-12);
        }
        assert_eq!((track.time_at(-50.0, 800.0), track.time_at(9000.0, 800.0)), (0.5, 4.5));
        assert!(Track::default().time_at(30.0, 0.0).is_finite());
    }

    #[test]
    fn marks_are_held_by_their_tabs() {
        let track = Track { marks: (Some(1.0), Some(3.0)), ..track() };
        let (a, b) = (track.x(1.0, 800.0), track.x(3.0, 800.0));
        assert_eq!(track.mark_at(a + 5.0, TOP + 5.0, 800.0), Some(RangeMark::A));
        assert_eq!(track.mark_at(b - 5.0, TOP + 5.0, 800.0), Some(RangeMark::B));
        assert_eq!(track.mark_at(b + 9.0, TOP + 5.0, 800.0), None);
        assert_eq!(track.mark_at(a + 5.0, TOP + 30.0, 800.0), None);
        assert_eq!(Track::default().mark_at(20.0, 20.0, 800.0), None);
    }

    #[test]
    fn ruler_marks_stand_far_enough_apart() {
        let track = track();
        for width in [80.0, 400.0, 1600.0] {
            let step = track.step(&SECONDS, 1.0, 64.0, width);
            assert!(track.x(step, width) - track.x(0.0, width) >= 64.0 || step == 3600.0);
        }
        assert_eq!(grid((0.5, 4.5), 1.0).collect::<Vec<_>>(), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(grid((0.0, 1e12), 1.0).count(), 1000);
    }

    #[test]
    fn a_frame_lasts_until_the_next() {
        assert_eq!(frame_of(1.0 / 24.0, 24.0), 1.0);
        assert_eq!(frame_of(1.9 / 24.0, 24.0), 1.0);
    }
}
