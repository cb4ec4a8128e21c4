//! Compares answers for small clouds with the definition:
//! `cargo run --profile fuzz --package hpr-tests --bin fuzz_oracle -- --minutes 5 [--seed N] [--kind TEXT]`
//!
//! Mostly degenerate clouds of every kind under every inversion. Each cloud is asked for its
//! visible points, and every second cloud also for a consequence of them (`Aspect`). `run`
//! explains the output.

use hidden_point_removal::{Exponential, Inversion, Options, PointCloud, Visibility};

mod aspects;
#[path = "../core/common/mod.rs"]
mod common;
mod run;
mod shrink;

use aspects::Aspect;
use common::definition;
use common::degenerate::DEGENERATE;
use common::flip::{farthest, flip_as};
use common::indices_of;
use common::rng::Rng;
use common::scenes::{EXTREME, KINDS, Kind, Scene};
use run::{Run, argument, checked, literal};
use shrink::shrink;

/// The most points of a cloud that only the enumeration can decide.
const FEW: usize = 9;
/// Of this many clouds that certificates decide, the enumeration decides one, too.
const CROSS_CHECKS: u64 = 50;

fn main() {
    let wanted = argument("--kind").unwrap_or_default();
    let mut run = Run::start();
    let mut aspects = [0u64; Aspect::ALL.len()];
    let mut points = 0;
    let kinds: Vec<&Kind> = [DEGENERATE, KINDS, EXTREME]
        .into_iter()
        .flatten()
        .filter(|kind| kind.name.contains(&wanted))
        .collect();
    while run.goes_on() {
        for kind in &kinds {
            let rng = &mut run.rng;
            let n = match rng.below(10) {
                0..6 => rng.below(13),
                6..9 => 10 + rng.below(12),
                _ => 20 + rng.below(21),
            };
            let mut scene = kind.scene(rng.bits(), n);
            if rng.chance(3) {
                scene.options = Options::with_inversion(inversion(rng, &scene));
            }
            if !has_certificates(&scene) {
                scene.points.truncate(FEW);
            }
            let aspect = rng.below(2 * Aspect::ALL.len());
            let (aspect, seed) = (Aspect::ALL.get(aspect).copied(), rng.bits());
            points += scene.points.len();
            let wrong = match checked(|| check(&scene, aspect, seed)) {
                Ok(Asked::Nothing) => continue,
                Ok(asked) => {
                    run.count(kind.name, 1);
                    if let (Asked::More, Some(aspect)) = (asked, aspect) {
                        aspects[aspect as usize] += 1;
                    }
                    continue;
                }
                Err(wrong) => wrong,
            };
            if run.count_wrong(kind.name) {
                println!("wrong: {}, {aspect:?} with seed {seed}: {wrong}", kind.name);
                let is_wrong = |scene: &Scene| checked(|| check(scene, aspect, seed)).is_err();
                scene.options = resolved(&scene);
                println!("{}", literal(&shrink(scene, is_wrong)));
            }
        }
    }
    println!("{points} points; asked for more:");
    for (aspect, count) in Aspect::ALL.iter().zip(aspects) {
        println!("  {aspect:?}: {count}");
    }
    run.finish();
}

fn inversion(rng: &mut Rng, scene: &Scene) -> Inversion {
    let farthest = farthest(&scene.points, scene.viewpoint).max(1e-300);
    match rng.below(5) {
        0 => Inversion::Power(rng.between(1.0001, 16.0)),
        1 => Inversion::Power(rng.between(1.001, 2.0)),
        2 => Inversion::Power(rng.pick(&[2.0, 3.0, 16.0])),
        3 => Inversion::Exponential(Exponential::Auto),
        _ => {
            let times = 10f64.powf(rng.between(-8.0, 3.0));
            Inversion::Exponential(Exponential::Scale(farthest * times))
        }
    }
}

fn flipped(scene: &Scene, answer: &Visibility) -> Vec<Option<[f64; 3]>> {
    let flip = |&p: &[f64; 3]| flip_as(p, scene.viewpoint, answer);
    scene.points.iter().map(flip).collect()
}

fn asked(scene: &Scene) -> Option<Visibility> {
    let cloud = PointCloud::new(&scene.points).ok()?;
    cloud.visible_from(scene.viewpoint, &scene.options).ok()
}

fn has_certificates(scene: &Scene) -> bool {
    let answer = std::panic::catch_unwind(|| asked(scene)).ok().flatten();
    answer.is_some_and(|answer| definition::has_certificates(&flipped(scene, &answer)))
}

/// Options with the numbers of the whole cloud's answer, so that a part of the cloud is asked
/// with the same numbers.
fn resolved(scene: &Scene) -> Options {
    let answer = std::panic::catch_unwind(|| asked(scene)).ok().flatten();
    answer.map_or(scene.options, |answer| aspects::given(&answer))
}

/// The question that a scene was asked.
enum Asked {
    /// The scene was refused, and rightly so.
    Nothing,
    Visible,
    /// The scene was also asked for an aspect.
    More,
}

fn check(scene: &Scene, aspect: Option<Aspect>, seed: u64) -> Result<Asked, String> {
    let answer = match PointCloud::new(&scene.points)
        .and_then(|cloud| cloud.visible_from(scene.viewpoint, &scene.options))
    {
        Ok(answer) => answer,
        // Radii for extreme distances, and given radii that are too small for them.
        Err(error) if error.code() == "radius" => return Ok(Asked::Nothing),
        Err(error) => return Err(format!("refused: {error}")),
    };
    let flipped = flipped(scene, &answer);
    let expected = definition::visible(&flipped);
    if answer.indices() != indices_of(&expected) {
        let expected = indices_of(&expected);
        return Err(format!(
            "answered {:?}, expected {expected:?}",
            answer.indices()
        ));
    }
    if seed % CROSS_CHECKS == 0 {
        let otherwise = definition::visible_otherwise(&flipped);
        if otherwise.is_some_and(|otherwise| otherwise != expected) {
            return Err("certificates and enumeration disagree".to_string());
        }
    }
    let rng = &mut Rng::new(seed);
    let more = aspect.and_then(|aspect| aspect.check(scene, &answer, &expected, rng));
    more.map_or(Ok(Asked::Visible), |more| more.map(|()| Asked::More))
}
