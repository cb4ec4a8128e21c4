//! How a surface is sampled, from the spacings of a few of its points.
//!
//! A point with spacing s stands for a piece of surface whose area grows as s². So a mean over the
//! points tells of the dense places, and a mean with weights s² tells of the surface.

use alloc::vec::Vec;

use crate::base::allocation::OutOfMemory;
use crate::base::sort::percentile;

/// How many points are measured; with more of them the mean hardly changes.
pub(crate) const SAMPLES: usize = 2048;
/// The percentile of the spacings at which longer ones are cut off. Otherwise a few stray points
/// far from the surface would decide.
const PERCENTILE: usize = 99;

/// The mean of the spacings; 0 where there are none.
pub(crate) fn mean(spacings: &[f64]) -> f64 {
    // Not `sum`, which is -0 where there is nothing.
    let total = spacings.iter().fold(0.0, |total, spacing| total + spacing);
    total / spacings.len().max(1) as f64
}

/// The spacing at which longer ones are cut off; infinite where there are none.
pub(crate) fn longest(spacings: &[f64]) -> Result<f64, OutOfMemory> {
    Ok(percentile(spacings, PERCENTILE)?.unwrap_or(f64::INFINITY))
}

/// Cuts off the spacings that are longer.
pub(crate) fn cut_off(mut spacings: Vec<f64>, longest: f64) -> Vec<f64> {
    for spacing in &mut spacings {
        *spacing = spacing.min(longest);
    }
    spacings
}

/// The gap: the mean of s³ ÷ the square of the mean of s. It is the spacing if all points have the
/// same one. Where sampling is uneven, it is longer, because holes between sparse points let the
/// points behind shine through: it is the mean spacing over the surface × the mean of s² ÷ the
/// square of the mean of s. 0 where there are no spacings, or where they are 0.
pub(crate) fn gap(spacings: &[f64]) -> f64 {
    // In units of the mean, so that no power overflows.
    let unit = mean(spacings);
    let mut cubes = 0.0;
    for spacing in spacings {
        let share = spacing / unit;
        cubes += share * share * share;
    }
    if unit > 0.0 {
        unit * (cubes / spacings.len() as f64)
    } else {
        0.0
    }
}

/// Turns spacings into the areas for which their points stand, in some unit.
pub(crate) fn into_areas(mut spacings: Vec<f64>) -> Vec<f64> {
    let unit = mean(&spacings);
    for spacing in &mut spacings {
        let share = *spacing / unit;
        *spacing = share * share;
    }
    spacings
}

/// The mean and the variance of numbers with these weights; 0 where there are no weights.
pub(crate) fn moments(weights: &[f64], number: &dyn Fn(usize) -> f64) -> [f64; 2] {
    if weights.is_empty() {
        return [0.0, 0.0];
    }
    // Sums relative to one of the numbers keep the detail of georeferenced clouds.
    let origin = number(0);
    let [mut total, mut sum, mut squares] = [0.0; 3];
    for (i, weight) in weights.iter().enumerate() {
        total += weight;
        sum += weight * (number(i) - origin);
    }
    let mean = origin + sum / total;
    for (i, weight) in weights.iter().enumerate() {
        let off = number(i) - mean;
        squares += weight * (off * off);
    }
    [mean, squares / total]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_the_mean_and_the_variance() {
        assert_eq!(moments(&[], &|_| unreachable!()), [0.0, 0.0]);
        // Far from 0, so that squares of the numbers themselves would lose the variance.
        let numbers = [4e8 + 2.0, 4e8 - 1.0, 4e8 + 8.0];
        let weights = [1.0, 2.0, 1.0];
        assert_eq!(moments(&weights, &|i| numbers[i]), [4e8 + 2.0, 13.5]);
    }
}
