//! How far measured points lie off their surface, from an even sample of the points.
//!
//! The distance of 17 near points from a quadric comes from noise, from curvature and from edges.
//! Among 33 points the part of the curvature is larger. What does not grow is noise. A low
//! percentile over the sample leaves edges and corners out.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::FULL;
use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::real::{power_of_two_below, ramp, smaller, square_root};
use crate::base::sort::{Keyed, percentile};
use crate::cloud::neighbors::{Nearest, Neighbors};
use crate::cloud::plane::off_plane;
use crate::cloud::points::Points;
use crate::cloud::quadric::off_quadric;
use crate::cloud::sheets::{LOW, NEAR, PLACES, Sample, next_sheet, off_two_planes};
use crate::cloud::statistics::{Statistics, mean_distance};
use crate::cloud::surface;
use crate::cloud::surface::SAMPLES;

/// From the low percentile to the standard deviation of normal noise.
const TO_DEVIATION: f64 = 1.15;
/// A cloud is noisy if its noise is more than this, in spacings. Clean scans have up to 0.065, and
/// registered ones 0.13 and more. It is none if its rough places lie on two planes: if points are at most this share as far
/// off them as off one quadric. Clean sheets have 0, scanned surfaces and all kinds of noise 0.34 and more, scans without
/// noise that lie beside each other 0.13. Half of it counts if it is even and [alike](MEASURED), which the corners of clean meshes are not.
pub(crate) const NOISY: f64 = 0.075;
/// Rough surfaces, as of plants, grow by so much from the small to the large surroundings, at the
/// median place: by 1.32 to 1.58. Layers have 1.14 to 1.24, noise less.
const ROUGH: [f64; 2] = [1.24, 1.32];
/// Noise is even below the first ratio of a low to a very low percentile, and in layers above the second. Normal noise
/// gives 1.29, noisy objects at most 1.57, scans that overlap 1.89 and more.
const EVEN: [f64; 2] = [1.6, 1.9];
const VERY_LOW: usize = 5;
/// Points that lie off less than this, in spacings, are only rounded. Scanners give 0.007 and more.
const EXACT: f64 = 0.002;
/// Above half of this, the measured noise is too small: where noise is as large as the spacing, near points are
/// those of like noise. Measured on spheres with noise of 0.1 to 2 spacings.
const MOST: f64 = 0.53;

/// Neighbors of the two surroundings whose planes are compared.
const PLANES: [usize; 2] = [8, 24];
/// A surface is measured by a scanner if points are about as far off their planes in the small
/// surroundings as in the large ones, by this share. Curved surfaces without noise have 0.2 to 0.5.
const MEASURED: [f64; 2] = [0.5, 0.7];
/// The gap of one hull's radius is the median spacing ÷ this for a scan, and once more for overlapping
/// scans. For even noise it is ÷ (1 + this × its standard deviation in spacings). The gap of clean surfaces heeds
/// outliers and the sparse places of a scan.
const SCANNED: f64 = 2.0;

/// How a cloud's points lie about the surface that they sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Surface {
    /// On it.
    Clean,
    /// As far off it everywhere, as a sensor's noise is. The planes of neighbors remove it.
    Noisy,
    /// In layers, as registered scans are, or rough, as plants are: no neighbor tells which point is the
    /// surface.
    Layered,
}

impl Surface {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Clean, Self::Noisy, Self::Layered];

    /// Its name in other languages: clean, noisy or layered.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Clean => "clean",
            Self::Noisy => "noisy",
            Self::Layered => "layered",
        }
    }
}

/// What a sample tells of a cloud's noise.
pub(crate) struct Noise {
    /// Empty where the cloud has too few points.
    pub samples: Vec<Sample>,
    /// The mean spacing of the samples.
    pub spacing: f64,
    /// The median spacing of the samples.
    pub usual: f64,
    /// The noise in spacings, whether it is noise or not.
    pub ratio: f64,
    /// How far it is noisy and how far it is layered, from 0 to 1 together. A switch would change answers with the
    /// points that are sampled.
    pub shares: [f64; 2],
    /// How far the widening counts: less where points are off their quadrics everywhere alike, by more than roundings.
    wide: f64,
    /// How far it grows with the surroundings, as what is rough does, and layers do not.
    pub rough: f64,
    /// The noise beyond that of clean clouds, in the cloud's units.
    pub beyond_clean: f64,
    /// How far a surface counts as measured by a scanner.
    pub scanned: f64,
    /// What takes the place of the gap between samples where it does.
    gap: f64,
    /// The distance from a clean surface to the next one behind or before it; infinite where it is measured.
    pub next_sheet: f64,
}

impl Noise {
    /// Measures distinct points along the Hilbert curve, at the places of a sample.
    pub(crate) fn of(points: &Points, sample: &[u32]) -> Result<Self, OutOfMemory> {
        let neighbors = &Neighbors::new(points)?;
        let measured = Measured::of(points, neighbors, sample)?;
        let mut spacings = with_capacity(measured.samples.len())?;
        spacings.extend(measured.samples.iter().map(|sample| sample.spacing));
        let longest = surface::longest(&spacings)?;
        let usual = low(&spacings, 50)?;
        let cut = surface::cut_off(spacings, longest);
        let apart = ramp(measured.unevenness()?, EVEN);
        let [ratio, least, share] = measured.noise(points.len(), apart)?;
        let beyond = (ratio - least) * usual;
        let is_exact = low(&measured.ratios[0], LOW)? <= EXACT;
        let mut noise = Self {
            spacing: surface::mean(&cut),
            usual,
            ratio,
            shares: [(1.0 - apart) * share, apart * share],
            wide: if is_exact { 1.0 } else { apart },
            // The module of the operator alone has no looks.
            rough: if FULL { measured.rough()? } else { 0.0 },
            beyond_clean: if beyond > 0.0 && beyond.is_finite() {
                beyond
            } else {
                0.0
            },
            scanned: 0.0,
            gap: usual,
            next_sheet: f64::INFINITY,
            samples: Vec::new(),
        };
        let uneven = ramp(low(&cut, 90)? / usual, EVEN);
        let unevenly = uneven * measured.alike()?;
        noise.scanned = 1.0 - (1.0 - share) * (1.0 - unevenly);
        if noise.scanned > 0.0 {
            let [even, layered] = noise.shares;
            let of_noise = libm::pow(1.0 + SCANNED * deviation(ratio), even);
            noise.gap /= of_noise * libm::pow(SCANNED, 2.0 * layered + (1.0 - share) * unevenly);
        }
        if noise.scanned < 1.0 {
            let next = next_sheet(neighbors, &measured.samples, usual)?;
            noise.next_sheet = next / (1.0 - noise.scanned);
        }
        noise.samples = measured.samples;
        Ok(noise)
    }

    pub(crate) fn surface(&self) -> Surface {
        let [noisy, layered] = self.shares;
        if noisy + layered == 0.0 {
            Surface::Clean
        } else if noisy > layered {
            Surface::Noisy
        } else {
            Surface::Layered
        }
    }

    /// One standard deviation, in the cloud's units. It is 0 where nothing tells of noise.
    pub(crate) fn deviation(&self) -> f64 {
        match self.surface() {
            Surface::Clean => 0.0,
            Surface::Layered => self.ratio * self.usual,
            Surface::Noisy => deviation(self.ratio) * self.spacing,
        }
    }

    /// The gap of one hull's radius. `gap` is that of a clean surface.
    pub(crate) fn gap(&self, gap: f64) -> f64 {
        gap * libm::pow(smaller(self.gap / gap, 1.0), self.scanned)
    }

    /// How many times wider gaps count. Between the rings of a scanner there is surface, and it is seen from its station.
    /// Parts made of triangles are even nowhere: by 6 times and more.
    pub(crate) fn widening(&self, statistics: &Statistics) -> f64 {
        libm::pow(statistics.widening, self.wide)
    }
}

/// One standard deviation of even noise, in spacings.
fn deviation(ratio: f64) -> f64 {
    let share = ratio / MOST;
    let cube = share * share * share;
    ratio * (1.0 + cube * cube)
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
    /// The distances off the planes of [`PLANES`]: the small ÷ the large one.
    planes: Vec<f64>,
    /// At some of the rough places, how far points lie off two planes ÷ off the quadric.
    sheets: Vec<f64>,
}

impl Measured {
    #[inline(never)]
    fn of(points: &Points, neighbors: &Neighbors, sample: &[u32]) -> Result<Self, OutOfMemory> {
        let is_enough = points.len() >= SAMPLES;
        let sample = if is_enough { sample } else { &[] };
        let count = sample.len();
        let mut samples: Vec<Sample> = with_capacity(count)?;
        let mut ratios = [with_capacity(count)?, with_capacity(count)?];
        let mut lengths: Vec<f64> = with_capacity(count)?;
        let mut planes = with_capacity(count)?;
        let [_, most] = NEAR;
        let mut places: Vec<DVec3> = with_capacity(most + 1)?;
        let mut nearest = Nearest::with_capacity(most)?;
        let mut sheets = with_capacity(PLACES)?;
        let mut order: Vec<Keyed> = filled(most + 1, (0, 0))?;
        for &query in sample {
            let query = query as usize;
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
            // Where points are in one plane but for roundings, these tell nothing.
            planes.push(if far > EXACT * size { near / far } else { 0.0 });
            let [small_off, large_off] = [&small, &large].map(|off| off.deviation / size);
            ratios[0].push(small_off);
            ratios[1].push(large_off);
            let noise = constant(small_off, large_off);
            if noise > NOISY && samples.len() % (SAMPLES / PLACES) == 0 {
                let share = off_two_planes(&places, large.normal, &mut order) / large.deviation;
                // NaN where all points are on the quadric.
                if share >= 0.0 {
                    sheets.push(share);
                }
            }
            samples.push(Sample {
                noise,
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
            sheets,
        })
    }

    /// The noise in spacings, what counts as none, and how far the rest counts. A sensor's noise is the same everywhere.
    /// Registered scans lie beside each other only where they overlap, and what is rough is so in places: there the
    /// median counts. `apart` is how far they are in layers.
    fn noise(&self, count: usize, apart: f64) -> Result<[f64; 3], OutOfMemory> {
        let [small, large] = &self.ratios;
        let everywhere = TO_DEVIATION * constant(low(small, LOW)?, low(large, LOW)?);
        let mut constants = with_capacity(self.samples.len())?;
        constants.extend(self.samples.iter().map(|sample| sample.noise));
        let in_places = TO_DEVIATION * low(&constants, 50)?;
        // Clouds of few points on curved bodies have more at their edges.
        let leasts = [
            1.0 - 0.5 * self.alike()?,
            1.0 + SAMPLES as f64 / count as f64,
        ];
        let between = |[even, layered]: [f64; 2]| even * (1.0 - apart) + layered * apart;
        let ratio = between([everywhere, in_places]);
        let least = NOISY * between(leasts);
        let are_sheets = percentile(&self.sheets, LOW)?.is_some_and(|share| share <= NOISY);
        let is_clean = are_sheets || !ratio.is_finite();
        let share = if is_clean {
            0.0
        } else {
            ramp(ratio, [least, 2.0 * least])
        };
        Ok([ratio, least, share])
    }

    /// How far points are farther off their quadrics in large surroundings than layers are.
    fn rough(&self) -> Result<f64, OutOfMemory> {
        let [small, large] = &self.ratios;
        let mut growth = with_capacity(small.len())?;
        growth.extend(small.iter().zip(large).map(|(small, large)| large / small));
        Ok(ramp(low(&growth, 50)?, ROUGH))
    }

    /// How far points are about as far off their planes in small surroundings as in large ones.
    fn alike(&self) -> Result<f64, OutOfMemory> {
        Ok(ramp(low(&self.planes, 50)?, MEASURED))
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
