//! Pictures and films of a document: what moves, where the eye stands, and how they become files. The command line and the window make them
//! here, so that both have the same result.

mod frame_renderer;
mod framing;
mod motion;
mod pattern;
mod save;

pub use frame_renderer::{Look, SequenceRenderer, Times};
pub use framing::{Direction, FittedOrbit, posed_bounds};
pub use motion::{FPS, FRAMES, FrameSpec, Motion, Sequence, SequenceError, SequenceOptions};
pub use pattern::Pattern;
pub use save::{Target, save};
