//! Tests for faults that all other tests missed. These gaps were found by changing the code in
//! one place at a time, and by listing the lines that no test reaches.

use hidden_point_removal::{Error, MAX_POINTS, Options, PointCloud, PointCloudNd};

use crate::common::rng::Rng;
use crate::common::{ask, shapes};
use crate::test;

/// Five points that all vote on each other. Two or three of them are visible: the nearest point on
/// the ray along x, and the points on rays of their own. More than two fifths must be visible.
#[test]
fn two_of_five_votes_are_not_enough() {
    let options = Options::default().vote(4);
    let [a, b, c, d] = [1.0, 2.0, 3.0, 4.0].map(|x| [x, 0.0, 0.0]);
    let (e, f) = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let two = ask(&[a, b, c, d, e], [0.0; 3], &options);
    assert_eq!(two.count(), 0);
    let three = ask(&[a, b, c, e, f], [0.0; 3], &options);
    assert_eq!(three.indices(), [0, 1, 2, 3, 4]);
}

#[test]
fn a_cloud_that_is_prepared_twice_answers_alike() {
    let points = shapes::bumpy(&mut Rng::new(3), 600);
    let options = Options::default().denoise(8);
    let mut cloud = PointCloud::new(&points).unwrap();
    cloud.prepare_for(&options).unwrap();
    cloud.prepare_for(&options).unwrap();
    let view = cloud.visible_from([0.0, 0.5, 3.0], &options).unwrap();
    assert_eq!(view, ask(&points, [0.0, 0.5, 3.0], &options));
}

/// Three neighbors at the distances 3, 4 and 5.
#[test]
fn the_spacing_is_told_in_every_dimension() {
    let flat = PointCloud::new(&[[0.0; 3], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]]).unwrap();
    assert_eq!(flat.spacing(), Ok(4.0));
    let corners = [[0.0; 4], [3.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 4.0]].concat();
    assert_eq!(PointCloudNd::new(4, &corners).unwrap().spacing(), 4.0);
    let cloud = PointCloud::new(&[[0.0; 3]; 2]).unwrap();
    assert_eq!(
        format!("{cloud:?}"),
        "PointCloud { len: 2, skipped: 0, .. }"
    );
}

#[test]
fn refusals_that_are_hard_to_provoke_are_one_sentence() {
    let direction = [0.0, f64::NEG_INFINITY, f64::NAN];
    let points = format!("5 points exceed the limit of {MAX_POINTS}");
    for (error, message) in [
        (
            Error::Direction { direction },
            "the direction must be finite and not zero, got 0, -infinity, NaN",
        ),
        (Error::TooManyPoints { count: 5 }, points.as_str()),
        (Error::OutOfMemory, "not enough memory for this cloud"),
    ] {
        assert_eq!(error.to_string(), message);
    }
    assert_eq!(Error::OutOfMemory.code(), "too-large");
}
