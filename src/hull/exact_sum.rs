//! Signs of sums of determinants of any finite `f64`s, exact over their whole range.
//!
//! Kulisch's long accumulator: every product of three `f64`s is an integer multiple of
//! 2^-3222 below 2^3072. So a fixed-point number of some 6,300 bits holds each product
//! exactly, and also sums of a few products. In WebAssembly this takes 1 kB; the three
//! operations of a library of big integers took 26 kB.

use core::cmp::Ordering;

const LIMB: usize = u64::BITS as usize;
/// Positions of a product's last bit (three exponents below 2046), its own 159 bits,
/// and carries of up to 2^30 products.
const LIMBS: usize = (3 * 2045 + 159 + 30usize).div_ceil(LIMB);

/// A sum of products. Positive and negative products are kept apart, so that nothing is
/// subtracted.
pub(crate) struct ExactSum {
    positive: [u64; LIMBS],
    negative: [u64; LIMBS],
}

impl ExactSum {
    pub(crate) const ZERO: Self = Self {
        positive: [0; LIMBS],
        negative: [0; LIMBS],
    };

    /// Adds det(a, b, c).
    pub(crate) fn add_determinant(&mut self, a: [f64; 3], b: [f64; 3], c: [f64; 3]) {
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            self.add_product(a[i], b[j], c[k]);
            self.add_product(-a[i], b[k], c[j]);
        }
    }

    fn add_product(&mut self, x: f64, y: f64, z: f64) {
        if x == 0.0 || y == 0.0 || z == 0.0 {
            return;
        }
        let [x, y, z] = [x, y, z].map(Decoded::of);
        let xy = u128::from(x.significand) * u128::from(y.significand);
        let low = u128::from(xy as u64) * u128::from(z.significand);
        let high = (xy >> LIMB) * u128::from(z.significand) + (low >> LIMB);

        let position = x.position + y.position + z.position;
        let sum = if x.negative ^ y.negative ^ z.negative {
            &mut self.negative
        } else {
            &mut self.positive
        };
        let shift = position % LIMB;
        let mut carry = 0;
        let mut limb = position / LIMB;
        for digits in [low as u64, high as u64, (high >> LIMB) as u64] {
            let shifted = u128::from(digits) << shift;
            carry += u128::from(sum[limb]) + u128::from(shifted as u64);
            sum[limb] = carry as u64;
            carry = (carry >> LIMB) + (shifted >> LIMB);
            limb += 1;
        }
        while carry != 0 {
            carry += u128::from(sum[limb]);
            sum[limb] = carry as u64;
            carry >>= LIMB;
            limb += 1;
        }
    }

    /// How the sum compares with 0.
    pub(crate) fn sign(&self) -> Ordering {
        self.positive.iter().rev().cmp(self.negative.iter().rev())
    }
}

/// A finite f64 as ±significand · 2^(position − 1074).
pub(crate) struct Decoded {
    pub negative: bool,
    pub significand: u64,
    pub position: usize,
}

impl Decoded {
    pub(crate) fn of(x: f64) -> Self {
        const FRACTION: u64 = (1 << 52) - 1;
        let bits = x.to_bits();
        let exponent = (bits >> 52 & 0x7ff) as usize;
        // Subnormal numbers have the exponent of the smallest normal ones.
        let hidden = u64::from(exponent != 0) << 52;
        Self {
            negative: x.is_sign_negative(),
            significand: bits & FRACTION | hidden,
            position: exponent.saturating_sub(1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use num_bigint::BigInt;

    /// A finite f64 as an integer multiple of 2^-1074.
    fn integer(x: f64) -> BigInt {
        let parts = Decoded::of(x);
        let magnitude = BigInt::from(parts.significand) << parts.position;
        if parts.negative {
            -magnitude
        } else {
            magnitude
        }
    }

    #[test]
    fn a_carry_runs_through_many_limbs() {
        let mut sum = ExactSum::ZERO;
        let power = |exponent| 2.0f64.powi(exponent);
        (0..300).for_each(|exponent| sum.add_product(power(exponent), 1.0, 1.0));
        sum.add_product(-power(300), 1.0, 1.0);
        assert_eq!(sum.sign(), Ordering::Less);
        sum.add_product(1.0, 1.0, 1.0);
        assert_eq!(sum.sign(), Ordering::Equal);
    }

    fn determinant(rows: [[f64; 3]; 3]) -> BigInt {
        let [a, b, c] = rows.map(|row| row.map(integer));
        let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
        &a[0] * minor(1, 2) - &a[1] * minor(0, 2) + &a[2] * minor(0, 1)
    }

    /// Checks that sums of determinants of `numbers` have the same signs as with big integers.
    /// Some of these sums cancel.
    fn check(numbers: &[f64]) {
        let mut seed = 1u64;
        let mut pick = || {
            seed = seed.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
            numbers[(seed >> 33) as usize % numbers.len()]
        };
        let mut met = [0; 3];
        for _ in 0..5000 {
            let terms: [[[f64; 3]; 3]; 4] = core::array::from_fn(|_| {
                core::array::from_fn(|_| core::array::from_fn(|_| pick()))
            });
            let mut sum = ExactSum::ZERO;
            let mut expected = BigInt::ZERO;
            for [a, b, c] in terms {
                sum.add_determinant(a, b, c);
                expected += determinant([a, b, c]);
                assert_eq!(sum.sign(), expected.cmp(&BigInt::ZERO), "{terms:?}");
                met[(sum.sign() as i8 + 1) as usize] += 1;
            }
        }
        assert!(met.iter().all(|&times| times > 50), "{met:?}");
    }

    #[test]
    fn signs_of_small_integers_are_exact() {
        check(&[-2.0, -1.0, -0.0, 0.0, 1.0, 1.0, 3.0]);
    }

    #[test]
    fn signs_over_the_whole_range_are_exact() {
        let extremes = [f64::MAX, f64::MIN_POSITIVE, 5e-324, 1.0, 1.0 + f64::EPSILON];
        let numbers: Vec<f64> = extremes.iter().flat_map(|&x| [x, -x, 0.0]).collect();
        check(&numbers);
    }

    #[test]
    fn the_largest_sums_have_room() {
        let most = [f64::MAX; 3];
        let mut sum = ExactSum::ZERO;
        for _ in 0..1000 {
            sum.add_determinant([f64::MAX, 0.0, 0.0], [0.0, f64::MAX, 0.0], most);
        }
        assert_eq!(sum.sign(), Ordering::Greater);
        for _ in 0..1000 {
            sum.add_determinant([0.0, f64::MAX, 0.0], [f64::MAX, 0.0, 0.0], most);
        }
        assert_eq!(sum.sign(), Ordering::Equal);
    }
}
