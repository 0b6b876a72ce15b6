//! Lists of what touches each band, in the order in which it was given, and the columns that it touches there.

use super::memory::push;

/// Numbers in a block; with its head a block fills four cache lines.
const BLOCK: usize = 62;

#[derive(Debug, Clone, Copy)]
struct BinBlock {
    next: u32,
    len: u32,
    values: [u32; BLOCK],
}

const NONE: u32 = u32::MAX;

/// A stretch of columns, ends included; empty where `last < first`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ColumnRange {
    pub first: i32,
    pub last: i32,
}

impl ColumnRange {
    pub(super) const NONE: Self = Self { first: i32::MAX, last: i32::MIN };

    #[inline(always)]
    pub(super) fn is_empty(&self) -> bool {
        self.last < self.first
    }

    /// The smallest stretch that holds both.
    #[inline(always)]
    pub(super) fn union(self, other: Self) -> Self {
        Self { first: self.first.min(other.first), last: self.last.max(other.last) }
    }
}

/// One list a band. Blocks are taken from one arena that is kept from frame to frame.
///
/// Where there is no memory for a value it is left out and the lists are incomplete from then on, which the stage that fills them asks once at its end.
#[derive(Debug, Default)]
pub(super) struct BinLists {
    heads: Vec<u32>,
    tails: Vec<u32>,
    columns: Vec<ColumnRange>,
    blocks: Vec<BinBlock>,
    incomplete: bool,
}

impl BinLists {
    /// Empties all and makes room for `bands` lists.
    pub(super) fn reset(&mut self, bands: usize) {
        self.heads.clear();
        self.tails.clear();
        self.columns.clear();
        self.blocks.clear();
        let room = [self.heads.try_reserve(bands), self.tails.try_reserve(bands), self.columns.try_reserve(bands)];
        self.incomplete = room.iter().any(Result::is_err);
        if !self.incomplete {
            self.heads.resize(bands, NONE);
            self.tails.resize(bands, NONE);
            self.columns.resize(bands, ColumnRange::NONE);
        }
    }

    /// Whether values were left out since the last [`BinLists::reset`].
    pub(super) fn is_incomplete(&self) -> bool {
        self.incomplete
    }

    /// Adds `value`, which touches these columns, to the list of `band`.
    #[inline(always)]
    pub(super) fn push(&mut self, band: usize, columns: ColumnRange, value: u32) {
        let (Some(touched), Some(&tail)) = (self.columns.get_mut(band), self.tails.get(band)) else { return };
        *touched = touched.union(columns);
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
        if push(&mut self.blocks, BinBlock { next: NONE, len: 1, values }).is_err() {
            self.incomplete = true;
            return;
        }
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

    /// The columns that something touches in `band`.
    pub(super) fn columns(&self, band: usize) -> ColumnRange {
        self.columns.get(band).copied().unwrap_or(ColumnRange::NONE)
    }

    /// At least as many as the longest list holds.
    pub(super) fn max_len(&self) -> usize {
        (0..self.heads.len()).map(|band| self.of(band).count() * BLOCK).max().unwrap_or(0)
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
        let mut bins = BinLists::default();
        for _ in 0..2 {
            bins.reset(3);
            for i in 0..1000 {
                let column = 40 - i as i32 % 20;
                bins.push(i as usize % 2, ColumnRange { first: column, last: column + 3 }, i);
            }
            assert_eq!(bins.columns(0), ColumnRange { first: 22, last: 43 });
            assert!(bins.columns(2).is_empty() && bins.max_len() >= 500);
            let odd: Vec<u32> = bins.of(1).flatten().copied().collect();
            assert_eq!(odd, (0..1000).filter(|i| i % 2 == 1).collect::<Vec<_>>());
            assert!(bins.is_empty(2) && !bins.is_empty(0));
        }
    }
}
