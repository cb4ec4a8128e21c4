//! Scores as probabilities: the logarithm of a score's odds is scaled and shifted. Clean surfaces decide sharply. Where
//! there is noise or range, points are more or less often visible than there.
//!
//! The constants were fitted to half of the labeled clouds, so that the mean calibration error of thin shapes, of real
//! scans and of each class of simulated ones is least.

/// What a score's odds become.
#[derive(Clone, Copy)]
pub(super) struct Odds {
    shift: f64,
    power: f64,
}

/// The power of the odds on clean surfaces, and where there is noise or a scanner.
const POWERS: [f64; 2] = [1.4, 0.75];
/// The shift on scans whose points were not moved: gaps in the scans show what is behind them, and what is far
/// behind a surface may be seen beside it.
const SCANNED: f64 = 2.2;
/// For each spacing of noise that was removed.
const NOISE: f64 = -1.4;
/// For each power by which spacing grows with range, as seen from the scanner.
const GROWTH: f64 = 2.9;
/// For each spacing of thickness.
const LAYERS: f64 = -0.15;
/// A score of 1 has finite odds.
const LEAST: f64 = 0.01;

impl Odds {
    /// `removed` is a length of noise in spacings; `left` is the thickness in spacings, of scans whose points were not
    /// moved.
    pub(super) fn of(removed: Option<f64>, left: Option<f64>, growth: f64) -> Self {
        let shift = match (removed, left) {
            (Some(removed), _) => NOISE * removed,
            (None, Some(left)) => (SCANNED + LAYERS * left).max(0.0),
            (None, None) => 0.0,
        };
        let is_measured = removed.is_some() || left.is_some();
        Self {
            shift: shift + GROWTH * growth,
            power: POWERS[usize::from(is_measured)],
        }
    }

    /// The probability to which a score belongs.
    pub(super) fn probability(self, score: f32) -> f32 {
        let score = f64::from(score);
        let odds = (score + LEAST) / (1.0 - score + LEAST);
        (1.0 / (1.0 + libm::exp(-self.shift) * libm::pow(odds, -self.power))) as f32
    }
}
