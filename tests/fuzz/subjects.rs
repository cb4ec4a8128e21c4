//! Large clouds to walk through: scanned clouds of npm packages (run
//! `npm ci --ignore-scripts` first) and generated clouds.

use hidden_point_removal::PointCloud;

use super::common::rng::Rng;
use super::common::shapes::{self, Points};
use super::scans;

pub struct Subject {
    pub name: &'static str,
    pub points: Points,
    pub cloud: PointCloud,
}

/// One of twelve clouds. Each call builds its cloud again, so that only one is in memory.
pub fn any(rng: &mut Rng) -> Subject {
    let makers: [fn() -> Subject; 12] = [
        || scan("dragon", &scans::dragon("dragon_vrip")),
        || scan("dragon_res2", &scans::dragon("dragon_vrip_res2")),
        || scan("dragon_res3", &scans::dragon("dragon_vrip_res3")),
        || scan("dragon_res4", &scans::dragon("dragon_vrip_res4")),
        || scan("bunny", &scans::bunny()),
        || generated("room", |rng| shapes::room(rng, 30_000)),
        || generated("bumpy", |rng| shapes::bumpy(rng, 20_000)),
        || generated("ball", |rng| shapes::ball(rng, 5_000)),
        || generated("georeferenced, uneven", georeferenced),
        || generated("block of a lattice", lattice),
        || generated("terrain with holes", terrain),
        || generated("duplicates", |rng| shapes::duplicates(rng, 9_000)),
    ];
    // Smaller clouds come more often, because their views cost less.
    let mut number = rng.below(makers.len());
    if number < 2 && !rng.chance(3) {
        number += 2;
    }
    makers[number]()
}

fn scan(name: &'static str, points: &[[f32; 3]]) -> Subject {
    Subject {
        name,
        points: points.iter().map(|p| p.map(f64::from)).collect(),
        cloud: PointCloud::new(points).expect("an acceptable cloud"),
    }
}

fn generated(name: &'static str, shape: fn(&mut Rng) -> Points) -> Subject {
    let points = shape(&mut Rng::new(1));
    Subject {
        name,
        cloud: PointCloud::new(&points).expect("an acceptable cloud"),
        points,
    }
}

/// A surface in map coordinates, rounded to millimeters, much denser on one side.
fn georeferenced(rng: &mut Rng) -> Points {
    let place = [523_000.0, 4_657_000.0, 120.0];
    let points = shapes::bumpy(rng, 40_000).into_iter();
    let kept = points.filter(|p| rng.unit() < (1.1 + p[0]) * (1.1 + p[0]) * 0.25);
    kept.map(|p| core::array::from_fn(|i| place[i] + (p[i] * 20_000.0).round() / 1000.0))
        .collect()
}

/// A block of a lattice. It has planes, lines and spheres of points everywhere.
fn lattice(_: &mut Rng) -> Points {
    (0..17 * 17 * 17)
        .map(|i| [i % 17, i / 17 % 17, i / 289].map(f64::from))
        .collect()
}

/// Heights over a regular grid. Some heights are missing.
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
