//! Heights of points above a plane, with bounds of their errors.

use alloc::vec::Vec;

/// A plane through the point in question: its normal m, and a bound of the error of the height of
/// another point, relative to the sum of the products and absolute.
#[derive(Default)]
pub(super) struct Plane {
    pub normal: Vec<f64>,
    relative: f64,
    absolute: f64,
    /// A point whose product with the normal is smaller is below the plane for sure.
    pub below: f64,
}

impl Plane {
    /// Sets the bounds for the plane through `q`, if the normal has an error of its own.
    pub(super) fn bound(&mut self, relative: f64, q: &[f64]) {
        // A difference, a product and sums, with room for the rounding of the bound itself.
        self.relative = relative + (self.normal.len() + 4) as f64 * f64::EPSILON;
        let size = self.normal.iter().fold(0.0, |sum, m| sum + m.abs());
        // Far above anything that underflows.
        self.absolute = 1e-300 * (1.0 + size);
        // No coordinate is 2 or larger.
        self.below = self.product(q) - 4.0 * size * self.relative - self.absolute;
    }

    #[inline(never)]
    pub(super) fn product(&self, p: &[f64]) -> f64 {
        let axes = self.normal.iter().zip(p);
        axes.fold(0.0, |sum, (m, x)| sum + m * x)
    }

    /// m·(p − q), and a bound of its error.
    #[inline(never)]
    pub(super) fn height(&self, p: &[f64], q: &[f64]) -> (f64, f64) {
        let (mut height, mut size) = (0.0, 0.0);
        for ((m, p), q) in self.normal.iter().zip(p).zip(q) {
            let product = m * (p - q);
            height += product;
            size += product.abs();
        }
        (height, size * self.relative + self.absolute)
    }
}

/// Subtracts a multiple of `other` from `row`.
#[inline(never)]
pub(super) fn subtract(row: &mut [f64], times: f64, other: &[f64]) {
    for (x, y) in row.iter_mut().zip(other) {
        *x -= times * y;
    }
}
