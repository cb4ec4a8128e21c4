//! The statistics of a cloud with one more point, without building that cloud. Every sum runs in
//! the same order as there, so all bits are the same.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::error::Error;
use crate::cloud::neighbors::{Nearest, Neighbor, Neighbors, distance_squared};
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::sequence::without_negative_zero;
use crate::cloud::spatial::HilbertCurve;
use crate::cloud::statistics::{NEIGHBORS, SAMPLES, Statistics, mean_distance, sampled_place};

/// Measures a cloud with one more point at a time.
pub(crate) struct Growth<'a> {
    cloud: &'a PointCloud,
    curve: HilbertCurve,
    /// For each sampled place of the longer order, the neighbors of two points, one of which is
    /// there: the point that is there if the new one comes later, and if it comes earlier.
    samples: Vec<Nearest>,
}

impl<'a> Growth<'a> {
    pub(crate) fn of(cloud: &'a PointCloud) -> Result<Self, Error> {
        let points = &cloud.sequence.points;
        let longer = points.len() + 1;
        let count = longer.min(SAMPLES);
        let neighbors = Neighbors::new(points)?;
        let mut samples: Vec<Nearest> = with_capacity(2 * count)?;
        for sample in 0..2 * count {
            let place = sampled_place(sample / 2, count, longer);
            let mut nearest = Nearest::with_capacity(NEIGHBORS)?;
            // The place may be before the first point or after the last one.
            let point = place.wrapping_sub(sample % 2);
            if point < points.len() {
                neighbors.find(point, &mut nearest);
            }
            samples.push(nearest);
        }
        Ok(Self {
            cloud,
            curve: HilbertCurve::new(&cloud.bounds),
            samples,
        })
    }

    /// The statistics of the cloud with a point at `position`.
    pub(crate) fn with(&self, position: [f64; 3]) -> Result<Statistics, Error> {
        let cloud = self.cloud;
        let points = &cloud.sequence.points;
        let position = without_negative_zero(position);
        let mut bounds = cloud.bounds;
        bounds.include(position);
        if points.len() == 0 || HilbertCurve::new(&bounds) != self.curve {
            // All points have another order.
            return Ok(cloud.with_point(position)?.statistics);
        }
        let (place, is_present) = cloud.sequence.place_of(position, &self.curve);
        if is_present {
            return Ok(cloud.statistics);
        }
        let spacings = self.spacings(place, position)?;
        let longer = points.len() + 1;
        let samples = Statistics::of_samples(spacings, longer, &bounds, &|sample, samples| {
            let sampled = sampled_place(sample, samples, longer);
            if sampled == place {
                position
            } else {
                points.get(sampled - usize::from(sampled > place))
            }
        })?;
        // The centroid would take a pass over the cloud. No automatic rule needs it.
        Ok(Statistics {
            centroid: cloud.statistics.centroid,
            ..samples
        })
    }

    fn spacings(&self, place: usize, position: [f64; 3]) -> Result<Vec<f64>, OutOfMemory> {
        let points = &self.cloud.sequence.points;
        let count = self.samples.len() / 2;
        let mut spacings = filled(count, 0.0)?;
        for (sample, spacing) in spacings.iter_mut().enumerate() {
            let sampled = sampled_place(sample, count, points.len() + 1);
            if sampled == place {
                let mut nearest = Nearest::with_capacity(NEIGHBORS)?;
                for (index, place) in (0..).zip(points.iter()) {
                    let squared = distance_squared(position, place);
                    nearest.offer(Neighbor { squared, index }, points);
                }
                *spacing = mean_distance(nearest.found(), None);
                continue;
            }
            let is_later = usize::from(sampled > place);
            let found = self.samples[2 * sample + is_later].found();
            let point = points.get(sampled - is_later);
            *spacing = mean_distance(found, Some(distance_squared(point, position)));
        }
        Ok(spacings)
    }
}
