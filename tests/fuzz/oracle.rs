//! Random scenes against the definition, for as long as you like:
//! `cargo run --release --example fuzz_oracle -- --minutes 5 [--seed N] [--kind TEXT]`
//!
//! Small scenes are compared with the naive oracle, larger ones with certificates
//! for every point. A wrong answer is cut down to the fewest points that still
//! show it, printed with its seed, and ends the run with status 1.

use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use hidden_point_removal::{Options, PointCloud};

#[path = "../core/common/mod.rs"]
mod common;

use common::rng::Rng;
use common::scenes::{EXTREME, KINDS, Scene};
use common::{ask, indices_of, oracle, proved};

fn main() {
    let minutes: f64 = argument("--minutes").map_or(1.0, |x| x.parse().expect("a number"));
    let now = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .expect("a clock");
    let seed: u64 = argument("--seed").map_or(now.as_secs(), |x| x.parse().expect("a number"));
    // Only kinds of scenes with this in their name.
    let wanted = argument("--kind").unwrap_or_default();
    println!("seed {seed}, {minutes} minutes");

    let mut rng = Rng::new(seed);
    let end = Instant::now() + Duration::from_secs_f64(minutes * 60.0);
    let (mut scenes, mut points) = (0u64, 0u64);
    while Instant::now() < end {
        for (kind, extreme) in KINDS
            .iter()
            .map(|kind| (kind, false))
            .chain(EXTREME.iter().map(|kind| (kind, true)))
        {
            let seed = rng.bits();
            if !kind.name.contains(&wanted) {
                continue;
            }
            let n = match rng.below(8) {
                0 if !extreme => 20 + rng.below(1500),
                1 | 2 if !extreme => 14 + rng.below(12),
                _ => rng.below(14),
            };
            let scene = kind.scene(seed, n);
            if is_wrong(&scene) {
                println!("wrong: {} with seed {seed}, {n} points", kind.name);
                report(shrink(scene));
                std::process::exit(1);
            }
            scenes += 1;
            points += n as u64;
        }
    }
    println!("{scenes} scenes with {points} points answered by the definition");
}

fn argument(name: &str) -> Option<String> {
    std::env::args().skip_while(|arg| arg != name).nth(1)
}

fn expected(scene: &Scene, radius: f64) -> Vec<bool> {
    if scene.points.len() < 30 {
        oracle::visible(&scene.points, scene.viewpoint, radius)
    } else {
        proved(&scene.points, scene.viewpoint, radius)
    }
}

fn is_wrong(scene: &Scene) -> bool {
    let answer = ask(&scene.points, scene.viewpoint, &scene.options);
    answer.indices() != indices_of(&expected(scene, answer.radius()))
}

/// Leaves out points, in ever smaller runs, while the answer stays wrong.
fn shrink(mut scene: Scene) -> Scene {
    let radius = ask(&scene.points, scene.viewpoint, &scene.options).radius();
    scene.options = Options::with_radius(radius);
    let mut run = scene.points.len() / 2;
    while run > 0 {
        let mut start = 0;
        let before = scene.points.len();
        while start < scene.points.len() {
            let mut fewer = scene.points.clone();
            fewer.drain(start..(start + run).min(fewer.len()));
            std::mem::swap(&mut scene.points, &mut fewer);
            if !is_wrong(&scene) {
                scene.points = fewer;
                start += run;
            }
        }
        if run > 1 || scene.points.len() == before {
            run /= 2;
        }
    }
    scene
}

fn report(scene: Scene) {
    let cloud = PointCloud::new(&scene.points).expect("an acceptable cloud");
    let answer = cloud
        .visible_from(scene.viewpoint, &scene.options)
        .expect("an acceptable view");
    println!("{scene:?}");
    println!("answered {:?}", answer.indices());
    println!(
        "expected {:?}",
        indices_of(&expected(&scene, answer.radius()))
    );
}
