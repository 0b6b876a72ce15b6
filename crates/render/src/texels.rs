//! Texture sampling for one pixel: mip levels and their mix.

use super::draw_data::FrameData;
use super::material_state::ResolvedMaterial;
use super::shade::Gradients;
use super::texture::{Texture, TextureSampler};
use sinew_scene::WrapMode;
use sinew_simd::{Simd, always, each, map};

/// What the textures of a material say at a pixel.
pub(super) struct Texels<L: Simd> {
    /// 0 to 1; multiplies the material's colour.
    pub color: [L::F; 3],
    /// 0 to 1, the material's own opacity included.
    pub opacity: L::F,
    /// 0 to 1.
    pub emission: [L::F; 3],
}

impl<L: Simd> Texels<L> {
    #[inline(always)]
    pub(super) fn read<const K: usize>(
        l: L,
        frame_data: &FrameData<'_>,
        style: &ResolvedMaterial,
        uv: [L::F; 2],
        gradients: &Gradients<K>,
        values: &[L::F; K],
        first: usize,
    ) -> Self {
        let glow = map(style.emission, always!(|emission| l.splat(emission)));
        let mut texels = Self { color: [l.splat(1.0); 3], opacity: l.splat(style.opacity), emission: glow };
        // A loop, so that the long way through a texture is compiled once.
        let samplers = [&style.diffuse, &style.cutout, &style.emission_texture];
        let mut which = 0;
        while which < samplers.len() {
            if let Some(sampler) = samplers[which]
                && let Some(texture) = frame_data.textures.get(sampler.texture as usize)
            {
                let [r, g, b, a] =
                    filtered(l, texture, sampler.wrap, uv, gradients, gradients.levels[which], TextureAttributes { values, first });
                match which {
                    0 => texels.color = [r, g, b],
                    1 => texels.opacity = texels.opacity * (a * l.splat(style.cutout_share) + l.splat(1.0 - style.cutout_share)),
                    _ => texels.emission = [texels.emission[0] * r, texels.emission[1] * g, texels.emission[2] * b],
                }
            }
            which += 1;
            // By far the most materials have a colour texture alone.
            if which == 1 && style.cutout.is_none() && style.emission_texture.is_none() {
                break;
            }
        }
        texels
    }
}

/// The interpolated attributes of a pixel, and which of them is the first texture coordinate.
#[derive(Clone, Copy)]
struct TextureAttributes<'a, L: Simd, const K: usize> {
    values: &'a [L::F; K],
    first: usize,
}

/// A texture where a pixel sees it: from one level of its mip chain, or from two that pass into each other.
#[inline(always)]
fn filtered<L: Simd, const K: usize>(
    l: L,
    texture: &Texture,
    wrap: [WrapMode; 2],
    uv: [L::F; 2],
    gradients: &Gradients<K>,
    half: i32,
    attributes: TextureAttributes<'_, L, K>,
) -> [L::F; 4] {
    let mut mips = [texture.mip(l, half >> 1), texture.mip(l, (half + 1) >> 1)];
    let mut share = l.splat(0.0);
    // Odd, or everything that is mixed.
    let mut two = half & 1 != 0;
    if two {
        let [across, down] = gradients.of(l, attributes.values, attributes.first);
        let detail = texture.detail(l, across, down);
        let mut finer = l.isplat(half >> 1);
        if half == Gradients::<K>::MIXED {
            two = l.any(detail.passes(l));
            let levels = detail.levels(l);
            finer = levels[0];
            mips = map(levels, always!(|level: L::I| texture.mips(l, level)));
        }
        share = detail.mix_factor(l, finer);
    }
    // A loop, so that reading is compiled once.
    let mut found = [l.splat(0.0); 4];
    let mut pass = 0;
    loop {
        let read = texture.sample(l, wrap, uv, mips[pass]);
        if pass == 1 {
            return each(always!(|k: usize| found[k] + (read[k] - found[k]) * share));
        }
        if !two {
            return read;
        }
        found = read;
        pass = 1;
    }
}

/// The textures of a material: colour, opacity, glow.
#[inline(always)]
pub(super) fn textures<'a>(frame_data: &'a FrameData<'a>, style: &ResolvedMaterial) -> [Option<&'a Texture>; 3] {
    map(
        [style.diffuse, style.cutout, style.emission_texture],
        always!(|sampler: Option<TextureSampler>| frame_data.textures.get(sampler?.texture as usize)),
    )
}
