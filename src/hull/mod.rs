//! Which flipped points lie on the outer boundary of K = conv({q} ∪ {0})?
//!
//! INPUT    the flipped points q, one for each distinct point of the cloud
//!          (none for points at the viewpoint); the viewpoint is the origin.
//! OUTPUT   for each point: visible (the ray from the origin through q leaves K
//!          at q) or hidden. Exact for the rounded q, in every dimension K has.
//! SUMMARY  Three points that, together with the origin, span space start an
//!          incremental hull (`incremental`). If no such points exist, K is flat,
//!          and `flat` answers according to its dimension.

pub(crate) mod division;

#[cfg(debug_assertions)]
mod assertions;
mod boxes;
mod depth;
mod dual_plane;
mod exact_sum;
mod flat;
mod flipped;
mod incremental;
mod kept;
mod locate;
mod lower;
mod memory;
mod order;
mod outer_boundary;
mod outer_faces;
mod predicates;
mod share;
mod topology;

pub(crate) use boxes::hides_box;
pub(crate) use depth::{Window, place};
#[cfg(feature = "higher")]
pub(crate) use exact_sum::Decoded;
pub(crate) use kept::KeptHull;
pub(crate) use lower::lower_boundary;
pub(crate) use memory::Memory;
pub(crate) use outer_boundary::{
    complete, go_on, mark_sector, mark_visible, triangulate_visible, visible_once,
};
pub(crate) use outer_faces::{Exit, OuterFaces};
pub(crate) use topology::{FaceId, Vertex};
