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
        let scale = check_inversion(options, self.statistics.spacing)?;
        let points = &self.sequence.points;
        let farthest = farthest_distance(points, viewpoint)?;
        let radius =
            |choice| radius::resolve(choice, points, &self.statistics, viewpoint, farthest);
        let (kernel, chosen, inversion) = match options.inversion {
            Inversion::Spherical => {
                let chosen = radius(options.radius)?;
                let radius = chosen.radius;
                (Kernel::Spherical { radius }, chosen, Inversion::Spherical)
            }
            Inversion::Power(gamma) => {
                let unit = match options.radius {
                    Radius::Auto => farthest,
                    choice => radius(choice)?.radius,
                };
                let kernel = Kernel::Power { gamma, unit };
                (kernel, ChosenRadius::unit(unit), options.inversion)
            }
            Inversion::Exponential(_) => (
                Kernel::Exponential { scale },
                ChosenRadius::unit(0.0),
                Inversion::Exponential(Exponential::Scale(scale)),
            ),
        };
        Ok(View {
            flip: Flip::new(viewpoint, kernel),
            chosen,
            inversion,
        })
    }
}

/// Refuses numbers out of range and choices that exclude each other; returns the
/// scale of an exponential inversion.
fn check_inversion(options: &Options, spacing: f64) -> Result<f64, Error> {
    let refuse = |inversion| {
        let option = options.radius.name();
        Err(Error::RadiusWithInversion { option, inversion })
    };
    match options.inversion {
        Inversion::Spherical => {}
        Inversion::Power(power) => {
            // Written so that a NaN is refused, too.
            if !(power > 1.0 && power <= 16.0) {
                return Err(Error::PowerInvalid { power });
            }
            if !matches!(options.radius, Radius::Auto | Radius::Absolute(_)) {
                return refuse("power");
            }
        }
        Inversion::Exponential(scale) => {
            if options.radius != Radius::Auto {
                return refuse("exponential");
            }
            return resolve_scale(scale, spacing);
        }
    }
    Ok(0.0)
}

/// Where there is no spacing, any scale gives the same answer.
fn resolve_scale(scale: Exponential, spacing: f64) -> Result<f64, Error> {
    match scale {
        Exponential::Auto if spacing > 0.0 => {
            Ok((SPACINGS_IN_SCALE * spacing).clamp(f64::MIN_POSITIVE, f64::MAX))
        }
        Exponential::Auto => Ok(1.0),
        Exponential::Scale(scale) if scale > 0.0 && scale.is_finite() => Ok(scale),
        Exponential::Scale(scale) => Err(Error::ScaleInvalid { scale }),
    }
}
