//! Positions as they are given and as they are stored.

use alloc::vec::Vec;

use crate::error::Error;

/// A point as three coordinates: `[f32; 3]` or `[f64; 3]`. Single precision is
/// stored as it is and widened when it is used.
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
    use super::{Points, Vec};

    pub trait Sealed: Sized {
        /// -0 becomes +0, so that equal points have equal bits.
        fn without_negative_zero(self) -> Self;
        fn store(points: Vec<Self>) -> Points;
    }

    impl Sealed for [f32; 3] {
        fn without_negative_zero(self) -> Self {
            self.map(|x| x + 0.0)
        }
        fn store(points: Vec<Self>) -> Points {
            Points::Single(points)
        }
    }

    impl Sealed for [f64; 3] {
        fn without_negative_zero(self) -> Self {
            self.map(|x| x + 0.0)
        }
        fn store(points: Vec<Self>) -> Points {
            Points::Double(points)
        }
    }
}

/// Points in the precision they came in. (Public only inside this private module.)
///
/// An enum rather than a type parameter, so that everything downstream is compiled
/// once; which precision it is, every access finds out anew, at no cost that shows.
pub enum Points {
    Single(Vec<[f32; 3]>),
    Double(Vec<[f64; 3]>),
}

impl Points {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Single(points) => points.len(),
            Self::Double(points) => points.len(),
        }
    }

    #[inline]
    pub(crate) fn get(&self, index: usize) -> [f64; 3] {
        match self {
            Self::Single(points) => points[index].widen(),
            Self::Double(points) => points[index],
        }
    }

    /// The points with these indices, in their order.
    pub(crate) fn gathered(&self, indices: &[u32]) -> Result<Self, Error> {
        fn gather<P: Copy>(points: &[P], indices: &[u32]) -> Result<Vec<P>, Error> {
            let mut gathered = Vec::new();
            gathered.try_reserve_exact(indices.len())?;
            gathered.extend(indices.iter().map(|&index| points[index as usize]));
            Ok(gathered)
        }
        Ok(match self {
            Self::Single(points) => Self::Single(gather(points, indices)?),
            Self::Double(points) => Self::Double(gather(points, indices)?),
        })
    }

    /// These and `new` ones, new one k in `places[k]`. Single precision only where
    /// both are, so that no coordinate is rounded.
    pub(crate) fn spliced(&self, new: &Self, places: &[Splice]) -> Result<Self, Error> {
        use Points::{Double, Single};
        let same = |p: [f64; 3]| p;
        Ok(match (self, new) {
            (Single(a), Single(b)) => Single(splice(a, b, places, |p| p, |p| p)?),
            (Single(a), Double(b)) => Double(splice(a, b, places, Position::widen, same)?),
            (Double(a), Single(b)) => Double(splice(a, b, places, same, Position::widen)?),
            (Double(a), Double(b)) => Double(splice(a, b, places, same, same)?),
        })
    }

    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = [f64; 3]> {
        (0..self.len()).map(|index| self.get(index))
    }
}

/// Where a new point goes among those present: before `after`, and in the stead
/// of those from `start`, which are none, or the one that equals it.
#[derive(Clone, Copy)]
pub(crate) struct Splice {
    pub start: usize,
    pub after: usize,
}

fn splice<A: Copy, B: Copy, P>(
    present: &[A],
    new: &[B],
    places: &[Splice],
    from_present: impl Fn(A) -> P,
    from_new: impl Fn(B) -> P,
) -> Result<Vec<P>, Error> {
    let equal: usize = places.iter().map(|place| place.after - place.start).sum();
    let mut all = Vec::new();
    all.try_reserve_exact(present.len() + new.len() - equal)?;
    let mut copied = 0;
    for (&point, place) in new.iter().zip(places) {
        all.extend(
            present[copied..place.start]
                .iter()
                .map(|&p| from_present(p)),
        );
        all.push(from_new(point));
        copied = place.after;
    }
    all.extend(present[copied..].iter().map(|&p| from_present(p)));
    Ok(all)
}

pub(crate) fn is_finite(p: [f64; 3]) -> bool {
    p.iter().all(|x| x.is_finite())
}
