//! A picture that is filled row by row, smaller than what comes in where it has to be.

use std::sync::LazyLock;

use sinew_scene::Pixels;

/// What one channel of a pixel takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BitDepth {
    /// One byte.
    Byte,
    /// Two bytes, the higher first.
    Big,
    /// Two bytes as the machine has them.
    Native,
    /// Four bytes, 0 to 1.
    Float,
}

/// How the bytes of a row hold its pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct PixelFormat {
    /// 1 and 2: grey, without and with alpha; 3 and 4: red, green, blue, without and with alpha.
    pub channels: usize,
    /// What a channel takes.
    pub depth: BitDepth,
}

impl PixelFormat {
    fn bytes(self) -> usize {
        self.channels
            * match self.depth {
                BitDepth::Byte => 1,
                BitDepth::Big | BitDepth::Native => 2,
                BitDepth::Float => 4,
            }
    }

    /// The channel `k` of a pixel, 0 to 255.
    fn channel(self, pixel: &[u8], k: usize) -> u8 {
        let pair = || pixel.get(2 * k..).and_then(|rest| rest.first_chunk::<2>()).copied().unwrap_or_default();
        let narrow = |wide: u16| ((u32::from(wide) + 128) / 257) as u8;
        match self.depth {
            BitDepth::Byte => pixel.get(k).copied().unwrap_or_default(),
            BitDepth::Big => narrow(u16::from_be_bytes(pair())),
            BitDepth::Native => narrow(u16::from_ne_bytes(pair())),
            BitDepth::Float => {
                let four = pixel.get(4 * k..).and_then(|rest| rest.first_chunk::<4>()).copied().unwrap_or_default();
                (f32::from_ne_bytes(four).clamp(0.0, 1.0) * 255.0).round() as u8
            }
        }
    }

    fn pixel(self, pixel: &[u8]) -> [u8; 4] {
        let at = |k| self.channel(pixel, k);
        match self.channels {
            1 => [at(0), at(0), at(0), 255],
            2 => [at(0), at(0), at(0), at(1)],
            3 => [at(0), at(1), at(2), 255],
            _ => [at(0), at(1), at(2), at(3)],
        }
    }
}

/// Light of each sRGB value (IEC 61966-2-1), 0 to 1.
static LIGHT: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|value| {
        let value = value as f32 / 255.0;
        if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
    })
});

/// The sRGB value of light from 0 to 1.
fn value(light: f32) -> u8 {
    let value = if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    (value * 255.0 + 0.5) as u8
}

/// A picture on its way.
pub(super) struct ScaledImage {
    from: [u32; 2],
    to: [u32; 2],
    rgba: Vec<u8>,
    /// For each column that comes in the one that it falls into; empty where the size stays.
    columns: Vec<u32>,
    /// Light and alpha of the row that is being filled, and how many pixels fell into it.
    sums: Vec<([f32; 4], u32)>,
    /// Rows that came in.
    rows: u32,
}

impl ScaledImage {
    /// Room for a picture of size `to`, made from one of size `from`, which is no smaller. `None` where the system gives no memory.
    pub(super) fn new(from: [u32; 2], to: [u32; 2]) -> Option<Self> {
        let to = [to[0].clamp(1, from[0].max(1)), to[1].clamp(1, from[1].max(1))];
        let mut rgba = Vec::new();
        rgba.try_reserve_exact(usize::try_from(u64::from(to[0]) * u64::from(to[1]) * 4).ok()?).ok()?;
        let column = |x: u32| (u64::from(x) * u64::from(to[0]) / u64::from(from[0].max(1))) as u32;
        let (columns, sums) =
            if from == to { Default::default() } else { ((0..from[0]).map(column).collect(), vec![([0.0; 4], 0); to[0] as usize]) };
        Some(Self { from, to, rgba, columns, sums, rows: 0 })
    }

    /// Takes one or more whole rows.
    pub(super) fn rows(&mut self, bytes: &[u8], layout: PixelFormat) {
        for row in bytes.chunks_exact(layout.bytes() * self.from[0] as usize) {
            if self.rows == self.from[1] {
                return;
            }
            let pixels = row.chunks_exact(layout.bytes());
            if self.from == self.to {
                if layout.channels == 4 && layout.depth == BitDepth::Byte {
                    self.rgba.extend_from_slice(row);
                } else {
                    pixels.for_each(|pixel| self.rgba.extend_from_slice(&layout.pixel(pixel)));
                }
                self.rows += 1;
            } else {
                self.add(pixels.map(|pixel| layout.pixel(pixel)));
            }
        }
    }

    fn add(&mut self, pixels: impl Iterator<Item = [u8; 4]>) {
        for ([red, green, blue, alpha], column) in pixels.zip(&self.columns) {
            let Some((sum, count)) = self.sums.get_mut(*column as usize) else { continue };
            for (sum, value) in sum.iter_mut().zip([red, green, blue]) {
                *sum += LIGHT.get(usize::from(value)).copied().unwrap_or_default();
            }
            sum[3] += f32::from(alpha);
            *count += 1;
        }
        let row = |rows: u32| u64::from(rows) * u64::from(self.to[1]) / u64::from(self.from[1]);
        let before = row(self.rows);
        self.rows += 1;
        if row(self.rows) == before {
            return;
        }
        for (sum, count) in &mut self.sums {
            let share = 1.0 / *count as f32;
            let [red, green, blue] = [sum[0], sum[1], sum[2]].map(|light| value(light * share));
            self.rgba.extend_from_slice(&[red, green, blue, (sum[3] * share + 0.5) as u8]);
            (*sum, *count) = ([0.0; 4], 0);
        }
    }

    /// The picture; `None` where rows are missing.
    pub(super) fn finish(self) -> Option<Pixels> {
        (self.rows == self.from[1]).then_some(Pixels { width: self.to[0], height: self.to[1], rgba: self.rgba })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RGB: PixelFormat = PixelFormat { channels: 3, depth: BitDepth::Byte };

    #[test]
    fn a_chequered_picture_becomes_the_mean_of_its_light() {
        let bytes: Vec<u8> = (0..64).flat_map(|i| [if (i + i / 8) % 2 == 0 { 0 } else { 255 }; 3]).collect();
        let mut canvas = ScaledImage::new([8, 8], [4, 4]).expect("memory");
        canvas.rows(&bytes, RGB);
        let small = canvas.finish().expect("all rows");
        assert_eq!(small.rgba, [188, 188, 188, 255].repeat(16));
    }

    proptest::proptest! {
        /// Whatever the sizes, an even colour stays what it is and every pixel of the smaller picture is filled.
        #[test]
        fn an_even_colour_stays(from in [1_u32..40, 1_u32..40], part in [1_u32..40, 1_u32..40], color in [0_u8..=255, 0_u8..=255, 0_u8..=255, 0_u8..=255]) {
            let to = [part[0].min(from[0]), part[1].min(from[1])];
            let mut canvas = ScaledImage::new(from, to).expect("memory");
            canvas.rows(&color.repeat((from[0] * from[1]) as usize), PixelFormat { channels: 4, depth: BitDepth::Byte });
            let small = canvas.finish().expect("all rows");
            proptest::prop_assert_eq!(small.rgba, color.repeat((to[0] * to[1]) as usize));
        }
    }

    #[test]
    fn a_picture_that_lacks_rows_is_none() {
        let mut canvas = ScaledImage::new([2, 2], [1, 1]).expect("memory");
        canvas.rows(&[0; 6], RGB);
        assert!(canvas.finish().is_none());
    }
}
