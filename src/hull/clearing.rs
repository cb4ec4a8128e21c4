//! Clears a knot of turned faces out of a surface that is being repaired.
//!
//! Where many vertices crossed each other, no vertex can be taken out alone: the hole that it
//! leaves has turned over, too. So all vertices of a turned face are taken out at once. If their
//! hole cannot be filled either, the vertices around it follow.

use alloc::vec::Vec;

use super::incremental::{Hull, ORIGIN};
use super::repair::Repair;
use super::topology::{FaceId, HalfEdge, Rim, Vertex};
use crate::base::allocation::{OutOfMemory, push, reserve};

/// How often the vertices around a hole are taken out, too.
const MOST_RINGS: usize = 4;
/// The most faces of a hole.
const MOST_FACES: usize = 256;

impl Hull {
    /// Takes the vertices of a face out of the surface, with as many around them as must follow,
    /// and fills the hole. Returns false, and changes nothing, if no such hole can be filled.
    #[cold]
    pub(super) fn clear(&mut self, face: FaceId, repair: &mut Repair) -> Result<bool, OutOfMemory> {
        repair.star.clear();
        push(&mut repair.star, face)?;
        for _ in 0..MOST_RINGS {
            // To look for faces of a hole costs less than to look for an ear.
            if !self.widen(&mut repair.star)? || !repair.spend(repair.star.len() / 2) {
                return Ok(false);
            }
            if self.trace(&repair.star, &mut repair.rim)? && self.fill(repair)? {
                return Ok(true);
            }
        }
        Ok(false)
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

#[cfg(test)]
mod tests {
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
