//! The frames of a sequence: how many there are, and the pose and turntable angle of each.

use sinew_engine::document::{Document, PoseState};
use sinew_muscle::{JointDof, MuscleRig};

/// Frames per second where none is given.
pub const DEFAULT_FPS: f64 = 25.0;

/// Duration of a turntable or an arm's swing where none is given, seconds.
pub(super) const DEFAULT_SECONDS: f64 = 4.0;

/// Most frames of a sequence.
pub const MAX_FRAMES: usize = 100_000;

/// One frame: the pose and the turntable angle.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameSpec {
    /// The pose state.
    pub state: PoseState,
    /// Turntable angle, degrees.
    pub turntable: f32,
}

/// What moves from frame to frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Motion {
    /// Nothing, except a turntable.
    Still,
    /// The clip; without a clip the arm swings.
    #[default]
    Play,
    /// The elbow, from one angle to another, degrees.
    Angle(f64, f64),
    /// The muscles, from one contraction to another, per cent.
    Contraction(f64, f64),
}

/// Options of a sequence; those that are `None` have a default.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SequenceOptions {
    /// What moves.
    pub motion: Motion,
    /// Start and end time, seconds; on the clip's own time axis where a clip plays.
    pub from: Option<f64>,
    /// See [`SequenceOptions::from`].
    pub to: Option<f64>,
    /// Duration, seconds, instead of `to`.
    pub duration: Option<f64>,
    /// Frames per second.
    pub fps: Option<f64>,
    /// Whether the camera makes one turn round the model.
    pub turntable: bool,
}

/// Why a sequence is impossible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SequenceError {
    /// The start lies after the end.
    Empty {
        /// Start time, seconds.
        from: f64,
        /// End time, seconds.
        to: f64,
    },
    /// More than [`MAX_FRAMES`].
    TooMany,
    /// The document has no joint to bend.
    NoElbow,
    /// The document has no muscle to contract.
    NoMuscle,
}

/// What moves, resolved for a document.
#[derive(Debug, Clone, Copy, PartialEq)]
enum MotionKind {
    Still,
    Clip,
    /// The arm: straight, bent, straight.
    Swing,
    Angle(f64, f64),
    Contraction(f64, f64),
}

/// A sequence of frames.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    /// Number of frames.
    pub count: usize,
    /// Frames per second.
    pub fps: f64,
    state: PoseState,
    from: f64,
    to: f64,
    kind: MotionKind,
    joint: Option<JointDof>,
    turntable: bool,
}

impl Sequence {
    /// A single frame of `state`.
    pub fn single(state: PoseState) -> Self {
        let time = state.time;
        Self { count: 1, fps: DEFAULT_FPS, state, from: time, to: time, kind: MotionKind::Still, joint: None, turntable: false }
    }

    /// The sequence that `options` describes, from start to end, both included. Defaults: the whole clip;
    /// without a clip one swing of the arm; with the turntable alone one turn, whose last frame is the one before the first.
    ///
    /// # Errors
    /// [`SequenceError`].
    pub fn new(options: &SequenceOptions, document: &Document, state: PoseState) -> Result<Self, SequenceError> {
        let fps = options.fps.unwrap_or(DEFAULT_FPS);
        let clip = state.clip.and_then(|index| document.clips.get(index)).filter(|clip| clip.duration() > 0.0);
        let rig = document.driven_rig();
        let mut joint = None;
        let turntable = if options.turntable { DEFAULT_SECONDS } else { 0.0 };
        let (kind, start, end) = match (options.motion, clip) {
            (Motion::Angle(from, to), _) => {
                joint = if rig.is_some_and(|rig| rig.flexion_range().is_some()) { None } else { document.joint() };
                if joint.is_none() && rig.is_none_or(|rig| rig.flexion_range().is_none()) {
                    return Err(SequenceError::NoElbow);
                }
                (MotionKind::Angle(from, to), 0.0, DEFAULT_SECONDS)
            }
            (Motion::Contraction(from, to), _) => {
                if !rig.is_some_and(MuscleRig::is_drivable) && document.joint_rotation_for_contraction(&state, from).is_none() {
                    return Err(SequenceError::NoMuscle);
                }
                (MotionKind::Contraction(from, to), 0.0, DEFAULT_SECONDS)
            }
            (Motion::Play, Some(clip)) => (MotionKind::Clip, clip.start, clip.end),
            (Motion::Play, None) if rig.is_some_and(MuscleRig::is_drivable) && !options.turntable => {
                (MotionKind::Swing, 0.0, DEFAULT_SECONDS)
            }
            (Motion::Still | Motion::Play, _) => (MotionKind::Still, 0.0, turntable),
        };
        let from = options.from.unwrap_or(start);
        let to = options.duration.map_or(options.to.unwrap_or(end), |seconds| from + seconds);
        if from > to {
            return Err(SequenceError::Empty { from, to });
        }
        // The end counts where rounding misses it by less than a millionth of a frame. A turntable ends before its first frame would repeat.
        let steps = ((to - from) * fps + 1e-6).floor();
        if steps >= MAX_FRAMES as f64 {
            return Err(SequenceError::TooMany);
        }
        let last = usize::from(!options.turntable || kind != MotionKind::Still || steps < 1.0);
        Ok(Self { count: steps as usize + last, fps, state, from, to, kind, joint, turntable: options.turntable })
    }

    /// Duration, seconds: the last frame is shown as long as the others.
    pub fn seconds(&self) -> f64 {
        self.count as f64 / self.fps
    }

    /// Whether it has a turntable.
    pub fn has_turntable(&self) -> bool {
        self.turntable
    }

    /// Whether nothing but the turntable moves.
    pub fn is_turntable_only(&self) -> bool {
        self.turntable && self.kind == MotionKind::Still
    }

    /// Frame `index`, from 0.
    pub fn frame_spec(&self, document: &Document, index: usize) -> FrameSpec {
        let time = self.from + index as f64 / self.fps;
        // A sweep includes both of its ends.
        let fraction = index as f64 / (self.count.max(2) - 1) as f64;
        let mut state = self.state.clone();
        match self.kind {
            MotionKind::Still => {}
            MotionKind::Clip => {
                if let Some(clip) = state.clip.and_then(|index| document.clips.get(index)) {
                    state.time = time.clamp(clip.start, clip.end.max(clip.start));
                }
            }
            MotionKind::Angle(from, to) => {
                let angle = from + (to - from) * fraction;
                match (&self.joint, document.driven_rig()) {
                    (Some(joint), _) => state.joints.rotation = Some(joint.absolute(angle)),
                    (None, Some(rig)) => state.joints.drive = rig.at_flexion(angle),
                    (None, None) => {}
                }
            }
            MotionKind::Contraction(from, to) => {
                let per_cent = from + (to - from) * fraction;
                match document.driven_rig().filter(|rig| rig.is_drivable()) {
                    Some(rig) => state.joints.drive = rig.at_contraction(per_cent),
                    None => state.joints.rotation = document.joint_rotation_for_contraction(&state, per_cent),
                }
            }
            MotionKind::Swing => {
                if let Some(rig) = document.driven_rig() {
                    let turntable = (time - self.from) / (self.to - self.from).max(f64::MIN_POSITIVE) * std::f64::consts::TAU;
                    state.joints.drive = rig.at_contraction(50.0 - 50.0 * turntable.cos());
                }
            }
        }
        let turntable = if self.turntable { 360.0 * index as f32 / self.count as f32 } else { 0.0 };
        FrameSpec { state, turntable }
    }
}
