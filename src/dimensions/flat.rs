//! Heights of points above a plane, with bounds of their errors; the flat that holds all points of a cloud, except for
//! rounding; and frames with as many coordinates as points span dimensions.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled, push, reserve, with_capacity};
use crate::base::real::power_of_two_below;
use crate::dimensions::residues::{Integers, inverse, times_plus};

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

/// Coordinates are rounded. A distance from a flat counts as 0 up to so many times the rounding of
/// the coordinates that it is computed from.
const ROUNDINGS: f64 = 32.0;

/// One of the points, and directions from it that span the flat. Each direction has an axis on
/// which those after it are 0.
#[derive(Default)]
pub(super) struct Flat {
    origin: Vec<f64>,
    directions: Vec<f64>,
    axes: Vec<usize>,
    /// The rounding of the points' coordinates on each axis.
    roundings: Vec<f64>,
}

impl Flat {
    /// Elimination, with the pivot that is largest relative to the rounding of its axis.
    #[inline(never)]
    pub(super) fn of<'a>(
        count: usize,
        dimension: usize,
        at: &dyn Fn(usize) -> &'a [f64],
    ) -> Result<Self, OutOfMemory> {
        let mut flat = Self::default();
        if count == 0 {
            return Ok(flat);
        }
        let mut rest: Vec<f64> = with_capacity(count * dimension)?;
        for point in 0..count {
            rest.extend_from_slice(at(point));
        }
        flat.roundings = filled(dimension, 0.0)?;
        for (i, x) in rest.iter().enumerate() {
            let rounding = &mut flat.roundings[i % dimension];
            *rounding = rounding.max(f64::EPSILON * x.abs());
        }
        reserve(&mut flat.origin, dimension)?;
        flat.origin.extend_from_slice(at(0));
        for row in rest.chunks_exact_mut(dimension) {
            subtract(row, 1.0, &flat.origin);
        }
        while flat.axes.len() < dimension {
            let Some(pivot) = farthest(&rest, &flat.roundings) else {
                break;
            };
            let axis = pivot % dimension;
            let start = flat.directions.len();
            reserve(&mut flat.directions, dimension)?;
            flat.directions
                .extend_from_slice(&rest[pivot - axis..][..dimension]);
            for row in rest.chunks_exact_mut(dimension) {
                clear(row, axis, &flat.directions[start..]);
            }
            push(&mut flat.axes, axis)?;
        }
        Ok(flat)
    }

    /// The axes that tell the points of the smallest flat through all points and `viewpoint` apart;
    /// `None` if all axes are needed.
    #[inline(never)]
    pub(super) fn axes(&self, viewpoint: &[f64]) -> Result<Option<Vec<bool>>, OutOfMemory> {
        let dimension = viewpoint.len();
        if self.axes.len() == dimension || self.origin.is_empty() {
            return Ok(None);
        }
        let mut axes = filled(dimension, false)?;
        let mut rest: Vec<f64> = with_capacity(dimension)?;
        rest.extend_from_slice(viewpoint);
        subtract(&mut rest, 1.0, &self.origin);
        let mut times = 1.0;
        let directions = self.directions.chunks_exact(dimension);
        for (&axis, direction) in self.axes.iter().zip(directions) {
            axes[axis] = true;
            times += clear(&mut rest, axis, direction).abs();
        }
        let mut roundings: Vec<f64> = with_capacity(dimension)?;
        let own = viewpoint.iter().zip(&self.roundings);
        roundings.extend(own.map(|(x, rounding)| f64::EPSILON * x.abs() + times * rounding));
        if let Some(axis) = farthest(&rest, &roundings) {
            axes[axis] = true;
        }
        // Where all points are at the viewpoint, rounding is all that there is.
        Ok((axes.contains(&false) && axes.contains(&true)).then_some(axes))
    }
}

/// The largest coordinate relative to the rounding of its axis, if rounding does not explain it.
#[inline(never)]
fn farthest(rows: &[f64], roundings: &[f64]) -> Option<usize> {
    let (mut largest, mut found) = (ROUNDINGS, None);
    for (i, x) in rows.iter().enumerate() {
        let size = x.abs() / roundings[i % roundings.len()];
        if size > largest {
            (largest, found) = (size, Some(i));
        }
    }
    found
}

/// Makes `row` 0 on an axis, and returns how many times the direction was subtracted.
#[inline(never)]
fn clear(row: &mut [f64], axis: usize, direction: &[f64]) -> f64 {
    let times = row[axis] / direction[axis];
    subtract(row, times, direction);
    row[axis] = 0.0;
    times
}

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
