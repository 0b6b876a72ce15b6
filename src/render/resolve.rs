//! From samples to pixels, and into the target.

use super::plane::Plane;

/// The rows of a band in the target.
pub(super) struct Rows<'a> {
    pub bytes: &'a mut [u8],
    pub stride: usize,
}

impl Rows<'_> {
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

/// The finished pixels of row `y` in the columns in use: the only sample, or the average of four in `out`.
pub(super) fn resolve<'a>(plane: &'a Plane, y: usize, out: &'a mut [u32]) -> &'a [u32] {
    if plane.samples == 1 {
        return plane.row(0, y);
    }
    let [a, b, c, d] = [0, 1, 2, 3].map(|s| plane.row(s, y));
    let out = &mut out[..a.len()];
    for ((((to, &a), &b), &c), &d) in out.iter_mut().zip(a).zip(b).zip(c).zip(d) {
        // Two channels at a time, in the even bytes of a word.
        let even = |x: u32| x & 0x00FF_00FF;
        let low = even(a) + even(b) + even(c) + even(d) + 0x0002_0002;
        let high = even(a >> 8) + even(b >> 8) + even(c >> 8) + even(d >> 8) + 0x0002_0002;
        *to = even(low >> 2) | even(high >> 2) << 8;
    }
    out
}

/// Lays the overlay over the picture: fully where it is in front of the surface, with the opacity `behind` where it is not.
pub(super) fn lay_over(plane: &mut Plane, overlay: &Plane, behind: f32) {
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
