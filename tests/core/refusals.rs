//! Bad input: every error occurs, and valid input is not refused.

use hidden_point_removal::{Error, MAX_POINTS, NonFinite, Options, PointCloud, Radius, Visibility};

use crate::common::refused;
use crate::test;

const NAN: f64 = f64::NAN;
const INF: f64 = f64::INFINITY;
const ORIGIN: [f64; 3] = [0.0; 3];
const POINTS: [[f64; 3]; 3] = [[3.0, 4.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -2.0]];

type View = Result<Visibility, Error>;

fn view(points: &[[f64; 3]], viewpoint: [f64; 3], options: Options) -> View {
    let cloud = PointCloud::new(points).unwrap();
    cloud.visible_from(viewpoint, &options)
}

#[test]
fn positions_that_are_not_finite_are_counted_and_located() {
    let words = |count, first| {
        format!(
            "{count} point(s) have a coordinate that is NaN or infinite, the first at index {first}"
        )
    };
    let double = PointCloud::new(&[[0.0; 3], [1.0, NAN, NAN], [INF, 0.0, -INF], [2.0; 3]]);
    refused("non-finite", &words(2, 1), double);
    let single = PointCloud::new(&[[0.0f32, f32::NEG_INFINITY, 0.0]]);
    refused("non-finite", &words(1, 0), single);
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
    let text = format!("{cloud:?}");
    assert_eq!(text, "PointCloud { len: 4, skipped: 4, .. }");
}

#[test]
fn a_viewpoint_that_is_not_finite_is_refused() {
    for bad in [NAN, INF, -INF] {
        for axis in 0..3 {
            let mut viewpoint = [1.0; 3];
            viewpoint[axis] = bad;
            for points in [&POINTS[..], &[]] {
                refused("viewpoint", "", view(points, viewpoint, Options::default()));
                let cloud = PointCloud::new(points).unwrap();
                refused("viewpoint", "", cloud.auto_radius(viewpoint, Radius::Auto));
            }
        }
    }
}

#[test]
fn numbers_that_are_no_radius_or_exponent_are_refused() {
    for points in [&POINTS[..], &[]] {
        for bad in [NAN, INF, -INF, 0.0, -0.0, -5.0] {
            let found = view(points, ORIGIN, Options::radius(bad));
            refused("radius", "radius must be finite and positive", found);
        }
        for bad in [NAN, INF, -INF, -0.5] {
            let found = view(points, ORIGIN, Options::exponent(bad));
            refused("option", "exponent must be finite and at least 0", found);
        }
    }
}

#[test]
fn distances_and_radii_beyond_the_range_are_refused() {
    let far = [[1e200, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for options in [
        Options::default(),
        Options::exponent(0.0),
        Options::radius(1e300),
    ] {
        refused(
            "radius",
            "the farthest distance (infinity)",
            view(&far, ORIGIN, options),
        );
    }
    let cloud = PointCloud::new(&far).unwrap();
    refused("radius", "", cloud.auto_radius(ORIGIN, Radius::Auto));
    // p − C itself overflows.
    let end = [f64::MAX, 0.0, 0.0];
    refused(
        "radius",
        "",
        view(&[end], end.map(|x| -x), Options::default()),
    );
    for options in [
        Options::radius(f64::MAX),
        Options::exponent(308.0),
        Options::exponent(1e300),
    ] {
        refused(
            "radius",
            "radius must be at most 8.98e307",
            view(&POINTS, ORIGIN, options),
        );
    }
}

/// The npm package words these itself; tests/package/errors.test.ts expects the same.
#[test]
fn messages_spell_numbers_plainly() {
    use Radius::{Absolute, Exponent};
    let point = [[3.0, 4.0, 0.0]];
    let small = "is smaller than the distance of the farthest point, 5";
    let small = |radius: &str| format!("radius {radius} {small}");
    let large = "radius must be at most 8.98e307, got 1.5e308 (an exponent e makes it 5 * 10^e)";
    for (code, message, radius) in [
        ("radius", "finite and positive, got infinity", Absolute(INF)),
        ("radius", "finite and positive, got -0", Absolute(-0.0)),
        ("radius", &small("4.5"), Absolute(4.5)),
        ("radius", &small("0.0000012"), Absolute(1.2e-6)),
        ("radius", &small("1.2e-7"), Absolute(1.2e-7)),
        ("radius", large, Absolute(1.5e308)),
        (
            "option",
            "at least 0, got -100000000000000000000",
            Exponent(-1e20),
        ),
        ("option", "at least 0, got -1e21", Exponent(-1e21)),
    ] {
        refused(
            code,
            message,
            view(&point, ORIGIN, Options::default().with_radius(radius)),
        );
    }
    let nowhere = view(&point, [0.0, NAN, 5.5], Options::default());
    refused(
        "viewpoint",
        "the viewpoint must be finite, got 0, NaN, 5.5",
        nowhere,
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
                .visible_from(ORIGIN, &Options::default().with_radius(radius))
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
                Options::exponent(3.0),
                Options::radius(1e300),
            ] {
                // Most of these overflow and are refused; the others are answered.
                if let Ok(answer) = cloud.visible_from(viewpoint, &options) {
                    assert!(answer.count() <= n && answer.radius().is_finite());
                }
            }
        }
    }
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
