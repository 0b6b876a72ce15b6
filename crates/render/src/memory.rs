//! Asking the system for memory in a way that it can refuse: whatever grows with the picture or the scene is asked for here.

use std::collections::TryReserveError;

use bytemuck::Zeroable;

use super::RenderError;

impl From<TryReserveError> for RenderError {
    fn from(_: TryReserveError) -> Self {
        Self::OutOfMemory
    }
}

/// So many zeros. The system hands the memory out only as it is touched.
pub(super) fn zeroed<T: Zeroable>(count: usize) -> Result<Vec<T>, RenderError> {
    bytemuck::allocation::try_zeroed_slice_box(count).map(Vec::from).map_err(|()| RenderError::OutOfMemory)
}

/// Makes `list` at least `count` elements long.
pub(super) fn grow<T: Clone + Default>(list: &mut Vec<T>, count: usize) -> Result<(), RenderError> {
    if list.len() < count {
        list.try_reserve(count - list.len())?;
        list.resize(count, T::default());
    }
    Ok(())
}

/// Adds one element.
#[inline(always)]
pub(super) fn push<T>(list: &mut Vec<T>, value: T) -> Result<(), RenderError> {
    if list.len() == list.capacity() {
        list.try_reserve(1)?;
    }
    list.push(value);
    Ok(())
}

/// The elements as a list.
pub(super) fn collect<T>(elements: impl ExactSizeIterator<Item = T>) -> Result<Vec<T>, RenderError> {
    let mut list = Vec::new();
    list.try_reserve_exact(elements.len())?;
    list.extend(elements);
    Ok(list)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_system_has_is_an_error() {
        assert_eq!(zeroed::<u32>(usize::MAX / 8), Err(RenderError::OutOfMemory));
        let mut list = vec![1_u64];
        assert_eq!(grow(&mut list, usize::MAX / 16), Err(RenderError::OutOfMemory));
        assert_eq!((list.len(), zeroed::<u32>(3)), (1, Ok(vec![0; 3])));
    }
}
