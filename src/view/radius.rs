//! A radius R of the flipping sphere: checked, or by the closed form (paper §4).

use crate::base::error::Error;
use crate::base::real::{larger, square_root};
use crate::cloud::neighbors::distance_squared;
use crate::cloud::noise::Noise;
use crate::cloud::points::Given;
use crate::cloud::statistics::Statistics;
use crate::view::options::Radius;

/// A radius fit for flipping: at least the farthest distance, 2R finite.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ChosenRadius {
    /// R, in the cloud's units; 0 where no point is away from the viewpoint.
    pub radius: f64,
    /// log₁₀(R ÷ farthest distance), the paper's parameter; 0 where the farthest distance is 0.
    pub exponent: f64,
    /// How many hulls the choice of R took.
    pub evaluations: u32,
}

impl ChosenRadius {
    /// A length without an exponent, found without a search.
    pub(crate) fn unit(radius: f64) -> Self {
        Self {
            radius,
            exponent: 0.0,
            evaluations: 0,
        }
    }

    /// The larger radius of two views, with the number of hulls of both choices.
    pub(crate) fn joined(self, other: Self) -> Self {
        let larger = if other.radius > self.radius {
            other
        } else {
            self
        };
        Self {
            evaluations: self.evaluations + other.evaluations,
            ..larger
        }
    }
}

/// Checks a choice of R for points that are not in a cloud.
pub(crate) fn check_reach(choice: Radius, viewpoint: [f64; 3], points: Given) -> Result<(), Error> {
    let mut largest = 0.0f64;
    for p in points.iter() {
        largest = largest.max(distance_squared(p, viewpoint));
    }
    let farthest = square_root(largest);
    if !farthest.is_finite() {
        let radius = None;
        return Err(Error::RadiusOverflow { radius, farthest });
    }
    given(choice, farthest)?;
    Ok(())
}

/// The largest R the flip accepts: 2R·(1 + rounding) must not overflow.
pub(crate) const LARGEST: f64 = f64::MAX / 2.0 * (1.0 - 1e-15);

/// Checks a radius that is given as a number. Any other choice becomes the closed form of a
/// cloud without spacing: the farthest distance.
#[inline(never)]
pub(crate) fn given(choice: Radius, farthest: f64) -> Result<ChosenRadius, Error> {
    match choice {
        Radius::Absolute(radius) => {
            if !(radius > 0.0 && radius.is_finite()) {
                // No distance matters.
                let farthest = 0.0;
                Err(Error::Radius { radius, farthest })
            } else if radius < farthest {
                Err(Error::Radius { radius, farthest })
            } else if radius > LARGEST {
                Err(Error::RadiusOverflow {
                    radius: Some(radius),
                    farthest,
                })
            } else {
                Ok(from_radius(radius, farthest))
            }
        }
        Radius::Exponent(exponent) => {
            if !(exponent >= 0.0 && exponent.is_finite()) {
                return Err(Error::Parameter {
                    option: "exponent",
                    must_be: "finite and at least 0",
                    value: exponent,
                });
            }
            if farthest == 0.0 {
                return Ok(from_radius(0.0, farthest));
            }
            let radius = farthest * libm::pow(10.0, exponent);
            if radius > LARGEST {
                return Err(Error::RadiusOverflow {
                    radius: Some(radius),
                    farthest,
                });
            }
            Ok(ChosenRadius {
                radius,
                exponent,
                evaluations: 0,
            })
        }
        Radius::Auto | Radius::Opposite => Ok(from_radius(farthest, farthest)),
    }
}

/// R of a view is this many times n^¼·r² ÷ gap. Errors against ray-traced truth change little
/// between 0.35 and 0.5. They grow faster above than below, the more so the less evenly a surface
/// is sampled.
const FACTOR: f64 = 0.4;

pub(crate) fn automatic(
    statistics: &Statistics,
    noise: &Noise,
    viewpoint: [f64; 3],
    farthest: f64,
) -> f64 {
    let r_squared = distance_squared(viewpoint, statistics.middle) + statistics.variance;
    let gap = effective_gap(statistics, noise);
    closed_form(statistics.count, r_squared, gap, farthest)
}

/// The gap of a clean surface that would have the same radius. Points of a measured surface lie
/// behind each other, and only a larger sphere shows them. What lies d behind a clean surface is hidden only by
/// R < d·r²/s² (paper §4).
pub(crate) fn effective_gap(statistics: &Statistics, noise: &Noise) -> f64 {
    let measured = noise.gap.map(|gap| gap * statistics.widening);
    let gap = statistics.gap.min(measured.unwrap_or(f64::INFINITY));
    let bound = bend(statistics.count, noise.next_sheet) * noise.usual * noise.usual;
    larger(gap, bound)
}

/// R = 0.4·n^¼·r²/g, with n the number of distinct points, r the root-mean-square distance of the
/// surface from the viewpoint and g the gap between its samples (see `surface` and `filling`). A
/// denser or more distant cloud needs a larger sphere. r² is |C − middle|² + variance. So no pass
/// over the points is needed, and R moves smoothly with the viewpoint, inside the cloud too.
pub(crate) fn closed_form(count: usize, r_squared: f64, gap: f64, farthest: f64) -> f64 {
    if count < 2 || gap == 0.0 || farthest == 0.0 {
        return farthest;
    }
    within(bend(count, gap) * r_squared, farthest)
}

/// How often r² makes up R: 0.4·n^¼/g. What has to be hidden lies as deep as the body is thick. In
/// units of g, a body of n points is about √n thick; the best R grows with the root of that.
pub(crate) fn bend(count: usize, gap: f64) -> f64 {
    FACTOR * square_root(square_root(count as f64)) / gap
}

/// `radius`, or the nearest radius that is fit for flipping.
fn within(radius: f64, farthest: f64) -> f64 {
    // `max` and `min` also replace a NaN, which overflowing statistics give, by a bound.
    radius.max(farthest).min(LARGEST)
}

/// `radius`, or the nearest radius that is fit for flipping, with its exponent.
pub(crate) fn bounded(radius: f64, farthest: f64) -> ChosenRadius {
    from_radius(within(radius, farthest), farthest)
}

#[inline(never)]
pub(crate) fn from_radius(radius: f64, farthest: f64) -> ChosenRadius {
    let exponent = if farthest > 0.0 && radius > farthest {
        libm::log10(radius / farthest).min(f64::MAX)
    } else {
        0.0
    };
    ChosenRadius {
        radius,
        exponent,
        evaluations: 0,
    }
}
