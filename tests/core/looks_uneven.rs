//! Several looks at points that are near each other in rows, and far from row to row, like the
//! corners of a coarse mesh.

use core::f64::consts::PI;
use hidden_point_removal::{Options, PointCloud, Visibility};

use crate::test;

/// A sphere of radius 1, turned from rows of corners. Each row is turned by another angle, so
/// that no two rows lie alike.
fn turned(rows: usize, corners: usize) -> Vec<[f64; 3]> {
    let corner = |i: usize| {
        let (row, along) = (i / corners, i % corners);
        let up = PI * (row as f64 + 0.5) / rows as f64;
        let around = 2.0 * PI * (along as f64 + 0.618 * row as f64) / corners as f64;
        let [x, y] = [libm::cos(around), libm::sin(around)].map(|x| x * libm::sin(up));
        [x, y, libm::cos(up)]
    };
    (0..rows * corners).map(corner).collect()
}

/// The share of wrong answers, in percent. The truth of a sphere: a point is visible if it faces
/// the viewer.
fn wrong(points: &[[f64; 3]], seen: &Visibility, faces: impl Fn(&[f64; 3]) -> bool) -> f64 {
    let mask = seen.mask();
    let pairs = points.iter().zip(&mask);
    let wrong = pairs.filter(|(point, seen)| faces(point) != (**seen == 1));
    100.0 * wrong.count() as f64 / points.len() as f64
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn long_triangles_hide_where_most_triangles_are_long() {
    let points = turned(16, 300);
    let cloud = PointCloud::new(&points).unwrap();
    for towards in [[0.6, 0.0, 0.8], [0.96, 0.28, 0.0], [0.0, -0.28, 0.96]] {
        for count in [2, 3] {
            let options = Options::looks(count);
            for distance in [1.8, 5.0] {
                let viewpoint = towards.map(|x: f64| x * distance);
                let seen = cloud.visible_from(viewpoint, &options).unwrap();
                let wrong = wrong(&points, &seen, |point| dot(point, &viewpoint) > 1.0);
                assert!(wrong < 5.0, "{viewpoint:?}, {count} looks: {wrong} % wrong");
            }
            let ahead = towards.map(|x| -x);
            let seen = cloud.visible_from_direction(ahead, &options).unwrap();
            let wrong = wrong(&points, &seen, |point| dot(point, &ahead) < 0.0);
            assert!(
                wrong < 5.0,
                "along {ahead:?}, {count} looks: {wrong} % wrong"
            );
        }
    }
}

#[test]
fn the_scales_are_larger_where_points_leave_much_empty() {
    let scale = |points: &[[f64; 3]]| {
        let cloud = PointCloud::new(points).unwrap();
        let options = Options::looks(3);
        let seen = cloud.visible_from([3.0, 5.0, 9.0], &options).unwrap();
        let [tight, usual, loose] = *seen.looks() else {
            panic!("three looks have three scales")
        };
        assert!((tight / usual - 4.0).abs() < 1e-9 && (tight / loose - 14.0).abs() < 1e-9);
        tight / (0.28 * cloud.spacing().unwrap())
    };
    assert_eq!(scale(&turned(60, 120)), 1.0);
    let rows = scale(&turned(28, 300));
    // The eighth power of a share: 1 % of it is 8 % here. Which points are sampled decides that much.
    assert!((2.0..31.0).contains(&rows), "{rows}");
    // No scale is larger.
    let fewer = scale(&turned(12, 300));
    assert!((fewer - 32.0).abs() < 1e-9, "{fewer}");
}
