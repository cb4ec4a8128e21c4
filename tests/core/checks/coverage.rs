//! Many viewpoints and cameras: the counts of single views, and the greedy choice without any shortcut.

use hidden_point_removal::{Convention, Error, Options, Placing, PointCloud, Seat, Visibility};

use super::{options, same};
use crate::common::cameras::camera;
use crate::common::cloud_of;
use crate::common::placing::{best, eager};
use crate::common::rng::Rng;
use crate::common::scenes::Scene;
use crate::common::structured;

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let cloud = cloud_of(&scene.points, rng.chance(2));
    let options = options(scene, rng);
    let mut places: Vec<Seat> = (0..rng.below(9))
        .map(|_| {
            let place = structured::viewpoint(rng, &scene.points);
            let ahead = rng.direction();
            match rng.chance(3) {
                true => camera(rng, place, ahead, Convention::OpenCv).into(),
                false => place.into(),
            }
        })
        .collect();
    places.push(scene.viewpoint.into());
    if rng.chance(2) {
        // Equal candidates tie.
        let again = rng.pick(&places);
        places.insert(rng.below(places.len()), again);
    }
    let refusal = places
        .iter()
        .find_map(|place| view(&cloud, place, &options).err());
    let counts = cloud.coverage(&places, &options);
    let least = 1 + rng.below(places.len());
    let several = match least {
        1 if rng.chance(2) => cloud.visible_from_any(&places, &options),
        _ => cloud.visible_from_at_least(least, &places, &options),
    };
    let several = several.map(Visibility::into_indices);
    if refusal.is_some() {
        same("refusal", several.err(), refusal)?;
        return same("refusal", counts.err(), refusal);
    }
    let views = places.iter().map(|place| view(&cloud, place, &options));
    let masks = views.collect::<Result<Vec<_>, _>>();
    let masks = masks.map_err(|error| error.to_string())?;
    let count = |k: usize| masks.iter().filter(|mask| mask[k]).count();
    let expected: Vec<u32> = (0..cloud.len()).map(|k| count(k) as u32).collect();
    let seen = (0..cloud.len() as u32).filter(|&k| expected[k as usize] as usize >= least);
    same("at least", several, Ok(seen.collect()))?;
    same("coverage", counts, Ok(expected))?;
    placement(&cloud, &places, &masks, &options, rng)
}

fn view(cloud: &PointCloud, seat: &Seat, options: &Options) -> Result<Vec<bool>, Error> {
    let seen = match seat {
        Seat::Viewpoint(place) => cloud.visible_from(*place, options)?,
        Seat::Camera(camera) => cloud.visible_from_camera(camera, options)?.visibility,
    };
    Ok(seen.mask().iter().map(|&byte| byte == 1).collect())
}

fn placement(
    cloud: &PointCloud,
    places: &[Seat],
    masks: &[Vec<bool>],
    options: &Options,
    rng: &mut Rng,
) -> Result<(), String> {
    let n = cloud.len() as u32;
    let weights: Vec<f64> = match rng.below(4) {
        0 => vec![1.0; n as usize],
        1 => (0..n).map(|_| f64::from(rng.integer(0, 3)) * 0.1).collect(),
        2 => (0..n).map(|_| rng.unit()).collect(),
        // Sums of such weights round, and small ones vanish.
        _ => (0..n).map(|_| 10f64.powi(rng.integer(-20, 20))).collect(),
    };
    let count = 1 + rng.below(4);
    let placing = Placing {
        count: Some(count),
        weights: Some(&weights),
        ..Placing::default()
    };
    let placed = cloud
        .place_viewpoints(places, options, &placing)
        .map_err(|error| error.to_string())?;
    let (chosen, gains) = eager(masks, &weights, count);
    same("chosen", &placed.chosen, &chosen)?;
    same("gains", &placed.gains, &gains)?;
    let sees = |k: usize, index: u32| masks[k][index as usize];
    let seen = (0..n).filter(|&index| chosen.iter().any(|&k| sees(k, index)));
    same("seen", placed.seen, seen.collect())?;
    let unseen = (0..n).filter(|&index| (0..masks.len()).all(|k| !sees(k, index)));
    same("unseen", placed.unseen, unseen.collect())?;
    let (got, most) = (gains.iter().sum::<f64>(), best(masks, &weights, count));
    let bound = 1.0 - (-1.0f64).exp();
    if got < bound * most * (1.0 - 1e-9) {
        return Err(format!("{count} viewpoints see {got} of {most}"));
    }
    Ok(())
}
