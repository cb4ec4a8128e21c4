//! View-independent statistics of a cloud: its centroid, its spacing, and its surface.
//!
//! All sums run over the distinct points in their canonical order (see
//! `spatial`), so permuting or duplicating the input changes no bit.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled};
use crate::base::real::square_root;
use crate::cloud::neighbors::{Nearest, Neighbor, Neighbors};
use crate::cloud::points::Points;
use crate::cloud::spatial::Bounds;
use crate::cloud::{filling, surface};

/// The spacing of a point is its mean distance from this many nearest points.
pub(crate) const NEIGHBORS: usize = 6;
/// How many points are measured; with more of them the mean hardly changes.
pub(crate) const SAMPLES: usize = 2048;

/// The statistics from which the automatic radius is computed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Statistics {
    /// Distinct finite points.
    pub count: usize,
    /// Mean of the distinct points.
    pub centroid: [f64; 3],
    /// Mean distance to the 6 nearest other points (to all others where there
    /// are fewer), averaged over an even sample; 0 below two points.
    pub spacing: f64,
    /// How many times wider gaps are than the spacings tell, see [`filling::widening`]; 0 without
    /// points.
    pub widening: f64,
    /// The gap of the sampled spacings, see [`surface::gap`], times `widening`; 0 below two points.
    pub gap: f64,
    /// The mean place of the surface: the sampled points, weighted by the area for which each
    /// stands.
    pub middle: [f64; 3],
    /// Mean squared distance of the surface from its middle.
    pub variance: f64,
}

impl Statistics {
    /// Measures `points`: distinct, finite, along the Hilbert curve.
    pub(crate) fn measure(points: &Points, bounds: &Bounds) -> Result<Self, OutOfMemory> {
        let n = points.len();
        if n == 0 {
            return Ok(Self::default());
        }
        // Sums relative to a corner of the box keep the detail of georeferenced clouds.
        let corner = bounds.min;
        let mut sum = [0.0; 3];
        for p in points.iter() {
            for axis in 0..3 {
                sum[axis] += p[axis] - corner[axis];
            }
        }
        let centroid = core::array::from_fn(|axis| corner[axis] + sum[axis] / n as f64);
        let samples =
            Self::of_samples(sampled_spacings(points)?, n, bounds, &|sample, samples| {
                points.get(sampled_place(sample, samples, n))
            })?;
        Ok(Self {
            centroid,
            ..samples
        })
    }

    /// Everything but the centroid, from the spacings of sampled points of a cloud of `count`.
    /// `point` gives a sampled point by its number and the number of samples.
    #[inline(never)]
    pub(crate) fn of_samples(
        spacings: Vec<f64>,
        count: usize,
        bounds: &Bounds,
        point: &dyn Fn(usize, usize) -> [f64; 3],
    ) -> Result<Self, OutOfMemory> {
        let spacing = surface::mean(&spacings);
        let longest = surface::longest(&spacings)?;
        let samples = spacings.len();
        let point = |sample| point(sample, samples);
        // The points of clouds of two dimensions are on curves, which fill nothing. Clouds in a plane
        // x = const or y = const are like those in a plane z = const.
        let is_flat = (0..3).any(|axis| bounds.min[axis] >= bounds.max[axis]);
        let widening = if is_flat {
            1.0
        } else {
            filling::widening(&spacings, longest, count, &point)
        };
        let spacings = surface::cut_off(spacings, longest);
        let gap = surface::gap(&spacings) * widening;
        let areas = surface::into_areas(spacings);
        let axes: [[f64; 2]; 3] =
            core::array::from_fn(|axis| surface::moments(&areas, &|sample| point(sample)[axis]));
        Ok(Self {
            count,
            centroid: [0.0; 3],
            spacing,
            widening,
            gap,
            middle: axes.map(|[mean, _]| mean),
            variance: axes.iter().map(|[_, variance]| variance).sum(),
        })
    }
}

/// The mean distances of sampled points from their nearest other points. Empty below two points.
fn sampled_spacings(points: &Points) -> Result<Vec<f64>, OutOfMemory> {
    let n = points.len();
    if n < 2 {
        return Ok(Vec::new());
    }
    let neighbors = Neighbors::new(points)?;
    let mut nearest = Nearest::with_capacity(NEIGHBORS)?;
    let mut spacings = filled(n.min(SAMPLES), 0.0)?;
    let samples = spacings.len();
    for (sample, spacing) in spacings.iter_mut().enumerate() {
        neighbors.find(sampled_place(sample, samples, n), &mut nearest);
        *spacing = mean_distance(nearest.found(), None);
    }
    Ok(spacings)
}

/// The point in the middle of even run number `sample` of the curve.
pub(crate) fn sampled_place(sample: usize, samples: usize, n: usize) -> usize {
    ((2 * sample as u64 + 1) * n as u64 / (2 * samples as u64)) as usize
}

/// The mean distance to the `found` points, nearest first, and to one `added` point, whose squared
/// distance is given. At most [`NEIGHBORS`] count.
#[inline(never)]
pub(crate) fn mean_distance(found: &[Neighbor], added: Option<f64>) -> f64 {
    let count = (found.len() + usize::from(added.is_some())).min(NEIGHBORS);
    let added = added.unwrap_or(f64::INFINITY);
    let mut distances = 0.0;
    let mut shift = 0;
    for k in 0..count {
        let squared = found.get(k - shift).map_or(added, |next| next.squared);
        if shift == 0 && added < squared {
            shift = 1;
            distances += square_root(added);
        } else {
            distances += square_root(squared);
        }
    }
    distances / count as f64
}
