//! The order in which a cloud keeps its points: along a 3D Hilbert curve.
//!
//! Neighbors on the curve are neighbors in space. So walks on the hull are short and memory
//! is read in runs. The order depends on the set of points alone, because coordinates break
//! ties on the curve. It does not depend on the order of the input, or on earlier changes of
//! the cloud. So everything that is computed in this order is reproducible to the bit.

use crate::base::real::{floor, positive_part};
use crate::cloud::hilbert::{BITS, Pairs, hilbert_key};

/// Cells along an axis.
const CELLS: f64 = (1u32 << BITS) as f64;

/// Axis-aligned bounding box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub min: [f64; 3],
    pub max: [f64; 3],
}

impl Bounds {
    pub(crate) const EMPTY: Self = Self {
        min: [f64::INFINITY; 3],
        max: [f64::NEG_INFINITY; 3],
    };

    pub(crate) fn include(&mut self, p: [f64; 3]) {
        self.union(&Self { min: p, max: p });
    }

    pub(crate) fn union(&mut self, other: &Self) {
        // Comparisons, because WebAssembly calls a function for `min` and `max`.
        for axis in 0..3 {
            if other.min[axis] < self.min[axis] {
                self.min[axis] = other.min[axis];
            }
            if other.max[axis] > self.max[axis] {
                self.max[axis] = other.max[axis];
            }
        }
    }

    /// The box around a few places. Where they are many, most change nothing, and [`Self::include`]
    /// is as fast.
    #[inline]
    pub(crate) fn around(places: impl Iterator<Item = [f64; 3]>) -> Self {
        let Self { min, max } = Self::EMPTY;
        let (mut min, mut max) = (min.map(in_order), max.map(in_order));
        for place in places {
            for (axis, x) in place.map(in_order).into_iter().enumerate() {
                min[axis] = min[axis].min(x);
                max[axis] = max[axis].max(x);
            }
        }
        let [min, max] = [min, max].map(|ends| ends.map(from_order));
        Self { min, max }
    }

    /// The length of the diagonal, 0 for an empty box.
    pub(crate) fn diagonal(&self) -> f64 {
        let extent = [0, 1, 2].map(|axis| (self.max[axis] - self.min[axis]).max(0.0));
        libm::hypot(libm::hypot(extent[0], extent[1]), extent[2])
    }

    /// A power of two k that scales the box to a size near 1, and k times a point near the
    /// middle of the box. The point has few bits, so that differences from coordinates of few
    /// bits are exact.
    pub(crate) fn coarse_center(&self) -> ([f64; 3], f64) {
        // An extent below this counts as 0: it lies far below the last bit of any coordinate.
        const NOTHING: f64 = 1.0 / (1u64 << 60) as f64;
        let mut extent = 0.0f64;
        for axis in 0..3 {
            let [low, high] = [self.min[axis] * 0.25, self.max[axis] * 0.25];
            extent = extent.max(high - low);
            extent = extent.max(low.abs().max(high.abs()) * NOTHING);
        }
        // The extent of an empty box is infinite.
        let unit = power_of_two_above(extent.min(f64::MAX * 0.5));
        let scale = (0.25 / unit).max(f64::MIN_POSITIVE);
        let middle = |axis: usize| {
            let sum = self.max[axis] * (0.5 * scale) + self.min[axis] * (0.5 * scale);
            floor(sum * 8.0 + 0.5) / 8.0
        };
        let center = [0, 1, 2].map(middle);
        (center.map(|x| if x.is_finite() { x } else { 0.0 }), scale)
    }

    /// Squared distance from `p` to the box, 0 inside.
    #[inline]
    pub(crate) fn distance_squared(&self, p: [f64; 3]) -> f64 {
        self.gap_squared(&Self { min: p, max: p })
    }

    /// Squared distance between two boxes, 0 where they meet.
    #[inline]
    pub(crate) fn gap_squared(&self, other: &Self) -> f64 {
        let mut sum = 0.0;
        for axis in 0..3 {
            // At most one of the two is positive.
            let after = positive_part(self.min[axis] - other.max[axis]);
            let before = positive_part(other.min[axis] - self.max[axis]);
            let gap = after + before;
            sum += gap * gap;
        }
        sum
    }
}

/// A whole number in the order of the floats. WebAssembly engines compare whole numbers without a
/// branch.
#[inline]
fn in_order(x: f64) -> i64 {
    let bits = x.to_bits() as i64;
    bits ^ (bits >> 63 & i64::MAX)
}

/// The float of a number of [`in_order`].
#[inline]
fn from_order(number: i64) -> f64 {
    f64::from_bits((number ^ (number >> 63 & i64::MAX)) as u64)
}

/// Maps points of a box to their place on the Hilbert curve through a cube that
/// holds the box.
///
/// The cube depends on the box only coarsely: its side is twice a power of two,
/// the `unit`, that is at least the box's largest extent, and its corner a multiple
/// of that unit. So a cloud that grows or shrinks mostly keeps its curve and the order of
/// its points; there are only a few corners for each unit.
///
/// All lengths are quarters here, because the extent of a finite box can overflow.
#[derive(PartialEq)]
pub(crate) struct HilbertCurve {
    /// The corner in units; infinite along an axis where that overflows. All coordinates of
    /// such an axis are equal, and lie in cell 0.
    corner: [f64; 3],
    /// 1 ÷ unit, which is exact.
    per_unit: f64,
}

/// The place of a point in the order: its key, then its key in the cell, then its
/// coordinates, none of which is -0.
#[derive(PartialEq, PartialOrd)]
pub(crate) struct Place {
    key: u64,
    key_in_cell: u64,
    point: [f64; 3],
}

impl HilbertCurve {
    #[inline(never)]
    pub(crate) fn new(bounds: &Bounds) -> Self {
        let mut extent = 0.0f64;
        for axis in 0..3 {
            extent = extent.max(bounds.max[axis] * 0.25 - bounds.min[axis] * 0.25);
        }
        let unit = power_of_two_above(extent);
        Self {
            corner: bounds.min.map(|least| floor(least * 0.25 / unit) * unit),
            per_unit: 1.0 / unit,
        }
    }

    /// The key of `p` among all points; equal points have equal keys.
    #[inline(never)]
    pub(crate) fn key(&self, p: [f64; 3]) -> u64 {
        hilbert_key(self.cells(p).map(cell), BITS)
    }

    /// The key of the cell of `p` in the coarser curve with so many levels.
    #[inline(never)]
    pub(crate) fn coarse_key(&self, p: [f64; 3], levels: u32, pairs: &Pairs) -> u64 {
        pairs.key(self.cells(p).map(cell), levels)
    }

    /// The key of `p` among the points of one cell, along a curve inside the cell. A single far
    /// point can make the box so large that all other points share a few cells.
    #[inline(never)]
    pub(crate) fn key_in_cell(&self, p: [f64; 3]) -> u64 {
        let inside = |cells: f64| cell((cells - f64::from(cell(cells))) * CELLS);
        hilbert_key(self.cells(p).map(inside), BITS)
    }

    #[inline(never)]
    pub(crate) fn place(&self, point: [f64; 3]) -> Place {
        Place {
            key: self.key(point),
            key_in_cell: self.key_in_cell(point),
            point,
        }
    }

    /// How many cells `p` is away from the corner, along each axis.
    fn cells(&self, p: [f64; 3]) -> [f64; 3] {
        let along = |axis: usize| (p[axis] * 0.25 - self.corner[axis]) * self.per_unit;
        // One unit holds half of the cells.
        core::array::from_fn(|axis| along(axis) * (0.5 * CELLS))
    }
}

/// The number of the cell. A point that rounding put beyond the last cell belongs to it.
fn cell(cells: f64) -> u32 {
    // `as` saturates.
    (cells as u32).min((1 << BITS) - 1)
}

/// The smallest normal power of two not below `x`, which is at most 2^1023.
fn power_of_two_above(x: f64) -> f64 {
    const FRACTION: u64 = (1 << 52) - 1;
    f64::from_bits((x.max(f64::MIN_POSITIVE).to_bits() + FRACTION) & !FRACTION)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(min: [f64; 3], max: [f64; 3]) -> HilbertCurve {
        HilbertCurve::new(&Bounds { min, max })
    }

    #[test]
    fn small_changes_of_the_box_keep_the_curve() {
        let before = curve([0.1, 0.2, -0.3], [3.5, 1.0, 0.0]);
        assert!(before == curve([0.0, 0.9, -3.9], [4.0, 1.0, -3.8]));
        assert!(before != curve([0.1, 0.2, -0.3], [4.2, 1.0, 0.0]));
        assert!(before != curve([-0.1, 0.2, -0.3], [3.5, 1.0, 0.0]));
    }

    #[test]
    fn a_box_of_any_size_and_place_is_told_apart() {
        let tiny = f64::MIN_POSITIVE;
        for [low, high] in [
            [0.0, 1.0],
            [-f64::MAX, f64::MAX],
            [f64::MAX / 2.0, f64::MAX],
            [-64.0 * tiny, 64.0 * tiny],
            [1e6, 1e6 + 1e-6],
            [-1.0 - f64::EPSILON, -1.0],
        ] {
            let curve = curve([low, low, 1e300], [high, high, 1e300]);
            let key = |x, y| curve.key([x, y, 1e300]);
            let mut corners = [
                key(low, low),
                key(low, high),
                key(high, low),
                key(high, high),
            ];
            corners.sort_unstable();
            assert!(corners.is_sorted_by(|a, b| a < b), "{low}..{high}");
        }
    }

    #[test]
    fn points_beyond_the_last_cell_belong_to_it() {
        assert_eq!([-1.0, 0.0, 5.9].map(cell), [0, 0, 5]);
        let last = (1 << BITS) - 1;
        assert_eq!(
            [f64::from(last), f64::from(last) + 1.0, 1e300].map(cell),
            [last; 3]
        );
    }
}
