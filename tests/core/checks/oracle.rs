//! Mostly small and degenerate clouds of every kind under every inversion, compared with the definition. Every second
//! cloud is also asked for a consequence of it (`Aspect`).

use hidden_point_removal::{Exponential, Inversion, Options, PointCloud, Visibility};

use super::aspects::Aspect;
use crate::common::definition;
use crate::common::degenerate::DEGENERATE;
use crate::common::flip::{farthest, flip_as};
use crate::common::indices_of;
use crate::common::rng::Rng;
use crate::common::scenes::{EXTREME, KINDS, Scene};

/// The most points of a cloud that only the enumeration can decide.
const FEW: usize = 9;
/// Of this many clouds that certificates decide, the enumeration decides one, too.
const CROSS_CHECKS: usize = 50;

pub fn subject(rng: &mut Rng) -> (&'static str, Scene) {
    let kinds = [DEGENERATE, KINDS, KINDS, EXTREME];
    let large = rng.chance(200);
    let kind = rng.pick(&if large { [KINDS; 4] } else { kinds });
    let kind = &kind[rng.below(kind.len())];
    let n = match rng.below(10) {
        _ if large => 100 + rng.below(1000),
        0..6 => rng.below(13),
        6..9 => 10 + rng.below(12),
        _ => 20 + rng.below(21),
    };
    let mut scene = kind.scene(rng.bits(), n);
    if rng.chance(3) {
        scene.options = Options::inversion(inversion(rng, &scene));
    }
    let cloud = PointCloud::new(&scene.points).expect("an acceptable cloud");
    let answer = cloud.visible_from(scene.viewpoint, &scene.options);
    if !answer.is_ok_and(|answer| definition::has_certificates(&flipped(&scene, &answer))) {
        scene.points.truncate(FEW);
    }
    (kind.name, scene)
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

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let answer = match PointCloud::new(&scene.points)
        .and_then(|cloud| cloud.visible_from(scene.viewpoint, &scene.options))
    {
        Ok(answer) => answer,
        // Radii for extreme distances, and given radii that are too small for them.
        Err(error) if error.code() == "radius" => return Ok(()),
        Err(error) => return Err(format!("refused: {error}")),
    };
    let flipped = flipped(scene, &answer);
    let expected = definition::visible(&flipped);
    super::same("answer", answer.indices(), &indices_of(&expected)[..])?;
    if rng.chance(CROSS_CHECKS) {
        let otherwise = definition::visible_otherwise(&flipped);
        if otherwise.is_some_and(|otherwise| otherwise != expected) {
            return Err("certificates and enumeration disagree".to_string());
        }
    }
    let aspect = rng.below(2 * Aspect::ALL.len());
    let more = Aspect::ALL
        .get(aspect)
        .and_then(|aspect| aspect.check(scene, &answer, &expected, rng));
    more.unwrap_or(Ok(()))
}
