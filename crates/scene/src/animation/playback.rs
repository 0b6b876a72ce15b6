//! The time cursor: playback, seeking, looping. It has no clock: its caller passes the elapsed time.

use std::ops::RangeInclusive;

/// What happens at the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LoopMode {
    /// Starts again.
    #[default]
    Loop,
    /// Stops.
    Once,
    /// Plays back and forth.
    PingPong,
}

/// A cursor on a stretch of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Playback {
    /// First moment, seconds.
    pub start: f64,
    /// Last moment, seconds.
    pub end: f64,
    /// The present moment, seconds.
    pub time: f64,
    /// Whether time goes on.
    pub playing: bool,
    /// Seconds of the clip a second; negative runs backwards.
    pub speed: f64,
    /// What happens at the end.
    pub mode: LoopMode,
    /// Mark A: playing keeps to the stretch from here.
    pub mark_a: Option<f64>,
    /// Mark B: playing keeps to the stretch up to here.
    pub mark_b: Option<f64>,
}

impl Default for Playback {
    fn default() -> Self {
        Self::new(0.0, 0.0)
    }
}

impl Playback {
    /// Slowest and fastest speed, either way.
    pub const SPEED: RangeInclusive<f64> = 0.05..=4.0;

    /// A resting cursor at the start of a stretch, in seconds. A stretch that is not finite or runs backwards is a single moment.
    pub fn new(start: f64, end: f64) -> Self {
        let start = if start.is_finite() { start } else { 0.0 };
        let end = if end.is_finite() { end.max(start) } else { start };
        Self { start, end, time: start, playing: false, speed: 1.0, mode: LoopMode::Loop, mark_a: None, mark_b: None }
    }

    /// Seconds from start to end.
    pub fn duration(&self) -> f64 {
        (self.end - self.start).max(0.0)
    }

    /// The range that is played, seconds: between the marks where they are set, else the whole clip.
    pub fn play_range(&self) -> (f64, f64) {
        let from = self.mark_a.map_or(self.start, |a| a.clamp(self.start, self.end));
        let to = self.mark_b.map_or(self.end, |b| b.clamp(self.start, self.end));
        if from < to { (from, to) } else { (self.start, self.end) }
    }

    /// Goes to a moment of the file's time axis. Beyond the ends it wraps when looping and is held otherwise; the end itself stays the end.
    pub fn seek(&mut self, time: f64) {
        if time.is_finite() {
            self.time = match self.mode {
                _ if (self.start..=self.end).contains(&time) => time,
                LoopMode::Loop => wrap(time, self.start, self.end),
                LoopMode::Once | LoopMode::PingPong => time.clamp(self.start, self.end),
            };
        }
    }

    /// Starts to play; from the end of a stretch that is not looped it begins anew.
    pub fn play(&mut self) {
        let (from, to) = self.play_range();
        if self.mode == LoopMode::Once {
            if self.speed >= 0.0 && self.time >= to {
                self.time = from;
            } else if self.speed < 0.0 && self.time <= from {
                self.time = to;
            }
        }
        self.playing = to > from;
    }

    /// Stops where it is.
    pub fn pause(&mut self) {
        self.playing = false;
    }

    /// Advances by `seconds` of the clock and returns whether the time changed. Any number of ends may be passed.
    pub fn advance(&mut self, seconds: f64) -> bool {
        let (from, to) = self.play_range();
        let length = to - from;
        let delta = self.speed * seconds;
        if !self.playing || delta == 0.0 || !delta.is_finite() || length <= 0.0 {
            return false;
        }
        let before = self.time;
        // From outside the marks it enters at the near end of the stretch.
        let time = if (from..=to).contains(&before) {
            before
        } else if delta > 0.0 {
            from
        } else {
            to
        };
        self.time = match self.mode {
            LoopMode::Loop if (from..=to).contains(&(time + delta)) && time + delta < to => time + delta,
            LoopMode::Loop => wrap(time + delta, from, to),
            LoopMode::Once => {
                let next = time + delta;
                self.playing = next > from && next < to;
                next.clamp(from, to)
            }
            LoopMode::PingPong => {
                // One way there and back is a circle of twice the length; its second half runs backwards.
                let phase = if delta > 0.0 { time - from } else { 2.0 * length - (time - from) };
                let phase = (phase + delta.abs()).rem_euclid(2.0 * length);
                let forward = phase < length;
                self.speed = if forward { self.speed.abs() } else { -self.speed.abs() };
                if forward { from + phase } else { (to - (phase - length)).clamp(from, to) }
            }
        };
        self.time != before
    }

    /// Sets the magnitude of the speed, clamped to [`Playback::SPEED`]; the direction stays.
    pub fn set_speed(&mut self, speed: f64) {
        if speed.is_finite() {
            let speed = speed.abs().clamp(*Self::SPEED.start(), *Self::SPEED.end());
            self.speed = if self.speed < 0.0 { -speed } else { speed };
        }
    }

    /// Goes `frames` whole frames on (back where negative) on the grid of `rate` frames a second. From between two frames the first step goes to the nearer
    /// side's frame.
    pub fn step(&mut self, frames: i32, rate: f64) {
        if frames == 0 || !rate.is_finite() || rate <= 0.0 {
            return;
        }
        let exact = self.time * rate;
        let grid = if frames > 0 { (exact + 1e-6).floor() } else { (exact - 1e-6).ceil() };
        self.seek((grid + f64::from(frames)) / rate);
    }

    /// The last key before the present moment.
    pub fn previous_key(&self, keys: &[f64]) -> Option<f64> {
        keys.iter().copied().filter(|key| *key < self.time - 1e-6).reduce(f64::max)
    }

    /// The first key after the present moment.
    pub fn next_key(&self, keys: &[f64]) -> Option<f64> {
        keys.iter().copied().filter(|key| *key > self.time + 1e-6).reduce(f64::min)
    }
}

fn wrap(time: f64, from: f64, to: f64) -> f64 {
    let length = to - from;
    if length <= 0.0 {
        return from;
    }
    let wrapped = from + (time - from).rem_euclid(length);
    // Rounding may land on the far end, which is the start.
    if wrapped < to { wrapped } else { from }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn playing(mode: LoopMode, speed: f64) -> Playback {
        Playback { playing: true, mode, speed, ..Playback::new(0.5, 2.5) }
    }

    #[test]
    fn seeking_wraps_when_looping_and_clamps_otherwise() {
        let mut cursor = Playback::new(0.5, 2.5);
        for (asked, looped, held) in [(1.0, 1.0, 1.0), (2.5, 2.5, 2.5), (3.0, 1.0, 2.5), (0.0, 2.0, 0.5), (-5.75, 0.25 + 2.0, 0.5)] {
            cursor.mode = LoopMode::Loop;
            cursor.seek(asked);
            assert!((cursor.time - looped).abs() < 1e-12, "{asked} looped is {}", cursor.time);
            for mode in [LoopMode::Once, LoopMode::PingPong] {
                cursor.mode = mode;
                cursor.seek(asked);
                assert_eq!(cursor.time, held);
            }
        }
        cursor.seek(f64::NAN);
        assert_eq!(cursor.time, 0.5);
    }

    #[test]
    fn looping_starts_again_either_way() {
        let mut cursor = playing(LoopMode::Loop, 1.0);
        cursor.advance(2.0);
        assert_eq!(cursor.time, 0.5);
        cursor.advance(3.0);
        assert_eq!(cursor.time, 1.5);
        cursor.speed = -0.5;
        cursor.advance(4.0);
        assert_eq!(cursor.time, 1.5);
        cursor.advance(3.0);
        assert_eq!(cursor.time, 2.0);
    }

    #[test]
    fn once_stops_at_the_end_and_plays_again_from_the_start() {
        let mut cursor = playing(LoopMode::Once, 1.0);
        assert!(cursor.advance(10.0));
        assert_eq!((cursor.time, cursor.playing), (2.5, false));
        assert!(!cursor.advance(1.0));
        cursor.play();
        assert_eq!((cursor.time, cursor.playing), (0.5, true));
        cursor.speed = -1.0;
        cursor.advance(0.1);
        assert_eq!((cursor.time, cursor.playing), (0.5, false));
        cursor.play();
        assert_eq!(cursor.time, 2.5);
    }

    #[test]
    fn ping_pong_turns_round_at_both_ends() {
        let mut cursor = playing(LoopMode::PingPong, 1.0);
        for (step, time, speed) in
            [(1.5, 2.0, 1.0), (1.0, 2.0, -1.0), (1.5, 0.5, 1.0), (0.25, 0.75, 1.0), (4.0, 0.75, 1.0), (2.0, 2.25, -1.0)]
        {
            cursor.advance(step);
            assert!((cursor.time - time).abs() < 1e-12 && cursor.speed == speed, "{cursor:?}");
        }
    }

    #[test]
    fn marks_bound_what_plays_but_not_where_one_can_go() {
        let mut cursor = playing(LoopMode::Loop, 1.0);
        (cursor.mark_a, cursor.mark_b) = (Some(1.0), Some(2.0));
        assert_eq!(cursor.play_range(), (1.0, 2.0));
        cursor.advance(0.25);
        assert_eq!(cursor.time, 1.25);
        cursor.advance(1.0);
        assert_eq!(cursor.time, 1.25);
        cursor.seek(2.4);
        assert_eq!(cursor.time, 2.4);
        cursor.mark_b = Some(0.7);
        assert_eq!(cursor.play_range(), (0.5, 2.5), "marks in the wrong order bound nothing");
    }

    #[test]
    fn frames_lie_on_the_file_axis() {
        let mut cursor = Playback { mode: LoopMode::Once, ..Playback::new(1.0 / 24.0, 2.0) };
        cursor.step(1, 24.0);
        assert!((cursor.time - 2.0 / 24.0).abs() < 1e-12);
        cursor.seek(2.5 / 24.0);
        cursor.step(1, 24.0);
        assert!((cursor.time - 3.0 / 24.0).abs() < 1e-12);
        cursor.seek(2.5 / 24.0);
        cursor.step(-1, 24.0);
        assert!((cursor.time - 2.0 / 24.0).abs() < 1e-12);
        cursor.step(-9, 24.0);
        assert_eq!(cursor.time, 1.0 / 24.0);
    }

    #[test]
    fn keys_are_found_on_either_side() {
        let mut cursor = Playback::new(0.0, 3.0);
        cursor.seek(1.0);
        let keys = [0.0, 0.5, 1.0, 2.0];
        assert_eq!(cursor.previous_key(&keys), Some(0.5));
        assert_eq!(cursor.next_key(&keys), Some(2.0));
        cursor.seek(0.0);
        assert_eq!(cursor.previous_key(&keys), None);
    }

    #[test]
    fn a_single_moment_never_plays() {
        let mut cursor = Playback::new(1.0, f64::NAN);
        cursor.play();
        assert!(!cursor.playing && !cursor.advance(1.0));
        cursor.seek(7.0);
        assert_eq!(cursor.time, 1.0);
    }

    proptest! {
        #[test]
        fn time_stays_within_the_stretch(
            start in -1e3..1e3f64, length in 0.0..1e3f64, mode in 0..3usize, steps in prop::collection::vec((-1e5..1e5f64, -4.0..4.0f64), 1..20)
        ) {
            let mode = [LoopMode::Loop, LoopMode::Once, LoopMode::PingPong][mode];
            let mut cursor = Playback { mode, ..Playback::new(start, start + length) };
            for (seconds, speed) in steps {
                cursor.speed = speed;
                cursor.play();
                cursor.advance(seconds);
                prop_assert!(cursor.time >= cursor.start && cursor.time <= cursor.end);
                cursor.seek(seconds);
                prop_assert!(cursor.time >= cursor.start && cursor.time <= cursor.end);
            }
        }

        #[test]
        fn many_small_steps_are_one_large_one(mode in 0..3usize, speed in 0.05..4.0f64, total in 0.0..30.0f64) {
            let mode = [LoopMode::Loop, LoopMode::Once, LoopMode::PingPong][mode];
            let (mut small, mut large) = (playing(mode, speed), playing(mode, speed));
            for _ in 0..1000 {
                small.advance(total / 1000.0);
            }
            large.advance(total);
            // On a circle the two ends of a loop are the same place.
            let apart = (small.time - large.time).abs();
            prop_assert!(apart.min((apart - 2.0).abs()) < 1e-9, "{} and {}", small.time, large.time);
        }
    }
}
