//! Spheres around runs of the spatial order, and spheres around runs of spheres. They bound
//! many points at once, from any viewpoint.

use alloc::vec::Vec;
use core::ops::Range;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, reserve, with_capacity};
use crate::base::error::Error;
use crate::base::real::{larger, smaller, square_root};
use crate::cloud::points::Points;
use crate::cloud::spatial::Bounds;

/// Points in a block.
pub(crate) const BLOCK: usize = 64;
/// Nodes in a node one level up.
pub(crate) const FANOUT: usize = 8;

/// A bound of the relative error of a distance, with room to spare.
const MARGIN: f64 = 1e-12;

/// A square above this number has not underflowed.
const WITH_SQUARE: f64 = 1e-200;

/// All points of the node lie within `radius` of `center`. The radius is infinite where
/// distances overflow.
#[derive(Clone, Copy)]
pub(crate) struct Sphere {
    pub center: [f64; 3],
    pub radius: f64,
}

/// Level 0 holds a sphere for each block. Every higher level holds one sphere for `FANOUT`
/// spheres of the level below. The last level has at most `FANOUT` spheres. All take half a
/// byte a point.
#[derive(Clone)]
pub(crate) struct Blocks {
    pub levels: Vec<Vec<Sphere>>,
}

impl Blocks {
    /// The spheres around `points`, which are in their spatial order.
    #[inline(never)]
    pub(crate) fn around(points: &Points) -> Result<Self, OutOfMemory> {
        let mut levels = Vec::new();
        let mut level = around_runs(points.len(), BLOCK, &|run, spheres| {
            spheres.extend(run.map(|index| Sphere {
                center: points.get(index),
                radius: 0.0,
            }));
        })?;
        while level.len() > FANOUT {
            let above = around_runs(level.len(), FANOUT, &|run, spheres| {
                spheres.extend_from_slice(&level[run]);
            })?;
            reserve(&mut levels, 2)?;
            levels.push(level);
            level = above;
        }
        levels.push(level);
        Ok(Self { levels })
    }

    /// The largest distance of any of the `points` from `viewpoint`, or 0 for an empty cloud. It
    /// is the root of the largest rounded v·v, where v = p − C. Only blocks that may hold the
    /// farthest point are computed.
    ///
    /// # Errors
    /// [`Error::RadiusOverflow`] when a distance exceeds the range of f64.
    pub(crate) fn farthest_distance(
        &self,
        points: &Points,
        viewpoint: [f64; 3],
    ) -> Result<f64, Error> {
        let viewpoint = DVec3::from_array(viewpoint);
        let reach = |sphere: &Sphere| {
            let center = DVec3::from_array(sphere.center) - viewpoint;
            (square_root(center.dot(center)) + sphere.radius) * (1.0 + MARGIN)
        };
        // The most promising block comes first, then every block that may hold a farther point.
        let mut promising = 0;
        let mut farthest_reach = 0.0;
        for (block, sphere) in self.levels[0].iter().enumerate() {
            let reach = reach(sphere);
            if reach > farthest_reach {
                promising = block;
                farthest_reach = reach;
            }
        }
        let mut largest = 0.0f64;
        for block in core::iter::once(promising).chain(0..self.levels[0].len()) {
            let certain = largest > WITH_SQUARE && {
                let reach = reach(&self.levels[0][block]);
                reach * reach < largest
            };
            if !certain {
                for index in block * BLOCK..points.len().min((block + 1) * BLOCK) {
                    let v = DVec3::from_array(points.get(index)) - viewpoint;
                    largest = largest.max(v.dot(v));
                }
            }
        }
        // The root is monotonic, so the root of the largest is the largest root.
        let farthest = square_root(largest);
        if farthest.is_finite() {
            Ok(farthest)
        } else {
            Err(Error::RadiusOverflow {
                radius: None,
                farthest,
            })
        }
    }
}

/// A sphere around every `run` of `count` spheres, of which `copy` copies a run.
fn around_runs(
    count: usize,
    run: usize,
    copy: &dyn Fn(Range<usize>, &mut Vec<Sphere>),
) -> Result<Vec<Sphere>, OutOfMemory> {
    let mut around: Vec<Sphere> = with_capacity(count.div_ceil(run))?;
    let mut spheres: Vec<Sphere> = with_capacity(run)?;
    for start in (0..count).step_by(run) {
        spheres.clear();
        copy(start..count.min(start + run), &mut spheres);
        let bounds = Bounds::around(spheres.iter().map(|sphere| sphere.center));
        let center = core::array::from_fn(|axis| bounds.min[axis] * 0.5 + bounds.max[axis] * 0.5);
        let mut radius = 0.0f64;
        for inner in &spheres {
            let v = DVec3::from_array(inner.center) - DVec3::from_array(center);
            // Where squares underflow, the sum of the coordinates is an upper bound.
            let tiny = v.abs().element_sum();
            let distance = larger(square_root(v.dot(v)), smaller(1e-150, tiny));
            radius = larger(radius, (distance + inner.radius) * (1.0 + MARGIN));
        }
        around.push(Sphere { center, radius });
    }
    Ok(around)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;

    #[test]
    fn spheres_hold_their_points_and_are_not_larger_than_their_boxes() {
        let points = Points::Double(Random::new(1).bumpy(5000));
        let blocks = Blocks::around(&points).unwrap();
        let counts: Vec<usize> = blocks.levels.iter().map(Vec::len).collect();
        assert_eq!(counts, [79, 10, 2]);
        let mut run = BLOCK;
        for (level, spheres) in blocks.levels.iter().enumerate() {
            for (node, sphere) in spheres.iter().enumerate() {
                let mut bounds = Bounds::EMPTY;
                for index in node * run..points.len().min((node + 1) * run) {
                    let p = points.get(index);
                    bounds.include(p);
                    let v = DVec3::from_array(p) - DVec3::from_array(sphere.center);
                    assert!(v.length() <= sphere.radius);
                }
                if level == 0 {
                    assert!(sphere.radius < 0.5 * bounds.diagonal() + 1e-9);
                }
            }
            run *= FANOUT;
        }
    }

    #[test]
    fn the_farthest_distance_is_that_of_a_point() {
        let mut random = Random::new(2);
        let points = Points::Double(random.bumpy(3000));
        let blocks = Blocks::around(&points).unwrap();
        for round in 0..300 {
            let size = [0.0, 0.3, 2.0, 1e4][round % 4];
            let viewpoint = size * random.direction();
            let distance = |p: [f64; 3]| {
                let v = DVec3::from_array(p) - viewpoint;
                square_root(v.dot(v))
            };
            let farthest = points.iter().map(distance).fold(0.0, f64::max);
            let found = blocks.farthest_distance(&points, viewpoint.to_array());
            assert_eq!(found, Ok(farthest));
        }
    }
}
