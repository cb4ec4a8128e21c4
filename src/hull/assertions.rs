//! Assertions about a finished hull. They are compiled with debug assertions only, for tests
//! and fuzzers.

use glam::DVec3;

use crate::hull::incremental::{Hull, ORIGIN};
use crate::hull::predicates::{Sign, side_of_origin};
use crate::hull::topology::{FaceId, HalfEdge};

/// If there are more faces than this, only an even sample is checked.
const MOST_FACES: usize = 4096;
/// How many rays are tried: a ray that runs exactly through an edge says nothing.
const RAYS: usize = 4;

impl Hull {
    /// Panics unless `id` is an outer face of the surface: a walk may start there.
    pub(super) fn assert_is_outer(&self, id: FaceId) {
        assert!(self.corners(id).is_some(), "face {id} is not alive");
        assert!(self.is_outer(id), "face {id} is not an outer face");
    }

    /// Panics unless the surface is closed, convex at every edge and covers a ray once.
    /// Such a surface is the hull of its vertices.
    pub(super) fn assert_is_hull(&self) {
        let step = self.surface.slots().div_ceil(MOST_FACES).max(1);
        for (id, face) in self.surface.alive().step_by(step) {
            for edge in 0..3 {
                let twin = face.twins[edge as usize];
                let across = self.surface.face(twin.face());
                let edge = HalfEdge::new(id, edge);
                assert!(across.is_alive(), "face {id} has a dead neighbor");
                assert_eq!(across.twins[twin.edge()], edge, "the surface is not closed");
                let [tail, head, _] = face.vertices_from(edge.edge());
                assert_eq!(across.vertices_from(twin.edge())[..2], [head, tail]);
                assert!(!self.is_reflex(edge), "the surface is reflex at face {id}");
            }
            assert!(
                face.vertices.contains(&ORIGIN) || !self.turns_inward(face.vertices),
                "face {id} turns its outer side to the viewpoint"
            );
        }
        let outer = self.surface.alive().filter(|&(id, _)| self.is_outer(id));
        let corners = outer.map(|(_, face)| face.vertices.map(|v| self.vertices.at(v)));
        let mut rays = corners.take(RAYS).filter_map(middle);
        if let Some(times) = rays.find_map(|ray| self.times_covered(ray)) {
            assert_eq!(times, 1, "so many faces are pierced by one ray");
        }
    }

    /// Whether the surface is reflex at an edge between faces that turn outward.
    fn is_reflex(&self, edge: HalfEdge) -> bool {
        let face = self.surface.face(edge.face());
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

    fn turns_inward(&self, vertices: [u32; 3]) -> bool {
        let [a, b, c] = vertices.map(|v| self.vertices.at(v));
        side_of_origin(a, b, c) == Sign::Negative
    }

    /// How many outer faces the ray pierces; `None` if it runs through an edge.
    fn times_covered(&self, ray: DVec3) -> Option<usize> {
        let mut times = 0;
        for (id, face) in self.surface.alive() {
            let sides = sides(face.vertices.map(|v| self.vertices.at(v)), ray);
            if !sides.contains(&Sign::Negative) && self.is_outer(id) {
                if sides.contains(&Sign::Zero) {
                    return None;
                }
                times += 1;
            }
        }
        Some(times)
    }
}

/// A ray strictly inside the face; `None` where rounding moved it out of a thin face.
fn middle(corners: [DVec3; 3]) -> Option<DVec3> {
    let ray = corners.iter().sum::<DVec3>();
    (ray.is_finite() && sides(corners, ray) == [Sign::Positive; 3]).then_some(ray)
}

/// The side of each edge on which the ray is; positive is inside.
fn sides([a, b, c]: [DVec3; 3], ray: DVec3) -> [Sign; 3] {
    [(a, b), (b, c), (c, a)].map(|(tail, head)| side_of_origin(tail, head, ray))
}
