//! Compares drafts with exact answers:
//! `cargo run --profile fuzz --package hpr-tests --bin fuzz_drafts -- --minutes 5 [--seed N]`
//!
//! Viewpoints walk around, in and through clouds of every kind, with every inversion. Each
//! view is asked as a draft first. Then the exact answer goes on from the draft. Both are
//! compared with answers that start from nothing. The last line says how many views were tried
//! and how many were wrong.

use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use hidden_point_removal::{Options, PointCloud};

#[path = "../core/common/mod.rs"]
mod common;
mod subject;

use common::drafts::fault;
use common::rng::Rng;
use common::walk::Walk;
use subject::{inversion, subject};

/// The number of views of one cloud.
const WALK: usize = 12;

fn main() {
    let minutes: f64 = argument("--minutes").map_or(1.0, |x| x.parse().expect("a number"));
    let now = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .expect("a clock");
    let seed: u64 = argument("--seed").map_or(now.as_secs(), |x| x.parse().expect("a number"));
    println!("seed {seed}, {minutes} minutes");
    let end = Instant::now() + Duration::from_secs_f64(60.0 * minutes);
    let mut rng = Rng::new(seed);
    let [mut tried, mut wrong] = [0; 2];
    while Instant::now() < end {
        let (name, points, viewpoint) = subject(&mut rng);
        let cloud = PointCloud::new(&points).expect("an acceptable cloud");
        let mut observer = cloud.observer();
        let mut walk = Walk::new(&points, viewpoint, Options::default());
        for _ in 0..WALK {
            let mut options = walk.options;
            if rng.chance(4) {
                options = Options::with_inversion(inversion(&mut rng));
            }
            if rng.chance(12) && points.len() > 8 {
                options.vote = Some(1 + rng.below(7));
            }
            if let Some(found) = fault(&cloud, &mut observer, walk.viewpoint, &options) {
                wrong += 1;
                let count = points.len();
                println!(
                    "wrong: {name} ({count} points) from {:?} with {options:?}: {found}",
                    walk.viewpoint
                );
            }
            tried += 1;
            walk.step(&mut rng);
        }
    }
    println!("{tried} tried, {wrong} wrong");
    if wrong > 0 {
        std::process::exit(1);
    }
}

fn argument(name: &str) -> Option<String> {
    std::env::args().skip_while(|arg| arg != name).nth(1)
}
