//! Clouds of other dimensions than three. Two dimensions are treated as three with z = 0. Four
//! and more dimensions use linear programs.

#[cfg(feature = "higher")]
pub(crate) mod higher;
pub(crate) mod two;
