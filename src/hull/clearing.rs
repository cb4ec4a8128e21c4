//! Clears a knot of turned faces out of a surface that is being repaired.
//!
//! Where many vertices crossed each other, no vertex can be taken out alone: the hole that it
//! leaves has turned over, too. So a larger hole is made: of a turned face and its neighbors, or of
//! all faces around its vertices. Where edges of the hole's rim cross each other, seen from the
//! viewpoint, no triangles fill it. Then the faces across these edges are added to the hole. At last
//! the vertices around it follow.

use alloc::vec::Vec;

use super::incremental::{Hull, ORIGIN, Vertices};
use super::repair::{MAX_DEGREE, Repair};
use super::topology::{FaceId, HalfEdge, Rim, Vertex};
use crate::base::allocation::{OutOfMemory, push, reserve};

/// How often the vertices around a hole are taken out, too.
const MOST_RINGS: usize = 4;
/// How many holes are tried, each larger than the one before.
const MOST_HOLES: usize = 8;
/// The most faces of a hole.
const MOST_FACES: usize = 256;

impl Hull {
    /// Takes the vertices of a face out of the surface, with as many faces around them as must
    /// follow, and fills the hole. Returns false, and changes nothing, if no such hole can be filled.
    #[cold]
    pub(super) fn clear(&mut self, face: FaceId, repair: &mut Repair) -> Result<bool, OutOfMemory> {
        repair.star.clear();
        push(&mut repair.star, face)?;
        for _ in 0..MOST_RINGS {
            if !self.widen(&mut repair.star)? {
                return Ok(false);
            }
            if self.fill_or_grow(repair)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Fills a hole of a face, of its neighbors, and of as many faces as must follow. Its vertices
    /// may stay. Returns false, and changes nothing, if no such hole can be filled.
    #[cold]
    pub(super) fn untie(&mut self, face: FaceId, repair: &mut Repair) -> Result<bool, OutOfMemory> {
        repair.star.clear();
        push(&mut repair.star, face)?;
        for twin in self.surface.face(face).twins {
            if !repair.star.contains(&twin.face()) {
                push(&mut repair.star, twin.face())?;
            }
        }
        self.fill_or_grow(repair)
    }

    /// Fills the hole `repair.star`. As long as this is not possible, because edges of its rim cross
    /// each other, the hole grows. Returns false if there is still a hole.
    #[inline(never)]
    fn fill_or_grow(&mut self, repair: &mut Repair) -> Result<bool, OutOfMemory> {
        for _ in 0..MOST_HOLES {
            // To look for faces of a hole costs less than to look for an ear.
            if !repair.spend(repair.star.len() / 2) || !self.trace(&repair.star, &mut repair.rim)? {
                return Ok(false);
            }
            if self.fill(repair)? {
                return Ok(true);
            }
            if !self.grow(repair)? {
                return Ok(false);
            }
        }
        Ok(false)
    }

    /// Adds the faces across those edges of the rim that prevent that the hole is filled: edges that
    /// cross each other, and edges of faces that have turned over. Returns false if there are none.
    fn grow(&self, repair: &mut Repair) -> Result<bool, OutOfMemory> {
        let Repair { rim, star, .. } = repair;
        if rim.len() > MAX_DEGREE {
            return Ok(false);
        }
        let before = star.len();
        for edge in &*rim {
            let id = edge.outside.face();
            let crosses = |other: &Rim| self.vertices.cross(edge, other);
            let prevents =
                self.vertices.is_turned(self.surface.face(id)) || rim.iter().any(crosses);
            if prevents && !star.contains(&id) {
                push(star, id)?;
            }
        }
        Ok(star.len() > before && star.len() <= MOST_FACES)
    }

    /// Adds all faces around the vertices of a hole to it. Returns false if they are too many.
    fn widen(&self, hole: &mut Vec<FaceId>) -> Result<bool, OutOfMemory> {
        for i in 0..hole.len() {
            let id = hole[i];
            for vertex in self.surface.face(id).vertices {
                if vertex == ORIGIN {
                    continue;
                }
                for (around, _) in self.surface.around(vertex, id) {
                    if !hole.contains(&around) {
                        push(hole, around)?;
                    }
                    if hole.len() > MOST_FACES {
                        return Ok(false);
                    }
                }
            }
        }
        Ok(true)
    }

    /// Lists the edges around a hole, counter-clockwise. Returns false unless they are one cycle
    /// that passes no vertex twice, with the origin outside or on it.
    fn trace(&self, hole: &[FaceId], rim: &mut Vec<Rim>) -> Result<bool, OutOfMemory> {
        // A hole is small, and sorting would make the wasm larger.
        let is_inside = |edge: HalfEdge| hole.contains(&self.surface.twin(edge).face());
        let mut first = None;
        let mut count = 0;
        for &face in hole {
            for edge in (0..3).map(|edge| HalfEdge::new(face, edge)) {
                if !is_inside(edge) {
                    first = Some(edge);
                    count += 1;
                }
            }
        }
        let Some(first) = first else {
            return Ok(false);
        };
        rim.clear();
        reserve(rim, count)?;
        let mut edge = first;
        loop {
            let [tail, head, _] = self.surface.face(edge.face()).vertices_from(edge.edge());
            if rim.len() == count || rim.iter().any(|passed| passed.tail == tail) {
                return Ok(false);
            }
            let outside = self.surface.twin(edge);
            rim.push(Rim {
                tail,
                head,
                outside,
            });
            edge = edge.next();
            while is_inside(edge) {
                edge = self.surface.twin(edge).next();
            }
            if edge == first {
                break;
            }
        }
        let meets = |vertex: Vertex| rim.iter().any(|edge| edge.tail == vertex);
        let holds = |&face: &FaceId| self.surface.face(face).vertices.contains(&ORIGIN);
        Ok(rim.len() == count && (meets(ORIGIN) || !hole.iter().any(holds)))
    }
}

impl Vertices {
    /// Whether two edges without a common vertex cross each other, seen from the viewpoint.
    fn cross(&self, first: &Rim, second: &Rim) -> bool {
        let [a, b, c, d] = [first.tail, first.head, second.tail, second.head];
        if [a, b].contains(&c) || [a, b].contains(&d) || [a, b, c, d].contains(&ORIGIN) {
            return false;
        }
        let side = self.is_left(a, b, c);
        // Edges on opposite sides of the viewpoint differ in the last comparison.
        side != self.is_left(a, b, d)
            && side == self.is_left(c, d, b)
            && side != self.is_left(c, d, a)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::base::random::Random;
    use crate::cloud::points::Points;
    use crate::flip::inversion::Flip;
    use crate::flip::kernel::Kernel;
    use crate::hull::dual_plane::Plane;
    use crate::hull::topology::Face;
    use crate::hull::{Memory, mark_visible};

    fn hull() -> Hull {
        let points = Points::Double(Random::new(51).bumpy(800));
        let flip = Flip::new([0.0, 0.5, 2.5], Kernel::Spherical { radius: 100.0 });
        let mut memory = Memory::default();
        mark_visible(&points, &[], &flip, None, &mut memory).unwrap();
        memory.hull
    }

    /// The faces around a vertex.
    fn star(hull: &Hull, vertex: Vertex) -> Vec<FaceId> {
        let mut faces = hull.surface.alive();
        let (start, _) = faces
            .find(|(_, face)| face.vertices.contains(&vertex))
            .unwrap();
        hull.surface
            .around(vertex, start)
            .map(|(id, _)| id)
            .collect()
    }

    /// The vertices of faces without those in `inner`.
    fn corners_but(hull: &Hull, faces: &[FaceId], inner: Vertex) -> Vec<Vertex> {
        let all = faces.iter().flat_map(|&id| hull.surface.face(id).vertices);
        all.filter(|&v| v != inner).collect()
    }

    /// Whether the arcs of two edges meet in a direction strictly inside both.
    fn meet([a, b, c, d]: [DVec3; 4]) -> bool {
        let (first, second) = (a.cross(b), c.cross(d));
        let between = |normal: DVec3, tail: DVec3, head: DVec3, u: DVec3| {
            normal.dot(tail.cross(u)) > 0.0 && normal.dot(u.cross(head)) > 0.0
        };
        let common = first.cross(second);
        [common, -common]
            .into_iter()
            .any(|u| between(first, a, b, u) && between(second, c, d, u))
    }

    #[test]
    fn edges_cross_where_their_arcs_meet() {
        let mut random = Random::new(52);
        let edge = |tail, head| Rim {
            tail,
            head,
            outside: HalfEdge::new(0, 0),
        };
        let [mut crossed, mut opposite] = [0; 2];
        for _ in 0..4000 {
            let corners: [DVec3; 4] = core::array::from_fn(|_| random.direction());
            let vertices = Vertices {
                positions: [DVec3::ZERO].into_iter().chain(corners).collect(),
                ..Vertices::default()
            };
            let expected = meet(corners);
            assert_eq!(vertices.cross(&edge(1, 2), &edge(3, 4)), expected);
            assert_eq!(vertices.cross(&edge(4, 3), &edge(1, 2)), expected);
            // Edges that share a vertex, or have the viewpoint as an end, do not cross.
            assert!(!vertices.cross(&edge(1, 2), &edge(2, 3)));
            assert!(!vertices.cross(&edge(1, 2), &edge(3, 1)));
            assert!(!vertices.cross(&edge(1, 2), &edge(3, ORIGIN)));
            let [a, b, c, d] = corners;
            crossed += u32::from(expected);
            opposite += u32::from(meet([a, b, -c, -d]));
        }
        assert!(crossed > 300 && opposite > 300, "{crossed}, {opposite}");
    }

    #[test]
    fn only_simple_holes_have_a_rim() {
        let hull = hull();
        let mut rim = Vec::new();
        let mut vertices = corners_but(&hull, &star(&hull, ORIGIN), ORIGIN);
        vertices.sort_unstable();
        vertices.dedup();
        let used = |(_, face): (FaceId, &Face<Plane>)| face.vertices;
        let mut apart: Vec<Vertex> = hull.surface.alive().flat_map(used).collect();
        apart.sort_unstable();
        apart.dedup();
        apart.retain(|v| *v != ORIGIN && !vertices.contains(v));

        // The origin may be on the rim, but not inside.
        assert!(!hull.trace(&star(&hull, ORIGIN), &mut rim).unwrap());
        for &vertex in &vertices {
            let hole = star(&hull, vertex);
            assert!(hull.trace(&hole, &mut rim).unwrap());
            assert_eq!(rim.len(), hole.len());
            assert!(rim.iter().any(|edge| edge.tail == ORIGIN));
        }
        let [mut rings, mut knots] = [0; 2];
        for &vertex in &apart {
            let inner = star(&hull, vertex);
            assert!(hull.trace(&inner, &mut rim).unwrap());
            let mut link = corners_but(&hull, &inner, vertex);
            link.sort_unstable();
            link.dedup();
            if link.iter().any(|v| !apart.contains(v)) {
                continue;
            }
            // A ring of faces has two rims.
            let mut ring: Vec<FaceId> = link.iter().flat_map(|&v| star(&hull, v)).collect();
            ring.sort_unstable();
            ring.dedup();
            ring.retain(|id| !inner.contains(id));
            assert!(!hull.trace(&ring, &mut rim).unwrap());
            rings += 1;
            // A ring whose ends meet in a vertex has one rim, which passes this vertex twice.
            let end = link[0];
            let mut outside = star(&hull, end);
            outside.retain(|id| !inner.contains(id));
            let is_end = |id: &FaceId| {
                let corners = hull.surface.face(*id).vertices;
                corners.iter().filter(|v| link.contains(v)).count() > 1
            };
            if outside.iter().filter(|id| is_end(id)).count() == 2 && outside.len() > 3 {
                ring.retain(|id| !outside.contains(id) || is_end(id));
                assert!(!hull.trace(&ring, &mut rim).unwrap());
                knots += 1;
            }
        }
        assert!(rings > 10 && knots > 5, "{rings} rings, {knots} knots");
    }

    #[test]
    fn cleared_holes_cost_the_squares_of_their_sizes() {
        let mut hull = hull();
        let mut repair = Repair::default();
        let mut cleared = 0;
        for face in 0..hull.surface.slots() as FaceId {
            let corners = hull.corners(face);
            if corners.is_none_or(|corners| corners.contains(&ORIGIN)) {
                continue;
            }
            let mut hole = Vec::from([face]);
            hull.widen(&mut hole).unwrap();
            let is_hole = hull.trace(&hole, &mut repair.rim).unwrap();
            let (faces, edges) = (hole.len(), repair.rim.len());
            repair.effort = 10_000;
            if is_hole && hull.clear(face, &mut repair).unwrap() && repair.star.len() == faces {
                let effort = (faces / 2).pow(2) + edges.pow(2);
                assert_eq!(repair.effort, 10_000 - effort);
                cleared += 1;
            }
        }
        assert!(cleared > 10, "{cleared}");
    }
}
