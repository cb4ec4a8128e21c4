//! View-independent statistics of a cloud: centroid, spread and spacing.
//!
//! All sums run over the distinct points in their canonical order (see
//! `spatial`), so permuting or duplicating the input changes no bit.

use crate::base::allocation::OutOfMemory;
use crate::base::real::square_root;
use crate::cloud::neighbors::{Nearest, Neighbors, distance_squared};
use crate::cloud::points::Points;
use crate::cloud::spatial::Bounds;

/// The spacing of a point is its mean distance from this many nearest points.
const NEIGHBORS: usize = 6;
/// How many points are measured; with more of them the mean hardly changes.
const SAMPLES: usize = 2048;

/// The statistics from which the automatic radius is computed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Statistics {
    /// Distinct finite points.
    pub count: usize,
    /// Mean of the distinct points.
    pub centroid: [f64; 3],
    /// Mean squared distance from the centroid.
    pub variance: f64,
    /// Mean distance to the 6 nearest other points (to all others where there
    /// are fewer), averaged over an even sample; 0 below two points.
    pub spacing: f64,
}

impl Statistics {
    /// Measures `points`: distinct, finite, along the Hilbert curve.
    pub(crate) fn measure(points: &Points, bounds: &Bounds) -> Result<Self, OutOfMemory> {
        if points.len() == 0 {
            return Ok(Self::default());
        }
        let count = points.len() as f64;
        // Sums relative to a corner of the box keep the detail of georeferenced clouds.
        let corner = bounds.min;
        let mut sum = [0.0; 3];
        for p in points.iter() {
            for axis in 0..3 {
                sum[axis] += p[axis] - corner[axis];
            }
        }
        let centroid: [f64; 3] = core::array::from_fn(|axis| corner[axis] + sum[axis] / count);
        let mut squares = 0.0;
        for p in points.iter() {
            squares += distance_squared(p, centroid);
        }
        Ok(Self {
            count: points.len(),
            centroid,
            variance: squares / count,
            spacing: mean_spacing(points)?,
        })
    }
}

fn mean_spacing(points: &Points) -> Result<f64, OutOfMemory> {
    let n = points.len();
    if n < 2 {
        return Ok(0.0);
    }
    let neighbors = Neighbors::new(points)?;
    let mut nearest = Nearest::with_capacity(NEIGHBORS)?;
    let samples = n.min(SAMPLES);
    let mut sum = 0.0;
    for sample in 0..samples {
        // The middle of each of `samples` even runs of the curve.
        let index = ((2 * sample as u64 + 1) * n as u64 / (2 * samples as u64)) as usize;
        neighbors.find(index, &mut nearest);
        let mut distances = 0.0;
        for neighbor in nearest.found() {
            distances += square_root(neighbor.squared);
        }
        sum += distances / nearest.found().len() as f64;
    }
    Ok(sum / samples as f64)
}
