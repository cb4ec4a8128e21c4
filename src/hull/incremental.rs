//! The exact hull in space, point by point, with the viewpoint as ghost vertex.
//!
//! K = conv({q} ∪ {0}) is star-shaped around the viewpoint, so its outer faces
//! triangulate directions: a point is hidden once it lies inside the face its
//! ray pierces, and otherwise sees the faces that it will replace. Faces that
//! hold the origin ("ghost faces") close the hull where no point is seen. They
//! vanish when the viewpoint is inside the cloud, so inside and outside are one
//! algorithm.
//!
//! Every decision is a sign: first of a rounded dual plane with a proved bound
//! of its error, then exact (`predicates`).

mod triangles;

use alloc::collections::TryReserveError;
use alloc::vec::Vec;
use glam::DVec3;

use super::topology::{Face, FaceId, HalfEdge, Surface, Vertex};
use crate::error::Error;
use crate::predicates::{Sign, side_of_face, side_of_origin};

/// Steps of a walk before it is worth looking for a better start.
const PATIENCE: usize = 64;

/// The ghost vertex.
const ORIGIN: Vertex = 0;

/// A face's dual plane: `m·x = 1` on it, `m·x > 1` outside.
///
/// With u = a − p, w = b − p, n = u × w and D = n·p, m is n/D. In units of
/// ε = 2⁻⁵³ and with |p|, |q| ≤ L/2 the rounded value differs from the true
/// n·(q − p)/D by at most, to first order and with κ = ½(|u|² + |w|²)·L/D:
///
/// - n: 4√2·|u||w|, which shifts n·q/D by 2.9 κ;
/// - D: (4√2 + 3)·|u||w||p|, which shifts m·q by 4.4 κ·(m·q);
/// - the division and the sum m·q − 1: 5·|m||q| + 1 ≤ 2.5 κ + 1.
///
/// At m·q near 1 that is below 10 ε (1 + κ); `error` is twice that. Farther
/// from the plane the error grows with |m·q|, but by less than 10⁻⁵ of it, so
/// the sign stays right, also of the difference of two neighbors' m·q while one
/// of them is between 0 and 1. L is [`Flip::reach`].
///
/// [`Flip::reach`]: crate::inversion::Flip::reach
#[derive(Clone, Copy)]
struct Plane {
    m: DVec3,
    /// Bound of the error of `m·q − 1`; infinite where only exact signs count.
    error: f64,
}

impl Plane {
    /// A plane that decides nothing by itself: ghost faces, faces seen edge-on.
    const EXACT_ONLY: Self = Self {
        m: DVec3::ZERO,
        error: f64::INFINITY,
    };

    fn through(a: DVec3, b: DVec3, p: DVec3, reach: f64) -> Self {
        const ROUNDING: f64 = f64::EPSILON / 2.0;
        const MAX_CONDITION: f64 = 1e10;
        // Above this no product in `n` that matters has underflowed.
        const MIN_VOLUME: f64 = 1e-200;
        let u = a - p;
        let w = b - p;
        let n = u.cross(w);
        let volume = n.dot(p);
        let inverse = 1.0 / volume;
        let condition = 0.5 * (u.length_squared() + w.length_squared()) * reach * inverse;
        // Written so that a NaN is refused, too.
        if volume > MIN_VOLUME && volume < f64::MAX && condition < MAX_CONDITION {
            Self {
                m: n * inverse,
                error: 20.0 * ROUNDING * (1.0 + condition),
            }
        } else {
            Self::EXACT_ONLY
        }
    }

    fn is_exact_only(&self) -> bool {
        self.error == f64::INFINITY
    }
}

/// Where a flipped point lies relative to the hull.
enum Location {
    /// Strictly outside this face.
    Outside(FaceId),
    /// Exactly on the outer boundary.
    Boundary(FaceId),
    /// In K, and K goes on beyond it: hidden, now and for every larger K.
    Inside(FaceId),
}

/// Marks the visible points among those of `order`. `corners` is the first
/// tetrahedron's outer face, counter-clockwise seen from outside. The outer faces go
/// to `triangles`, if they are wanted.
pub(super) fn mark_visible(
    order: impl Iterator<Item = u32>,
    flipped: &impl Fn(u32) -> Option<DVec3>,
    reach: f64,
    corners: [u32; 3],
    visible: &mut [bool],
    triangles: Option<&mut Vec<[u32; 3]>>,
) -> Result<(), Error> {
    let mut hull = Hull::new(corners, flipped, reach, visible.len())?;
    // A point found exactly on the boundary is visible only if it still is
    // when the hull is complete.
    let mut on_boundary: Vec<u32> = Vec::new();
    let mut hint = 0;
    for index in order {
        let Some(q) = flipped(index) else {
            visible[index as usize] = true;
            continue;
        };
        hint = match hull.locate(q, hint) {
            Location::Outside(face) => hull.insert(index, q, face)?,
            Location::Boundary(face) => {
                on_boundary.try_reserve(1)?;
                on_boundary.push(index);
                face
            }
            Location::Inside(face) => face,
        };
    }
    hull.mark_outer_vertices(visible);
    for &index in &on_boundary {
        let Some(q) = flipped(index) else { continue };
        if let Location::Boundary(face) = hull.locate(q, hint) {
            visible[index as usize] = true;
            hint = face;
        }
    }
    if let Some(triangles) = triangles {
        *triangles = hull.outer_triangles(&on_boundary, flipped, hint)?;
    }
    Ok(())
}

struct Hull {
    surface: Surface<Plane>,
    vertices: Vertices,
}

struct Vertices {
    /// Flipped positions; the origin comes first.
    positions: Vec<DVec3>,
    /// Which point of the cloud each one is; unused for the origin.
    points: Vec<u32>,
    reach: f64,
}

impl Vertices {
    fn reserve(&mut self, more: usize) -> Result<(), TryReserveError> {
        self.positions.try_reserve(more)?;
        self.points.try_reserve(more)
    }

    #[inline]
    fn plane(&self, [a, b, c]: [Vertex; 3]) -> Plane {
        if a == ORIGIN || b == ORIGIN || c == ORIGIN {
            return Plane::EXACT_ONLY;
        }
        Plane::through(self.at(a), self.at(b), self.at(c), self.reach)
    }

    #[inline]
    fn at(&self, vertex: Vertex) -> DVec3 {
        self.positions[vertex as usize]
    }

    /// Which side of `face` the point `q` is on: positive is outside.
    #[inline]
    fn side(&self, face: &Face<Plane>, q: DVec3) -> Sign {
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
    fn is_beyond(&self, face: &Face<Plane>, edge: usize, q: DVec3) -> bool {
        let tail = self.at(face.vertices[edge]);
        let head = self.at(face.vertices[(edge + 1) % 3]);
        side_of_origin(tail, head, q) == Sign::Negative
    }

    /// Whether the plane of `face` leaves the origin strictly inside: not a
    /// ghost face and not seen edge-on.
    fn is_outer(&self, face: &Face<Plane>) -> bool {
        if !face.data.is_exact_only() {
            return true;
        }
        let [a, b, c] = face.vertices.map(|v| self.at(v));
        side_of_origin(a, b, c) == Sign::Positive
    }
}

impl Hull {
    /// The first tetrahedron, with room, if it can be had, for a hull that half of
    /// `count` points are on: growing later would hold two copies for a moment.
    fn new(
        corners: [u32; 3],
        flipped: &impl Fn(u32) -> Option<DVec3>,
        reach: f64,
        count: usize,
    ) -> Result<Self, Error> {
        let mut vertices = Vertices {
            positions: Vec::new(),
            points: Vec::new(),
            reach,
        };
        vertices
            .reserve(4 + count / 2)
            .or_else(|_| vertices.reserve(4))?;
        vertices.positions.push(DVec3::ZERO);
        vertices.points.push(u32::MAX);
        for corner in corners {
            if let Some(q) = flipped(corner) {
                vertices.positions.push(q);
                vertices.points.push(corner);
            }
        }
        let mut surface = Surface::tetrahedron(ORIGIN, [1, 2, 3], |v| vertices.plane(v));
        surface.reserve(count);
        Ok(Self { surface, vertices })
    }

    /// Walks from `hint`, an outer face, towards the face that the ray of `q`
    /// pierces, by way of outer faces only: beyond a ghost or edge-on face, which
    /// side of an edge is farther would have no meaning.
    ///
    /// Two neighbors' dual planes agree on their edge, so which of m·q is the
    /// larger tells on which side of that edge the ray passes, and the largest
    /// m·q of all belongs to the face it pierces. If that one has q inside, all have.
    fn locate(&self, q: DVec3, hint: FaceId) -> Location {
        let mut id = hint;
        let mut height = self.surface.face(id).data.m.dot(q);
        for step in 0..PATIENCE + self.surface.slots() {
            if step % PATIENCE == PATIENCE - 1 {
                id = self.jump(id, q, step);
                height = self.surface.face(id).data.m.dot(q);
            }
            let face = self.surface.face(id);
            let error = face.data.error;
            if height - 1.0 > error {
                return Location::Outside(id);
            }
            let mut steepest = id;
            let mut steepest_height = f64::NEG_INFINITY;
            let mut steepest_error = 0.0;
            let mut bound = f64::NEG_INFINITY;
            for twin in face.twins {
                let neighbor = &self.surface.face(twin.face()).data;
                let h = neighbor.m.dot(q);
                bound = bound.max(h + neighbor.error);
                if h > steepest_height {
                    steepest = twin.face();
                    steepest_height = h;
                    steepest_error = neighbor.error;
                }
            }
            if steepest_height - height > steepest_error + error {
                id = steepest;
                height = steepest_height;
            } else if height > 0.0 && bound < height - error {
                // All three neighbors are certainly lower.
                return self.decide(id, q);
            } else if let Some(twin) = self.crossed_edge(face, q, step) {
                id = twin.face();
                let face = self.surface.face(id);
                // The plane of a ghost or edge-on face is the plane of this
                // edge and the origin, and q lies strictly beyond it.
                if !self.vertices.is_outer(face) {
                    return Location::Outside(id);
                }
                height = face.data.m.dot(q);
            } else {
                return self.decide(id, q);
            }
        }
        self.search(q, id)
    }

    /// Exactly, for near-ties: an edge of `face` beyond which the ray of `q` passes.
    /// Which edge is tried first changes from step to step, or a walk could go
    /// round in a circle of coplanar faces.
    #[cold]
    fn crossed_edge(&self, face: &Face<Plane>, q: DVec3, step: usize) -> Option<HalfEdge> {
        // The high bits of a product with the golden ratio look random.
        let first = (step as u32).wrapping_mul(0x9e37_79b9) >> 16;
        (first..first + 3)
            .map(|edge| (edge % 3) as usize)
            .find(|&edge| self.vertices.is_beyond(face, edge, q))
            .map(|edge| face.twins[edge])
    }

    /// A better place to walk on from than `id`, after many steps: walks are short
    /// but for those around a vertex of very many faces. Looks at as many faces as
    /// a walk between two of them may need steps.
    #[cold]
    fn jump(&self, id: FaceId, q: DVec3, step: usize) -> FaceId {
        let slots = self.surface.slots();
        let stride = slots.isqrt().max(1);
        let mut best = id;
        let mut best_height = self.surface.face(id).data.m.dot(q);
        for slot in (step % stride..slots).step_by(stride) {
            let face = self.surface.face(slot as FaceId);
            let height = face.data.m.dot(q);
            if height > best_height && face.is_alive() && !face.data.is_exact_only() {
                best = slot as FaceId;
                best_height = height;
            }
        }
        best
    }

    /// Decides for the outer face that the ray of `q` pierces.
    fn decide(&self, id: FaceId, q: DVec3) -> Location {
        let face = self.surface.face(id);
        match self.vertices.side(face, q) {
            Sign::Positive => Location::Outside(id),
            Sign::Zero => Location::Boundary(id),
            Sign::Negative => Location::Inside(id),
        }
    }

    /// The answer by looking at every face, for the rare walk that ends nowhere.
    #[cold]
    fn search(&self, q: DVec3, hint: FaceId) -> Location {
        let mut location = Location::Inside(hint);
        for (id, face) in self.surface.alive() {
            match self.vertices.side(face, q) {
                Sign::Positive => return Location::Outside(id),
                Sign::Zero if self.vertices.is_outer(face) => location = Location::Boundary(id),
                Sign::Zero | Sign::Negative => {}
            }
        }
        location
    }

    /// Makes `q`, strictly outside face `start`, a vertex; returns one of its faces
    /// that is outer. There is one, because the ray of a new vertex ends at it.
    fn insert(&mut self, point: u32, q: DVec3, start: FaceId) -> Result<FaceId, Error> {
        let vertex = self.vertices.positions.len() as Vertex;
        self.vertices.reserve(1)?;
        self.vertices.positions.push(q);
        self.vertices.points.push(point);
        let vertices = &self.vertices;
        self.surface.insert(
            vertex,
            start,
            |face| vertices.side(face, q) == Sign::Positive,
            |corners| vertices.plane(corners),
        )?;
        let is_outer = |&id: &FaceId| self.vertices.is_outer(self.surface.face(id));
        let outer = self.surface.fan().iter().rev().copied().find(is_outer);
        Ok(outer.expect("a new vertex is on the outer boundary"))
    }

    /// A vertex is visible when one of its faces has the origin strictly inside;
    /// on ghost and edge-on faces alone, its ray stays in K beyond it.
    fn mark_outer_vertices(&self, visible: &mut [bool]) {
        for (_, face) in self.surface.alive() {
            if self.vertices.is_outer(face) {
                for vertex in face.vertices {
                    visible[self.vertices.points[vertex as usize] as usize] = true;
                }
            }
        }
    }
}
