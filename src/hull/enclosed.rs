//! Which of a sector's faces no far point can see, proved with a few of them.
//!
//! The faces of a hull that a point sees are connected across edges, as the cavity of an
//! insertion is. If the point's ray pierces an outer face, the point sees this face, or it sees
//! none. Otherwise it sees a face that is not outer. So the faces that far points can see are
//! reached, across edges, from faces in the directions of far points and from faces that are not
//! outer. A *ring* of faces that no far point sees stops this. What lies behind the ring is not
//! seen either.
//!
//! A ring face has own vertices only. It is *clear*: no far point is seen in its directions. So all
//! faces in the directions of far points are reached: a line of such directions leads to them, from
//! the middle of each cap that lies beyond a side of the sector's cell.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled, push};
use crate::base::sort::sort_keyed;
use crate::hull::incremental::ORIGIN;
use crate::hull::locate::Location;
#[cfg(debug_assertions)]
use crate::hull::predicates::Sign;
use crate::hull::share::Share;
use crate::hull::topology::FaceId;

impl Share<'_> {
    /// Marks the own vertices of faces that no far point can see, because a closed ring of faces
    /// around them is proved not to be seen. Returns all other faces with own vertices.
    #[inline(never)]
    pub(super) fn mark_enclosed(&mut self) -> Result<Vec<FaceId>, OutOfMemory> {
        let slots = self.hull.surface.slots();
        let mut is_reached: Vec<bool> = filled(slots, false)?;
        let mut reached = self.outside()?;
        if reached.is_empty() {
            // In doubt, all faces are asked about, one by one.
            is_reached.fill(true);
        }
        for &id in &reached {
            is_reached[id as usize] = true;
        }
        let mut ring: Vec<FaceId> = Vec::new();
        let mut met: Vec<(u64, FaceId)> = Vec::new();
        while !reached.is_empty() {
            met.clear();
            while let Some(id) = reached.pop() {
                for twin in self.hull.surface.face(id).twins {
                    let next = twin.face();
                    if !core::mem::replace(&mut is_reached[next as usize], true) {
                        if self.is_clear(next) {
                            let [first, ..] = self.hull.surface.face(next).vertices;
                            push(&mut met, (u64::from(self.hull.point(first)), next))?;
                        } else {
                            push(&mut reached, next)?;
                        }
                    }
                }
            }
            // Neighbors are asked about one after another, see `Far`.
            sort_keyed(&mut met);
            for &(_, id) in &met {
                let list = match self.in_the_way(id)? {
                    Some(_) => &mut reached,
                    None => &mut ring,
                };
                push(list, id)?;
            }
        }
        for id in ring {
            is_reached[id as usize] = false;
        }
        let mut open: Vec<FaceId> = Vec::new();
        for id in 0..slots as FaceId {
            let Some(corners) = self.hull.corners(id) else {
                continue;
            };
            if !corners.iter().any(|&v| self.open_vertices[v as usize]) {
                continue;
            }
            if is_reached[id as usize] || !self.hull.is_outer(id) {
                push(&mut open, id)?;
            } else {
                #[cfg(debug_assertions)]
                self.assert_unseen(id);
                self.mark(id);
            }
        }
        Ok(open)
    }

    /// Whether a face is one of own vertices, an outer face, and no far point is seen in its
    /// directions.
    pub(super) fn is_clear(&self, id: FaceId) -> bool {
        let face = self.hull.surface.face(id);
        let is_own = face
            .vertices
            .iter()
            .all(|&v| self.open_vertices[v as usize]);
        is_own && self.hull.is_sound(id) && {
            let points = face.vertices.map(|v| self.hull.point(v));
            let corners = face.vertices.map(|v| self.hull.vertices.at(v));
            self.division.is_clear(points, corners)
        }
    }

    /// The ghost faces, and a face in each part of the directions where far points may be seen.
    /// Empty if such a face is in doubt.
    pub(super) fn outside(&self) -> Result<Vec<FaceId>, OutOfMemory> {
        let mut faces = Vec::new();
        let is_ghost = |id: &FaceId| {
            let corners = self.hull.corners(*id);
            corners.is_some_and(|corners| corners.contains(&ORIGIN))
        };
        for id in (0..self.hull.surface.slots() as FaceId).filter(is_ghost) {
            push(&mut faces, id)?;
        }
        for q in self.division.outside() {
            match self.hull.locate(q, self.hint) {
                Location::Inside(id) if self.hull.pierces(id, q) => push(&mut faces, id)?,
                Location::Outside(id) if !self.hull.is_outer(id) => {}
                _ => return Ok(Vec::new()),
            }
        }
        Ok(faces)
    }

    /// Panics if a far point sees the face. Only an even sample of faces is checked.
    #[cfg(debug_assertions)]
    fn assert_unseen(&self, id: FaceId) {
        const FACES: usize = 32;
        if id as usize % self.hull.surface.slots().div_ceil(FACES) != 0 {
            return;
        }
        let face = self.hull.surface.face(id);
        for index in 0..self.flipped.len() as u32 {
            let is_above = self.flipped.get(index).is_some_and(|q| {
                self.division.is_far(index) && self.hull.vertices.side(face, q) == Sign::Positive
            });
            assert!(!is_above, "far point {index} sees face {id}");
        }
    }
}
