//! One budget for the images of a document: how large each may be.

/// What an image asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ImageDemand {
    /// Columns and rows.
    pub size: [u32; 2],
    /// In how many ways it is used as a texture; each has mip levels of its own.
    pub textures: u32,
}

/// What an image and each of its mip chains take at least, bytes.
const FIXED: u64 = 2_048;

impl ImageDemand {
    /// What it takes at this size, bytes: four a pixel, and for each texture the same again with a third more for the mip levels.
    fn bytes(&self, [width, height]: [u32; 2]) -> u64 {
        let area = u64::from(width) * u64::from(height);
        let apron = 8 * (u64::from(width) + u64::from(height)) * 4;
        4 * area + FIXED + u64::from(self.textures) * (area * 16 / 3 + apron + FIXED)
    }

    /// Its size, halved until it has no more than `most` pixels.
    fn size_within(&self, most: u64) -> [u32; 2] {
        let [mut width, mut height] = self.size;
        while u64::from(width) * u64::from(height) > most && (width > 1 || height > 1) {
            (width, height) = ((width / 2).max(1), (height / 2).max(1));
        }
        [width, height]
    }
}

/// What all images take together as they are, bytes.
pub(super) fn total(demands: &[ImageDemand]) -> u64 {
    demands.iter().map(|demand| demand.bytes(demand.size)).fold(0, u64::saturating_add)
}

/// The size of each image, so that all together take no more than `budget` bytes. The largest are halved first, equal ones alike; `None` where not
/// even a pixel is left for one.
pub(super) fn sizes(demands: &[ImageDemand], budget: u64) -> Vec<Option<[u32; 2]>> {
    let sum = |most: u64| demands.iter().map(|demand| demand.bytes(demand.size_within(most))).fold(0, u64::saturating_add);
    let area = |demand: &ImageDemand| u64::from(demand.size[0]) * u64::from(demand.size[1]);
    let mut most = demands.iter().map(area).max().unwrap_or(1);
    while most > 1 && sum(most) > budget {
        most /= 2;
    }
    let mut left = budget;
    let size = |demand: &ImageDemand| {
        let size = demand.size_within(most);
        left = left.checked_sub(demand.bytes(size))?;
        Some(size)
    };
    demands.iter().map(size).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn demand(width: u32, height: u32) -> ImageDemand {
        ImageDemand { size: [width, height], textures: 1 }
    }

    #[test]
    fn what_fits_stays_and_the_largest_is_halved_first() {
        let demands = [demand(4096, 4096), demand(512, 512), demand(4096, 2048)];
        assert_eq!(sizes(&demands, total(&demands)), demands.map(|demand| Some(demand.size)));
        assert_eq!(sizes(&demands, total(&demands) - 1), [Some([2048, 2048]), Some([512, 512]), Some([4096, 2048])]);
        let many = [demand(4096, 4096); 40];
        assert_eq!(sizes(&many, 512 << 20), [Some([1024, 1024]); 40]);
        assert_eq!(sizes(&many, 40_000).iter().flatten().count(), 9, "where not even a pixel fits, some are left out");
    }

    proptest! {
        #[test]
        fn the_budget_holds_and_nothing_grows(
            demands in proptest::collection::vec((1_u32..=16_384, 1_u32..=16_384, 0_u32..4), 0..50),
            budget in 0_u64..1 << 30,
        ) {
            let demands: Vec<ImageDemand> = demands.into_iter().map(|(width, height, textures)| ImageDemand { size: [width, height], textures }).collect();
            let sizes = sizes(&demands, budget);
            let taken: u64 = demands.iter().zip(&sizes).filter_map(|(demand, size)| Some(demand.bytes((*size)?))).sum();
            prop_assert!(taken <= budget);
            for (demand, size) in demands.iter().zip(&sizes) {
                if let Some([width, height]) = size {
                    prop_assert!(*width <= demand.size[0] && *height <= demand.size[1] && *width > 0 && *height > 0);
                }
            }
            // A fitting set is left alone.
            if total(&demands) <= budget {
                prop_assert!(sizes.iter().zip(&demands).all(|(size, demand)| *size == Some(demand.size)));
            }
        }
    }
}
