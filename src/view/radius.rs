//! A radius R of the flipping sphere: checked, or by the closed form (paper §4).

use core::f64::consts::PI;

use crate::base::error::{Error, in_range};
use crate::base::real::{larger, sine_cosine, square_root};
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
    let gap = noise.gap(statistics.gap) * noise.widening(statistics);
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

// Bounds that the paper proves (§4 and appendix).

/// The largest curvature of a pit whose bottom is still found visible (Lemma 4.3), in the
/// inverse of the unit of length:
///
/// k < [4R(2R − r)·cot²β + 2Rr] / (4Rr − 4R² + (r − 2R)²/sin²β)^(3/2)
///
/// for a point at distance `r` from the viewpoint, flipped with `radius` R. `beta` is
/// the angle, from 0 to π, between the ray and the hull's plane at the *flipped* point
/// (π/2 faces the viewer: k < 2R/r²). Where the surface itself meets the ray at an angle
/// ψ, cot β = r·cot ψ/(2R − r). Surfaces that are flat or bend away from the viewer are
/// always found; in space the bound is for every direction.
///
/// # Errors
/// [`Error::OutOfRange`] unless 0 < `r` ≤ `radius`, finite, and 0 ≤ `beta` ≤ π.
///
/// ```
/// use hidden_point_removal::permissible_curvature;
///
/// let facing = permissible_curvature(100.0, 5.0, core::f64::consts::FRAC_PI_2)?;
/// assert!((facing - 2.0 * 100.0 / 25.0).abs() < 1e-12);
/// # Ok::<(), hidden_point_removal::Error>(())
/// ```
pub fn permissible_curvature(radius: f64, r: f64, beta: f64) -> Result<f64, Error> {
    in_range("r", r, f64::MIN_POSITIVE, f64::MAX)?;
    in_range("R", radius, r, f64::MAX)?;
    in_range("beta", beta, 0.0, PI)?;
    // In units of R; numerator and denominator times t³·sin³β, t = r ÷ R. Nothing overflows.
    // The denominator is the paper's, written without differences:
    // 4Rr − 4R² + (2R − r)²/sin²β = r² + (2R − r)²·cot²β.
    let (sin, cos) = sine_cosine(beta);
    let t = r / radius;
    let far = 2.0 - t;
    let above = 2.0 * sin * (2.0 * far * cos * cos + t * sin * sin);
    let below = libm::hypot(t * sin, far * cos);
    Ok(above / below / below / below / radius)
}

/// The radius R below which the bottoms of dents in a body are hidden (paper §4):
/// d·r²/ρ². The body has `thickness` d, its back is at `distance` r from the viewpoint, and
/// the samples of its front lie 2ρ apart; ρ is the `spacing`. With a larger R the back shows
/// between the samples of the front.
///
/// # Errors
/// [`Error::OutOfRange`] for a number that is not positive and finite.
///
/// ```
/// use hidden_point_removal::radius_bound;
///
/// assert_eq!(radius_bound(0.5, 4.0, 0.1)?.round(), 800.0);
/// # Ok::<(), hidden_point_removal::Error>(())
/// ```
pub fn radius_bound(thickness: f64, distance: f64, spacing: f64) -> Result<f64, Error> {
    let positive = |option, x| in_range(option, x, f64::MIN_POSITIVE, f64::MAX);
    positive("thickness", thickness)?;
    positive("distance", distance)?;
    positive("spacing", spacing)?;
    let samples = distance / spacing;
    Ok((thickness * samples * samples).min(f64::MAX))
}
