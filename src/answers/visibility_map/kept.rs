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
}
