//! The background of the picture.

use super::Background;

/// The background, ready to be written row by row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BackgroundRows {
    kind: Background,
    height: u32,
}

/// Thresholds of an 8 × 8 ordered dither, from 0 to 63.
const BAYER: [[u8; 8]; 8] = bayer();

const fn bayer() -> [[u8; 8]; 8] {
    let mut matrix = [[0; 8]; 8];
    let mut y = 0;
    while y < 8 {
        let mut x = 0;
        while x < 8 {
            // Bits of x ^ y and y, interleaved and reversed.
            let (a, b) = (x ^ y, y);
            let mut value = 0;
            let mut bit = 0;
            while bit < 3 {
                value |= ((a >> bit & 1) << (5 - 2 * bit)) | ((b >> bit & 1) << (4 - 2 * bit));
                bit += 1;
            }
            matrix[y][x] = value as u8;
            x += 1;
        }
        y += 1;
    }
    matrix
}

impl BackgroundRows {
    pub(super) fn new(kind: Background, height: u32) -> Self {
        Self { kind, height }
    }

    /// Whether all rows look alike.
    pub(super) fn is_uniform(&self) -> bool {
        !matches!(self.kind, Background::Gradient(..))
    }

    /// Writes picture row `y`. A gradient over hundreds of rows has fewer steps than rows, so it is dithered lest it show bands.
    pub(super) fn row(&self, y: i32, out: &mut [u32]) {
        match self.kind {
            Background::Transparent => out.fill(0),
            Background::Solid(color) => out.fill(0xFF00_0000 | color),
            Background::Gradient(top, bottom) => {
                // Colours with 16 bits of fraction, in whole numbers: eight thresholds side by side are a matter of a few instructions.
                let (at, end) = (2 * i64::from(y) + 1, 2 * i64::from(self.height.max(1)));
                let channels = [16, 8, 0].map(|shift| {
                    let [from, to] = [top, bottom].map(|color| i64::from(color >> shift & 255));
                    (((from * end + (to - from) * at) << 16) / end) as u32
                });
                let pattern = BAYER[y as usize & 7].map(|threshold| {
                    let threshold = (2 * u32::from(threshold) + 1) << 9;
                    let [red, green, blue] = channels.map(|channel| (channel + threshold) >> 16);
                    0xFF00_0000 | red << 16 | green << 8 | blue
                });
                let (whole, rest) = out.as_chunks_mut::<8>();
                whole.fill(pattern);
                rest.copy_from_slice(&pattern[..rest.len()]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_threshold_stands_once() {
        let mut all: Vec<u8> = BAYER.concat();
        all.sort_unstable();
        assert_eq!(all, (0..64).collect::<Vec<u8>>());
    }

    #[test]
    fn a_gradient_runs_from_its_first_to_its_last_colour() {
        let background_rows = BackgroundRows::new(Background::Gradient(0x102030, 0x405060), 100);
        let mut row = [0; 13];
        background_rows.row(0, &mut row);
        assert!(row.iter().all(|p| (p >> 16 & 255).abs_diff(0x10) <= 1), "{row:x?}");
        background_rows.row(99, &mut row);
        assert!(row.iter().all(|p| (p & 255).abs_diff(0x60) <= 1), "{row:x?}");
    }
}
