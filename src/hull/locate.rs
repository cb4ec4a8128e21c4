//! Walking on the hull: which face does a ray from the viewpoint pierce, and is a point on
//! this ray outside of the hull?

use core::array::from_fn;

use glam::DVec3;

use crate::base::real::larger;
use crate::hull::dual_plane::Plane;
use crate::hull::incremental::Hull;
use crate::hull::predicates::Sign;
use crate::hull::topology::{Face, FaceId, HalfEdge};

/// After this many steps a walk looks for a better start.
const PATIENCE: usize = 64;

/// Where a flipped point lies relative to the hull.
pub(super) enum Location {
    /// Strictly outside this face.
    Outside(FaceId),
    /// Exactly on the outer boundary.
    Boundary(FaceId),
    /// In K, and K goes on beyond it: hidden, now and for every larger K.
    Inside(FaceId),
}

impl Hull {
    /// Walks from `hint`, an outer face, towards the face that the ray of `q` pierces. The walk
    /// goes through outer faces only: beyond a ghost or edge-on face, the comparison of m·q
    /// would have no meaning.
    ///
    /// The dual planes of two neighbors agree on their common edge. So the ray passes on the
    /// side of that edge where m·q is larger, and the largest m·q of all belongs to the face
    /// that the ray pierces. If q is inside of this face, it is inside of all faces.
    ///
    /// For a point inside or on the boundary, the returned face is outer, too. It can be the
    /// next hint.
    pub(super) fn locate(&self, q: DVec3, hint: FaceId) -> Location {
        #[cfg(debug_assertions)]
        self.assert_is_outer(hint);
        let mut id = hint;
        let mut height = self.surface.face(id).data.m.dot(q);
        for step in 0..PATIENCE + self.surface.slots() {
            // The number of steps between two jumps doubles, so that every walk ends.
            if step >= PATIENCE && step.is_power_of_two() && self.is_sound(id) {
                id = self.jump(id, q, step);
                height = self.surface.face(id).data.m.dot(q);
            }
            let face = self.surface.face(id);
            let error = face.data.error;
            if height - 1.0 > error {
                return Location::Outside(id);
            }
            if cfg!(target_family = "wasm") {
                let neighbors = face.twins.map(|twin| twin.face());
                let planes = neighbors.map(|neighbor| self.surface.face(neighbor).data);
                let heights = planes.map(|plane| plane.m.dot(q));
                let steepest = index_of_largest(heights);
                let certain = planes.map(|plane| plane.error + error);
                if heights[steepest] - height > certain[steepest] {
                    id = neighbors[steepest];
                    height = heights[steepest];
                    continue;
                }
                if height > 0.0 && are_below(heights, planes, height - error) {
                    // m·q is certainly lower for all three neighbors.
                    return self.decide(id, q);
                }
            } else {
                // The same. Native code chooses between floats without a branch. One function for both
                // made the walk in WebAssembly much slower: all was computed before it was needed.
                let mut steepest = id;
                let mut steepest_height = f64::NEG_INFINITY;
                let mut steepest_error = 0.0;
                let mut bound = f64::NEG_INFINITY;
                for twin in face.twins {
                    let neighbor = &self.surface.face(twin.face()).data;
                    let h = neighbor.m.dot(q);
                    bound = larger(bound, h + neighbor.error);
                    if h > steepest_height {
                        steepest = twin.face();
                        steepest_height = h;
                        steepest_error = neighbor.error;
                    }
                }
                if steepest_height - height > steepest_error + error {
                    id = steepest;
                    height = steepest_height;
                    continue;
                }
                if height > 0.0 && bound < height - error {
                    return self.decide(id, q);
                }
            }
            if let Some(twin) = self.crossed_edge(face, q, step) {
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

    /// The same, not inlined, for callers that run rarely.
    #[inline(never)]
    pub(super) fn locate_out_of_line(&self, q: DVec3, hint: FaceId) -> Location {
        self.locate(q, hint)
    }

    /// An upper bound of m·`direction` over the dual planes m of all outer faces, and the face to
    /// start the next walk at. K contains `direction` divided by this bound. The bound is infinite
    /// where it is in doubt, or where no outer face lies in this direction. The length of
    /// `direction` is near 1.
    #[inline(never)]
    pub(super) fn height_along(&self, direction: DVec3, hint: FaceId) -> (FaceId, f64) {
        // A bound of the roundings of the last line.
        const ROUNDING: f64 = 1e-15;
        let mut id = hint;
        let mut face = self.surface.face(id);
        let mut height = face.data.m.dot(direction);
        for _ in 0..PATIENCE {
            let beyond = |edge: usize| &self.surface.face(face.twins[edge].face()).data;
            let heights = from_fn(|edge| beyond(edge).m.dot(direction));
            let steepest = index_of_largest(heights);
            if heights[steepest] <= height {
                let bound = height * (1.0 + 2.0 * face.data.error + ROUNDING);
                let certain = height > 0.0 && self.is_pierced(face, direction, height);
                return (id, if certain { bound } else { f64::INFINITY });
            }
            id = face.twins[steepest].face();
            face = self.surface.face(id);
            height = heights[steepest];
        }
        (id, f64::INFINITY)
    }

    /// Whether the ray of `direction` certainly leaves K through `face`, whose m·direction is
    /// the positive `height`.
    #[inline]
    fn is_pierced(&self, face: &Face<Plane>, direction: DVec3, height: f64) -> bool {
        let error = face.data.error;
        !face.data.is_exact_only()
            && face.twins.iter().enumerate().all(|(edge, twin)| {
                let neighbor = &self.surface.face(twin.face()).data;
                if neighbor.is_exact_only() {
                    // Beyond the edge of a ghost face there is nothing of K.
                    return !self.vertices.is_beyond(face, edge, direction);
                }
                let h = neighbor.m.dot(direction);
                h + height * neighbor.error < height * (1.0 - error)
            })
    }

    /// Whether the ray of `q` passes through an outer face, its border included. The answer is exact.
    pub(super) fn pierces(&self, id: FaceId, q: DVec3) -> bool {
        let face = self.surface.face(id);
        self.vertices.is_outer(face) && (0..3).all(|edge| !self.vertices.is_beyond(face, edge, q))
    }

    /// An edge of `face` beyond which the ray of `q` passes. It is found exactly, for cases where
    /// two values of m·q are nearly equal. The edge that is tried first changes from step to
    /// step. Otherwise a walk could go round in a circle of coplanar faces.
    #[cold]
    fn crossed_edge(&self, face: &Face<Plane>, q: DVec3, step: usize) -> Option<HalfEdge> {
        // The high bits of a product with the golden ratio look random.
        let first = (step as u32).wrapping_mul(0x9e37_79b9) >> 16;
        (first..first + 3)
            .map(|edge| (edge % 3) as usize)
            .find(|&edge| self.vertices.is_beyond(face, edge, q))
            .map(|edge| face.twins[edge])
    }

    /// Finds a better face than `id` for the rest of a long walk. Walks are long only around a
    /// vertex with very many faces. The sample of faces is so dense that a walk between two of
    /// them takes about as many steps as there are samples.
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
    #[inline]
    fn decide(&self, id: FaceId, q: DVec3) -> Location {
        let face = self.surface.face(id);
        match self.vertices.side(face, q) {
            Sign::Positive => Location::Outside(id),
            Sign::Zero => Location::Boundary(id),
            Sign::Negative => Location::Inside(id),
        }
    }

    /// Answers for a walk that does not end, which is rare: looks at every face.
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
}

/// The first place of the largest number. Which one is larger is as good as random along a walk.
/// A processor that guesses a branch is wrong half of the time, so there is none.
#[inline]
fn index_of_largest([a, b, c]: [f64; 3]) -> usize {
    let is_third = (c > a) & (c > b);
    let is_second = (b > a) & !is_third;
    usize::from(is_second) + 2 * usize::from(is_third)
}

/// Whether m·q of all three planes is certainly below `limit`.
#[inline]
fn are_below([a, b, c]: [f64; 3], planes: [Plane; 3], limit: f64) -> bool {
    let [of_a, of_b, of_c] = planes.map(|plane| plane.error);
    (a + of_a < limit) & (b + of_b < limit) & (c + of_c < limit)
}
