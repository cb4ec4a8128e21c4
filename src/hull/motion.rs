//! The hull of a nearby view, from the hull of the last one.
//!
//! INPUT    the last view's hull; the flip of the new view.
//! OUTPUT   the exact hull, in the new view, of points that were vertices in the
//!          last one, and which they are; or the verdict that starting anew is better.
//! SUMMARY  From a viewpoint close by, most faces are the same. So the vertices
//!          are flipped anew and every face and edge is looked at. Faces that the
//!          motion turned over are unfolded; edges that became reflex are flipped;
//!          a vertex that stands in the way is taken out, to be located again like
//!          any other point. A surface whose faces all turn outward, whose edges
//!          are all convex and which covers one direction once is the hull, however
//!          it was found, so nothing here can make an answer wrong: where in doubt,
//!          there is always the way of starting anew.

use alloc::collections::TryReserveError;
use alloc::vec::Vec;
use glam::DVec3;

use super::Flipped;
use super::incremental::{Hull, ORIGIN, Vertices};
use super::plane::Plane;
use super::topology::{Face, FaceId, HalfEdge, Rim, Vertex};
use crate::predicates::{Sign, side_of_face, side_of_origin};

/// Faces looked at to tell whether the views are close.
const SAMPLE: usize = 512;
/// With more of them turned over than one in this many, starting anew is faster.
const FEW_TURNED: usize = 100;
/// Likewise for reflex ones among their edges.
const FEW_REFLEX: usize = 28;
/// The largest link of a vertex that is taken out.
const MAX_DEGREE: usize = 64;

/// Buffers kept from view to view.
#[derive(Default)]
pub(super) struct Repair {
    /// Edges that may be reflex.
    suspects: Vec<HalfEdge>,
    /// Faces that the motion turned over.
    turned: Vec<FaceId>,
    rim: Vec<Rim>,
    star: Vec<FaceId>,
    ring: Vec<Rim>,
    ears: Vec<usize>,
    sides: Vec<u8>,
}

impl Hull {
    /// Becomes the hull of its vertices as `flipped` now; false where the hull must
    /// be started anew (what it is then has no meaning).
    pub(super) fn move_to(
        &mut self,
        flipped: &Flipped,
        repair: &mut Repair,
        is_vertex: &mut [bool],
    ) -> Result<bool, TryReserveError> {
        if self.surface.slots() == 0 || !self.looks_alike(flipped) {
            return Ok(false);
        }
        self.vertices.reach = flipped.reach();
        let points = self.vertices.points.iter().skip(1);
        for (position, &point) in self.vertices.positions.iter_mut().skip(1).zip(points) {
            let Some(q) = flipped.get_out_of_line(point) else {
                return Ok(false);
            };
            *position = q;
        }
        let sum = self.vertices.positions.iter().sum::<DVec3>();
        self.vertices.inner = sum / self.vertices.positions.len() as f64;
        self.renew_planes(repair)?;
        let mut budget = self.surface.slots() / 2 + 64;
        // What its neighbors prevent for one face is tried again when they are mended,
        // in the end with more force.
        let mut force = false;
        while !repair.turned.is_empty() {
            let before = repair.turned.len();
            let mut kept = 0;
            for i in 0..before {
                let face = repair.turned[i];
                if !self.unfold(face, force, repair)? {
                    repair.turned[kept] = face;
                    kept += 1;
                }
            }
            repair.turned.truncate(kept);
            if kept > before / 2 {
                if force {
                    return Ok(false);
                }
                force = true;
            }
        }
        while let Some(edge) = repair.suspects.pop() {
            if self.is_reflex(edge) {
                budget -= 1;
                if budget == 0 || !self.make_convex(edge, repair)? {
                    return Ok(false);
                }
            }
        }
        self.settle(repair, is_vertex)
    }

    /// Whether, in a sample, few faces turned over and few edges became reflex.
    /// (With roundings: this only decides which way is faster.)
    fn looks_alike(&self, flipped: &Flipped) -> bool {
        let slots = self.surface.slots();
        let at = |vertex: Vertex| flipped.get_out_of_line(self.vertices.points[vertex as usize]);
        let [mut faces, mut turned, mut reflex] = [0; 3];
        for slot in (0..slots).step_by(slots.div_ceil(SAMPLE)) {
            let face = self.surface.face(slot as FaceId);
            if !face.is_alive() || face.vertices.contains(&ORIGIN) {
                continue;
            }
            let [Some(a), Some(b), Some(c)] = face.vertices.map(at) else {
                return false;
            };
            let normal = (a - c).cross(b - c);
            let height = normal.dot(c);
            faces += 1;
            turned += usize::from(height <= 0.0);
            for twin in face.twins {
                let [_, _, apex] = self.surface.face(twin.face()).vertices_from(twin.edge());
                if apex != ORIGIN {
                    reflex += usize::from(at(apex).is_some_and(|q| normal.dot(q) > height));
                }
            }
        }
        turned * FEW_TURNED <= faces && reflex * FEW_REFLEX <= 3 * faces
    }

    /// Each face's plane in the new view; lists turned faces and reflex edges.
    fn renew_planes(&mut self, repair: &mut Repair) -> Result<(), TryReserveError> {
        repair.turned.clear();
        repair.suspects.clear();
        for slot in 0..self.surface.slots() as FaceId {
            let face = self.surface.face_mut(slot);
            if !face.is_alive() {
                continue;
            }
            face.data = self.vertices.plane(face.vertices);
            let face = *face;
            // All three neighbors at once, and each edge from both sides: a branch
            // that goes either way at random costs more.
            let heights = face.twins.map(|twin| {
                let across = self.surface.face(twin.face());
                let apex = across.vertices[(twin.edge() + 2) % 3];
                face.data.m.dot(self.vertices.at(apex)) - 1.0
            });
            let highest = heights[0].max(heights[1]).max(heights[2]);
            if highest < -face.data.error {
                continue;
            }
            if self.vertices.is_turned(&face) {
                repair.turned.try_reserve(1)?;
                repair.turned.push(slot);
                continue;
            }
            for edge in (0..3).map(|edge| HalfEdge::new(slot, edge)) {
                let twin = face.twins[edge.edge()];
                let across = self.surface.face(twin.face());
                if twin.face() < slot && !self.vertices.is_turned(across) && self.is_reflex(edge) {
                    repair.suspects.try_reserve(1)?;
                    repair.suspects.push(edge);
                }
            }
        }
        Ok(())
    }

    /// Mends a face that turned over: mostly one vertex crossed the opposite edge
    /// and came to lie over the neighbor, where flipping that edge mends it.
    ///
    /// With `force`, vertices next to the face may be taken out, too.
    fn unfold(
        &mut self,
        id: FaceId,
        force: bool,
        repair: &mut Repair,
    ) -> Result<bool, TryReserveError> {
        let face = *self.surface.face(id);
        if !face.is_alive() || !self.vertices.is_turned(&face) {
            return Ok(true);
        }
        let can_flip = |&edge: &HalfEdge| {
            let [[c, _, d], _] = self.surface.flipped(edge);
            self.can_flip(edge) && !self.surface.are_joined(c, d, id)
        };
        // Not by way of a ghost face if it can be helped: those fit too often.
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
        for vertex in face.vertices {
            if self.take_out(vertex, id, repair)? {
                return Ok(true);
            }
        }
        if let Some(edge) = any {
            return self.unfold_across(edge, repair);
        }
        if force {
            for hub in face.vertices.into_iter().filter(|&v| v != ORIGIN) {
                let next = self
                    .surface
                    .around(hub, id)
                    .map(|(face, rim)| (rim.tail, face));
                for (vertex, face) in next.take(MAX_DEGREE).collect::<Vec<_>>() {
                    if self.take_out(vertex, face, repair)? {
                        return Ok(false);
                    }
                }
            }
        }
        Ok(false)
    }

    fn unfold_across(
        &mut self,
        edge: HalfEdge,
        repair: &mut Repair,
    ) -> Result<bool, TryReserveError> {
        let twin = self.surface.face(edge.face()).twins[edge.edge()];
        self.flip(edge);
        repair.suspect(edge.face())?;
        repair.suspect(twin.face())?;
        Ok(true)
    }

    fn flip(&mut self, edge: HalfEdge) {
        let twin = self.surface.face(edge.face()).twins[edge.edge()];
        self.surface.flip(edge);
        self.renew_plane(edge.face());
        self.renew_plane(twin.face());
    }

    #[inline(never)]
    fn renew_plane(&mut self, id: FaceId) {
        let face = self.surface.face_mut(id);
        face.data = self.vertices.plane(face.vertices);
    }

    /// Whether the surface is reflex at an edge between faces that turn outward.
    #[inline(never)]
    fn is_reflex(&self, edge: HalfEdge) -> bool {
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

    /// Flips a reflex edge; where that would turn a face over, an end of the edge
    /// is below the others and is taken out.
    fn make_convex(
        &mut self,
        edge: HalfEdge,
        repair: &mut Repair,
    ) -> Result<bool, TryReserveError> {
        if self.can_flip(edge) {
            let twin = self.surface.face(edge.face()).twins[edge.edge()];
            self.flip(edge);
            // The new edge is convex.
            repair.suspects.try_reserve(4)?;
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
        self.take_out(below, edge.face(), repair)
    }

    /// Whether both faces that flipping `edge` would make turn outward.
    fn can_flip(&self, edge: HalfEdge) -> bool {
        let faces = self.surface.flipped(edge);
        let [[c, _, d], _] = faces;
        c != d && faces.into_iter().all(|face| self.vertices.may_face(face))
    }

    /// Takes `vertex`, one of `face`, out of the surface and fills the hole by ears.
    fn take_out(
        &mut self,
        vertex: Vertex,
        face: FaceId,
        repair: &mut Repair,
    ) -> Result<bool, TryReserveError> {
        if vertex == ORIGIN {
            return Ok(false);
        }
        repair.rim.clear();
        repair.star.clear();
        for (id, rim) in self.surface.around(vertex, face) {
            repair.rim.try_reserve(1)?;
            repair.rim.push(rim);
            repair.star.try_reserve(1)?;
            repair.star.push(id);
        }
        if !(3..=MAX_DEGREE).contains(&repair.rim.len()) {
            return Ok(false);
        }
        // First the plan, so that nothing has changed if there is none.
        repair.ring.clear();
        repair.ring.try_reserve(repair.rim.len())?;
        repair.ring.extend_from_slice(&repair.rim);
        repair.ears.clear();
        repair.ears.try_reserve(repair.rim.len())?;
        while repair.ring.len() > 2 {
            let Some(ear) = self.ear(&repair.ring) else {
                return Ok(false);
            };
            repair.ears.push(ear);
            repair.ring.remove((ear + 1) % repair.ring.len());
        }
        for i in 0..repair.ears.len() {
            let (ear, slot) = (repair.ears[i], repair.star[i]);
            self.surface.cut_ear(&mut repair.rim, ear, slot);
            self.renew_plane(slot);
            repair.suspect(slot)?;
        }
        for &slot in &repair.star[repair.ears.len()..] {
            self.surface.free(slot)?;
        }
        Ok(true)
    }

    /// Where on a ring of vertices (the tails of `ring`) an ear can be cut off: a triangle
    /// of three successive ones that turns outward and holds no other of the ring.
    /// Where there is none, and the ring opens to the ghost faces, a ghost face.
    fn ear(&self, ring: &[Rim]) -> Option<usize> {
        let corners = |ear: usize| [0, 1, 2].map(|i| ring[(ear + i) % ring.len()].tail);
        if ring.len() == 3 {
            return self.vertices.may_face(corners(0)).then_some(0);
        }
        // Where two vertices are joined already, a second edge would be wrong.
        let is_new = |ear: usize| {
            let [tail, _, head] = corners(ear);
            !self
                .surface
                .are_joined(tail, head, ring[ear].outside.face())
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

    /// Whether the ray of `inner` pierces exactly one face. With faces that all turn
    /// outward, and ghost faces that all have that ray inside, the surface then covers
    /// every direction at most once.
    ///
    /// Also marks the points that are vertices, and frees the numbers of vertices that
    /// no face has.
    fn settle(
        &mut self,
        repair: &mut Repair,
        is_vertex: &mut [bool],
    ) -> Result<bool, TryReserveError> {
        let ray = self.vertices.inner;
        // On which sides of two planes through the ray a vertex is: a face that is all
        // on one side of either is not pierced. Roundings are far below the margin.
        let margin = self.vertices.reach * 1e-12;
        let Some(axis) = ray.try_normalize() else {
            return Ok(false);
        };
        let (e, f) = axis.any_orthonormal_pair();
        let sides = &mut repair.sides;
        sides.clear();
        sides.try_reserve(self.vertices.positions.len())?;
        sides.extend(self.vertices.positions.iter().map(|q| {
            let (x, y) = (q.dot(e), q.dot(f));
            u8::from(x > margin)
                | u8::from(x < -margin) << 1
                | u8::from(y > margin) << 2
                | u8::from(y < -margin) << 3
        }));
        const USED: u8 = 1 << 4;
        let mut pierced = 0;
        for (_, face) in self.surface.alive() {
            let [a, b, c] = face.vertices.map(|v| sides[v as usize]);
            if a & b & c & !USED == 0 && !face.vertices.contains(&ORIGIN) {
                match contains(face.vertices.map(|v| self.vertices.at(v)), ray) {
                    Some(inside) => pierced += u32::from(inside),
                    None => return Ok(false),
                }
            }
            for vertex in face.vertices {
                sides[vertex as usize] |= USED;
            }
        }
        let Vertices { points, free, .. } = &mut self.vertices;
        free.clear();
        for (vertex, (&point, &sides)) in (0..).zip(points.iter().zip(&*sides)).skip(1) {
            if sides & USED == 0 {
                free.try_reserve(1)?;
                free.push(vertex);
            } else {
                is_vertex[point as usize] = true;
            }
        }
        Ok(pierced == 1)
    }
}

impl Vertices {
    /// Whether a face does not turn outward, or a ghost face not away from `inner`.
    #[inline]
    fn is_turned(&self, face: &Face<Plane>) -> bool {
        face.data.is_exact_only() && !self.turns_right(face.vertices)
    }

    /// Whether a face of these corners would turn as it should.
    #[inline(never)]
    fn may_face(&self, corners: [Vertex; 3]) -> bool {
        !self.plane(corners).is_exact_only() || self.turns_right(corners)
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
        [[a, b], [b, c], [c, a]].into_iter().any(|[tail, head]| {
            side_of_origin(self.at(tail), self.at(head), self.at(vertex)) == Sign::Negative
        })
    }
}

impl Repair {
    /// All edges of a face are to be looked at again.
    fn suspect(&mut self, face: FaceId) -> Result<(), TryReserveError> {
        self.suspects.try_reserve(3)?;
        self.suspects
            .extend((0..3).map(|edge| HalfEdge::new(face, edge)));
        Ok(())
    }
}

/// Whether `ray` is strictly inside the cone of the corners; `None` on its border.
fn contains([a, b, c]: [DVec3; 3], ray: DVec3) -> Option<bool> {
    let sides = [(a, b), (b, c), (c, a)].map(|(tail, head)| side_of_origin(tail, head, ray));
    if sides.contains(&Sign::Negative) {
        Some(false)
    } else if sides.contains(&Sign::Zero) {
        None
    } else {
        Some(true)
    }
}
