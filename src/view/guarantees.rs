//! Bounds that the paper proves (§4 and appendix).

use core::f64::consts::PI;

use crate::base::error::{Error, in_range};
use crate::base::real::sine_cosine;

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
