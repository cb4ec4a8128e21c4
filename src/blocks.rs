//! Spheres around runs of the spatial order, and around runs of those: what is known
//! of many points at once, from any viewpoint.

use alloc::vec::Vec;
use glam::DVec3;

use crate::error::Error;
use crate::inversion::square_root;
use crate::points::Points;
use crate::spatial::Bounds;

/// Points in a block.
pub(crate) const BLOCK: usize = 64;
/// Nodes in a node one level up.
pub(crate) const FANOUT: usize = 8;

/// More than any error of the few roundings in a distance, relative to it.
const MARGIN: f64 = 1e-12;

/// All points of the node are within `radius` of `center`.
#[derive(Clone, Copy)]
pub(crate) struct Sphere {
    pub center: [f64; 3],
    pub radius: f64,
}

/// Level 0 is a sphere for each block, every higher level one for `FANOUT` spheres
/// of the level below; the last level has at most `FANOUT`. Half a byte a point.
pub(crate) struct Blocks {
    pub levels: Vec<Vec<Sphere>>,
}

impl Blocks {
    /// Around `points`, which are in their spatial order.
    pub(crate) fn around(points: &Points) -> Result<Self, Error> {
        let mut level: Vec<Sphere> = Vec::new();
        level.try_reserve_exact(points.len().div_ceil(BLOCK))?;
        for start in (0..points.len()).step_by(BLOCK) {
            let run = || (start..points.len().min(start + BLOCK)).map(|i| points.get(i));
            let mut bounds = Bounds::EMPTY;
            run().for_each(|p| bounds.include(p));
            level.push(around(middle(&bounds), run().map(|p| (p, 0.0))));
        }
        let mut levels = Vec::new();
        while level.len() > FANOUT {
            let mut above: Vec<Sphere> = Vec::new();
            above.try_reserve_exact(level.len().div_ceil(FANOUT))?;
            for run in level.chunks(FANOUT) {
                let mut bounds = Bounds::EMPTY;
                run.iter().for_each(|sphere| bounds.include(sphere.center));
                let spheres = run.iter().map(|sphere| (sphere.center, sphere.radius));
                above.push(around(middle(&bounds), spheres));
            }
            levels.try_reserve(2)?;
            levels.push(level);
            level = above;
        }
        levels.push(level);
        Ok(Self { levels })
    }

    /// The largest squared distance from `viewpoint`: of all v·v, v = p − C, as they
    /// are rounded, but computed only in blocks that may hold it.
    pub(crate) fn farthest_squared(&self, points: &Points, viewpoint: DVec3) -> f64 {
        let reach = |sphere: &Sphere| {
            let center = DVec3::from_array(sphere.center) - viewpoint;
            (square_root(center.dot(center)) + sphere.radius) * (1.0 + MARGIN)
        };
        let in_block = |block: usize, mut largest: f64| {
            for index in block * BLOCK..points.len().min((block + 1) * BLOCK) {
                let v = DVec3::from_array(points.get(index)) - viewpoint;
                largest = largest.max(v.dot(v));
            }
            largest
        };
        let mut promising = (0, 0.0);
        for (block, sphere) in self.levels[0].iter().enumerate() {
            let reach = reach(sphere);
            if reach > promising.1 {
                promising = (block, reach);
            }
        }
        let mut largest = in_block(promising.0, 0.0);
        for (block, sphere) in self.levels[0].iter().enumerate() {
            let reach = reach(sphere);
            // Written so that nothing is left out where squares are not to be trusted.
            if !(reach * reach < largest && largest > 1e-200) {
                largest = in_block(block, largest);
            }
        }
        largest
    }
}

fn middle(bounds: &Bounds) -> [f64; 3] {
    core::array::from_fn(|axis| bounds.min[axis] * 0.5 + bounds.max[axis] * 0.5)
}

/// The sphere around `center` that holds all of these. Infinite, or NaN, where the
/// distances overflow: it leaves out nothing then.
fn around(center: [f64; 3], spheres: impl Iterator<Item = ([f64; 3], f64)>) -> Sphere {
    let mut radius = 0.0f64;
    for (other, size) in spheres {
        let v = DVec3::from_array(other) - DVec3::from_array(center);
        let far = (square_root(v.dot(v)) + size) * (1.0 + MARGIN);
        // Where squares underflow, the sum of the coordinates is large enough.
        let far = far.max(v.abs().element_sum().min(1e-150) + size);
        radius = radius.max(far);
    }
    Sphere { center, radius }
}
