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
use crate::view::radius::{ChosenRadius, LARGEST, automatic, from_radius, given};

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

/// The steps of the paper's rule, in decades above the least radius: first every half decade,
/// then ever closer around the best one.
const COARSE: f64 = 0.5;
const COARSE_STEPS: u8 = 12;
const FINE: [f64; 3] = [0.25, 0.125, 0.0625];

/// The paper's own rule (§4). C′ is the mirror image of C in the cloud's centroid. The rule
/// takes the R for which the most points are seen by exactly one of the two. The paper
/// descends a gradient; here the optimum is bracketed, because the objective is a step
/// function.
///
/// `least` is the larger of the farthest distances from C and from C′. `look` counts the points
/// that exactly one of C and C′ sees with some radius. Returns `None` where no radius is possible.
pub(crate) fn opposite(
    least: f64,
    farthest: f64,
    look: &mut dyn FnMut(Kernel) -> Result<usize, Error>,
) -> Result<Option<ChosenRadius>, Error> {
    if !(least > 0.0 && least < LARGEST) {
        return Ok(None);
    }
    let mut evaluations = 0;
    let mut best: Option<(usize, f64)> = None;
    let mut consider = |decades: f64| -> Result<f64, Error> {
        let radius = (least * libm::pow(10.0, decades)).min(LARGEST);
        let one = look(Kernel::Spherical { radius })?;
        evaluations += 2;
        let better = match best {
            Some((most, at)) => one > most || one == most && decades < at,
            None => true,
        };
        if better {
            best = Some((one, decades));
        }
        Ok(best.map_or(decades, |(_, at)| at))
    };
    let mut at = 0.0;
    for step in 0..=COARSE_STEPS {
        at = consider(COARSE * f64::from(step))?;
    }
    for step in FINE {
        let center = at;
        if center >= step {
            consider(center - step)?;
        }
        at = consider(center + step)?;
    }
    let radius = (least * libm::pow(10.0, at)).min(LARGEST);
    Ok(Some(ChosenRadius {
        evaluations,
        ..from_radius(radius, farthest)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_at_both_viewpoints_have_no_radius() {
        for least in [0.0, f64::INFINITY, f64::NAN] {
            let radius = opposite(least, 1.0, &mut |_| panic!("nothing is seen"));
            assert!(radius.is_ok_and(|radius| radius.is_none()));
        }
    }
}
