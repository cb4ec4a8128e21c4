//! Mostly small and degenerate clouds of every kind under every inversion, compared with the definition. Others are also
//! merged from parts, or seen along an axis.

use hidden_point_removal::{
    Exponential, Inversion, Options, PointCloud, Radius, Visibility, merge_visible,
};

use super::same;
use crate::common::degenerate::DEGENERATE;
use crate::common::flip::{farthest, flip_as};
use crate::common::rng::Rng;
use crate::common::scenes::{EXTREME, KINDS, Scene};
use crate::common::{definition, indices_of, lower};

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
    let expected_indices = indices_of(&expected);
    same("answer", answer.indices(), &expected_indices[..])?;
    if rng.chance(CROSS_CHECKS) {
        let otherwise = definition::visible_otherwise(&flipped);
        if otherwise.is_some_and(|otherwise| otherwise != expected) {
            return Err("certificates and enumeration disagree".to_string());
        }
    }
    let (title, both) = match rng.below(12) {
        0 => {
            let found = merged(scene, &answer, rng);
            ("merged", found.map(|found| (found, expected_indices)))
        }
        1 => ("along an axis", along_axis(scene, rng)),
        _ => return Ok(()),
    };
    both.map_or(Ok(()), |(found, expected)| same(title, found, expected))
}

/// The visible points of parts, and some other points, merged. `None` if all points are at the viewpoint.
fn merged(scene: &Scene, answer: &Visibility, rng: &mut Rng) -> Option<Vec<u32>> {
    let inversion = answer.inversion();
    let mut options = Options::inversion(inversion);
    if !matches!(inversion, Inversion::Exponential(_)) {
        if answer.radius() == 0.0 {
            return None;
        }
        options.radius = Radius::Absolute(answer.radius());
    }
    let mut parts = vec![(Vec::new(), Vec::new()); 1 + rng.below(4)];
    for (id, &point) in (0..).zip(&scene.points) {
        loop {
            let part = rng.below(parts.len());
            parts[part].0.push(point);
            parts[part].1.push(id);
            if !rng.chance(6) {
                break;
            }
        }
    }
    // Each part leaves out all or some of its hidden points.
    let keeps_some = rng.chance(2);
    for (positions, ids) in &mut parts {
        let cloud = PointCloud::new(positions).expect("an acceptable part");
        let mask = cloud
            .visible_from(scene.viewpoint, &options)
            .expect("an acceptable view of a part")
            .mask();
        let kept = |&k: &usize| mask[k] == 1 || keeps_some && rng.chance(3);
        let kept: Vec<usize> = (0..ids.len()).filter(kept).collect();
        *positions = kept.iter().map(|&k| positions[k]).collect();
        *ids = kept.iter().map(|&k| ids[k]).collect();
    }
    let parts: Vec<_> = parts.iter().map(|(p, ids)| (&p[..], &ids[..])).collect();
    Some(merge_visible(&parts, scene.viewpoint, &options).expect("parts that merge"))
}

/// The lower boundary of the lifted points, in integers: nothing rounds.
fn along_axis(scene: &Scene, rng: &mut Rng) -> Option<(Vec<u32>, Vec<u32>)> {
    const MOST: usize = 14;
    let is_small = |x: &f64| x.fract() == 0.0 && x.abs() < 1000.0;
    if scene.points.len() > MOST || !scene.points.iter().flatten().all(is_small) {
        return None;
    }
    let (axis, sign) = (rng.below(3), if rng.chance(2) { 1 } else { -1 });
    let bend = rng.pick(&[1i64, 2, 4]);
    let mut direction = [0.0; 3];
    direction[axis] = 2.5 * sign as f64;
    let lifted: Vec<[i64; 3]> = scene
        .points
        .iter()
        .map(|p| {
            let p = p.map(|x| x as i64);
            let [x, y] = [p[(axis + 1) % 3], p[(axis + 2) % 3]];
            [x, y, sign * p[axis] + bend * (x * x + y * y)]
        })
        .collect();
    let scale = Exponential::Scale(0.5 / bend as f64);
    let options = Options::inversion(Inversion::Exponential(scale));
    let cloud = PointCloud::new(&scene.points).ok()?;
    let found = cloud.visible_from_direction(direction, &options).ok()?;
    Some((found.into_indices(), indices_of(&lower::visible(&lifted))))
}
