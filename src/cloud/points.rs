//! Positions as they are given and as they are stored.

use alloc::vec::Vec;
use core::ops::Range;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::error::Error;
use crate::base::real::one_by_one;
use crate::base::{FULL, MAX_POINTS};

/// A point as three coordinates, `[f32; 3]` or `[f64; 3]`. Single precision is stored as
/// given, and widened when it is used.
pub trait Position: sealed::Sealed + Copy {
    /// The coordinates in double precision.
    fn widen(self) -> [f64; 3];
}

impl Position for [f32; 3] {
    fn widen(self) -> [f64; 3] {
        self.map(f64::from)
    }
}

impl Position for [f64; 3] {
    fn widen(self) -> [f64; 3] {
        self
    }
}

mod sealed {
    use super::Given;

    pub trait Sealed: Sized {
        fn given(positions: &[Self]) -> Given<'_>;
    }

    impl Sealed for [f32; 3] {
        fn given(positions: &[Self]) -> Given<'_> {
            Given::Single(positions)
        }
    }

    impl Sealed for [f64; 3] {
        fn given(positions: &[Self]) -> Given<'_> {
            Given::Double(positions)
        }
    }
}

/// The caller's positions, in the precision in which they were given. (Public only inside
/// this private module.)
///
/// This is an enum rather than a type parameter, so that everything downstream is compiled
/// once. Every access branches on the precision, at no measurable cost.
#[derive(Clone, Copy)]
pub enum Given<'a> {
    Single(&'a [[f32; 3]]),
    Double(&'a [[f64; 3]]),
}

impl Given<'_> {
    pub(crate) fn len(self) -> usize {
        match self {
            Self::Single(points) => points.len(),
            Self::Double(points) => points.len(),
        }
    }

    #[inline]
    pub(crate) fn get(self, index: usize) -> [f64; 3] {
        match self {
            Self::Single(points) => points[index].widen(),
            Self::Double(points) => one_by_one(points[index].into()).into(),
        }
    }

    pub(crate) fn iter(self) -> impl ExactSizeIterator<Item = [f64; 3]> {
        (0..self.len()).map(move |index| self.get(index))
    }

    /// Calls `visit` with the index and the place of each finite one.
    #[inline(never)]
    pub(crate) fn each_finite(self, visit: &mut dyn FnMut(u32, [f64; 3])) {
        for (index, p) in (0..).zip(self.iter()) {
            if is_finite(p) {
                visit(index, p);
            }
        }
    }

    /// The points with these indices, in their order. -0 becomes +0, so that equal points have
    /// equal bits.
    pub(crate) fn gathered(self, indices: &[u32]) -> Result<Points, OutOfMemory> {
        let mut gathered = Points::with_capacity(indices.len(), self)?;
        let each = indices.iter().map(|&index| index as usize);
        match (&mut gathered, self) {
            (Points::Single(own), Self::Single(points)) if FULL => {
                own.extend(each.map(|index| points[index].map(|x| x + 0.0)));
            }
            (Points::Double(own), Self::Double(points)) if FULL => {
                own.extend(each.map(|index| points[index].map(|x| x + 0.0)));
            }
            // Slower, and less.
            _ => each.for_each(|index| gathered.push(self.get(index).map(|x| x + 0.0))),
        }
        Ok(gathered)
    }
}

/// The cloud's own points, in the precision in which they were given.
#[derive(Clone)]
pub(crate) enum Points {
    Single(Vec<[f32; 3]>),
    Double(Vec<[f64; 3]>),
}

impl Points {
    /// An empty list with room for `count` points. It has the precision of `positions`, so
    /// that no coordinate is rounded.
    #[inline(never)]
    pub(crate) fn with_capacity(count: usize, positions: Given) -> Result<Self, OutOfMemory> {
        fn reserved<P>(count: usize) -> Result<Vec<P>, OutOfMemory> {
            let points = with_capacity(count)?;
            Ok(points)
        }
        Ok(match positions {
            Given::Single(_) => Self::Single(reserved(count)?),
            Given::Double(_) => Self::Double(reserved(count)?),
        })
    }

    pub(crate) fn as_given(&self) -> Given<'_> {
        match self {
            Self::Single(points) => Given::Single(points),
            Self::Double(points) => Given::Double(points),
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.as_given().len()
    }

    #[inline]
    pub(crate) fn get(&self, index: usize) -> [f64; 3] {
        self.as_given().get(index)
    }

    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = [f64; 3]> {
        self.as_given().iter()
    }

    /// Adds a point that was given in the same precision.
    #[inline(never)]
    pub(crate) fn push(&mut self, point: [f64; 3]) {
        match self {
            Self::Single(points) => points.push(point.map(|x| x as f32)),
            Self::Double(points) => points.push(one_by_one(point.into()).into()),
        }
    }

    /// Adds a run of points that were given in the same precision or a lower one.
    #[inline(never)]
    pub(crate) fn extend(&mut self, points: Given, run: Range<usize>) {
        match (&mut *self, points) {
            (Self::Single(own), Given::Single(points)) => own.extend_from_slice(&points[run]),
            (Self::Double(own), Given::Double(points)) => own.extend_from_slice(&points[run]),
            _ => run.for_each(|index| self.push(points.get(index))),
        }
    }

    /// The points with these indices, in their order.
    pub(crate) fn gathered(&self, indices: &[u32]) -> Result<Self, OutOfMemory> {
        self.as_given().gathered(indices)
    }

    /// Leaves one of equal neighbors. Returns where each point began, and their number; nothing if
    /// all stay.
    pub(crate) fn dedup(&mut self) -> Result<Vec<u32>, OutOfMemory> {
        let count = self.len();
        let begins = |&k: &usize| k == 0 || self.get(k) != self.get(k - 1);
        let different = (0..count).filter(begins).count();
        if different == count {
            return Ok(Vec::new());
        }
        let mut starts = with_capacity(different + 1)?;
        starts.extend((0..count).filter(begins).map(|k| k as u32));
        starts.push(count as u32);
        match self {
            Self::Single(points) => points.dedup(),
            Self::Double(points) => points.dedup(),
        }
        Ok(starts)
    }

    /// The present points and the `new` ones, of which number k goes to `places[k]`.
    pub(crate) fn spliced(&self, new: &Self, places: &[Splice]) -> Result<Self, OutOfMemory> {
        let (present, new) = (self.as_given(), new.as_given());
        let equal: usize = places.iter().map(|place| place.after - place.start).sum();
        let widest = match present {
            Given::Single(_) => new,
            Given::Double(_) => present,
        };
        let mut all = Self::with_capacity(present.len() + new.len() - equal, widest)?;
        let mut copied = 0;
        for (k, place) in places.iter().enumerate() {
            all.extend(present, copied..place.start);
            all.push(new.get(k));
            copied = place.after;
        }
        all.extend(present, copied..present.len());
        Ok(all)
    }
}

/// The place of a new point among the present points. The new point comes before `after`. It
/// replaces the points from `start` up to `after`: none, or the one point that equals it.
#[derive(Clone, Copy)]
pub(crate) struct Splice {
    pub start: usize,
    pub after: usize,
}

pub(crate) fn is_finite(p: [f64; 3]) -> bool {
    p.iter().all(|x| x.is_finite())
}

/// `count`; an error if it is more than a cloud may hold.
pub(crate) fn checked_len(count: usize) -> Result<usize, Error> {
    if count > MAX_POINTS {
        return Err(Error::TooManyPoints { count });
    }
    Ok(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_points_than_a_cloud_may_hold_are_refused() {
        for count in [0, MAX_POINTS - 1, MAX_POINTS] {
            assert_eq!(checked_len(count), Ok(count));
        }
        for count in [MAX_POINTS + 1, MAX_POINTS + 2, usize::MAX] {
            assert_eq!(checked_len(count), Err(Error::TooManyPoints { count }));
        }
    }
}
