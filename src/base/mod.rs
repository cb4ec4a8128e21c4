//! Tools that do not depend on points: the error type, the limit of a cloud's size, memory
//! that may be refused, threads, square roots without `std`, values that are made once, and the only sort.

pub(crate) mod allocation;
pub(crate) mod beat;
pub(crate) mod bits;
pub(crate) mod build;
pub(crate) mod error;
pub(crate) mod limit;
pub(crate) mod once;
#[cfg(test)]
pub(crate) mod random;
pub(crate) mod real;
pub(crate) mod sort;
pub(crate) mod threads;
