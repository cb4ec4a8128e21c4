//! How far measured points lie off their surface, from an even sample of the points.
//!
//! The distance of 17 near points from a quadric comes from noise, from curvature and from edges.
//! Among 33 points the part of the curvature is larger. What does not grow is noise. A low
//! percentile over the sample leaves edges and corners out.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::real::{power_of_two_below, square_root};
use crate::base::sort::percentile;
use crate::cloud::neighbors::{Nearest, Neighbors};
use crate::cloud::plane::off_plane;
use crate::cloud::points::Points;
use crate::cloud::quadric::off_quadric;
use crate::cloud::sheets::{are_sheets, next_sheet};
use crate::cloud::statistics::{mean_distance, sampled_place};
use crate::cloud::surface;

/// Clouds with fewer points tell nothing.
const FEWEST: usize = 2000;
/// How many points are measured at most.
const SAMPLES: usize = 2048;
/// Neighbors of the small and the large surroundings of a point.
const NEAR: [usize; 2] = [16, 32];
/// The percentile of the distances off the quadric.
const LOW: usize = 25;
/// From the low percentile to the standard deviation of normal noise.
const TO_DEVIATION: f64 = 1.15;
/// Where scans overlap in half of a cloud, the low percentile may have no noise. This share of the
/// median noise of single places counts, too. Clean clouds have at most 0.1, such scans 0.33.
const WHERE_LAYERED: f64 = 0.4;
/// A cloud is noisy if its noise is more than this, in spacings. Clean scans have up to 0.065, and
/// registered ones 0.13 and more.
const NOISY: f64 = 0.075;
/// Less noise counts if it is even and [alike](MEASURED). The corners of clean meshes are not. This share of the noise never counts.
const CLEAN: f64 = 0.04;
/// Noise is even if this ratio of a low to a very low percentile is not reached. Normal noise gives
/// 1.29, noisy objects at most 1.57, scans that overlap 2.0 and more.
const EVEN: f64 = 1.8;
const VERY_LOW: usize = 5;
/// The measured noise comes nowhere near this, however large the noise is. Above 0.25 it is too small,
/// as measured on spheres with noise of 0.1 to 2 spacings.
const MOST: f64 = 0.56;
const LEAST_LEFT: f64 = 0.2;
/// Evenness is also measured on one point in so many, if this leaves at least [`LEFT`] points.
const THINNED: usize = 10;
const LEFT: usize = 3000;

/// Neighbors of the two surroundings whose planes are compared.
const PLANES: [usize; 2] = [8, 24];
/// A surface is measured by a scanner if points are about as far off their planes in the small
/// surroundings as in the large ones, by this share, and at least so far, in spacings. Curved
/// surfaces without noise have 0.2 to 0.5.
const MEASURED: f64 = 0.6;
const LEAST_OFF: f64 = 0.008;
/// Its samples are uneven if one spacing in ten is this many times the median.
const SPREAD: f64 = 1.8;
/// The gap of one hull's radius is the median spacing, divided by this: for scans, for overlapping
/// scans, and for even noise by its standard deviation in spacings. The gap of clean surfaces heeds
/// outliers and the sparse places of a scan.
const SCANNED: f64 = 2.0;
const OVERLAPPING: f64 = 4.0;
const BY_NOISE: f64 = 1.5;

/// A measured point.
pub(crate) struct Sample {
    pub point: u32,
    pub place: [f64; 3],
    /// The normal of the plane of its 16 nearest points, of either sign.
    pub normal: DVec3,
    /// The mean distance to its 6 nearest points.
    pub spacing: f64,
    /// What does not grow of the distances off the quadrics, in spacings.
    pub noise: f64,
}

/// What a sample tells of a cloud's noise.
pub(crate) struct Noise {
    /// Empty where the cloud has too few points.
    pub samples: Vec<Sample>,
    /// The mean spacing of the samples.
    pub spacing: f64,
    /// The noise in spacings, whether it is noise or not.
    pub ratio: f64,
    /// What the noise of a noisy cloud has beyond that of clean ones, in the cloud's units; else 0.
    pub excess: f64,
    /// Whether a noisy cloud has the same noise everywhere.
    pub is_even: bool,
    /// Whether points are about as far off their planes in small surroundings as in large ones.
    pub is_alike: bool,
    /// What takes the place of the gap between samples where a surface was measured by a scanner.
    pub gap: Option<f64>,
    /// The median spacing of the samples.
    pub usual: f64,
    /// The distance from a clean surface to the next one behind or before it; else infinite.
    pub next_sheet: f64,
}

impl Noise {
    /// Measures distinct points along the Hilbert curve.
    pub(crate) fn of(points: &Points) -> Result<Self, OutOfMemory> {
        let neighbors = &Neighbors::new(points)?;
        let measured = Measured::of(points, neighbors)?;
        let mut spacings = with_capacity(measured.samples.len())?;
        spacings.extend(measured.samples.iter().map(|sample| sample.spacing));
        let longest = surface::longest(&spacings)?;
        let median = low(&spacings, 50)?;
        let cut = surface::cut_off(spacings, longest);
        let spacing = surface::mean(&cut);
        let [small, large] = &measured.ratios;
        let common = constant(low(small, LOW)?, low(large, LOW)?);
        let mut constants = with_capacity(small.len())?;
        constants.extend(measured.samples.iter().map(|sample| sample.noise));
        let mut noise = Self {
            spacing,
            ratio: (TO_DEVIATION * common).max(WHERE_LAYERED * low(&constants, 50)?),
            excess: 0.0,
            is_even: false,
            is_alike: low(&measured.planes[0], 50)? >= MEASURED,
            gap: None,
            usual: median,
            next_sheet: f64::INFINITY,
            samples: Vec::new(),
        };
        let is_measured = noise.is_alike && low(&measured.planes[1], 50)? >= LEAST_OFF;
        let is_uneven = low(&cut, 90)? >= SPREAD * median;
        let mut looser = if is_measured && is_uneven {
            SCANNED
        } else {
            1.0
        };
        let is_large = noise.ratio > NOISY;
        if noise.ratio > CLEAN
            && (is_large || noise.is_alike)
            && noise.ratio * spacing < f64::INFINITY
        {
            let is_even = measured.is_even(points)?;
            // The two sides of a thin sheet are no noise.
            let is_noise =
                (is_large || is_even) && !are_sheets(points, neighbors, &measured.samples, NOISY)?;
            if is_noise {
                noise.is_even = is_even;
                noise.excess = (noise.ratio - CLEAN) * spacing;
            }
            if is_noise && is_large {
                looser = if is_even {
                    1.0 + BY_NOISE * noise.deviation() / spacing
                } else {
                    OVERLAPPING
                };
            }
        }
        noise.gap = Some(median / looser).filter(|_| looser > 1.0);
        if noise.excess == 0.0 && noise.gap.is_none() {
            noise.next_sheet = next_sheet(neighbors, &measured.samples, median)?;
        }
        noise.samples = measured.samples;
        Ok(noise)
    }

    /// One standard deviation, in the cloud's units. It is 0 where nothing tells of noise.
    pub(crate) fn deviation(&self) -> f64 {
        if self.excess == 0.0 {
            return 0.0;
        }
        // Where noise is as large as the spacing, near points are those of like noise.
        let share = self.ratio / MOST;
        let share = share * share;
        let lost = (1.0 - share * share).max(LEAST_LEFT);
        self.ratio / square_root(lost) * self.spacing
    }

    /// The standard deviation beyond that of clean clouds, in the cloud's units.
    pub(crate) fn beyond_clean(&self) -> f64 {
        (self.deviation() - CLEAN * self.spacing).max(0.0)
    }
}

/// What does not grow of the distances off the quadric: q² = noise² + curvature·k, for k and 2k
/// neighbors.
fn constant(small: f64, large: f64) -> f64 {
    square_root(((4.0 * small * small - large * large) / 3.0).max(0.0))
}

fn low(numbers: &[f64], percent: usize) -> Result<f64, OutOfMemory> {
    Ok(percentile(numbers, percent)?.unwrap_or(0.0))
}

/// The samples, and their distances off the quadrics.
struct Measured {
    samples: Vec<Sample>,
    /// In spacings of each sample, for the small and the large surroundings.
    ratios: [Vec<f64>; 2],
    /// In the cloud's units, for the small surroundings.
    lengths: Vec<f64>,
    /// The distances off the planes of [`PLANES`]: the small ÷ the large one, and the small one in
    /// spacings.
    planes: [Vec<f64>; 2],
}

impl Measured {
    #[inline(never)]
    fn of(points: &Points, neighbors: &Neighbors) -> Result<Self, OutOfMemory> {
        let n = points.len();
        let count = if n < FEWEST { 0 } else { n.min(SAMPLES) };
        let mut samples: Vec<Sample> = with_capacity(count)?;
        let mut ratios = [with_capacity(count)?, with_capacity(count)?];
        let mut lengths: Vec<f64> = with_capacity(count)?;
        let mut planes = [with_capacity(count)?, with_capacity(count)?];
        let [_, most] = NEAR;
        let mut places: Vec<DVec3> = with_capacity(most + 1)?;
        let mut nearest = Nearest::with_capacity(most)?;
        for sample in 0..count {
            let query = sampled_place(sample, count, n);
            neighbors.find(query, &mut nearest);
            let found = nearest.found();
            let place = points.get(query);
            let spacing = mean_distance(found, None);
            // In this unit nothing overflows, and no power of two of the cloud's unit rounds.
            let farthest = found.last().map_or(0.0, |last| last.squared);
            let unit = power_of_two_below((1.0 / square_root(farthest)).min(f64::MAX));
            if !(spacing > 0.0 && farthest < f64::INFINITY) {
                continue;
            }
            places.clear();
            places.push(DVec3::ZERO);
            places.extend(found.iter().map(|other| {
                let other = DVec3::from_array(points.get(other.index as usize));
                (other - DVec3::from_array(place)) * unit
            }));
            let small = off_quadric(&places[..=NEAR[0]]);
            let large = off_quadric(&places);
            let size = spacing * unit;
            lengths.push(small.deviation / unit);
            let normal = small.normal;
            let [near, far] = PLANES.map(|count| off_plane(&places[..=count]));
            planes[0].push(near / far);
            planes[1].push(near / size);
            let [small_off, large_off] = [small, large].map(|off| off.deviation / size);
            ratios[0].push(small_off);
            ratios[1].push(large_off);
            samples.push(Sample {
                noise: constant(small_off, large_off),
                point: query as u32,
                place,
                normal,
                spacing,
            });
        }
        Ok(Self {
            samples,
            ratios,
            lengths,
            planes,
        })
    }

    /// Whether the noise of these points is the same everywhere, as that of a sensor is. Registered
    /// scans lie beside each other only where they overlap.
    fn is_even(&self, points: &Points) -> Result<bool, OutOfMemory> {
        let mut unevenness = self.unevenness()?;
        // Where noise is as large as the spacing, neighborhoods are round. Fewer points show layers.
        let step = (points.len() / LEFT).min(THINNED);
        if step > 1 {
            let mut places = with_capacity(points.len() / step + 1)?;
            places.extend((0..points.len() as u32).step_by(step));
            let thinned = {
                let points = points.gathered(&places)?;
                Self::of(&points, &Neighbors::new(&points)?)?.unevenness()?
            };
            unevenness = unevenness.max(thinned);
        }
        Ok(unevenness < EVEN)
    }

    /// The low percentile of the distances ÷ the very low one, in spacings or in units, whichever
    /// is more even.
    fn unevenness(&self) -> Result<f64, OutOfMemory> {
        let mut least = f64::INFINITY;
        for numbers in [&self.ratios[0], &self.lengths] {
            least = least.min(low(numbers, LOW)? / low(numbers, VERY_LOW)?);
        }
        Ok(least)
    }
}
