//! No map of a viewpoint hides a point that is visible from there with the same options, whatever its size, its
//! directions and its origin are, and whatever was asked before. The viewpoint walks around, in and through the cloud.

use hidden_point_removal::{Error, MapOptions, Options, PointCloud};

use crate::common::rng::Rng;
use crate::common::scenes::Scene;
use crate::common::shapes::{self, Points};
use crate::common::walk::Walk;
use crate::common::walked::{self, inversion};

/// The number of views of one cloud, and of maps of one view.
const WALK: usize = 6;
const MAPS: usize = 6;

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let mut points = scene.points.clone();
    let cloud = if rng.chance(2) {
        PointCloud::new(&points)
    } else {
        let single: Vec<[f32; 3]> = points.iter().map(|p| p.map(|x| x as f32)).collect();
        points = single.iter().map(|p| p.map(f64::from)).collect();
        PointCloud::new(&single)
    };
    // Single precision may have no such numbers.
    let Ok(cloud) = cloud else { return Ok(()) };
    let mut observer = cloud.observer();
    let mut walk = Walk::new(&points, scene.viewpoint, scene.options);
    for _ in 0..WALK {
        let mut options = walk.options;
        if rng.chance(3) {
            options = Options::with_inversion(inversion(rng));
        }
        let from = walk.viewpoint;
        if let Ok(seen) = cloud.visible_from(from, &options) {
            let visible: Points = (seen.indices().iter())
                .map(|&index| points[index as usize])
                .collect();
            for _ in 0..MAPS {
                let asked = size(rng, from, &visible);
                let map = match observer.visibility_map(from, &options, &asked) {
                    Err(Error::Excludes { .. }) => break,
                    made => made.map_err(|error| format!("{asked:?}: {error}"))?,
                };
                if let Some(point) = visible.iter().find(|&&point| map.hides(point)) {
                    return Err(format!(
                        "{point:?} is hidden from {from:?} with {options:?}, {asked:?}"
                    ));
                }
            }
        }
        walk.step(rng);
    }
    Ok(())
}

/// Some clouds are large, since a map has more to hide there, and some are far from the origin.
pub fn subject(rng: &mut Rng) -> (&'static str, Scene) {
    let (name, mut points, mut viewpoint) = any_subject(rng);
    if rng.chance(4) {
        for place in points.iter_mut().chain([&mut viewpoint]) {
            for (x, by) in place.iter_mut().zip([452_000.0, 5_411_000.0, 300.0]) {
                *x += by;
            }
        }
    }
    let scene = Scene {
        points,
        viewpoint,
        options: Options::default(),
    };
    (name, scene)
}

fn any_subject(rng: &mut Rng) -> (&'static str, Points, [f64; 3]) {
    if !rng.chance(4) {
        return walked::subject(rng);
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
