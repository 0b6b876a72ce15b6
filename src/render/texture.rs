//! Images as mip chains, and reading them with bilinear filtering.

use std::sync::Arc;

use super::lanes::{Lanes, always};
use super::muscle::Pattern;
use crate::scene::{AlphaSource, Pixels, Wrap};

/// Most levels: enough for [`crate::limits::IMAGE_SIDE`].
const LEVELS: usize = 16;

/// A use of a texture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sampler {
    /// Index in the cache's list.
    pub texture: u32,
    /// Horizontally, vertically.
    pub wrap: [Wrap; 2],
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

/// A mip chain of `0xAARRGGBB` texels, rows from the top.
#[derive(Debug, Default)]
pub(super) struct Texture {
    texels: Vec<u32>,
    offset: [u32; LEVELS],
    width: [u32; LEVELS],
    height: [u32; LEVELS],
    last: u32,
    /// Average colour, 0 to 1.
    pub average: [f32; 3],
}

impl Texture {
    /// The chain of an image.
    pub(super) fn from_pixels(pixels: &Pixels, alpha: Alpha) -> Self {
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
        let mut texels: Vec<u32> = pixels.rgba.chunks_exact(4).take(full).map(texel).collect();
        // An image whose pixels are missing is white where they are.
        texels.resize(full, u32::MAX);
        Self::from_texels(texels, pixels.width, pixels.height)
    }

    /// The chain over a first level of `width` × `height` texels.
    pub(super) fn from_texels(mut texels: Vec<u32>, width: u32, height: u32) -> Self {
        let (mut width, mut height) = (width, height);
        if width == 0 || height == 0 || texels.len() < width as usize * height as usize {
            (texels, width, height) = (vec![u32::MAX], 1, 1);
        }
        let mut chain = Self { texels, ..Self::default() };
        (chain.width[0], chain.height[0]) = (width, height);
        for level in 1..LEVELS {
            let (w, h) = (chain.width[level - 1], chain.height[level - 1]);
            if w == 1 && h == 1 {
                break;
            }
            chain.offset[level] = chain.texels.len() as u32;
            (chain.width[level], chain.height[level]) = ((w / 2).max(1), (h / 2).max(1));
            chain.last = level as u32;
            halve(&mut chain.texels, chain.offset[level - 1] as usize, [w, h], [chain.width[level], chain.height[level]]);
        }
        let end = chain.texels[chain.texels.len() - 1];
        chain.average = [16, 8, 0].map(|shift| (end >> shift & 255) as f32 / 255.0);
        chain
    }

    /// Bilinear texels, each channel 0 to 255 in the order red, green, blue, alpha. `across` and `down` are the changes of (u, v) a pixel to the
    /// right and downward; (0, 0) is the bottom left of the image.
    #[inline(always)]
    pub(super) fn sample<L: Lanes>(&self, l: L, wrap: [Wrap; 2], uv: [L::F; 2], across: [L::F; 2], down: [L::F; 2]) -> [L::F; 4] {
        let (w0, h0) = (l.splat(self.width[0] as f32), l.splat(self.height[0] as f32));
        let size = always!(|d: [L::F; 2]| {
            let (x, y) = (d[0] * w0, d[1] * h0);
            x * x + y * y
        });
        // The nearest level: floor(log2 ρ + ½), read off the exponent of ρ².
        let squared = l.clamp(l.max(size(across), size(down)), 1.0, 1e9);
        let level = l.shr::<1>(l.shr::<23>(l.bits(squared)) - l.isplat(126));
        let last = l.isplat(self.last as i32);
        let level = l.iselect(l.ilt(last, level), last, level);
        let mut first = [0u32; 16];
        l.istore(level, &mut first);
        let same = first[0] as usize & (LEVELS - 1);
        let alike = l.isplat(same as i32);
        let (offset, width, height) = if l.any(l.ilt(level, alike) | l.ilt(alike, level)) {
            (l.gather(&self.offset, level), l.gather(&self.width, level), l.gather(&self.height, level))
        } else {
            (l.isplat(self.offset[same] as i32), l.isplat(self.width[same] as i32), l.isplat(self.height[same] as i32))
        };
        let x = Axis::new(l, wrap[0], uv[0], width);
        let y = Axis::new(l, wrap[1], l.splat(1.0) - uv[1], height);
        let rows = [offset + l.imul(y.texel[0], width), offset + l.imul(y.texel[1], width)];
        let tap = always!(|row: usize, column: usize| l.gather(&self.texels, rows[row] + x.texel[column]));
        let taps = [[tap(0, 0), tap(0, 1)], [tap(1, 0), tap(1, 1)]];
        let byte = l.isplat(255);
        let channel = always!(|which: usize| {
            let pick = always!(|t: L::I| match which {
                0 => l.shr::<16>(t),
                1 => l.shr::<8>(t),
                2 => t,
                _ => l.shr::<24>(t),
            });
            let value = always!(|row: usize, column: usize| l.float(pick(taps[row][column]) & byte));
            let upper = value(0, 0) * x.weight[0] + value(0, 1) * x.weight[1];
            let lower = value(1, 0) * x.weight[0] + value(1, 1) * x.weight[1];
            upper * y.weight[0] + lower * y.weight[1]
        });
        [channel(0), channel(1), channel(2), channel(3)]
    }
}

/// The two texels along one axis that a coordinate lies between, and their shares.
struct Axis<L: Lanes> {
    texel: [L::I; 2],
    weight: [L::F; 2],
}

impl<L: Lanes> Axis<L> {
    #[inline(always)]
    fn new(l: L, wrap: Wrap, coordinate: L::F, size: L::I) -> Self {
        let (zero, one) = (l.splat(0.0), l.splat(1.0));
        // The order of the comparison turns NaN into the bound.
        let coordinate = l.clamp(coordinate, -1e6, 1e6);
        let length = l.float(size);
        let within = match wrap {
            Wrap::Repeat => coordinate - l.floor(coordinate),
            Wrap::Mirror => {
                let two = coordinate - l.splat(2.0) * l.floor(coordinate * l.splat(0.5));
                l.min(two, l.splat(2.0) - two)
            }
            Wrap::Clamp => l.clamp(coordinate, 0.0, 1.0),
            Wrap::Border => l.clamp(coordinate, -1.0, 2.0),
        };
        let position = within * length - l.splat(0.5);
        let below = l.floor(position);
        let share = position - below;
        let mut texel = [l.trunc(below), l.trunc(below) + l.isplat(1)];
        let mut weight = [one - share, share];
        let end = size - l.isplat(1);
        for (texel, weight) in texel.iter_mut().zip(&mut weight) {
            let (before, beyond) = (l.negative(*texel), l.ilt(end, *texel));
            let (low, high) = if matches!(wrap, Wrap::Repeat) { (end, l.isplat(0)) } else { (l.isplat(0), end) };
            if matches!(wrap, Wrap::Border) {
                *weight = l.select(before | beyond, zero, *weight);
            }
            *texel = l.iselect(before, low, l.iselect(beyond, high, *texel));
        }
        Self { texel, weight }
    }
}

/// Appends a level of size `to` made by averaging the level of size `from` that starts at `at`.
fn halve(texels: &mut Vec<u32>, at: usize, from: [u32; 2], to: [u32; 2]) {
    for y in 0..to[1] {
        for x in 0..to[0] {
            let mut sum = [0u32; 4];
            for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let (sx, sy) = ((x * 2 + dx).min(from[0] - 1), (y * 2 + dy).min(from[1] - 1));
                let texel = texels[at + sy as usize * from[0] as usize + sx as usize];
                for (sum, byte) in sum.iter_mut().zip(texel.to_be_bytes()) {
                    *sum += u32::from(byte);
                }
            }
            texels.push(u32::from_be_bytes(sum.map(|s| ((s + 2) / 4) as u8)));
        }
    }
}

/// The textures of a renderer: made when first used, kept while they are.
#[derive(Debug, Default)]
pub(super) struct Cache {
    entries: Vec<Entry>,
    textures: Vec<Texture>,
    fibres: Pattern,
    frame: u64,
}

#[derive(Debug)]
struct Entry {
    key: Key,
    used: u64,
}

/// What a texture was made from.
#[derive(Debug)]
enum Key {
    /// The image is held, so that its address cannot be given to another one while the entry lives.
    Image(Arc<Pixels>, Alpha),
    /// Muscle fibres of a colour, with or without tendons.
    Muscle([u8; 3], bool),
}

/// A texture that was not used for this many frames is dropped.
const PATIENCE: u64 = 240;

impl Cache {
    /// Begins a frame: forgets what has long not been used. Indices handed out before are void.
    pub(super) fn begin(&mut self) {
        self.frame += 1;
        let mut k = 0;
        while k < self.entries.len() {
            if self.frame - self.entries[k].used > PATIENCE {
                self.entries.swap_remove(k);
                self.textures.swap_remove(k);
            } else {
                k += 1;
            }
        }
    }

    /// The index of an image's texture.
    pub(super) fn get(&mut self, pixels: &Arc<Pixels>, alpha: Alpha) -> u32 {
        let same = |key: &Key| matches!(key, Key::Image(known, kind) if Arc::ptr_eq(known, pixels) && *kind == alpha);
        self.find(same, |_| (Key::Image(Arc::clone(pixels), alpha), Texture::from_pixels(pixels, alpha)))
    }

    /// The index of the fibres of a muscle.
    pub(super) fn muscle(&mut self, color: [u8; 3], tendon: bool) -> u32 {
        let same = |key: &Key| matches!(key, Key::Muscle(known, end) if *known == color && *end == tendon);
        self.find(same, |fibres| (Key::Muscle(color, tendon), fibres.texture(color, tendon)))
    }

    fn find(&mut self, same: impl Fn(&Key) -> bool, make: impl FnOnce(&mut Pattern) -> (Key, Texture)) -> u32 {
        let index = self.entries.iter().position(|entry| same(&entry.key)).unwrap_or_else(|| {
            let (key, texture) = make(&mut self.fibres);
            self.entries.push(Entry { key, used: 0 });
            self.textures.push(texture);
            self.entries.len() - 1
        });
        self.entries[index].used = self.frame;
        index as u32
    }

    /// The textures by index.
    pub(super) fn textures(&self) -> &[Texture] {
        &self.textures
    }
}
