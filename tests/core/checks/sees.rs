//! Points that are not in the cloud: the answer of a cloud with the point added.

use hidden_point_removal::{Error, Inversion, Options, PointCloud, Radius};

use super::{options, same};
use crate::common::cloud_of;
use crate::common::flip::distance;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let mut options = options(scene, rng);
    if let Inversion::Spherical = options.inversion
        && rng.chance(4)
    {
        let radius = rng.pick(&[Radius::Auto, Radius::Exponent(2.0), Radius::Exponent(7.0)]);
        options = options.with_radius(radius);
    }
    let mut cloud = cloud_of(&scene.points, rng.chance(2));
    if rng.chance(2) {
        let gone = cloud.len() as u32;
        cloud.append(&[rng.in_ball()]).expect("a point");
        cloud.remove(&[gone]).expect("its index");
    }
    let places = places(rng, scene, 5);
    let row = cloud.sees(scene.viewpoint, &places, &options);
    for (k, &place) in places.iter().enumerate() {
        let title = format!("{place:?} from {:?} with {options:?}", scene.viewpoint);
        let found = cloud.sees(scene.viewpoint, &[place], &options);
        if let Ok(row) = &row {
            same(&title, &found, &Ok(vec![row[k]]))?;
        }
        let single = place.map(|x| x as f32);
        if single.map(f64::from) == place {
            let narrow = cloud.sees(scene.viewpoint, &[single], &options);
            same(&title, &narrow, &found)?;
        }
        let expected = by_definition(&scene.points, place, scene.viewpoint, &options);
        // The unit S of a power cannot be given for a point beyond it.
        let is_power = matches!(options.inversion, Inversion::Power(_));
        if is_power && matches!(expected, Err(Error::Radius { .. })) {
            continue;
        }
        // A cloud that cannot be viewed itself is refused before the point is looked at.
        if cloud.visible_from(scene.viewpoint, &options).is_ok() || found.is_ok() {
            same(&title, found.map(|seen| seen[0]), expected)?;
        }
    }
    Ok(())
}

/// The answer by definition: that of a cloud with the point more, with the radius and the inversion
/// of the view without it.
fn by_definition(
    points: &[[f64; 3]],
    place: [f64; 3],
    viewpoint: [f64; 3],
    options: &Options,
) -> Result<bool, Error> {
    let mut part = PointCloud::new(points)?;
    let mut options = *options;
    if let Some(within) = options.within.take() {
        part = part.within(&within, viewpoint)?;
        let alone = PointCloud::new(&[place])?.within(&within, viewpoint)?;
        if alone.visible_from(viewpoint, &Options::default())?.count() == 0 {
            part.visible_from(viewpoint, &options)?;
            return Ok(false);
        }
    }
    let without = part.visible_from(viewpoint, &options)?;
    if !matches!(options.inversion, Inversion::Looks(_)) {
        options.inversion = without.inversion();
        let is_spherical = options.inversion == Inversion::Spherical;
        if is_spherical && distance(place, viewpoint) > without.radius() {
            return Ok(false);
        }
        if without.radius() > 0.0 {
            options.radius = Radius::Absolute(without.radius());
        }
    }
    part.append(&[place])?;
    let seen = part.visible_from(viewpoint, &options)?;
    Ok(seen.indices().last() == Some(&(points.len() as u32)))
}

/// Places that are hard to decide: points of the cloud, on their rays, between them, at the
/// viewpoint, beyond the cloud.
fn places(rng: &mut Rng, scene: &Scene, count: usize) -> Vec<[f64; 3]> {
    let (points, c) = (&scene.points, scene.viewpoint);
    let any = |rng: &mut Rng| {
        if points.is_empty() {
            rng.in_ball()
        } else {
            rng.pick(points)
        }
    };
    (0..count)
        .map(|_| {
            let [a, b] = [any(rng), any(rng)];
            let between = |t: f64, from: [f64; 3], to: [f64; 3]| {
                core::array::from_fn(|i| from[i] + (to[i] - from[i]) * t)
            };
            match rng.below(8) {
                0 => a,
                1 => c,
                2 => between(0.5, a, b),
                3 => between(rng.between(0.0, 1.0), a, b),
                4 => between(rng.between(0.5, 1.5), c, a),
                5 => between(2.0, c, a),
                6 => between(rng.between(-1.0, 3.0), a, b),
                _ => between(1.0 + 1e-9, c, a),
            }
        })
        .collect()
}
