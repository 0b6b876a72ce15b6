//! Resolves samples to pixels and writes them to the target.

use super::srgb::Srgb;
use super::tile_buffer::BandBuffer;

/// The rows of a band in the target.
pub(super) struct SampleRows<'a> {
    pub bytes: &'a mut [u8],
    pub stride: usize,
}

impl SampleRows<'_> {
    /// Row `y` of the band; empty where the target ends earlier.
    pub(super) fn row(&mut self, y: usize) -> &mut [u8] {
        let from = (y * self.stride).min(self.bytes.len());
        let to = (from + self.stride).min(self.bytes.len());
        &mut self.bytes[from..to]
    }
}

/// Writes pixels in native byte order into a row, from column `from` on; those that do not fit are left out.
pub(super) fn copy_row(pixels: &[u32], to: &mut [u8], from: usize) {
    let to = to.get_mut(from * 4..).unwrap_or_default();
    let bytes: &[u8] = bytemuck::cast_slice(pixels);
    let n = bytes.len().min(to.len() / 4 * 4);
    to[..n].copy_from_slice(&bytes[..n]);
}

/// Samples no further apart than this are averaged as bytes: the light between them differs from that by a fifth of a byte at most.
const ALIKE: u8 = 4;
/// Pixels that are looked at together: all their bytes at once, which vectors of any kind do in a few steps.
const GROUP: usize = 8;

/// The finished pixels of row `y` in the columns in use: the only sample, or in `out` the colour of the four samples' light together.
pub(super) fn resolve<'a>(plane: &'a BandBuffer, y: usize, out: &'a mut [u32]) -> &'a [u32] {
    if plane.samples == 1 {
        return plane.row(0, y);
    }
    let rows = [0, 1, 2, 3].map(|s| plane.row(s, y));
    let out = &mut out[..rows[0].len()];
    let tables = Srgb::tables();
    let [(a, a_rest), (b, b_rest), (c, c_rest), (d, d_rest)] = rows.map(|row| row.as_chunks::<GROUP>());
    let (groups, rest) = out.as_chunks_mut::<GROUP>();
    for ((((to, a), b), c), d) in groups.iter_mut().zip(a).zip(b).zip(c).zip(d) {
        if apart(a, b, c, d) <= ALIKE {
            for k in 0..GROUP {
                to[k] = mean_of_bytes([a[k], b[k], c[k], d[k]]);
            }
        } else {
            for k in 0..GROUP {
                to[k] = one(tables, [a[k], b[k], c[k], d[k]]);
            }
        }
    }
    for ((((to, &a), &b), &c), &d) in rest.iter_mut().zip(a_rest).zip(b_rest).zip(c_rest).zip(d_rest) {
        *to = one(tables, [a, b, c, d]);
    }
    out
}

/// The furthest that any byte of a group is from the same byte of another sample.
#[inline(always)]
fn apart(a: &[u32; GROUP], b: &[u32; GROUP], c: &[u32; GROUP], d: &[u32; GROUP]) -> u8 {
    let [a, b, c, d]: [&[u8; GROUP * 4]; 4] = [a, b, c, d].map(bytemuck::cast_ref);
    let mut most = 0;
    for k in 0..GROUP * 4 {
        most = most.max(a[k].max(b[k]).max(c[k].max(d[k])) - a[k].min(b[k]).min(c[k].min(d[k])));
    }
    most
}

/// One pixel, by the same rule as a group: what a pixel becomes must not depend on where a row begins.
fn one(tables: &Srgb, samples: [u32; 4]) -> u32 {
    let bytes = samples.map(u32::to_ne_bytes);
    let apart = |k: usize| {
        let [a, b, c, d] = [bytes[0][k], bytes[1][k], bytes[2][k], bytes[3][k]];
        a.max(b).max(c.max(d)) - a.min(b).min(c.min(d))
    };
    let most = apart(0).max(apart(1)).max(apart(2).max(apart(3)));
    if most <= ALIKE { mean_of_bytes(samples) } else { together(tables, samples) }
}

/// Two channels at a time, in the even bytes of a word.
#[inline(always)]
fn mean_of_bytes(samples: [u32; 4]) -> u32 {
    let (mut low, mut high) = (0x0002_0002, 0x0002_0002);
    for sample in samples {
        low += sample & 0x00FF_00FF;
        high += (sample >> 8) & 0x00FF_00FF;
    }
    ((low >> 2) & 0x00FF_00FF) | ((high >> 2) & 0x00FF_00FF) << 8
}

/// The colour that sends out as much light as four samples do together. Where some are not opaque, their share counts, and the colour is
/// that of what is there: the rim of a figure on nothing keeps the figure's colour.
fn together(tables: &Srgb, samples: [u32; 4]) -> u32 {
    let channel = |sample: u32, shift: u32| sample >> shift & 255;
    if samples.iter().fold(u32::MAX, |all, sample| all & sample) >> 24 == 255 {
        let mean =
            |shift: u32| tables.byte((samples.iter().map(|sample| tables.light(channel(*sample, shift))).sum::<u32>() + 2) / 4) << shift;
        return 0xFF00_0000 | mean(16) | mean(8) | mean(0);
    }
    let shares: u32 = samples.iter().map(|sample| sample >> 24).sum();
    if shares == 0 {
        return 0;
    }
    let opacity = (shares + 2) / 4;
    let mean = |shift: u32| {
        let light = |sample: &u32| {
            let share = sample >> 24;
            // Premultiplied: the colour itself is more, where there is any.
            let color = (channel(*sample, shift) * 255 + share / 2).checked_div(share).unwrap_or(0).min(255);
            tables.light(color) * share
        };
        let color = tables.byte((samples.iter().map(light).sum::<u32>() + shares / 2) / shares);
        ((color * opacity + 127) / 255) << shift
    };
    opacity << 24 | mean(16) | mean(8) | mean(0)
}

/// Lays the overlay over the picture: fully where it is in front of the surface, with the opacity `behind` where it is not.
pub(super) fn lay_over(plane: &mut BandBuffer, overlay: &BandBuffer, behind: f32) {
    for s in 0..plane.samples {
        for y in 0..plane.rows {
            let (colors, depths) = (overlay.row(s, y), overlay.depth_row(s, y));
            let (row, under) = plane.row_and_depth(s, y);
            for (((to, under), &color), &depth) in row.iter_mut().zip(under).zip(colors).zip(depths) {
                if color == 0 {
                    continue;
                }
                let share = if depth >= *under { 1.0 } else { behind };
                let keep = 1.0 - (color >> 24) as f32 * share / 255.0;
                let channel = |shift: u32| {
                    let [new, old] = [color, *to].map(|pixel| (pixel >> shift & 255) as f32);
                    ((new * share + old * keep + 0.5) as u32).min(255) << shift
                };
                *to = channel(24) | channel(16) | channel(8) | channel(0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_averaged_as_light() {
        let tables = Srgb::tables();
        let (black, white) = (0xFF00_0000, 0xFFFF_FFFF);
        let grey = |samples| together(tables, samples) & 255;
        assert_eq!(
            [grey([black, black, black, white]), grey([black, white, white, black]), grey([white, white, black, white])],
            [137, 188, 225]
        );
        // A rim on nothing keeps its colour, a glass before nothing too.
        assert_eq!(together(tables, [0, 0xFF20_4060, 0, 0]), 0x4008_1018);
        assert_eq!(together(tables, [0x8010_2030, 0x8010_2030, 0, 0]), 0x4008_1018);
        assert_eq!(together(tables, [0; 4]), 0);
    }

    #[test]
    fn samples_that_are_alike_may_be_averaged_as_bytes() {
        let tables = Srgb::tables();
        for low in 0..=251u32 {
            for [b, c, d] in [[4, 4, 0], [4, 0, 0], [4, 4, 4], [2, 4, 1]] {
                let samples = [low, low + b, low + c, low + d].map(|byte| 0xFF00_0000 | byte << 16 | byte << 8 | byte);
                let [bytes, light] = [mean_of_bytes(samples), together(tables, samples)].map(|pixel| pixel & 255);
                assert!(bytes.abs_diff(light) <= 1, "{low} {b} {c} {d}: {bytes}, {light}");
            }
        }
    }
}
