//! How numbers of a map depend on the flip: g of a distance, and back.

use glam::Vec4;

use crate::answers::looks::Depth;
use crate::base::real::larger;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;

/// Stands for an unknown bound; at least [`UNKNOWN`] also after all means.
pub(super) const NONE: f32 = 1e30;
pub(super) const UNKNOWN: f32 = 1e20;
/// Stands for a direction in which nothing is hidden.
pub(super) const NOWHERE: f32 = f32::MAX;
/// The largest distance in a map, where points can be hidden. A test takes a cell with a larger one as
/// unknown.
pub(super) const MOST: f64 = 1e30;
/// Champions that are nearer are left out, and no distance in a map is less. Single precision may flush a smaller one to 0.
pub(super) const LEAST: f32 = 1e-30;
pub(super) const UNIT: f32 = 0.5 * f32::EPSILON;
/// The logarithm grows slower than any power; this one is as good.
const LEAST_POWER: f64 = 0.01;

/// What a map stands in for.
pub(super) enum Asked<'a> {
    Hull(&'a Flip),
    /// The kernel of its hull, and where points may be visible besides.
    Looks(Kernel, Depth),
}

/// How numbers in a window depend on the flip.
#[derive(Clone, Copy)]
pub(super) struct Gauge<'a> {
    flip: Lengths<'a>,
    /// For looks: how far behind a surface points are hidden.
    pub behind: Option<f32>,
}

#[derive(Clone, Copy)]
enum Lengths<'a> {
    /// 2R, rounded down.
    Sphere(f32),
    /// S.
    Other(&'a Flip, f64),
    /// For looks, whose maps are not proved.
    Looks(Log),
}

/// log|q| = scale·(d/unit)^power. It is so small that differences of it are as good as shares of |q|.
#[derive(Clone, Copy)]
struct Log {
    scale: f32,
    unit: f32,
    power: f32,
    /// That of the nearest champions.
    most: f32,
}

impl<'a> Gauge<'a> {
    /// `None` where no distance would be left. `nearest`: a distance of the nearest champions.
    pub(super) fn new(asked: &Asked<'a>, nearest: f32) -> Option<Self> {
        let flip = match *asked {
            Asked::Hull(flip) => {
                let twice = flip.diameter();
                let length = twice.unwrap_or_else(|| flip.most_beyond(f64::from(nearest)));
                let known = (1e-25..1e25).contains(&twice.unwrap_or(1.0))
                    && (1e-280..1e280).contains(&length);
                if !known {
                    return None;
                }
                match twice {
                    Some(twice) => Lengths::Sphere(twice as f32 * (1.0 - f32::EPSILON)),
                    None => Lengths::Other(flip, length),
                }
            }
            Asked::Looks(kernel, _) => Lengths::Looks(Log::of(kernel, nearest)?),
        };
        let behind = match asked {
            Asked::Hull(_) => None,
            Asked::Looks(_, depth) => Some(depth.behind as f32),
        };
        Some(Self { flip, behind })
    }

    /// G of points at these distances.
    #[inline(never)]
    pub(super) fn bound(&self, d: Vec4) -> Vec4 {
        let d = d * (1.0 + 16.0 * UNIT);
        match self.flip {
            Lengths::Sphere(twice) => d / (Vec4::splat(twice) - d),
            Lengths::Other(flip, length) => other(d, |d| length / flip.reach_at(d) - 1.0),
            Lengths::Looks(log) => log.beyond(raised(d / log.unit, log.power) * log.scale),
        }
    }

    /// The distances of these G.
    #[inline(never)]
    pub(super) fn distance(&self, bound: Vec4) -> Vec4 {
        match self.flip {
            Lengths::Sphere(twice) => bound / (bound + 1.0) * twice * (1.0 + 16.0 * UNIT),
            Lengths::Other(flip, length) => {
                other(bound, |bound| flip.distance_at(length / (1.0 + bound)))
            }
            Lengths::Looks(log) => {
                raised(log.beyond(bound) / log.scale, log.power.recip()) * log.unit
            }
        }
    }
}

impl Log {
    fn of(kernel: Kernel, nearest: f32) -> Option<Self> {
        let (scale, unit, power) = match kernel {
            Kernel::Exponential { scale } => (scale, 1.0, -1.0),
            Kernel::Growing {
                scale,
                farthest,
                power,
            } => {
                let less = larger(1.0 - power, LEAST_POWER);
                (scale / (farthest * less), farthest, -less)
            }
            Kernel::Spherical { .. } | Kernel::Power { .. } => return None,
        };
        let [scale, unit, power] = [scale, unit, power].map(|x| x as f32);
        let most = scale * raised(Vec4::splat(nearest / unit), power).x;
        let is_known = scale > LEAST && (LEAST..1.0 / LEAST).contains(&most);
        is_known.then_some(Self {
            scale,
            unit,
            power,
            most,
        })
    }

    #[inline(always)]
    fn beyond(&self, log: Vec4) -> Vec4 {
        (Vec4::splat(self.most) - log).max(Vec4::ZERO)
    }
}

/// Powers of positive numbers, to five digits: bounds of maps of looks are no better.
#[inline(never)]
fn raised(numbers: Vec4, power: f32) -> Vec4 {
    if power == -1.0 {
        return numbers.recip();
    }
    // x is m·2^k with m from √½ to √2: log₂ m is a series of (m − 1)/(m + 1).
    const ROOT_HALF: u32 = core::f32::consts::FRAC_1_SQRT_2.to_bits();
    let bits = numbers.to_array().map(f32::to_bits);
    let whole = bits.map(|bits| (bits.wrapping_sub(ROOT_HALF) as i32) >> 23);
    let m = Vec4::from_array(core::array::from_fn(|lane| {
        f32::from_bits(bits[lane].wrapping_sub((whole[lane] << 23) as u32))
    }));
    let s = (m - 1.0) / (m + 1.0);
    let log = Vec4::from_array(whole.map(|k| k as f32)) + series(s * s, &LOG) * s;
    let log = (log * power).clamp(Vec4::splat(-126.0), Vec4::splat(126.0));
    let nearest = (log + 0.5).floor();
    let scale = nearest
        .to_array()
        .map(|k| f32::from_bits(((k as i32 + 127) << 23) as u32));
    series(log - nearest, &EXP) * Vec4::from_array(scale)
}

/// log₂((1 + s)/(1 − s)) ÷ s in powers of s², and 2^x in those of x, from the highest one.
const LOG: [f32; 3] = [0.577_078_04, 0.961_796_7, 2.885_39];
const EXP: [f32; 6] = [
    0.001_333_355_8,
    0.009_618_129,
    0.055_504_11,
    0.240_226_5,
    core::f32::consts::LN_2,
    1.0,
];

#[inline(always)]
fn series<const N: usize>(x: Vec4, factors: &[f32; N]) -> Vec4 {
    factors
        .iter()
        .fold(Vec4::ZERO, |sum, &factor| sum * x + factor)
}

#[inline(never)]
fn other(numbers: Vec4, of: impl Fn(f64) -> f64) -> Vec4 {
    numbers.map(|x| {
        if x < UNKNOWN {
            (of(f64::from(x)).clamp(0.0, 1e31) * (1.0 + 1e-6)) as f32
        } else {
            NONE
        }
    })
}
