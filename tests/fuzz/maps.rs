//! Tests visible points against maps of directions:
//! `cargo run --profile fuzz --package hpr-tests --bin fuzz_maps -- --minutes 5 [--seed N]`
//!
//! No map of a viewpoint hides a point that is visible from there with the same options, whatever its
//! size, its directions and its origin are, and whatever was asked before. Viewpoints walk around, in
//! and through clouds of every kind. Each visible point that is tested against a map counts. `run`
//! explains the output.

use hidden_point_removal::{Error, MapOptions, Options, PointCloud};

#[path = "../core/common/mod.rs"]
mod common;
#[allow(dead_code)]
mod run;

use common::rng::Rng;
use common::shapes::{self, Points};
use common::walk::Walk;
use common::walked::{inversion, subject};
use run::Run;

/// The number of views of one cloud, and of maps of one view.
const WALK: usize = 6;
const MAPS: usize = 6;

fn main() {
    let mut run = Run::start();
    while run.goes_on() {
        let rng = &mut run.rng;
        let (name, mut points, mut viewpoint) = any_subject(rng);
        if rng.chance(4) {
            for place in points.iter_mut().chain([&mut viewpoint]) {
                for (x, by) in place.iter_mut().zip([452_000.0, 5_411_000.0, 300.0]) {
                    *x += by;
                }
            }
        }
        let cloud = if rng.chance(2) {
            PointCloud::new(&points)
        } else {
            let single: Vec<[f32; 3]> = points.iter().map(|p| p.map(|x| x as f32)).collect();
            points = single.iter().map(|p| p.map(f64::from)).collect();
            PointCloud::new(&single)
        };
        // Single precision may have no such numbers.
        let Ok(cloud) = cloud else { continue };
        let mut observer = cloud.observer();
        let mut walk = Walk::new(&points, viewpoint, Options::default());
        for _ in 0..WALK {
            let mut options = walk.options;
            if run.rng.chance(3) {
                options = Options::with_inversion(inversion(&mut run.rng));
            }
            let from = walk.viewpoint;
            let Ok(seen) = cloud.visible_from(from, &options) else {
                walk.step(&mut run.rng);
                continue;
            };
            let mask = seen.mask();
            let visible = points.iter().zip(&mask).filter(|&(_, &bit)| bit == 1);
            let visible: Points = visible.map(|(&point, _)| point).collect();
            for _ in 0..MAPS {
                let asked = size(&mut run.rng, from, &visible);
                let made = match observer.visibility_map(from, &options, &asked) {
                    Err(Error::Excludes { .. }) => break,
                    made => made,
                };
                let hidden = made.map(|map| visible.iter().find(|&&point| map.hides(point)));
                match hidden {
                    Ok(None) => run.count(name, visible.len() as u64),
                    fault => {
                        if run.count_wrong(name) {
                            let count = points.len();
                            println!(
                                "{name} ({count} points) from {from:?}, {options:?}, {asked:?}: {fault:?}"
                            );
                        }
                    }
                }
            }
            walk.step(&mut run.rng);
        }
    }
    run.finish();
}

/// Half of the clouds are large: of these, many more points can be tested in the same time.
fn any_subject(rng: &mut Rng) -> (&'static str, Points, [f64; 3]) {
    if rng.chance(2) {
        return subject(rng);
    }
    let n = 20_000 + rng.below(100_000);
    let place = rng.in_ball();
    match rng.below(3) {
        0 => ("large bumpy", shapes::bumpy(rng, n), place.map(|x| x * 5.0)),
        1 => ("large room", shapes::room(rng, n), place.map(|x| x * 3.0)),
        _ => (
            "large lattice",
            shapes::grid(rng, n),
            place.map(|x| x * 40.0),
        ),
    }
}

/// Any size, any directions, and one origin of three.
fn size(rng: &mut Rng, from: [f64; 3], visible: &[[f64; 3]]) -> MapOptions {
    let mut asked = MapOptions {
        points: 16 << rng.below(11),
        corners: 64 << rng.below(13),
        ..MapOptions::default()
    };
    if rng.chance(3) {
        asked.towards = Some((rng.direction(), rng.between(1.0, 360.0)));
    }
    match rng.below(3) {
        0 => asked.origin = Some(from),
        1 if !visible.is_empty() => asked.origin = Some(rng.pick(visible)),
        _ => {}
    }
    asked
}
