//! Display presets by name: display options, shading, background.

use serde::{Deserialize, Serialize};

use sinew_render::{Background, Display, OverlayPalette, Shading, Theme};

/// A boolean display option: its name in files and actions, and its field.
pub type DisplayFlag = (&'static str, fn(&mut Display) -> &mut bool);

/// All boolean display options.
pub const DISPLAY_FLAGS: [DisplayFlag; 16] = [
    ("mesh", |d| &mut d.mesh),
    ("muscle", |d| &mut d.muscle),
    ("see-through", |d| &mut d.see_through),
    ("lines-of-action", |d| &mut d.lines_of_action),
    ("materials", |d| &mut d.materials),
    ("smooth-normals", |d| &mut d.smooth_normals),
    ("normal-glyphs", |d| &mut d.normal_glyphs),
    ("wireframe", |d| &mut d.wireframe),
    ("bones", |d| &mut d.bones),
    ("bone-axes", |d| &mut d.bone_axes),
    ("xray", |d| &mut d.xray),
    ("grid", |d| &mut d.grid),
    ("axes", |d| &mut d.axes),
    ("bounding-box", |d| &mut d.bounding_box),
    ("depth-test", |d| &mut d.depth_test),
    ("cull-back-faces", |d| &mut d.cull_back_faces),
];

/// Shading by the name that the file and the actions use.
pub const SHADINGS: [(&str, Shading); 3] = [("flat", Shading::Flat), ("gouraud", Shading::Gouraud), ("phong", Shading::Phong)];

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
