//! How far the gaps are wider than the spacings tell, because the samples leave much of what they
//! span empty. The flat sides of a part have no points but at their rims. No distance to near
//! neighbors tells of such a gap. Thin things, like wires, are alike: what they hide lies near.
//!
//! The samples are halved across their longest axis until regions are left. What a region holds is taken apart
//! at its widest gaps. Both depend on distances alone, so a cloud that moves or turns has the same regions.

use alloc::vec::Vec;
use glam::{DMat3, DVec3};

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::real::square_root;
use crate::cloud::plane::{least_axis, outer_product};

/// How often the samples are halved, if there are enough of them.
const HALVINGS: usize = 4;
/// Samples in a region, at least.
const LEAST: usize = 16;
/// A region is cut so often in two, always at the widest gap.
const CUTS: usize = 3;
/// A region holds things that are far apart if its parts span less than this share of it. Then only
/// the parts count.
const APART: f64 = 1.0 / 6.0;
/// The emptiness above which gaps count as wider. Evenly sampled surfaces have 0.06 to 0.13. Errors
/// against ray-traced truth change little between 0.155 and 0.175.
const EMPTY: f64 = 1.0 / 6.0;
/// The largest answer.
const WIDEST: f64 = 32.0;

/// A sampled point. Lengths are in units of the longest spacing.
#[derive(Clone, Copy)]
struct Sampled {
    place: DVec3,
    /// Its spacing. Points with more than 1 may be strays, which span nothing.
    side: f64,
    /// How far it is from the points before it in its region.
    gap: f64,
}

/// How many times wider the gaps are, 1 at least: (6 × emptiness)⁵. The emptiness is what a region
/// spans ÷ the area for which its points stand, as a mean over the regions. Spacings count as the
/// `longest` one at most. `count` points were sampled. `point` gives a sampled point by its number.
pub(crate) fn widening(
    spacings: &[f64],
    longest: f64,
    count: usize,
    point: &dyn Fn(usize) -> [f64; 3],
) -> Result<f64, OutOfMemory> {
    let all = spacings.len();
    if all == 0 {
        return Ok(1.0);
    }
    // Places relative to one of them keep the detail of georeferenced clouds.
    let origin = DVec3::from_array(point(0));
    let mut samples: Vec<Sampled> = with_capacity(all)?;
    samples.extend(
        spacings
            .iter()
            .enumerate()
            .map(|(sample, spacing)| Sampled {
                place: (DVec3::from_array(point(sample)) - origin) / longest,
                side: spacing / longest,
                gap: 0.0,
            }),
    );
    let mut halvings = 0;
    while halvings < HALVINGS && all >> (halvings + 1) >= LEAST {
        halvings += 1;
    }
    let regions = f64::from(1 << halvings);
    let weight = count as f64 / all as f64;
    let ratio = emptiness(&mut samples, halvings) / (regions * weight * EMPTY);
    // It is NaN where numbers overflow, and where there is no spacing.
    Ok(if ratio > 1.0 {
        let square = ratio * ratio;
        (square * square * ratio).min(WIDEST)
    } else {
        1.0
    })
}

/// The sum of the emptiness of the regions into which the samples are halved.
fn emptiness(samples: &mut [Sampled], halvings: usize) -> f64 {
    if halvings > 0 {
        let axis = longest_axis(samples);
        samples
            .sort_unstable_by(|one, other| one.place.dot(axis).total_cmp(&other.place.dot(axis)));
        let (low, high) = samples.split_at_mut(samples.len() / 2);
        return emptiness(low, halvings - 1) + emptiness(high, halvings - 1);
    }
    let whole = span(samples);
    let connected = connect(samples);
    let parts = parts(&samples[..connected], CUTS);
    let spanned = if parts < APART * whole.area {
        parts
    } else {
        whole.area
    };
    spanned / whole.stands_for
}

/// The axis along which the samples vary most.
fn longest_axis(samples: &[Sampled]) -> DVec3 {
    let count = samples.len() as f64;
    let mean = samples
        .iter()
        .fold(DVec3::ZERO, |sum, sample| sum + sample.place)
        / count;
    let spread = samples.iter().fold(DMat3::ZERO, |sum, sample| {
        sum + outer_product(sample.place - mean)
    });
    let trace = spread.x_axis.x + spread.y_axis.y + spread.z_axis.z;
    // The same axes, in the other order.
    least_axis(DMat3::from_diagonal(DVec3::splat(trace)) - spread)
}

/// Brings the samples that are no strays to the front, each one followed by the nearest of those that
/// are left (Prim's tree). So the parts beside any gap are runs. Returns their number.
fn connect(samples: &mut [Sampled]) -> usize {
    let mut count = 0;
    for sample in 0..samples.len() {
        if samples[sample].side <= 1.0 {
            samples.swap(count, sample);
            count += 1;
        }
    }
    for sample in &mut samples[..count] {
        sample.gap = f64::INFINITY;
    }
    for next in 0..count.saturating_sub(1) {
        let place = samples[next].place;
        let mut nearest = next + 1;
        for other in next + 1..count {
            let gap = (samples[other].place - place).length_squared();
            if gap < samples[other].gap {
                samples[other].gap = gap;
            }
            if samples[other].gap < samples[nearest].gap {
                nearest = other;
            }
        }
        samples.swap(next + 1, nearest);
    }
    count
}

/// The area that the parts of a connected run span together.
fn parts(run: &[Sampled], cuts: usize) -> f64 {
    if cuts == 0 || run.len() < 2 {
        return span(run).area;
    }
    let mut cut = 1;
    for sample in 1..run.len() {
        if run[sample].gap > run[cut].gap {
            cut = sample;
        }
    }
    parts(&run[..cut], cuts - 1) + parts(&run[cut..], cuts - 1)
}

/// What samples span and stand for. Areas are in squares of the longest spacing.
struct Span {
    /// The area that they span, by their moments: the root of the sum of the principal minors
    /// of their covariance. For a rectangle it is a twelfth of its area.
    area: f64,
    /// The area for which they stand.
    stands_for: f64,
}

fn span(samples: &[Sampled]) -> Span {
    let next = |v: DVec3| DVec3::new(v.y, v.z, v.x);
    let origin = samples.first().map_or(DVec3::ZERO, |first| first.place);
    let [mut sum, mut squares, mut products] = [DVec3::ZERO; 3];
    let [mut number, mut stands_for] = [0.0; 2];
    for &Sampled { place, side, .. } in samples {
        if side > 1.0 {
            stands_for += 1.0;
            continue;
        }
        stands_for += side * side;
        let v = place - origin;
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

#[cfg(test)]
mod tests {
    use super::*;

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
        let rims: Vec<[f64; 3]> = (0..1 << HALVINGS)
            .flat_map(|k| rim(7).into_iter().map(apart(k)))
            .collect();
        let one = widened(&rim(7), 0.25, 1.0);
        assert!((widened(&rims, 0.25, 1.0) / one - 1.0).abs() < 1e-6);
        assert_eq!(widened(&rim(7), 0.25, 0.9), WIDEST);
    }

    #[test]
    fn parts_are_taken_apart_at_the_widest_gaps() {
        let points = rectangle(30, 20);
        let two =
            |k: usize| DVec3::from_array(points[k % 600]) + DVec3::Z * (1000 * (k / 600)) as f64;
        let sampled = |side: f64| -> Vec<Sampled> {
            let sample = |k: usize| Sampled {
                place: two(k * 7 % 1200),
                side,
                gap: 0.0,
            };
            (0..1200).map(sample).collect()
        };
        let area = 30.0 * 20.0 / 12.0;
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 0.01;
        let mut samples = sampled(0.5);
        assert!(near(span(&samples).stands_for, 300.0));
        assert_eq!(connect(&mut samples), 1200);
        assert!(near(span(&samples[..600]).area, area));
        assert!(near(parts(&samples, 1), 2.0 * area));
        // Longer spacings than the longest stand for one square each, and their places do not count.
        let mut strays = sampled(1.5);
        assert_eq!(span(&strays).stands_for, 1200.0);
        assert_eq!(span(&strays).area, 0.0);
        assert_eq!(connect(&mut strays), 0);
    }
}
