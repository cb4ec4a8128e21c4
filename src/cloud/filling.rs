//! How far the gaps are wider than the spacings tell, because the samples leave much of what they
//! span empty. The flat sides of a part have no points but at their rims. No distance to near
//! neighbors tells of such a gap. Thin things, like wires, are alike: what they hide lies near.
//!
//! The samples follow the Hilbert curve, so each run of them is one region of the cloud.

use core::ops::Range;
use glam::DVec3;

use crate::base::real::square_root;

/// Regions, with at least as many samples in each.
const RUNS: usize = 16;
/// A region is cut so often into halves, always at its longest jump.
const CUTS: usize = 3;
/// The emptiness above which gaps count as wider. Evenly sampled surfaces have 0.06 to 0.13. Errors
/// against ray-traced truth change little between 0.155 and 0.175. A region also holds things that are far apart if
/// its parts span less than this share of it. Then only the parts count.
const EMPTY: f64 = 1.0 / 6.0;
/// The largest answer.
const WIDEST: f64 = 32.0;

/// Sampled points with the spacing of each.
struct Samples<'a> {
    spacings: &'a [f64],
    /// Points with more than this spacing may be strays, which span nothing.
    longest: f64,
    point: &'a dyn Fn(usize) -> [f64; 3],
}

/// How many times wider the gaps are, 1 at least: (6 × emptiness)⁵. The emptiness is what a region
/// spans ÷ the area for which its points stand, as a mean over the regions. Spacings count as the
/// `longest` one at most. `count` points were sampled.
pub(crate) fn widening(
    spacings: &[f64],
    longest: f64,
    count: usize,
    point: &dyn Fn(usize) -> [f64; 3],
) -> f64 {
    let samples = Samples {
        spacings,
        longest,
        point,
    };
    let all = spacings.len();
    let runs = (all / RUNS).clamp(1, RUNS);
    let mut emptiness = 0.0;
    for run in 0..runs {
        let [start, end] = [run * all / runs, (run + 1) * all / runs];
        let whole = samples.span(start..end);
        let parts = samples.parts(start..end, CUTS);
        let spanned = if parts < EMPTY * whole.area {
            parts
        } else {
            whole.area
        };
        emptiness += spanned / whole.stands_for;
    }
    let weight = count as f64 / all as f64;
    let ratio = emptiness / (runs as f64 * weight * EMPTY);
    // It is NaN where numbers overflow, and where there is no spacing.
    if ratio > 1.0 {
        let square = ratio * ratio;
        (square * square * ratio).min(WIDEST)
    } else {
        1.0
    }
}

/// A run of samples. Areas are in squares of the longest spacing.
struct Span {
    /// The area that the run spans, by its moments: the root of the sum of the principal minors
    /// of its covariance. For a rectangle it is a twelfth of its area.
    area: f64,
    /// The area for which its points stand.
    stands_for: f64,
    /// The sample that is farthest from the one before it.
    cut: usize,
}

impl Samples<'_> {
    /// The area that the parts of a run span together.
    fn parts(&self, run: Range<usize>, cuts: usize) -> f64 {
        let whole = self.span(run.clone());
        if cuts == 0 {
            return whole.area;
        }
        self.parts(run.start..whole.cut, cuts - 1) + self.parts(whole.cut..run.end, cuts - 1)
    }

    #[inline(never)]
    fn span(&self, run: Range<usize>) -> Span {
        let next = |v: DVec3| DVec3::new(v.y, v.z, v.x);
        let mut cut = run.start;
        // Sums relative to one of the places keep the detail of georeferenced clouds.
        let origin = run.start;
        let [mut sum, mut squares, mut products, mut last] = [DVec3::ZERO; 4];
        let [mut number, mut farthest, mut stands_for] = [0.0; 3];
        for sample in run {
            let side = self.spacings[sample] / self.longest;
            if side > 1.0 {
                stands_for += 1.0;
                continue;
            }
            stands_for += side * side;
            let from_origin = |sample| DVec3::from_array((self.point)(sample));
            let v = (from_origin(sample) - from_origin(origin)) / self.longest;
            let jump = (v - last).length_squared();
            if jump > farthest {
                (cut, farthest) = (sample, jump);
            }
            last = v;
            number += 1.0;
            sum += v;
            squares += v * v;
            products += v * next(v);
        }
        let mean = sum / number;
        let variance = squares / number - mean * mean;
        let covariance = products / number - mean * next(mean);
        let minors = (variance * next(variance) - covariance * covariance).element_sum();
        Span {
            // Roundings can make it negative. It is NaN without samples.
            area: square_root(if minors > 0.0 { minors } else { 0.0 }),
            stands_for,
            cut,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// Points one apart, along the rim of a square or row by row.
    fn rim(side: usize) -> Vec<[f64; 3]> {
        let place = |k: usize| {
            let along = (k % side) as f64;
            let far = side as f64;
            let [x, y] = match k / side {
                0 => [along, 0.0],
                1 => [far, along],
                2 => [far - along, far],
                _ => [0.0, far - along],
            };
            [x, y, 0.5 * x]
        };
        (0..4 * side).map(place).collect()
    }

    fn rectangle(columns: usize, rows: usize) -> Vec<[f64; 3]> {
        let place = |k: usize| [(k % columns) as f64, (k / columns) as f64, 7.0];
        (0..columns * rows).map(place).collect()
    }

    fn widened(points: &[[f64; 3]], unit: f64, sampled: f64) -> f64 {
        let spacings: Vec<f64> = points.iter().map(|_| unit).collect();
        let count = (sampled * points.len() as f64) as usize;
        let far = [523_000.0, 4_657_000.0, 120.0];
        let point = |k: usize| core::array::from_fn(|i| far[i] + unit * points[k][i]);
        widening(&spacings, unit, count, &point)
    }

    #[test]
    fn gaps_are_wider_where_samples_leave_what_they_span_empty() {
        assert_eq!(widened(&rectangle(60, 40), 0.25, 1.0), 1.0);
        for (side, wider) in [(5, 5.886), (6, 14.213), (7, 30.166)] {
            let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-3;
            for unit in [0.25, 4.0] {
                assert!(near(widened(&rim(side), unit, 1.0), wider));
                let fewer = widened(&rim(side), unit, 1.25);
                assert!(near(fewer, (wider / 1.25f64.powi(5)).max(1.0)));
            }
        }
        // Each region is one of these rims.
        let apart = |k: usize| move |[x, y, z]: [f64; 3]| [x, y + 100.0 * k as f64, z];
        let rims: Vec<[f64; 3]> = (0..RUNS)
            .flat_map(|k| rim(7).into_iter().map(apart(k)))
            .collect();
        let one = widened(&rim(7), 0.25, 1.0);
        assert!((widened(&rims, 0.25, 1.0) / one - 1.0).abs() < 1e-6);
        assert_eq!(widened(&rim(7), 0.25, 0.9), WIDEST);
    }

    #[test]
    fn runs_span_a_twelfth_of_a_rectangle() {
        let points = rectangle(30, 20);
        let mut spacings: Vec<f64> = points.iter().map(|_| 2.0).collect();
        let two = |k: usize| {
            let [x, y, z] = points[k % 600];
            [x, y, z + 1000.0 * (k / 600) as f64]
        };
        spacings.extend_from_within(..);
        let samples = Samples {
            spacings: &spacings,
            longest: 4.0,
            point: &two,
        };
        let area = 30.0 * 20.0 / 12.0 / 16.0;
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 0.01;
        let one = samples.span(600..1200);
        assert!(
            near(one.area, area) && near(one.stands_for, 150.0),
            "{} {}",
            one.area,
            one.stands_for
        );
        assert_eq!(samples.span(0..1200).cut, 600);
        assert!(near(samples.parts(0..1200, 1), 2.0 * area));
        // Longer spacings than the longest stand for one square each, and their places do not count.
        let samples = Samples {
            spacings: &spacings,
            longest: 1.5,
            point: &two,
        };
        assert_eq!(samples.span(0..600).stands_for, 600.0);
        assert_eq!(samples.span(0..600).area, 0.0);
    }
}
