//! Points with as many coordinates as they span dimensions.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::real::power_of_two_below;
use crate::dimensions::residues::{Integers, inverse, times_plus};

/// The rank is the larger one modulo these primes, so it is too small only if both divide all
/// determinants of some order.
const PRIMES: [u64; 2] = [2_147_483_629, 2_147_483_587];

/// Leaving out the other coordinates maps the points' subspace one-to-one, and keeps rays, planes
/// and convexity.
pub(super) struct Frame {
    /// The points, each axis scaled by a power of two to a size near 1.
    pub points: Vec<f64>,
    /// The points that span all, as many as there are dimensions.
    pub corners: Vec<usize>,
    pub integers: Integers,
}

impl Frame {
    pub(super) fn new(q: &[f64], dimension: usize) -> Result<Self, OutOfMemory> {
        let mut scaled: Vec<f64> = with_capacity(q.len())?;
        scaled.extend_from_slice(q);
        for axis in 0..dimension {
            let axis = || (axis..q.len()).step_by(dimension);
            let largest = axis().fold(0.0f64, |largest, i| largest.max(q[i].abs()));
            let scale = 1.0 / power_of_two_below(largest);
            axis().for_each(|i| scaled[i] *= scale);
        }
        let mut rows: Vec<f64> = with_capacity(q.len())?;
        rows.extend_from_slice(q);
        let integers = Integers::new(rows, dimension)?;
        let mut span = Span::default();
        for prime in PRIMES {
            let other = Span::new(&scaled, &integers, dimension, prime)?;
            if other.corners.len() > span.corners.len() {
                span = other;
            }
            if span.corners.len() == dimension {
                break;
            }
        }
        let rank = span.corners.len();
        if rank == dimension || rank == 0 {
            return Ok(Self {
                points: scaled,
                corners: span.corners,
                integers,
            });
        }
        drop((scaled, integers));
        Self::of_columns(q, &span.kept)
    }

    /// Leaves out the columns of `rows` that are not kept.
    pub(super) fn of_columns(rows: &[f64], kept: &[bool]) -> Result<Self, OutOfMemory> {
        let rank = kept.iter().filter(|kept| **kept).count();
        Self::new(&columns(rows, kept)?, rank)
    }
}

/// The columns of `rows` that are kept.
#[inline(never)]
pub(super) fn columns(rows: &[f64], kept: &[bool]) -> Result<Vec<f64>, OutOfMemory> {
    let mut columns = with_capacity(rows.len())?;
    for row in rows.chunks_exact(kept.len()) {
        let kept = row.iter().zip(kept).filter(|(_, kept)| **kept);
        columns.extend(kept.map(|(x, _)| x));
    }
    Ok(columns)
}

/// Points that span all others, and the axes that tell their combinations apart.
#[derive(Default)]
struct Span {
    corners: Vec<usize>,
    kept: Vec<bool>,
}

impl Span {
    /// Elimination in floating point and modulo `prime` at once. The largest pivot is taken, if it
    /// is not 0 modulo the prime. So the rank is exact, and the corners are far apart.
    #[inline(never)]
    fn new(
        scaled: &[f64],
        integers: &Integers,
        dimension: usize,
        prime: u64,
    ) -> Result<Self, OutOfMemory> {
        let mut rest: Vec<(u64, f64)> = with_capacity(scaled.len())?;
        let numbers = scaled.iter().enumerate();
        rest.extend(
            numbers.map(|(i, &x)| (integers.residue(i / dimension, i % dimension, prime), x)),
        );
        let mut span = Self {
            corners: with_capacity(dimension)?,
            kept: filled(dimension, false)?,
        };
        while span.corners.len() < dimension {
            let pivots = (0..rest.len()).filter(|&i| rest[i].0 != 0);
            let size = |i: &usize| rest[*i].1.abs();
            let Some(at) = pivots.max_by(|a, b| size(a).total_cmp(&size(b))) else {
                break;
            };
            let (corner, axis) = (at / dimension, at % dimension);
            span.corners.push(corner);
            span.kept[axis] = true;
            let mut pivot: Vec<(u64, f64)> = with_capacity(dimension)?;
            pivot.extend_from_slice(&rest[corner * dimension..][..dimension]);
            let factor = inverse(pivot[axis].0, prime);
            for row in rest.chunks_exact_mut(dimension) {
                let (residue, x) = row[axis];
                let times = times_plus(prime - residue, factor, 0, prime);
                let share = if x == 0.0 { 0.0 } else { x / pivot[axis].1 };
                for ((residue, x), (p, y)) in row.iter_mut().zip(&pivot) {
                    *residue = times_plus(times, *p, *residue, prime);
                    *x -= share * y;
                }
            }
        }
        Ok(span)
    }
}
