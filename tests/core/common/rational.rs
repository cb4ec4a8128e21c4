//! The definition in any dimension, by enumeration in integers.
//!
//! q is hidden exactly when λq ∈ K for some λ > 1. Then q is a sum of differences p − q of other
//! flipped points p with positive factors. As many independent differences as there are dimensions
//! suffice (Carathéodory). So all choices of independent differences are tried.

use hidden_point_removal::{Exponential, Inversion, Visibility};
use num_bigint::BigInt;

/// The flipped points that an answer reports, operation by operation; `None` for a point at the
/// viewpoint.
pub fn flipped_as(
    rows: &[Vec<f64>],
    viewpoint: &[f64],
    answer: &Visibility,
) -> Vec<Option<Vec<f64>>> {
    let flip = |row: &Vec<f64>| {
        let v: Vec<f64> = row.iter().zip(viewpoint).map(|(p, c)| p - c).collect();
        let d = v.iter().fold(0.0, |sum, x| sum + x * x).sqrt();
        let s = match answer.inversion() {
            Inversion::Spherical => (2.0 * answer.radius() - d) / d,
            Inversion::Power(gamma) => libm::pow(d / answer.radius(), -gamma),
            Inversion::Exponential(Exponential::Scale(c)) => libm::exp((c / d).min(200.0)) / d,
            _ => panic!("not one resolved inversion"),
        };
        let q: Vec<f64> = v.iter().map(|x| x * s).collect();
        q.iter().all(|x| x.is_finite()).then_some(q)
    };
    rows.iter().map(flip).collect()
}

/// The answer by enumeration.
pub fn visible_by_definition(flipped: &[Option<Vec<f64>>]) -> Vec<u32> {
    let q = integers(flipped);
    let mut others: Vec<_> = q.iter().flatten().collect();
    others.sort();
    others.dedup();
    let visible = |q: &Option<Vec<BigInt>>| q.as_ref().is_none_or(|q| is_visible(q, &others));
    (0..q.len() as u32)
        .filter(|&i| visible(&q[i as usize]))
        .collect()
}

fn is_visible(q: &[BigInt], others: &[&Vec<BigInt>]) -> bool {
    if q.iter().all(|x| *x == BigInt::ZERO) {
        return false;
    }
    let from_q = |p: &&Vec<BigInt>| p.iter().zip(q).map(|(p, q)| p - q).collect::<Vec<_>>();
    let differences: Vec<_> = others.iter().filter(|p| p[..] != *q).map(from_q).collect();
    !is_sum(&mut Vec::new(), &differences, q)
}

/// Whether `q` is a sum of the chosen differences, and of some of the rest, with factors that are
/// not negative. The chosen ones are independent.
fn is_sum<'a>(chosen: &mut Vec<&'a Vec<BigInt>>, rest: &'a [Vec<BigInt>], q: &[BigInt]) -> bool {
    for (k, next) in rest.iter().enumerate() {
        chosen.push(next);
        let hides = match factors(chosen, q) {
            Solution::Dependent => false,
            Solution::Factors(factors) if factors.iter().all(|x| *x >= BigInt::ZERO) => true,
            _ => is_sum(chosen, &rest[k + 1..], q),
        };
        chosen.pop();
        if hides {
            return true;
        }
    }
    false
}

enum Solution {
    Dependent,
    /// Up to one positive factor.
    Factors(Vec<BigInt>),
    None,
}

/// Gauss and Jordan's elimination without fractions (Bareiss).
fn factors(vectors: &[&Vec<BigInt>], sum: &[BigInt]) -> Solution {
    let count = vectors.len();
    let mut rows: Vec<Vec<BigInt>> = (0..sum.len())
        .map(|axis| {
            let row = vectors.iter().map(|v| v[axis].clone());
            row.chain([sum[axis].clone()]).collect()
        })
        .collect();
    let mut before = BigInt::from(1);
    for column in 0..count {
        let Some(row) = (column..rows.len()).find(|&row| rows[row][column] != BigInt::ZERO) else {
            return Solution::Dependent;
        };
        rows.swap(row, column);
        let pivot = rows[column].clone();
        for (_, row) in rows
            .iter_mut()
            .enumerate()
            .filter(|(other, _)| *other != column)
        {
            let times = row[column].clone();
            for (x, p) in row.iter_mut().zip(&pivot) {
                *x = (&*x * &pivot[column] - &times * p) / &before;
            }
        }
        before = pivot[column].clone();
    }
    if rows[count..].iter().any(|row| row[count] != BigInt::ZERO) {
        return Solution::None;
    }
    // All rows have the same number on the diagonal.
    let sign = BigInt::from(if before > BigInt::ZERO { 1 } else { -1 });
    Solution::Factors(
        rows[..count]
            .iter()
            .map(|row| &row[count] * &sign)
            .collect(),
    )
}

/// All coordinates times one power of two.
fn integers(flipped: &[Option<Vec<f64>>]) -> Vec<Option<Vec<BigInt>>> {
    let parts = |x: f64| {
        let exponent = (x.to_bits() >> 52 & 0x7ff) as i32;
        let fraction = (x.to_bits() & ((1 << 52) - 1)) as i64;
        let hidden = i64::from(exponent != 0) << 52;
        let significand = if x < 0.0 {
            -(fraction | hidden)
        } else {
            fraction | hidden
        };
        (significand, exponent.max(1))
    };
    let numbers = flipped.iter().flatten().flatten().filter(|x| **x != 0.0);
    let lowest = numbers.map(|&x| parts(x).1).min().unwrap_or(0);
    let integer = |&x: &f64| match parts(x) {
        (0, _) => BigInt::ZERO,
        (significand, exponent) => BigInt::from(significand) << (exponent - lowest),
    };
    let row = |q: &Vec<f64>| q.iter().map(integer).collect();
    flipped.iter().map(|q| q.as_ref().map(row)).collect()
}
