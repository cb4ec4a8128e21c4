//! What can be asked besides a view, compared with views alone:
//! `cargo run --profile fuzz --package hpr-tests --bin fuzz_queries -- --minutes 5 [--seed N] [--query NAME]`
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

use common::rng::Rng;
use common::scenes::Scene;
use queries::{QUERIES, subject};
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
