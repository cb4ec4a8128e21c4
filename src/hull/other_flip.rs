//! A kept hull is asked about a point under another flip of the same viewpoint, without making the
//! hull of that flip. The answer is proved, or it is left open.
//!
//! The face by which the point's ray leaves the kept hull is a guess. Its three points are flipped
//! anew. If the flipped point is strictly below their triangle, K hides it there, too. If it
//! is farther out along the triangle's normal than all points of the cloud, it is outside of K.
//! Otherwise the point that is farthest out makes a triangle farther out, and so on.

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
        let flipped = |vertex| apply(flip, points.get(hull.point(vertex) as usize));
        // A place that is so near the viewpoint is below the face that its ray pierces, or beside all of K.
        const NEAR: f64 = 1e-6;
        let ghost = match hull.locate(ahead * (NEAR * self.reach()), *hint) {
            Location::Outside(ghost) => ghost,
            Location::Inside(face) | Location::Boundary(face) => {
                *hint = face;
                if !hull.is_outer(face) {
                    return None;
                }
                let [a, b, c] = hull.corners(face)?.map(flipped);
                return climb([a?, b?, c?], q, flip, points, blocks);
            }
        };
        // A plane through the viewpoint is between.
        let [a, b, c] = hull.corners(ghost)?;
        let (tail, head) = match (a, b, c) {
            (ORIGIN, tail, head) | (head, ORIGIN, tail) | (tail, head, ORIGIN) => (tail, head),
            _ => return None,
        };
        let normal = flipped(head)?.cross(flipped(tail)?);
        let outward = if normal.dot(q) < 0.0 { -normal } else { normal };
        let found = farthest(outward, q, flip, points, blocks);
        matches!(found, Farthest::Given).then_some(false)
    }
}

/// Not inlined, because it is called in several places.
#[inline(never)]
fn apply(flip: &Flip, position: [f64; 3]) -> Option<DVec3> {
    flip.apply(position)
}

/// Goes outward from a triangle that the ray of `q` pierces, from one such triangle to the next, until `q` is
/// below a triangle, and so hidden, or beyond all points. `None` if neither happens.
fn climb(
    [mut a, mut b, mut c]: [DVec3; 3],
    q: DVec3,
    flip: &Flip,
    points: &Points,
    blocks: &[Sphere],
) -> Option<bool> {
    // A few steps are enough, unless many points are in one plane.
    const STEPS: usize = 20;
    for _ in 0..STEPS {
        let is_pierced = !is_beside(a, b, q) && !is_beside(b, c, q) && !is_beside(c, a, q);
        if !is_pierced || side_of_origin(a, b, c) != Sign::Positive {
            return None;
        }
        if side_of_face(a, b, c, q) == Sign::Negative {
            return Some(true);
        }
        let p = match farthest((b - a).cross(c - a), q, flip, points, blocks) {
            Farthest::Given => return Some(false),
            Farthest::Point(p) => p,
            Farthest::Unknown => return None,
        };
        // The ray pierces one of the triangles of p and an edge.
        (a, b, c) = match (is_beside(a, p, q), is_beside(b, p, q), is_beside(c, p, q)) {
            (true, false, _) => (a, b, p),
            (_, true, false) => (b, c, p),
            (false, _, true) => (c, a, p),
            _ => return None,
        };
    }
    None
}

/// Whether `q` is on the right of the way from `tail` to `head`, seen from outside. Not inlined, because it is called
/// in several places.
#[inline(never)]
fn is_beside(tail: DVec3, head: DVec3, q: DVec3) -> bool {
    side_of_origin(tail, head, q) == Sign::Negative
}

/// Which of a given point, the origin and all flipped points is farthest out along a normal.
enum Farthest {
    /// The given point, certainly.
    Given,
    /// This flipped point, or the given point by less than the rounding.
    Point(DVec3),
    Unknown,
}

fn farthest(normal: DVec3, q: DVec3, flip: &Flip, points: &Points, blocks: &[Sphere]) -> Farthest {
    let normal = normal / normal.abs().max_element();
    let size = normal.abs();
    let mut least = normal.dot(q) - ROUNDING * size.dot(q.abs());
    // The comparisons also refuse a NaN.
    if !(least > LEAST && least < f64::MAX) {
        return Farthest::Unknown;
    }
    let length = square_root(normal.length_squared());
    let mut found = Farthest::Given;
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
                if height.is_nan() {
                    return Farthest::Unknown;
                }
                if height >= least {
                    least = height;
                    found = Farthest::Point(other);
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;
    use crate::base::random::Random;
    use crate::cloud::blocks::Blocks;
    use crate::flip::kernel::Kernel;

    #[test]
    fn another_flip_is_answered_as_by_its_own_hull() {
        let mut random = Random::new(61);
        let points = Points::Double(random.bumpy(1500));
        let blocks = Blocks::around(&points).unwrap();
        let spheres = &blocks.levels[0];
        for viewpoint in [[0.05, 0.1, -0.1], [0.0, 0.5, 2.5]] {
            let [first, second] =
                [30.0, 12.0].map(|radius| Flip::new(viewpoint, Kernel::Spherical { radius }));
            let kept = KeptHull::of(&points, spheres, &first).unwrap();
            let other = KeptHull::of(&points, spheres, &second).unwrap();
            let [mut hint, mut other_hint] = [kept.first_hint(), other.first_hint()];
            let mut answers = [0; 3];
            for round in 0..1000 {
                let far = random.between(0.5, 1.5);
                let place = match round % 2 {
                    0 => DVec3::from_array(points.get(random.below(1500) as usize)) * far.sqrt(),
                    _ => random.direction() * far,
                };
                let expected = other.hides(place.to_array(), &mut other_hint).unwrap();
                let answer =
                    kept.hides_otherwise(&second, &points, spheres, place.to_array(), &mut hint);
                assert!(
                    answer.is_none_or(|hides| hides == expected),
                    "{place}: {answer:?}"
                );
                answers[answer.map_or(2, usize::from)] += 1;
            }
            assert!(
                answers[0] > 200 && answers[1] > 400 && answers[2] == 0,
                "{answers:?}"
            );
        }
    }

    /// The points of many blocks are left out together. The answer is compared with a look at every
    /// point.
    #[test]
    fn the_farthest_point_is_found_whichever_blocks_are_left_out() {
        let mut random = Random::new(62);
        let points = Points::Double(random.bumpy(3000));
        let blocks = Blocks::around(&points).unwrap();
        let mut answers = [0; 2];
        for viewpoint in [[0.0, 0.5, 2.5], [0.05, 0.1, -0.1], [0.9, 0.7, 0.0]] {
            let flip = Flip::new(viewpoint, Kernel::Spherical { radius: 9.0 });
            let all: Vec<DVec3> = (0..points.len())
                .filter_map(|index| apply(&flip, points.get(index)))
                .collect();
            for round in 0..400 {
                let normal = random.direction();
                let own = all[random.below(all.len() as u64) as usize];
                let q = own * random.between(0.9, 1.3);
                let height = |place: DVec3| normal.dot(place);
                let highest = all
                    .iter()
                    .map(|&place| height(place))
                    .fold(f64::MIN, f64::max);
                if height(q) < 0.1 {
                    continue;
                }
                match farthest(normal, q, &flip, &points, &blocks.levels[0]) {
                    Farthest::Given => {
                        answers[0] += 1;
                        assert!(height(q) > highest, "round {round}");
                    }
                    Farthest::Point(place) => {
                        answers[1] += 1;
                        assert!(
                            height(place) == highest && highest > height(q),
                            "round {round}"
                        );
                    }
                    Farthest::Unknown => panic!("round {round}"),
                }
            }
        }
        assert!(answers.iter().all(|&count| count > 50), "{answers:?}");
    }
}
