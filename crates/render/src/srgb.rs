//! Bytes of colour and the light that they stand for (IEC 61966-2-1): averages are taken of light, since half of white's light is not half of its byte.

use std::sync::LazyLock;

/// The light of a byte of 255.
const FULL: u32 = 65_535;
/// Entries of the table from light to bytes: 16 units of light each, fewer than lie between two bytes anywhere, so that an entry holds at most one step.
const ENTRIES: usize = 4096;

/// The two tables. Made once; the same on every machine, because no value lies so close to a rounding's edge that the last bit of a power could move it.
pub(super) struct Srgb {
    light: [u16; 256],
    /// The byte at the lower end of each entry.
    byte: [u8; ENTRIES],
    /// The light from which on a byte is the nearest; one more than any light past the end.
    from: [u32; 257],
}

static TABLES: LazyLock<Srgb> = LazyLock::new(Srgb::new);

impl Srgb {
    /// The tables.
    pub(super) fn tables() -> &'static Self {
        &TABLES
    }

    fn new() -> Self {
        let light = |byte: f64| {
            let c = byte / 255.0;
            (if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }) * f64::from(FULL)
        };
        let mut from = [FULL + 1; 257];
        from[0] = 0;
        for (byte, from) in (1..256).zip(&mut from[1..]) {
            *from = light(f64::from(byte) - 0.5).ceil() as u32;
        }
        let nearest = |of: u32| from.partition_point(|start| *start <= of).saturating_sub(1) as u8;
        Self {
            light: std::array::from_fn(|byte| light(byte as f64).round() as u16),
            byte: std::array::from_fn(|entry| nearest(entry as u32 * 16)),
            from,
        }
    }

    /// The light of a byte, up to 65,535.
    #[inline(always)]
    pub(super) fn light(&self, byte: u32) -> u32 {
        u32::from(self.light[(byte & 255) as usize])
    }

    /// The byte that comes nearest to a light; what is more than all is 255.
    #[inline(always)]
    pub(super) fn byte(&self, light: u32) -> u32 {
        let light = light.min(FULL);
        let byte = self.byte[(light >> 4) as usize & (ENTRIES - 1)];
        u32::from(byte) + u32::from(light >= self.from[usize::from(byte) + 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_light_gets_the_nearest_byte() {
        let tables = Srgb::tables();
        for byte in 0..256 {
            assert_eq!(tables.byte(tables.light(byte)), byte);
        }
        for light in 0..=FULL {
            let c = f64::from(light) / f64::from(FULL);
            let exact = (if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }) * 255.0;
            assert!((exact - f64::from(tables.byte(light))).abs() <= 0.501, "{light}");
        }
        assert_eq!((tables.byte(0), tables.byte(u32::MAX), tables.byte(FULL / 2)), (0, 255, 188));
    }
}
