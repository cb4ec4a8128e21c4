//! A kept hull is asked about a point under another flip of the same viewpoint, without making the
//! hull of that flip. The answer is proved, or it is left open.
//!
//! The face by which the point's ray leaves the kept hull is a guess. Its three points are flipped
//! anew. If the flipped point is strictly inside of their triangle, K hides it there, too. If it
//! is farther out along the triangle's normal than all points of the cloud, it is outside of K.

use glam::DVec3;

use super::incremental::ORIGIN;
use super::kept::KeptHull;
use super::locate::Location;
use super::predicates::{Sign, side_of_face, side_of_origin};
use super::topology::FaceId;
use crate::base::real::square_root;
use crate::cloud::blocks::{BLOCK, Sphere};
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;

/// A bound of the relative error of a sum of three products, with room to spare.
const ROUNDING: f64 = 1e-15;
/// The same for bounds of blocks.
const MARGIN: f64 = 1e-12;
/// Products above this number have not underflowed.
const LEAST: f64 = 1e-200;

impl KeptHull {
    /// Whether the cloud would hide a point at `position` under `flip`; `None` if that is not
    /// proved. The hull is that of `points` under another flip from the same viewpoint, and
    /// `blocks` are the spheres around their blocks. `hint` is as for [`KeptHull::hides`].
    #[inline(never)]
    pub(crate) fn hides_otherwise(
        &self,
        flip: &Flip,
        points: &Points,
        blocks: &[Sphere],
        position: [f64; 3],
        hint: &mut FaceId,
    ) -> Option<bool> {
        let Some(q) = apply(flip, position) else {
            return Some(false);
        };
        let hull = self.hull()?;
        let v = DVec3::from_array(position) - flip.viewpoint();
        let ahead = v / square_root(v.length_squared());
        let (face, _) = hull.height_along(ahead, *hint);
        let flipped = |vertex| apply(flip, points.get(hull.point(vertex) as usize));
        if hull.is_outer(face) {
            *hint = face;
            let [a, b, c] = hull.corners(face)?.map(flipped);
            let (a, b, c) = (a?, b?, c?);
            let inside = |tail, head| side_of_origin(tail, head, q) != Sign::Negative;
            if side_of_origin(a, b, c) != Sign::Positive {
                return None;
            }
            if side_of_face(a, b, c, q) == Sign::Negative {
                let is_hidden = inside(a, b) && inside(b, c) && inside(c, a);
                return is_hidden.then_some(true);
            }
            let normal = (b - a).cross(c - a);
            if is_farthest(normal, q, flip, points, blocks) {
                return Some(false);
            }
        }
        // The ray may pass beside all of K: then a plane through the viewpoint is between. The place
        // is so near the viewpoint that it is below most faces.
        const NEAR: f64 = 1e-6;
        let Location::Outside(ghost) = hull.locate(ahead * (NEAR * self.reach()), *hint) else {
            return None;
        };
        let [a, b, c] = hull.corners(ghost)?;
        let (tail, head) = match (a, b, c) {
            (ORIGIN, tail, head) | (head, ORIGIN, tail) | (tail, head, ORIGIN) => (tail, head),
            _ => return None,
        };
        let normal = flipped(head)?.cross(flipped(tail)?);
        let outward = if normal.dot(q) < 0.0 { -normal } else { normal };
        is_farthest(outward, q, flip, points, blocks).then_some(false)
    }
}

/// Not inlined, because it is called in several places.
#[inline(never)]
fn apply(flip: &Flip, position: [f64; 3]) -> Option<DVec3> {
    flip.apply(position)
}

/// Whether `q` is certainly farther out along `normal` than the origin and all flipped points.
fn is_farthest(normal: DVec3, q: DVec3, flip: &Flip, points: &Points, blocks: &[Sphere]) -> bool {
    let normal = normal / normal.abs().max_element();
    let size = normal.abs();
    let least = normal.dot(q) - ROUNDING * size.dot(q.abs());
    // The comparisons also refuse a NaN.
    if !(least > LEAST && least < f64::MAX) {
        return false;
    }
    let length = square_root(normal.length_squared());
    for (block, sphere) in blocks.iter().enumerate() {
        let v = DVec3::from_array(sphere.center) - flip.viewpoint();
        let beyond = normal.dot(v) + length * sphere.radius + MARGIN * size.dot(v.abs());
        if beyond <= 0.0 {
            continue;
        }
        let nearest = (square_root(v.length_squared()) - sphere.radius) * (1.0 - MARGIN);
        // An upper bound of the factor s of the flip.
        let factor = flip.most_beyond(nearest) / nearest;
        if nearest > 0.0 && factor * beyond * (1.0 + MARGIN) < least {
            continue;
        }
        for index in block * BLOCK..points.len().min((block + 1) * BLOCK) {
            if let Some(other) = apply(flip, points.get(index)) {
                let height = normal.dot(other) + ROUNDING * size.dot(other.abs());
                if height >= least || height.is_nan() {
                    return false;
                }
            }
        }
    }
    true
}
