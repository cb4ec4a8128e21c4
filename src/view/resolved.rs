//! One view of a cloud: the viewpoint and the options, checked and resolved to a flip.

use alloc::vec::Vec;

use glam::DVec3;

use crate::base::FULL;
use crate::base::allocation::with_capacity;
use crate::base::error::{Error, in_range};
use crate::base::real::square_root;
use crate::cloud::point_cloud::PointCloud;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::hull::visible_once;
use crate::view::options::{Exponential, Inversion, Options, Radius};
use crate::view::radius::{self, ChosenRadius, LARGEST, automatic, from_radius, given};

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

// Choosing the radius R of the flipping sphere (paper §4): by the closed form, by the paper's
// own rule, or as given.

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
