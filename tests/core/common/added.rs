//! Points that are not in the cloud, compared with a cloud that has them.

use hidden_point_removal::{Error, Exponential, Inversion, Options, PointCloud, Radius};

use super::flip::distance;
use super::rng::Rng;
use super::scenes::Scene;

/// The answer by definition: that of a cloud with the point more, with the radius and the inversion
/// of the view without it.
pub fn by_definition(
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
pub fn places(rng: &mut Rng, scene: &Scene, count: usize) -> Vec<[f64; 3]> {
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

pub fn check(scene: &Scene, options: &Options, places: &[[f64; 3]], title: &str) {
    let cloud = PointCloud::new(&scene.points).unwrap();
    for &place in places {
        let found = cloud.sees(scene.viewpoint, &[place], options);
        let expected = by_definition(&scene.points, place, scene.viewpoint, options);
        // The unit S of a power cannot be given for a point beyond it.
        let is_power = matches!(options.inversion, Inversion::Power(_));
        if is_power && matches!(expected, Err(Error::Radius { .. })) {
            continue;
        }
        // A cloud that cannot be viewed itself is refused before the point is looked at.
        if cloud.visible_from(scene.viewpoint, options).is_ok() || found.is_ok() {
            let found = found.map(|seen| seen[0]);
            assert_eq!(
                found,
                expected,
                "{title}: {place:?} from {:?} with {options:?} and {} points",
                scene.viewpoint,
                scene.points.len()
            );
        }
    }
    let answers = cloud.sees(scene.viewpoint, places, options);
    if let Ok(answers) = answers {
        for (&place, seen) in places.iter().zip(answers) {
            let alone = cloud.sees(scene.viewpoint, &[place], options);
            assert_eq!(alone, Ok(vec![seen]), "{title}: a row of places");
        }
    }
}

pub fn choices(scene: &Scene) -> [Options; 5] {
    [
        scene.options,
        Options::default(),
        Options::exponent(0.5),
        Options::inversion(Inversion::Exponential(Exponential::Auto)),
        Options::inversion(Inversion::Power(1.7)),
    ]
}
