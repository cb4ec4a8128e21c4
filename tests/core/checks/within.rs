//! Points within limits: every answer is that of a cloud of these points alone.

use hidden_point_removal::{Inversion, Lighting, Options, PointCloud, Within};

use super::{options, same};
use crate::common::chosen::{alone, chosen, facts, only, some_choice};
use crate::common::cloud_of;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let Scene {
        points, viewpoint, ..
    } = scene;
    let mut plain = options(scene, rng).with_within(None);
    plain.scores = matches!(plain.inversion, Inversion::Looks(_));
    let within = some_choice(rng, scene);
    let options = only(within, &plain);
    let mut cloud = cloud_of(points, rng.chance(2));
    if rng.chance(2)
        && let Err(refusal) = cloud.prepare_for(&options)
    {
        let view = cloud.visible_from(*viewpoint, &options);
        return same("refusal", view.err(), Some(refusal));
    }
    let single = |place: [f64; 3]| {
        let near = chosen(points, &within, Some(place));
        facts(
            alone(points, &near).visible_from(place, &plain),
            Some(&near),
        )
    };
    let expected = single(*viewpoint);
    let title = |how: &str| format!("{how} {within:?} with {plain:?}");
    let found = facts(cloud.visible_from(*viewpoint, &options), None);
    same(&title("view"), found, expected.clone())?;

    let near = chosen(points, &within, Some(*viewpoint));
    let mut mask = vec![false; points.len()];
    near.iter().for_each(|&i| mask[i as usize] = true);
    let masked = cloud.masked(&mask).map_err(|error| error.to_string())?;
    let found = facts(masked.visible_from(*viewpoint, &plain), None);
    same(&title("mask"), found, expected.clone())?;

    let mut observer = cloud.observer();
    let mut place = *viewpoint;
    for _ in 0..3 {
        let found = facts(observer.visible_from(place, &options), None);
        same(&title("observer"), found, single(place))?;
        place = place.map(|x| x + 1e-3 * rng.between(-1.0, 1.0));
    }
    if expected.is_err() {
        return Ok(());
    }
    let shared = options.with_threads(2 + rng.below(3));
    let shared = facts(cloud.visible_from(*viewpoint, &shared), None);
    same(&title("threads"), shared, expected)?;
    let part = alone(points, &near);
    if within.distance.is_none() {
        let ahead = rng.direction();
        let found = cloud.visible_from_direction(ahead, &options);
        let expected = part.visible_from_direction(ahead, &plain);
        let expected = facts(expected, Some(&near));
        same(&title("direction"), facts(found, None), expected)?;
    }
    if plain.scores {
        return Ok(());
    }
    let mesh = cloud.reconstruct(*viewpoint, &options, None);
    let expected = part.reconstruct(*viewpoint, &plain, None).map(|mesh| {
        let corners = mesh.triangles.iter().flatten();
        corners.map(|&k| near[k as usize]).collect::<Vec<_>>()
    });
    let mesh = mesh.map(|mesh| mesh.triangles.into_flattened());
    same(&title("mesh"), mesh, expected)?;
    let light = cloud.illuminate(&[*viewpoint], &options, &Lighting::default());
    let own = light.map(|light| near.iter().map(|&i| light[i as usize]).collect());
    let expected = part.illuminate(&[*viewpoint], &plain, &Lighting::default());
    if within.distance.is_none() {
        same(&title("light"), own, expected)?;
    }
    several(&cloud, scene, &within, &plain, rng)
}

/// Points that at least two of three viewpoints see. Each viewpoint has its own points.
fn several(
    cloud: &PointCloud,
    scene: &Scene,
    within: &Within,
    plain: &Options,
    rng: &mut Rng,
) -> Result<(), String> {
    let places: [[f64; 3]; 3] = core::array::from_fn(|_| {
        let nudge = rng.direction();
        core::array::from_fn(|i| scene.viewpoint[i] + nudge[i].round())
    });
    let mut counts = vec![0; scene.points.len()];
    for place in places {
        let near = chosen(&scene.points, within, Some(place));
        let Ok(seen) = alone(&scene.points, &near).visible_from(place, plain) else {
            return Ok(());
        };
        for &k in seen.indices() {
            counts[near[k as usize] as usize] += 1;
        }
    }
    let options = only(*within, plain);
    let counted = cloud.coverage(&places, &options);
    same("coverage", counted, Ok(counts.clone()))?;
    let lighting = Lighting {
        smoothing: 0,
        ..Lighting::default()
    };
    let light = cloud.illuminate(&places, &options, &lighting);
    let shares = counts.iter().map(|&count| (f64::from(count) / 3.0) as f32);
    same("light", light, Ok(shares.collect()))?;
    let found = cloud.visible_from_at_least(2, &places, &options);
    let twice = (0u32..).zip(&counts).filter(|(_, count)| **count >= 2);
    same(
        "at least two",
        found.map(|seen| seen.into_indices()),
        Ok(twice.map(|(index, _)| index).collect()),
    )
}
