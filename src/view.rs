//! One view of a cloud: the viewpoint and the options, checked and resolved to a flip.

use crate::cloud::PointCloud;
use crate::error::Error;
use crate::inversion::{Flip, Kernel, farthest_distance};
use crate::options::{Exponential, Inversion, Options, Radius};
use crate::radius::{self, ChosenRadius};

/// Spacings in the scale of [`Exponential::Auto`]. Errors against ray-traced truth are
/// least between 0.05 and 0.06 for scanned surfaces seen from outside, between 0.06 and
/// 0.08 inside furnished rooms, and grow faster below than above; at 0.07 they are 0.8
/// to 1.05 times what the best R of every single view leaves.
const SPACINGS_IN_SCALE: f64 = 0.07;

/// What a view was resolved to.
pub(crate) struct View {
    pub flip: Flip,
    pub chosen: ChosenRadius,
    /// With numbers only.
    pub inversion: Inversion,
}

impl PointCloud {
    pub(crate) fn view(&self, viewpoint: [f64; 3], options: &Options) -> Result<View, Error> {
        if viewpoint.iter().any(|x| !x.is_finite()) {
            return Err(Error::Viewpoint { viewpoint });
        }
        let inversion = self.resolved_inversion(options)?;
        let points = &self.sequence.points;
        let farthest = farthest_distance(points, viewpoint)?;
        let radius =
            |choice| radius::resolve(choice, points, &self.statistics, viewpoint, farthest);
        let (kernel, chosen) = match inversion {
            Inversion::Spherical => {
                let chosen = radius(options.radius)?;
                let radius = chosen.radius;
                (Kernel::Spherical { radius }, chosen)
            }
            Inversion::Power(gamma) => {
                let unit = match options.radius {
                    Radius::Auto => farthest,
                    choice => radius(choice)?.radius,
                };
                (Kernel::Power { gamma, unit }, ChosenRadius::unit(unit))
            }
            Inversion::Exponential(scale) => {
                let scale = self.resolved_scale(scale)?;
                (Kernel::Exponential { scale }, ChosenRadius::unit(0.0))
            }
        };
        Ok(View {
            flip: Flip::new(viewpoint, kernel),
            chosen,
            inversion,
        })
    }

    /// The inversion with numbers only; numbers out of range and choices that exclude
    /// each other are refused.
    pub(crate) fn resolved_inversion(&self, options: &Options) -> Result<Inversion, Error> {
        let refuse = |inversion| {
            let option = options.radius.name();
            Err(Error::RadiusWithInversion { option, inversion })
        };
        match options.inversion {
            Inversion::Spherical => Ok(Inversion::Spherical),
            Inversion::Power(power) => {
                // Written so that a NaN is refused, too.
                if !(power > 1.0 && power <= 16.0) {
                    return Err(Error::PowerInvalid { power });
                }
                if !matches!(options.radius, Radius::Auto | Radius::Absolute(_)) {
                    return refuse("power");
                }
                Ok(options.inversion)
            }
            Inversion::Exponential(scale) => {
                if options.radius != Radius::Auto {
                    return refuse("exponential");
                }
                let scale = self.resolved_scale(scale)?;
                Ok(Inversion::Exponential(Exponential::Scale(scale)))
            }
        }
    }

    /// Where there is no spacing, any scale gives the same answer.
    fn resolved_scale(&self, scale: Exponential) -> Result<f64, Error> {
        let spacing = self.statistics.spacing;
        match scale {
            Exponential::Auto if spacing > 0.0 => {
                Ok((SPACINGS_IN_SCALE * spacing).clamp(f64::MIN_POSITIVE, f64::MAX))
            }
            Exponential::Auto => Ok(1.0),
            Exponential::Scale(scale) if scale > 0.0 && scale.is_finite() => Ok(scale),
            Exponential::Scale(scale) => Err(Error::ScaleInvalid { scale }),
        }
    }
}
