//! The options that questions are asked with.

use hidden_point_removal::{Exponential, Inversion, Options, Radius};

use super::clouds::Subject;
use super::flip::distance;

pub fn with_rule(radius: Radius) -> Options {
    Options::default().with_radius(radius)
}

pub fn with_kernel(inversion: Inversion) -> Options {
    Options::inversion(inversion)
}

pub fn exponential() -> Options {
    with_kernel(Inversion::Exponential(Exponential::Auto))
}

/// An exponential inversion with a given scale: a third of the distance to some point.
pub fn exponential_of(subject: &Subject) -> Options {
    let distance = distance(subject.target(), subject.viewpoint);
    let scale = if distance > 0.0 { distance / 3.0 } else { 0.3 };
    with_kernel(Inversion::Exponential(Exponential::Scale(scale)))
}

/// Options for several looks, with scores.
pub fn looks(count: usize) -> Options {
    with_kernel(Inversion::Looks(count)).with_scores(true)
}
