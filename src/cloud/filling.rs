//! How far the gaps are wider than the spacings tell, because the samples leave much of what they
//! span empty. The flat sides of a part have no points but at their rims. No distance to near
//! neighbors tells of such a gap. Thin things, like wires, are alike: what they hide lies near.
//!
//! A region is the samples that are nearest to one of them. So shifts and turns change nothing.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::real::square_root;

/// A region has one of so many parts of the samples, and as many as twice that at least. Smaller ones lie within a
/// rim, larger ones bend around the body.
const PARTS: usize = 8;
/// Samples around which such regions are. With fewer, the choice of samples moves the mean.
const SEEDS: usize = 64;
/// The emptiness above which gaps count as wider. Evenly sampled surfaces have 0.03 to 0.08.
const EMPTY: f64 = 1.0 / 11.0;
/// The largest answer.
const WIDEST: f64 = 32.0;
/// A shell holds the squares of distances, plus 1, with equal exponents and first two bits.
const SHELL: u32 = 50;
/// The shell of the seed, where the square is 0.
const FIRST: usize = (1.0f64.to_bits() >> SHELL) as usize;
/// There is a last shell for all that is infinite, or NaN with or without a sign.
const SHELLS: usize = (f64::INFINITY.to_bits() >> SHELL) as usize - FIRST + 1;
/// A region ends before so many empty shells: from there on things are twice as far.
const APART: usize = 8;

/// Sampled points, in a unit: the longest distance of a sample from the next ones.
struct Samples {
    /// From one of them: that keeps the detail of georeferenced clouds.
    places: Vec<DVec3>,
    /// Points with a longer one than 1 may be strays, which span nothing.
    sides: Vec<f64>,
}

/// How many times wider the gaps are, 1 at least: (11 × emptiness)⁸, at most 32. The emptiness is what the regions
/// span ÷ the area for which their points stand. Spacings count as the
/// `longest` one at most. `count` points were sampled.
pub(crate) fn widening(
    spacings: &[f64],
    longest: f64,
    count: usize,
    point: &dyn Fn(usize) -> [f64; 3],
) -> Result<f64, OutOfMemory> {
    let all = spacings.len();
    let samples = Samples::new(spacings, longest, count, point)?;
    let size = (all / PARTS).max(2 * PARTS).min(all);
    let seeds = SEEDS.min(all);
    let [mut area, mut stands_for] = [0.0; 2];
    for number in 0..seeds {
        let span = samples.span((2 * number + 1) * all / (2 * seeds), size);
        area += span.area;
        stands_for += span.stands_for;
    }
    let ratio = area / (EMPTY * stands_for);
    // It is NaN where numbers overflow, and where there is no spacing.
    Ok(if ratio > 1.0 {
        let square = ratio * ratio;
        let fourth = square * square;
        (fourth * fourth).min(WIDEST)
    } else {
        1.0
    })
}

/// A region.
struct Span {
    /// The area that it spans, by its moments: the root of the sum of the principal minors
    /// of its covariance. For a rectangle it is a twelfth of its area.
    area: f64,
    /// The area for which its points stand.
    stands_for: f64,
}

impl Samples {
    fn new(
        spacings: &[f64],
        longest: f64,
        count: usize,
        point: &dyn Fn(usize) -> [f64; 3],
    ) -> Result<Self, OutOfMemory> {
        let all = spacings.len();
        let unit = longest * square_root(count as f64 / all as f64);
        let place = |sample| DVec3::from_array(point(sample));
        let mut places = with_capacity(all)?;
        places.extend((0..all).map(|sample| (place(sample) - place(0)) / unit));
        let mut sides = with_capacity(all)?;
        // Of many that are equally long, none is longer by a rounding.
        let longest = longest * (1.0 + 1e-6);
        sides.extend(spacings.iter().map(|spacing| spacing / longest));
        Ok(Self { places, sides })
    }

    /// What at least `size` samples span that are nearest to the sample `seed`, itself included, without things that
    /// are far apart.
    #[inline(never)]
    fn span(&self, seed: usize, size: usize) -> Span {
        let from = self.places[seed];
        let shell = |place: DVec3| {
            let bits = ((place - from).length_squared() + 1.0).to_bits();
            ((bits >> SHELL) as usize - FIRST).min(SHELLS - 1)
        };
        let mut inside = [0u32; SHELLS];
        for &place in &self.places {
            inside[shell(place)] += 1;
        }
        let [mut held, mut end, mut empty] = [0; 3];
        while held < size && empty < APART {
            held += inside[end] as usize;
            empty = if inside[end] > 0 { 0 } else { empty + 1 };
            end += 1;
        }
        let next = |v: DVec3| DVec3::new(v.y, v.z, v.x);
        let [mut sum, mut squares, mut products] = [DVec3::ZERO; 3];
        let [mut number, mut stands_for] = [0.0; 2];
        for (&place, &side) in self.places.iter().zip(&self.sides) {
            if shell(place) >= end {
                continue;
            }
            if side > 1.0 {
                stands_for += 1.0;
                continue;
            }
            stands_for += side * side;
            let v = place - from;
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
        widening(&spacings, unit, count, &point).unwrap()
    }

    #[test]
    fn gaps_are_wider_where_samples_leave_what_they_span_empty() {
        assert_eq!(widened(&rectangle(50, 40), 0.25, 1.0), 1.0);
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-3;
        for (side, sampled, wider) in [(2, 1.0, 3.1229), (3, 1.25, 8.0655)] {
            for unit in [0.25, 4.0] {
                assert!(near(widened(&rim(side), unit, sampled), wider));
                let fewer = widened(&rim(side), unit, 1.5);
                assert!(near(fewer, (wider * (sampled / 1.5).powi(8)).max(1.0)));
            }
        }
        // Each region is one of these rims.
        let apart = |k: usize| move |[x, y, z]: [f64; 3]| [x, y + 100.0 * k as f64, z];
        let rims: Vec<[f64; 3]> = (0..16)
            .flat_map(|k| rim(4).into_iter().map(apart(k)))
            .collect();
        assert!(near(
            widened(&rims, 0.25, 1.75),
            widened(&rim(4), 0.25, 1.75)
        ));
        assert_eq!(widened(&rim(4), 0.25, 1.25), WIDEST);
    }

    #[test]
    fn regions_span_a_twelfth_of_a_rectangle() {
        let points = rectangle(30, 20);
        let mut spacings: Vec<f64> = points.iter().map(|_| 2.0).collect();
        let two = |k: usize| {
            let [x, y, z] = points[k % 600];
            [x, y, z + 1000.0 * (k / 600) as f64]
        };
        spacings.extend_from_within(..);
        let samples = Samples::new(&spacings, 4.0, 1200, &two).unwrap();
        let area = 30.0 * 20.0 / 12.0 / 16.0;
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 0.01;
        for seed in [0, 599, 600, 700] {
            let span = samples.span(seed, 600);
            assert!(near(span.area, area) && near(span.stands_for, 150.0));
        }
        // Longer spacings than the longest stand for one square each, and their places do not count.
        let strays = Samples::new(&spacings, 1.5, 1200, &two).unwrap();
        let span = strays.span(0, 600);
        assert_eq!([span.stands_for, span.area], [600.0, 0.0]);
    }
}
