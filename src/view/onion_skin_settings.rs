//! Settings of onion skins: how many poses, how far apart.

use serde::{Deserialize, Serialize};

/// Most ghosts on one side.
const MOST: u32 = 10;
/// Longest step, frames.
const LONGEST: u32 = 100;

/// Which ghosts are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct Ghosts {
    /// Whether other moments are drawn at all.
    pub shown: bool,
    /// How many moments before the present one.
    pub before: u32,
    /// How many after it.
    pub after: u32,
    /// Frames from one to the next.
    pub step: u32,
    /// Whether the path of the selected node is drawn.
    pub path: bool,
}

impl Default for Ghosts {
    fn default() -> Self {
        Self { shown: false, before: 2, after: 2, step: 5, path: false }
    }
}

impl Ghosts {
    /// The numbers within their limits.
    pub fn sane(self) -> Self {
        Self { before: self.before.min(MOST), after: self.after.min(MOST), step: self.step.clamp(1, LONGEST), ..self }
    }
}
