//! How a view takes its looks: by the noise of the cloud, and by how its spacing grows with range.
//!
//! Where there is neither, nothing changes. A scan's spacing grows with range, as seen from the
//! scanner. Then the scale c of a hull grows in the same way, and the hull is looser.
//!
//! With noise a visible point may lie behind its neighbors, up to a thickness T. It stays on the
//! hull if it is less than x²/2c behind points that are x beside it. Where rays graze the surface,
//! noise is longer along a ray, and samples are nearer to each other across it. So hulls are
//! looser, by more than the cube of the cosine.

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::looks::rays::{Projection, Ray, Rays};
use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::real::{larger, ramp, square_root};
use crate::base::sort::percentile;
use crate::cloud::blocks::FANOUT;
use crate::cloud::noise::Noise;
use crate::cloud::point_cloud::{PointCloud, Survey};
use crate::cloud::points::Points;
use crate::cloud::spatial::Bounds;
use crate::cloud::statistics::Statistics;
use crate::cloud::surface::SAMPLES;
use crate::flip::kernel::Kernel;

/// The scale c of each look as a share of the cloud's spacing × widening, from tight to loose. Two
/// looks leave out the middle one. Twice or half of any of these values changes the error little. A vertex of a hull is
/// visible only if c is at least the last share of the spacing of those beside it.
pub(super) const SHARES: [f64; 3] = [0.28, 0.07, 0.02];
/// The thickness of layers in standard deviations beyond what clean clouds have. Errors on registered scans
/// change little between 8 and 16.
const LAYERS: f64 = 14.0;
/// Spacing grows with range if its power, times what that explains, is above this; clean surfaces
/// have 0.1 from inside. It has its full effect from the second number on. The widening of a scan in
/// rings is about 20, so hulls are 50 times looser then. The effect grows with the square of the way
/// between, here and in [`AWAY`]: labels change most where it begins.
const GROWS: [f64; 2] = [0.12, 0.3];
/// A scan that is seen from its scanner has near points side by side: in at most this share of all
/// directions, the nearest point by direction is more than so many spacings away. From the first
/// number on, the viewpoint is not at the scanner.
const AWAY: [f64; 2] = [0.5, 0.05];
const NEAR: f64 = 10.0;
/// How much looser hulls are with a thickness. Points that were moved lie so near their surface that hulls may have
/// vertices behind it: the widest ring of a vertex shrinks by as much.
const LOOSER: f64 = 0.5;
/// By how many powers of two hulls are looser with range.
const LOOSER_BY_RANGE: f64 = 4.0;
/// The power of the cosine with which hulls are looser where rays graze the surface.
const COSINE_POWER: f64 = 3.5;

/// A triangle of a hull may be surface if its longest edge is at most this many local spacings.
pub(super) const LEAST: f64 = 4.0;

/// The numbers of one view, in the cloud's units.
#[derive(Clone, Copy)]
pub(super) struct Tuning {
    /// The scale c of each of the three looks; at the farthest distance if it grows.
    pub scales: [f64; 3],
    /// The power by which spacing grows with range.
    pub growth: f64,
    /// By how much the widest ring of a vertex shrinks.
    pub ring: f64,
    /// The largest local spacing of a vertex.
    pub widest: f64,
    /// How far the widening and the length of long triangles count, from 0 to 1.
    pub wide: f64,
    /// How far behind a surface a point may be besides what its triangles allow.
    pub thickness: f64,
    /// Half the distance to the next sheet: how far behind a surface a point may be at most, besides the thickness.
    pub behind: f64,
    /// What scores become.
    pub odds: Odds,
}

impl Tuning {
    pub(super) fn of(
        projection: Projection,
        cloud: &PointCloud,
        survey: Option<&Survey>,
        given: Option<f64>,
        farthest: f64,
    ) -> Result<Self, OutOfMemory> {
        let statistics = &cloud.statistics()?;
        let Some(survey) = survey else {
            return Ok(Self::plain(statistics, &*cloud.known_noise()?));
        };
        let measured: &Noise = &survey.noise;
        // Moved points have their own noise.
        let noise = survey
            .smooth
            .as_ref()
            .map_or(measured, |smooth| &smooth.noise);
        let [moved, layered] = survey.shares;
        let range = match projection {
            Projection::Perspective(viewpoint) => Some(Range {
                noise,
                viewpoint,
                farthest,
            }),
            Projection::Parallel(_) => None,
        };
        let (growth, ranged) = match &range {
            Some(range) => range.growth(&cloud.sequence.points)?,
            None => (0.0, 0.0),
        };
        // What is rough shows its depth only from where it was measured.
        let counts = 1.0 - measured.rough * (1.0 - ranged);
        // Squared, as points that also move are less far off.
        let of_layers = LAYERS * counts * layered * layered * measured.beyond_clean;
        let thickness = given.unwrap_or(of_layers);
        let is_given = given.is_some_and(|given| given > 0.0);
        let [thick, scanned] =
            [layered, measured.scanned].map(|share| if is_given { 1.0 } else { share });
        let left = scanned * (1.0 - thickness / statistics.spacing / LAYERS).max(0.0);
        let odds = Odds::of(moved, measured.ratio, left, scanned, growth);
        let mut ring = libm::pow(2.0, -LOOSER_BY_RANGE * growth);
        let mut looser = ring;
        if thick > 0.0 {
            let cosine = cosine(noise, projection)?;
            ring *= libm::pow((2.0 * cosine).min(1.0), COSINE_POWER * thick);
            looser = libm::pow(LOOSER, thick) * ring;
        }
        let wide = (1.0 - thick) * (1.0 - ranged);
        let mut gap = statistics.spacing * libm::pow(noise.widening(statistics), wide);
        gap = larger(gap, gap_of_sheets(noise));
        if growth > 0.0
            && let Some(range) = range
        {
            // The mean of all local scales is that of a cloud that does not grow.
            gap /= range.mean_power(growth);
        }
        Ok(Self {
            scales: scales(gap, looser),
            growth,
            ring: ring * libm::pow(LOOSER, -moved),
            // Strays in front of a surface have larger ones, and the triangles between them are none.
            widest: LEAST * statistics.spacing / (moved + thick).min(1.0),
            wide,
            thickness,
            behind: 0.5 * noise.next_sheet,
            odds,
        })
    }

    /// The kernel of a look with this scale.
    pub(super) fn kernel(&self, scale: f64, farthest: f64) -> Kernel {
        if self.growth > 0.0 {
            let power = self.growth;
            Kernel::Growing {
                scale,
                farthest,
                power,
            }
        } else {
            Kernel::Exponential { scale }
        }
    }

    pub(super) fn plain(statistics: &Statistics, noise: &Noise) -> Self {
        // Where samples leave much empty, gaps are wider than the spacing.
        let gap = statistics.spacing * noise.widening(statistics);
        let gap = larger(gap, gap_of_sheets(noise));
        Self {
            scales: scales(gap, 1.0),
            growth: 0.0,
            ring: 1.0,
            widest: f64::INFINITY,
            wide: 1.0,
            thickness: 0.0,
            behind: 0.5 * noise.next_sheet,
            odds: Odds::of(0.0, 0.0, 0.0, 0.0, 0.0),
        }
    }
}

/// The gap at which the tight look hides what lies as far behind a clean surface as the next sheet:
/// c > s²/2d, as R < d·r²/s².
fn gap_of_sheets(noise: &Noise) -> f64 {
    let [tight, ..] = SHARES;
    noise.usual * noise.usual / (2.0 * tight * noise.next_sheet)
}

fn scales(gap: f64, looser: f64) -> [f64; 3] {
    // Without a spacing there is one point at most, and any scale gives the same answer.
    let gap = if gap > 0.0 { gap } else { 1.0 };
    SHARES.map(|share| (share * gap * looser).clamp(f64::MIN_POSITIVE, f64::MAX))
}

/// The samples as they are seen from a viewpoint.
struct Range<'a> {
    noise: &'a Noise,
    viewpoint: [f64; 3],
    farthest: f64,
}

impl Range<'_> {
    /// A place relative to the viewpoint, in units of the farthest distance.
    fn place(&self, point: [f64; 3]) -> DVec3 {
        (DVec3::from_array(point) - DVec3::from_array(self.viewpoint)) / self.farthest
    }

    fn distances(&self) -> impl Iterator<Item = f64> {
        let places = self.noise.samples.iter().map(|sample| sample.place);
        places.map(|place| square_root(self.place(place).length_squared()))
    }

    /// The power of the distance with which spacing grows, and how far this counts, from 0 to 1.
    fn growth(&self, points: &Points) -> Result<(f64, f64), OutOfMemory> {
        let growth = self.correlated_growth();
        let mut counts = ramp(growth, GROWS);
        if counts > 0.0 {
            counts *= ramp(self.share_away(points)?, AWAY);
        }
        counts *= counts;
        Ok((growth * counts, counts))
    }

    /// The power of the distance with which spacing grows, at most 1, times the share of the
    /// variance of its logarithm that this explains.
    fn correlated_growth(&self) -> f64 {
        let [mut n, mut x, mut y, mut xx, mut xy, mut yy] = [0.0; 6];
        for (sample, distance) in self.noise.samples.iter().zip(self.distances()) {
            if distance > 0.0 {
                let a = libm::log(distance);
                let b = libm::log(sample.spacing / self.noise.spacing);
                n += 1.0;
                x += a;
                y += b;
                xx += a * a;
                xy += a * b;
                yy += b * b;
            }
        }
        let [varied, together, other] = [n * xx - x * x, n * xy - x * y, n * yy - y * y];
        let power = (together / varied).min(1.0);
        let growth = power * (power * (2.0 * together - power * varied) / other);
        // NaN where all are alike.
        if growth > 0.0 { growth } else { 0.0 }
    }

    /// The share of the samples whose nearest point by direction is elsewhere. Of a large cloud, an even part is looked
    /// through.
    fn share_away(&self, points: &Points) -> Result<f64, OutOfMemory> {
        let step = (points.len() / (64 * SAMPLES)).max(1);
        let sparser = square_root(step as f64);
        let mut rays = with_capacity(points.len().div_ceil(step))?;
        let places = points.iter().enumerate().step_by(step);
        rays.extend(places.map(|(point, place)| Ray::to(self.place(place), None, point)));
        let rays = Rays::of(rays)?;
        let mut away = 0;
        let mut runs = Vec::new();
        for sample in &self.noise.samples {
            let place = self.place(sample.place);
            let own = Ray::to(place, None, sample.point as usize);
            let (mut nearest, mut least) = (own, f64::INFINITY);
            let mut meet = |run: usize| {
                for ray in rays.run(run).0 {
                    let squared = (ray.place - own.place).length_squared();
                    // Of equally near ones the last one counts.
                    let is_after = squared == least && ray.point > nearest.point;
                    if ray.point != own.point && (squared < least || is_after) {
                        (nearest, least) = (*ray, squared);
                    }
                }
                least
            };
            let reach = meet(sample.point as usize / step / FANOUT);
            rays.list(
                &Bounds::around([own.place.to_array()].into_iter()),
                reach,
                &mut runs,
            )?;
            runs.iter().for_each(|&run| {
                meet(run as usize);
            });
            let apart = nearest.place * nearest.range - place;
            let near = NEAR * sample.spacing * sparser / self.farthest;
            away += usize::from(apart.length_squared() > near * near);
        }
        Ok(away as f64 / self.noise.samples.len() as f64)
    }

    /// The mean of the distance to the power of the growth.
    fn mean_power(&self, growth: f64) -> f64 {
        let powers = self.distances().map(|distance| libm::pow(distance, growth));
        powers.fold(0.0, |sum, power| sum + power) / self.noise.samples.len() as f64
    }
}

/// The median of the cosine between ray and normal.
fn cosine(noise: &Noise, projection: Projection) -> Result<f64, OutOfMemory> {
    let mut cosines = with_capacity(noise.samples.len())?;
    for sample in &noise.samples {
        let ray = match projection {
            Projection::Perspective(viewpoint) => {
                let v = DVec3::from_array(sample.place) - DVec3::from_array(viewpoint);
                v / square_root(v.dot(v))
            }
            Projection::Parallel(ahead) => ahead,
        };
        let cosine = sample.normal.dot(ray).abs();
        if cosine >= 0.0 {
            cosines.push(cosine);
        }
    }
    Ok(percentile(&cosines, 50)?.unwrap_or(1.0))
}

/// Scores as probabilities: the logarithm of a score's odds is scaled and shifted. Clean surfaces decide sharply. Where
/// there is noise or range, points are more or less often visible than there.
///
/// The constants were fitted to half of the labeled clouds, so that the mean calibration error of thin shapes, of real
/// scans and of each class of simulated ones is least.
#[derive(Clone, Copy)]
pub(super) struct Odds {
    shift: f64,
    power: f64,
}

/// The power of the odds on clean surfaces, and where there is noise or a scanner.
const POWERS: [f64; 2] = [1.4, 0.75];
/// The shift on scans whose points were not moved: gaps in the scans show what is behind them, and what is far
/// behind a surface may be seen beside it. It is less with thickness: 0 at that of layers with noise of a spacing.
const SCANNED: f64 = 2.2;
/// For each power by which spacing grows with range, as seen from the scanner.
const GROWTH: f64 = 2.9;
/// For each spacing of noise that was removed.
const NOISE: f64 = -1.4;
/// A score of 1 has finite odds.
const LEAST_ODDS: f64 = 0.01;

impl Odds {
    /// `moved` is how far points were moved, `ratio` the noise before in spacings. `left` is 1 on scans without
    /// thickness.
    pub(super) fn of(moved: f64, ratio: f64, left: f64, scanned: f64, growth: f64) -> Self {
        let [clean, measured] = POWERS;
        let share = moved + (1.0 - moved) * scanned;
        let removed = if moved > 0.0 { moved * ratio } else { 0.0 };
        let stay = 1.0 - moved;
        Self {
            shift: NOISE * removed + stay * stay * SCANNED * left + GROWTH * growth,
            power: clean * (1.0 - share) + measured * share,
        }
    }

    /// The probability to which a score belongs.
    pub(super) fn probability(self, score: f32) -> f32 {
        let score = f64::from(score);
        let odds = (score + LEAST_ODDS) / (1.0 - score + LEAST_ODDS);
        (1.0 / (1.0 + libm::exp(-self.shift) * libm::pow(odds, -self.power))) as f32
    }
}
