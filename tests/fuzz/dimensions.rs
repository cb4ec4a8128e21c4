//! Small clouds of two to seven dimensions, compared with the definition in integers:
//! `cargo run --profile fuzz -p tests --bin fuzz_dimensions -- --minutes 5 [--seed N]`
//!
//! `run` explains the output.

#[path = "../core/common/mod.rs"]
mod common;
#[allow(dead_code)]
mod run;

use std::panic::{AssertUnwindSafe, catch_unwind};

use common::hyper::Case;
use run::Run;

fn main() {
    let mut run = Run::start();
    while run.goes_on() {
        let dimension = 2 + run.rng.below(6);
        let case = Case::random(&mut run.rng, dimension, 10);
        let kind = format!("{} in {dimension} dimensions", case.kind);
        match catch_unwind(AssertUnwindSafe(|| case.is_right())) {
            Ok(None) => {}
            Ok(Some(true)) => run.count(&kind, 1),
            _ => {
                if run.count_wrong(&kind) {
                    println!("{case:?}");
                }
            }
        }
    }
    run.finish();
}
