//! Promises that hold for every scene. Each check asks a scene in a way that depends only on the random numbers.
//! The core's tests try some scenes of each (`crate::short`), the fuzzer `fuzz_core` tries new ones.

use hidden_point_removal::{Exponential, Inversion, Options};

use crate::common::chosen::{only, some_choice};
use crate::common::degenerate::DEGENERATE;
use crate::common::rng::Rng;
use crate::common::scenes::{EXTREME, KINDS, Scene};
use crate::common::structured;

pub mod boxes;
mod camera;
mod coverage;
mod dimensions;
mod invariance;
pub mod maps;
mod oracle;
pub mod sectors;
mod sees;
mod slices;
mod threads;
mod within;

pub struct Check {
    pub name: &'static str,
    /// A scene, and the name of its kind.
    pub subject: fn(&mut Rng) -> (&'static str, Scene),
    /// Panics or returns an error if an answer is wrong.
    pub ask: fn(&Scene, &mut Rng) -> Result<(), String>,
}

pub const CHECKS: [Check; 12] = [
    check("oracle", oracle::subject, oracle::check),
    check("sectors", |rng| subject(rng, 2500), sectors::check),
    check("slices", slices::subject, slices::check),
    check("boxes", boxes::subject, boxes::check),
    check("dimensions", dimensions::subject, dimensions::check),
    check("camera", |rng| subject(rng, 2500), camera::check),
    check("sees", |rng| subject(rng, 1200), sees::check),
    check("within", |rng| subject(rng, 1200), within::check),
    check("coverage", |rng| subject(rng, 400), coverage::check),
    check("invariance", |rng| subject(rng, 2500), invariance::check),
    check("maps", maps::subject, maps::check),
    check("threads", |rng| subject(rng, 9000), threads::check),
];

const fn check(
    name: &'static str,
    subject: fn(&mut Rng) -> (&'static str, Scene),
    ask: fn(&Scene, &mut Rng) -> Result<(), String>,
) -> Check {
    Check { name, subject, ask }
}

/// A cloud of at most about `most` points, with a viewpoint and options. Most clouds are small.
fn subject(rng: &mut Rng, most: usize) -> (&'static str, Scene) {
    let n = match rng.below(10) {
        0..4 => rng.below(13),
        4..9 => 12 + rng.below(100),
        _ => 100 + rng.below(most),
    };
    let (name, mut scene) = match rng.below(4) {
        0 | 1 => {
            let shape = rng.pick(structured::SHAPES);
            (shape.0, structured::scene(rng, shape, n))
        }
        2 => {
            let kinds = if n < 100 && rng.chance(4) {
                EXTREME
            } else {
                KINDS
            };
            let kind = &kinds[rng.below(kinds.len())];
            (kind.name, kind.scene(rng.bits(), n))
        }
        _ => {
            let kind = &DEGENERATE[rng.below(DEGENERATE.len())];
            (kind.name, kind.scene(rng.bits(), n.min(120)))
        }
    };
    if rng.chance(6) && !scene.points.is_empty() {
        for _ in 0..1 + rng.below(10) {
            let copy = rng.pick(&scene.points);
            scene.points.push(copy);
        }
    }
    if rng.chance(6) {
        // Map coordinates: the planes of lattices stay planes, because whole numbers do not round.
        let place = [523_000.0, 4_657_000.0, 120.0];
        let moved = |p: [f64; 3]| core::array::from_fn(|i| place[i] + p[i]);
        scene.points.iter_mut().for_each(|p| *p = moved(*p));
        scene.viewpoint = moved(scene.viewpoint);
    }
    (name, scene)
}

/// The scene's own options, or others; sometimes for some of the points only.
fn options(scene: &Scene, rng: &mut Rng) -> Options {
    let mut options = match rng.below(6) {
        0..3 => scene.options,
        3 => Options::default(),
        4 => Options::inversion(Inversion::Exponential(Exponential::Auto)),
        _ => Options::looks(2 + rng.below(2)),
    };
    if rng.chance(5) {
        options = only(some_choice(rng, scene), &options);
    }
    options
}

/// An error unless both are equal. A refusal that names NaN equals itself.
fn same<T: PartialEq + core::fmt::Debug>(title: &str, found: T, expected: T) -> Result<(), String> {
    if found == expected || format!("{found:?}") == format!("{expected:?}") {
        return Ok(());
    }
    Err(format!("{title}: {found:?}, expected {expected:?}"))
}
