//! What the looks know of a cloud before they look: its noise, and what to do against it.
//!
//! The noise of a sensor is everywhere. Points move to the planes of their neighbors, and the looks
//! are at the moved points. Scans that were put together with errors lie beside each other, only
//! where they overlap. No neighbor tells which of them is the surface. So the surface counts as thick
//! (`tuning`).

use alloc::boxed::Box;
use alloc::sync::Arc;

use crate::answers::looks::look::Seen;
use crate::base::allocation::filled;
use crate::base::error::Error;
use crate::cloud::noise::{NOISY, Surface};
use crate::cloud::point_cloud::{PointCloud, Smooth, Survey};
use crate::cloud::sheets::NEAR;

impl Smooth {
    /// `share` is how far the points move.
    fn of(cloud: &PointCloud, share: f64) -> Result<Self, Error> {
        let most = cloud.sequence.points.len().saturating_sub(1);
        let [_, plane] = NEAR;
        let neighbors = plane.min(most).max(1);
        let mut moved = cloud.denoised(neighbors)?;
        let mut noise = moved.known_noise()?;
        // Again as long as that removes what counts as noise.
        let least = 0.5 * NOISY;
        let mut before = f64::INFINITY;
        while noise.ratio > least && before - noise.ratio > least {
            before = noise.ratio;
            moved = moved.denoised(neighbors)?;
            noise = moved.known_noise()?;
        }
        if share < 1.0 {
            let mut places = filled(cloud.sequence.points.len(), [0.0; 3])?;
            let order = moved.places()?;
            for (k, place) in places.iter_mut().enumerate() {
                let from = cloud.sequence.points.get(k);
                let to = moved
                    .sequence
                    .points
                    .get(order[cloud.sequence.indices_of(k)[0] as usize] as usize);
                *place = core::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis]));
            }
            moved = cloud.moved(&places)?;
            noise = moved.known_noise()?;
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
        Ok(self.known_noise()?.surface())
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
        let shares = match (surface, thickness) {
            (Some(Surface::Clean), _) => [0.0, 0.0],
            (Some(Surface::Noisy), _) => [1.0, 0.0],
            (Some(Surface::Layered), _) | (None, Some(_)) => [0.0, 1.0],
            (None, None) => noise.shares,
        };
        let [moved, _] = shares;
        let can_move = self.sequence.points.len() > 1;
        let smooth = if moved > 0.0 && can_move {
            let kept = &self.kept.smooth[usize::from(moved < 1.0)];
            Some(kept.get(|| Smooth::of(self, moved).map(Arc::new))?)
        } else {
            None
        };
        Ok(Some(Survey {
            noise,
            shares,
            smooth,
        }))
    }
}
