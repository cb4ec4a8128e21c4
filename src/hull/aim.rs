//! The face that the ray of a point pierces in a hull without planes, found by the positions of its
//! vertices alone.

use glam::DVec3;

use super::incremental::{Hull, ORIGIN};
use super::locate::Location;
use super::topology::{FaceId, Vertex};
use crate::base::real::smaller;

/// After this many steps a walk is given up.
const PATIENCE: usize = 64;

/// Where a walk ended.
struct Aim {
    face: FaceId,
    /// The least determinant of the ray and an edge of the face; negative if the ray misses it.
    least: f64,
}

impl Hull {
    /// The same as [`Hull::locate`], for a hull that may have no planes. `hint` is an outer face.
    /// `other` is a number that was kept over insertions. It may now be unused, far away or a
    /// ghost face.
    #[inline]
    pub(super) fn locate_again(&self, q: DVec3, hint: FaceId, other: FaceId) -> Location {
        if self.compact.is_used() {
            self.locate_by_positions(q, hint, other)
        } else {
            self.locate(q, self.nearer_hint(q, hint, other))
        }
    }

    #[inline(never)]
    fn locate_by_positions(&self, q: DVec3, hint: FaceId, other: FaceId) -> Location {
        let aim = self.aim(q, self.nearer_start(q, hint, other));
        if self.is_certain(&aim) {
            return self.decide(aim.face, q);
        }
        let is_outer = self.is_outer(aim.face);
        self.locate_out_of_line(q, if is_outer { aim.face } else { hint })
    }

    /// The better of two faces to start a walk at: the one with the nearer corner.
    #[inline]
    fn nearer_start(&self, q: DVec3, hint: FaceId, other: FaceId) -> FaceId {
        let distance = |[corner, ..]: [Vertex; 3]| (self.vertices.at(corner) - q).length_squared();
        let (first, second) = (self.surface.face(hint), self.surface.face(other));
        let usable = hint != other && second.is_alive() && !second.vertices.contains(&ORIGIN);
        if usable && distance(second.vertices) < distance(first.vertices) {
            other
        } else {
            hint
        }
    }

    /// Walks towards the face that the ray of `q` pierces, from `start`, which is not a ghost face.
    /// The walk does not enter ghost faces. Roundings may lead it astray.
    #[inline]
    fn aim(&self, q: DVec3, start: FaceId) -> Aim {
        let mut id = start;
        let mut face = self.surface.face(id);
        // The edge from `tail` to `head`, across which the walk came. Only in the first face the ray
        // may be beyond it.
        let mut edge = 0;
        let [mut tail, mut head, mut apex] = face.vertices.map(|v| self.vertices.at(v));
        let mut first = tail.cross(head).dot(q);
        for _ in 0..PATIENCE {
            let second = head.cross(apex).dot(q);
            let third = apex.cross(tail).dot(q);
            // The edge runs the other way in the next face.
            let (step, least);
            if (first >= 0.0) & (second >= 0.0) & (third >= 0.0) {
                let least = smaller(smaller(second, third), first);
                return Aim { face: id, least };
            } else if (second <= third) & (second <= first) {
                (step, least) = (1, second);
                tail = apex;
            } else if third <= first {
                (step, least) = (2, third);
                head = apex;
            } else {
                (step, least) = (0, first);
                (tail, head) = (head, tail);
            }
            let twin = face.twins[(edge + step) % 3];
            let across = self.surface.face(twin.face());
            if across.vertices.contains(&ORIGIN) {
                return Aim { face: id, least };
            }
            (id, face, edge) = (twin.face(), across, twin.edge());
            let [_, _, last] = across.vertices_from(edge);
            apex = self.vertices.at(last);
            first = -least;
        }
        Aim {
            face: id,
            least: f64::NEG_INFINITY,
        }
    }

    /// Whether the ray certainly pierces the face strictly inside. No flipped point is farther out
    /// than 5/8 of the reach, so each determinant is a sum of products below 1/4 of the reach cubed,
    /// with about ten roundings.
    #[inline]
    fn is_certain(&self, aim: &Aim) -> bool {
        const ROUNDINGS: f64 = 16.0 * f64::EPSILON;
        // A bound above this shows that no product that matters has underflowed.
        const LEAST: f64 = 1e-250;
        let reach = self.vertices.reach;
        let doubt = ROUNDINGS * reach * reach * reach;
        doubt > LEAST && aim.least > doubt
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::hull::incremental::Hull;

    /// Points on a sphere and a lattice, where many rays run through edges and vertices.
    #[test]
    fn both_walks_find_the_same_place() {
        let mut random = Random::new(11);
        for round in 0..40 {
            let unit = [1.0, 1e-20, 1e20, 0.125][round % 4];
            let mut point = || {
                let on_lattice = random.below(2) == 0;
                let far = random.between(0.7, 1.0);
                let p = random.direction() * far;
                (if on_lattice {
                    (p * 4.0).round() / 4.0
                } else {
                    p
                }) * unit
            };
            let mut hull = Hull::default();
            let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis * unit);
            let corners = [(0, axes[0]), (1, axes[2]), (2, axes[1])];
            let corners = match crate::hull::predicates::side_of_origin(axes[0], axes[2], axes[1]) {
                crate::hull::predicates::Sign::Positive => corners,
                _ => [(0, axes[0]), (1, axes[1]), (2, axes[2])],
            };
            hull.start(corners, 4.0 * unit, 400).unwrap();
            let mut hint = 0;
            let mut other = 0;
            for index in 3..400 {
                let q = point();
                if q == DVec3::ZERO {
                    continue;
                }
                let found = hull.locate(q, hint);
                let again = hull.locate_by_positions(q, hint, other);
                hint = match (found, again) {
                    (Location::Outside(face), Location::Outside(_)) => {
                        hull.insert(index, q, face).unwrap()
                    }
                    (Location::Boundary(face), Location::Boundary(_))
                    | (Location::Inside(face), Location::Inside(_)) => face,
                    _ => panic!("{q} is at two places"),
                };
                if index % 3 == 0 {
                    other = hint;
                }
            }
        }
    }
}
