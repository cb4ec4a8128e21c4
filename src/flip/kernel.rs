//! The kernels. A kernel gives the distance |q| = d·s to which a flip moves a point at
//! distance d, and the factor s of q = v·s. Except for rounding, |q| strictly decreases as d
//! grows.
//!
//! pow and exp come from `libm` in every build, so that all of them round alike.

use crate::base::FULL;
use crate::base::real::smaller;

/// The new distance |q| of a point at distance d from the viewpoint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kernel {
    /// |q| = 2R − d: spherical flipping (paper §3, eq. 1).
    Spherical { radius: f64 },
    /// |q| = d·(d/S)^−γ: the paper's other kernel (§3), 1/‖p‖^γ.
    Power { gamma: f64, unit: f64 },
    /// |q| = exp(c/d).
    Exponential { scale: f64 },
    /// |q| = exp(∫c(d)/d²), where c(d) is `scale`·(d/D)^β, with 0 < β ≤ 1 and D = `farthest`.
    Growing {
        scale: f64,
        farthest: f64,
        power: f64,
    },
}

/// The largest exponent for `exp`. All points with a larger one go equally far.
const MAX_EXPONENT: f64 = 200.0;

impl Kernel {
    /// The factor s for a point at distance `d`; not finite for d = 0.
    #[inline]
    pub(crate) fn factor(&self, d: f64) -> f64 {
        match *self {
            Self::Spherical { radius } => (2.0 * radius - d) / d,
            Self::Power { gamma, unit } => libm::pow(d / unit, -gamma),
            Self::Exponential { scale } => exponential(scale, d) / d,
            Self::Growing { .. } => self.length(d) / d,
        }
    }

    /// |q| of a point at distance `d`, for kernels that need no other number.
    #[inline]
    pub(crate) fn length(&self, d: f64) -> f64 {
        match *self {
            Self::Exponential { scale } => exponential(scale, d),
            Self::Growing {
                scale,
                farthest,
                power,
            } => growing(scale / farthest, d / farthest, power),
            _ => self.factor(d) * d,
        }
    }

    /// The same, not inlined, to keep loops small.
    #[inline(never)]
    pub(crate) fn factor_out_of_line(&self, d: f64) -> f64 {
        self.factor(d)
    }

    /// The distance that has this |q|: the inverse of [`Kernel::length`]; infinite where there is
    /// none.
    pub(crate) fn distance(&self, length: f64) -> f64 {
        if length.is_nan() || length <= 0.0 {
            return f64::INFINITY;
        }
        match *self {
            Self::Spherical { radius } => 2.0 * radius - length,
            Self::Power { gamma, unit } => unit * libm::pow(length / unit, 1.0 / (1.0 - gamma)),
            Self::Exponential { scale } if length > 1.0 => scale / libm::log(length),
            Self::Exponential { .. } => f64::INFINITY,
            Self::Growing {
                scale,
                farthest,
                power,
            } => {
                let (less, grown) = (1.0 - power, libm::log(length) * farthest / scale);
                let log = if less > 0.0 {
                    libm::log1p(less * grown) / less
                } else {
                    grown
                };
                let distance = farthest * libm::exp(-log);
                if distance.is_nan() {
                    f64::INFINITY
                } else {
                    distance
                }
            }
        }
    }

    /// The R of a flip on a sphere: |q| is at most 2.5 R (or 3 R). `None` for other kernels: their
    /// largest |q| depends on the points.
    pub(crate) fn radius(&self) -> Option<f64> {
        match *self {
            Self::Spherical { radius } => Some(radius),
            Self::Power { .. } | Self::Exponential { .. } | Self::Growing { .. } => None,
        }
    }
}

fn exponential(scale: f64, d: f64) -> f64 {
    libm::exp(smaller(MAX_EXPONENT, scale / d))
}

/// exp(c·(t^(β−1) − 1)/(1 − β)), which is t^(−c) for β = 1.
fn growing(scale: f64, t: f64, power: f64) -> f64 {
    if !FULL {
        unreachable!("only looks flip so");
    }
    let less = 1.0 - power;
    let log = -libm::log(t);
    let grown = if less > 0.0 {
        libm::expm1(less * log) / less
    } else {
        log
    };
    libm::exp(smaller(MAX_EXPONENT, scale * grown))
}
