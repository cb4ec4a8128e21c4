//! How many points a cloud may hold.

/// The largest number of points in one cloud: hull faces are numbered in 30
/// bits, and a hull has up to two faces a point. Removed points count too, since
/// their indices are never given again.
pub const MAX_POINTS: usize = 1 << 28;
