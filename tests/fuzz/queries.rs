//! What can be asked besides a view, compared with views alone:
//! `cargo run --profile fuzz --example fuzz_queries -- --minutes 5 [--seed N] [--query NAME]`
//!
//! Cameras, points that are not in the cloud (`sees`), points within limits, coverage and placement,
//! several looks, sectors of a cloud in parts. The clouds are walls, lattices, duplicates, planes through the
//! viewpoint and map coordinates, in single and double precision. `run` explains the output.

#[path = "../core/common/mod.rs"]
mod common;
#[path = "queries/mod.rs"]
mod queries;
mod run;
mod shrink;

use common::degenerate::DEGENERATE;
use common::rng::Rng;
use common::scenes::{EXTREME, KINDS, Scene};
use common::structured;
use queries::QUERIES;
use run::{Run, argument, checked, literal};
use shrink::shrink;

fn main() {
    let wanted = argument("--query").unwrap_or_default();
    let mut run = Run::start();
    while run.goes_on() {
        for query in QUERIES.iter().filter(|query| query.name.contains(&wanted)) {
            let (kind, scene) = subject(&mut run.rng, query.most);
            let seed = run.rng.bits();
            let check = |scene: &Scene| checked(|| (query.check)(scene, &mut Rng::new(seed)));
            match check(&scene) {
                Ok(()) => run.count(query.name, 1),
                Err(wrong) => {
                    if run.count_wrong(query.name) {
                        println!("wrong: {}, {kind}, seed {seed}: {wrong}", query.name);
                        let small = shrink(scene, |scene| check(scene).is_err());
                        println!("{}\n{:?}", literal(&small), check(&small));
                    }
                }
            }
        }
    }
    run.finish();
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
