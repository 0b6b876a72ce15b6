//! Lists of what touches each band, in the order in which it was given.

/// Numbers in a block; with its head a block fills four cache lines.
const BLOCK: usize = 62;

#[derive(Debug, Clone, Copy)]
struct Block {
    next: u32,
    len: u32,
    values: [u32; BLOCK],
}

const NONE: u32 = u32::MAX;

/// One list a band. Blocks are taken from one arena that is kept from frame to frame.
#[derive(Debug, Default)]
pub(super) struct Bins {
    heads: Vec<u32>,
    tails: Vec<u32>,
    blocks: Vec<Block>,
}

impl Bins {
    /// Empties all and makes room for `bands` lists.
    pub(super) fn reset(&mut self, bands: usize) {
        self.heads.clear();
        self.heads.resize(bands, NONE);
        self.tails.clear();
        self.tails.resize(bands, NONE);
        self.blocks.clear();
    }

    /// Adds `value` to the list of `band`.
    #[inline(always)]
    pub(super) fn push(&mut self, band: usize, value: u32) {
        let tail = self.tails[band];
        if let Some(block) = self.blocks.get_mut(tail as usize)
            && let Some(slot) = block.values.get_mut(block.len as usize)
        {
            *slot = value;
            block.len += 1;
            return;
        }
        self.grow(band, value);
    }

    #[cold]
    fn grow(&mut self, band: usize, value: u32) {
        let index = u32::try_from(self.blocks.len()).unwrap_or(NONE);
        let mut values = [0; BLOCK];
        values[0] = value;
        self.blocks.push(Block { next: NONE, len: 1, values });
        match self.blocks.get_mut(self.tails[band] as usize) {
            Some(tail) => tail.next = index,
            None => self.heads[band] = index,
        }
        self.tails[band] = index;
    }

    /// Whether nothing touches `band`.
    pub(super) fn is_empty(&self, band: usize) -> bool {
        self.heads.get(band).is_none_or(|head| *head == NONE)
    }

    /// The list of `band`, in stretches.
    pub(super) fn of(&self, band: usize) -> impl Iterator<Item = &[u32]> {
        let mut next = self.heads.get(band).copied().unwrap_or(NONE);
        std::iter::from_fn(move || {
            let block = self.blocks.get(next as usize)?;
            next = block.next;
            block.values.get(..block.len as usize)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_keep_their_order() {
        let mut bins = Bins::default();
        for _ in 0..2 {
            bins.reset(3);
            for i in 0..1000 {
                bins.push(i as usize % 2, i);
            }
            let odd: Vec<u32> = bins.of(1).flatten().copied().collect();
            assert_eq!(odd, (0..1000).filter(|i| i % 2 == 1).collect::<Vec<_>>());
            assert!(bins.is_empty(2) && !bins.is_empty(0));
        }
    }
}
