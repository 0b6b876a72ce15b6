//! One budget for the images of a document: how large each may be.

/// What an image asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Wish {
    /// Columns and rows.
    pub size: [u32; 2],
    /// In how many ways it is used as a texture; each has mip levels of its own.
    pub textures: u32,
}

/// What an image and each of its mip chains take at least, bytes.
const FIXED: u64 = 2_048;

impl Wish {
    /// What it takes at this size, bytes: four a pixel, and for each texture the same again with a third more for the mip levels.
    fn bytes(&self, [width, height]: [u32; 2]) -> u64 {
        let area = u64::from(width) * u64::from(height);
        let apron = 8 * (u64::from(width) + u64::from(height)) * 4;
        4 * area + FIXED + u64::from(self.textures) * (area * 16 / 3 + apron + FIXED)
    }

    /// Its size, halved until it has no more than `most` pixels.
    fn within(&self, most: u64) -> [u32; 2] {
        let [mut width, mut height] = self.size;
        while u64::from(width) * u64::from(height) > most && (width > 1 || height > 1) {
            (width, height) = ((width / 2).max(1), (height / 2).max(1));
        }
        [width, height]
    }
}

/// What all images take together as they are, bytes.
pub(super) fn total(wishes: &[Wish]) -> u64 {
    wishes.iter().map(|wish| wish.bytes(wish.size)).fold(0, u64::saturating_add)
}

/// The size of each image, so that all together take no more than `budget` bytes. The largest are halved first, equal ones alike; `None` where not
/// even a pixel is left for one.
pub(super) fn sizes(wishes: &[Wish], budget: u64) -> Vec<Option<[u32; 2]>> {
    let sum = |most: u64| wishes.iter().map(|wish| wish.bytes(wish.within(most))).fold(0, u64::saturating_add);
    let area = |wish: &Wish| u64::from(wish.size[0]) * u64::from(wish.size[1]);
    let mut most = wishes.iter().map(area).max().unwrap_or(1);
    while most > 1 && sum(most) > budget {
        most /= 2;
    }
    let mut left = budget;
    let size = |wish: &Wish| {
        let size = wish.within(most);
        left = left.checked_sub(wish.bytes(size))?;
        Some(size)
    };
    wishes.iter().map(size).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn wish(width: u32, height: u32) -> Wish {
        Wish { size: [width, height], textures: 1 }
    }

    #[test]
    fn what_fits_stays_and_the_largest_is_halved_first() {
        let wishes = [wish(4096, 4096), wish(512, 512), wish(4096, 2048)];
        assert_eq!(sizes(&wishes, total(&wishes)), wishes.map(|wish| Some(wish.size)));
        assert_eq!(sizes(&wishes, total(&wishes) - 1), [Some([2048, 2048]), Some([512, 512]), Some([4096, 2048])]);
        let many = [wish(4096, 4096); 40];
        assert_eq!(sizes(&many, 512 << 20), [Some([1024, 1024]); 40]);
        assert_eq!(sizes(&many, 40_000).iter().flatten().count(), 9, "where not even a pixel fits, some are left out");
    }

    proptest! {
        #[test]
        fn the_budget_holds_and_nothing_grows(
            wishes in proptest::collection::vec((1_u32..=16_384, 1_u32..=16_384, 0_u32..4), 0..50),
            budget in 0_u64..1 << 30,
        ) {
            let wishes: Vec<Wish> = wishes.into_iter().map(|(width, height, textures)| Wish { size: [width, height], textures }).collect();
            let sizes = sizes(&wishes, budget);
            let taken: u64 = wishes.iter().zip(&sizes).filter_map(|(wish, size)| Some(wish.bytes((*size)?))).sum();
            prop_assert!(taken <= budget);
            for (wish, size) in wishes.iter().zip(&sizes) {
                if let Some([width, height]) = size {
                    prop_assert!(*width <= wish.size[0] && *height <= wish.size[1] && *width > 0 && *height > 0);
                }
            }
            // A fitting set is left alone.
            if total(&wishes) <= budget {
                prop_assert!(sizes.iter().zip(&wishes).all(|(size, wish)| *size == Some(wish.size)));
            }
        }
    }
}
