//! Which directions belong to which sector.

use alloc::vec::Vec;
use glam::DVec3;

use super::Sector;
use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::sort::sort_keyed;
use crate::hull::locate::larger;

/// A block as it is seen: its direction, and the work that it stands for.
#[derive(Clone, Copy)]
pub(super) struct Item {
    pub direction: DVec3,
    pub work: u32,
}

/// The directions of one sector: the unit vectors in a box. All cells together hold each vector
/// once.
#[derive(Clone, Copy)]
pub(super) struct Cell {
    /// A vector of the cell is at least `low` and below `high` along each axis.
    low: DVec3,
    high: DVec3,
}

impl Cell {
    /// The cell of `sector`. Directions are cut in two, along the axis on which the work is spread
    /// most, then each part again. Each sector gets about the same work.
    pub(super) fn of(sector: Sector, items: &mut Vec<Item>) -> Result<Self, OutOfMemory> {
        let mut cell = Self {
            low: DVec3::NEG_INFINITY,
            high: DVec3::INFINITY,
        };
        let Sector {
            mut number,
            mut count,
        } = sector;
        while count > 1 {
            let axis = widest_axis(items);
            let lower = count / 2;
            let cut = cut(items, axis, lower, count)?;
            // Outside of the cell the cut would make it larger.
            let cut = cut.max(cell.low[axis]).min(cell.high[axis]);
            let is_lower = number < lower;
            if is_lower {
                cell.high[axis] = cut;
                count = lower;
            } else {
                cell.low[axis] = cut;
                number -= lower;
                count -= lower;
            }
            items.retain(|item| (item.direction[axis] < cut) == is_lower);
        }
        Ok(cell)
    }

    fn contains(&self, u: DVec3) -> bool {
        u.cmpge(self.low).all() && u.cmplt(self.high).all()
    }

    /// Which of these directions the cell holds, and which of them are in the cell or at most
    /// `clearance` outside: a bit for each.
    pub(super) fn places(
        &self,
        directions: impl Iterator<Item = DVec3>,
        clearance: f64,
    ) -> (u64, u64) {
        let mut inside = 0;
        let mut near = 0;
        for (place, u) in directions.enumerate() {
            inside |= u64::from(self.contains(u)) << place;
            near |= u64::from(self.excess(u) <= clearance) << place;
        }
        (inside, inside | near)
    }

    /// The centers of the caps of the unit sphere that lie more than `clearance` beyond a side.
    pub(super) fn caps(&self, clearance: f64) -> impl Iterator<Item = DVec3> {
        let Self { low, high } = *self;
        (0..3).flat_map(move |axis| {
            let up = high[axis] + clearance < 1.0;
            let down = low[axis] - clearance > -1.0;
            let center = DVec3::AXES[axis];
            (up.then_some(center).into_iter()).chain(down.then_some(-center))
        })
    }

    /// How far `u` lies outside along some axis; negative inside. It changes by at most the
    /// distance that `u` moves.
    #[inline]
    pub(super) fn excess(&self, u: DVec3) -> f64 {
        let (below, above) = (self.low - u, u - self.high);
        let along = |axis: usize| larger(below[axis], above[axis]);
        larger(along(0), larger(along(1), along(2)))
    }
}

fn widest_axis(items: &[Item]) -> usize {
    let mut total = 0.0;
    let (mut sum, mut squares) = (DVec3::ZERO, DVec3::ZERO);
    for &Item { direction, work } in items {
        total += f64::from(work);
        sum += f64::from(work) * direction;
        squares += f64::from(work) * direction * direction;
    }
    let spread = squares * total - sum * sum;
    if spread.x >= spread.y && spread.x >= spread.z {
        0
    } else if spread.y >= spread.z {
        1
    } else {
        2
    }
}

/// The place on an axis below which there are `lower` of `count` parts of the work.
fn cut(items: &[Item], axis: usize, lower: u32, count: u32) -> Result<f64, OutOfMemory> {
    // Numbers that are not negative have the same order as their bits.
    const SHIFT: f64 = 2.0;
    let mut places = with_capacity(items.len())?;
    places.extend(items.iter().map(|item| {
        let place = (item.direction[axis] + SHIFT).to_bits();
        (place, item.work)
    }));
    sort_keyed(&mut places);
    let total: u64 = places.iter().map(|&(_, work)| u64::from(work)).sum();
    let wanted = total * u64::from(lower) / u64::from(count);
    let mut below = 0;
    for (place, work) in places {
        below += u64::from(work);
        if below > wanted {
            return Ok(f64::from_bits(place) - SHIFT);
        }
    }
    Ok(0.0)
}
