//! Which pictures a film is made of: one, or many in a row.

use crate::document::{Document, PoseState};
use crate::muscle::{Joint, MuscleRig};

/// Frames a second where nobody says.
pub const FPS: f64 = 25.0;

/// Seconds of a turn or an arm's swing where nobody says.
pub(super) const TURN_SECONDS: f64 = 4.0;

/// Most frames of a film.
pub const FRAMES: usize = 100_000;

/// One picture: the pose, and how far the turntable has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameSpec {
    /// The moment.
    pub state: PoseState,
    /// Degrees.
    pub turn: f32,
}

/// What moves from frame to frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Motion {
    /// Nothing but the turntable.
    Still,
    /// The clip, or an arm that swings where there is none.
    #[default]
    Play,
    /// The elbow, from one angle to another, degrees.
    Angle(f64, f64),
    /// The muscles, from one contraction to another, per cent.
    Contraction(f64, f64),
}

/// What somebody wants of a film; what is not said has a sensible value.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SequenceOptions {
    /// What moves.
    pub motion: Motion,
    /// First and last moment, seconds; of the clip's own time axis where a clip plays.
    pub from: Option<f64>,
    /// See [`SequenceOptions::from`].
    pub to: Option<f64>,
    /// Seconds, in place of `to`.
    pub duration: Option<f64>,
    /// Frames a second.
    pub fps: Option<f64>,
    /// Whether the model turns once round.
    pub turning: bool,
}

/// Why there is no such film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SequenceError {
    /// The first moment lies after the last.
    Empty {
        /// First moment, seconds.
        from: f64,
        /// Last moment, seconds.
        to: f64,
    },
    /// More than [`FRAMES`].
    TooMany,
    /// There is no elbow that could bend.
    NoElbow,
    /// There is no muscle that could contract.
    NoMuscle,
}

/// What moves in this document.
#[derive(Debug, Clone, Copy, PartialEq)]
enum MotionKind {
    Still,
    Clip,
    /// The arm: straight, bent, straight.
    Swing,
    Angle(f64, f64),
    Contraction(f64, f64),
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
    course: MotionKind,
    joint: Option<Joint>,
    turning: bool,
}

impl Sequence {
    /// One picture of `state`.
    pub fn single(state: PoseState) -> Self {
        Self { count: 1, fps: FPS, state, from: state.time, to: state.time, course: MotionKind::Still, joint: None, turning: false }
    }

    /// The row of pictures that `wish` asks for: every moment from its first to its last, both included. Where it does not say: the whole clip;
    /// without a clip an arm swings once; with the turntable alone the model turns once, and then its last frame is the one before the first.
    ///
    /// # Errors
    /// [`SequenceError`].
    pub fn new(wish: &SequenceOptions, document: &Document, state: PoseState) -> Result<Self, SequenceError> {
        let fps = wish.fps.unwrap_or(FPS);
        let clip = state.clip.and_then(|index| document.clips.get(index)).filter(|clip| clip.duration() > 0.0);
        let rig = document.driven_rig();
        let mut joint = None;
        let turn = if wish.turning { TURN_SECONDS } else { 0.0 };
        let (course, start, end) = match (wish.motion, clip) {
            (Motion::Angle(from, to), _) => {
                joint = if rig.is_some_and(|rig| rig.flexion_range().is_some()) { None } else { document.joint() };
                if joint.is_none() && rig.is_none_or(|rig| rig.flexion_range().is_none()) {
                    return Err(SequenceError::NoElbow);
                }
                (MotionKind::Angle(from, to), 0.0, TURN_SECONDS)
            }
            (Motion::Contraction(from, to), _) => {
                if !rig.is_some_and(MuscleRig::is_drivable) && document.contracted(&state, from).is_none() {
                    return Err(SequenceError::NoMuscle);
                }
                (MotionKind::Contraction(from, to), 0.0, TURN_SECONDS)
            }
            (Motion::Play, Some(clip)) => (MotionKind::Clip, clip.start, clip.end),
            (Motion::Play, None) if rig.is_some_and(MuscleRig::is_drivable) && !wish.turning => (MotionKind::Swing, 0.0, TURN_SECONDS),
            (Motion::Still | Motion::Play, _) => (MotionKind::Still, 0.0, turn),
        };
        let from = wish.from.unwrap_or(start);
        let to = wish.duration.map_or(wish.to.unwrap_or(end), |seconds| from + seconds);
        if from > to {
            return Err(SequenceError::Empty { from, to });
        }
        // The last moment counts where rounding misses it by less than a millionth of a frame. A whole turn ends before its first frame comes again.
        let steps = ((to - from) * fps + 1e-6).floor();
        if steps >= FRAMES as f64 {
            return Err(SequenceError::TooMany);
        }
        let last = usize::from(!wish.turning || course != MotionKind::Still || steps < 1.0);
        Ok(Self { count: steps as usize + last, fps, state, from, to, course, joint, turning: wish.turning })
    }

    /// Seconds that the film lasts: its last frame is shown as long as the others.
    pub fn seconds(&self) -> f64 {
        self.count as f64 / self.fps
    }

    /// Whether the model turns.
    pub fn turning(&self) -> bool {
        self.turning
    }

    /// Whether the model turns and nothing else moves.
    pub fn only_turns(&self) -> bool {
        self.turning && self.course == MotionKind::Still
    }

    /// Picture `index`, from 0.
    pub fn shot(&self, document: &Document, index: usize) -> FrameSpec {
        let time = self.from + index as f64 / self.fps;
        // From one end of a sweep to the other, both shown.
        let part = index as f64 / (self.count.max(2) - 1) as f64;
        let mut state = self.state;
        match self.course {
            MotionKind::Still => {}
            MotionKind::Clip => {
                if let Some(clip) = state.clip.and_then(|index| document.clips.get(index)) {
                    state.time = time.clamp(clip.start, clip.end.max(clip.start));
                }
            }
            MotionKind::Angle(from, to) => {
                let angle = from + (to - from) * part;
                match (&self.joint, document.driven_rig()) {
                    (Some(joint), _) => state.turn = Some(joint.at(angle)),
                    (None, Some(rig)) => state.drive = rig.at_flexion(angle),
                    (None, None) => {}
                }
            }
            MotionKind::Contraction(from, to) => {
                let per_cent = from + (to - from) * part;
                match document.driven_rig().filter(|rig| rig.is_drivable()) {
                    Some(rig) => state.drive = rig.at_contraction(per_cent),
                    None => state.turn = document.contracted(&state, per_cent),
                }
            }
            MotionKind::Swing => {
                if let Some(rig) = document.driven_rig() {
                    let turn = (time - self.from) / (self.to - self.from).max(f64::MIN_POSITIVE) * std::f64::consts::TAU;
                    state.drive = rig.at_contraction(50.0 - 50.0 * turn.cos());
                }
            }
        }
        let turn = if self.turning { 360.0 * index as f32 / self.count as f32 } else { 0.0 };
        FrameSpec { state, turn }
    }
}
