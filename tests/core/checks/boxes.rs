//! Boxes that a horizon hides, compared with 1,000 points of each box: a box that is proved hidden must hold no point
//! that the horizon does not hide.

use hidden_point_removal::{Exponential, Horizon, Inversion, Options};

use crate::common::flip::farthest;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;
use crate::common::{shapes, structured};

/// The number of boxes for each horizon.
const BOXES: usize = 60;
/// The points of a box that are compared: a few first, since most open boxes show at once.
const SAMPLES: [usize; 2] = [64, 936];
/// The boxes reach to this many times the distance of the farthest point.
const BEYOND: f64 = 4.0;

type Place = [f64; 3];
type Block = (Place, Place);

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    tally(scene, rng).map(|_| ())
}

/// How many boxes are hidden by all samples, and how many of them are proved.
pub fn tally(scene: &Scene, rng: &mut Rng) -> Result<[u64; 2], String> {
    let Scene {
        points, viewpoint, ..
    } = scene;
    let reach = BEYOND * farthest(points, *viewpoint);
    let mut shares = [0; 2];
    if !(1e-100..1e100).contains(&reach) {
        return Ok(shares);
    }
    let options = options(rng, reach);
    let mut horizon = Horizon::new(*viewpoint, &options).expect("options with numbers");
    horizon.add(points).expect("points within reach");
    for _ in 0..BOXES {
        let (kind, (min, max)) = draw(rng, points, *viewpoint);
        let proved = horizon.hides_box(min, max).expect("a box");
        match first_seen(rng, &horizon, (min, max), *viewpoint) {
            Some(Some(point)) if proved => {
                return Err(format!(
                    "{kind}: {min:?} to {max:?} is not hidden at {point:?} with {options:?}"
                ));
            }
            Some(None) => {
                shares[0] += 1;
                shares[1] += u64::from(proved);
            }
            _ => {}
        }
    }
    Ok(shares)
}

/// A cloud and a viewpoint.
pub fn subject(rng: &mut Rng) -> (&'static str, Scene) {
    if rng.chance(4) {
        let kind = rng.pick(structured::SHAPES);
        let n = 20 + rng.below(2000);
        return (kind.0, structured::scene(rng, kind, n));
    }
    type Shape = fn(&mut Rng, usize) -> Vec<Place>;
    let all: [(&str, Shape); 5] = [
        ("room", shapes::room),
        ("bumpy", shapes::bumpy),
        ("sphere", shapes::sphere),
        ("wall", wall),
        ("street", street),
    ];
    let (name, shape) = rng.pick(&all);
    let n = 500 + rng.below(6000);
    let points = shape(rng, n);
    let viewpoint = match rng.below(4) {
        // In the plane of a wall or the ground, in one coordinate of a point.
        0 => {
            let point = rng.pick(&points);
            let mut place = rng.in_ball().map(|x| 3.0 * x);
            let axis = rng.below(3);
            place[axis] = point[axis];
            place
        }
        1 => rng.in_ball().map(|x| 0.3 * x),
        2 => rng.direction().map(|x| 8.0 * x),
        _ => rng.in_ball().map(|x| 3.0 * x),
    };
    let scene = Scene {
        points,
        viewpoint,
        options: Options::default(),
    };
    (name, scene)
}

fn wall(rng: &mut Rng, n: usize) -> Vec<Place> {
    (0..n)
        .map(|_| [1.0, rng.between(-3.0, 3.0), rng.between(-1.0, 2.0)])
        .collect()
}

/// Ground, and walls on both sides.
fn street(rng: &mut Rng, n: usize) -> Vec<Place> {
    (0..n)
        .map(|_| match rng.below(3) {
            0 => [rng.between(-9.0, 9.0), rng.between(-1.0, 1.0), -1.0],
            side => {
                let y = if side == 1 { -1.0 } else { 1.0 };
                [rng.between(-9.0, 9.0), y, rng.between(-1.0, 2.0)]
            }
        })
        .collect()
}

/// Options for points up to a distance.
fn options(rng: &mut Rng, reach: f64) -> Options {
    match rng.below(8) {
        0 => Options::radius(reach),
        1 => Options::radius(10.0 * reach),
        2 => Options::radius(1e4 * reach),
        3 => Options::radius(reach).with_inversion(Inversion::Power(2.0)),
        kind => {
            let scale = [1e-3, 1e-2, 0.1, 3.0][kind - 4] * reach;
            Options::inversion(Inversion::Exponential(Exponential::Scale(scale)))
        }
    }
}

/// A box, most of them behind a point of the cloud.
fn draw(rng: &mut Rng, points: &[Place], viewpoint: Place) -> (&'static str, Block) {
    let point = rng.pick(points);
    let behind = rng.pick(&[1.0, 1.01, 1.1, 1.5, 3.0]);
    let start: Place =
        core::array::from_fn(|axis| viewpoint[axis] + behind * (point[axis] - viewpoint[axis]));
    let length = farthest(&[point], viewpoint);
    let size = rng.pick(&[1e-9, 1e-4, 1e-2, 0.1, 0.5]) * length;
    let mut edges: Place = core::array::from_fn(|_| size * rng.unit());
    let mut min = start;
    let kind = match rng.below(8) {
        0 => {
            edges = [0.0; 3];
            "point"
        }
        1 => {
            edges[rng.below(3)] = 0.0;
            "sheet"
        }
        2 => {
            let axis = rng.below(3);
            edges[(axis + 1) % 3] = 0.0;
            edges[(axis + 2) % 3] = 0.0;
            "needle"
        }
        3 => {
            min = point;
            "at a point"
        }
        4 => {
            // The plane of a side goes through the viewpoint.
            min[rng.below(3)] = viewpoint[rng.below(3)];
            let axis = rng.below(3);
            min[axis] = viewpoint[axis];
            "in a plane with the viewpoint"
        }
        5 => {
            // The box reaches to both sides of the point's ray.
            min = core::array::from_fn(|axis| start[axis] - 0.5 * edges[axis]);
            "around a ray"
        }
        6 => {
            edges[rng.below(3)] *= 20.0;
            "long"
        }
        _ => "box",
    };
    let max = core::array::from_fn(|axis| min[axis] + edges[axis]);
    (kind, (min, max))
}

/// A point of the box that the horizon does not hide, if a sample finds one. `None` if the box
/// reaches beyond the radius.
fn first_seen(
    rng: &mut Rng,
    horizon: &Horizon,
    (min, max): Block,
    viewpoint: Place,
) -> Option<Option<Place>> {
    for count in SAMPLES {
        let mut samples: Vec<Place> = (0..count)
            .map(|_| {
                // Corners, edges and sides hold more than their share.
                core::array::from_fn(|axis| {
                    let along = rng.between(-0.5, 1.5).clamp(0.0, 1.0);
                    (min[axis] + along * (max[axis] - min[axis])).clamp(min[axis], max[axis])
                })
            })
            .collect();
        samples.push(core::array::from_fn(|axis| {
            viewpoint[axis].clamp(min[axis], max[axis])
        }));
        let seen = horizon.screen(&samples).ok()?;
        if let Some(&index) = seen.first() {
            return Some(Some(samples[index as usize]));
        }
    }
    Some(None)
}
