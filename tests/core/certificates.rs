//! Compares the crate with exact certificates on clouds that are too large for the oracle.
//! Also compares the certificates with the oracle.

use crate::common::scenes::{KINDS, Scene};
use crate::common::{ask, indices_of, oracle, proved};

/// Compares the crate's answer with the proved answer, for every point of the scene.
fn check(name: &str, seed: u64, scene: &Scene) {
    let answer = ask(&scene.points, scene.viewpoint, &scene.options);
    let expected = proved(&scene.points, scene.viewpoint, answer.radius());
    assert_eq!(
        answer.indices(),
        indices_of(&expected),
        "{name} with seed {seed}, {} points, {:?}",
        scene.points.len(),
        scene.options
    );
}

#[test]
fn every_point_of_medium_clouds_is_certified() {
    for kind in KINDS {
        for seed in 1000..1008 {
            check(
                kind.name,
                seed,
                &kind.scene(seed, 40 + 60 * (seed % 4) as usize),
            );
        }
    }
}

#[test]
fn every_point_of_larger_clouds_is_certified() {
    for kind in KINDS {
        check(kind.name, 7, &kind.scene(7, 1200));
    }
}

#[test]
fn certificates_and_oracle_agree() {
    for kind in KINDS {
        for seed in 3000..3010 {
            let scene = kind.scene(seed, 14);
            let radius = ask(&scene.points, scene.viewpoint, &scene.options).radius();
            let certified = proved(&scene.points, scene.viewpoint, radius);
            let expected = oracle::visible(&scene.points, scene.viewpoint, radius);
            assert_eq!(certified, expected, "{} with seed {seed}", kind.name);
        }
    }
}
