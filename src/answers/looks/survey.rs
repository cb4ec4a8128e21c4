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
use crate::cloud::noise::{CLEAN, Noise, Surface};
use crate::cloud::point_cloud::{PointCloud, Smooth, Survey};
use crate::cloud::quadric::off_quadric;
use crate::cloud::sheets::{LOW, NEAR, some};

/// Points move at most so often.
const PASSES: usize = 3;
/// Moving points joins layers if, at the high quartile, they lie off their surface afterwards by at most this
/// share of the noise: by 0.12 to 0.31 in objects whose scans are up to half a spacing off, by 0.42 and more in registered rooms and streets.
const JOINED: f64 = 0.36;

/// Whether moved points lie in one surface.
#[inline(never)]
fn are_joined(cloud: &PointCloud, noise: &Noise) -> Result<bool, OutOfMemory> {
    let points = &cloud.sequence.points;
    let neighbors = Neighbors::new(points)?;
    let [surface, plane] = NEAR;
    let mut around = Nearest::with_capacity(surface)?;
    let mut nearest = Nearest::with_capacity(plane)?;
    let mut moved = with_capacity(surface + 1)?;
    let mut off = with_capacity(noise.samples.len())?;
    for sample in some(&noise.samples) {
        let query = sample.point as usize;
        neighbors.find(query, &mut around);
        let [origin, spacing] = [
            DVec3::from_array(sample.place),
            DVec3::splat(sample.spacing),
        ];
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
    Ok(percentile(&off, 100 - LOW)?.is_some_and(|high| high < JOINED * noise.ratio))
}

impl Smooth {
    fn of(cloud: &PointCloud) -> Result<Self, Error> {
        let most = cloud.sequence.points.len().saturating_sub(1);
        let [_, plane] = NEAR;
        let neighbors = plane.min(most).max(1);
        let mut moved = cloud.denoised(neighbors)?;
        let mut noise = moved.known_noise()?;
        for _ in 1..PASSES {
            if noise.ratio > CLEAN {
                moved = moved.denoised(neighbors)?;
                noise = moved.known_noise()?;
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
    /// their surface. It is 0 where nothing tells of noise, and where there are fewer than 2048
    /// distinct points. It is measured at 2048 points.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn noise(&self) -> Result<f64, Error> {
        Ok(self.known_noise()?.deviation())
    }

    /// How the points lie about the surface that they sample, as looks take them. [`Options::surface`]
    /// overrides it.
    ///
    /// [`Options::surface`]: crate::Options::surface
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn surface(&self) -> Result<Surface, Error> {
        let measure = || {
            let noise = self.known_noise()?;
            let is_joined = noise.surface == Surface::Layered && are_joined(self, &noise)?;
            Ok(if is_joined {
                Surface::Noisy
            } else {
                noise.surface
            })
        };
        self.kept.surface.get(measure)
    }

    /// What looks with this surface and thickness know of the cloud, if they need it.
    pub(crate) fn survey(
        &self,
        surface: Option<Surface>,
        thickness: Option<f64>,
    ) -> Result<Option<Survey>, Error> {
        // A cloud without thickness that nobody asked to smooth is taken as it is.
        if thickness == Some(0.0) && surface.is_none() {
            return Ok(None);
        }
        let noise = self.known_noise()?;
        let surface = match (surface, thickness) {
            (Some(surface), _) => surface,
            (None, Some(_)) => Surface::Layered,
            (None, None) => self.surface()?,
        };
        let can_move = self.sequence.points.len() > 1;
        let smooth = if surface == Surface::Noisy && can_move {
            Some(self.kept.smooth.get(|| Smooth::of(self).map(Arc::new))?)
        } else {
            None
        };
        Ok(Some(Survey {
            noise,
            surface,
            smooth,
        }))
    }
}
