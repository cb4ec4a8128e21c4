//! The hull of a nearby view, from the hull of the last one.
//!
//! INPUT    the last view's hull; the flip of the new view.
//! OUTPUT   the exact hull, in the new view, of points that were vertices of the last
//!          hull, and a list of these points; or the verdict that a new hull is faster.
//! SUMMARY  From a viewpoint close by, most faces are the same. So the vertices
//!          are flipped again and every face and edge is looked at. Faces that the
//!          motion turned over are unfolded. Edges that became reflex are flipped.
//!          A vertex that stands in the way is taken out, and located again later like
//!          any other point. A surface is the hull if all faces turn outward, all edges
//!          are convex and one direction is covered once. It does not matter how the
//!          surface was found. So nothing here can make an answer wrong: in doubt, the
//!          view starts with a new hull.

#[cfg(test)]
mod knots;
#[cfg(test)]
mod scenes;
#[cfg(test)]
mod tests;

use glam::DVec3;

use super::flipped::Flipped;
use super::incremental::{Hull, Numbers, ORIGIN, Vertices};
use super::listing::MANY;
use super::repair::Repair;
use super::topology::{FaceId, HalfEdge, Vertex};
use crate::base::allocation::{OutOfMemory, push, reserve};
use crate::hull::predicates::{Sign, side_of_origin};

/// A new hull is faster than mending the old one where more than one face in this many of a sample
/// has turned over, and one more.
const FEW_TURNED: usize = 120;
/// The same for all faces. A sample that has missed so many is rare.
const MOST_TURNED: usize = 80;
/// A new hull is faster where more than one edge in this many has become reflex.
const FEW_REFLEX: usize = 25;
/// The same for a hull that does not fit into the caches: its repair waits for memory.
const FEW_REFLEX_OF_MANY: usize = 32;
/// How many faces of the last hull are looked at, to find out whether the views are close.
const SAMPLE: usize = 1024;
/// At most one face in so many, because a small hull is made in a short time.
const LEAST_STEP: usize = 8;
/// The faces are looked at in so many rounds, each over the whole hull. After a round it may be clear
/// that the views are not close.
const ROUNDS: usize = 16;
/// A round may find so many more turned faces and reflex edges by chance.
const CHANCE_TURNED: usize = 4;
const CHANCE_REFLEX: usize = 20;
/// A repair that made little progress with force so many times is given up.
const MOST_FORCED: usize = 32;
/// A repair that flips more than one edge in this many faces is given up.
const FACES_PER_FLIP: usize = 2;
/// Edge flips that a repair of even the smallest hull may take.
const FEWEST_FLIPS: usize = 64;
/// The effort that a repair may spend on taking out vertices, in squares of their degrees and of
/// half the faces of cleared holes: so much for each face, and `SPARE_EFFORT` more.
const EFFORT_PER_FACE: usize = 2;
const SPARE_EFFORT: usize = 1000;

impl Hull {
    /// Becomes the hull of its vertices as `flipped` now.
    /// Returns false where a new hull must be started; the old hull is unusable then.
    pub(super) fn move_to(
        &mut self,
        flipped: &Flipped,
        repair: &mut Repair,
        is_vertex: &mut [bool],
        witnesses: &mut [FaceId],
    ) -> Result<bool, OutOfMemory> {
        // The new numbers pay only for a hull that goes on moving.
        if self.numbers == Numbers::Moved {
            self.renumber(flipped.len(), witnesses)?;
            self.numbers = Numbers::InOrder;
        }
        self.use_corners()?;
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
        let most_turned = self.surface.slots() / MOST_TURNED;
        if !self.renew_planes(most_turned, repair)? {
            return Ok(false);
        }
        repair.effort = EFFORT_PER_FACE * self.surface.slots() + SPARE_EFFORT;
        let mut flips_left = self.surface.slots() / FACES_PER_FLIP + FEWEST_FLIPS;
        // The neighbors of a face may prevent its repair. Then it is tried again after they are
        // mended, in the end with more force.
        let mut forced = 0;
        while !repair.turned.is_empty() {
            let before = repair.turned.len();
            let mut kept = 0;
            for i in 0..before {
                let face = repair.turned[i];
                if !self.unfold(face, forced > 0, repair)? {
                    repair.turned[kept] = face;
                    kept += 1;
                }
            }
            repair.turned.truncate(kept);
            if kept > before / 2 {
                // Without a change, the same would fail again.
                let is_stuck = forced > 0 && kept == before;
                if is_stuck || forced == MOST_FORCED || repair.effort == 0 {
                    return Ok(false);
                }
                forced += 1;
            }
        }
        while let Some(edge) = repair.suspects.pop() {
            if self.is_reflex(edge) {
                flips_left -= 1;
                if flips_left == 0 || !self.make_convex(edge, repair)? {
                    return Ok(false);
                }
            }
        }
        if self.numbers == Numbers::AsMade {
            self.numbers = Numbers::Moved;
        }
        self.list_new()?;
        self.settle(repair, is_vertex)
    }

    /// The share of reflex edges in a sample, if the views are close: few faces turned over, and few
    /// edges became reflex. This is computed with roundings, because it only decides which way is
    /// faster.
    pub(super) fn reflex_share(&self, flipped: &Flipped) -> Option<f64> {
        let slots = self.surface.slots();
        let step = sample_step(slots);
        let few_reflex = if slots < MANY {
            FEW_REFLEX
        } else {
            FEW_REFLEX_OF_MANY
        };
        let at = |vertex: Vertex| flipped.get_out_of_line(self.vertices.points[vertex as usize]);
        let [mut faces, mut turned, mut reflex] = [0; 3];
        for round in 0..ROUNDS {
            for slot in (round * step..slots).step_by(ROUNDS * step) {
                let face = self.surface.face(slot as FaceId);
                if !face.is_alive() || face.vertices.contains(&ORIGIN) {
                    continue;
                }
                let [Some(a), Some(b), Some(c)] = face.vertices.map(at) else {
                    return None;
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
            let many_turned = turned > faces / FEW_TURNED + CHANCE_TURNED;
            if many_turned || reflex > 3 * faces / few_reflex + CHANCE_REFLEX {
                return None;
            }
        }
        let is_close = turned <= faces / FEW_TURNED + 1 && reflex * few_reflex <= 3 * faces;
        is_close.then(|| reflex as f64 / faces.max(1) as f64)
    }

    /// Computes each face's plane in the new view. Lists turned faces and reflex edges. Stops and
    /// returns false if there are more than `most_turned` turned faces: the sample missed them.
    fn renew_planes(
        &mut self,
        most_turned: usize,
        repair: &mut Repair,
    ) -> Result<bool, OutOfMemory> {
        repair.turned.clear();
        repair.suspects.clear();
        for slot in 0..self.surface.slots() as FaceId {
            let Some(corners) = self.surroundings(slot) else {
                continue;
            };
            let plane = self.vertices.plane(corners.own);
            if self.compact.is_used() {
                self.compact.note_plane(slot, &plane);
            } else {
                self.surface.face_mut(slot).data = plane;
            }
            // All three neighbors are computed, so each edge is looked at from both sides. A branch
            // that cannot be predicted would cost more. The largest height would be such a branch
            // in WebAssembly, where no instruction selects a floating-point number without one.
            let limit = 1.0 - plane.error;
            let is_below = |apex| plane.m.dot(self.vertices.at(apex)) < limit;
            let [first, second, third] = corners.across.map(is_below);
            if first & second & third {
                continue;
            }
            let face = *self.surface.face(slot);
            if plane.is_exact_only() && self.vertices.is_turned(&face) {
                if repair.turned.len() == most_turned {
                    return Ok(false);
                }
                push(&mut repair.turned, slot)?;
                continue;
            }
            for edge in (0..3).map(|edge| HalfEdge::new(slot, edge)) {
                let twin = face.twins[edge.edge()];
                let across = self.surface.face(twin.face());
                if twin.face() < slot && !self.vertices.is_turned(across) && self.is_reflex(edge) {
                    push(&mut repair.suspects, edge)?;
                }
            }
        }
        Ok(true)
    }

    /// Whether the ray of `inner` pierces exactly one face. With faces that all turn
    /// outward, and ghost faces that all have that ray inside, the surface then covers
    /// every direction at most once.
    ///
    /// Also marks the points that are vertices, and frees the numbers of vertices that
    /// no face has.
    fn settle(&mut self, repair: &mut Repair, is_vertex: &mut [bool]) -> Result<bool, OutOfMemory> {
        let ray = self.vertices.inner;
        // The flags of a vertex hold its sides of two planes through the ray. A face that lies on
        // one side of one of these planes is not pierced. Roundings are far below the margin.
        let margin = self.vertices.reach * 1e-12;
        let Some(axis) = ray.try_normalize() else {
            return Ok(false);
        };
        let (e, f) = axis.any_orthonormal_pair();
        let sides = &mut repair.sides;
        sides.clear();
        reserve(sides, self.vertices.positions.len())?;
        sides.extend(self.vertices.positions.iter().map(|q| {
            let (x, y) = (q.dot(e), q.dot(f));
            u8::from(x > margin)
                | u8::from(x < -margin) << 1
                | u8::from(y > margin) << 2
                | u8::from(y < -margin) << 3
        }));
        const USED: u8 = 1 << 4;
        let mut pierced = 0;
        for corners in self.triangles() {
            let [a, b, c] = corners.map(|v| sides[v as usize]);
            if a & b & c & !USED == 0 && !corners.contains(&ORIGIN) {
                match contains(corners.map(|v| self.vertices.at(v)), ray) {
                    Some(inside) => pierced += u32::from(inside),
                    None => return Ok(false),
                }
            }
            for vertex in corners {
                sides[vertex as usize] |= USED;
            }
        }
        let Vertices { points, free, .. } = &mut self.vertices;
        free.clear();
        for (vertex, (&point, &sides)) in (0..).zip(points.iter().zip(&*sides)).skip(1) {
            if sides & USED == 0 {
                push(free, vertex)?;
            } else {
                is_vertex[point as usize] = true;
            }
        }
        Ok(pierced == 1)
    }
}

/// One in so many faces is in the sample.
fn sample_step(slots: usize) -> usize {
    slots.div_ceil(SAMPLE).max(LEAST_STEP)
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
