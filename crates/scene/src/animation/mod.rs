//! Animation: curves, clips, and playback. Depends on the scene only.

mod clip;
mod curve;
mod playback;
mod pose;

pub use clip::{Channel, ChannelTarget, Clip, Components, MaterialSlot};
pub use curve::{Curve, Interpolation, Keys, Tangents};
pub use playback::{LoopMode, Playback};
pub use pose::Pose;
