//! View-independent statistics of a cloud: its centroid, its spacing, and its surface.
//!
//! All sums run over the distinct points in their canonical order (see
//! `spatial`), so permuting or duplicating the input changes no bit.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::real::{power_of_two_below, square_root};
use crate::base::sort::{Keyed, sort_by_numbers};
use crate::cloud::neighbors::{Nearest, Neighbor, Neighbors};
use crate::cloud::points::Points;
use crate::cloud::spatial::Bounds;
use crate::cloud::surface::SAMPLES;
use crate::cloud::{filling, surface};

/// The spacing of a point is its mean distance from this many nearest points.
pub(crate) const NEIGHBORS: usize = 6;
/// How many shells around the centroid are told apart before any point is sorted.
const SHELLS: usize = 1 << 15;

/// The statistics from which the automatic radius is computed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Statistics {
    /// Distinct finite points.
    pub count: usize,
    /// Mean of the distinct points.
    pub centroid: [f64; 3],
    /// Mean distance to the 6 nearest other points (to all others where there
    /// are fewer), averaged over an even sample; 0 below two points.
    pub spacing: f64,
    /// How many times wider gaps are than the spacings tell, see [`filling::widening`]; 0 without
    /// points.
    pub widening: f64,
    /// The gap of the sampled spacings, see [`surface::gap`]; 0 below two points.
    pub gap: f64,
    /// The mean place of the surface: the sampled points, weighted by the area for which each
    /// stands.
    pub middle: [f64; 3],
    /// Mean squared distance of the surface from its middle.
    pub variance: f64,
}

impl Statistics {
    /// Measures `points`, distinct, finite, and along the Hilbert curve, at a sample of them.
    pub(crate) fn measure(
        points: &Points,
        bounds: &Bounds,
        Sampled { centroid, places }: &Sampled,
    ) -> Result<Self, OutOfMemory> {
        let n = points.len();
        if n == 0 {
            return Ok(Self::default());
        }
        let spacings = sampled_spacings(points, places)?;
        let spacing = surface::mean(&spacings);
        let longest = surface::longest(&spacings)?;
        let point = |number: usize| points.get(places[number] as usize);
        // The points of clouds of two dimensions are on curves, which fill nothing. Clouds in a plane
        // x = const or y = const are like those in a plane z = const.
        let is_flat = (0..3).any(|axis| bounds.min[axis] >= bounds.max[axis]);
        let widening = if is_flat {
            1.0
        } else {
            filling::widening(&spacings, longest, n, &point)?
        };
        let spacings = surface::cut_off(spacings, longest);
        let gap = surface::gap(&spacings);
        let areas = surface::into_areas(spacings);
        let axes: [[f64; 2]; 3] =
            core::array::from_fn(|axis| surface::moments(&areas, &|number| point(number)[axis]));
        // A sample that lies off the cloud's centroid lies as far off the middle.
        let off = places.iter().fold(DVec3::ZERO, |off, &place| {
            off + (DVec3::from_array(points.get(place as usize)) - DVec3::from_array(*centroid))
        });
        Ok(Self {
            count: n,
            centroid: *centroid,
            spacing,
            widening,
            gap,
            middle: core::array::from_fn(|axis| axes[axis][0] - off[axis] / places.len() as f64),
            variance: axes.iter().map(|[_, variance]| variance).sum(),
        })
    }
}

/// The mean of the points. Sums relative to a corner of the box keep the detail of georeferenced clouds.
fn centroid(points: &Points, bounds: &Bounds) -> [f64; 3] {
    let corner = bounds.min;
    let mut sum = [0.0; 3];
    for p in points.iter() {
        for axis in 0..3 {
            sum[axis] += p[axis] - corner[axis];
        }
    }
    core::array::from_fn(|axis| corner[axis] + sum[axis] / points.len() as f64)
}

/// The mean distances of sampled points from their nearest other points. Empty below two points.
fn sampled_spacings(points: &Points, sample: &[u32]) -> Result<Vec<f64>, OutOfMemory> {
    if points.len() < 2 {
        return Ok(Vec::new());
    }
    let neighbors = Neighbors::new(points)?;
    let mut nearest = Nearest::with_capacity(NEIGHBORS)?;
    let mut spacings = with_capacity(sample.len())?;
    for &place in sample {
        neighbors.find(place as usize, &mut nearest);
        spacings.push(mean_distance(nearest.found(), None));
    }
    Ok(spacings)
}

/// The centroid of a cloud, and the places of at most [`SAMPLES`] points, in the order of their distance from
/// a [`corner`]: the middle of each of so many even runs. So it does not matter where the cloud lies, and how it is turned.
pub(crate) struct Sampled {
    centroid: [f64; 3],
    pub places: Vec<u32>,
}

/// A place that follows from the cloud alone, away from its symmetries. From the centroid, the corners of a turned part
/// are equally far, and roundings would choose among them. It is half way to the farthest point, then a quarter of the
/// way beside that axis and an eighth above that plane. Where points are equally far by a symmetry, any of them will do: the
/// samples are alike but for it. No point is farther from it than the second number.
fn corner(points: &Points, vector: impl Fn([f64; 3]) -> DVec3) -> (DVec3, f64) {
    let [mut parts, mut units] = [[DVec3::ZERO; 3]; 2];
    for axis in 0..3 {
        let (mut most, first) = (0.0, parts[0]);
        for v in points.iter().map(&vector) {
            let rest = units
                .iter()
                .take(axis)
                .fold(v, |rest, &unit| rest - unit * v.dot(unit));
            let fit = rest.length_squared() * (v - first).length_squared();
            if fit > most {
                (most, parts[axis]) = (fit, rest);
            }
        }
        units[axis] = parts[axis].normalize_or_zero();
    }
    let corner = parts[0] / 2.0 + parts[1] / 4.0 + parts[2] / 8.0;
    (corner, parts[0].length() + corner.length())
}

pub(crate) fn sample_of(points: &Points, bounds: &Bounds) -> Result<Sampled, OutOfMemory> {
    let n = points.len();
    let count = n.min(SAMPLES);
    let mut places: Vec<u32> = with_capacity(count)?;
    let center = centroid(points, bounds);
    if n == 0 {
        return Ok(Sampled {
            centroid: center,
            places,
        });
    }
    // In this unit no square overflows.
    let unit = power_of_two_below((1.0 / bounds.diagonal()).min(f64::MAX));
    let vector = |p: [f64; 3]| (DVec3::from_array(p) - DVec3::from_array(center)) * unit;
    let (corner, farthest) = corner(points, vector);
    let squared = |p: [f64; 3]| (vector(p) - corner).length_squared();
    // Only the shells that hold a wanted point are sorted.
    let scale = SHELLS as f64 / (farthest * farthest);
    let shell = |p: [f64; 3]| ((squared(p) * scale) as usize).min(SHELLS - 1);
    let mut inside = filled(SHELLS + 1, 0u32)?;
    for p in points.iter() {
        inside[shell(p) + 1] += 1;
    }
    for shell in 0..SHELLS {
        inside[shell + 1] += inside[shell];
    }
    let wanted = |number: usize| ((2 * number as u64 + 1) * n as u64 / (2 * count as u64)) as u32;
    let mut is_wanted = filled(SHELLS, false)?;
    let mut held = 0;
    for number in 0..count {
        let shell = inside.partition_point(|&before| before <= wanted(number)) - 1;
        if !is_wanted[shell] {
            is_wanted[shell] = true;
            held += inside[shell + 1] - inside[shell];
        }
    }
    let mut members: Vec<Keyed> = with_capacity(held as usize)?;
    for (place, p) in points.iter().enumerate() {
        if is_wanted[shell(p)] {
            members.push((squared(p).to_bits(), place as u32));
        }
    }
    sort_by_numbers(&mut members, 2, &|_, place| u64::from(place));
    // How many of the members lie before the shell of the next wanted point.
    let mut before = 0;
    let mut last = 0;
    for number in 0..count {
        let rank = wanted(number);
        let shell = inside.partition_point(|&before| before <= rank) - 1;
        while last < shell {
            if is_wanted[last] {
                before += inside[last + 1] - inside[last];
            }
            last += 1;
        }
        places.push(members[(before + rank - inside[shell]) as usize].1);
    }
    Ok(Sampled {
        centroid: center,
        places,
    })
}

/// The mean distance to the `found` points, nearest first, and to one `added` point, whose squared
/// distance is given. At most [`NEIGHBORS`] count.
#[inline(never)]
pub(crate) fn mean_distance(found: &[Neighbor], added: Option<f64>) -> f64 {
    let count = (found.len() + usize::from(added.is_some())).min(NEIGHBORS);
    let added = added.unwrap_or(f64::INFINITY);
    let mut distances = 0.0;
    let mut shift = 0;
    for k in 0..count {
        let squared = found.get(k - shift).map_or(added, |next| next.squared);
        if shift == 0 && added < squared {
            shift = 1;
            distances += square_root(added);
        } else {
            distances += square_root(squared);
        }
    }
    distances / count as f64
}
