//! Tools that do not depend on points: the error type, the limit of a cloud's size, memory
//! that may be refused, threads, square roots without `std`, values that are made once, and the only sort.

pub(crate) mod allocation;
pub(crate) mod beat;
pub(crate) mod bits;
pub(crate) mod error;
#[cfg(test)]
pub(crate) mod random;
pub(crate) mod real;
pub(crate) mod sort;
pub(crate) mod threads;

/// The largest number of points in one cloud: hull faces are numbered in 30
/// bits, and a hull has up to two faces a point. Removed points count too, since
/// their indices are never given again.
pub const MAX_POINTS: usize = 1 << 28;

/// False in the small module of the npm package, which holds the operator alone. Only code that the
/// linker would keep asks for it.
pub(crate) const FULL: bool = cfg!(any(feature = "wasm", not(feature = "lite")));
