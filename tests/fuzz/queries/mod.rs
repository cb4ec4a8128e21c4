//! One file for each kind of question. Each asks a scene in a way that depends only on the random numbers.

use hidden_point_removal::{Exponential, Inversion, Options};

use super::common::chosen::{only, some_choice};
use super::common::rng::Rng;
use super::common::scenes::Scene;

mod camera;
mod coverage;
mod looks;
mod outsiders;
mod parts;
mod within;

pub struct Query {
    pub name: &'static str,
    /// The number of points that the largest clouds have, or a few more.
    pub most: usize,
    /// Panics or returns an error if an answer is wrong.
    pub check: fn(&Scene, &mut Rng) -> Result<(), String>,
}

pub const QUERIES: [Query; 6] = [
    query("camera", 2500, camera::check),
    query("sees", 1200, outsiders::check),
    query("within", 1200, within::check),
    query("coverage", 400, coverage::check),
    query("looks", 2500, looks::check),
    query("parts", 1200, parts::check),
];

const fn query(
    name: &'static str,
    most: usize,
    check: fn(&Scene, &mut Rng) -> Result<(), String>,
) -> Query {
    Query { name, most, check }
}

/// The scene's own options, or others; sometimes for some of the points only.
fn options(scene: &Scene, rng: &mut Rng) -> Options {
    let mut options = match rng.below(6) {
        0..3 => scene.options,
        3 => Options::default(),
        4 => Options::with_inversion(Inversion::Exponential(Exponential::Auto)),
        _ => Options::with_inversion(Inversion::Looks(2 + rng.below(2))),
    };
    if rng.chance(5) {
        options.denoise = Some(1 + rng.below(8));
    }
    if rng.chance(5) {
        options.vote = Some(1 + rng.below(8));
    }
    if rng.chance(5) {
        options = only(some_choice(rng, scene), &options);
    }
    options
}

/// An error unless both are equal.
fn same<T: PartialEq + core::fmt::Debug>(title: &str, found: T, expected: T) -> Result<(), String> {
    if found == expected {
        return Ok(());
    }
    Err(format!("{title}: {found:?}, expected {expected:?}"))
}
