//! Tests for faults that all other tests missed. These gaps were found by changing the code in
//! one place at a time, and by listing the lines that no test reaches.

use hidden_point_removal::{Error, MAX_POINTS, PointCloud, PointCloudNd};

use crate::test;

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
