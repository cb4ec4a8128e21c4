//! Random scenes against the definition, for as long as you like:
//! `cargo run --profile fuzz --example fuzz_oracle -- --minutes 5 [--seed N] [--kind TEXT]`
//!
//! Small scenes are compared with the naive oracle, larger ones with certificates
//! for every point. A wrong answer is cut down to the fewest points that still
//! show it, printed with its seed, and ends the run with status 1.

use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use hidden_point_removal::{Exponential, Inversion, Options, PointCloud, Radius, Visibility};

#[path = "../core/common/mod.rs"]
mod common;

use common::flip::{farthest, flip_as};
use common::rng::Rng;
use common::scenes::{EXTREME, KINDS, Scene};
use common::{ask, indices_of, oracle, proved_flipped};

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
            let mut scene = kind.scene(seed, n);
            if rng.chance(3) {
                scene.options = Options::with_inversion(inversion(&mut rng, &scene));
            }
            if is_wrong(&scene) {
                println!("wrong: {} with seed {seed}, {n} points", kind.name);
                report(shrink(scene));
                println!("{} tried, 1 wrong", scenes + 1);
                std::process::exit(1);
            }
            scenes += 1;
            points += n as u64;
        }
    }
    println!("{points} points in all");
    println!("{scenes} tried, 0 wrong");
}

fn argument(name: &str) -> Option<String> {
    std::env::args().skip_while(|arg| arg != name).nth(1)
}

/// Any inversion for small scenes, mild ones where certificates have to follow.
fn inversion(rng: &mut Rng, scene: &Scene) -> Inversion {
    if scene.points.len() >= 30 {
        return Inversion::Power(rng.between(1.001, 2.0));
    }
    let farthest = farthest(&scene.points, scene.viewpoint).max(1e-300);
    match rng.below(4) {
        0 => Inversion::Power(rng.between(1.0001, 16.0)),
        1 => Inversion::Power(2.0),
        2 => Inversion::Exponential(Exponential::Auto),
        _ => {
            let times = 10f64.powf(rng.between(-8.0, 3.0));
            Inversion::Exponential(Exponential::Scale(farthest * times))
        }
    }
}

fn expected(scene: &Scene, answer: &Visibility) -> Vec<bool> {
    let flip = |&p: &[f64; 3]| flip_as(p, scene.viewpoint, answer);
    let flipped: Vec<_> = scene.points.iter().map(flip).collect();
    if scene.points.len() < 30 {
        oracle::visible_flipped(&flipped)
    } else {
        proved_flipped(&flipped)
    }
}

fn is_wrong(scene: &Scene) -> bool {
    let answer = ask(&scene.points, scene.viewpoint, &scene.options);
    answer.indices() != indices_of(&expected(scene, &answer))
}

/// Leaves out points, in ever smaller runs, while the answer stays wrong.
fn shrink(mut scene: Scene) -> Scene {
    let answer = ask(&scene.points, scene.viewpoint, &scene.options);
    let inversion = answer.inversion();
    scene.options = Options::with_inversion(inversion);
    if !matches!(inversion, Inversion::Exponential(_)) {
        scene.options.radius = Radius::Absolute(answer.radius());
    }
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
    println!("expected {:?}", indices_of(&expected(&scene, &answer)));
}
