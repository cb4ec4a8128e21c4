//! The distinct points of a cloud in canonical order, each with the caller's indices of it.
//! The order is made here. It is also merged, thinned and made again here.
//!
//! Points follow the Hilbert curve; inside a cell they follow a second curve; coordinates
//! break ties. So the order depends on the set of points alone. No function changes a
//! sequence in place: where memory is refused, nothing has changed.

use alloc::vec::Vec;

use crate::base::FULL;
use crate::base::allocation::{OutOfMemory, copied, filled, push, reserve, with_capacity};
use crate::base::sort::{Keyed, ordered, sort_by_numbers, sort_packed};
use crate::cloud::hilbert::Pairs;
use crate::cloud::points::{Given, Points, Splice};
use crate::cloud::spatial::{HilbertCurve, Place};

/// So many points are sorted at once, at most.
const AT_ONCE: usize = 1 << 20;
/// The levels of the curve along which more points are divided.
const COARSE: u32 = 4;

#[derive(Clone)]
pub(crate) struct Sequence {
    /// Distinct and finite.
    pub points: Points,
    indices: Groups,
}

impl Sequence {
    /// Sorts the finite `positions`, of which there are `finite`. The caller's indices of
    /// `positions` begin with `first_index`.
    #[inline(never)]
    pub(crate) fn sorted(
        positions: Given,
        first_index: u32,
        finite: usize,
        curve: &HilbertCurve,
    ) -> Result<Self, OutOfMemory> {
        let (mut points, mut order) = sort_along_curve(positions, finite, curve, AT_ONCE)?;
        let starts = points.dedup()?;
        for index in &mut order {
            *index += first_index;
        }
        let indices = Groups { order, starts };
        Ok(Self { points, indices })
    }

    /// Merges two sequences into one. Both follow `curve`. Runs between new points are copied as
    /// a whole, and only O(log n) keys are computed for each new point.
    #[inline(never)]
    pub(crate) fn merged(&self, new: &Self, curve: &HilbertCurve) -> Result<Self, OutOfMemory> {
        let mut places = with_capacity(new.points.len())?;
        let mut after = 0;
        for point in new.points.iter() {
            let start = self.first_not_before(&curve.place(point), after, curve);
            let present = start < self.points.len() && self.points.get(start) == point;
            after = start + usize::from(present);
            places.push(Splice { start, after });
        }

        let mut indices =
            Groups::with_capacity(self.indices.order.len() + new.indices.order.len())?;
        let mut copied = 0;
        for (k, &Splice { start, after }) in places.iter().enumerate() {
            for unchanged in copied..start {
                indices.copy(self.indices.of(unchanged).iter())?;
            }
            let present = (start..after).flat_map(|same| self.indices.of(same));
            indices.copy(present.chain(new.indices.of(k)))?;
            copied = after;
        }
        for unchanged in copied..self.points.len() {
            indices.copy(self.indices.of(unchanged).iter())?;
        }
        indices.close()?;
        Ok(Self {
            points: self.points.spliced(&new.points, &places)?,
            indices,
        })
    }

    /// This sequence without the indices that `removed` names. A point goes when its last
    /// index goes.
    pub(crate) fn without(&self, removed: &dyn Fn(u32) -> bool) -> Result<Self, OutOfMemory> {
        let mut kept = with_capacity(self.points.len())?;
        let mut indices = Groups::with_capacity(self.indices.order.len())?;
        for k in 0..self.points.len() {
            let mut stays = false;
            for &index in self.indices.of(k) {
                if !removed(index) {
                    indices.push(index, !stays)?;
                    if !stays {
                        stays = true;
                        kept.push(k as u32);
                    }
                }
            }
        }
        indices.close()?;
        Ok(Self {
            points: self.points.gathered(&kept)?,
            indices,
        })
    }

    /// The points at these places, which ascend.
    #[inline(never)]
    pub(crate) fn selected(&self, places: &[u32]) -> Result<Self, OutOfMemory> {
        let mut indices = Groups::with_capacity(places.len())?;
        for &place in places {
            let list = self.indices.of(place as usize);
            reserve(&mut indices.order, list.len())?;
            indices.copy(list.iter())?;
        }
        indices.close()?;
        Ok(Self {
            points: self.points.gathered(places)?,
            indices,
        })
    }

    /// These points along another curve.
    #[inline(never)]
    pub(crate) fn resorted(&self, curve: &HilbertCurve) -> Result<Self, OutOfMemory> {
        let count = self.points.len();
        let sorted = Self::sorted(self.points.as_given(), 0, count, curve)?;
        // Distinct points: every group there is one place here.
        let mut indices = Groups::with_capacity(self.indices.order.len())?;
        for &k in &sorted.indices.order {
            indices.copy(self.indices.of(k as usize).iter())?;
        }
        indices.close()?;
        Ok(Self {
            points: sorted.points,
            indices,
        })
    }

    /// The caller's indices at other `positions`, one for each distinct point, along
    /// the curve through those.
    pub(crate) fn moved(
        &self,
        positions: &[[f64; 3]],
        curve: &HilbertCurve,
    ) -> Result<Self, OutOfMemory> {
        let sorted = Self::sorted(Given::Double(positions), 0, positions.len(), curve)?;
        // Points may have come to lie on each other.
        let mut indices = Groups::with_capacity(self.indices.order.len())?;
        for k in 0..sorted.points.len() {
            let before = sorted.indices.of(k).iter();
            indices.copy(before.flat_map(|&place| self.indices.of(place as usize)))?;
        }
        indices.close()?;
        Ok(Self {
            points: sorted.points,
            indices,
        })
    }

    /// The caller's indices of distinct point `k`.
    pub(crate) fn indices_of(&self, k: usize) -> &[u32] {
        self.indices.of(k)
    }

    /// The caller's index of each distinct point, if each has only one. Otherwise empty.
    pub(crate) fn single_indices(&self) -> &[u32] {
        if self.indices.starts.is_empty() {
            &self.indices.order
        } else {
            &[]
        }
    }

    /// The index of the first point, from `low` on, that does not come before `place`.
    #[inline(never)]
    fn first_not_before(&self, place: &Place, mut low: usize, curve: &HilbertCurve) -> usize {
        let before = |k: usize| curve.place(self.points.get(k)) < *place;
        // New points come in order too. So the search takes steps that double, then bisects
        // the last step.
        let mut step = 1;
        while low + step <= self.points.len() && before(low + step - 1) {
            low += step;
            step *= 2;
        }
        let mut high = (low + step - 1).min(self.points.len());
        while low < high {
            let middle = low + (high - low) / 2;
            if before(middle) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        low
    }
}

/// Lists of indices, one list for each distinct point, stored one after another.
#[derive(Clone)]
struct Groups {
    order: Vec<u32>,
    /// Where each list starts in `order`, with an end mark; empty where every
    /// list holds one index, and `order[k]` is list `k`.
    starts: Vec<u32>,
}

impl Groups {
    /// No list yet, with room for `count` indices.
    #[inline(never)]
    fn with_capacity(indices: usize) -> Result<Self, OutOfMemory> {
        let order = with_capacity(indices)?;
        Ok(Self {
            order,
            starts: Vec::new(),
        })
    }

    /// Adds an index to a new list, or to the last one.
    fn push(&mut self, index: u32, is_first: bool) -> Result<(), OutOfMemory> {
        let count = self.order.len();
        self.order.push(index);
        if is_first && self.starts.is_empty() {
            return Ok(());
        }
        self.mark(is_first, count)
    }

    /// Begins a list that starts at `count`, or lets the last list go on there.
    #[inline(never)]
    fn mark(&mut self, is_first: bool, count: usize) -> Result<(), OutOfMemory> {
        if is_first {
            return push(&mut self.starts, count as u32);
        }
        if self.starts.is_empty() {
            // This is the first list with more than one index.
            reserve(&mut self.starts, count)?;
            self.starts.extend(0..count as u32);
        }
        Ok(())
    }

    /// Adds a list.
    fn copy<'a>(&mut self, list: impl Iterator<Item = &'a u32>) -> Result<(), OutOfMemory> {
        let mut is_first = true;
        for &index in list {
            self.push(index, is_first)?;
            is_first = false;
        }
        Ok(())
    }

    /// Ends the last list.
    fn close(&mut self) -> Result<(), OutOfMemory> {
        if self.starts.is_empty() {
            return Ok(());
        }
        self.mark(true, self.order.len())
    }

    fn of(&self, k: usize) -> &[u32] {
        if self.starts.is_empty() {
            &self.order[k..=k]
        } else {
            &self.order[self.starts[k] as usize..self.starts[k + 1] as usize]
        }
    }
}

/// The finite positions in order, and their indices: along the curve, then along the curve inside a
/// cell, then by coordinates, then by index. At most `at_once` are sorted without a division.
fn sort_along_curve(
    positions: Given,
    finite: usize,
    curve: &HilbertCurve,
    at_once: usize,
) -> Result<(Points, Vec<u32>), OutOfMemory> {
    let sorter = Sorter::new(curve, finite);
    if !FULL || finite <= at_once {
        let order = sorter.order(positions, finite)?;
        return Ok((positions.gathered(&order)?, order));
    }
    // A processor's cache has no room for so many, so they are divided into the cells of a coarse curve.
    let cell = |p| curve.coarse_key(p, COARSE, &sorter.pairs) as usize;
    let mut starts = filled((1 << (3 * COARSE)) + 1, 0u32)?;
    positions.each_finite(&mut |_, p| starts[cell(p) + 1] += 1);
    for cell in 1..starts.len() {
        starts[cell] += starts[cell - 1];
    }
    let mut next = copied(&starts)?;
    let mut order = filled(finite, 0u32)?;
    positions.each_finite(&mut |index, p| {
        let place = &mut next[cell(p)];
        order[*place as usize] = index;
        *place += 1;
    });
    let mut points = Points::with_capacity(finite, positions)?;
    for ends in starts.windows(2) {
        let order = &mut order[ends[0] as usize..ends[1] as usize];
        let part = positions.gathered(order)?;
        let mut places = sorter.order(part.as_given(), order.len())?;
        points.extend(part.gathered(&places)?.as_given(), 0..order.len());
        for place in &mut places {
            *place = order[*place as usize];
        }
        order.copy_from_slice(&places);
    }
    Ok((points, order))
}

/// Sorts positions along a curve.
struct Sorter<'a> {
    curve: &'a HilbertCurve,
    pairs: Pairs,
    /// The levels of the curve by which the positions are sorted first.
    levels: u32,
}

impl<'a> Sorter<'a> {
    /// For a cloud of `count` positions.
    fn new(curve: &'a HilbertCurve, count: usize) -> Self {
        Self {
            curve,
            pairs: Pairs::new(),
            // With so many, few positions of a surface share a cell.
            levels: (usize::BITS - count.leading_zeros()).div_ceil(2) + 6,
        }
    }

    /// The order of the `finite` ones among the positions.
    fn order(&self, positions: Given, finite: usize) -> Result<Vec<u32>, OutOfMemory> {
        let point = |index: u32| without_negative_zero(positions.get(index as usize));
        let sort_by_all = |keyed: &mut [Keyed]| {
            sort_by_numbers(keyed, 6, &|number, index| match number {
                1 => self.curve.key_in_cell(point(index)),
                axis @ 2..=4 => ordered(point(index)[axis - 2]),
                _ => u64::from(index),
            });
        };
        // What stays is reserved first, so that what goes makes room for the points.
        let mut order = with_capacity(finite)?;
        let mut keyed: Vec<Keyed> = Vec::new();
        if !FULL {
            // Half as fast, and 2 kB less.
            reserve(&mut keyed, finite)?;
            positions.each_finite(&mut |index, p| keyed.push((self.curve.key(p), index)));
            sort_by_all(&mut keyed);
            order.extend(keyed.iter().map(|&(_, index)| index));
            return Ok(order);
        }
        // The first digits of a key share one number with the index, so that little memory is moved.
        let low = usize::BITS - positions.len().leading_zeros();
        let levels = self.levels.min((u64::BITS - low) / 3);
        // One piece of memory for the numbers and for the room to sort them: later it serves the points.
        let mut packed: Vec<u64> = with_capacity(2 * finite)?;
        positions.each_finite(&mut |index, p| {
            let key = self.curve.coarse_key(p, levels, &self.pairs);
            packed.push(key << low | u64::from(index));
        });
        packed.resize(2 * finite, 0);
        let (packed, room) = packed.split_at_mut(finite);
        sort_packed(packed, low, room);
        let index = |packed: u64| (packed & ((1 << low) - 1)) as u32;
        for cell in packed.chunk_by(|a, b| a >> low == b >> low) {
            if let &[one] = cell {
                order.push(index(one));
                continue;
            }
            keyed.clear();
            reserve(&mut keyed, cell.len())?;
            let indices = cell.iter().map(|&packed| index(packed));
            keyed.extend(indices.map(|index| (self.curve.key(point(index)), index)));
            sort_by_all(&mut keyed);
            order.extend(keyed.iter().map(|&(_, index)| index));
        }
        Ok(order)
    }
}

/// -0 becomes +0, so that equal points have equal bits.
pub(crate) fn without_negative_zero(point: [f64; 3]) -> [f64; 3] {
    point.map(|x| x + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::cloud::points::is_finite;
    use crate::cloud::spatial::Bounds;

    /// The order by what it is defined by.
    fn defined_order(positions: &[[f64; 3]], curve: &HilbertCurve) -> Vec<u32> {
        let mut order: Vec<u32> = (0..positions.len() as u32).collect();
        order.retain(|&index| is_finite(positions[index as usize]));
        let place = |&index: &u32| curve.place(without_negative_zero(positions[index as usize]));
        order.sort_by(|a, b| place(a).partial_cmp(&place(b)).unwrap());
        order
    }

    #[test]
    fn clouds_of_every_density_are_sorted_whole_and_divided() {
        let mut random = Random::new(5);
        let surface = random.bumpy(6000);
        // All but one point in a few cells, or in one; equal ones; -0.
        let dense = |scale: f64| {
            let near = surface.iter().map(move |p| p.map(|x| x * scale));
            near.chain([[1e6; 3]]).collect::<Vec<_>>()
        };
        let coarse = |x: f64| (x * 4.0).trunc();
        let grid = surface.iter().map(|p| p.map(coarse)).collect();
        let broken = (0..).zip(&surface);
        let broken = broken.map(|(k, p)| if k % 3 == 0 { [f64::NAN; 3] } else { *p });
        for positions in [
            surface.clone(),
            dense(1.0),
            dense(1e-9),
            grid,
            broken.collect(),
        ] {
            let mut bounds = Bounds::EMPTY;
            let finite = positions.iter().filter(|&&p| is_finite(p));
            finite.clone().for_each(|&p| bounds.include(p));
            let curve = HilbertCurve::new(&bounds);
            let expected = defined_order(&positions, &curve);
            for at_once in [0, AT_ONCE] {
                let given = Given::Double(&positions);
                let sorted = sort_along_curve(given, finite.clone().count(), &curve, at_once);
                let (points, order) = sorted.unwrap();
                assert_eq!(order, expected);
                let gathered = order.iter().map(|&index| positions[index as usize]);
                assert!(points.iter().eq(gathered));
            }
        }
    }
}
