//! Material, display options and surface, resolved to the numbers that the kernels read.

use super::light::Specular;
use super::texture::TextureSampler;

/// What the vertex stage hands on for each vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum VertexOutput {
    /// Finished colour and opacity.
    Color,
    /// Light times colour, and highlight: a texture is to come.
    Light,
    /// Position and normal in the world: lit later, by triangle or by pixel.
    Geometry,
}

/// Where the normal comes from when a triangle is lit after the vertex stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Normals {
    /// Interpolated from the vertices.
    Smooth,
    /// The triangle's own, light at each corner.
    Face,
    /// The triangle's own, light once in its middle.
    Flat,
}

/// When something is drawn, and into what.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum RenderPass {
    /// First, in order.
    Opaque,
    /// After all that is opaque, the farthest first.
    Blended,
    /// Into a layer of its own that is laid over the picture: bones.
    Overlay,
}

/// Which kernel fills the triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ShaderKind {
    /// Colours blended between the corners.
    Gouraud,
    /// Light between the corners, colour from a texture.
    Textured,
    /// Light at each pixel.
    Phong,
    /// Light at each pixel, colour from a texture.
    PhongTextured,
}

/// How the triangles of one item are drawn.
#[derive(Debug, Clone)]
pub(super) struct ResolvedMaterial {
    pub vertex_output: VertexOutput,
    pub normals: Normals,
    pub pass: RenderPass,
    pub shader: ShaderKind,
    /// How many steps it is pushed back in depth; see [`super::projection::ViewTransform::depth_bias`].
    pub depth_offset: f32,
    /// Colour under full light, 0 to 1.
    pub albedo: [f32; 3],
    pub opacity: f32,
    pub emission: [f32; 3],
    pub specular: [f32; 3],
    pub highlight: Specular,
    /// No light: the colour as it is.
    pub unlit: bool,
    /// Back faces show, so they have to be lit too.
    pub both_sides: bool,
    /// Whether clockwise is outside.
    pub mirrored: bool,
    /// Whether vertices have colours of their own.
    pub tinted: bool,
    /// Colour of a selected or hovered surface and its share.
    pub mark: [f32; 3],
    pub mark_share: f32,
    pub depth_test: bool,
    pub diffuse: Option<TextureSampler>,
    pub cutout: Option<TextureSampler>,
    /// How much of the cutout counts: opacity is multiplied by `1 − share + share · texture`.
    pub cutout_share: f32,
    pub emission_texture: Option<TextureSampler>,
}

impl Default for ResolvedMaterial {
    fn default() -> Self {
        Self {
            vertex_output: VertexOutput::Color,
            normals: Normals::Smooth,
            pass: RenderPass::Opaque,
            shader: ShaderKind::Gouraud,
            depth_offset: 0.0,
            albedo: [1.0; 3],
            opacity: 1.0,
            emission: [0.0; 3],
            specular: [0.0; 3],
            highlight: Specular { exponent: 0.0, mirrored: false },
            unlit: false,
            both_sides: true,
            mirrored: false,
            tinted: false,
            mark: [0.0; 3],
            mark_share: 0.0,
            depth_test: true,
            diffuse: None,
            cutout: None,
            cutout_share: 1.0,
            emission_texture: None,
        }
    }
}
