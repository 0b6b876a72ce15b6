//! Few colours for many: a palette of at most 255 for a whole animation, and ordered dithering that does not crawl from frame to frame.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU16, Ordering};

use color_quant::NeuQuant;

use super::png::rgb;
use sinew_render::{Framebuffer, RenderError};

/// Most colours of a palette; one more index is kept for transparency.
pub const COLORS: usize = 255;

/// About how many pixels the palette is made from.
const SAMPLES: usize = 200_000;

/// Colours that cover at least this part of the samples stand in the palette as they are.
const EXACT_SHARE: f64 = 0.005;

/// How far dithering moves a channel, up and down: about half the distance of neighbouring palette colours in a lit scene.
const AMPLITUDE: i32 = 6;

/// Squared distance up to which a palette colour is taken without dithering, so that plain areas stay plain.
const NEAR: i32 = 8;

/// Cells of the table of nearest colours: six bits a channel.
const CELLS: usize = 1 << 18;
/// Stands in that table for a cell that was not asked for yet; indices are below.
const UNKNOWN: u16 = u16::MAX;

/// Collects colours from pictures.
#[derive(Debug, Clone)]
pub struct ColorSampler {
    colors: Vec<[u8; 3]>,
    a_picture: usize,
}

impl ColorSampler {
    /// For about this many pictures.
    pub fn new(pictures: usize) -> Self {
        Self { colors: Vec::new(), a_picture: (SAMPLES / pictures.max(1)).max(1) }
    }

    /// Takes colours spread over `picture`; transparent pixels count for nothing.
    pub fn add(&mut self, picture: &Framebuffer) {
        let step = (picture.pixels.len() / self.a_picture).max(1);
        // A step that shares a factor with the width would see the same columns only.
        let step = if step > 1 && (picture.width as usize).is_multiple_of(step) { step + 1 } else { step };
        self.colors.extend(picture.pixels.iter().step_by(step).filter(|pixel| is_solid(**pixel)).map(|pixel| rgb(*pixel)));
    }

    /// The palette of all that was added.
    ///
    /// # Errors
    /// [`RenderError::OutOfMemory`] where the system gives no memory for its table.
    pub fn color_table(self) -> Result<ColorTable, RenderError> {
        let mut counts: HashMap<[u8; 3], usize> = HashMap::new();
        for color in &self.colors {
            *counts.entry(*color).or_default() += 1;
        }
        let mut ordered: Vec<_> = counts.into_iter().collect();
        // Most frequent first, and the same order on every run.
        ordered.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        let exact = if ordered.len() <= COLORS {
            ordered.len()
        } else {
            let enough = (self.colors.len() as f64 * EXACT_SHARE).max(1.0);
            ordered.iter().take(COLORS / 4).take_while(|(_, count)| *count as f64 >= enough).count()
        };
        let mut colors: Vec<[u8; 3]> = ordered.iter().take(exact).map(|(color, _)| *color).collect();
        if exact < ordered.len() {
            let pixels: Vec<u8> = self.colors.iter().flat_map(|[r, g, b]| [*r, *g, *b, 255]).collect();
            let quantiser = NeuQuant::new(3, COLORS - exact, &pixels);
            colors.extend(quantiser.color_map_rgb().chunks_exact(3).filter_map(|c| <[u8; 3]>::try_from(c).ok()));
        }
        colors.dedup();
        colors.truncate(COLORS);
        ColorTable::of(colors)
    }
}

/// Whether a pixel of a format without half transparency is drawn.
pub fn is_solid(pixel: u32) -> bool {
    pixel >> 24 >= 128
}

/// At most 255 colours, with a table that finds the nearest. Threads share it: what one has found, the others know.
#[derive(Debug)]
pub struct ColorTable {
    colors: Vec<[u8; 3]>,
    /// Index of the nearest colour for each cell of 4 × 4 × 4 colours, [`UNKNOWN`] until it is asked for. Whoever finds it first, it is the same.
    nearest: Vec<AtomicU16>,
}

impl ColorTable {
    fn of(mut colors: Vec<[u8; 3]>) -> Result<Self, RenderError> {
        if colors.is_empty() {
            colors.push([0; 3]);
        }
        let mut nearest = Vec::new();
        nearest.try_reserve_exact(CELLS)?;
        nearest.resize_with(CELLS, || AtomicU16::new(UNKNOWN));
        Ok(Self { colors, nearest })
    }

    /// The colours as a row of red, green, blue.
    pub fn bytes(&self) -> Vec<u8> {
        self.colors.concat()
    }

    /// The index that stands for `color` at column `x` and row `y`.
    pub fn index(&self, color: [u8; 3], x: usize, y: usize) -> u8 {
        let plain = self.lookup(color);
        if self.distance(plain, color) <= NEAR {
            return plain;
        }
        let shift = (threshold(x, y) * 2 - 63) * AMPLITUDE / 64;
        self.lookup(color.map(|channel| (i32::from(channel) + shift).clamp(0, 255) as u8))
    }

    fn lookup(&self, color: [u8; 3]) -> u8 {
        let [r, g, b] = color.map(|channel| usize::from(channel >> 2));
        let cell = r << 12 | g << 6 | b;
        // Three times six bits are always within the table.
        let Some(nearest) = self.nearest.get(cell) else { return 0 };
        if let Ok(known) = u8::try_from(nearest.load(Ordering::Relaxed)) {
            return known;
        }
        // The middle of the cell stands for all of it.
        let middle = color.map(|channel| channel & !3 | 2);
        let found = (0..self.colors.len() as u32).min_by_key(|i| self.distance(*i as u8, middle)).unwrap_or(0) as u8;
        nearest.store(found.into(), Ordering::Relaxed);
        found
    }

    fn distance(&self, index: u8, color: [u8; 3]) -> i32 {
        let near = self.colors.get(usize::from(index)).copied().unwrap_or_default();
        near.iter().zip(color).map(|(a, b)| (i32::from(*a) - i32::from(b)).pow(2)).sum()
    }
}

/// Bayer's matrix of 8 × 8: each number from 0 to 63 once, neighbours far apart. Bits of x ⊕ y and y, interleaved in reverse.
fn threshold(x: usize, y: usize) -> i32 {
    let (a, b) = (x ^ y, y);
    (0..3).fold(0, |value, bit| value << 2 | ((a >> bit & 1) << 1 | (b >> bit & 1)) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds_are_each_number_once() {
        let mut seen: Vec<i32> = (0..64).map(|i| threshold(i % 8, i / 8)).collect();
        seen.sort_unstable();
        assert_eq!(seen, (0..64).collect::<Vec<_>>());
    }

    #[test]
    fn few_colours_stay_exact() {
        let mut sampler = ColorSampler::new(1);
        sampler.add(&Framebuffer { width: 3, height: 1, pixels: vec![0xFF010203, 0xFFFFFFFF, 0x00000000] });
        let palette = sampler.color_table().expect("there is memory");
        assert_eq!(palette.bytes().len(), 6);
        for color in [[1, 2, 3], [255, 255, 255]] {
            let index = usize::from(palette.index(color, 5, 3));
            assert_eq!(palette.colors[index], color);
        }
    }

    #[test]
    fn a_gradient_stays_close() {
        let pixels: Vec<u32> = (0..65_536_u32).map(|i| 0xFF00_0000 | (i & 255) << 16 | (i >> 8) << 8 | 64).collect();
        let picture = Framebuffer { width: 256, height: 256, pixels };
        let mut sampler = ColorSampler::new(1);
        sampler.add(&picture);
        let palette = sampler.color_table().expect("there is memory");
        let (mut error, mut worst) = ([0_i64; 3], 0);
        for (i, pixel) in picture.pixels.iter().enumerate() {
            let color = rgb(*pixel);
            let index = palette.index(color, i % 256, i / 256);
            worst = worst.max(palette.distance(index, color));
            for (sum, (a, b)) in error.iter_mut().zip(palette.colors[usize::from(index)].iter().zip(color)) {
                *sum += i64::from(*a) - i64::from(b);
            }
        }
        assert!(worst < 40 * 40, "{worst}");
        assert!(error.iter().all(|sum| sum.abs() < 2 * 65_536), "{error:?}");
    }
}
