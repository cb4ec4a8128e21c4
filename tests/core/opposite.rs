//! The choice of R by the paper's rule.

use hidden_point_removal::{ChosenRadius, Error, Options, PointCloud, Radius};

use crate::common::flip::farthest;
use crate::common::rng::Rng;
use crate::common::{ask, shapes};
use crate::test;

const FRONT: [f64; 3] = [0.3, -0.2, 3.0];

fn chosen(points: &[[f64; 3]], viewpoint: [f64; 3], rule: Radius) -> ChosenRadius {
    let cloud = PointCloud::new(points).unwrap();
    cloud.auto_radius(viewpoint, rule).unwrap()
}

fn centroid(points: &[[f64; 3]]) -> [f64; 3] {
    let n = points.len() as f64;
    core::array::from_fn(|i| points.iter().map(|p| p[i]).sum::<f64>() / n)
}

/// Points seen by exactly one of the viewpoint and its mirror image.
fn seen_by_one(points: &[[f64; 3]], mirror: [f64; 3], radius: f64) -> usize {
    let options = Options::radius(radius);
    let here = ask(points, FRONT, &options).mask();
    let there = ask(points, mirror, &options).mask();
    here.iter().zip(&there).filter(|(a, b)| a != b).count()
}

#[test]
fn the_papers_rule_makes_points_seen_by_one_side_most() {
    let points = shapes::bumpy(&mut Rng::new(23), 800);
    let centroid = centroid(&points);
    let mirror: [f64; 3] = core::array::from_fn(|i| 2.0 * centroid[i] - FRONT[i]);
    let least = farthest(&points, FRONT).max(farthest(&points, mirror));
    let chosen = chosen(&points, FRONT, Radius::Opposite);
    assert!(chosen.radius >= least * (1.0 - 1e-12));
    let most = seen_by_one(&points, mirror, chosen.radius);
    for step in 0..=24 {
        let radius = least * (1.0 + 1e-12) * 10f64.powf(0.25 * f64::from(step));
        let other = seen_by_one(&points, mirror, radius);
        // A step function may have maxima that a bracketing search does not visit.
        assert!(
            other <= most + points.len() / 100,
            "{other} at {radius}, {most} found"
        );
    }
    assert!(chosen.evaluations > 20 && chosen.evaluations % 2 == 0);
}

#[test]
fn ties_take_the_smallest_radius() {
    // Already with the smallest radius, each side sees one of the two points.
    let points = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let chosen = chosen(&points, [0.0, 0.0, 5.0], Radius::Opposite);
    assert_eq!((chosen.radius, chosen.exponent), (6.0, 0.0));
}

#[test]
fn at_the_centroid_the_papers_rule_falls_back() {
    let cube: Vec<[f64; 3]> = (0..8)
        .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|x| f64::from(x as u8) * 2.0 - 1.0))
        .collect();
    let opposite = chosen(&cube, [0.0; 3], Radius::Opposite);
    assert_eq!(opposite, chosen(&cube, [0.0; 3], Radius::Auto));
}

#[test]
fn distances_beyond_the_range_are_refused() {
    let cloud = PointCloud::new(&[[1e160, 0.0, 0.0], [0.0; 3]]).unwrap();
    let error = cloud.auto_radius([0.0; 3], Radius::Opposite).unwrap_err();
    assert!(matches!(error, Error::RadiusOverflow { .. }));
    // The mirror image is out of range, the viewpoint is not.
    let far = [0.0, 1.2e154, 1.21e154, 1.22e154].map(|x| [x, 0.0, 0.0]);
    let viewpoint = [5e152, 0.0, 0.0];
    let auto = chosen(&far, viewpoint, Radius::Auto);
    assert_eq!(chosen(&far, viewpoint, Radius::Opposite), auto);
}
