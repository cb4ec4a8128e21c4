//! One view of a cloud: the viewpoint and the options, checked and resolved to a flip.

use glam::DVec3;

use crate::base::error::{Error, in_range};
use crate::base::real::square_root;
use crate::cloud::point_cloud::PointCloud;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::view::options::{Exponential, Inversion, Options, Radius};
use crate::view::radius::{self, ChosenRadius};

/// The scale of [`Exponential::Auto`], in spacings. Errors against ray-traced truth are least
/// between 0.05 and 0.06 for scanned surfaces seen from outside, and between 0.06 and 0.08
/// inside furnished rooms. They grow faster below than above. At 0.07 they are 0.8 to 1.05
/// times the error of the best R of each view.
const SPACINGS_IN_SCALE: f64 = 0.07;

/// A view that is ready to be computed: its options are numbers.
pub(crate) struct View {
    pub flip: Flip,
    pub chosen: ChosenRadius,
    /// The inversion, with numbers only.
    pub inversion: Inversion,
    /// The distance of the farthest point.
    pub farthest: f64,
}

impl PointCloud {
    /// Refuses options that are refused for every viewpoint. Queries without a viewpoint use it.
    pub(crate) fn check_options(&self, options: &Options) -> Result<(), Error> {
        match looks(options)? {
            Some(_) => Ok(()),
            None => check_flip(options),
        }
    }

    /// The inversion with numbers only.
    pub(crate) fn resolved_inversion(&self, options: &Options) -> Result<Inversion, Error> {
        let spacing = match options.inversion {
            Inversion::Exponential(Exponential::Auto) => self.spacing()?,
            _ => 0.0,
        };
        resolved_inversion(options, spacing)
    }

    pub(crate) fn view(&self, viewpoint: [f64; 3], options: &Options) -> Result<View, Error> {
        check_viewpoint(viewpoint)?;
        let inversion = self.resolved_inversion(options)?;
        let points = &self.sequence.points;
        let farthest = self.blocks.farthest_distance(points, viewpoint)?;
        let (kernel, chosen) = resolved_kernel(inversion, options.radius, farthest, &|choice| {
            self.chosen_radius(choice, viewpoint, farthest)
        })?;
        Ok(View {
            flip: Flip::new(viewpoint, kernel),
            chosen,
            inversion,
            farthest,
        })
    }
}

/// The kernel of an inversion with numbers only, and the radius that was chosen for it.
/// `radius` turns a choice of R into a number.
#[inline(never)]
pub(crate) fn resolved_kernel(
    inversion: Inversion,
    choice: Radius,
    farthest: f64,
    radius: &dyn Fn(Radius) -> Result<ChosenRadius, Error>,
) -> Result<(Kernel, ChosenRadius), Error> {
    Ok(match inversion {
        Inversion::Spherical => {
            let chosen = radius(choice)?;
            let radius = chosen.radius;
            (Kernel::Spherical { radius }, chosen)
        }
        Inversion::Power(gamma) => {
            let unit = match choice {
                Radius::Auto => farthest,
                choice => radius(choice)?.radius,
            };
            (Kernel::Power { gamma, unit }, ChosenRadius::unit(unit))
        }
        Inversion::Exponential(scale) => {
            let scale = resolved_scale(scale, 0.0)?;
            (Kernel::Exponential { scale }, ChosenRadius::unit(0.0))
        }
        Inversion::Looks(_) => return Err(SEVERAL_HULLS),
    })
}

/// The flip of a view whose radius and inversion are numbers, before its points are known.
#[inline(never)]
pub(crate) fn numbered_flip(viewpoint: [f64; 3], options: &Options) -> Result<Flip, Error> {
    check_viewpoint(viewpoint)?;
    let inversion = resolved_inversion(options, 0.0)?;
    let radius = |choice| radius::given(choice, 0.0);
    let (kernel, _) = resolved_kernel(inversion, options.radius, 0.0, &radius)?;
    Ok(Flip::new(viewpoint, kernel))
}

pub(crate) fn check_viewpoint(viewpoint: [f64; 3]) -> Result<(), Error> {
    if viewpoint.iter().any(|x| !x.is_finite()) {
        return Err(Error::Viewpoint { viewpoint });
    }
    Ok(())
}

/// The unit vector, unless `direction` is zero or not finite.
pub(crate) fn normalized(direction: [f64; 3]) -> Option<DVec3> {
    let direction = DVec3::from_array(direction);
    let size = direction.abs().max_element();
    if !(direction.is_finite() && size > 0.0) {
        return None;
    }
    // Scaled, so that squares neither overflow nor underflow.
    let direction = direction / size;
    Some(direction / square_root(direction.dot(direction)))
}

/// Refuses options that are refused even where all points are at the viewpoint.
pub(crate) fn check_flip(options: &Options) -> Result<(), Error> {
    let inversion = resolved_inversion(options, 0.0)?;
    let radius = |choice| radius::given(choice, 0.0);
    resolved_kernel(inversion, options.radius, 0.0, &radius)?;
    Ok(())
}

/// The inversion with numbers only. Refuses numbers out of range.
#[inline(never)]
pub(crate) fn resolved_inversion(options: &Options, spacing: f64) -> Result<Inversion, Error> {
    match options.inversion {
        Inversion::Spherical => Ok(Inversion::Spherical),
        Inversion::Power(power) => {
            // The comparison also refuses a NaN.
            if !(power > 1.0 && power <= 16.0) {
                return Err(Error::Parameter {
                    option: "inversion power",
                    must_be: "above 1 and at most 16",
                    value: power,
                });
            }
            Ok(options.inversion)
        }
        Inversion::Exponential(scale) => {
            let scale = resolved_scale(scale, spacing)?;
            Ok(Inversion::Exponential(Exponential::Scale(scale)))
        }
        Inversion::Looks(_) => Err(SEVERAL_HULLS),
    }
}

/// A question about one hull was asked with an inversion that has several, or none.
pub(crate) const SEVERAL_HULLS: Error = Error::Excludes {
    option: "looks",
    other: "a question about one hull",
};

/// How many looks are asked for, if any.
pub(crate) fn looks(options: &Options) -> Result<Option<usize>, Error> {
    match options.inversion {
        Inversion::Looks(count) => {
            in_range("looks", count as f64, 2.0, 3.0)?;
            if let Some(thickness) = options.thickness {
                in_range("thickness", thickness, 0.0, f64::MAX)?;
            }
            Ok(Some(count))
        }
        _ => Ok(None),
    }
}

/// The scale as a number. Where there is no spacing, any scale gives the same answer.
fn resolved_scale(scale: Exponential, spacing: f64) -> Result<f64, Error> {
    match scale {
        Exponential::Auto if spacing > 0.0 => {
            // Not `clamp`: its panic brings the formatting of numbers, 30 kB of wasm.
            Ok((SPACINGS_IN_SCALE * spacing).max(f64::MIN_POSITIVE))
        }
        Exponential::Auto => Ok(1.0),
        Exponential::Scale(scale) if scale > 0.0 && scale.is_finite() => Ok(scale),
        Exponential::Scale(value) => Err(Error::Parameter {
            option: "inversion exponential",
            must_be: "finite and positive",
            value,
        }),
    }
}
