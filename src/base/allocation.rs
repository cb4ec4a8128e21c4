//! Vectors where memory may be refused. What there is to do about that is said here once,
//! because the wasm would hold a copy for every vector.

use alloc::collections::TryReserveError;
use alloc::vec::Vec;

use crate::base::error::Error;

/// The allocator refused memory. It holds nothing, so that handing it on takes no code to
/// speak of, which an [`Error`] does.
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

/// An empty vector with room for so many.
#[inline(never)]
pub(crate) fn with_capacity<T>(count: usize) -> Result<Vec<T>, OutOfMemory> {
    let mut items = Vec::new();
    items.try_reserve_exact(count)?;
    Ok(items)
}

/// So many times the same.
#[inline(never)]
pub(crate) fn filled<T: Clone>(count: usize, value: T) -> Result<Vec<T>, OutOfMemory> {
    let mut items = with_capacity(count)?;
    items.resize(count, value);
    Ok(items)
}

/// Makes room for so many more, where it is not there already.
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
