//! The number of a sector.

/// One of several sectors that a view is divided into, one for each thread. A sector needs nothing from the
/// others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sector {
    pub number: u32,
    pub count: u32,
}
