//! Moving viewpoints. Each answer is compared with a cold answer, which starts from nothing:
//! `cargo run --profile fuzz --package hpr-tests --bin fuzz_motion -- --minutes 5 [--seed N]`
//!
//! The viewpoint walks around, in and through small clouds of every kind, under every inversion.
//! One cold answer in eight is compared with the definition, too. Then the viewpoint walks through
//! scanned and generated clouds of up to 437,645 points. Steps are of all sizes, along axes and
//! between places in the planes of points. `run` explains the output. "Warm" views started
//! from the view before.

use hidden_point_removal::{Observer, PointCloud};

#[path = "../core/common/mod.rs"]
mod common;
mod run;
#[path = "../core/common/scans.rs"]
mod scans;
mod subjects;

use common::degenerate::DEGENERATE;
use common::rng::Rng;
use common::scenes::{EXTREME, KINDS, Kind, Scene};
use common::walk::{Walk, difference};
use common::{definition, flip, indices_of, structured};
use run::{Run, checked, literal, options_literal};

/// The number of views before the walk starts again at another place.
const WALK: usize = 40;
/// The number of walks through small clouds for each walk through a large cloud.
const SMALL_WALKS: usize = 400;
/// Of this many cold answers of small clouds, one is compared with the definition.
const PROOFS: usize = 8;
/// The largest number of points of a small cloud.
const FEW: usize = 60;

fn main() {
    let mut run = Run::start();
    let kinds: Vec<&Kind> = [DEGENERATE, KINDS, EXTREME].into_iter().flatten().collect();
    let mut warm = 0;
    while run.goes_on() {
        for _ in 0..SMALL_WALKS {
            let kind = run.rng.pick(&kinds);
            let n = match run.rng.below(20) {
                0..14 => 4 + run.rng.below(50),
                14..19 => 40 + run.rng.below(300),
                _ => 2000 + run.rng.below(1500),
            };
            let mut scene = kind.scene(run.rng.bits(), n);
            let cloud = PointCloud::new(&scene.points).expect("an acceptable cloud");
            warm += walk_small(&mut run, kind.name, &cloud, &mut scene);
        }
        let subject = subjects::any(&mut run.rng);
        warm += walk_large(&mut run, &subject);
    }
    println!("{warm} views were warm");
    run.finish();
}

/// Returns how many views were warm.
fn walk_small(run: &mut Run, kind: &str, cloud: &PointCloud, scene: &mut Scene) -> u64 {
    let mut observer = cloud.observer();
    let mut path = Vec::new();
    let mut warm = 0;
    let points = scene.points.clone();
    let mut walk = Walk::new(&points, scene.viewpoint, scene.options);
    for _ in 0..WALK {
        let outcome = checked(|| view(cloud, &mut observer, scene, &mut run.rng));
        path.push((scene.viewpoint, options_literal(&scene.options)));
        if let Err(wrong) = outcome {
            if run.count_wrong(kind) {
                println!("wrong: {kind}, {wrong}");
                println!("// seen before: {path:?}");
                println!("{}", literal(scene));
            }
            return warm;
        }
        run.count(kind, 1);
        warm += u64::from(observer.moved());
        walk.viewpoint = scene.viewpoint;
        walk.options = scene.options;
        step(&mut run.rng, &mut walk, path[0].0);
        (scene.viewpoint, scene.options) = (walk.viewpoint, walk.options);
    }
    warm
}

/// Mostly a small step. Sometimes a step along an axis, back to the start of the walk, to a
/// place in the planes of the points, or to other options.
fn step(rng: &mut Rng, walk: &mut Walk, first: [f64; 3]) {
    match rng.below(16) {
        0 => walk.viewpoint = first,
        1 => walk.viewpoint = structured::viewpoint(rng, walk.points()),
        2..5 => {
            let nudge = rng.pick(&[1e-13, 1e-9, 1e-6, 1e-3, 0.125]);
            walk.viewpoint[rng.below(3)] += if rng.chance(2) { nudge } else { -nudge };
        }
        5 if rng.chance(3) => {
            walk.options = structured::options(rng, walk.points(), walk.viewpoint);
        }
        6 | 7 => walk.step(rng),
        _ => {
            let part = rng.pick(&[1e-12, 1e-8, 1e-5, 1e-3, 1e-2]);
            walk.viewpoint = walk.near(rng, part);
        }
    }
}

fn view(
    cloud: &PointCloud,
    observer: &mut Observer,
    scene: &Scene,
    rng: &mut Rng,
) -> Result<(), String> {
    let different = difference(cloud, observer, scene.viewpoint, &scene.options);
    different.map_or(Ok(()), Err)?;
    if scene.points.len() > FEW || !rng.chance(PROOFS) {
        return Ok(());
    }
    let Ok(answer) = cloud.visible_from(scene.viewpoint, &scene.options) else {
        return Ok(());
    };
    let flip = |&p: &[f64; 3]| flip::flip_as(p, scene.viewpoint, &answer);
    let flipped: Vec<_> = scene.points.iter().map(flip).collect();
    if !definition::has_certificates(&flipped) {
        return Ok(());
    }
    let expected = indices_of(&definition::visible(&flipped));
    if answer.indices() == expected {
        return Ok(());
    }
    let answered = answer.indices();
    Err(format!("answered {answered:?}, by definition {expected:?}"))
}

fn walk_large(run: &mut Run, subject: &subjects::Subject) -> u64 {
    let mut observer = subject.cloud.observer();
    let mut walk = Walk::new(&subject.points, [0.0; 3], Default::default());
    walk.viewpoint = walk.place(&mut run.rng, 3.0);
    let mut warm = 0;
    for _ in 0..WALK {
        let before = walk.viewpoint;
        walk.step(&mut run.rng);
        let (viewpoint, options) = (walk.viewpoint, walk.options);
        let cloud = &subject.cloud;
        let mut different = || difference(cloud, &mut observer, viewpoint, &options);
        if let Err(wrong) = checked(|| different().map_or(Ok(()), Err)) {
            if run.count_wrong(subject.name) {
                let options = options_literal(&options);
                println!(
                    "wrong: {} from {before:?} to {viewpoint:?}, {options}",
                    subject.name
                );
                println!("{wrong}");
            }
            return warm;
        }
        run.count(subject.name, 1);
        warm += u64::from(observer.moved());
    }
    warm
}
