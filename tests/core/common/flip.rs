//! The flips, operation by operation. Answers are exact for this fixed sequence of `f64`
//! operations.

use hidden_point_removal::{Exponential, Inversion, Visibility};

/// `v = p − C` and its length. The sum of the squares is computed from left to right.
fn relative(p: [f64; 3], viewpoint: [f64; 3]) -> ([f64; 3], f64) {
    let x = p[0] - viewpoint[0];
    let y = p[1] - viewpoint[1];
    let z = p[2] - viewpoint[2];
    let xx = x * x;
    let yy = y * y;
    let zz = z * z;
    ([x, y, z], ((xx + yy) + zz).sqrt())
}

pub fn distance(p: [f64; 3], viewpoint: [f64; 3]) -> f64 {
    relative(p, viewpoint).1
}

/// The farthest distance; 0 for no points.
pub fn farthest(points: &[[f64; 3]], viewpoint: [f64; 3]) -> f64 {
    points
        .iter()
        .map(|&p| distance(p, viewpoint))
        .fold(0.0, f64::max)
}

/// q, or `None` for a point at the viewpoint. Such a point is visible and hides nothing.
pub fn flip(p: [f64; 3], viewpoint: [f64; 3], radius: f64) -> Option<[f64; 3]> {
    let (v, d) = relative(p, viewpoint);
    if d == 0.0 {
        return None;
    }
    let s = (2.0 * radius - d) / d;
    s.is_finite().then(|| v.map(|x| x * s))
}

/// The flip that an answer reports.
pub fn flip_as(p: [f64; 3], viewpoint: [f64; 3], answer: &Visibility) -> Option<[f64; 3]> {
    let (v, d) = relative(p, viewpoint);
    let s = match answer.inversion() {
        Inversion::Spherical => return flip(p, viewpoint, answer.radius()),
        Inversion::Power(gamma) => libm::pow(d / answer.radius(), -gamma),
        Inversion::Exponential(Exponential::Scale(c)) => libm::exp((c / d).min(200.0)) / d,
        other => panic!("{other:?} is not one resolved inversion"),
    };
    // A point beyond the range of f64 counts like a point at the viewpoint.
    Some(v.map(|x| x * s)).filter(|q| q.iter().all(|x| x.is_finite()))
}

/// The place whose flip is about q, by the flip that an answer reports.
pub fn unflipped_as(q: [f64; 3], viewpoint: [f64; 3], answer: &Visibility) -> Option<[f64; 3]> {
    let (_, far) = relative(q, [0.0; 3]);
    let radius = answer.radius();
    let d = match answer.inversion() {
        Inversion::Spherical => 2.0 * radius - far,
        Inversion::Power(gamma) => radius * libm::pow(far / radius, 1.0 / (1.0 - gamma)),
        Inversion::Exponential(Exponential::Scale(c)) => c / libm::log(far),
        other => panic!("{other:?} is not one resolved inversion"),
    };
    let place = core::array::from_fn(|axis| viewpoint[axis] + q[axis] * (d / far));
    (d > 0.0 && place.iter().all(|x| x.is_finite())).then_some(place)
}
