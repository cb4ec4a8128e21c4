//! The corners of a moving hull's faces, in a list of their own.
//!
//! A moving hull is read from end to end several times in each view. If it does not fit into the
//! caches, most of the time is spent waiting for memory, and a face is large. So the corners of each
//! face and the vertices across its edges are kept here once more. A pass over this list does not look
//! at a face's neighbors. It stores no plane: a plane is computed where it is needed.
//! [`Plane::EXACT_ONLY`] stands for a missing plane, because it decides nothing by itself.

use alloc::vec::Vec;

use super::dual_plane::Plane;
use super::topology::{FaceId, NONE, Vertex};

/// A face without its plane.
#[derive(Clone, Copy)]
pub(super) struct Corners {
    /// The face's vertices; the first one is `NONE` where there is no face.
    pub own: [Vertex; 3],
    /// The third vertex of the face across each edge.
    pub across: [Vertex; 3],
}

/// The corners of all faces, by the faces' numbers.
#[derive(Default)]
pub(super) struct Compact {
    pub faces: Vec<Corners>,
    /// Whether a face certainly turns outward.
    pub outward: Vec<bool>,
    /// The faces that were made since the last motion. They have planes.
    pub new: Vec<FaceId>,
    /// How many of them are in the list of corners already.
    pub listed: usize,
    /// Whether the list is used. Then only new faces have planes.
    pub is_used: bool,
}

impl Corners {
    #[inline]
    pub(super) fn is_alive(&self) -> bool {
        self.own[0] != NONE
    }
}

impl Compact {
    pub(super) fn stop(&mut self) {
        self.is_used = false;
        self.new.clear();
    }

    #[inline]
    pub(super) fn is_used(&self) -> bool {
        self.is_used
    }

    /// Notes the plane of a face as it was computed in a pass.
    #[inline]
    pub(super) fn note_plane(&mut self, id: FaceId, plane: &Plane) {
        self.outward[id as usize] = !plane.is_exact_only();
    }

    /// The corners of all faces, with the faces' numbers.
    #[inline]
    pub(super) fn alive(&self) -> impl Iterator<Item = (FaceId, [Vertex; 3])> + '_ {
        let alive = (0..).zip(&self.faces).filter(|(_, face)| face.is_alive());
        alive.map(|(id, face)| (id, face.own))
    }

    /// Whether a face certainly turns outward. If not, it may still do so.
    #[inline]
    pub(super) fn is_outward(&self, id: FaceId) -> bool {
        self.outward[id as usize]
    }
}
