//! Bad input: every error occurs, and valid input is not refused.

use hidden_point_removal::{Error, NonFinite, Options, PointCloud, Radius};

const NAN: f64 = f64::NAN;
const INF: f64 = f64::INFINITY;
const ORIGIN: [f64; 3] = [0.0; 3];
const POINTS: [[f64; 3]; 3] = [[3.0, 4.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -2.0]];

fn refused(points: &[[f64; 3]], viewpoint: [f64; 3], options: Options) -> Error {
    let cloud = PointCloud::new(points).unwrap();
    cloud.visible_from(viewpoint, &options).unwrap_err()
}

#[test]
fn positions_that_are_not_finite_are_counted_and_located() {
    let error = PointCloud::new(&[[0.0; 3], [1.0, NAN, NAN], [INF, 0.0, -INF], [2.0; 3]]).err();
    assert_eq!(error, Some(Error::NonFinite { count: 2, first: 1 }));
    let error = error.unwrap();
    assert_eq!(error.code(), "non-finite");
    let message = error.to_string();
    assert!(
        message.contains('2') && message.contains("index 1"),
        "{message}"
    );
    let single = PointCloud::new(&[[0.0f32, f32::NEG_INFINITY, 0.0]]).err();
    assert_eq!(single, Some(Error::NonFinite { count: 1, first: 0 }));
}

#[test]
fn skipped_points_keep_their_indices_and_are_never_visible() {
    let points = [
        [NAN; 3],
        [1.0, 0.0, 0.0],
        [0.0, INF, 0.0],
        [2.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let cloud = PointCloud::with_non_finite(&points, NonFinite::Skip).unwrap();
    assert_eq!((cloud.len(), cloud.skipped()), (5, 2));
    let answer = cloud.visible_from(ORIGIN, &Options::default()).unwrap();
    assert_eq!(answer.indices(), [1, 4]);
    assert_eq!(answer.mask(), [0, 1, 0, 0, 1]);
    // The other points are answered as if the skipped points had not been given.
    let finite = PointCloud::new(&[points[1], points[3], points[4]]).unwrap();
    assert_eq!(
        finite.auto_radius(ORIGIN, Radius::Auto),
        cloud.auto_radius(ORIGIN, Radius::Auto)
    );
    assert_eq!(finite.skipped(), 0);
}

#[test]
fn a_cloud_of_skipped_points_only_is_answered() {
    let cloud = PointCloud::with_non_finite(&[[f32::NAN; 3]; 4], NonFinite::Skip).unwrap();
    assert_eq!(
        (cloud.len(), cloud.skipped(), cloud.is_empty()),
        (4, 4, false)
    );
    let answer = cloud.visible_from(ORIGIN, &Options::default()).unwrap();
    assert_eq!((answer.mask(), answer.radius()), (vec![0; 4], 0.0));
}

#[test]
fn a_viewpoint_that_is_not_finite_is_refused() {
    for bad in [NAN, INF, -INF] {
        for axis in 0..3 {
            let mut viewpoint = [1.0; 3];
            viewpoint[axis] = bad;
            for points in [&POINTS[..], &[]] {
                let error = refused(points, viewpoint, Options::default());
                assert!(matches!(error, Error::Viewpoint { .. }), "{error:?}");
                assert_eq!(error.code(), "viewpoint");
                let cloud = PointCloud::new(points).unwrap();
                assert_eq!(
                    cloud
                        .auto_radius(viewpoint, Radius::Auto)
                        .unwrap_err()
                        .code(),
                    "viewpoint"
                );
            }
        }
    }
}

#[test]
fn a_radius_that_is_no_positive_number_is_refused() {
    for bad in [NAN, INF, -INF, 0.0, -0.0, -5.0] {
        for points in [&POINTS[..], &[]] {
            let error = refused(points, ORIGIN, Options::with_radius(bad));
            assert!(matches!(error, Error::RadiusInvalid { .. }), "{error:?}");
            assert_eq!(error.code(), "radius");
        }
    }
}

#[test]
fn a_radius_within_the_cloud_is_refused_with_both_numbers() {
    let error = refused(&POINTS, ORIGIN, Options::with_radius(4.5));
    let expected = Error::RadiusTooSmall {
        radius: 4.5,
        farthest: 5.0,
    };
    assert_eq!(error, expected);
    assert_eq!(error.code(), "radius");
    let message = error.to_string();
    assert!(
        message.contains("4.5") && message.contains('5'),
        "{message}"
    );
}

#[test]
fn distances_and_radii_beyond_the_range_are_refused() {
    let far = [[1e200, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for options in [
        Options::default(),
        Options::with_exponent(0.0),
        Options::with_radius(1e300),
    ] {
        let error = refused(&far, ORIGIN, options);
        assert!(matches!(error, Error::RadiusOverflow { .. }), "{error:?}");
        assert_eq!(error.code(), "radius");
    }
    assert_eq!(
        PointCloud::new(&far)
            .unwrap()
            .auto_radius(ORIGIN, Radius::Auto)
            .unwrap_err()
            .code(),
        "radius"
    );
    // p − C itself overflows.
    let error = refused(
        &[[f64::MAX, 0.0, 0.0]],
        [-f64::MAX, 0.0, 0.0],
        Options::default(),
    );
    assert_eq!(error.code(), "radius");
    // Twice the radius overflows.
    for options in [
        Options::with_radius(f64::MAX),
        Options::with_exponent(308.0),
        Options::with_exponent(1e300),
    ] {
        let error = refused(&POINTS, ORIGIN, options);
        assert!(matches!(error, Error::RadiusOverflow { .. }), "{error:?}");
    }
}

#[test]
fn an_exponent_that_is_no_number_from_zero_up_is_refused() {
    for bad in [NAN, INF, -INF, -0.5] {
        for points in [&POINTS[..], &[]] {
            let error = refused(points, ORIGIN, Options::with_exponent(bad));
            assert!(matches!(error, Error::Parameter { .. }), "{error:?}");
            assert_eq!(error.code(), "option");
        }
    }
}

/// The npm package words these itself; tests/package/errors.test.ts expects the same.
#[test]
fn messages_spell_numbers_plainly() {
    let view = |viewpoint, options| refused(&[[3.0, 4.0, 0.0]], viewpoint, options).to_string();
    let at = |options| view(ORIGIN, options);
    assert_eq!(
        PointCloud::new(&[[0.0; 3], [NAN; 3]])
            .err()
            .unwrap()
            .to_string(),
        "1 point(s) have a coordinate that is NaN or infinite, the first at index 1"
    );
    assert_eq!(
        view([0.0, NAN, 5.5], Options::default()),
        "the viewpoint must be finite, got 0, NaN, 5.5"
    );
    assert_eq!(
        at(Options::with_radius(INF)),
        "radius must be finite and positive, got infinity"
    );
    assert_eq!(
        at(Options::with_radius(-0.0)),
        "radius must be finite and positive, got -0"
    );
    assert_eq!(
        at(Options::with_radius(1.2e-6)),
        "radius 0.0000012 is smaller than the distance of the farthest point, 5"
    );
    assert_eq!(
        at(Options::with_radius(1.2e-7)),
        "radius 1.2e-7 is smaller than the distance of the farthest point, 5"
    );
    assert_eq!(
        at(Options::with_radius(1.5e308)),
        "twice the radius 1.5e308 exceeds the range of f64 (the farthest distance is 5)"
    );
    assert_eq!(
        refused(&[[1e200, 0.0, 0.0]], ORIGIN, Options::default()).to_string(),
        "the farthest distance (infinity) exceeds the range of f64"
    );
    assert_eq!(
        at(Options::with_exponent(-1e20)),
        "exponent must be finite and at least 0, got -100000000000000000000"
    );
    assert_eq!(
        at(Options::with_exponent(-1e21)),
        "exponent must be finite and at least 0, got -1e21"
    );
    let mut cloud = PointCloud::new(&POINTS).unwrap();
    assert_eq!(
        cloud.remove(&[3]).unwrap_err().to_string(),
        "index 3 is out of range for a cloud of length 3"
    );
}

#[test]
fn a_refusal_leaves_the_cloud_usable() {
    let cloud = PointCloud::new(&POINTS).unwrap();
    let before = cloud.visible_from(ORIGIN, &Options::default()).unwrap();
    for radius in [
        Radius::Absolute(1.0),
        Radius::Exponent(-1.0),
        Radius::Absolute(NAN),
    ] {
        assert!(
            cloud
                .visible_from(ORIGIN, &Options::default().radius(radius))
                .is_err()
        );
    }
    let after = cloud.visible_from(ORIGIN, &Options::default()).unwrap();
    assert_eq!(before.indices(), after.indices());
}

#[test]
fn nothing_the_range_allows_panics() {
    let extremes = [
        f64::MAX,
        -f64::MAX,
        1e308,
        1e154,
        1.0,
        1e-154,
        1e-308,
        5e-324,
        0.0,
    ];
    let mut points = Vec::new();
    for x in extremes {
        for y in extremes {
            points.push([x, y, 0.0]);
            points.push([y, 1.0, x]);
        }
    }
    for &viewpoint in &points {
        for n in [1, 2, 3, 5, points.len()] {
            let cloud = PointCloud::new(&points[..n]).unwrap();
            for options in [
                Options::default(),
                Options::with_exponent(3.0),
                Options::with_radius(1e300),
            ] {
                // Most of these overflow and are refused; the others are answered.
                if let Ok(answer) = cloud.visible_from(viewpoint, &options) {
                    assert!(answer.count() <= n && answer.radius().is_finite());
                }
            }
        }
    }
}
