//! What colour a pixel gets: the four ways of lighting, each as a set of attributes at the corners and a function of them at a pixel.

use glam::Vec3;

use super::drawing::{Drawing, Feed, Item};
use super::lanes::{Lanes, Scalar, always, each, map};
use super::light::{normalize, see, shine};
use super::style::{Normals, Style};
use super::vertex::finish;

/// A way of shading with `K` attributes; attribute 0 is left to the caller.
pub(super) trait Attributes<const K: usize> {
    /// Values at the corners of triangle `t`.
    fn corners(&self, feed: &Feed<'_>, t: usize, other_side: bool) -> [[f32; K]; 3];
    /// Red, green, blue and opacity, 0 to 255 or a little beyond. `values[0]` is the distance where attributes are curved.
    fn shade<L: Lanes>(&self, l: L, values: &[L::F; K], slopes: &Slopes<K>) -> [L::F; 4];
}

/// Makes a way of shading for an item.
pub(super) trait Shader<'a>: Sized {
    fn new(drawing: &'a Drawing<'a>, item: &'a Item) -> Self;
}

/// How attributes change from pixel to pixel, for the choice of a mip level.
pub(super) struct Slopes<const K: usize> {
    pub right: [f32; K],
    pub below: [f32; K],
    /// Whether they are slopes of attributes times nearness.
    pub curved: bool,
}

impl<const K: usize> Slopes<K> {
    /// Change of the attributes `first` and `first + 1` a pixel to the right and downward.
    #[inline(always)]
    fn of<L: Lanes>(&self, l: L, values: &[L::F; K], first: usize) -> [[L::F; 2]; 2] {
        let along = always!(|slope: &[f32; K], k: usize| {
            let straight = l.splat(slope[k]);
            // Quotient rule, with values[0] = 1 / nearness.
            if self.curved { (straight - values[k] * l.splat(slope[0])) * values[0] } else { straight }
        });
        [[along(&self.right, first), along(&self.right, first + 1)], [along(&self.below, first), along(&self.below, first + 1)]]
    }
}

/// Colours between the corners.
pub(super) struct Gouraud<'a> {
    drawing: &'a Drawing<'a>,
    style: &'a Style,
}

impl<'a> Shader<'a> for Gouraud<'a> {
    #[inline(always)]
    fn new(drawing: &'a Drawing<'a>, item: &'a Item) -> Self {
        Self { drawing, style: &item.style }
    }
}

impl Attributes<5> for Gouraud<'_> {
    #[inline(always)]
    fn corners(&self, feed: &Feed<'_>, t: usize, other_side: bool) -> [[f32; 5]; 3] {
        let quads = match self.style.normals {
            Normals::Smooth => feed.lit(t, other_side),
            _ => face_colors(self.drawing, self.style, feed, t, other_side),
        };
        map(quads, always!(|[r, g, b, a]: [f32; 4]| [0.0, r, g, b, a]))
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, _: L, values: &[L::F; 5], _: &Slopes<5>) -> [L::F; 4] {
        [values[1], values[2], values[3], values[4]]
    }
}

/// Light between the corners, colour from a texture.
pub(super) struct Textured<'a> {
    drawing: &'a Drawing<'a>,
    style: &'a Style,
}

impl<'a> Shader<'a> for Textured<'a> {
    #[inline(always)]
    fn new(drawing: &'a Drawing<'a>, item: &'a Item) -> Self {
        Self { drawing, style: &item.style }
    }
}

impl Attributes<7> for Textured<'_> {
    #[inline(always)]
    fn corners(&self, feed: &Feed<'_>, t: usize, other_side: bool) -> [[f32; 7]; 3] {
        let uv = feed.uvs(t);
        let quads = match self.style.normals {
            Normals::Smooth => feed.lit(t, other_side),
            _ => face_light(self.drawing, self.style, feed, t, other_side),
        };
        each(always!(|k: usize| [0.0, uv[k].x, uv[k].y, quads[k][0], quads[k][1], quads[k][2], quads[k][3]]))
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, l: L, values: &[L::F; 7], slopes: &Slopes<7>) -> [L::F; 4] {
        let uv = [values[1], values[2]];
        let [across, down] = slopes.of(l, values, 1);
        let texel = Texels::read(l, self.drawing, self.style, uv, across, down);
        let (one, full) = (l.splat(1.0), l.splat(255.0));
        let style = self.style;
        let channel = always!(|i: usize| {
            let lit = texel.color[i] * values[3 + i];
            let dark = (one - lit * l.splat(1.0 / 255.0)) * (one - values[6] * l.splat(style.specular[i])) * (one - texel.glow[i]);
            let out = one - dark;
            (out + (l.splat(style.mark[i]) - out) * l.splat(style.mark_share)) * full
        });
        [channel(0), channel(1), channel(2), texel.opacity * full]
    }
}

/// Light at every pixel.
pub(super) struct Phong<'a> {
    drawing: &'a Drawing<'a>,
    style: &'a Style,
}

impl<'a> Shader<'a> for Phong<'a> {
    #[inline(always)]
    fn new(drawing: &'a Drawing<'a>, item: &'a Item) -> Self {
        Self { drawing, style: &item.style }
    }
}

impl Attributes<11> for Phong<'_> {
    #[inline(always)]
    fn corners(&self, feed: &Feed<'_>, t: usize, other_side: bool) -> [[f32; 11]; 3] {
        let (places, normals) = geometry(self.style, feed, t, other_side);
        each(always!(|k: usize| {
            let (n, p, c) = (normals[k], places[k], feed.tint(t, k));
            [0.0, n.x, n.y, n.z, p.x, p.y, p.z, c[0], c[1], c[2], c[3]]
        }))
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, l: L, v: &[L::F; 11], _: &Slopes<11>) -> [L::F; 4] {
        let normal = normalize(l, [v[1], v[2], v[3]]);
        let lights = &self.drawing.lights;
        let seen = see(l, lights, [v[4], v[5], v[6]], normal);
        let light = shine(l, lights, self.style.gloss, seen, false);
        let [r, g, b] = finish(l, self.style, light, [v[7], v[8], v[9]], map(self.style.emission, always!(|e| l.splat(e))));
        let full = l.splat(255.0);
        [r * full, g * full, b * full, v[10] * l.splat(self.style.opacity * 255.0)]
    }
}

/// Light at every pixel, colour from a texture.
pub(super) struct PhongTextured<'a> {
    drawing: &'a Drawing<'a>,
    style: &'a Style,
}

impl<'a> Shader<'a> for PhongTextured<'a> {
    #[inline(always)]
    fn new(drawing: &'a Drawing<'a>, item: &'a Item) -> Self {
        Self { drawing, style: &item.style }
    }
}

impl Attributes<12> for PhongTextured<'_> {
    #[inline(always)]
    fn corners(&self, feed: &Feed<'_>, t: usize, other_side: bool) -> [[f32; 12]; 3] {
        let (places, normals) = geometry(self.style, feed, t, other_side);
        let uv = feed.uvs(t);
        each(always!(|k: usize| {
            let (n, p, c) = (normals[k], places[k], feed.tint(t, k));
            [0.0, n.x, n.y, n.z, p.x, p.y, p.z, uv[k].x, uv[k].y, c[0], c[1], c[2]]
        }))
    }

    #[inline(always)]
    fn shade<L: Lanes>(&self, l: L, v: &[L::F; 12], slopes: &Slopes<12>) -> [L::F; 4] {
        let [across, down] = slopes.of(l, v, 7);
        let texel = Texels::read(l, self.drawing, self.style, [v[7], v[8]], across, down);
        let normal = normalize(l, [v[1], v[2], v[3]]);
        let lights = &self.drawing.lights;
        let seen = see(l, lights, [v[4], v[5], v[6]], normal);
        let light = shine(l, lights, self.style.gloss, seen, false);
        let base = [texel.color[0] * v[9], texel.color[1] * v[10], texel.color[2] * v[11]];
        let [r, g, b] = finish(l, self.style, light, base, texel.glow);
        let full = l.splat(255.0);
        [r * full, g * full, b * full, texel.opacity * full]
    }
}

/// What the textures of a material say at a pixel.
struct Texels<L: Lanes> {
    /// 0 to 1; multiplies the material's colour.
    color: [L::F; 3],
    /// 0 to 1, the material's own opacity included.
    opacity: L::F,
    /// 0 to 1.
    glow: [L::F; 3],
}

impl<L: Lanes> Texels<L> {
    #[inline(always)]
    fn read(l: L, drawing: &Drawing<'_>, style: &Style, uv: [L::F; 2], across: [L::F; 2], down: [L::F; 2]) -> Self {
        let byte = l.splat(1.0 / 255.0);
        let mut texels = Self {
            color: [l.splat(1.0); 3],
            opacity: l.splat(style.opacity),
            glow: map(style.emission, always!(|emission| l.splat(emission))),
        };
        // A loop, so that there is one copy of the sampling code.
        for (which, sampler) in [&style.diffuse, &style.cutout, &style.glow].into_iter().enumerate() {
            let Some(sampler) = sampler else { continue };
            let Some(texture) = drawing.textures.get(sampler.texture as usize) else { continue };
            let [r, g, b, a] = map(texture.sample(l, sampler.wrap, uv, across, down), always!(|c| c * byte));
            match which {
                0 => {
                    texels.color = [r, g, b];
                    texels.opacity = texels.opacity * a;
                }
                1 => texels.opacity = texels.opacity * a,
                _ => texels.glow = [texels.glow[0] * r, texels.glow[1] * g, texels.glow[2] * b],
            }
        }
        texels
    }
}

/// Places and normals of a triangle's corners, the normals on the side that is seen.
#[inline(always)]
fn geometry(style: &Style, feed: &Feed<'_>, t: usize, other_side: bool) -> ([Vec3; 3], [Vec3; 3]) {
    let places = feed.places(t);
    let sign = if other_side { -1.0 } else { 1.0 };
    let normals = match style.normals {
        Normals::Smooth => map(feed.normals(t), always!(|n| n * sign)),
        _ => [face_normal(style, places, other_side); 3],
    };
    (places, normals)
}

/// The unit normal of a triangle, on the side that is seen; zero where it has none.
#[inline(always)]
fn face_normal(style: &Style, [a, b, c]: [Vec3; 3], other_side: bool) -> Vec3 {
    let cross = (b - a).cross(c - a);
    // The length of the longest component first: a small triangle must not vanish in the squares.
    let normal = (cross / cross.abs().max_element().max(1e-30)).normalize_or_zero();
    if other_side != style.mirrored { -normal } else { normal }
}

/// Light at the corners, or in the middle, with the triangle's own normal.
#[inline(never)]
fn face_shine(drawing: &Drawing<'_>, style: &Style, feed: &Feed<'_>, t: usize, other_side: bool) -> [super::light::Shine<Scalar>; 3] {
    let places = feed.places(t);
    let normal = face_normal(style, places, other_side).to_array();
    let at = always!(|p: Vec3| shine(Scalar, &drawing.lights, style.gloss, see(Scalar, &drawing.lights, p.to_array(), normal), false));
    if style.normals == Normals::Flat {
        [at((places[0] + places[1] + places[2]) / 3.0); 3]
    } else {
        each(always!(|k: usize| at(places[k])))
    }
}

#[inline(never)]
fn face_colors(drawing: &Drawing<'_>, style: &Style, feed: &Feed<'_>, t: usize, other_side: bool) -> [[f32; 4]; 3] {
    let light = face_shine(drawing, style, feed, t, other_side);
    each(always!(|k: usize| {
        let [r, g, b, a] = feed.tint(t, k);
        let color = finish(Scalar, style, light[k], [r, g, b], style.emission);
        [color[0] * 255.0, color[1] * 255.0, color[2] * 255.0, a * (style.opacity * 255.0)]
    }))
}

#[inline(never)]
fn face_light(drawing: &Drawing<'_>, style: &Style, feed: &Feed<'_>, t: usize, other_side: bool) -> [[f32; 4]; 3] {
    let light = face_shine(drawing, style, feed, t, other_side);
    each(always!(|k: usize| {
        let tint = feed.tint(t, k);
        let c = always!(|i: usize| (if style.unlit { 1.0 } else { light[k].light[i] }) * tint[i] * style.albedo[i] * 255.0);
        [c(0), c(1), c(2), light[k].highlight]
    }))
}
