//! Shared by the tests of the core. Nothing here knows how the crate finds its
//! answers. Everything is derived from the definition of visibility,
//!
//! > q is visible exactly when λq ∉ K for every λ > 1, K = conv(Q ∪ {0}),
//!
//! where Q are the flipped points as rounded to `f64`.
// Each test program uses only a part of this.
#![allow(dead_code)]

pub mod cameras;
pub mod certify;
pub mod chosen;
pub mod definition;
pub mod degenerate;
pub mod flip;
pub mod hyper;
pub mod lower;
pub mod oracle;
pub mod placing;
pub mod rational;
pub mod rng;
pub mod scanner;
pub mod scenes;
pub mod shapes;
pub mod structured;
pub mod walk;
pub mod walked;

/// No viewpoints.
pub const NOWHERE: [[f64; 3]; 0] = [];

use hidden_point_removal::{Error, Options, PointCloud, Position, Visibility};

use certify::Certifier;
use flip::flip;

/// Asks the crate. The inputs must be accepted.
pub fn ask<P: Position>(points: &[P], viewpoint: [f64; 3], options: &Options) -> Visibility {
    PointCloud::new(points)
        .expect("an acceptable cloud")
        .visible_from(viewpoint, options)
        .expect("an acceptable view")
}

/// Asserts that the question was refused with this code, by a message that has these words.
#[track_caller]
pub fn refused<T>(code: &str, words: &str, found: Result<T, Error>) {
    let error = found
        .err()
        .unwrap_or_else(|| panic!("answered, not refused as {code}: {words}"));
    assert_eq!(error.code(), code, "{error}");
    assert!(error.to_string().contains(words), "{error}, not: {words}");
}

/// In single precision, if that is requested and can hold every coordinate.
pub fn cloud_of(points: &[[f64; 3]], in_single: bool) -> PointCloud {
    let is_single = |x: &f64| f64::from(*x as f32) == *x;
    let cloud = if in_single && points.iter().flatten().all(is_single) {
        let points: Vec<[f32; 3]> = points.iter().map(|p| p.map(|x| x as f32)).collect();
        PointCloud::new(&points)
    } else {
        PointCloud::new(points)
    };
    cloud.expect("an acceptable cloud")
}

/// The positions of the set bits.
pub fn indices_of(mask: &[bool]) -> Vec<u32> {
    (0..mask.len() as u32)
        .filter(|&i| mask[i as usize])
        .collect()
}

/// The answer by certificates for every point.
pub fn proved(points: &[[f64; 3]], viewpoint: [f64; 3], radius: f64) -> Vec<bool> {
    let flipped: Vec<_> = points.iter().map(|&p| flip(p, viewpoint, radius)).collect();
    proved_flipped(&flipped)
}

/// The same for flipped points; `None` stands for a point at the viewpoint.
pub fn proved_flipped(flipped: &[Option<[f64; 3]>]) -> Vec<bool> {
    let q: Vec<_> = flipped.iter().flatten().copied().collect();
    if q.is_empty() {
        return vec![true; flipped.len()];
    }
    let certifier = Certifier::new(&q);
    let mut number = 0;
    flipped
        .iter()
        .map(|q| {
            q.is_none() || {
                number += 1;
                certifier.verdict(number - 1).visible
            }
        })
        .collect()
}

pub fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|axis| a[axis] - b[axis])
}

pub fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}
