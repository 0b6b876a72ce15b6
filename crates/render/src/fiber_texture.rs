//! Procedural texture of fibres along v, whose ends may pass into another colour.
//!
//! The mesh brings u round the bundle and v along it, so fibres that are straight in the texture follow its rings, close in where it is thin and spread
//! where it bulges. A texture, not a formula at each pixel: its mip chain keeps distant fibres from glittering.

use super::RenderError;
use super::memory::collect;
use super::texture::Texture;
use sinew_scene::WrapMode;

/// Size of the pattern: fine across the fibres, coarse along them.
const WIDTH: u32 = 2048;
const HEIGHT: u32 = 128;

/// Round and round, but not from one end to the other.
pub(super) const WRAP: [WrapMode; 2] = [WrapMode::Repeat, WrapMode::Clamp];

/// The pattern without colour: how light the fibre is, and how much of it has the colour of the ends.
#[derive(Debug, Default)]
pub(super) struct FiberTexture {
    texels: Vec<(f32, f32)>,
}

/// A number from 0 to 1 that looks random.
fn hash(x: i32, y: i32, seed: u32) -> f32 {
    let mut h = (x as u32).wrapping_mul(0x9E37_79B1) ^ (y as u32).wrapping_mul(0x85EB_CA77) ^ seed.wrapping_mul(0xC2B2_AE3D);
    h = (h ^ (h >> 15)).wrapping_mul(0x2C1B_3C6D);
    h = (h ^ (h >> 12)).wrapping_mul(0x297A_2D39);
    (h ^ (h >> 15)) as f32 / u32::MAX as f32
}

/// Smooth noise from 0 to 1, periodic in x.
fn noise(x: f32, y: f32, period: i32, seed: u32) -> f32 {
    let (fx, fy) = (x.floor(), y.floor());
    let smooth = |t: f32| t * t * (3.0 - 2.0 * t);
    let (tx, ty) = (smooth(x - fx), smooth(y - fy));
    let at = |dx: i32, dy: i32| hash((fx as i32 + dx).rem_euclid(period), fy as i32 + dy, seed);
    let upper = at(0, 0) + (at(1, 0) - at(0, 0)) * tx;
    let lower = at(0, 1) + (at(1, 1) - at(0, 1)) * tx;
    upper + (lower - upper) * ty
}

fn step(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl FiberTexture {
    fn new() -> Result<Self, RenderError> {
        let texel = |i: u32| {
            let (u, v) = ((i % WIDTH) as f32 / WIDTH as f32, (i / WIDTH) as f32 / (HEIGHT - 1) as f32);
            // Fibres wander a little, whole bundles together.
            let wander = (noise(u * 6.0, v * 3.0, 6, 1) - 0.5) * 0.035;
            let x = u + wander;
            // Bundles with dark furrows between them, fibres in the bundles, and the finest grain.
            let bundle = (noise(x * 30.0, v * 1.6, 30, 2) - 0.5).abs() * 2.0;
            let furrow = 1.0 - step(0.0, 0.34, bundle);
            let fibre = noise(x * 96.0, v * 2.2, 96, 3);
            let grain = noise(x * 240.0, v * 4.0, 240, 4);
            let light = 1.22 - 0.20 * furrow - 0.26 * (1.0 - fibre) - 0.13 * (1.0 - grain);
            // The end reaches between the bundles in tongues.
            let tongue = 0.05 + 0.10 * noise(x * 30.0, 0.0, 30, 5);
            let end = v.min(1.0 - v);
            let end_share = 1.0 - step(tongue * 0.35, tongue * 1.25, end);
            (light, end_share)
        };
        Ok(Self { texels: collect((0..WIDTH * HEIGHT).map(texel))? })
    }

    /// The texture of fibres of this colour (0 to 255), whose ends pass into the colour `ends`, `0xRRGGBB`.
    pub(super) fn texture(&mut self, color: [u8; 3], ends: Option<u32>) -> Result<Texture, RenderError> {
        if self.texels.is_empty() {
            *self = Self::new()?;
        }
        let end_color = [16, 8, 0].map(|shift| (ends.unwrap_or(0) >> shift & 255) as f32);
        let paint = |&(light, share): &(f32, f32)| {
            let share = if ends.is_some() { share } else { 0.0 };
            // Towards the ends the fibres are fainter.
            let shade = light + (0.5 + 0.5 * light - light) * share;
            let channel = |i: usize| {
                let base = f32::from(color[i]);
                // Furrows are darker and a little more saturated than a mere shadow.
                let deep = if i == 0 { shade } else { shade * (0.6 + 0.4 * shade) };
                let fiber_color = base * deep;
                let out = fiber_color + (end_color[i] * (0.25 + 0.75 * shade) - fiber_color) * share;
                out.clamp(0.0, 255.0) as u32
            };
            0xFF00_0000 | channel(0) << 16 | channel(1) << 8 | channel(2)
        };
        // Row 0 of a texture is the top, v = 1.
        let rows = self.texels.chunks(WIDTH as usize).rev();
        let mut texels = Vec::new();
        texels.try_reserve_exact(self.texels.len())?;
        texels.extend(rows.flatten().map(paint));
        Texture::from_texels(texels, WIDTH, HEIGHT, WRAP)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pattern_closes_round_the_bundle() {
        let pattern = FiberTexture::new().expect("there is memory for it");
        for row in pattern.texels.chunks(WIDTH as usize) {
            let (first, last) = (row[0].0, row[WIDTH as usize - 1].0);
            assert!((first - last).abs() < 0.12, "a seam: {first} beside {last}");
        }
    }
}
