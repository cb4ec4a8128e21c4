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
