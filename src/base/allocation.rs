//! Vectors that report refused memory instead of aborting. These functions are not inlined,
//! because the wasm would otherwise hold a copy for every vector.

use alloc::collections::TryReserveError;
use alloc::vec::Vec;

use crate::base::error::Error;

/// The allocator refused memory. This type is empty, so that returning it takes almost no
/// code; returning an [`Error`] takes more.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OutOfMemory;

impl From<TryReserveError> for OutOfMemory {
    fn from(_: TryReserveError) -> Self {
        Self
    }
}

impl From<OutOfMemory> for Error {
    fn from(_: OutOfMemory) -> Self {
        Self::OutOfMemory
    }
}

/// An empty vector with room for `count` items.
#[inline(never)]
pub(crate) fn with_capacity<T>(count: usize) -> Result<Vec<T>, OutOfMemory> {
    let mut items = Vec::new();
    items.try_reserve_exact(count)?;
    Ok(items)
}

/// A vector of the same items.
#[inline(never)]
pub(crate) fn copied<T: Copy>(items: &[T]) -> Result<Vec<T>, OutOfMemory> {
    let mut copy = with_capacity(items.len())?;
    copy.extend_from_slice(items);
    Ok(copy)
}

/// A vector that holds `value` `count` times.
#[inline(never)]
pub(crate) fn filled<T: Clone>(count: usize, value: T) -> Result<Vec<T>, OutOfMemory> {
    let mut items = with_capacity(count)?;
    items.resize(count, value);
    Ok(items)
}

/// Makes an empty vector hold `value` `count` times. A struct of many vectors takes less code so.
#[cfg(feature = "higher")]
#[inline(never)]
pub(crate) fn fill<T: Clone>(
    items: &mut Vec<T>,
    count: usize,
    value: T,
) -> Result<(), OutOfMemory> {
    items.try_reserve_exact(count)?;
    items.resize(count, value);
    Ok(())
}

/// Makes room for `more` items, if there is none yet.
#[inline]
pub(crate) fn reserve<T>(items: &mut Vec<T>, more: usize) -> Result<(), OutOfMemory> {
    if items.capacity() - items.len() < more {
        grow(items, more)?;
    }
    Ok(())
}

#[cold]
#[inline(never)]
fn grow<T>(items: &mut Vec<T>, more: usize) -> Result<(), OutOfMemory> {
    Ok(items.try_reserve(more)?)
}

#[inline]
pub(crate) fn push<T>(items: &mut Vec<T>, item: T) -> Result<(), OutOfMemory> {
    reserve(items, 1)?;
    items.push(item);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn room_is_made_for_all_items_that_come() {
        for (present, more) in [(0, 1), (3, 5), (8, 100)] {
            let mut items = filled(present, 0u8).unwrap();
            reserve(&mut items, more).unwrap();
            assert!(items.capacity() >= present + more);
            let room = items.capacity();
            reserve(&mut items, room - present).unwrap();
            assert_eq!(items.capacity(), room);
        }
        let mut items = filled(3, 0u8).unwrap();
        assert!(reserve(&mut items, usize::MAX).is_err());
    }
}
