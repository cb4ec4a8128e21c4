//! No map of a viewpoint hides a point that is visible from there with the same options, or any place in front of
//! the hull, whatever its size, its directions and its origin are, and whatever was asked before. The
//! viewpoint walks around, in and through the cloud.

use std::sync::atomic::{AtomicU64, Ordering};

use hidden_point_removal::{Error, MapOptions, Options, PointCloud, Reconstruction};

use crate::common::flip::{flip_as, unflipped_as};
use crate::common::rng::Rng;
use crate::common::scenes::Scene;
use crate::common::shapes::{self, Points};
use crate::common::walk::Walk;
use crate::common::walked::{self, inversion};
use crate::common::{cross, dot, length, minus};

/// The number of views of one cloud, and of maps of one view.
const WALK: usize = 6;
const MAPS: usize = 6;
/// How many places in front of the hull each map is asked about.
const PLACES: usize = 20_000;

/// How many visible points and places were tested.
pub static TESTED: AtomicU64 = AtomicU64::new(0);

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
            options = Options::inversion(inversion(rng));
        }
        let from = walk.viewpoint;
        if let Ok(hull) = cloud.reconstruct(from, &options, Some(f64::INFINITY)) {
            let visible: Points = (hull.visibility.indices().iter())
                .map(|&index| points[index as usize])
                .collect();
            let front = Front::of(&points, from, &hull);
            for _ in 0..MAPS {
                let asked = size(rng, from, &visible);
                let map = match observer.visibility_map(from, &options, &asked) {
                    Err(Error::Excludes { .. }) => break,
                    made => made.map_err(|error| format!("{asked:?}: {error}"))?,
                };
                let mut tested = 0;
                let mut places = (0..PLACES).filter_map(|_| front.place(rng));
                let hidden = (visible.iter().copied())
                    .chain(&mut places)
                    .inspect(|_| tested += 1)
                    .find(|&point| map.hides(point));
                TESTED.fetch_add(tested, Ordering::Relaxed);
                if let Some(point) = hidden {
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

/// What lies right in front of the outer faces of K. No point there is in K, so none may be hidden.
struct Front<'a> {
    from: [f64; 3],
    hull: &'a Reconstruction,
    /// The flipped points of each face, its normal, and the normal's product with them.
    faces: Vec<([[f64; 3]; 3], [f64; 3], f64)>,
}

impl<'a> Front<'a> {
    fn of(points: &[[f64; 3]], from: [f64; 3], hull: &'a Reconstruction) -> Self {
        let flipped = |index: u32| flip_as(points[index as usize], from, &hull.visibility);
        let faces = (hull.triangles.iter())
            .filter_map(|&[a, b, c]| {
                let [a, b, c] = [flipped(a)?, flipped(b)?, flipped(c)?];
                let [right, up] = [minus(c, a), minus(b, a)];
                let normal = cross(right, up);
                // The normal of a thin triangle is not known well.
                let is_wide = length(normal) > 1e-4 * length(right) * length(up);
                is_wide.then(|| ([a, b, c], normal, dot(normal, a)))
            })
            .collect();
        Self { from, hull, faces }
    }

    /// `None` where it is not certain that the place is in front.
    fn place(&self, rng: &mut Rng) -> Option<[f64; 3]> {
        if self.faces.is_empty() {
            return None;
        }
        let (corners, normal, depth) = &self.faces[rng.below(self.faces.len())];
        // Near a corner, near an edge, or anywhere.
        let mut shares = [0.0; 3].map(|_: f64| rng.between(0.0, 1.0));
        for share in &mut shares {
            *share *= rng.pick(&[1.0, 1.0, 1e-3, 1e-6]);
        }
        let sum: f64 = shares.iter().sum();
        let out = 1.0 + rng.pick(&[1e-9, 1e-7, 1e-5, 1e-3]);
        let flipped = core::array::from_fn(|axis| {
            let on = |corner: usize| corners[corner][axis] * (shares[corner] / sum);
            (on(0) + on(1) + on(2)) * out
        });
        let place = unflipped_as(flipped, self.from, &self.hull.visibility)?;
        let again = flip_as(place, self.from, &self.hull.visibility)?;
        let doubt = 1e-10 * length(*normal) * length(again);
        (dot(*normal, again) > depth + doubt).then_some(place)
    }
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
        points: 16 << rng.below(14),
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
