//! What is kept from map to map.

use crate::answers::visibility_map::hides::VisibilityMap;
use crate::answers::visibility_map::pool::Pool;
use crate::hull::Memory;

/// What the last map of a cloud leaves for the next one.
#[derive(Default)]
pub(crate) struct MapMemory {
    pub(super) hull: Memory,
    pub(super) pool: Option<Pool>,
    pub(super) last: Option<VisibilityMap>,
    pub(super) tuned: Option<Tuned>,
}

/// The factor by which the scale of the last look may grow, and what it was found for.
pub(super) struct Tuned {
    pub(super) count: usize,
    pub(super) thickness: Option<f64>,
    pub(super) larger: f64,
}
