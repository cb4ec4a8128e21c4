//! What is kept from map to map.

use crate::answers::visibility_map::pool::Pool;
use crate::hull::Memory;

/// The pool of a cloud, and the room of the last map's hull.
#[derive(Default)]
pub(crate) struct MapMemory {
    pub(super) hull: Memory,
    pub(super) pool: Option<Pool>,
}
