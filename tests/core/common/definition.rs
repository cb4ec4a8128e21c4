//! The answer by definition, for flipped points of any range and number.

use super::{oracle, proved_flipped};

/// Up to this number of points, answers are compared with the enumeration. The enumeration
/// takes coordinates of any range.
const FEW: usize = 9;
/// Ratios of coordinates beyond which expansion arithmetic is not exact.
const WIDE: f64 = 1e50;

/// Visible or not, for each flipped point; `None` stands for a point at the viewpoint.
///
/// Certificates decide if they can. Otherwise the enumeration decides, which takes n⁴ steps.
pub fn visible(flipped: &[Option<[f64; 3]>]) -> Vec<bool> {
    if has_certificates(flipped) {
        proved_flipped(flipped)
    } else {
        oracle::visible_flipped(flipped)
    }
}

/// The same answer by the other method, if it applies. The two methods are independent.
pub fn visible_otherwise(flipped: &[Option<[f64; 3]>]) -> Option<Vec<bool>> {
    (flipped.len() <= FEW && has_certificates(flipped)).then(|| oracle::visible_flipped(flipped))
}

/// Certificates need a nonzero q for each point, and ratios that expansion arithmetic can take.
pub fn has_certificates(flipped: &[Option<[f64; 3]>]) -> bool {
    let sizes = || flipped.iter().flatten().flatten().map(|x| x.abs());
    let largest = sizes().fold(0.0, f64::max);
    let is_narrow = sizes().all(|x| x == 0.0 || x > largest / WIDE);
    is_narrow && flipped.iter().flatten().all(|q| *q != [0.0; 3])
}
