//! Shading: four models, each with its attributes at the corners and its colour function at a pixel.

use glam::Vec3;

use super::draw_data::{DrawCall, FrameData, VertexReader};
use super::light::{lighting_terms, normalize, shading_point};
use super::material_state::{Normals, ResolvedMaterial};
use super::texels::{Texels, textures};
use super::texture::Texture;
use super::vertex::combine_lighting;
use sinew_simd::{Scalar, Simd, always, each, map};

/// A shader with `K` attributes, a multiple of four so that attribute planes are set up by whole vectors; attribute 0 is left to the caller.
pub(super) trait ShaderAttributes<const K: usize> {
    /// Whether the colour is a mixture of the corners' colours, and these are within 0 to 255.
    const BOUNDED: bool = false;
    /// Whether it is laid over what is there; `None` where the item says so.
    const BLENDED: Option<bool> = None;
    /// Whether a vector of pixels costs so much more to colour than to find that it should have few lanes outside the triangle.
    const COSTLY: bool = true;
    /// How many of the attributes mean anything; those behind are not carried along.
    const USED: usize = K;
    /// Values at the corners of triangle `t`.
    fn corners(&self, reader: &VertexReader<'_>, t: usize, other_side: bool) -> [[f32; K]; 3];
    /// Levels of the textures where the corners of a triangle agree about them, several triangles side by side: see [`Gradients::levels`].
    #[inline(always)]
    fn levels<L: Simd>(&self, l: L, corners: &TriangleAttributes<L, K>) -> [L::I; 3] {
        let _ = corners;
        [l.isplat(Gradients::<K>::MIXED); 3]
    }
    /// Red, green, blue and opacity, 0 to 255 or a little beyond. `values[0]` is the distance where attributes are curved.
    fn shade<L: Simd>(&self, l: L, values: &[L::F; K], gradients: &Gradients<K>) -> [L::F; 4];
}

/// Makes the shader of a draw call.
pub(super) trait Shader<'a>: Sized {
    fn new(frame_data: &'a FrameData<'a>, item: &'a DrawCall) -> Self;
}

/// How attributes change from pixel to pixel, for the choice of a mip level.
pub(super) struct Gradients<const K: usize> {
    pub right: [f32; K],
    pub below: [f32; K],
    /// Whether they are slopes of attributes times nearness.
    pub curved: bool,
    /// Levels of the material's textures, as [`super::texture::MipDetail::half`] counts them, where all corners of the triangle agree; [`Gradients::MIXED`] where they
    /// don't or there is none.
    pub levels: [i32; 3],
}

impl<const K: usize> Gradients<K> {
    /// Each pixel has to choose its level.
    pub(super) const MIXED: i32 = -1;

    /// Change of the attributes `first` and `first + 1` a pixel to the right and downward.
    #[inline(always)]
    pub(super) fn of<L: Simd>(&self, l: L, values: &[L::F; K], first: usize) -> [[L::F; 2]; 2] {
        let along = always!(|slope: &[f32; K], k: usize| {
            let straight = l.splat(slope[k]);
            // Quotient rule, with values[0] = 1 / nearness.
            if self.curved { (straight - values[k] * l.splat(slope[0])) * values[0] } else { straight }
        });
        [[along(&self.right, first), along(&self.right, first + 1)], [along(&self.below, first), along(&self.below, first + 1)]]
    }
}

/// Attributes of triangles side by side, for what is the same all over each.
pub(super) struct TriangleAttributes<L: Simd, const K: usize> {
    /// At the three corners, times nearness where they are curved.
    pub values: [[L::F; K]; 3],
    pub right: [L::F; K],
    pub below: [L::F; K],
    pub curved: L::M,
}

impl<L: Simd, const K: usize> TriangleAttributes<L, K> {
    /// The levels of the textures that attributes `first` and `first + 1` are the coordinates of.
    #[inline(always)]
    fn levels(&self, l: L, textures: [Option<&Texture>; 3], first: usize) -> [L::I; 3] {
        map(
            textures,
            always!(|texture: Option<&Texture>| {
                let mixed = l.isplat(Gradients::<K>::MIXED);
                let Some(texture) = texture else { return mixed };
                let at = always!(|corner: usize| {
                    let values = &self.values[corner];
                    let inverse = l.splat(1.0) / l.max(values[0], l.splat(1e-30));
                    let along = always!(|slope: &[L::F; K], k: usize| {
                        let exact = (slope[k] - values[k] * inverse * slope[0]) * inverse;
                        l.select(self.curved, exact, slope[k])
                    });
                    let across = [along(&self.right, first), along(&self.right, first + 1)];
                    texture.detail(l, across, [along(&self.below, first), along(&self.below, first + 1)]).half
                });
                let [a, b, c] = [at(0), at(1), at(2)];
                // Levels are small and not negative: what they are apart is 0 only where they are equal.
                let apart = l.iabs(a - b) | l.iabs(b - c);
                l.iselect(l.ilt(l.isplat(0), apart), mixed, a)
            }),
        )
    }
}

/// Colours between the corners.
pub(super) struct Gouraud<'a> {
    frame_data: &'a FrameData<'a>,
    style: &'a ResolvedMaterial,
}

impl<'a> Shader<'a> for Gouraud<'a> {
    #[inline(always)]
    fn new(frame_data: &'a FrameData<'a>, item: &'a DrawCall) -> Self {
        Self { frame_data, style: &item.material }
    }
}

impl Gouraud<'_> {
    /// The corners' colours, each turned into attributes: before the ways meet, so that they stay in registers.
    #[inline(always)]
    fn colors<const K: usize>(
        &self,
        reader: &VertexReader<'_>,
        t: usize,
        other_side: bool,
        to: impl Fn([f32; 4]) -> [f32; K],
    ) -> [[f32; K]; 3] {
        match self.style.normals {
            Normals::Smooth => {
                let [a, b, c] = reader.lit(t, other_side);
                [to(a), to(b), to(c)]
            }
            _ => {
                let [a, b, c] = face_colors(self.frame_data, self.style, reader, t, other_side);
                [to(a), to(b), to(c)]
            }
        }
    }
}

/// Opaque.
impl ShaderAttributes<4> for Gouraud<'_> {
    const BOUNDED: bool = true;
    const BLENDED: Option<bool> = Some(false);
    const COSTLY: bool = false;

    #[inline(always)]
    fn corners(&self, reader: &VertexReader<'_>, t: usize, other_side: bool) -> [[f32; 4]; 3] {
        self.colors(reader, t, other_side, always!(|[r, g, b, _]: [f32; 4]| [0.0, r, g, b]))
    }

    #[inline(always)]
    fn shade<L: Simd>(&self, l: L, values: &[L::F; 4], _: &Gradients<4>) -> [L::F; 4] {
        [values[1], values[2], values[3], l.splat(255.0)]
    }
}

/// With opacity.
impl ShaderAttributes<8> for Gouraud<'_> {
    const BLENDED: Option<bool> = Some(true);
    const COSTLY: bool = false;
    const USED: usize = 5;

    #[inline(always)]
    fn corners(&self, reader: &VertexReader<'_>, t: usize, other_side: bool) -> [[f32; 8]; 3] {
        self.colors(reader, t, other_side, always!(|[r, g, b, a]: [f32; 4]| [0.0, r, g, b, a, 0.0, 0.0, 0.0]))
    }

    #[inline(always)]
    fn shade<L: Simd>(&self, _: L, values: &[L::F; 8], _: &Gradients<8>) -> [L::F; 4] {
        [values[1], values[2], values[3], values[4]]
    }
}

/// Light between the corners, colour from a texture. `PLAIN` where the colour is that of the texture times the light and nothing else; see [`is_opaque_textured`].
pub(super) struct GouraudTextured<'a, const PLAIN: bool> {
    frame_data: &'a FrameData<'a>,
    style: &'a ResolvedMaterial,
}

/// Light between the corners, colour from a texture.
pub(super) type AnyTextured<'a> = GouraudTextured<'a, false>;
/// Colour from a texture times light, and nothing else.
pub(super) type OpaqueTextured<'a> = GouraudTextured<'a, true>;

/// Whether the texture times the light is all that a style wants: no shine, glow, opacity or mark.
pub(super) fn is_opaque_textured(frame_data: &FrameData<'_>, style: &ResolvedMaterial) -> bool {
    let colored = style.diffuse.is_some_and(|sampler| (sampler.texture as usize) < frame_data.textures.len());
    let bare = style.cutout.is_none() && style.emission_texture.is_none() && style.opacity == 1.0 && style.mark_share == 0.0;
    colored && bare && style.specular == [0.0; 3] && style.emission == [0.0; 3]
}

impl<'a, const PLAIN: bool> Shader<'a> for GouraudTextured<'a, PLAIN> {
    #[inline(always)]
    fn new(frame_data: &'a FrameData<'a>, item: &'a DrawCall) -> Self {
        Self { frame_data, style: &item.material }
    }
}

impl<const PLAIN: bool> ShaderAttributes<8> for GouraudTextured<'_, PLAIN> {
    const USED: usize = if PLAIN { 6 } else { 7 };

    #[inline(always)]
    fn levels<L: Simd>(&self, l: L, corners: &TriangleAttributes<L, 8>) -> [L::I; 3] {
        corners.levels(l, textures(self.frame_data, self.style), 1)
    }

    #[inline(always)]
    fn corners(&self, reader: &VertexReader<'_>, t: usize, other_side: bool) -> [[f32; 8]; 3] {
        let uv = reader.uvs(t);
        let quads = match self.style.normals {
            Normals::Smooth => reader.lit(t, other_side),
            _ => face_light(self.frame_data, self.style, reader, t, other_side),
        };
        each(always!(|k: usize| [0.0, uv[k].x, uv[k].y, quads[k][0], quads[k][1], quads[k][2], quads[k][3], 0.0]))
    }

    #[inline(always)]
    fn shade<L: Simd>(&self, l: L, values: &[L::F; 8], gradients: &Gradients<8>) -> [L::F; 4] {
        let uv = [values[1], values[2]];
        let texel = Texels::read(l, self.frame_data, self.style, uv, gradients, values, 1);
        if PLAIN {
            let lit = always!(|i: usize| texel.color[i] * values[3 + i]);
            return [lit(0), lit(1), lit(2), l.splat(255.0)];
        }
        let (one, full) = (l.splat(1.0), l.splat(255.0));
        let style = self.style;
        let channel = always!(|i: usize| {
            let lit = texel.color[i] * values[3 + i];
            let dark = (one - lit * l.splat(1.0 / 255.0)) * (one - values[6] * l.splat(style.specular[i])) * (one - texel.emission[i]);
            let out = one - dark;
            (out + (l.splat(style.mark[i]) - out) * l.splat(style.mark_share)) * full
        });
        [channel(0), channel(1), channel(2), texel.opacity * full]
    }
}

/// Light at every pixel.
pub(super) struct Phong<'a> {
    frame_data: &'a FrameData<'a>,
    style: &'a ResolvedMaterial,
}

impl<'a> Shader<'a> for Phong<'a> {
    #[inline(always)]
    fn new(frame_data: &'a FrameData<'a>, item: &'a DrawCall) -> Self {
        Self { frame_data, style: &item.material }
    }
}

impl ShaderAttributes<12> for Phong<'_> {
    const USED: usize = 11;

    #[inline(always)]
    fn corners(&self, reader: &VertexReader<'_>, t: usize, other_side: bool) -> [[f32; 12]; 3] {
        let (places, normals) = geometry(self.style, reader, t, other_side);
        each(always!(|k: usize| {
            let (n, p, c) = (normals[k], places[k], reader.tint(t, k));
            [0.0, n.x, n.y, n.z, p.x, p.y, p.z, c[0], c[1], c[2], c[3], 0.0]
        }))
    }

    #[inline(always)]
    fn shade<L: Simd>(&self, l: L, v: &[L::F; 12], _: &Gradients<12>) -> [L::F; 4] {
        let normal = normalize(l, [v[1], v[2], v[3]]);
        let lights = &self.frame_data.lights;
        let seen = shading_point(l, lights, [v[4], v[5], v[6]], normal);
        let light = lighting_terms(l, lights, self.style.highlight, seen, false);
        let [r, g, b] = combine_lighting(l, self.style, light, [v[7], v[8], v[9]], map(self.style.emission, always!(|e| l.splat(e))));
        let full = l.splat(255.0);
        [r * full, g * full, b * full, v[10] * l.splat(self.style.opacity * 255.0)]
    }
}

/// Light at every pixel, colour from a texture.
pub(super) struct PhongTextured<'a> {
    frame_data: &'a FrameData<'a>,
    style: &'a ResolvedMaterial,
}

impl<'a> Shader<'a> for PhongTextured<'a> {
    #[inline(always)]
    fn new(frame_data: &'a FrameData<'a>, item: &'a DrawCall) -> Self {
        Self { frame_data, style: &item.material }
    }
}

impl ShaderAttributes<12> for PhongTextured<'_> {
    #[inline(always)]
    fn levels<L: Simd>(&self, l: L, corners: &TriangleAttributes<L, 12>) -> [L::I; 3] {
        corners.levels(l, textures(self.frame_data, self.style), 7)
    }

    #[inline(always)]
    fn corners(&self, reader: &VertexReader<'_>, t: usize, other_side: bool) -> [[f32; 12]; 3] {
        let (places, normals) = geometry(self.style, reader, t, other_side);
        let uv = reader.uvs(t);
        each(always!(|k: usize| {
            let (n, p, c) = (normals[k], places[k], reader.tint(t, k));
            [0.0, n.x, n.y, n.z, p.x, p.y, p.z, uv[k].x, uv[k].y, c[0], c[1], c[2]]
        }))
    }

    #[inline(always)]
    fn shade<L: Simd>(&self, l: L, v: &[L::F; 12], gradients: &Gradients<12>) -> [L::F; 4] {
        let texel = Texels::read(l, self.frame_data, self.style, [v[7], v[8]], gradients, v, 7);
        let normal = normalize(l, [v[1], v[2], v[3]]);
        let lights = &self.frame_data.lights;
        let seen = shading_point(l, lights, [v[4], v[5], v[6]], normal);
        let light = lighting_terms(l, lights, self.style.highlight, seen, false);
        let base = [texel.color[0] * v[9], texel.color[1] * v[10], texel.color[2] * v[11]];
        let [r, g, b] = combine_lighting(l, self.style, light, base, texel.emission);
        let full = l.splat(255.0);
        [r * full, g * full, b * full, texel.opacity * full]
    }
}

/// Places and normals of a triangle's corners, the normals on the side that is seen.
#[inline(always)]
fn geometry(style: &ResolvedMaterial, reader: &VertexReader<'_>, t: usize, other_side: bool) -> ([Vec3; 3], [Vec3; 3]) {
    let places = reader.positions(t);
    let sign = if other_side { -1.0 } else { 1.0 };
    let normals = match style.normals {
        Normals::Smooth => map(reader.normals(t), always!(|n| n * sign)),
        _ => [face_normal(style, places, other_side); 3],
    };
    (places, normals)
}

/// The unit normal of a triangle, on the side that is seen; zero where it has none.
#[inline(always)]
fn face_normal(style: &ResolvedMaterial, [a, b, c]: [Vec3; 3], other_side: bool) -> Vec3 {
    let cross = (b - a).cross(c - a);
    // The length of the longest component first: a small triangle must not vanish in the squares.
    let normal = (cross / cross.abs().max_element().max(1e-30)).normalize_or_zero();
    if other_side != style.mirrored { -normal } else { normal }
}

/// Light at the corners, or in the middle, with the triangle's own normal.
#[inline(never)]
fn face_lighting(
    frame_data: &FrameData<'_>,
    style: &ResolvedMaterial,
    reader: &VertexReader<'_>,
    t: usize,
    other_side: bool,
) -> [super::light::LightingTerms<Scalar>; 3] {
    let places = reader.positions(t);
    let normal = face_normal(style, places, other_side).to_array();
    let at = always!(|p: Vec3| lighting_terms(
        Scalar,
        &frame_data.lights,
        style.highlight,
        shading_point(Scalar, &frame_data.lights, p.to_array(), normal),
        false
    ));
    if style.normals == Normals::Flat {
        [at((places[0] + places[1] + places[2]) / 3.0); 3]
    } else {
        each(always!(|k: usize| at(places[k])))
    }
}

#[inline(never)]
fn face_colors(
    frame_data: &FrameData<'_>,
    style: &ResolvedMaterial,
    reader: &VertexReader<'_>,
    t: usize,
    other_side: bool,
) -> [[f32; 4]; 3] {
    let light = face_lighting(frame_data, style, reader, t, other_side);
    each(always!(|k: usize| {
        let [r, g, b, a] = reader.tint(t, k);
        let color = combine_lighting(Scalar, style, light[k], [r, g, b], style.emission);
        let all = [color[0] * 255.0, color[1] * 255.0, color[2] * 255.0, a * (style.opacity * 255.0)];
        map(all, always!(|c: f32| Scalar.clamp(c, 0.0, 255.0)))
    }))
}

#[inline(never)]
fn face_light(
    frame_data: &FrameData<'_>,
    style: &ResolvedMaterial,
    reader: &VertexReader<'_>,
    t: usize,
    other_side: bool,
) -> [[f32; 4]; 3] {
    let light = face_lighting(frame_data, style, reader, t, other_side);
    each(always!(|k: usize| {
        let tint = reader.tint(t, k);
        let c = always!(|i: usize| (if style.unlit { 1.0 } else { light[k].light[i] }) * tint[i] * style.albedo[i] * 255.0);
        [c(0), c(1), c(2), light[k].highlight]
    }))
}
