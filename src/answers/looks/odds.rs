//! Scores as probabilities where noise or scans make points more or less often visible than on
//! clean surfaces. The logarithm of a score's odds is scaled and shifted.
//!
//! The constants were fitted to half of the labeled clouds, by logistic regression: real scans, and
//! simulated ones with noise.

/// What a score's odds become.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Odds {
    shift: f64,
    power: f64,
}

/// Scans whose points were not moved: gaps in the scans show what is behind them, and what is far
/// behind a surface may be seen beside it.
const SCANNED: Odds = Odds {
    shift: 0.85,
    power: -0.4,
};
/// For each spacing of noise that was removed.
const NOISE: f64 = -2.1;
/// For each power by which spacing grows with range, as seen from the scanner.
const GROWTH: f64 = 1.9;
/// For each spacing of noise that is left: a thickness decides sharply.
const LAYERS: f64 = 1.65;
/// More of it counts no more.
const MOST_LEFT: f64 = 0.5;
/// A score of 1 has finite odds.
const LEAST: f64 = 0.01;

impl Odds {
    pub(super) const PLAIN: Self = Self {
        shift: 0.0,
        power: 1.0,
    };

    /// `removed` and `left` are lengths of noise in spacings.
    pub(super) fn of(is_scanned: bool, removed: f64, growth: f64, left: f64) -> Self {
        let scanned = f64::from(u8::from(is_scanned));
        Self {
            shift: scanned * SCANNED.shift + removed * NOISE + growth * GROWTH,
            power: 1.0 + scanned * SCANNED.power + left.min(MOST_LEFT) * LAYERS,
        }
    }

    /// The probability to which a score belongs.
    pub(super) fn probability(self, score: f32) -> f32 {
        if self == Self::PLAIN {
            return score;
        }
        let score = f64::from(score);
        let odds = (score + LEAST) / (1.0 - score + LEAST);
        (1.0 / (1.0 + libm::exp(-self.shift) * libm::pow(odds, -self.power))) as f32
    }
}
