//! What the looks know of a cloud before they look: its noise, and what to do against it.
//!
//! The noise of a sensor is everywhere. Points move to the planes of their neighbors, and the looks
//! are at the moved points. Scans that were put together with errors lie beside each other, only
//! where they overlap. Where they are near each other, planes of neighbors join them, too. Where
//! they are not, no neighbor tells which of them is the surface. So the surface counts as thick
//! (`tuning`).

use alloc::boxed::Box;
use alloc::sync::Arc;
use glam::DVec3;

use crate::answers::denoise::on_plane;
use crate::answers::looks::look::Seen;
use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::error::Error;
use crate::base::sort::percentile;
use crate::cloud::neighbors::{Nearest, Neighbors};
use crate::cloud::noise::Noise;
use crate::cloud::point_cloud::{PointCloud, Smooth, Survey};
use crate::cloud::quadric::off_quadric;
use crate::cloud::statistics::{mean_distance, sampled_place};

/// How many neighbors make the plane to which a point moves.
const NEIGHBORS: usize = 32;
/// Points move until their noise is at most this, in spacings, and at most so often. The first number is
/// for even noise. Layers are still beside each other where they have as much left.
const CLEAN: [f64; 2] = [0.04, 0.025];
const PASSES: usize = 3;
/// Moving points joins layers if, at this percentile of so many places, points lie at most so far
/// off their surface afterwards, in spacings: 0.24 and 0.4 in registered rooms. It does so, too, where
/// large surroundings are farther off their planes than small ones: objects whose scans are a spacing
/// off have 0.54 to 0.58, the rooms 0.65. A street has 0.19 and 0.59, but 10 times the lower
/// percentile: where most places are smooth and some are not, layers are left.
const HIGH: usize = 75;
const LOW: usize = 25;
const PLACES: usize = 512;
const JOINED: f64 = 0.2;
const LAYERED: f64 = 6.0;
/// How many of the nearest points tell of the surface at a place.
const AROUND: usize = 16;

impl Survey {
    pub(crate) fn of(cloud: &PointCloud) -> Result<Self, Error> {
        let noise = cloud.known_noise()?;
        let is_noisy = noise.excess > 0.0;
        let smooth = if is_noisy && (noise.is_even || are_joined(cloud, &noise)?) {
            Some(Smooth::of(cloud, CLEAN[usize::from(!noise.is_even)])?)
        } else {
            None
        };
        Ok(Self { noise, smooth })
    }
}

/// Whether moved points lie in one surface.
#[inline(never)]
fn are_joined(cloud: &PointCloud, noise: &Noise) -> Result<bool, OutOfMemory> {
    let points = &cloud.sequence.points;
    let n = points.len();
    let count = n.min(PLACES);
    let neighbors = Neighbors::new(points)?;
    let mut around = Nearest::with_capacity(AROUND)?;
    let mut nearest = Nearest::with_capacity(NEIGHBORS)?;
    let mut moved = with_capacity(AROUND + 1)?;
    let mut off = with_capacity(count)?;
    for sample in 0..count {
        let query = sampled_place(sample, count, n);
        neighbors.find(query, &mut around);
        let spacing = mean_distance(around.found(), None);
        let origin = DVec3::from_array(points.get(query));
        moved.clear();
        let others = around.found().iter().map(|other| other.index as usize);
        for point in core::iter::once(query).chain(others) {
            neighbors.find(point, &mut nearest);
            let place = on_plane(points.get(point), &nearest, points);
            moved.push((DVec3::from_array(place) - origin) / spacing);
        }
        let deviation = off_quadric(&moved).deviation;
        if deviation >= 0.0 {
            off.push(deviation);
        }
    }
    let [low, high] = [LOW, HIGH].map(|percent| percentile(&off, percent));
    let (Some(low), Some(high)) = (low?, high?) else {
        return Ok(false);
    };
    Ok((high < JOINED || !noise.is_alike) && high < LAYERED * low)
}

impl Smooth {
    fn of(cloud: &PointCloud, clean: f64) -> Result<Self, Error> {
        let mut moved = cloud.denoised(NEIGHBORS)?;
        let mut noise = Noise::of(&moved.sequence.points)?;
        for _ in 1..PASSES {
            if noise.ratio > clean {
                moved = moved.denoised(NEIGHBORS)?;
                noise = Noise::of(&moved.sequence.points)?;
            }
        }
        Ok(Self {
            cloud: Box::new(moved),
            noise,
        })
    }

    /// The answer of the moved points as that of the distinct points of `cloud`, from which they
    /// moved.
    pub(super) fn back(&self, seen: Seen, cloud: &PointCloud) -> Result<Seen, Error> {
        let places = self.cloud.places()?;
        let place = |k: usize| places[cloud.sequence.indices_of(k)[0] as usize] as usize;
        let count = cloud.sequence.points.len();
        let mut visible = filled(count, false)?;
        for (k, visible) in visible.iter_mut().enumerate() {
            *visible = seen.visible[place(k)];
        }
        let mut scores = filled(if seen.scores.is_empty() { 0 } else { count }, 0.0)?;
        for (k, score) in scores.iter_mut().enumerate() {
            *score = seen.scores[place(k)];
        }
        Ok(Seen {
            visible,
            scores,
            ..seen
        })
    }
}

impl PointCloud {
    /// One standard deviation of the noise, in the cloud's units: how far measured points lie off
    /// their surface. It is 0 where nothing tells of noise, and where there are fewer than 2000
    /// distinct points. It is measured at up to 2048 points.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn noise(&self) -> Result<f64, Error> {
        Ok(self.known_noise()?.deviation())
    }

    /// What looks with this thickness know of the cloud, if they need it.
    pub(crate) fn noise_survey(
        &self,
        thickness: Option<f64>,
    ) -> Result<Option<Arc<Survey>>, Error> {
        if thickness == Some(0.0) {
            return Ok(None);
        }
        let measure = || Survey::of(self).map(Arc::new);
        self.kept.survey.get(measure).map(Some)
    }
}
