//! The exact hull in space, point by point, with the viewpoint as ghost vertex.
//!
//! K = conv({q} ∪ {0}) is star-shaped around the viewpoint, so its outer faces
//! triangulate the directions. A point is hidden as soon as it lies inside the face that
//! its ray pierces. Otherwise it sees the faces that it will replace. Faces that hold the
//! origin ("ghost faces") close the hull where no point is seen. They vanish when the
//! viewpoint is inside the cloud. So one algorithm serves viewpoints inside and outside.
//!
//! Every decision is a sign. A rounded dual plane with a proved bound of its error gives the
//! sign first (`plane`). In doubt, the sign is computed exactly (`predicates`).

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, push};
use crate::base::real::one_by_one;
use crate::hull::dual_plane::{Plane, Spoke};
use crate::hull::predicates::{Sign, side_of_face, side_of_origin};
use crate::hull::topology::{Face, FaceId, Surface, Vertex};

/// The ghost vertex.
pub(super) const ORIGIN: Vertex = 0;

/// A hull under construction, or the last hull, which is kept for its memory.
#[derive(Default)]
pub(super) struct Hull {
    pub surface: Surface<Plane>,
    pub vertices: Vertices,
}

#[derive(Default)]
pub(super) struct Vertices {
    /// Flipped positions; the origin comes first.
    pub positions: Vec<DVec3>,
    /// The point of the cloud that each vertex is; unused for the origin.
    pub points: Vec<u32>,
    /// [`Flip::reach`](crate::flip::inversion::Flip::reach).
    pub reach: f64,
}

impl Vertices {
    /// Gives a vertex number to the point `point`, which is flipped to `q`.
    #[inline]
    pub(super) fn add(&mut self, point: u32, q: DVec3) -> Result<Vertex, OutOfMemory> {
        push(&mut self.positions, one_by_one(q))?;
        push(&mut self.points, point)?;
        Ok((self.positions.len() - 1) as Vertex)
    }

    pub(super) fn plane(&self, [a, b, c]: [Vertex; 3]) -> Plane {
        if a == ORIGIN || b == ORIGIN || c == ORIGIN {
            return Plane::EXACT_ONLY;
        }
        Plane::through(self.at(a), self.at(b), self.at(c), self.reach)
    }

    #[inline]
    pub(super) fn at(&self, vertex: Vertex) -> DVec3 {
        self.positions[vertex as usize]
    }

    /// Which side of `face` the point `q` is on: positive is outside.
    #[inline]
    pub(super) fn side(&self, face: &Face<Plane>, q: DVec3) -> Sign {
        let plane = &face.data;
        let above = plane.m.dot(q) - 1.0;
        if above > plane.error {
            Sign::Positive
        } else if above < -plane.error {
            Sign::Negative
        } else {
            self.exact_side(face, q)
        }
    }

    #[cold]
    fn exact_side(&self, face: &Face<Plane>, q: DVec3) -> Sign {
        let [a, b, c] = face.vertices.map(|v| self.at(v));
        side_of_face(a, b, c, q)
    }

    /// Whether the ray of `q` passes strictly beyond edge `edge` of an outer face.
    #[inline]
    pub(super) fn is_beyond(&self, face: &Face<Plane>, edge: usize, q: DVec3) -> bool {
        let tail = self.at(face.vertices[edge]);
        let head = self.at(face.vertices[(edge + 1) % 3]);
        side_of_origin(tail, head, q) == Sign::Negative
    }

    /// Whether the plane of `face` leaves the origin strictly inside: not a
    /// ghost face and not seen edge-on.
    #[inline]
    pub(super) fn is_outer(&self, face: &Face<Plane>) -> bool {
        !face.data.is_exact_only() || self.turns_outward(face.vertices)
    }

    /// Whether three vertices are counter-clockwise, seen from outside towards the origin. The
    /// answer is exact.
    #[cold]
    fn turns_outward(&self, vertices: [Vertex; 3]) -> bool {
        let [a, b, c] = vertices.map(|v| self.at(v));
        side_of_origin(a, b, c) == Sign::Positive
    }
}

impl Hull {
    /// Becomes the first tetrahedron: the origin and `corners`, counter-clockwise
    /// seen from outside.
    pub(super) fn start(
        &mut self,
        corners: [(u32, DVec3); 3],
        reach: f64,
    ) -> Result<(), OutOfMemory> {
        let vertices = &mut self.vertices;
        vertices.positions.clear();
        vertices.points.clear();
        vertices.reach = reach;
        vertices.add(u32::MAX, DVec3::ZERO)?;
        for (point, q) in corners {
            vertices.add(point, q)?;
        }
        self.surface
            .start(ORIGIN, [1, 2, 3], |corners| vertices.plane(corners))?;
        Ok(())
    }

    /// Makes room for `vertices` vertices and `faces` faces, if there is enough memory. A list that grows later needs
    /// memory for two copies for a moment.
    pub(super) fn reserve(&mut self, vertices: usize, faces: usize) {
        let more = vertices.saturating_sub(self.vertices.points.len());
        let _ = self.vertices.positions.try_reserve_exact(more);
        let _ = self.vertices.points.try_reserve_exact(more);
        self.surface.reserve(faces);
    }

    /// Makes a vertex of `q`, which is strictly outside of face `start`. Returns an outer face
    /// of this vertex. There is one, because the ray of a new vertex leaves K there.
    pub(super) fn insert(
        &mut self,
        point: u32,
        q: DVec3,
        start: FaceId,
    ) -> Result<FaceId, OutOfMemory> {
        let vertex = self.vertices.add(point, q)?;
        let vertices = &self.vertices;
        self.surface
            .find_cavity(start, |face| vertices.side(face, q) == Sign::Positive)?;
        self.fill_cavity(vertex)
    }

    /// The same, not inlined, for callers that run rarely.
    #[inline(never)]
    pub(super) fn insert_out_of_line(
        &mut self,
        point: u32,
        q: DVec3,
        start: FaceId,
    ) -> Result<FaceId, OutOfMemory> {
        self.insert(point, q, start)
    }

    /// Joins a new vertex to the horizon of the open cavity; returns an outer face of it.
    #[inline(never)]
    pub(super) fn fill_cavity(&mut self, vertex: Vertex) -> Result<FaceId, OutOfMemory> {
        let vertices = &self.vertices;
        let (apex, reach) = (vertices.at(vertex), vertices.reach);
        let spoke = |end| match end {
            ORIGIN => Spoke::NONE,
            end => Spoke::new(vertices.at(end), apex),
        };
        self.surface.fill_cavity(vertex, spoke, |tail, head| {
            Plane::between(tail, head, apex, reach)
        })?;
        let is_outer = |&id: &FaceId| self.vertices.is_outer(self.surface.face(id));
        let outer = self.surface.fan().iter().rev().copied().find(is_outer);
        Ok(outer.expect("a new vertex is on the outer boundary"))
    }

    /// Any outer face; there is one while there is a hull.
    pub(super) fn outer_face(&self) -> Option<FaceId> {
        self.surface
            .alive()
            .find(|(_, face)| self.vertices.is_outer(face))
            .map(|(id, _)| id)
    }

    /// Marks the visible vertices. A vertex is visible when one of its faces is outer. If all
    /// its faces are ghost or edge-on faces, its ray stays in K beyond it.
    pub(super) fn mark_outer_vertices(&self, visible: &mut [bool]) {
        for (_, face) in self.surface.alive() {
            if self.vertices.is_outer(face) {
                for vertex in face.vertices {
                    visible[self.vertices.points[vertex as usize] as usize] = true;
                }
            }
        }
    }

    /// Whether a walk can start at this face.
    #[inline]
    pub(super) fn is_sound(&self, id: FaceId) -> bool {
        let face = self.surface.face(id);
        face.is_alive() && !face.data.is_exact_only()
    }

    /// How many vertex numbers were ever given. The origin has the first number.
    pub(super) fn vertex_count(&self) -> usize {
        self.vertices.points.len()
    }

    /// The point of the cloud that a vertex is. The vertex must not be the origin.
    pub(super) fn point(&self, vertex: Vertex) -> u32 {
        self.vertices.points[vertex as usize]
    }

    /// The corners of a face; `None` for a number that the surface does not use.
    #[inline]
    pub(super) fn corners(&self, id: FaceId) -> Option<[Vertex; 3]> {
        let face = self.surface.face(id);
        face.is_alive().then_some(face.vertices)
    }

    /// Whether a face of the surface is an outer one.
    #[inline]
    pub(super) fn is_outer(&self, id: FaceId) -> bool {
        let face = self.surface.face(id);
        !face.vertices.contains(&ORIGIN) && self.vertices.is_outer(face)
    }

    /// The dual plane m of a face, and a limit: a point with m·q below it is strictly inside.
    #[inline]
    pub(super) fn support(&self, id: FaceId) -> (DVec3, f64) {
        let Plane { m, error } = self.surface.face(id).data;
        (m, 1.0 - error)
    }
}
