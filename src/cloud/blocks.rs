//! Spheres around runs of the spatial order, and spheres around runs of spheres. They bound
//! many points at once, from any viewpoint.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, reserve, with_capacity};
use crate::base::error::Error;
use crate::base::real::square_root;
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
pub(crate) struct Blocks {
    pub levels: Vec<Vec<Sphere>>,
}

impl Blocks {
    /// The spheres around `points`, which are in their spatial order.
    #[inline(never)]
    pub(crate) fn around(points: &Points) -> Result<Self, OutOfMemory> {
        let point = |index: usize| Sphere {
            center: points.get(index),
            radius: 0.0,
        };
        let mut levels = Vec::new();
        let mut level = around_runs(points.len(), BLOCK, &point)?;
        while level.len() > FANOUT {
            let above = around_runs(level.len(), FANOUT, &|node| level[node])?;
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

/// A sphere around every `run` of `count` spheres.
fn around_runs(
    count: usize,
    run: usize,
    sphere: &dyn Fn(usize) -> Sphere,
) -> Result<Vec<Sphere>, OutOfMemory> {
    let mut around: Vec<Sphere> = with_capacity(count.div_ceil(run))?;
    for start in (0..count).step_by(run) {
        let mut bounds = Bounds::EMPTY;
        let end = count.min(start + run);
        (start..end).for_each(|k| bounds.include(sphere(k).center));
        let center = core::array::from_fn(|axis| bounds.min[axis] * 0.5 + bounds.max[axis] * 0.5);
        let mut radius = 0.0f64;
        for inner in (start..end).map(sphere) {
            let v = DVec3::from_array(inner.center) - DVec3::from_array(center);
            // Where squares underflow, the sum of the coordinates is an upper bound.
            let distance = square_root(v.dot(v)).max(v.abs().element_sum().min(1e-150));
            radius = radius.max((distance + inner.radius) * (1.0 + MARGIN));
        }
        around.push(Sphere { center, radius });
    }
    Ok(around)
}
