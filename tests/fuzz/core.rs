//! The checks of `tests/core/checks`, on new random scenes:
//! `cargo run --profile fuzz --package hpr-tests --bin fuzz_core -- --minutes 5 [--seed N] [--check NAME]`
//!
//! `run` explains the output.

#[path = "../core/checks/mod.rs"]
mod checks;
#[path = "../core/common/mod.rs"]
mod common;
mod run;
mod shrink;

use checks::CHECKS;
use common::rng::Rng;
use common::scenes::Scene;
use run::{Run, argument, checked, literal};
use shrink::shrink;

fn main() {
    let wanted = argument("--check").unwrap_or_default();
    let mut run = Run::start();
    while run.goes_on() {
        for check in CHECKS.iter().filter(|check| check.name.contains(&wanted)) {
            let (kind, scene) = (check.subject)(&mut run.rng);
            let kind = format!("{}, {kind}", check.name);
            let seed = run.rng.bits();
            let ask = |scene: &Scene| checked(|| (check.ask)(scene, &mut Rng::new(seed)));
            match ask(&scene) {
                Ok(()) => run.count(&kind, 1),
                Err(wrong) => {
                    if run.count_wrong(&kind) {
                        println!("wrong: {kind}, seed {seed}: {wrong}");
                        let small = shrink(scene, |scene| ask(scene).is_err());
                        println!("{}\n{:?}", literal(&small), ask(&small));
                    }
                }
            }
        }
    }
    let tested = checks::maps::TESTED.load(std::sync::atomic::Ordering::Relaxed);
    println!("maps: {tested} points tested");
    run.finish();
}
