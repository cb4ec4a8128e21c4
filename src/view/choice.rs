//! Choosing the radius R of the flipping sphere (paper §4): by the closed form, by the paper's
//! own rule, or as given.

use alloc::vec::Vec;

use crate::base::FULL;
use crate::base::allocation::with_capacity;
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::hull::visible_once;
use crate::view::options::Radius;
use crate::view::radius::{ChosenRadius, automatic, from_radius, given};
use crate::view::search::opposite;

/// Computes which distinct points are visible from a place, flipped by a kernel.
type Seeing<'a> = dyn Fn(&[f64], Kernel) -> Result<Vec<bool>, Error> + 'a;

/// A cloud of any dimension, as far as a choice of R needs to know it.
pub(crate) struct RadiusInput<'a> {
    pub viewpoint: &'a [f64],
    pub centroid: &'a [f64],
    /// R by the closed form.
    pub automatic: f64,
    /// The farthest distance from the viewpoint.
    pub farthest: f64,
    /// The farthest distance from another place; infinite where it overflows.
    pub reach: &'a dyn Fn(&[f64]) -> f64,
    /// Which distinct points are visible from a place.
    pub seen: &'a Seeing<'a>,
}

impl RadiusInput<'_> {
    /// Turns the caller's choice into a radius.
    pub(crate) fn resolve(&self, choice: Radius) -> Result<ChosenRadius, Error> {
        let (viewpoint, farthest) = (self.viewpoint, self.farthest);
        match choice {
            Radius::Opposite if FULL => {
                let mut mirror = with_capacity(viewpoint.len())?;
                let axes = self.centroid.iter().zip(viewpoint);
                mirror.extend(axes.map(|(center, x)| center + (center - x)));
                let reach = (self.reach)(&mirror);
                // At the centroid there is no other side.
                let opposite = if mirror == viewpoint {
                    None
                } else {
                    opposite(reach.max(farthest), farthest, &mut |kernel| {
                        let here = (self.seen)(viewpoint, kernel)?;
                        let there = (self.seen)(&mirror, kernel)?;
                        Ok(here.iter().zip(&there).filter(|(a, b)| a != b).count())
                    })?
                };
                Ok(opposite.unwrap_or_else(|| from_radius(self.automatic, farthest)))
            }
            Radius::Absolute(_) | Radius::Exponent(_) => given(choice, farthest),
            Radius::Auto | Radius::Opposite => Ok(from_radius(self.automatic, farthest)),
        }
    }
}

impl PointCloud {
    /// Turns the caller's choice into a radius. The farthest point from `viewpoint` is at `farthest`.
    pub(crate) fn chosen_radius(
        &self,
        choice: Radius,
        viewpoint: [f64; 3],
        farthest: f64,
    ) -> Result<ChosenRadius, Error> {
        if let Radius::Absolute(_) | Radius::Exponent(_) = choice {
            // Nothing has to be measured.
            return given(choice, farthest);
        }
        let statistics = &self.statistics()?;
        let noise = &self.known_noise()?;
        let points = &self.sequence.points;
        let place = |p: &[f64]| [p[0], p[1], p[2]];
        let input = RadiusInput {
            viewpoint: &viewpoint,
            centroid: &statistics.centroid,
            automatic: automatic(statistics, noise, viewpoint, farthest),
            farthest,
            reach: &|p| {
                let reach = self.blocks.farthest_distance(points, place(p));
                reach.unwrap_or(f64::INFINITY)
            },
            seen: &|p, kernel| Ok(visible_once(points, &Flip::new(place(p), kernel))?),
        };
        input.resolve(choice)
    }
}
