//! The set of changed parts of a session, so that only the widgets that show them are refreshed.

use std::ops::{BitOr, BitOrAssign};

/// A set of kinds of change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ChangeSet(u32);

impl ChangeSet {
    /// Another document.
    pub const DOCUMENT: Self = Self(1);
    /// The present moment.
    pub const TIME: Self = Self(1 << 1);
    /// Whether and how time goes on: playing, speed, loop mode, marks, clip.
    pub const PLAYBACK: Self = Self(1 << 2);
    /// Elbow angle and contraction.
    pub const DRIVE: Self = Self(1 << 3);
    /// The selected node.
    pub const SELECTION: Self = Self(1 << 4);
    /// Switches of the display.
    pub const DISPLAY: Self = Self(1 << 5);
    /// The camera.
    pub const CAMERA: Self = Self(1 << 6);
    /// The light.
    pub const LIGHT: Self = Self(1 << 7);
    /// The model's transform.
    pub const MODEL: Self = Self(1 << 8);
    /// The tool in hand.
    pub const TOOL: Self = Self(1 << 9);
    /// The node under the pointer.
    pub const HOVER: Self = Self(1 << 10);
    /// What can be undone.
    pub const HISTORY: Self = Self(1 << 11);
    /// What the scene tree lists.
    pub const TREE: Self = Self(1 << 12);
    /// Which muscle the ledger shows.
    pub const MUSCLE: Self = Self(1 << 13);
    /// What surrounds the document: whether one is being read.
    pub const SURROUNDINGS: Self = Self(1 << 14);
    /// The shape or the ends of a muscle, or whether that is saved.
    pub const EDIT: Self = Self(1 << 15);
    /// What a click in the picture pointed at: the vertex explained, the two points between which is measured.
    pub const PROBE: Self = Self(1 << 16);
    /// Joint overrides.
    pub const JOINT_OVERRIDES: Self = Self(1 << 17);
    /// Onion skins, motion paths, and what is compared.
    pub const OVERLAYS: Self = Self(1 << 18);
    /// Whether the end of a muscle is being picked.
    pub const PICKING: Self = Self(1 << 19);
    /// Everything.
    pub const ALL: Self = Self(u32::MAX);

    /// What changes the picture.
    pub const PICTURE: Self = Self(
        Self::DOCUMENT.0
            | Self::TIME.0
            | Self::DRIVE.0
            | Self::SELECTION.0
            | Self::DISPLAY.0
            | Self::CAMERA.0
            | Self::LIGHT.0
            | Self::MODEL.0
            | Self::HOVER.0
            | Self::EDIT.0
            | Self::JOINT_OVERRIDES.0
            | Self::OVERLAYS.0,
    );

    /// Whether any of `kinds` is among them.
    pub fn any(self, kinds: Self) -> bool {
        self.0 & kinds.0 != 0
    }
}

impl BitOr for ChangeSet {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitOrAssign for ChangeSet {
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}
