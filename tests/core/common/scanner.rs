//! A simulated laser scanner in a furnished hall: rings of beams whose ranges and angles are noisy,
//! beams that hit two surfaces, scans that are put together with errors, voxels that keep one point.

use std::collections::BTreeSet;

use super::rng::Rng;

pub type Place = [f64; 3];

/// A scanned point, and the place on the surface that its beam hit; `None` where it hit two.
pub struct Measured {
    pub place: Place,
    pub truth: Option<Place>,
}

/// How wrong a scanner is.
#[derive(Clone, Copy)]
pub struct Scanner {
    pub rings: usize,
    pub columns: usize,
    /// One standard deviation of a range, in meters, and of an angle, in radians.
    pub range_noise: f64,
    pub angle_noise: f64,
    /// The width of a beam, in radians.
    pub beam: f64,
    /// One standard deviation of the place of a scan among others, in meters, and of its turn.
    pub registration: [f64; 2],
}

/// A hall of 18 by 8 by 3.2 meters around the origin: walls, boxes and balls.
pub struct Hall;

const HALF: Place = [9.0, 4.0, 1.6];
const BOXES: [[Place; 2]; 4] = [
    [[2.0, -1.0, -1.6], [3.2, 0.8, -0.7]],
    [[-6.0, 1.5, -1.6], [-4.5, 3.0, 0.4]],
    [[5.5, 2.0, -1.6], [5.8, 2.3, 1.6]],
    [[-3.0, -3.2, -1.6], [-2.4, -2.6, 0.9]],
];
const BALLS: [(Place, f64); 3] = [
    ([-1.5, 1.8, -0.9], 0.7),
    ([6.0, -2.0, -0.8], 0.8),
    ([-6.5, -1.5, -0.6], 0.5),
];

impl Hall {
    /// How far a ray of this unit direction goes from a place inside.
    fn range(from: Place, ray: Place) -> f64 {
        let mut range = f64::INFINITY;
        for axis in 0..3 {
            let wall = HALF[axis].copysign(ray[axis]) - from[axis];
            range = range.min(wall / ray[axis]);
        }
        for [low, high] in BOXES {
            let [mut enters, mut leaves] = [0.0, f64::INFINITY];
            for axis in 0..3 {
                let at = [low, high].map(|side| (side[axis] - from[axis]) / ray[axis]);
                enters = f64::max(enters, at[0].min(at[1]));
                leaves = f64::min(leaves, at[0].max(at[1]));
            }
            if enters < leaves && enters > 0.0 {
                range = range.min(enters);
            }
        }
        for (middle, radius) in BALLS {
            let v = [0, 1, 2].map(|axis| middle[axis] - from[axis]);
            let along = dot(v, ray);
            let inside = radius * radius - dot(v, v) + along * along;
            if inside > 0.0 && along > inside.sqrt() {
                range = range.min(along - inside.sqrt());
            }
        }
        range
    }

    /// Whether nothing stands between a place and a place on a surface.
    pub fn sees(from: Place, to: Place) -> bool {
        let v = [0, 1, 2].map(|axis| to[axis] - from[axis]);
        let length = dot(v, v).sqrt();
        Self::range(from, v.map(|x| x / length)) > length - 1e-6
    }
}

impl Scanner {
    /// One scan from a station. Its points are moved together, as registration does.
    pub fn scan(&self, station: Place, rng: &mut Rng) -> Vec<Measured> {
        let [places, turns] = self.registration;
        let shift = [0; 3].map(|_| places * normal(rng));
        let (sin, cos) = (turns * normal(rng)).sin_cos();
        let mut points = Vec::new();
        for ring in 0..self.rings {
            for column in 0..self.columns {
                let tilt = (120.0 * (ring as f64 + 0.5) / self.rings as f64 - 60.0).to_radians();
                let turn = core::f64::consts::TAU * column as f64 / self.columns as f64;
                let mut beam = |aside: f64| {
                    let turn = turn + aside + self.angle_noise * normal(rng);
                    let tilt = tilt + self.angle_noise * normal(rng);
                    let ray = [tilt.cos() * turn.cos(), tilt.cos() * turn.sin(), tilt.sin()];
                    (ray, Hall::range(station, ray))
                };
                let [(ray, range), (_, other)] = [beam(0.0), beam(self.beam)];
                let hits_two = (range - other).abs() > 0.1 * range;
                let mixed = if hits_two {
                    range + (other - range) * rng.unit()
                } else {
                    range
                };
                let on = |range: f64| [0, 1, 2].map(|axis| station[axis] + range * ray[axis]);
                let [x, y, z] = on(mixed + self.range_noise * normal(rng));
                let turned = [cos * x - sin * y, sin * x + cos * y, z];
                points.push(Measured {
                    place: [0, 1, 2].map(|axis| turned[axis] + shift[axis]),
                    truth: (!hits_two).then(|| on(range)),
                });
            }
        }
        points
    }
}

/// The first point in each voxel of this size.
pub fn fused(points: Vec<Measured>, size: f64) -> Vec<Measured> {
    let mut taken = BTreeSet::new();
    let voxel = |place: Place| place.map(|x| (x / size).floor() as i64);
    points
        .into_iter()
        .filter(|point| taken.insert(voxel(point.place)))
        .collect()
}

/// A normal number, as a sum of uniform ones.
pub fn normal(rng: &mut Rng) -> f64 {
    (0..12).fold(-6.0, |sum, _| sum + rng.unit())
}

fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
