//! Exact signs. The sign of a rounded determinant is taken where its error bound leaves no
//! doubt. Otherwise the sign of an exact sum is taken.
//!
//! Signs are defined from the viewer's side. The viewer stands at the origin, and
//! a face (a, b, c) of the hull is counter-clockwise seen from outside.

use core::cmp::Ordering;

use glam::DVec3;

use crate::hull::exact_sum::ExactSum;

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

/// The side of the plane through the face (a, b, c) on which `q` is. Positive is outside:
/// the side from which a, b, c are counter-clockwise. Zero is on the plane.
#[inline(never)]
pub(crate) fn side_of_face(a: DVec3, b: DVec3, c: DVec3, q: DVec3) -> Sign {
    let moderate = [a, b, c, q].iter().all(|p| is_moderate(&p.to_array()));
    // det(c − q, b − q, a − q) is positive when q is below the plane of (c, b, a). This is
    // the outside of (a, b, c).
    rounded_determinant(c - q, b - q, a - q, moderate)
        .unwrap_or_else(|| exact_side_of_face(a, b, c, q))
}

/// The sign of det(a, b, c). It is positive when a, b, c are clockwise seen from the
/// origin. Then the face (a, b, c) turns its inner side to the viewer. It is zero when the
/// three lie in one plane with the origin.
#[inline(never)]
pub(crate) fn side_of_origin(a: DVec3, b: DVec3, c: DVec3) -> Sign {
    let moderate = [a, b, c].iter().all(|p| is_moderate(&p.to_array()));
    rounded_determinant(a, b, c, moderate)
        .unwrap_or_else(|| exact_determinant(a.to_array(), b.to_array(), c.to_array()))
}

/// Positive when a, b, c turn counter-clockwise, zero when they are in one line.
#[inline(never)]
pub(crate) fn orient2d(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Sign {
    const BOUND: f64 = (3.0 + 16.0 * ROUNDING) * ROUNDING;
    if [a, b, c].iter().all(|p| is_moderate(p)) {
        let left = (a[0] - c[0]) * (b[1] - c[1]);
        let right = (a[1] - c[1]) * (b[0] - c[0]);
        let rounded = left - right;
        let size = left.abs() + right.abs();
        if is_certain(rounded, BOUND, size) {
            return Sign::of(rounded);
        }
    }
    let row = |[x, y]: [f64; 2]| [x, y, 1.0];
    exact_determinant(row(a), row(b), row(c))
}

const ROUNDING: f64 = f64::EPSILON / 2.0;

/// The sign of det(a, b, c) for rounded differences of moderate coordinates, if it is
/// beyond doubt: Shewchuk's first filter, with his bound ("Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates", 1997, §4.3, 4.4).
#[inline]
fn rounded_determinant(a: DVec3, b: DVec3, c: DVec3, moderate: bool) -> Option<Sign> {
    const BOUND: f64 = (7.0 + 56.0 * ROUNDING) * ROUNDING;
    let minor = |p: DVec3, q: DVec3| {
        let (left, right) = (p.x * q.y, q.x * p.y);
        (left - right, left.abs() + right.abs())
    };
    let [(bc, size_bc), (ca, size_ca), (ab, size_ab)] = [minor(b, c), minor(c, a), minor(a, b)];
    let rounded = a.z * bc + b.z * ca + c.z * ab;
    let size = size_bc * a.z.abs() + size_ca * b.z.abs() + size_ab * c.z.abs();
    (moderate && is_certain(rounded, BOUND, size)).then(|| Sign::of(rounded))
}

/// `size` is the sum of the absolute values of the products that `rounded` is made of;
/// if it is 0, each has a factor that is exactly 0.
#[inline]
fn is_certain(rounded: f64, bound: f64, size: f64) -> bool {
    rounded.abs() > bound * size || size == 0.0
}

/// Whether no product of three differences of such coordinates leaves the range in
/// which rounding is relative: their last bit is at least 2^-252, whose cube 2^-756 is
/// far above the smallest f64, and cubes of 2^201 stay far below the largest.
#[inline]
fn is_moderate(coordinates: &[f64]) -> bool {
    const BIAS: u64 = 1023;
    coordinates.iter().all(|x| {
        let exponent = x.to_bits() >> 52 & 0x7ff;
        (BIAS - 200..BIAS + 200).contains(&exponent) || *x == 0.0
    })
}

/// The sign of det(c − q, b − q, a − q). No difference is rounded.
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
    use crate::base::random::Random;

    /// Small integers and numbers very close to them, so that signs are often in doubt.
    fn point(random: &mut Random) -> DVec3 {
        DVec3::from_array(core::array::from_fn(|_| {
            let whole = random.below(7) as f64 - 3.0;
            match random.below(16) {
                0 => whole * 0.1,
                1 => whole * (1.0 + f64::EPSILON),
                _ => whole,
            }
        }))
    }

    /// Shewchuk's adaptive predicates (crate `robust`) say the same.
    #[test]
    fn signs_are_those_of_expansions() {
        let mut random = Random::new(7);
        let mut zeros = 0;
        for _ in 0..20_000 {
            let [a, b, c, q] = core::array::from_fn(|_| point(&mut random));
            let coord = |p: DVec3| robust::Coord3D {
                x: p.x,
                y: p.y,
                z: p.z,
            };
            let [ra, rb, rc, rq] = [a, b, c, q].map(coord);
            let side = Sign::of(robust::orient3d(rc, rb, ra, rq));
            assert_eq!(side_of_face(a, b, c, q), side, "{a} {b} {c} {q}");
            assert_eq!(exact_side_of_face(a, b, c, q), side, "{a} {b} {c} {q}");
            zeros += usize::from(side == Sign::Zero);

            let side = Sign::of(robust::orient3d(ra, rb, rc, coord(DVec3::ZERO)));
            assert_eq!(side_of_origin(a, b, c), side, "{a} {b} {c}");

            let coord = |p: DVec3| robust::Coord { x: p.x, y: p.y };
            let turn = Sign::of(robust::orient2d(coord(a), coord(b), coord(c)));
            let flat = |p: DVec3| [p.x, p.y];
            assert_eq!(orient2d(flat(a), flat(b), flat(c)), turn, "{a} {b} {c}");
        }
        assert!(zeros > 300, "only {zeros} degenerate quadruples met");
    }

    /// Points nearly in one line. Without a bound of the error, rounding gives wrong signs.
    #[test]
    fn signs_of_nearly_collinear_points_are_exact_at_every_scale() {
        let mut random = Random::new(3);
        for scale in [1.0, 2.0f64.powi(-60), 2.0f64.powi(60)] {
            for round in 0..3_000 {
                let [a, b, c] = core::array::from_fn(|_| {
                    let times = (1 + random.below(99)) as f64 * scale;
                    DVec3::new(0.1 * times, 0.3 * times, 0.0)
                });
                let row = |p: DVec3| [p.x, p.y, 1.0];
                let turn = exact_determinant(row(a), row(b), row(c));
                let flat = |p: DVec3| [p.x, p.y];
                assert_eq!(orient2d(flat(a), flat(b), flat(c)), turn, "{a} {b} {c}");
                // The product of c.z is mostly a rounding error. The product of b.z is as small.
                let tiny = scale * 2.0f64.powi(-50 - (random.below(8)) as i32);
                let b_z = if random.below(2) == 0 { tiny } else { -tiny };
                let mut points = [a, DVec3::new(b.x, b.y, b_z), DVec3::new(c.y, -c.x, scale)];
                points.rotate_left(round % 3);
                let side = exact_determinant(
                    points[0].to_array(),
                    points[1].to_array(),
                    points[2].to_array(),
                );
                let [a, b, c] = points;
                assert_eq!(side_of_origin(a, b, c), side, "{a} {b} {c}");
            }
        }
    }

    /// At the moderate scales the rounded determinant decides wherever it can.
    #[test]
    fn scales_keep_the_sign() {
        let mut random = Random::new(11);
        for exponent in [-1000, -400, -150, -60, 60, 150, 900] {
            let scale = 2.0f64.powi(exponent);
            for _ in 0..2_000 {
                let [a, b, c, q] = core::array::from_fn(|_| point(&mut random));
                let signs = |[a, b, c, q]: [DVec3; 4]| {
                    let flat = |p: DVec3| [p.x, p.y];
                    let turn = orient2d(flat(a), flat(b), flat(c));
                    [side_of_face(a, b, c, q), side_of_origin(a, b, c), turn]
                };
                let at_one = signs([a, b, c, q]);
                let scaled = signs([a, b, c, q].map(|p| p * scale));
                assert_eq!(scaled, at_one, "{a} {b} {c} {q}, scale 2^{exponent}");
            }
        }
    }
}
