//! What is shown and how: every switch of the display menu, with the palette of light and dark.

use glam::Vec3;

use sinew_scene::{Bounds, NodeId};

/// Where lighting is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Shading {
    /// Once a triangle.
    Flat,
    /// Once a vertex, colours blended between.
    #[default]
    Gouraud,
    /// Once a pixel.
    Phong,
}

/// Samples a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Samples {
    /// Pixel centres only.
    One,
    /// Four on a rotated grid, for coverage and depth.
    #[default]
    Four,
}

/// What stands behind the scene. Colours are `0xRRGGBB`, sRGB.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Background {
    /// From top to bottom.
    Gradient(u32, u32),
    /// One colour.
    Solid(u32),
    /// Nothing: the picture has an alpha channel.
    Transparent,
}

/// Light or dark surroundings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Theme {
    /// Dark.
    #[default]
    Dark,
    /// Light.
    Light,
}

/// Colours of what is drawn over the model, `0xRRGGBB`, sRGB.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverlayPalette {
    /// Upper and lower background.
    pub background: (u32, u32),
    /// Grid lines and their opacity.
    pub grid: (u32, f32),
    /// X, Y, Z.
    pub axes: [u32; 3],
    /// Bones.
    pub bone: u32,
    /// The selected bone or node.
    pub selected: u32,
    /// The one under the pointer.
    pub hovered: u32,
}

impl OverlayPalette {
    /// The palette of a theme.
    pub fn of(theme: Theme) -> Self {
        let axes = [0xE5534B, 0x57AB5A, 0x539BF5];
        match theme {
            Theme::Dark => Self {
                background: (0x2B303B, 0x1A1D23),
                grid: (0xFFFFFF, 0.10),
                axes,
                bone: 0xFFC857,
                selected: 0xFF7A59,
                hovered: 0xFFE3A3,
            },
            Theme::Light => Self {
                background: (0xF4F6F9, 0xD5DBE4),
                grid: (0x000000, 0.10),
                axes,
                bone: 0xB07A00,
                selected: 0xD6492A,
                hovered: 0x7A5600,
            },
        }
    }
}

/// What of a scene is marked.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Highlight {
    /// The selected node: its bone or surface is marked.
    pub selected: Option<NodeId>,
    /// The node under the pointer.
    pub hovered: Option<NodeId>,
    /// The joint whose weights are painted over the skin.
    pub weights: Option<NodeId>,
}

/// Everything that decides how a frame looks, apart from the camera.
#[derive(Debug, Clone, PartialEq)]
pub struct Display {
    /// Where lighting is computed.
    pub shading: Shading,
    /// Anti-aliasing.
    pub samples: Samples,
    /// Meshes of files.
    pub mesh: bool,
    /// Surfaces of fibres: muscles.
    pub muscle: bool,
    /// Skins let the fibres beneath them be seen.
    pub see_through: bool,
    /// Lines of action of muscles, which whoever poses the scene adds to the frame's overlay lines.
    pub lines_of_action: bool,
    /// Materials and textures; without, everything has the neutral skin colour.
    pub materials: bool,
    /// Smooth normals in lighting; without, each triangle is flat and its own.
    pub smooth_normals: bool,
    /// Short lines along the vertex normals.
    pub normal_glyphs: bool,
    /// Edges of triangles.
    pub wireframe: bool,
    /// Bones as octahedra.
    pub bones: bool,
    /// The axes of each bone.
    pub bone_axes: bool,
    /// Bones show through surfaces.
    pub xray: bool,
    /// Ground grid.
    pub grid: bool,
    /// What the grid is laid out for; `None` = the frame's bounds, so that it changes as the model moves.
    pub ground: Option<Bounds>,
    /// World axes at the origin.
    pub axes: bool,
    /// Box round everything.
    pub bounding_box: bool,
    /// Depth test; without, later triangles win.
    pub depth_test: bool,
    /// Leaves out triangles that face away, unless their material shows both sides.
    pub cull_back_faces: bool,
    /// What stands behind.
    pub background: Background,
    /// Position of the light, world, metres; `None` = high on the left of the camera, near enough to the bounds.
    pub light: Option<Vec3>,
    /// Ambient light, 0 to 1.
    pub ambient: f32,
    /// A small mark where the light is.
    pub light_marker: bool,
    /// What is marked.
    pub highlight: Highlight,
    /// Colours of what is drawn over the model.
    pub palette: OverlayPalette,
    /// Pixels of the device a logical pixel: widths of lines follow it.
    pub scale: f32,
    /// Side of a cell of the ground grid, metres; `None` = a power of ten after the size of the scene.
    pub grid_cell: Option<f32>,
    /// How many times as wide as usual lines are, 0.5 to 4.
    pub line_width: f32,
}

impl Default for Display {
    fn default() -> Self {
        let palette = OverlayPalette::of(Theme::Dark);
        Self {
            shading: Shading::Gouraud,
            samples: Samples::Four,
            mesh: true,
            muscle: true,
            see_through: true,
            lines_of_action: false,
            materials: true,
            smooth_normals: true,
            normal_glyphs: false,
            wireframe: false,
            bones: false,
            bone_axes: false,
            xray: true,
            grid: true,
            ground: None,
            axes: false,
            bounding_box: false,
            depth_test: true,
            cull_back_faces: false,
            background: Background::Gradient(palette.background.0, palette.background.1),
            light: None,
            ambient: 0.25,
            light_marker: false,
            highlight: Highlight::default(),
            palette,
            scale: 1.0,
            grid_cell: None,
            line_width: 1.0,
        }
    }
}
