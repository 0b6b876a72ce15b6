//! Display presets by name: display options, shading, background.

use serde::{Deserialize, Serialize};

use crate::render::{Background, Display, Palette, Shading, Theme};

/// A switch of the display: its name in the file and in actions, and where it is.
pub type Switch = (&'static str, fn(&mut Display) -> &mut bool);

/// All switches of the display that are on or off and nothing else.
pub const SWITCHES: [Switch; 15] = [
    ("mesh", |d| &mut d.mesh),
    ("muscle", |d| &mut d.muscle),
    ("see-through", |d| &mut d.see_through),
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

/// What stands behind the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Backdrop {
    /// The gradient of the window's light or dark.
    #[default]
    Theme,
    /// White, for paper.
    White,
    /// A middle grey, which flatters no colour.
    Grey,
    /// Black.
    Black,
}

impl Backdrop {
    /// All, in the order of the list.
    pub const ALL: [Self; 4] = [Self::Theme, Self::White, Self::Grey, Self::Black];

    /// Colours of what is drawn over the model, and the background, in a window of this theme: on white what is meant for light surroundings.
    pub fn look(self, theme: Theme) -> (Palette, Background) {
        let theme = match self {
            Self::Theme => theme,
            Self::White => Theme::Light,
            Self::Grey | Self::Black => Theme::Dark,
        };
        let palette = Palette::of(theme);
        let background = match self {
            Self::Theme => Background::Gradient(palette.background.0, palette.background.1),
            Self::White => Background::Solid(0xFF_FFFF),
            Self::Grey => Background::Solid(0x55_5555),
            Self::Black => Background::Solid(0),
        };
        (palette, background)
    }
}
