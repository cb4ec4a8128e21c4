//! Divided views compared with whole views:
//! `cargo run --profile fuzz --package hpr-tests --bin fuzz_sectors -- --minutes 5 [--seed N]`
//!
//! Rooms, lattices, planes and lines, from viewpoints that lie in them, in 2 to 64
//! sectors, in single and double precision. For small clouds the whole view is also compared
//! with the definition. `run` explains the output.

use hidden_point_removal::PointCloud;

#[path = "../core/common/mod.rs"]
mod common;
mod run;
mod shrink;

use common::scenes::Scene;
use common::{cloud_of, definition, flip, indices_of, sectors, structured};
use run::{Run, checked, literal};
use shrink::shrink;

/// The number of viewpoints for each cloud.
const VIEWS: usize = 12;
/// Up to this number of points, the whole view is compared with the definition.
const FEW: usize = 150;

fn main() {
    let mut run = Run::start();
    while run.goes_on() {
        for &(kind, shape) in structured::SHAPES {
            let n = match run.rng.below(24) {
                0..10 => 65 + run.rng.below(200),
                10..21 => 200 + run.rng.below(700),
                21..23 => 900 + run.rng.below(1600),
                _ => 2500 + run.rng.below(2500),
            };
            let mut scene = structured::scene(&mut run.rng, (kind, shape), n);
            let in_single = run.rng.chance(2);
            let cloud = cloud_of(&scene.points, in_single);
            for _ in 0..VIEWS {
                let count = match run.rng.below(16) {
                    0..7 => 2,
                    7..15 => 3 + run.rng.below(5) as u32,
                    _ => 8 + run.rng.below(57) as u32,
                };
                let outcome = checked(|| check(&cloud, &scene, count));
                if let Err(wrong) = outcome {
                    if run.count_wrong(kind) {
                        println!("wrong: {kind}, {n} points, single: {in_single}: {wrong}");
                        let is_wrong = |scene: &Scene| {
                            let cloud = cloud_of(&scene.points, in_single);
                            checked(|| check(&cloud, scene, count)).is_err()
                        };
                        println!("{count} sectors of {}", literal(&shrink(scene, is_wrong)));
                    }
                    break;
                }
                if outcome == Ok(true) {
                    run.count(kind, 1);
                }
                structured::move_on(&mut run.rng, kind, &mut scene);
            }
        }
    }
    run.finish();
}

/// Returns whether the view was answered (`true`) or refused. The error describes a difference.
fn check(cloud: &PointCloud, scene: &Scene, count: u32) -> Result<bool, String> {
    let Scene {
        points,
        viewpoint,
        options,
    } = scene;
    sectors::compare(cloud, *viewpoint, options, count)?;
    let Ok(whole) = cloud.visible_from(*viewpoint, options) else {
        return Ok(false);
    };
    if points.len() > FEW {
        return Ok(true);
    }
    let flipped: Vec<_> = points
        .iter()
        .map(|&p| flip::flip_as(p, *viewpoint, &whole))
        .collect();
    if !definition::has_certificates(&flipped) {
        return Ok(true);
    }
    let expected = indices_of(&definition::visible(&flipped));
    if whole.indices() == expected {
        return Ok(true);
    }
    let answered = whole.indices();
    Err(format!("answered {answered:?}, by definition {expected:?}"))
}
