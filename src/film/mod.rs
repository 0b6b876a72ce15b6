//! Pictures and films of a document: what moves, where the eye stands, and how they become files. The command line and the window make them
//! here, so that both have the same result.

mod framing;
mod pattern;
mod save;
mod sequence;
mod studio;

pub use framing::{Direction, Eye, posed_bounds};
pub use pattern::Pattern;
pub use save::{Target, save};
pub use sequence::{FPS, FRAMES, Motion, Refusal, Sequence, Shot, Wish};
pub use studio::{Look, Studio, Times};
