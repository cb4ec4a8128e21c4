//! Looks at what a simulated scanner measures (`common/scanner`). The truth is that of the surface.

use hidden_point_removal::{Options, PointCloud};

use crate::common::rng::Rng;
use crate::common::scanner::{Hall, Measured, Place, Scanner, fused};
use crate::test;

fn looks() -> Options {
    Options::looks(3)
}
const LASER: Scanner = Scanner {
    rings: 90,
    columns: 360,
    range_noise: 0.008,
    angle_noise: 2e-4,
    beam: 2e-3,
    registration: [0.0; 2],
};

/// Few rings, with many points on each: spacing differs by direction, and grows with range.
const SPINNING: Scanner = Scanner {
    rings: 32,
    columns: 1000,
    range_noise: 0.02,
    ..LASER
};

fn cloud_of(points: &[Measured]) -> PointCloud {
    let places: Vec<Place> = points.iter().map(|point| point.place).collect();
    PointCloud::new(&places).unwrap()
}

/// Wrong points in percent: of all that are judged, of the hidden and of the visible ones.
fn wrong(points: &[Measured], viewpoint: Place, options: &Options) -> [f64; 3] {
    let seen = cloud_of(points).visible_from(viewpoint, options).unwrap();
    wrong_of(points, viewpoint, &seen.mask())
}

fn wrong_of(points: &[Measured], viewpoint: Place, seen: &[u8]) -> [f64; 3] {
    let [mut wrong, mut all] = [[0.0; 2]; 2];
    for (point, &seen) in points.iter().zip(seen) {
        let Some(truth) = point.truth else { continue };
        let is_visible = Hall::sees(viewpoint, truth);
        all[usize::from(is_visible)] += 1.0;
        wrong[usize::from(is_visible)] += f64::from(u8::from((seen == 1) != is_visible));
    }
    let share = |wrong: f64, all: f64| 100.0 * wrong / f64::max(all, 1.0);
    [
        share(wrong[0] + wrong[1], all[0] + all[1]),
        share(wrong[0], all[0]),
        share(wrong[1], all[1]),
    ]
}

#[test]
fn a_scanner_sees_its_own_points() {
    for (name, scanner) in [("laser", LASER), ("spinning", SPINNING)] {
        let station = [0.0, -0.5, 0.0];
        let points = scanner.scan(station, &mut Rng::new(1));
        let [now, _, _] = wrong(&points, station, &looks());
        let [before, _, _] = wrong(&points, station, &looks().with_thickness(0.0));
        assert!(now < 1.0 && now < before, "{name}: {now} {before}");
    }
}

/// Between few rings there is surface, though no points are on it.
#[test]
fn one_hull_sees_most_points_of_few_rings_from_their_station() {
    let station = [0.0, -0.5, 0.0];
    for rings in [16, 32] {
        let scanner = Scanner { rings, ..SPINNING };
        let points = scanner.scan(station, &mut Rng::new(1));
        let [now, _, _] = wrong(&points, station, &Options::default());
        assert!(now < 6.0, "{rings} rings: {now}");
    }
}

/// Leaves the station in steps of 10 cm: the largest share of labels that a step changes, and the
/// mean share of wrong ones, in percent.
fn leave(points: &[Measured], station: Place, axis: usize, steps: i32) -> [f64; 2] {
    let cloud = cloud_of(points);
    let [mut most, mut sum] = [0.0; 2];
    let mut before: Option<Vec<u8>> = None;
    for step in 0..=steps {
        let mut viewpoint = station;
        viewpoint[axis] += 0.1 * f64::from(step);
        let seen = cloud.visible_from(viewpoint, &looks()).unwrap().mask();
        if let Some(before) = before {
            let changed = before.iter().zip(&seen).filter(|(a, b)| a != b).count();
            most = f64::max(most, 100.0 * changed as f64 / seen.len() as f64);
        }
        sum += wrong_of(points, viewpoint, &seen)[0];
        before = Some(seen);
    }
    [most, sum / f64::from(steps + 1)]
}

#[test]
fn a_path_from_the_station_has_no_sudden_step() {
    let station = [0.0, -0.5, 0.0];
    let points = SPINNING.scan(station, &mut Rng::new(1));
    // Across the hall up to a wall, and up to 10 cm below the ceiling.
    for (axis, steps, bounds) in [(1, 30, [10.0, 5.0]), (2, 15, [25.0, 3.0])] {
        let [most, wrong] = leave(&points, station, axis, steps);
        let is_kept = most < bounds[0] && wrong < bounds[1];
        assert!(is_kept, "axis {axis}: {most} {wrong}");
    }
}

#[test]
fn registered_scans_are_one_surface() {
    let scanner = Scanner {
        registration: [0.03, 0.003],
        ..LASER
    };
    for (seed, voxel) in [(2, 0.02), (4, 0.08)] {
        let mut rng = Rng::new(seed);
        let mut points = Vec::new();
        for station in [
            [-5.0, -0.5, 0.2],
            [0.5, 2.5, 0.0],
            [4.0, -2.8, 0.3],
            [-1.0, -1.0, -0.2],
            [7.5, 1.0, 0.1],
        ] {
            points.extend(scanner.scan(station, &mut rng));
        }
        let points = fused(points, voxel);
        let viewpoint = [1.2, -2.0, 0.4];
        let [now, shown, lost] = wrong(&points, viewpoint, &looks());
        let [before, _, _] = wrong(&points, viewpoint, &looks().with_thickness(0.0));
        assert!(
            now < 3.0 && shown < 18.0 && lost < 3.0,
            "{voxel}: {shown} {lost}"
        );
        assert!(now < 0.3 * before, "{voxel}: {now} {before}");
    }
}
