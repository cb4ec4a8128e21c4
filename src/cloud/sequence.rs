//! The distinct points of a cloud in canonical order, each with the caller's indices of it.
//! The order is made here. It is also merged, thinned and made again here.
//!
//! Points follow the Hilbert curve; inside a cell they follow a second curve; coordinates
//! break ties. So the order depends on the set of points alone. No function changes a
//! sequence in place: where memory is refused, nothing has changed.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, push, reserve, with_capacity};
use crate::base::sort::{ordered, sort_by_numbers};
use crate::cloud::hilbert::BITS;
use crate::cloud::points::{Given, Points, Splice, is_finite};
use crate::cloud::spatial::{HilbertCurve, Place};

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
        let keyed = sort_along_curve(positions, finite, curve)?;
        let mut points = Points::with_capacity(keyed.len(), positions)?;
        let mut indices = Groups::with_capacity(keyed.len())?;
        let mut previous = None;
        for &(_, index) in &keyed {
            let point = without_negative_zero(positions.get(index as usize));
            let is_new = previous != Some(point);
            if is_new {
                previous = Some(point);
                points.push(point);
            }
            indices.push(first_index + index, is_new)?;
        }
        indices.close()?;
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

/// The finite positions in order: along the curve, then along the curve inside a cell, then
/// by coordinates, then by index. Most positions that share a cell are equal. Few positions of a
/// surface share a cell of a coarser curve, so that most need no more than its shorter key.
fn sort_along_curve(
    positions: Given,
    finite: usize,
    curve: &HilbertCurve,
) -> Result<Vec<(u64, u32)>, OutOfMemory> {
    let mut keyed: Vec<(u64, u32)> = with_capacity(finite)?;
    // With so many levels, a surface of n points crosses some 4·n cells.
    let levels = ((usize::BITS - finite.leading_zeros()).div_ceil(2) + 3).min(BITS);
    for (index, position) in positions.iter().enumerate() {
        if is_finite(position) {
            keyed.push((curve.coarse_key(position, levels), index as u32));
        }
    }
    let point = |index: u32| without_negative_zero(positions.get(index as usize));
    sort_by_numbers(&mut keyed, 7, &|number, index| match number {
        1 => curve.key(point(index)),
        2 => curve.key_in_cell(point(index)),
        axis @ 3..=5 => ordered(point(index)[axis - 3]),
        _ => u64::from(index),
    });
    Ok(keyed)
}

/// -0 becomes +0, so that equal points have equal bits.
pub(crate) fn without_negative_zero(point: [f64; 3]) -> [f64; 3] {
    point.map(|x| x + 0.0)
}
