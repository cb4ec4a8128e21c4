//! One view divided among several workers: by the direction in which points are seen.
//!
//! INPUT    a cloud's points and blocks, a viewpoint and a radius; the number of the sector, and
//!          the number of all sectors.
//! OUTPUT   for each point, whether it is the sector's own, and whether it is near the sector or
//!          far from it; and bounds of m·q over the far points.
//! SUMMARY  The unit vectors of the points' directions are cut in two along an axis, then each
//!          half again. A sector is a box of them, its *cell*, and owns the points in it. Every
//!          worker finds the same cells. Any division gives the right answer (see
//!          `hull::share`). This division has short seams.

mod cell;
mod cone;
mod far;
mod leaf_cache;
#[cfg(test)]
mod tests;

pub(crate) use self::cone::Sector;

use alloc::vec::Vec;
use glam::DVec3;

use self::cell::{Cell, Item};
use self::cone::{Cone, MARGIN};
use self::far::{Far, places_in};
use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::real::{larger, square_root};
use crate::cloud::blocks::{BLOCK, Blocks};
use crate::cloud::points::Points;
use crate::hull::flipped::Flipped;

/// How one sector sees the cloud.
pub(crate) struct Division {
    /// The sector's own points: a bit for each point, a number for each block.
    own: Vec<u64>,
    /// The sector's own points, and those near its seams.
    near: Vec<u64>,
    far: Far,
    cell: Cell,
    /// For each block, no point of it has a larger excess.
    most_excess: Vec<f64>,
    /// Every direction in which a far point is seen is farther than this from the cell.
    clearance: f64,
    /// No flipped point is nearer to the origin.
    nearest: f64,
}

/// A direction is known better than this.
const DOUBT: f64 = 1e-9;
/// The number of sampled blocks that decide how the work is shared.
const SAMPLES: usize = 1024;
/// The work of a visible point; the work of a hidden one is 1.
const SEEN: u32 = 4;
/// The width of the band of near points around the cell, in mean radii of the blocks as seen.
const BAND: f64 = 0.4;
/// The step from one block of the sample to the next.
fn sample_step(blocks: usize) -> usize {
    blocks.div_ceil(SAMPLES).max(1)
}

impl Division {
    /// A sample of the points. A view of the sample alone decides how the work is shared.
    pub(crate) fn sample(blocks: &Blocks) -> impl Iterator<Item = u32> {
        let count = blocks.levels[0].len();
        (0..count)
            .step_by(sample_step(count))
            .map(|block| (block * BLOCK) as u32)
    }

    /// `seen` are the visible points of the sample. No point is farther than `radius`.
    pub(crate) fn new(
        points: &Points,
        blocks: &Blocks,
        viewpoint: DVec3,
        radius: f64,
        seen: &[bool],
        sector: Sector,
    ) -> Result<Self, OutOfMemory> {
        let diameter = 2.0 * radius * (1.0 + MARGIN);
        let mut levels: Vec<Vec<Cone>> = Vec::new();
        levels.try_reserve_exact(blocks.levels.len())?;
        for spheres in &blocks.levels {
            let mut cones = with_capacity(spheres.len())?;
            cones.extend(
                spheres
                    .iter()
                    .map(|sphere| Cone::of(sphere, viewpoint, diameter)),
            );
            levels.push(cones);
        }
        let cones = &levels[0];
        let step = sample_step(cones.len());
        let mut items = with_capacity(seen.len())?;
        let mut spreads = 0.0;
        for (cone, &seen) in cones.iter().step_by(step).zip(seen) {
            spreads += cone.spread();
            items.push(Item {
                direction: cone.axis,
                work: if seen { SEEN } else { 1 },
            });
        }
        let spread = spreads / items.len().max(1) as f64;
        let clearance = BAND * spread;
        let cell = Cell::of(sector, &mut items)?;
        let mut own = with_capacity(cones.len())?;
        let mut near = with_capacity(cones.len())?;
        let mut most_excess = with_capacity(cones.len())?;
        for (block, cone) in cones.iter().enumerate() {
            let room = cone.spread();
            let excess = cell.excess(cone.axis);
            // All points of most blocks are on one side of every seam.
            let (is_own, is_near) = if cone.is_everywhere() || excess.abs() <= room + clearance {
                let start = block * BLOCK;
                let directions = (start..points.len().min(start + BLOCK))
                    .map(|index| direction(DVec3::from_array(points.get(index)) - viewpoint));
                cell.places(directions, clearance)
            } else if excess < 0.0 {
                let all = places_in(block, points.len());
                (all, all)
            } else {
                (0, 0)
            };
            own.push(is_own);
            most_excess.push(excess + room);
            near.push(is_near);
        }
        let mut taken = with_capacity(near.len())?;
        taken.extend_from_slice(&near);
        Ok(Self {
            own,
            far: Far::new(levels, taken, points.len(), spread)?,
            near,
            most_excess,
            cell,
            clearance,
            nearest: radius * (1.0 - MARGIN),
        })
    }

    pub(crate) fn block_count(&self) -> usize {
        self.near.len()
    }

    /// Which points of a block are in the hull or will be in it.
    #[inline]
    pub(crate) fn near(&self, block: usize) -> u64 {
        self.near[block]
    }

    /// An upper bound of how far the direction of `q` lies outside of the sector's cell; negative
    /// inside. `q` is point `index`.
    #[inline]
    pub(crate) fn excess(&self, index: u32, q: DVec3) -> f64 {
        let bound = self.most_excess[index as usize / BLOCK];
        if bound < -self.clearance {
            return bound;
        }
        self.cell.excess(q / square_root(q.dot(q)))
    }

    /// Whether no far point is seen in the directions of a face. Its corners are flipped points.
    ///
    /// Each direction in the face is nearer to a corner than the longest edge, on the unit sphere.
    /// There, distances are at most those of the flipped points, divided by the length of the
    /// shortest flipped point.
    pub(crate) fn is_clear(&self, [a, b, c]: [u32; 3], corners: [DVec3; 3]) -> bool {
        let [p, q, r] = corners;
        let excess = larger(
            self.excess(a, p),
            larger(self.excess(b, q), self.excess(c, r)),
        );
        let [pq, qr, rp] = [p - q, q - r, r - p].map(|edge| edge.dot(edge));
        let longest = larger(pq, larger(qr, rp));
        let room = self.clearance - excess - 2.0 * DOUBT;
        // For longer edges the first statement does not hold.
        let room = if room < 1.0 { room } else { 1.0 };
        room > 0.0 && longest < room * room * self.nearest * self.nearest
    }

    /// A place in each part of the directions where far points may be seen, near the origin. A
    /// part is what lies beyond one side of the cell, so it is a cap of the sphere of directions.
    pub(crate) fn outside(&self) -> impl Iterator<Item = DVec3> {
        let centers = self.cell.caps(self.clearance - DOUBT);
        let near = 1e-3 * self.nearest;
        centers.map(move |u| near * u)
    }

    /// Whether this sector decides about point `index` of the spatial order.
    #[inline]
    pub(crate) fn owns(&self, index: u32) -> bool {
        self.own[index as usize / BLOCK] >> (index as usize % BLOCK) & 1 != 0
    }

    /// Whether a point is far: not in the hull.
    #[cfg(debug_assertions)]
    pub(crate) fn is_far(&self, index: u32) -> bool {
        !self.far.is_taken(index)
    }

    /// About how many points the sector's hull is made of.
    pub(crate) fn near_points(&self) -> usize {
        self.near
            .iter()
            .map(|near| near.count_ones() as usize)
            .sum()
    }

    /// Leaves only the sector's own points marked.
    pub(crate) fn keep_own(&self, visible: &mut [bool]) {
        for (index, visible) in (0..).zip(visible) {
            *visible &= self.owns(index);
        }
    }

    /// The far point with the largest m·q, or `None` if m·q is below `limit` for all far points.
    pub(in crate::hull) fn most_in_the_way(
        &mut self,
        support: (DVec3, f64),
        flipped: &Flipped,
    ) -> Result<Option<u32>, OutOfMemory> {
        self.far.most_in_the_way(support, flipped)
    }

    /// Notes that a point is in the hull.
    pub(crate) fn take(&mut self, index: u32) {
        self.far.take(index);
    }
}

/// The direction of a point at `v` from the viewpoint; zero for a point at the viewpoint.
fn direction(v: DVec3) -> DVec3 {
    let distance = square_root(v.dot(v));
    // Squares must not have underflowed.
    if distance > 1e-100 {
        v / distance
    } else {
        DVec3::ZERO
    }
}
