//! Exact signs. Shewchuk's adaptive predicates (crate `robust`) answer while
//! their expansions can neither over- nor underflow; exact sums answer the rest.
//!
//! Signs are told from the viewer's side. The viewer stands at the origin, and
//! a face (a, b, c) of the hull is counter-clockwise seen from outside.

use core::cmp::Ordering;

use glam::DVec3;
use robust::{Coord, Coord3D};

use crate::exact_sum::ExactSum;

/// The sign of an exact quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sign {
    Negative,
    Zero,
    Positive,
}

impl Sign {
    fn of(x: f64) -> Self {
        if x > 0.0 {
            Self::Positive
        } else if x < 0.0 {
            Self::Negative
        } else {
            Self::Zero
        }
    }

    fn of_sum(sum: &ExactSum) -> Self {
        match sum.sign() {
            Ordering::Less => Self::Negative,
            Ordering::Equal => Self::Zero,
            Ordering::Greater => Self::Positive,
        }
    }
}

/// Which side of the plane through the face (a, b, c) `q` is on: positive
/// outside (the side from which a, b, c are counter-clockwise), zero on it.
pub(crate) fn side_of_face(a: DVec3, b: DVec3, c: DVec3, q: DVec3) -> Sign {
    if [a, b, c, q].iter().all(|p| fits_expansions(&p.to_array())) {
        // orient3d is positive when its last point lies *below* the plane,
        // and for (c, b, a) below is our outside.
        return Sign::of(robust::orient3d(coord3(c), coord3(b), coord3(a), coord3(q)));
    }
    exact_side_of_face(a, b, c, q)
}

/// The sign of det(a, b, c): positive when a, b, c are clockwise seen from the
/// origin (so that the face (a, b, c) turns its inner side to the viewer), zero
/// when the three lie in one plane with the origin.
pub(crate) fn side_of_origin(a: DVec3, b: DVec3, c: DVec3) -> Sign {
    if [a, b, c].iter().all(|p| fits_expansions(&p.to_array())) {
        let origin = coord3(DVec3::ZERO);
        return Sign::of(robust::orient3d(coord3(a), coord3(b), coord3(c), origin));
    }
    exact_determinant(a.to_array(), b.to_array(), c.to_array())
}

/// Positive when a, b, c turn counter-clockwise, zero when they are in one line.
pub(crate) fn orient2d(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Sign {
    if [a, b, c].iter().all(|p| fits_expansions(p)) {
        let coord = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
        return Sign::of(robust::orient2d(coord(a), coord(b), coord(c)));
    }
    let row = |[x, y]: [f64; 2]| [x, y, 1.0];
    exact_determinant(row(a), row(b), row(c))
}

/// Whether expansions of degree 3 in these coordinates are exact: the last bit
/// of 2^-200 is 2^-252, whose cube 2^-756 is far above the smallest f64, and
/// cubes of 2^200 stay far below the largest.
fn fits_expansions(coordinates: &[f64]) -> bool {
    const BIAS: u64 = 1023;
    coordinates.iter().all(|x| {
        let exponent = x.to_bits() >> 52 & 0x7ff;
        (BIAS - 200..BIAS + 200).contains(&exponent) || *x == 0.0
    })
}

fn coord3(p: DVec3) -> Coord3D<f64> {
    Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    }
}

/// The sign of det(c − q, b − q, a − q), of which no difference is rounded.
fn exact_side_of_face(a: DVec3, b: DVec3, c: DVec3, q: DVec3) -> Sign {
    let [a, b, c, q] = [a, b, c, q].map(|p| p.to_array());
    let minus_q = q.map(|x| -x);
    let mut sum = ExactSum::ZERO;
    sum.add_determinant(c, b, a);
    sum.add_determinant(minus_q, b, a);
    sum.add_determinant(c, minus_q, a);
    sum.add_determinant(c, b, minus_q);
    Sign::of_sum(&sum)
}

fn exact_determinant(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> Sign {
    let mut sum = ExactSum::ZERO;
    sum.add_determinant(a, b, c);
    Sign::of_sum(&sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A small deterministic generator (splitmix64).
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> u64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = self.0;
            z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ z >> 31
        }

        /// Small integers and their near misses, so that signs are often in doubt.
        fn coordinate(&mut self) -> f64 {
            let whole = (self.next() % 7) as f64 - 3.0;
            match self.next() % 16 {
                0 => whole * 0.1,
                1 => whole * (1.0 + f64::EPSILON),
                _ => whole,
            }
        }

        fn point(&mut self) -> DVec3 {
            DVec3::from_array(core::array::from_fn(|_| self.coordinate()))
        }
    }

    #[test]
    fn signs_have_the_documented_sides() {
        let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
        assert_eq!(side_of_origin(x, y, z), Sign::Positive);
        assert_eq!(side_of_origin(x, y, x + y), Sign::Zero);
        assert_eq!(side_of_face(x, y, z, DVec3::ONE), Sign::Positive);
        assert_eq!(side_of_face(x, y, z, DVec3::ZERO), Sign::Negative);
        assert_eq!(side_of_face(x, y, z, x), Sign::Zero);
        assert_eq!(orient2d([0.0, 0.0], [1.0, 0.0], [0.0, 1.0]), Sign::Positive);
    }

    #[test]
    fn expansions_and_sums_agree() {
        let mut random = Random(7);
        let mut zeros = 0;
        for _ in 0..20_000 {
            let [a, b, c, q] = core::array::from_fn(|_| random.point());
            let sum = exact_side_of_face(a, b, c, q);
            assert_eq!(side_of_face(a, b, c, q), sum, "{a} {b} {c} {q}");
            zeros += usize::from(sum == Sign::Zero);

            let [a, b, c] = [a, b, c].map(|p| p.to_array());
            let sum = exact_determinant(a, b, c);
            assert_eq!(side_of_origin(a.into(), b.into(), c.into()), sum);
            let flat = |[x, y, _]: [f64; 3]| [x, y];
            let one = |[x, y, _]: [f64; 3]| [x, y, 1.0];
            let sum = exact_determinant(one(a), one(b), one(c));
            assert_eq!(orient2d(flat(a), flat(b), flat(c)), sum);
        }
        assert!(zeros > 300, "only {zeros} degenerate quadruples met");
    }

    #[test]
    fn extreme_scales_keep_their_sign() {
        let mut random = Random(11);
        for scale in [2.0f64.powi(-1000), 2.0f64.powi(-400), 2.0f64.powi(900)] {
            for _ in 0..2_000 {
                let [a, b, c, q] = core::array::from_fn(|_| random.point());
                let at_one = side_of_face(a, b, c, q);
                let [a, b, c, q] = [a, b, c, q].map(|p| p * scale);
                assert_eq!(side_of_face(a, b, c, q), at_one, "scale {scale:e}");
            }
        }
    }
}
