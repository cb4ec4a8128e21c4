//! Small clouds of two to seven dimensions, compared with the definition in integers.

use hidden_point_removal::Options;

use crate::common::hyper::Case;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;

/// The scene is left empty: the cloud has more than three dimensions.
pub fn subject(_: &mut Rng) -> (&'static str, Scene) {
    let scene = Scene {
        points: Vec::new(),
        viewpoint: [0.0; 3],
        options: Options::default(),
    };
    ("random", scene)
}

pub fn check(_: &Scene, rng: &mut Rng) -> Result<(), String> {
    let dimension = 2 + rng.below(6);
    let case = Case::random(rng, dimension, 10);
    match case.is_right() {
        Some(false) => Err(format!("{case:?}")),
        _ => Ok(()),
    }
}
