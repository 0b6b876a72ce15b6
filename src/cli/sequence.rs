//! Which pictures a call asks for: one, or many in a row, and the names of their files.

use std::path::PathBuf;

use clap::ArgMatches;

use super::failure::Failure;
use super::moment::Moment;
use super::value;
use super::values::plain;
use crate::document::{Document, PoseState};
use crate::muscle::Rig;
use crate::tr;

/// Frames a second where the call does not say.
const FPS: f64 = 25.0;

/// Seconds of a turn or an arm's swing where the call does not say.
const TURN_SECONDS: f64 = 4.0;

/// Most frames of one call.
const FRAMES: usize = 100_000;

/// One picture: the pose, and how far the turntable has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shot {
    /// The moment.
    pub state: PoseState,
    /// Degrees.
    pub turn: f32,
}

/// What moves from frame to frame.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Motion {
    /// Nothing but the turntable.
    Still,
    /// The clip.
    Clip,
    /// The arm: straight, bent, straight.
    Swing,
}

/// Pictures in a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sequence {
    /// How many.
    pub count: usize,
    /// Frames a second.
    pub fps: f64,
    state: PoseState,
    from: f64,
    to: f64,
    motion: Motion,
    turning: bool,
}

impl Sequence {
    /// One picture of `state`.
    ///
    /// # Errors
    /// [`Failure::Usage`] where an option speaks of several pictures.
    pub fn single(given: &ArgMatches, state: PoseState) -> Result<Self, Failure> {
        for option in ["from", "to", "fps"] {
            if given.contains_id(option) {
                return Err(Failure::usage(tr!("cli-needs-sequence", option = format!("--{option}"))));
            }
        }
        if given.get_flag("turntable") {
            return Err(Failure::usage(tr!("cli-needs-sequence", option = "--turntable")));
        }
        Ok(Self { count: 1, fps: FPS, state, from: state.time, to: state.time, motion: Motion::Still, turning: false })
    }

    /// The row of pictures that the options ask for: every moment from `--from` to `--to`, both included, `--fps` a second. Without them
    /// the whole clip; without a clip an arm swings once; with `--turntable` alone the model turns once.
    ///
    /// # Errors
    /// [`Failure::Usage`] for an empty range or too many frames.
    pub fn given(given: &ArgMatches, moment: &Moment, document: &Document, state: PoseState) -> Result<Self, Failure> {
        let turning = given.get_flag("turntable");
        let fps = value::<f64>(given, "fps").unwrap_or(FPS);
        let clip = state.clip.and_then(|index| document.clips.get(index)).filter(|clip| clip.duration() > 0.0);
        let (from, to) = (value::<f64>(given, "from"), value::<f64>(given, "to"));
        let (motion, start, end) = match clip {
            _ if moment.time.is_some() => (Motion::Still, 0.0, if turning { TURN_SECONDS } else { 0.0 }),
            Some(clip) => (Motion::Clip, clip.start, clip.end),
            None if document.driven_rig().is_some_and(Rig::is_drivable) && !moment.fixes_muscles() && !turning => {
                (Motion::Swing, 0.0, TURN_SECONDS)
            }
            None => (Motion::Still, 0.0, if turning { TURN_SECONDS } else { 0.0 }),
        };
        let (from, to) = (from.unwrap_or(start), to.unwrap_or(end));
        if from > to {
            return Err(Failure::usage(tr!("cli-range-empty", from = plain(from), to = plain(to))));
        }
        // The last moment counts where rounding misses it by less than a millionth of a frame. A whole turn ends before its first frame comes again.
        let steps = ((to - from) * fps + 1e-6).floor();
        if steps >= FRAMES as f64 {
            return Err(Failure::usage(tr!("cli-too-many-frames", limit = plain(FRAMES as f64))));
        }
        let last = usize::from(!turning || motion != Motion::Still || steps < 1.0);
        Ok(Self { count: steps as usize + last, fps, state, from, to, motion, turning })
    }

    /// Whether the model turns.
    pub fn turning(&self) -> bool {
        self.turning
    }

    /// Whether the model turns and nothing else moves.
    pub fn only_turns(&self) -> bool {
        self.turning && self.motion == Motion::Still
    }

    /// Picture `index`, from 0.
    pub fn shot(&self, document: &Document, index: usize) -> Shot {
        let time = self.from + index as f64 / self.fps;
        let mut state = self.state;
        match self.motion {
            Motion::Still => {}
            Motion::Clip => {
                if let Some(clip) = state.clip.and_then(|index| document.clips.get(index)) {
                    state.time = time.clamp(clip.start, clip.end.max(clip.start));
                }
            }
            Motion::Swing => {
                if let Some(rig) = document.driven_rig() {
                    let turn = (time - self.from) / (self.to - self.from).max(f64::MIN_POSITIVE) * std::f64::consts::TAU;
                    state.drive = rig.at_contraction(50.0 - 50.0 * turn.cos());
                }
            }
        }
        let turn = if self.turning { 360.0 * index as f32 / self.count as f32 } else { 0.0 };
        Shot { state, turn }
    }
}

/// The names of a row of files: `frame-%04d.png`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    before: String,
    digits: usize,
    after: String,
}

impl Pattern {
    /// Finds the first `%d` or `%04d` in a name, `%%` being a plain `%` beside it; `None` where there is none, and then `%` is an ordinary
    /// character.
    pub fn of(name: &str) -> Option<Self> {
        let mut before = String::new();
        let mut rest = name;
        loop {
            let (plain, found) = rest.split_once('%')?;
            before.push_str(plain);
            let after = found.trim_start_matches(|c: char| c.is_ascii_digit());
            let digits = found.strip_suffix(after).unwrap_or_default();
            if let Some(after) = after.strip_prefix('d')
                && digits.len() <= 2
            {
                return Some(Self { before, digits: digits.parse().unwrap_or(0), after: after.replace("%%", "%") });
            }
            before.push('%');
            rest = found.strip_prefix('%').unwrap_or(found);
        }
    }

    /// The name of file `number`.
    pub fn file(&self, number: usize) -> PathBuf {
        PathBuf::from(format!("{}{number:0digits$}{}", self.before, self.after, digits = self.digits))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_filled_with_the_number() {
        let file = |name: &str, number| Pattern::of(name).map(|pattern| pattern.file(number));
        assert_eq!(file("frame-%04d.png", 7), Some(PathBuf::from("frame-0007.png")));
        assert_eq!(file("%d.png", 12), Some(PathBuf::from("12.png")));
        assert_eq!(file("50%%-%02d.png", 3), Some(PathBuf::from("50%-03.png")));
        assert_eq!(file("%03d.png", 12345), Some(PathBuf::from("12345.png")));
        for plain in ["picture.png", "50%.png", "%s.png", "%%04d.png", "%999d.png", "%", "%d%"] {
            let expected = (plain == "%d%").then(|| PathBuf::from("0%"));
            assert_eq!(file(plain, 0), expected, "{plain}");
        }
    }
}
