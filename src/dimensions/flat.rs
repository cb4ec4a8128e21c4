//! The flat that holds all points of a cloud, except for rounding.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled, push, reserve, with_capacity};
use crate::dimensions::plane::subtract;

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
