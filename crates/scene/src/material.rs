//! Materials, textures and images.

use std::path::PathBuf;
use std::sync::Arc;

use glam::{Affine2, Vec2, Vec3};

use super::{ImageId, Label, MaterialId, Unnamed};

/// How a texture goes on beyond its edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum WrapMode {
    /// Again and again.
    #[default]
    Repeat,
    /// Again, mirrored every other time.
    Mirror,
    /// The edge's colour.
    Clamp,
    /// Transparent black (COLLADA's BORDER and NONE).
    Border,
}

/// Where a texture lies on the texture coordinates that are given: `uv′ = turned(uv · repeat + offset)`, turned about the middle of a tile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureTransform {
    /// How often it repeats along each axis.
    pub repeat: Vec2,
    /// What is added then, tiles.
    pub offset: Vec2,
    /// Rotation of the coordinates about (½, ½) after that, counter-clockwise, degrees.
    pub rotation: f32,
}

impl Default for TextureTransform {
    fn default() -> Self {
        Self { repeat: Vec2::ONE, offset: Vec2::ZERO, rotation: 0.0 }
    }
}

impl TextureTransform {
    /// From the coordinates that are given to those that the image is read with.
    pub fn matrix(&self) -> Affine2 {
        const MIDDLE: Vec2 = Vec2::splat(0.5);
        let turn = Affine2::from_translation(MIDDLE) * Affine2::from_angle(self.rotation.to_radians()) * Affine2::from_translation(-MIDDLE);
        turn * Affine2::from_scale_angle_translation(self.repeat, 0.0, self.offset)
    }
}

/// A use of an image.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureRef {
    /// The image.
    pub image: ImageId,
    /// The name of the texture coordinates that the effect asks for, bound in [`MaterialBinding`].
    pub semantic: String,
    /// Behaviour beyond the left and right edge.
    pub wrap_s: WrapMode,
    /// Behaviour beyond the lower and upper edge.
    pub wrap_t: WrapMode,
    /// Where it lies on the texture coordinates; `None` as these say.
    pub transform: Option<TextureTransform>,
}

/// A colour, or a texture that multiplies it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Paint {
    /// sRGB-encoded red, green, blue from 0 to 1, as the file writes them.
    pub color: Vec3,
    /// Multiplies the colour where it is there.
    pub texture: Option<TextureRef>,
}

impl Paint {
    /// A plain colour.
    pub fn color(red: f32, green: f32, blue: f32) -> Self {
        Self { color: Vec3::new(red, green, blue), texture: None }
    }
}

/// The lighting formula that the file names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ShadingModel {
    /// Unlit: emission alone (with ambient).
    Constant,
    /// Diffuse.
    #[default]
    Lambert,
    /// Diffuse and a mirrored highlight.
    Phong,
    /// Diffuse and a half-vector highlight.
    Blinn,
}

/// Where a texture keeps its opacity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AlphaSource {
    /// The alpha channel.
    Alpha,
    /// One minus the alpha channel.
    InverseAlpha,
    /// Luminance: 0.212671 R + 0.715160 G + 0.072169 B.
    Luminance,
    /// One minus luminance (COLLADA's RGB_ZERO).
    InverseLuminance,
}

/// A material, resolved: opaque modes are already turned into one opacity.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The name in its file; empty where it has none.
    pub name: String,
    /// The id in the file.
    pub id: String,
    /// Lighting formula.
    pub model: ShadingModel,
    /// Diffuse colour or texture.
    pub diffuse: Paint,
    /// Light that it gives off.
    pub emission: Paint,
    /// Answer to ambient light; most exporters write black, so the renderer uses `diffuse` when it is.
    pub ambient: Paint,
    /// Colour of the highlight; black means none.
    pub specular: Paint,
    /// Exponent of the highlight, 0 to 1000.
    pub shininess: f32,
    /// 1 = solid, 0 = invisible.
    pub opacity: f32,
    /// A texture that multiplies the opacity.
    pub opacity_texture: Option<(TextureRef, AlphaSource)>,
    /// How much of that texture counts, 0 to 1: opacity is multiplied by `1 − share + share · texture`.
    pub opacity_texture_share: f32,
    /// Whether the file says that both sides show.
    pub double_sided: bool,
}

impl Material {
    /// What it is called.
    pub fn label(&self) -> Label<'_> {
        Label::of(&self.name, Unnamed::of_id(&self.id, Unnamed::Material))
    }
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            id: String::new(),
            model: ShadingModel::Lambert,
            // The palette's "skin without material", #C9A48B.
            diffuse: Paint::color(0.788, 0.643, 0.545),
            emission: Paint::default(),
            ambient: Paint::default(),
            specular: Paint::default(),
            shininess: 20.0,
            opacity: 1.0,
            opacity_texture: None,
            opacity_texture_share: 1.0,
            double_sided: false,
        }
    }
}

impl Material {
    /// Copies the colours and numbers of `other` that animation can change. Allocates nothing.
    pub fn copy_animated_from(&mut self, other: &Self) {
        self.diffuse.color = other.diffuse.color;
        self.emission.color = other.emission.color;
        self.ambient.color = other.ambient.color;
        self.specular.color = other.specular.color;
        self.shininess = other.shininess;
        self.opacity = other.opacity;
        self.opacity_texture_share = other.opacity_texture_share;
    }
}

/// A material on a part of an instance.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct MaterialBinding {
    /// The material.
    pub material: MaterialId,
    /// Which of the mesh's [`super::Mesh::uv_sets`] each semantic name means; a name that isn't here means set 0.
    pub uv_sets: Vec<(String, u32)>,
}

impl MaterialBinding {
    /// A binding that uses the first set of texture coordinates for everything.
    pub fn plain(material: MaterialId) -> Self {
        Self { material, uv_sets: Vec::new() }
    }

    /// The set of texture coordinates that `texture` uses.
    pub fn uv_set(&self, texture: &TextureRef) -> u32 {
        self.uv_sets.iter().find(|(name, _)| *name == texture.semantic).map_or(0, |(_, set)| *set)
    }
}

/// Decoded pixels: RGBA, 8 bits a channel, not premultiplied, rows from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pixels {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width · height · 4` bytes.
    pub rgba: Vec<u8>,
}

/// An image that textures refer to.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Image {
    /// The name in its file; empty where it has none.
    pub name: String,
    /// The id in the file.
    pub id: String,
    /// The reference as the file wrote it.
    pub uri: String,
    /// Line of the reference in the file.
    pub line: Option<u32>,
    /// The file that was found on the disk.
    pub path: Option<PathBuf>,
    /// Whether it was found inside the document's own file.
    pub archived: bool,
    /// Columns and rows of that file. The picture has fewer where the images of a document would take too much room.
    pub size: Option<[u32; 2]>,
    /// The picture; `None` where it is missing or broken, and a neutral colour is drawn.
    pub pixels: Option<Arc<Pixels>>,
}

impl Image {
    /// What it is called.
    pub fn label(&self) -> Label<'_> {
        Label::of(&self.name, Unnamed::Image)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texture_repeats_then_moves_then_turns_about_the_middle_of_a_tile() {
        let read = |placing: TextureTransform, u: f32, v: f32| placing.matrix().transform_point2(Vec2::new(u, v));
        assert_eq!(read(TextureTransform::default(), 0.25, 0.75), Vec2::new(0.25, 0.75));
        let moved = TextureTransform { repeat: Vec2::new(3.0, 2.0), offset: Vec2::new(0.5, -0.25), rotation: 0.0 };
        assert_eq!(read(moved, 0.5, 1.0), Vec2::new(2.0, 1.75));
        // A quarter turn takes the right edge's middle to the upper edge's.
        let turned = read(TextureTransform { rotation: 90.0, ..TextureTransform::default() }, 1.0, 0.5);
        assert!(turned.abs_diff_eq(Vec2::new(0.5, 1.0), 1e-6), "{turned}");
        let all = read(TextureTransform { rotation: 90.0, ..moved }, 0.5, 1.0);
        assert!(all.abs_diff_eq(Vec2::new(-0.75, 2.0), 1e-6), "{all}");
    }
}
