//! Positions as they are given and as they are stored.

use alloc::vec::Vec;

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

    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = [f64; 3]> {
        (0..self.len()).map(|index| self.get(index))
    }
}
