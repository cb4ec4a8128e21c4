//! One view divided among several workers: by the direction in which points are seen.
//!
//! INPUT    a cloud's blocks, a viewpoint and a radius; the number of the sector, and the
//!          number of all sectors.
//! OUTPUT   for each block, whether it is the sector's own, near it or far from it,
//!          the same in every worker; and bounds of m·q over the far blocks.
//! SUMMARY  The directions are cut by half-planes that meet in a line through the
//!          viewpoint. Every block belongs to the sector of its center. Any division gives
//!          the right answer (see `hull::share`). This division has short seams.

mod cone;
mod fan;

use alloc::vec::Vec;
use glam::DVec3;

use self::cone::{Cone, MARGIN, positive_root};
use self::fan::{Fan, sample_step};
use crate::base::allocation::{OutOfMemory, filled, reserve, with_capacity};
use crate::base::real::square_root;
use crate::cloud::blocks::{BLOCK, Blocks, FANOUT};

/// One of several sectors that a view is divided into.
///
/// Each sector can be asked in a thread of its own. It needs nothing from the others. See
/// [`PointCloud::visible_in_sector`](crate::PointCloud::visible_in_sector).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sector {
    pub(crate) number: u32,
    pub(crate) count: u32,
}

impl Sector {
    /// The one sector of a view that is not divided.
    #[cfg(feature = "wasm")]
    pub(crate) const WHOLE: Self = Self {
        number: 0,
        count: 1,
    };

    /// Sector `number` of `count`; `None` unless `number` is below `count`.
    #[must_use]
    pub fn new(number: u32, count: u32) -> Option<Self> {
        (number < count).then_some(Self { number, count })
    }
}

/// The role of a block for a sector.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    /// The sector decides about its points.
    Own,
    /// It belongs to another sector, but it is near the seam or already in the hull.
    Entered,
    /// It belongs to another sector and is not in the hull.
    Far,
}

/// How one sector sees the cloud.
pub(crate) struct Division {
    /// The role of each block.
    pub roles: Vec<Role>,
    /// The cones of the blocks and of the nodes above them.
    levels: Vec<Vec<Cone>>,
    /// How many blocks below each node are far.
    far: Vec<Vec<u32>>,
    /// The normals n of the two seams. Every far direction u has n·u ≥ `clearance` for one of
    /// them.
    seams: [DVec3; 2],
    clearance: f64,
    /// √(1 − clearance²)
    edge: f64,
    /// Whether the two seams differ.
    is_wedge: bool,
    /// No far point is flipped farther than this.
    reach: f64,
}

impl Division {
    /// A sample of the points. A view of the sample alone decides how the work is shared.
    pub(crate) fn sample(blocks: &Blocks) -> impl Iterator<Item = u32> {
        let count = blocks.levels[0].len();
        (0..count)
            .step_by(sample_step(count))
            .map(|block| (block * BLOCK) as u32)
    }

    /// `ahead` is a place in the cloud's middle; `seen` are the visible points of the sample.
    pub(crate) fn new(
        blocks: &Blocks,
        viewpoint: DVec3,
        ahead: DVec3,
        radius: f64,
        seen: &[bool],
        sector: Sector,
    ) -> Result<Self, OutOfMemory> {
        let diameter = 2.0 * radius * (1.0 + MARGIN);
        let mut levels: Vec<Vec<Cone>> = Vec::new();
        let mut far: Vec<Vec<u32>> = Vec::new();
        levels.try_reserve_exact(blocks.levels.len())?;
        far.try_reserve_exact(blocks.levels.len())?;
        for spheres in &blocks.levels {
            let mut cones = with_capacity(spheres.len())?;
            cones.extend(
                spheres
                    .iter()
                    .map(|sphere| Cone::of(sphere, viewpoint, diameter)),
            );
            levels.push(cones);
            let none = filled(spheres.len(), 0)?;
            far.push(none);
        }
        let fan = Fan::new(&levels[0], ahead - viewpoint, seen, sector.count as usize)?;
        let seams = fan.seams(sector.number as usize);
        let mut division = Self {
            roles: Vec::new(),
            levels,
            far,
            seams,
            clearance: fan.clearance,
            edge: positive_root(1.0 - fan.clearance * fan.clearance),
            is_wedge: true,
            reach: 0.0,
        };
        division.assign(&fan, sector)?;
        Ok(division)
    }

    #[inline(never)]
    fn assign(&mut self, fan: &Fan, sector: Sector) -> Result<(), OutOfMemory> {
        let mut beyond = [true; 2];
        let count = self.levels[0].len();
        self.roles.try_reserve_exact(count)?;
        for block in 0..count {
            let cone = self.levels[0][block];
            let role = if fan.sector_of(cone.axis) == sector.number as usize {
                Role::Own
            } else {
                let clear = self.seams.map(|n| cone.least(n) >= self.clearance);
                if clear == [false; 2] {
                    Role::Entered
                } else {
                    beyond[0] &= clear[0];
                    beyond[1] &= clear[1];
                    if cone.reach > self.reach {
                        self.reach = cone.reach;
                    }
                    for (level, far) in self.far.iter_mut().enumerate() {
                        far[block / FANOUT.pow(level as u32)] += 1;
                    }
                    Role::Far
                }
            };
            self.roles.push(role);
        }
        // Every far block beyond this seam is beyond the other seam too.
        match beyond {
            [true, _] => self.seams[1] = self.seams[0],
            [_, true] => self.seams[0] = self.seams[1],
            _ => {}
        }
        self.is_wedge = self.seams[0] != self.seams[1];
        Ok(())
    }

    /// Whether this sector decides about point `index` of the spatial order.
    #[inline]
    pub(crate) fn owns(&self, index: u32) -> bool {
        self.roles[index as usize / BLOCK] == Role::Own
    }

    /// About how many points the sector's hull is made of.
    pub(crate) fn near_points(&self) -> usize {
        let near = self.roles.iter().filter(|&&role| role != Role::Far);
        near.count() * BLOCK
    }

    /// Leaves only the sector's own points marked.
    pub(crate) fn keep_own(&self, visible: &mut [bool]) {
        for (points, &role) in visible.chunks_mut(BLOCK).zip(&self.roles) {
            if role != Role::Own {
                points.fill(false);
            }
        }
    }

    /// An upper bound of m·q over all far points. It takes a few products only.
    #[inline]
    pub(crate) fn bound_of_all(&self, m: DVec3) -> f64 {
        let squared = m.dot(m);
        let length = square_root(squared);
        let beyond = |n: DVec3| {
            let along = m.dot(n);
            if along >= self.clearance * length {
                length
            } else {
                // In the plane of m and n, at the edge of what is clear of the seam.
                let across = positive_root(squared - along * along);
                along * self.clearance + across * self.edge
            }
        };
        let mut largest = beyond(self.seams[0]);
        if self.is_wedge {
            let other = beyond(self.seams[1]);
            if other > largest {
                largest = other;
            }
        }
        (largest + MARGIN * length) * self.reach
    }

    /// The far block in which m·q may be largest. `None` if m·q is below `limit` in all far
    /// blocks.
    #[inline(never)]
    pub(crate) fn most_in_the_way(
        &self,
        m: DVec3,
        mut limit: f64,
    ) -> Result<Option<u32>, OutOfMemory> {
        let length = square_root(m.dot(m));
        let mut most = None;
        let top = self.levels.len() - 1;
        let mut path: Vec<(usize, usize)> = Vec::new();
        reserve(&mut path, FANOUT * self.levels.len())?;
        path.extend((0..self.levels[top].len()).map(|node| (top, node)));
        while let Some((level, node)) = path.pop() {
            if self.far[level][node] == 0 {
                continue;
            }
            let bound = self.levels[level][node].bound(m, length);
            if bound < limit {
                continue;
            }
            if level == 0 {
                most = Some(node as u32);
                limit = bound;
            } else {
                let below = self.levels[level - 1].len();
                let children = node * FANOUT..below.min((node + 1) * FANOUT);
                path.extend(children.map(|child| (level - 1, child)));
            }
        }
        Ok(most)
    }

    /// Notes that the points of a far block have been put into the hull.
    pub(crate) fn enter(&mut self, block: u32) {
        self.roles[block as usize] = Role::Entered;
        for (level, far) in self.far.iter_mut().enumerate() {
            far[block as usize / FANOUT.pow(level as u32)] -= 1;
        }
    }
}
