//! How far the gaps are wider than the spacings tell, because the samples leave much of what they
//! span empty. The flat sides of a part have no points but at their rims. No distance to near
//! neighbors tells of such a gap. Thin things, like wires, are alike: what they hide lies near.
//!
//! A region is the samples that are nearest to one of them. So shifts and turns change nothing.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::real::square_root;
use crate::base::sort::{Keyed, sort_keyed};
use crate::cloud::surface::SAMPLES;

/// A region has this share of the samples, and as many at least.
const REGIONS: usize = 16;
/// Samples around which such regions are. With fewer, the choice of samples moves the mean.
const SEEDS: usize = 64;
/// The emptiness above which gaps count as wider. Evenly sampled surfaces have 0.06 to 0.13. Errors
/// against ray-traced truth change little between 0.155 and 0.175.
const EMPTY: f64 = 1.0 / 6.0;
/// From this many times that emptiness on, the answer is the largest one: 2⁵.
const EMPTIEST: f64 = 2.0;
/// Things are far apart, and not one region, if the next sample is more than twice as far as those before it, by
/// squares. But that many are one.
const APART: f64 = 4.0;
const FEWEST: usize = 8;
/// A shell holds the squares of distances with equal exponents and first two bits. Squares have no sign.
const SHELL: u32 = 50;
const SHELLS: usize = 1 << (63 - SHELL);
/// The bits of a sample's number.
const NUMBER: u64 = SAMPLES as u64 - 1;

/// Sampled points with the spacing of each.
struct Samples<'a> {
    spacings: &'a [f64],
    /// Points with more than this spacing may be strays, which span nothing.
    longest: f64,
    /// In the longest spacing, from one of them: that keeps the detail of georeferenced clouds.
    places: Vec<DVec3>,
    /// Room for one number for each of them.
    keys: Vec<Keyed>,
}

/// How many times wider the gaps are, 1 at least: (6 × emptiness)⁵. The emptiness is what a region
/// spans ÷ the area for which its points stand, as a mean over the regions. Spacings count as the
/// `longest` one at most. `count` points were sampled.
pub(crate) fn widening(
    spacings: &[f64],
    longest: f64,
    count: usize,
    point: &dyn Fn(usize) -> [f64; 3],
) -> Result<f64, OutOfMemory> {
    let all = spacings.len();
    let mut samples = Samples::new(spacings, longest, point)?;
    let size = all / (all / REGIONS).clamp(1, REGIONS);
    let seeds = SEEDS.min(all);
    let weight = count as f64 / all as f64;
    let mut ratio = 0.0;
    for number in 0..seeds {
        let seed = (2 * number + 1) * all / (2 * seeds);
        let span = samples.span(seed, size);
        ratio += span.area / (EMPTY * weight * span.stands_for) / seeds as f64;
        if ratio >= EMPTIEST {
            ratio = EMPTIEST;
            break;
        }
    }
    // It is NaN where numbers overflow, and where there is no spacing.
    Ok(if ratio > 1.0 {
        let square = ratio * ratio;
        square * square * ratio
    } else {
        1.0
    })
}

/// A region. Areas are in squares of the longest spacing.
struct Span {
    /// The area that it spans, by its moments: the root of the sum of the principal minors
    /// of its covariance. For a rectangle it is a twelfth of its area.
    area: f64,
    /// The area for which its points stand.
    stands_for: f64,
}

impl<'a> Samples<'a> {
    fn new(
        spacings: &'a [f64],
        longest: f64,
        point: &dyn Fn(usize) -> [f64; 3],
    ) -> Result<Self, OutOfMemory> {
        let all = spacings.len();
        let place = |sample| DVec3::from_array(point(sample));
        let mut places = with_capacity(all)?;
        places.extend((0..all).map(|sample| (place(sample) - place(0)) / longest));
        Ok(Self {
            spacings,
            longest,
            places,
            keys: with_capacity(all)?,
        })
    }

    /// What the `size` samples span that are nearest to the sample `seed`, itself included, without things that are
    /// far apart.
    #[inline(never)]
    fn span(&mut self, seed: usize, size: usize) -> Span {
        let from = self.places[seed];
        // The square of the distance, by its bits, and in the last ones the sample's number: no two are equal.
        let key = |(sample, place): (usize, &DVec3)| {
            let bits = (*place - from).length_squared().to_bits();
            (bits & !NUMBER | sample as u64, sample as u32)
        };
        self.keys.clear();
        self.keys.extend(self.places.iter().enumerate().map(key));
        // Only shells around the seed that hold enough of them are sorted.
        let shell = |key: Keyed| (key.0 >> SHELL) as usize % SHELLS;
        let mut inside = [0u32; SHELLS];
        for &key in &self.keys {
            inside[shell(key)] += 1;
        }
        let mut held = 0;
        let mut last = 0;
        while held < size {
            held += inside[last] as usize;
            last += 1;
        }
        self.keys.retain(|&key| shell(key) < last);
        sort_keyed(&mut self.keys);
        let nearest = &self.keys[..size];
        let squared = |key: Keyed| f64::from_bits(key.0);
        let is_apart = |at: &usize| squared(nearest[*at]) > APART * squared(nearest[at - 1]);
        let end = (size.min(FEWEST)..size).find(is_apart).unwrap_or(size);
        let next = |v: DVec3| DVec3::new(v.y, v.z, v.x);
        let [mut sum, mut squares, mut products] = [DVec3::ZERO; 3];
        let [mut number, mut stands_for] = [0.0; 2];
        for &(_, sample) in &nearest[..end] {
            let sample = sample as usize;
            let side = self.spacings[sample] / self.longest;
            if side > 1.0 {
                stands_for += 1.0;
                continue;
            }
            stands_for += side * side;
            let v = self.places[sample] - from;
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
        let rims: Vec<[f64; 3]> = (0..REGIONS)
            .flat_map(|k| rim(7).into_iter().map(apart(k)))
            .collect();
        let one = widened(&rim(7), 0.25, 1.0);
        assert!((widened(&rims, 0.25, 1.0) / one - 1.0).abs() < 1e-6);
        assert_eq!(widened(&rim(7), 0.25, 0.9), 32.0);
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
        let mut samples = Samples::new(&spacings, 4.0, &two).unwrap();
        let area = 30.0 * 20.0 / 12.0 / 16.0;
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 0.01;
        for seed in [0, 599, 600, 700] {
            let span = samples.span(seed, 600);
            assert!(near(span.area, area) && near(span.stands_for, 150.0));
        }
        // Longer spacings than the longest stand for one square each, and their places do not count.
        let span = Samples::new(&spacings, 1.5, &two).unwrap().span(0, 600);
        assert_eq!([span.stands_for, span.area], [600.0, 0.0]);
    }
}
