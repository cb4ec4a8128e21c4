//! What the looks know of a cloud before they look: its noise, and what to do against it.
//!
//! The noise of a sensor is everywhere. Points move to the planes of their neighbors, and the looks
//! are at the moved points. Scans that were put together with errors lie beside each other, only
//! where they overlap. No neighbor tells which of them is the surface. So the surface counts as
//! thick (`tuning`).

use alloc::boxed::Box;
use alloc::sync::Arc;

use crate::answers::looks::look::Seen;
use crate::base::allocation::filled;
use crate::base::error::Error;
use crate::cloud::noise::Noise;
use crate::cloud::point_cloud::{PointCloud, Smooth, Survey};
use crate::view::options::Options;

/// How many neighbors make the plane to which a point moves.
const NEIGHBORS: usize = 32;
/// Points move until their noise is at most this, in spacings, and at most so often.
const SMOOTH: f64 = 0.08;
const PASSES: usize = 3;
/// Where noise is more than this, in spacings, so many neighbors vote.
const LARGE: f64 = 0.3;
const VOTERS: usize = 16;

impl Survey {
    pub(crate) fn of(cloud: &PointCloud) -> Result<Self, Error> {
        let noise = cloud.known_noise()?;
        let smooth = if noise.excess > 0.0 && noise.is_even {
            Some(Smooth::of(cloud, &noise)?)
        } else {
            None
        };
        Ok(Self { noise, smooth })
    }
}

impl Smooth {
    fn of(cloud: &PointCloud, before: &Noise) -> Result<Self, Error> {
        let mut moved = cloud.denoised(NEIGHBORS)?;
        let mut noise = Noise::of(&moved.sequence.points)?;
        for _ in 1..PASSES {
            if noise.ratio > SMOOTH {
                moved = moved.denoised(NEIGHBORS)?;
                noise = Noise::of(&moved.sequence.points)?;
            }
        }
        let voters = if before.ratio > LARGE {
            Some(cloud.voters(VOTERS)?)
        } else {
            None
        };
        Ok(Self {
            cloud: Box::new(moved),
            noise,
            voters,
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
        if let Some(voters) = &self.voters {
            visible = voters.vote(&visible)?;
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
        Ok(Some(match &self.kept.survey {
            Some(survey) => survey.clone(),
            None => Arc::new(Survey::of(self)?),
        }))
    }

    /// Keeps the survey for views with these options.
    pub(crate) fn keep_survey(&mut self, options: &Options) -> Result<(), Error> {
        if options.asks_for_looks() && self.kept.survey.is_none() {
            self.kept.survey = self.noise_survey(options.thickness)?;
        }
        Ok(())
    }
}
