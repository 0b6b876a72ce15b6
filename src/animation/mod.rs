//! Animation: curves, clips, and the cursor that walks through time. Knows the scene alone.

mod clip;
mod curve;
mod playback;
mod pose;

pub use clip::{Channel, Clip, Components, MaterialSlot, Target};
pub use curve::{Curve, Interpolation, Keys, Tangents};
pub use playback::{LoopMode, Playback};
pub use pose::Pose;
