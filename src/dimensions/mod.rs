//! Clouds of other dimensions than three: two as three with z = 0, four and more by linear
//! programs.

pub(crate) mod higher;
pub(crate) mod two;
