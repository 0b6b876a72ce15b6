//! Frame sequences of a document: what moves, where the camera stands, and how frames become files. The command line and the window use the same
//! code, so that both give the same result.

mod frame_renderer;
mod framing;
mod motion;
mod pattern;
mod save;

pub use frame_renderer::{FrameTimes, SequenceRenderer};
pub use framing::{Direction, FittedOrbit, posed_bounds};
pub use motion::{DEFAULT_FPS, FrameSpec, MAX_FRAMES, Motion, Sequence, SequenceError, SequenceOptions};
pub use pattern::FilePattern;
pub use save::{OutputTarget, save};
