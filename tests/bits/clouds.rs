//! More clouds than the scenes of the core's tests: thin clouds, clouds of all magnitudes, and
//! large clouds.

use hidden_point_removal::PointCloud;

use super::rng::Rng;
use super::scenes::Scene;
use super::shapes::{self, Points};

/// A cloud and a place to see it from.
pub struct Subject {
    pub points: Points,
    pub viewpoint: [f64; 3],
    pub cloud: PointCloud,
}

impl Subject {
    fn new(points: Points, viewpoint: [f64; 3]) -> Self {
        let cloud = PointCloud::new(&points).expect("an acceptable cloud");
        Self {
            points,
            viewpoint,
            cloud,
        }
    }

    /// Some point of the cloud.
    pub fn target(&self) -> [f64; 3] {
        self.points[self.points.len() / 2]
    }

    /// A scene without its options.
    pub fn of(scene: Scene) -> Self {
        Self::new(scene.points, scene.viewpoint)
    }
}

/// Clouds that are straight, flat or on one ray except for rounding, seen from beside and from
/// within.
pub fn thin() -> Vec<(String, Subject)> {
    let start = [0.3, -0.7, 1.1];
    let place = |t: f64, s: f64| {
        let (along, across) = ([1.7, 0.9, -2.3], [0.4, 1.3, 0.2]);
        core::array::from_fn(|i| start[i] + t * along[i] + s * across[i])
    };
    let mut rng = Rng::new(5);
    let line = (0..200).map(|_| place(rng.between(-5.0, 5.0), 0.0));
    let line: Points = line.collect();
    let plane = (0..400).map(|_| place(rng.between(-5.0, 5.0), rng.between(-5.0, 5.0)));
    let plane: Points = plane.collect();
    let ray = (0..200).map(|_| [1.7, 0.9, -2.3].map(|x| x * rng.between(1.0, 11.0)));
    let ray: Points = ray.collect();
    // A survey of level ground in map coordinates, rounded to millimeters.
    let ground = (0..400).map(|_| {
        let millimeters = |x: f64| (x * 1000.0).round() / 1000.0;
        let [x, y] = [0.0, 0.0].map(|_| millimeters(rng.between(0.0, 100.0)));
        [523_000.0 + x, 4_657_000.0 + y, 120.4]
    });
    let ground: Points = ground.collect();
    let aside = [9.0, 8.0, 7.5];
    let within = place(0.3, 0.0);
    let mut subjects = Vec::new();
    for (name, points, viewpoints) in [
        ("line", line, [aside, within]),
        ("plane", plane, [aside, within]),
        ("ray", ray, [aside, [0.0; 3]]),
        (
            "ground",
            ground,
            [
                [523_050.0, 4_657_050.0, 122.0],
                [523_050.0, 4_657_050.0, 120.4],
            ],
        ),
    ] {
        for (place, viewpoint) in ["aside", "within"].into_iter().zip(viewpoints) {
            let subject = Subject::new(points.clone(), viewpoint);
            subjects.push((format!("thin_{name}_{place}"), subject));
        }
    }
    subjects
}

/// One surface in tiny and huge units, and far from the origin.
pub fn magnitudes() -> Vec<(String, Subject)> {
    let points = shapes::bumpy(&mut Rng::new(6), 300);
    let viewpoint = [1.5, -1.1, 0.7];
    let mut subjects = Vec::new();
    for unit in [1e-140, 1e-30, 1e-3, 1e5, 1e30, 1e140] {
        let scaled = |p: [f64; 3]| p.map(|x| x * unit);
        let points = points.iter().map(|&p| scaled(p)).collect();
        let subject = Subject::new(points, scaled(viewpoint));
        subjects.push((format!("unit_{unit:e}"), subject));
    }
    for away in [523_000.25, 4e9, 1e13] {
        let moved = |p: [f64; 3]| p.map(|x| x + away);
        let points = points.iter().map(|&p| moved(p)).collect();
        let subject = Subject::new(points, moved(viewpoint));
        subjects.push((format!("away_{away:e}"), subject));
    }
    subjects
}

/// Clouds of 20,000 points.
pub fn large() -> Vec<(&'static str, Subject)> {
    let lattice = |rng: &mut Rng| {
        let mut points: Points = (0..27 * 27 * 27)
            .map(|i| [i % 27, i / 27 % 27, i / 729].map(f64::from))
            .collect();
        rng.shuffle(&mut points);
        points
    };
    let surveyed = |rng: &mut Rng| {
        let place = [523_000.0, 4_657_000.0, 120.0];
        let at =
            |p: [f64; 3]| core::array::from_fn(|i| place[i] + (p[i] * 20_000.0).round() / 1000.0);
        shapes::bumpy(rng, 20_000).into_iter().map(at).collect()
    };
    let mut rng = Rng::new(7);
    let rng = &mut rng;
    vec![
        (
            "large_sphere",
            Subject::new(shapes::sphere(rng, 20_000), [0.0, 0.5, 4.0]),
        ),
        (
            "large_bumpy",
            Subject::new(shapes::bumpy(rng, 20_000), [0.1, 0.2, 0.1]),
        ),
        // In the plane of a wall.
        (
            "large_room",
            Subject::new(shapes::room(rng, 20_000), [4.0, 0.4, 0.3]),
        ),
        (
            "large_lattice",
            Subject::new(lattice(rng), [13.0, 13.0, 40.0]),
        ),
        (
            "large_surveyed",
            Subject::new(surveyed(rng), [523_030.0, 4_657_010.0, 140.0]),
        ),
    ]
}
