//! Images as mip chains, and reading them with bilinear filtering.

use std::sync::Arc;

use glam::Affine2;

use super::RenderError;
use super::fiber_texture::FiberTexture;
use super::memory::{collect, push};
use super::srgb::Srgb;
use sinew_scene::{AlphaSource, Pixels, WrapMode};
use sinew_simd::{Simd, always};

/// Most levels: enough for [`sinew_scene::limits::IMAGE_SIDE`].
const LEVELS: usize = 16;

/// A use of a texture.
#[derive(Debug, Clone, Copy)]
pub(super) struct TextureSampler {
    /// From the mesh's texture coordinates to those that the texture is read with; `None` where they are the same.
    pub uv_transform: Option<Affine2>,
    /// Index in the cache's list.
    pub texture: u32,
    /// Horizontally, vertically.
    pub wrap: [WrapMode; 2],
    /// Set of texture coordinates.
    pub uv_set: u32,
}

/// What the alpha of a mip chain holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Alpha {
    /// 255 everywhere: the image is a colour.
    Solid,
    /// Opacity by this rule.
    From(AlphaSource),
}

/// Texels kept beyond the edges of a level, so that the four texels round a point never have to be wrapped one by one: one on the left and above, two on the
/// right and below.
const BORDER: u32 = 3;

/// A mip chain of `0xAARRGGBB` texels, rows from the top, each level with an apron that continues it as its wrapping says.
#[derive(Debug, Default)]
pub(super) struct Texture {
    texels: Vec<u32>,
    /// Where the apron of each level begins: before and above its texel (0, 0).
    origin: [u32; LEVELS],
    width: [u32; LEVELS],
    height: [u32; LEVELS],
    last: u32,
}

impl Texture {
    /// The chain of an image.
    pub(super) fn from_pixels(pixels: &Pixels, alpha: Alpha, wrap: [WrapMode; 2]) -> Result<Self, RenderError> {
        let texel = |p: &[u8]| {
            let [r, g, b, a] = [p[0], p[1], p[2], p[3]];
            let luminance = 0.212_671 * f32::from(r) + 0.715_160 * f32::from(g) + 0.072_169 * f32::from(b);
            let a = match alpha {
                Alpha::Solid => 255,
                Alpha::From(AlphaSource::Alpha) => a,
                Alpha::From(AlphaSource::InverseAlpha) => 255 - a,
                Alpha::From(AlphaSource::Luminance) => (luminance + 0.5) as u8,
                Alpha::From(AlphaSource::InverseLuminance) => 255 - (luminance + 0.5) as u8,
            };
            u32::from_be_bytes([a, r, g, b])
        };
        let full = pixels.width as usize * pixels.height as usize;
        let mut texels = Vec::new();
        texels.try_reserve_exact(full)?;
        texels.extend(pixels.rgba.chunks_exact(4).take(full).map(texel));
        // An image whose pixels are missing is white where they are.
        texels.resize(full, u32::MAX);
        Self::from_texels(texels, pixels.width, pixels.height, wrap)
    }

    /// The chain over a first level of `width` × `height` texels.
    pub(super) fn from_texels(mut level: Vec<u32>, mut width: u32, mut height: u32, wrap: [WrapMode; 2]) -> Result<Self, RenderError> {
        if width == 0 || height == 0 || level.len() < width as usize * height as usize {
            (level, width, height) = (vec![u32::MAX], 1, 1);
        }
        let mut chain = Self::default();
        chain.texels.try_reserve_exact(chain_len(width, height))?;
        for k in 0..LEVELS {
            (chain.width[k], chain.height[k], chain.last) = (width, height, k as u32);
            chain.origin[k] = chain.texels.len() as u32;
            for y in -1..height as i32 + 2 {
                let row = wrapped_texel(wrap[1], y, height).map(|y| &level[y as usize * width as usize..][..width as usize]);
                let texel = |x: i32| wrapped_texel(wrap[0], x, width).and_then(|x| row.map(|row| row[x as usize])).unwrap_or(0);
                chain.texels.extend((-1..width as i32 + 2).map(texel));
            }
            if width == 1 && height == 1 {
                break;
            }
            (level, width, height) = halve(&level, width, height)?;
        }
        Ok(chain)
    }

    /// How much is to be seen, for a change of (u, v) a pixel to the right and a pixel downward: see [`MipDetail`].
    #[inline(always)]
    pub(super) fn detail<L: Simd>(&self, l: L, across: [L::F; 2], down: [L::F; 2]) -> MipDetail<L> {
        let (w, h) = (l.splat(self.width[0] as f32), l.splat(self.height[0] as f32));
        let size = always!(|d: [L::F; 2]| {
            let (x, y) = (d[0] * w, d[1] * h);
            x * x + y * y
        });
        let squared = l.clamp(l.max(size(across), size(down)), 1.0, 1e9);
        // The bits of a float are its logarithm in 2⁻²³ths, except for an invisible deviation between two powers; the root halves it.
        let octaves = l.bits(squared) - l.isplat(1.0f32.to_bits() as i32);
        let last = l.isplat((self.last << 24) as i32);
        let octaves = l.iselect(l.ilt(last, octaves), last, octaves);
        MipDetail { octaves, half: l.shr::<23>(octaves + l.isplat((1 << 23) - 1)) }
    }

    /// A level for each lane.
    #[inline(always)]
    pub(super) fn mips<L: Simd>(&self, l: L, level: L::I) -> Mip<L> {
        Mip { origin: l.gather(&self.origin, level), width: l.gather(&self.width, level), height: l.gather(&self.height, level) }
    }

    /// The same level everywhere.
    #[inline(always)]
    pub(super) fn mip<L: Simd>(&self, l: L, level: i32) -> Mip<L> {
        let level = level as usize & (LEVELS - 1);
        let splat = always!(|of: &[u32; LEVELS]| l.isplat(of[level] as i32));
        Mip { origin: splat(&self.origin), width: splat(&self.width), height: splat(&self.height) }
    }

    /// Bilinear texels, each channel 0 to 1 in the order red, green, blue, alpha. (0, 0) is the bottom left of the image.
    ///
    /// Places between texels are told apart to a 256th, and the shares of the four texels add up to 256 exactly, so that an even colour stays what it is.
    #[inline(always)]
    pub(super) fn sample<L: Simd>(&self, l: L, wrap: [WrapMode; 2], uv: [L::F; 2], mip: Mip<L>) -> [L::F; 4] {
        let (x, fx) = wrap_coordinate(l, wrap[0], uv[0], mip.width);
        let (y, fy) = wrap_coordinate(l, wrap[1], l.splat(1.0) - uv[1], mip.height);
        let pitch = mip.width + l.isplat(BORDER as i32);
        // Sides and places are below 2¹⁵, shares at most 256.
        let at = mip.origin + l.dot16(y, pitch) + x;
        let ([a, b], [c, d]) = (l.pairs(&self.texels, at), l.pairs(&self.texels, at + pitch));
        let taps = [a, b, c, d];
        let both = l.shr::<8>(l.dot16(fx, fy) + l.isplat(128));
        let shares = [l.isplat(256) - fx - fy + both, fx - both, fy - both, both];
        let even = l.isplat(0x00FF_00FF);
        // Red and blue in one word, alpha and green in another, 8 bits of fraction each.
        let (mut red_blue, mut alpha_green) = (l.isplat(0), l.isplat(0));
        for k in 0..4 {
            let share = shares[k] | l.shl::<16>(shares[k]);
            red_blue = red_blue + l.mul16(taps[k] & even, share);
            alpha_green = alpha_green + l.mul16(l.shr::<8>(taps[k]) & even, share);
        }
        let (low, scale) = (l.isplat(0xFFFF), l.splat(1.0 / (255.0 * 256.0)));
        let float = always!(|x: L::I| l.float(x) * scale);
        [float(l.shr::<16>(red_blue)), float(alpha_green & low), float(red_blue & low), float(l.shr::<16>(alpha_green))]
    }
}

/// Levels of a mip chain, lane by lane.
#[derive(Clone, Copy)]
pub(super) struct Mip<L: Simd> {
    origin: L::I,
    width: L::I,
    height: L::I,
}

/// How many texels go into a pixel, as the logarithm to base 2 of their number along a side.
///
/// From one whole number to the next, the first half of the way passes from level to level; on the second half the coarser one stands alone, so that half
/// of all pixels pay for one level only. Half numbers of levels therefore say it all: `half` is even where level `half / 2` stands alone, odd where level
/// `half / 2`, rounded down, passes into the next.
#[derive(Clone, Copy)]
pub(super) struct MipDetail<L: Simd> {
    /// In 2⁻²⁴ths, never negative.
    octaves: L::I,
    pub half: L::I,
}

impl<L: Simd> MipDetail<L> {
    /// Share of the level after `finer`; it starts and ends gently, so that neither end shows as a line. 0 where `finer` stands alone.
    #[inline(always)]
    pub(super) fn mix_factor(self, l: L, finer: L::I) -> L::F {
        let within = l.clamp(l.float(self.octaves - l.shl::<24>(finer)) * l.splat(1.0 / (1 << 23) as f32), 0.0, 1.0);
        within * within * (l.splat(3.0) - (within + within))
    }

    /// Where two levels meet.
    #[inline(always)]
    pub(super) fn passes(self, l: L) -> L::M {
        l.ilt(l.isplat(0), self.half & l.isplat(1))
    }

    /// The finer and the coarser level; the same one twice where it stands alone.
    #[inline(always)]
    pub(super) fn levels(self, l: L) -> [L::I; 2] {
        [l.shr::<1>(self.half), l.shr::<1>(self.half + l.isplat(1))]
    }
}

/// The texel on the lower side of a coordinate, counted from the beginning of the apron, and how far (0 to 255) it is from there to the next.
///
/// All in 256ths of a texel: half a texel back to the middle of one, a whole one forward to the apron, half a 256th to round.
#[inline(always)]
fn wrap_coordinate<L: Simd>(l: L, wrap: WrapMode, coordinate: L::F, size: L::I) -> (L::I, L::I) {
    // What repeats is rounded down, which takes a number of moderate size; NaN becomes one too.
    let moderate = always!(|| l.clamp(coordinate, -1e6, 1e6));
    let length = l.float(l.shl::<8>(size));
    let ahead = l.splat(128.5);
    let position = match wrap {
        WrapMode::Repeat => {
            let coordinate = moderate();
            (coordinate - l.floor(coordinate)) * length + ahead
        }
        WrapMode::Mirror => {
            let coordinate = moderate();
            let two = coordinate - l.splat(2.0) * l.floor(coordinate * l.splat(0.5));
            l.min(two, l.splat(2.0) - two) * length + ahead
        }
        WrapMode::Clamp => l.clamp(coordinate, 0.0, 1.0) * length + ahead,
        // From the first texel of the apron on the one side to the last but one on the other.
        WrapMode::Border => l.min(l.max(coordinate * length + ahead, l.splat(0.5)), length + l.splat(256.5)),
    };
    let position = l.trunc(position);
    (l.shr::<8>(position), position & l.isplat(255))
}

/// Which texel stands at place `at` of an edge with `size` texels; `None` for the border's nothing.
fn wrapped_texel(wrap: WrapMode, at: i32, size: u32) -> Option<i32> {
    let size = size as i32;
    match wrap {
        WrapMode::Repeat => Some(at.rem_euclid(size)),
        WrapMode::Mirror => {
            let two = at.rem_euclid(2 * size);
            Some(two.min(2 * size - 1 - two))
        }
        WrapMode::Clamp => Some(at.clamp(0, size - 1)),
        WrapMode::Border => (0..size).contains(&at).then_some(at),
    }
}

/// The next level: what the texels beneath send out together in light, and the mean of their opacities. An odd side is shared out evenly,
/// three texels to one, so that none is left out.
fn halve(level: &[u32], width: u32, height: u32) -> Result<(Vec<u32>, u32, u32), RenderError> {
    let to = [(width / 2).max(1), (height / 2).max(1)];
    let tables = Srgb::tables();
    let columns = collect((0..to[0]).map(|x| source_texels(x, width)))?;
    let mut texels = Vec::new();
    texels.try_reserve_exact(to[0] as usize * to[1] as usize)?;
    let all = u64::from(box_weights(width)) * u64::from(box_weights(height));
    // A division of such numbers takes longer than all the rest, and most sides are even.
    let part = |sum: u64| (if all == 4 { sum >> 2 } else { sum / all }) as u32;
    for y in 0..to[1] {
        let rows = source_texels(y, height).map(|(y, share)| (&level[y * width as usize..][..width as usize], u64::from(share)));
        for column in &columns {
            let mut sums = [all / 2; 4];
            for (row, below) in rows.iter().filter(|(_, share)| *share > 0) {
                for (x, share) in column.iter().filter(|(_, share)| *share > 0) {
                    let [a, r, g, b] = row[*x].to_be_bytes().map(u32::from);
                    let values = [a, tables.light(r), tables.light(g), tables.light(b)];
                    for (sum, value) in sums.iter_mut().zip(values) {
                        *sum += u64::from(value) * u64::from(*share) * below;
                    }
                }
            }
            let [a, r, g, b] = sums.map(part);
            texels.push(a << 24 | tables.byte(r) << 16 | tables.byte(g) << 8 | tables.byte(b));
        }
    }
    Ok((texels, to[0], to[1]))
}

/// Texels of all levels with their aprons.
fn chain_len(mut width: u32, mut height: u32) -> usize {
    let mut len = 0;
    for _ in 0..LEVELS {
        len += (width + BORDER) as usize * (height + BORDER) as usize;
        if width == 1 && height == 1 {
            break;
        }
        (width, height) = ((width / 2).max(1), (height / 2).max(1));
    }
    len
}

/// Into how many shares a texel's place on the next level is divided along a side.
fn box_weights(side: u32) -> u32 {
    if side == 1 || side.is_multiple_of(2) { 2 } else { side }
}

/// Which texels of a side lie beneath texel `at` of the next level, and with what shares.
fn source_texels(at: u32, side: u32) -> [(usize, u32); 3] {
    let first = at as usize * 2;
    if side == 1 {
        return [(0, 2), (0, 0), (0, 0)];
    }
    if side.is_multiple_of(2) {
        return [(first, 1), (first + 1, 1), (0, 0)];
    }
    let half = side / 2;
    [(first, half - at), (first + 1, half), (first + 2, at + 1)]
}

/// The textures of a renderer: made when first used, kept while they are.
#[derive(Debug, Default)]
pub(super) struct TextureCache {
    entries: Vec<CacheEntry>,
    textures: Vec<Texture>,
    fibers: FiberTexture,
    frame: u64,
}

#[derive(Debug)]
struct CacheEntry {
    key: TextureKey,
    used: u64,
}

/// What a texture was made from.
#[derive(Debug)]
enum TextureKey {
    /// The image is held, so that its address cannot be given to another one while the entry lives.
    Image(Arc<Pixels>, Alpha, [WrapMode; 2]),
    /// Fibres of a colour, and the colour of their ends where these have another.
    Fibers([u8; 3], Option<u32>),
}

impl CacheEntry {
    /// Whether the cache holds the last reference to the image, as after a reload: then it cannot be requested again.
    fn is_orphan(&self) -> bool {
        matches!(&self.key, TextureKey::Image(pixels, ..) if Arc::strong_count(pixels) == 1)
    }
}

/// A texture that was not used for this many frames is dropped.
const MAX_UNUSED_FRAMES: u64 = 240;

impl TextureCache {
    /// Begins a frame: drops textures that were not used for long or cannot be requested any more. Earlier indices become invalid.
    pub(super) fn begin(&mut self) {
        self.frame += 1;
        let mut k = 0;
        while k < self.entries.len() {
            let entry = &self.entries[k];
            if entry.is_orphan() || self.frame - entry.used > MAX_UNUSED_FRAMES {
                self.entries.swap_remove(k);
                self.textures.swap_remove(k);
            } else {
                k += 1;
            }
        }
    }

    /// The index of an image's texture.
    pub(super) fn get(&mut self, pixels: &Arc<Pixels>, alpha: Alpha, wrap: [WrapMode; 2]) -> Result<u32, RenderError> {
        let same = |key: &TextureKey| matches!(key, TextureKey::Image(known, kind, edge) if Arc::ptr_eq(known, pixels) && *kind == alpha && *edge == wrap);
        self.find(same, |_| Ok((TextureKey::Image(Arc::clone(pixels), alpha, wrap), Texture::from_pixels(pixels, alpha, wrap)?)))
    }

    /// The index of the texture of fibres of this colour (0 to 255), whose ends pass into the colour `ends`, `0xRRGGBB`.
    pub(super) fn fibers(&mut self, color: [u8; 3], ends: Option<u32>) -> Result<u32, RenderError> {
        let same = |key: &TextureKey| matches!(key, TextureKey::Fibers(known, end) if *known == color && *end == ends);
        self.find(same, |fibers| Ok((TextureKey::Fibers(color, ends), fibers.texture(color, ends)?)))
    }

    fn find(
        &mut self,
        same: impl Fn(&TextureKey) -> bool,
        make: impl FnOnce(&mut FiberTexture) -> Result<(TextureKey, Texture), RenderError>,
    ) -> Result<u32, RenderError> {
        let index = match self.entries.iter().position(|entry| same(&entry.key)) {
            Some(index) => index,
            None => {
                let (key, texture) = make(&mut self.fibers)?;
                push(&mut self.textures, texture)?;
                push(&mut self.entries, CacheEntry { key, used: 0 })?;
                self.entries.len() - 1
            }
        };
        self.entries[index].used = self.frame;
        Ok(index as u32)
    }

    /// The textures by index.
    pub(super) fn textures(&self) -> &[Texture] {
        &self.textures
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texture_goes_with_the_last_who_has_its_image() {
        let mut cache = TextureCache::default();
        let image = || Arc::new(Pixels { width: 2, height: 2, rgba: vec![255; 16] });
        let kept = image();
        for _ in 0..5 {
            cache.begin();
            // A file that is read again brings another one each time.
            let (read, wrap) = (image(), [WrapMode::Repeat; 2]);
            cache.get(&read, Alpha::Solid, wrap).expect("two texels fit into memory");
            cache.get(&kept, Alpha::Solid, wrap).expect("two texels fit into memory");
            assert!(cache.textures().len() <= 2, "{}", cache.textures().len());
        }
        cache.begin();
        assert_eq!(cache.textures().len(), 1, "that of the image that is kept");
    }
}
