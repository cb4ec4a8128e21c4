//! The automatic radius: R = 5·r²/s, never below the farthest distance.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use hidden_point_removal::{Options, PointCloud, Radius};

use crate::common::ask;
use crate::common::flip::{distance, farthest};
use crate::common::rng::Rng;
use crate::common::scenes::KINDS;
use crate::common::shapes;

fn automatic(points: &[[f64; 3]], viewpoint: [f64; 3]) -> (f64, f64) {
    let cloud = PointCloud::new(points).unwrap();
    let chosen = cloud.auto_radius(viewpoint, Radius::Auto).unwrap();
    assert_eq!(chosen.evaluations, 0);
    (chosen.radius, chosen.exponent)
}

fn distinct(points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut points = points.to_vec();
    points.sort_by(|a, b| a.partial_cmp(b).unwrap());
    points.dedup();
    points
}

/// The mean distance to the 6 nearest other points, by comparing all pairs.
fn spacing(points: &[[f64; 3]]) -> f64 {
    let mut sum = 0.0;
    for (i, &p) in points.iter().enumerate() {
        let others = points.iter().enumerate().filter(|&(j, _)| j != i);
        let mut distances: Vec<f64> = others.map(|(_, &q)| distance(p, q)).collect();
        distances.sort_by(f64::total_cmp);
        distances.truncate(6);
        sum += distances.iter().sum::<f64>() / distances.len() as f64;
    }
    sum / points.len() as f64
}

/// 5·r²/s from scratch, r the root-mean-square distance of the distinct points.
fn expected(points: &[[f64; 3]], viewpoint: [f64; 3]) -> f64 {
    let points = distinct(points);
    let farthest = farthest(&points, viewpoint);
    if points.len() < 2 {
        return farthest;
    }
    let squares = points
        .iter()
        .map(|&p| distance(p, viewpoint).powi(2))
        .sum::<f64>();
    (5.0 * squares / points.len() as f64 / spacing(&points)).max(farthest)
}

#[test]
fn the_cloud_gives_its_spacing() {
    for kind in KINDS {
        for (seed, n) in [(1, 2), (2, 7), (3, 60), (4, 500)] {
            let points = kind.scene(seed, n).points;
            let cloud = PointCloud::new(&points).unwrap();
            let points = distinct(&points);
            let expected = if points.len() < 2 {
                0.0
            } else {
                spacing(&points)
            };
            let off = (cloud.spacing() - expected).abs();
            assert!(off <= 1e-9 * expected, "{}: {off}", kind.name);
        }
    }
}

#[test]
fn it_is_five_times_the_mean_square_distance_over_the_spacing() {
    for kind in KINDS.iter().filter(|kind| !kind.name.contains("scaled")) {
        for (seed, n) in [(1, 2), (2, 3), (3, 7), (4, 8), (5, 60), (6, 500)] {
            let scene = kind.scene(seed, n);
            let (radius, _) = automatic(&scene.points, scene.viewpoint);
            let expected = expected(&scene.points, scene.viewpoint);
            assert!(
                (radius - expected).abs() <= 1e-9 * expected,
                "{radius} instead of {expected}: {} with seed {seed}, {n} points",
                kind.name
            );
        }
    }
}

#[test]
fn two_thousand_points_are_measured_completely() {
    let points = shapes::bumpy(&mut Rng::new(11), 2000);
    for viewpoint in [[0.0, 0.0, 2.5], [0.1, 0.2, -0.1], [100.0, 0.0, 0.0]] {
        let (radius, _) = automatic(&points, viewpoint);
        let expected = expected(&points, viewpoint);
        assert!(
            (radius / expected - 1.0).abs() < 1e-9,
            "{radius}, {expected}"
        );
    }
}

#[test]
fn samples_of_larger_clouds_are_accurate_in_every_order_of_the_points() {
    let mut rng = Rng::new(12);
    let mut points = shapes::bumpy(&mut rng, 6000);
    let viewpoint = [0.0, 2.0, 1.0];
    let before = automatic(&points, viewpoint);
    assert!(
        (before.0 / expected(&points, viewpoint) - 1.0).abs() < 0.03,
        "{before:?}"
    );
    let copies: Vec<_> = (0..5000).map(|_| rng.pick(&points)).collect();
    points.extend(copies);
    rng.shuffle(&mut points);
    let after = automatic(&points, viewpoint);
    assert_eq!(before.0.to_bits(), after.0.to_bits());
    assert_eq!(before.1.to_bits(), after.1.to_bits());
}

#[test]
fn it_is_the_default_and_the_answer_reports_the_chosen_radius() {
    for kind in KINDS {
        let scene = kind.scene(21, 50);
        let (radius, exponent) = automatic(&scene.points, scene.viewpoint);
        let answer = ask(&scene.points, scene.viewpoint, &Options::default());
        assert_eq!(answer.radius().to_bits(), radius.to_bits(), "{}", kind.name);
        assert_eq!(
            answer.exponent().to_bits(),
            exponent.to_bits(),
            "{}",
            kind.name
        );
        let farthest = farthest(&scene.points, scene.viewpoint);
        assert!(radius >= farthest, "{}", kind.name);
        if farthest > 0.0 {
            assert!(
                (exponent - (radius / farthest).log10()).abs() < 1e-12,
                "{}",
                kind.name
            );
        }
        assert_eq!(answer.evaluations(), 0);
    }
}

#[test]
fn it_is_the_farthest_distance_where_there_is_no_spacing() {
    let viewpoint = [1.0, 2.0, 2.0];
    assert_eq!(automatic(&[], viewpoint), (0.0, 0.0));
    assert_eq!(automatic(&[viewpoint; 3], viewpoint), (0.0, 0.0));
    assert_eq!(automatic(&[[0.0; 3]], viewpoint), (3.0, 0.0));
    assert_eq!(
        automatic(&[[0.0; 3], [-0.0; 3], [0.0; 3]], viewpoint),
        (3.0, 0.0)
    );
    // One point at the viewpoint and one far from it: two distinct points.
    assert_eq!(
        automatic(&[[0.0; 3], viewpoint], viewpoint),
        (7.5, 2.5f64.log10())
    );
}

#[test]
fn an_overflow_is_clamped() {
    // The distances fit into an `f64`; their squares divided by the spacing do not.
    let mut points = vec![[1e150, 0.0, 0.0], [0.0, 1e150, 0.0], [0.0, 0.0, 1e150]];
    points.extend([[1e-200, 0.0, 0.0], [0.0, 1e-200, 0.0]]);
    let (radius, exponent) = automatic(&points, [-1e153, 0.0, 0.0]);
    assert!(radius >= 1e153 && (2.0 * radius).is_finite() && exponent.is_finite());
    let far = [1e-150, 2e-150, 3e-150].map(|x| [x, 0.0, 0.0]);
    let (radius, exponent) = automatic(&far, [1e153, 0.0, 0.0]);
    assert!((2.0 * radius).is_finite() && radius >= 1e153 && exponent.is_finite());
    assert_eq!(ask(&far, [1e153, 0.0, 0.0], &Options::default()).count(), 3);
}
