//! The repair of a surface of triangles after its vertices moved. The repair goes face by
//! face and edge by edge, until the surface is the hull of its vertices again.

use alloc::vec::Vec;

use super::dual_plane::Plane;
use super::incremental::{Hull, ORIGIN, Vertices};
use super::topology::{Face, FaceId, HalfEdge, Rim, Vertex};
use crate::base::allocation::{OutOfMemory, push, reserve};
use crate::hull::predicates::{Sign, side_of_face, side_of_origin};

/// The most edges around a hole that is filled.
pub(super) const MAX_DEGREE: usize = 128;
/// A vertex with more neighbors is not taken out at first, because that takes long.
const FEW_NEIGHBORS: usize = 16;

/// Buffers kept from view to view.
#[derive(Default)]
pub(super) struct Repair {
    /// Edges that may be reflex.
    pub suspects: Vec<HalfEdge>,
    /// Faces that the motion turned over.
    pub turned: Vec<FaceId>,
    /// The effort that is left for taking out vertices, in squares of their degrees and of half
    /// the faces of cleared holes. The repair is given up at 0.
    pub effort: usize,
    /// The edges around a hole, counter-clockwise.
    pub rim: Vec<Rim>,
    /// The faces that the hole had.
    pub star: Vec<FaceId>,
    ring: Vec<Rim>,
    ears: Vec<usize>,
    /// Flags of each vertex, for `Hull::settle`.
    pub sides: Vec<u8>,
}

impl Hull {
    /// Mends a face that turned over. Mostly one vertex crossed the opposite edge and now
    /// lies over the neighbor. Then flipping that edge mends the face.
    ///
    /// With `force`, the vertices of the face are taken out together, with others around them.
    pub(super) fn unfold(
        &mut self,
        id: FaceId,
        force: bool,
        repair: &mut Repair,
    ) -> Result<bool, OutOfMemory> {
        let face = *self.surface.face(id);
        if !face.is_alive() || !self.vertices.is_turned(&face) {
            return Ok(true);
        }
        let can_flip = |&edge: &HalfEdge| {
            let [[c, _, d], _] = self.surface.flipped(edge);
            self.can_flip(edge) && !self.surface.are_joined(c, d, id, &[])
        };
        // A flip that makes a ghost face is the last choice, because a ghost face fits too often.
        let is_inner = |&edge: &HalfEdge| {
            let [first, second] = self.surface.flipped(edge);
            !first.contains(&ORIGIN) && !second.contains(&ORIGIN)
        };
        let edges = [0, 1, 2].map(|edge| HalfEdge::new(id, edge));
        let inner = edges
            .into_iter()
            .find(|edge| is_inner(edge) && can_flip(edge));
        let any = edges.into_iter().find(can_flip);
        if let Some(edge) = inner {
            return self.unfold_across(edge, repair);
        }
        let most = if force { MAX_DEGREE } else { FEW_NEIGHBORS };
        if force && self.untie(id, repair)? {
            return Ok(true);
        }
        for vertex in face.vertices {
            if self.take_out(vertex, id, most, repair)? {
                return Ok(true);
            }
        }
        if let Some(edge) = any {
            return self.unfold_across(edge, repair);
        }
        if force {
            return self.clear(id, repair);
        }
        Ok(false)
    }

    fn unfold_across(&mut self, edge: HalfEdge, repair: &mut Repair) -> Result<bool, OutOfMemory> {
        let twin = self.surface.twin(edge);
        self.flip(edge)?;
        repair.suspect(edge.face())?;
        repair.suspect(twin.face())?;
        Ok(true)
    }

    fn flip(&mut self, edge: HalfEdge) -> Result<(), OutOfMemory> {
        let twin = self.surface.twin(edge);
        self.surface.flip(edge);
        self.renew_plane(edge.face())?;
        self.renew_plane(twin.face())
    }

    #[inline(never)]
    fn renew_plane(&mut self, id: FaceId) -> Result<(), OutOfMemory> {
        let face = self.surface.face_mut(id);
        face.data = self.vertices.plane_out_of_line(face.vertices);
        self.note_new(id)
    }

    /// Whether the surface is reflex at an edge between faces that turn outward.
    #[inline(never)]
    pub(super) fn is_reflex(&self, edge: HalfEdge) -> bool {
        let face = self.surface.face(edge.face());
        if !face.is_alive() {
            return false;
        }
        let twin = face.twins[edge.edge()];
        let across = self.surface.face(twin.face());
        // The plane of a face without the origin is enough to decide.
        let (face, [_, _, apex]) = if face.vertices.contains(&ORIGIN) {
            (across, face.vertices_from(edge.edge()))
        } else {
            (face, across.vertices_from(twin.edge()))
        };
        self.vertices.side(face, self.vertices.at(apex)) == Sign::Positive
    }

    /// Flips a reflex edge. Where the flip would turn a face over, one end of the edge lies
    /// below the other vertices. That end is taken out instead.
    pub(super) fn make_convex(
        &mut self,
        edge: HalfEdge,
        repair: &mut Repair,
    ) -> Result<bool, OutOfMemory> {
        if self.can_flip(edge) {
            let twin = self.surface.twin(edge);
            self.flip(edge)?;
            // The new edge is convex.
            reserve(&mut repair.suspects, 4)?;
            for face in [edge.face(), twin.face()] {
                repair
                    .suspects
                    .extend([0, 1].map(|edge| HalfEdge::new(face, edge)));
            }
            return Ok(true);
        }
        let [tail, head, _] = self.surface.face(edge.face()).vertices_from(edge.edge());
        let [with_tail, _] = self.surface.flipped(edge);
        let below = if self.vertices.may_face(with_tail) {
            head
        } else {
            tail
        };
        Ok(self.take_out(below, edge.face(), MAX_DEGREE, repair)?
            || self.clear(edge.face(), repair)?)
    }

    /// Whether both faces that flipping `edge` would make turn outward.
    #[inline]
    fn can_flip(&self, edge: HalfEdge) -> bool {
        let faces = self.surface.flipped(edge);
        let [[c, _, d], _] = faces;
        c != d && faces.into_iter().all(|face| self.vertices.may_face(face))
    }

    /// Takes `vertex`, a corner of `face`, out of the surface and fills the hole by ears.
    #[inline(never)]
    fn take_out(
        &mut self,
        vertex: Vertex,
        face: FaceId,
        most: usize,
        repair: &mut Repair,
    ) -> Result<bool, OutOfMemory> {
        if vertex == ORIGIN {
            return Ok(false);
        }
        repair.rim.clear();
        repair.star.clear();
        for (id, rim) in self.surface.around(vertex, face) {
            push(&mut repair.rim, rim)?;
            push(&mut repair.star, id)?;
            if repair.star.len() > most {
                return Ok(false);
            }
        }
        self.fill(repair)
    }

    /// Fills the hole of the faces `repair.star` inside `repair.rim` by ears. Returns false, and
    /// changes nothing, if that is not possible.
    #[inline(never)]
    pub(super) fn fill(&mut self, repair: &mut Repair) -> Result<bool, OutOfMemory> {
        if !(3..=MAX_DEGREE).contains(&repair.rim.len()) {
            return Ok(false);
        }
        if !repair.spend(repair.rim.len()) {
            return Ok(false);
        }
        // The plan is made first. If there is no plan, nothing has changed.
        repair.ring.clear();
        reserve(&mut repair.ring, repair.rim.len())?;
        repair.ring.extend_from_slice(&repair.rim);
        repair.ears.clear();
        reserve(&mut repair.ears, repair.rim.len())?;
        while repair.ring.len() > 2 {
            let Some(ear) = self.ear(&repair.ring, &repair.star) else {
                return Ok(false);
            };
            repair.ears.push(ear);
            repair.ring.remove((ear + 1) % repair.ring.len());
        }
        for i in 0..repair.ears.len() {
            let (ear, slot) = (repair.ears[i], repair.star[i]);
            self.surface.cut_ear(&mut repair.rim, ear, slot);
            self.renew_plane(slot)?;
            repair.suspect(slot)?;
        }
        for &slot in &repair.star[repair.ears.len()..] {
            self.surface.free(slot)?;
        }
        Ok(true)
    }

    /// Finds a place on a ring of vertices (the tails of `ring`) where an ear can be cut off.
    /// An ear is a triangle of three successive vertices that turns outward and holds no other
    /// vertex of the ring. If there is no ear and the ring holds the origin, a ghost face may
    /// be cut off instead.
    fn ear(&self, ring: &[Rim], hole: &[FaceId]) -> Option<usize> {
        let corners = |ear: usize| [0, 1, 2].map(|i| ring[(ear + i) % ring.len()].tail);
        if ring.len() == 3 {
            return self.vertices.may_face(corners(0)).then_some(0);
        }
        // A second edge between two vertices that are already joined would be wrong.
        let is_new = |ear: usize| {
            let [tail, _, head] = corners(ear);
            !self
                .surface
                .are_joined(tail, head, ring[ear].outside.face(), hole)
        };
        let is_ear = |&ear: &usize| {
            let corners = corners(ear);
            !corners.contains(&ORIGIN)
                && self.vertices.turns_outward(corners)
                && ring.iter().all(|other| {
                    corners.contains(&other.tail)
                        || other.tail == ORIGIN
                        || self.vertices.is_aside(corners, other.tail)
                })
                && is_new(ear)
        };
        let is_ghost = |&ear: &usize| {
            ring[ear].tail == ORIGIN && self.vertices.may_face(corners(ear)) && is_new(ear)
        };
        (0..ring.len())
            .find(is_ear)
            .or_else(|| (0..ring.len()).find(is_ghost))
    }
}

impl Vertices {
    /// Whether a face does not turn outward. A ghost face is asked whether it does not turn
    /// away from `inner`.
    #[inline]
    pub(super) fn is_turned(&self, face: &Face<Plane>) -> bool {
        face.data.is_exact_only() && !self.turns_right(face.vertices)
    }

    /// Whether a face with these corners would turn the right way.
    #[inline(never)]
    fn may_face(&self, corners: [Vertex; 3]) -> bool {
        !self.plane_out_of_line(corners).is_exact_only() || self.turns_right(corners)
    }

    #[cold]
    fn turns_right(&self, corners: [Vertex; 3]) -> bool {
        if corners.contains(&ORIGIN) {
            let [a, b, c] = corners.map(|v| self.at(v));
            side_of_face(a, b, c, self.inner) == Sign::Negative
        } else {
            self.turns_outward(corners)
        }
    }

    /// Whether the ray of `vertex` misses the face of these corners.
    fn is_aside(&self, [a, b, c]: [Vertex; 3], vertex: Vertex) -> bool {
        [[a, b], [b, c], [c, a]]
            .into_iter()
            .any(|[tail, head]| self.is_left(head, tail, vertex))
    }

    /// Whether `vertex` is strictly to the left of an edge, seen from outside.
    #[inline(never)]
    pub(super) fn is_left(&self, tail: Vertex, head: Vertex, vertex: Vertex) -> bool {
        let [tail, head, q] = [tail, head, vertex].map(|v| self.at(v));
        side_of_origin(tail, head, q) == Sign::Positive
    }
}

impl Repair {
    /// Spends the square of the `size` of a hole. If too little is left, none is left
    /// afterwards.
    pub(super) fn spend(&mut self, size: usize) -> bool {
        let rest = self.effort.checked_sub(size * size);
        self.effort = rest.unwrap_or(0);
        rest.is_some()
    }

    /// Lists all edges of a face, to be looked at again.
    #[inline]
    fn suspect(&mut self, face: FaceId) -> Result<(), OutOfMemory> {
        reserve(&mut self.suspects, 3)?;
        self.suspects
            .extend((0..3).map(|edge| HalfEdge::new(face, edge)));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effort_is_spent_in_squares_until_none_is_left() {
        let mut repair = Repair {
            effort: 100,
            ..Repair::default()
        };
        assert!(repair.spend(6));
        assert!(repair.spend(8));
        assert_eq!(repair.effort, 0);
        repair.effort = 100;
        assert!(!repair.spend(11));
        assert_eq!(repair.effort, 0);
    }
}
