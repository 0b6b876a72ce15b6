//! Settings of onion skins: how many poses, how far apart.

use serde::{Deserialize, Serialize};

/// Most onion skins before, and after, the present pose.
const MAX_SKINS: u32 = 10;
/// Largest step, frames.
const MAX_STEP: u32 = 100;

/// Which onion skins are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct OnionSkinSettings {
    /// Whether onion skins are drawn.
    pub shown: bool,
    /// Number of poses before the present one.
    pub before: u32,
    /// Number of poses after it.
    pub after: u32,
    /// Frames between two of them.
    pub step: u32,
    /// Whether the motion path of the selected node is drawn.
    pub path: bool,
}

impl Default for OnionSkinSettings {
    fn default() -> Self {
        Self { shown: false, before: 2, after: 2, step: 5, path: false }
    }
}

impl OnionSkinSettings {
    /// The same with numbers clamped to their limits.
    pub fn clamped(self) -> Self {
        Self { before: self.before.min(MAX_SKINS), after: self.after.min(MAX_SKINS), step: self.step.clamp(1, MAX_STEP), ..self }
    }
}
