//! The backgrounds that the viewport offers.

use serde::{Deserialize, Serialize};

use sinew_render::{Background, OverlayPalette, Theme};

/// Background of the viewport.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BackgroundPreset {
    /// The gradient of the window's light or dark theme.
    #[default]
    Theme,
    /// White, for paper.
    White,
    /// A neutral mid grey.
    Grey,
    /// Black.
    Black,
}

impl BackgroundPreset {
    /// All, in the order of the list.
    pub const ALL: [Self; 4] = [Self::Theme, Self::White, Self::Grey, Self::Black];

    /// Overlay colours and background in a window of this theme; on white the overlay colours of the light theme.
    pub fn palette_and_background(self, theme: Theme) -> (OverlayPalette, Background) {
        let theme = match self {
            Self::Theme => theme,
            Self::White => Theme::Light,
            Self::Grey | Self::Black => Theme::Dark,
        };
        let palette = OverlayPalette::of(theme);
        let background = match self {
            Self::Theme => Background::Gradient(palette.background.0, palette.background.1),
            Self::White => Background::Solid(0xFF_FFFF),
            Self::Grey => Background::Solid(0x55_5555),
            Self::Black => Background::Solid(0),
        };
        (palette, background)
    }
}
