//! The dual plane of a face: one dot product gives the side of a point.

use glam::DVec3;

/// A face's dual plane: `m·x = 1` on it, `m·x > 1` outside.
///
/// With u = a − p, w = b − p, n = u × w and D = n·p, m is n/D. In units of
/// ε = 2⁻⁵³ and with |p|, |q| ≤ L/2 the rounded value differs from the true
/// n·(q − p)/D by at most, to first order and with κ = ½(|u|² + |w|²)·L/D:
///
/// - n: 4√2·|u||w|, which shifts n·q/D by 2.9 κ;
/// - D: (4√2 + 3)·|u||w||p|, which shifts m·q by 4.4 κ·(m·q);
/// - the division and the sum m·q − 1: 5·|m||q| + 1 ≤ 2.5 κ + 1.
///
/// Where m·q is near 1, the sum of these errors is below 10 ε (1 + κ). `error` is twice that.
/// Farther from the plane the error grows with |m·q|, but by less than 10⁻⁵ of |m·q|. So the
/// sign stays right. The sign of the difference of two neighbors' m·q stays right, too, while
/// one of them is between 0 and 1. L is [`Flip::reach`].
///
/// [`Flip::reach`]: crate::flip::inversion::Flip::reach
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub m: DVec3,
    /// Bound of the error of `m·q − 1`; infinite where only exact signs count.
    pub error: f64,
}

impl Plane {
    /// The plane of ghost faces and of faces seen edge-on. It decides nothing by itself.
    pub(super) const EXACT_ONLY: Self = Self {
        m: DVec3::ZERO,
        error: f64::INFINITY,
    };

    /// The plane of a, b and p.
    #[inline]
    pub(super) fn through(a: DVec3, b: DVec3, p: DVec3, reach: f64) -> Self {
        Self::between(Spoke::new(a, p), Spoke::new(b, p), p, reach)
    }

    /// The plane of the two ends of spokes and of `p`, where the spokes start.
    #[inline]
    pub(super) fn between(u: Spoke, w: Spoke, p: DVec3, reach: f64) -> Self {
        const ROUNDING: f64 = f64::EPSILON / 2.0;
        const MAX_CONDITION: f64 = 1e10;
        // A volume above this shows that no product that matters has underflowed.
        const MIN_VOLUME: f64 = 1e-200;
        let n = u.along.cross(w.along);
        let volume = n.dot(p);
        let inverse = 1.0 / volume;
        let condition = 0.5 * (u.squared + w.squared) * reach * inverse;
        // The comparisons also refuse a NaN.
        if volume > MIN_VOLUME && volume < f64::MAX && condition < MAX_CONDITION {
            Self {
                m: n * inverse,
                error: 20.0 * ROUNDING * (1.0 + condition),
            }
        } else {
            Self::EXACT_ONLY
        }
    }

    #[inline]
    pub(super) fn is_exact_only(&self) -> bool {
        self.error == f64::INFINITY
    }
}

/// An edge from a vertex p to another vertex, and the square of its length.
#[derive(Clone, Copy)]
pub(super) struct Spoke {
    along: DVec3,
    squared: f64,
}

impl Spoke {
    /// The edge to the ghost vertex. A plane with this spoke decides nothing by itself.
    pub(super) const NONE: Self = Self {
        along: DVec3::ZERO,
        squared: 0.0,
    };

    #[inline]
    pub(super) fn new(end: DVec3, p: DVec3) -> Self {
        let along = end - p;
        Self {
            along,
            squared: along.length_squared(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::hull::predicates::{Sign, side_of_face};

    /// Faces on a fine lattice: mostly thin ones, whose planes are uncertain.
    #[test]
    fn signs_beyond_the_error_are_exact() {
        let mut random = Random::new(5);
        let mut decided = 0;
        for round in 0..40_000 {
            let unit = 2.0f64.powi(-10 - 10 * (round % 4));
            let mut point = || {
                let [x, y, z] = [7, 5, 6].map(|n| unit * random.below(n) as f64);
                DVec3::new(0.3 + x, 0.7 + y, 0.9 + x - z)
            };
            let [a, b, p, q] = core::array::from_fn(|_| point());
            let plane = Plane::through(a, b, p, 4.0);
            let height = plane.m.dot(q) - 1.0;
            if height.abs() > plane.error {
                let side = if height > 0.0 {
                    Sign::Positive
                } else {
                    Sign::Negative
                };
                assert_eq!(side_of_face(a, b, p, q), side, "{a} {b} {p} {q}");
                decided += 1;
            }
        }
        assert!(decided > 5_000, "only {decided} signs are beyond the error");
    }
}
