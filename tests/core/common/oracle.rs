//! The naive oracle: the definition of visibility for a handful of points, by
//! enumeration in exact integers.
//!
//! Why this is the definition: λq ∈ K for some λ > 1 if and only if q = Σ cⱼqⱼ with
//! cⱼ ≥ 0 and Σ cⱼ < 1. (For one direction, divide the convex combination by λ and leave
//! out the share of the origin. For the other direction, take λ = 1/Σ cⱼ, or any λ if
//! q = 0.) Finding the least Σ cⱼ is a linear program with a bounded optimum, so a basic
//! solution attains it. In a basic solution, the qⱼ with cⱼ ≠ 0 are linearly independent,
//! so there are at most three. So q is hidden exactly when q = 0 or when
//!   one qⱼ, or two or three linearly independent qⱼ, give q with Σ cⱼ < 1.
//! The proof assumes no rank. So planes, lines and single points need no case of their own.

use num_bigint::{BigInt, Sign};

use super::flip::flip;

type Vector = [BigInt; 3];

/// Visible or not, for each of `points`.
pub fn visible(points: &[[f64; 3]], viewpoint: [f64; 3], radius: f64) -> Vec<bool> {
    let flipped: Vec<_> = points.iter().map(|&p| flip(p, viewpoint, radius)).collect();
    visible_flipped(&flipped)
}

/// The same for flipped points; `None` stands for a point at the viewpoint.
pub fn visible_flipped(flipped: &[Option<[f64; 3]>]) -> Vec<bool> {
    let mut distinct: Vec<[f64; 3]> = flipped.iter().flatten().copied().collect();
    distinct.sort_by(|a, b| a.partial_cmp(b).expect("finite flipped points"));
    distinct.dedup();
    let hidden = hidden(&integers(&distinct));
    let is_hidden = |q: &[f64; 3]| hidden[distinct.iter().position(|other| other == q).unwrap()];
    flipped
        .iter()
        .map(|q| q.as_ref().is_none_or(|q| !is_hidden(q)))
        .collect()
}

/// The definition for the given flipped points.
pub fn hidden(q: &[Vector]) -> Vec<bool> {
    let n = q.len();
    let crosses: Vec<Vector> = (0..n * n).map(|ij| cross(&q[ij / n], &q[ij % n])).collect();
    // det[i][j][k] = qᵢ · (qⱼ × qₖ)
    let dets: Vec<BigInt> = (0..n * n * n)
        .map(|ijk| dot(&q[ijk / (n * n)], &crosses[ijk % (n * n)]))
        .collect();
    let det = |i: usize, j: usize, k: usize| &dets[(i * n + j) * n + k];

    let zero = BigInt::ZERO;
    let by_one = |p: usize, i: usize| {
        // q = c·qᵢ, c = (q·qᵢ)/(qᵢ·qᵢ)
        let c = dot(&q[p], &q[i]);
        is_zero(&crosses[p * n + i]) && c > zero && c < dot(&q[i], &q[i])
    };
    let by_two = |p: usize, i: usize, j: usize| {
        // Cross q = a·qᵢ + b·qⱼ with qⱼ and qᵢ, and measure along the normal qᵢ × qⱼ.
        let normal = &crosses[i * n + j];
        if is_zero(normal) || *det(p, i, j) != zero {
            return false;
        }
        let a = dot(&crosses[p * n + j], normal);
        let b = dot(&crosses[i * n + p], normal);
        a >= zero && b >= zero && a + b < dot(normal, normal)
    };
    let by_three = |p: usize, i: usize, j: usize, k: usize| {
        // Cramer: q = (det(q,j,k)·qᵢ + det(i,q,k)·qⱼ + det(i,j,q)·qₖ) / det(i,j,k)
        let (all, parts) = (det(i, j, k), [det(p, j, k), det(i, p, k), det(i, j, p)]);
        let opposite = match all.sign() {
            Sign::NoSign => return false,
            Sign::Plus => Sign::Minus,
            Sign::Minus => Sign::Plus,
        };
        parts.iter().all(|part| part.sign() != opposite)
            && (parts[0] + parts[1] + parts[2]).magnitude() < all.magnitude()
    };
    (0..n)
        .map(|p| {
            is_zero(&q[p])
                || (0..n).any(|i| {
                    by_one(p, i)
                        || (0..i).any(|j| by_two(p, i, j) || (0..j).any(|k| by_three(p, i, j, k)))
                })
        })
        .collect()
}

/// All vectors times the same power of two. This changes no answer.
pub fn integers(q: &[[f64; 3]]) -> Vec<Vector> {
    let parts = q.iter().flatten().map(|&x| decode(x));
    let least = parts
        .filter(|&(mantissa, _)| mantissa != 0)
        .map(|(_, exponent)| exponent)
        .min()
        .unwrap_or(0);
    let integer = |x: f64| {
        let (mantissa, exponent) = decode(x);
        if mantissa == 0 {
            BigInt::ZERO
        } else {
            BigInt::from(mantissa) << (exponent - least)
        }
    };
    q.iter().map(|v| v.map(integer)).collect()
}

/// x = mantissa · 2^exponent, the mantissa odd or 0.
fn decode(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (mantissa, exponent) = if biased == 0 {
        (fraction, -1074)
    } else {
        (fraction | 1 << 52, biased - 1075)
    };
    let zeros = if mantissa == 0 {
        0
    } else {
        mantissa.trailing_zeros()
    };
    let mantissa = mantissa >> zeros;
    (
        if x < 0.0 { -mantissa } else { mantissa },
        exponent + zeros as i32,
    )
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [
        &a[1] * &b[2] - &a[2] * &b[1],
        &a[2] * &b[0] - &a[0] * &b[2],
        &a[0] * &b[1] - &a[1] * &b[0],
    ]
}

fn dot(a: &Vector, b: &Vector) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn is_zero(a: &Vector) -> bool {
    a.iter().all(|x| x.sign() == Sign::NoSign)
}
