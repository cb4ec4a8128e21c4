//! Moving viewpoints, each answer compared with that of a view that starts anew:
//! `cargo run --profile fuzz --example fuzz_motion -- --minutes 5 [--seed N]`,
//! or `--views 10000` for a number of views.
//!
//! Walks around, in and through scanned and generated clouds, by steps of all sizes
//! and with every choice of the radius. A wrong answer is printed with what repeats it,
//! and ends the run with status 1.

use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use hidden_point_removal::{Options, PointCloud};

#[path = "../core/common/mod.rs"]
mod common;
#[path = "../core/common/scans.rs"]
mod scans;

use common::rng::Rng;
use common::shapes::{self, Points};
use common::walk::{Walk, difference};

/// Views before the walk starts again somewhere else.
const WALK: usize = 50;

struct Subject {
    name: &'static str,
    points: Points,
    cloud: PointCloud,
    /// Views, or seconds, out of a hundred.
    share: usize,
}

fn main() {
    // Either of the two ends a cloud's walks.
    let views: Option<usize> = argument("--views").map(|x| x.parse().expect("a number"));
    let default = if views.is_some() { 1e6 } else { 1.0 };
    let minutes: f64 = argument("--minutes").map_or(default, |x| x.parse().expect("a number"));
    let now = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .expect("a clock");
    let seed: u64 = argument("--seed").map_or(now.as_secs(), |x| x.parse().expect("a number"));
    println!("seed {seed}");
    let mut tried = 0;
    for subject in subjects() {
        let share = subject.share as f64 / 100.0;
        let end = Instant::now() + Duration::from_secs_f64(minutes * 60.0 * share);
        let views = views.map_or(usize::MAX, |views| views * subject.share / 100);
        let mut rng = Rng::new(seed);
        let (mut done, mut warm) = (0, 0);
        while done < views && Instant::now() < end {
            let last = views.min(done.saturating_add(WALK));
            warm += walk(&subject, &mut rng, done..last);
            done = last;
        }
        println!(
            "{} ({} points): {done} views, {warm} of them warm, wrong 0",
            subject.name,
            subject.points.len()
        );
        tried += done;
    }
    println!("{tried} tried, 0 wrong");
}

fn argument(name: &str) -> Option<String> {
    std::env::args().skip_while(|arg| arg != name).nth(1)
}

/// Compares the views of these numbers; returns how many were found from the last.
fn walk(subject: &Subject, rng: &mut Rng, views: std::ops::Range<usize>) -> usize {
    let mut observer = subject.cloud.observer();
    let mut walk = Walk::new(&subject.points, [0.0; 3], Options::default());
    walk.viewpoint = walk.place(rng, 3.0);
    let mut warm = 0;
    for view in views {
        let before = walk.viewpoint;
        walk.step(rng);
        let (viewpoint, options) = (walk.viewpoint, &walk.options);
        let different = difference(&subject.cloud, &mut observer, viewpoint, options);
        if let Some(different) = different {
            println!(
                "wrong: {}, view {view}, from {before:?} to {viewpoint:?} with {options:?}",
                subject.name
            );
            println!("{different}\n{} tried, 1 wrong", view + 1);
            std::process::exit(1);
        }
        warm += usize::from(observer.moved());
    }
    warm
}

/// One at a time, so that only one is in memory.
fn subjects() -> impl Iterator<Item = Subject> {
    let makers: [fn() -> Subject; 12] = [
        || scan("dragon", 3, &scans::dragon("dragon_vrip")),
        || scan("dragon_res2", 7, &scans::dragon("dragon_vrip_res2")),
        || scan("dragon_res3", 10, &scans::dragon("dragon_vrip_res3")),
        || scan("dragon_res4", 12, &scans::dragon("dragon_vrip_res4")),
        || scan("bunny", 12, &scans::bunny()),
        || generated("room", 10, |rng| shapes::room(rng, 30_000)),
        || generated("bumpy", 10, |rng| shapes::bumpy(rng, 20_000)),
        || generated("ball", 8, |rng| shapes::ball(rng, 5_000)),
        || generated("georeferenced, uneven", 10, georeferenced),
        || generated("grid", 8, grid),
        || generated("terrain with holes", 5, terrain),
        || generated("duplicates", 5, |rng| shapes::duplicates(rng, 9_000)),
    ];
    makers.into_iter().map(|make| make())
}

fn scan(name: &'static str, share: usize, points: &[[f32; 3]]) -> Subject {
    Subject {
        name,
        points: points.iter().map(|p| p.map(f64::from)).collect(),
        cloud: PointCloud::new(points).expect("an acceptable cloud"),
        share,
    }
}

fn generated(name: &'static str, share: usize, shape: fn(&mut Rng) -> Points) -> Subject {
    let points = shape(&mut Rng::new(1));
    Subject {
        name,
        cloud: PointCloud::new(&points).expect("an acceptable cloud"),
        points,
        share,
    }
}

/// A surface in map coordinates, to millimeters, much denser to one side.
fn georeferenced(rng: &mut Rng) -> Points {
    let place = [523_000.0, 4_657_000.0, 120.0];
    let points = shapes::bumpy(rng, 40_000).into_iter();
    let kept = points.filter(|p| rng.unit() < (1.1 + p[0]) * (1.1 + p[0]) * 0.25);
    kept.map(|p| core::array::from_fn(|i| place[i] + (p[i] * 20_000.0).round() / 1000.0))
        .collect()
}

/// A block of a lattice: planes, lines and spheres of points everywhere.
fn grid(_: &mut Rng) -> Points {
    (0..17 * 17 * 17)
        .map(|i| [i % 17, i / 17 % 17, i / 289].map(f64::from))
        .collect()
}

/// Heights over a regular grid, some missing.
fn terrain(rng: &mut Rng) -> Points {
    let mut points = Points::new();
    for i in 0..20_000 {
        let (x, y) = (f64::from(i % 160) * 0.1, f64::from(i / 160) * 0.1);
        if !rng.chance(5) {
            let rise = (x - 8.0) * (y - 6.0) * 0.02;
            points.push([x, y, rise * rise + 0.01 * rng.unit()]);
        }
    }
    points
}
