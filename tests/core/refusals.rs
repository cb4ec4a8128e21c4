//! Bad input: every error occurs, and valid input is not refused.

use hidden_point_removal::{
    Error, Exponential, Horizon, Inversion, Lighting, MAX_POINTS, MapOptions, NonFinite, Options,
    PanoramaOptions, Placing, PointCloud, Radius, Surface, Visibility, Within,
};

use crate::common::{NOWHERE, refused};
use crate::test;

const NAN: f64 = f64::NAN;
const INF: f64 = f64::INFINITY;
const ORIGIN: [f64; 3] = [0.0; 3];
const AHEAD: [f64; 3] = [0.0, 0.0, 5.0];
const SMALLER: &str = "smaller than the distance of the farthest point";
const NO_RADIUS: &str = "radius must be finite and positive";
const POINTS: [[f64; 3]; 3] = [[3.0, 4.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -2.0]];

type View = Result<Visibility, Error>;

fn view(points: &[[f64; 3]], viewpoint: [f64; 3], options: Options) -> View {
    let cloud = PointCloud::new(points).unwrap();
    cloud.visible_from(viewpoint, &options)
}

/// A question to a cloud from a viewpoint, or along it.
type Question = fn(&PointCloud, [f64; 3], &Options) -> Result<(), Error>;

const QUESTIONS: [(&str, Question); 15] = [
    ("view", |c, at, o| c.visible_from(at, o).map(drop)),
    ("slices", |c, at, o| c.observer().go_on(at, o, 9).map(drop)),
    ("several", |c, at, o| c.visible_from_any(&[at], o).map(drop)),
    ("two", |c, at, o| {
        c.visible_from_at_least(2, &[at; 2], o).map(drop)
    }),
    ("coverage", |c, at, o| c.coverage(&[at], o).map(drop)),
    ("placement", |c, at, o| {
        c.place_viewpoints(&[at], o, &Placing::default()).map(drop)
    }),
    ("sees", |c, at, o| c.sees(at, &[[0.1; 3]], o).map(drop)),
    ("map", |c, at, o| {
        c.visibility_map(at, o, &MapOptions::default()).map(drop)
    }),
    ("panorama", |c, at, o| {
        c.panorama(at, o, &PanoramaOptions::default()).map(drop)
    }),
    ("mesh", |c, at, o| c.reconstruct(at, o, None).map(drop)),
    ("light", |c, at, o| {
        c.illuminate(&[at], o, &Lighting::default()).map(drop)
    }),
    ("none", |c, _, o| c.visible_from_any(&NOWHERE, o).map(drop)),
    ("dark", |c, _, o| {
        c.illuminate(&[], o, &Lighting::default()).map(drop)
    }),
    ("direction", |c, at, o| {
        c.visible_from_direction(at, o).map(drop)
    }),
    ("horizon", |_, at, o| Horizon::new(at, o).map(drop)),
];

/// What no question takes, and words of its refusal.
fn wrong_options() -> Vec<(&'static str, Options)> {
    let (plain, looks) = (Options::default(), Options::looks(3));
    let by = |radius| plain.with_radius(radius);
    let within = |distance, bounds| plain.with_within(Within { distance, bounds });
    let exponential = |scale| Options::inversion(Inversion::Exponential(scale));
    let power = |gamma| Options::inversion(Inversion::Power(gamma));
    let automatic = exponential(Exponential::Auto);
    let [radius, small] = [9.0, 0.5].map(Radius::Absolute);
    let exponent = Radius::Exponent(2.0);
    let mut wrong = vec![
        ("scores cannot be combined", plain.with_scores(true)),
        ("thickness cannot be combined", plain.with_thickness(0.1)),
        ("surface cannot be", plain.with_surface(Surface::Clean)),
        ("looks cannot be", looks.with_radius(Radius::Opposite)),
        ("looks cannot be combined", looks.with_radius(radius)),
        ("looks cannot be combined", looks.with_radius(exponent)),
        ("cannot be combined", automatic.with_radius(radius)),
        (SMALLER, by(small)),
        (SMALLER, power(2.0).with_radius(small)),
    ];
    if cfg!(not(target_family = "wasm")) {
        for count in [257, usize::MAX] {
            wrong.push(("threads must be from 1 to 256", plain.with_threads(count)));
        }
    }
    for options in [power(2.0), automatic] {
        let opposite = options.with_radius(Radius::Opposite);
        wrong.push(("cannot be combined", opposite));
        wrong.push(("cannot be combined", options.with_radius(exponent)));
    }
    for bad in [NAN, INF, -INF, 0.0, -0.0, -5.0] {
        wrong.push((NO_RADIUS, by(Radius::Absolute(bad))));
        wrong.push(("exponential", exponential(Exponential::Scale(bad))));
        wrong.push(("power", power(bad)));
    }
    for bad in [NAN, INF, -0.5] {
        let exponent = "exponent must be finite and at least 0";
        wrong.push((exponent, by(Radius::Exponent(bad))));
        wrong.push(("thickness", looks.with_thickness(bad)));
    }
    for bad in [NAN, -1.0, -INF] {
        wrong.push(("within distance", within(Some(bad), None)));
    }
    for bounds in [[1.0, 0.0], [NAN, 0.0], [0.0, NAN]] {
        let bounds = bounds.map(|x| [x; 3]);
        wrong.push(("a box must be", within(None, Some(bounds))));
    }
    wrong.extend([1.0, 16.5].map(|gamma| ("power", power(gamma))));
    wrong.extend([0, 1, 4].map(|count| ("looks must be from", Options::looks(count))));
    wrong
}

#[test]
fn every_question_refuses_what_no_question_takes() {
    let cloud = PointCloud::new(&POINTS).unwrap();
    let empty = PointCloud::new::<[f64; 3]>(&[]).unwrap();
    for (name, ask) in QUESTIONS {
        for (words, options) in wrong_options() {
            let is_radius = [SMALLER, NO_RADIUS].contains(&words);
            let code = if is_radius { "radius" } else { "option" };
            for cloud in [&cloud, &empty] {
                // A radius is too small for some points only.
                if words == SMALLER
                    && (cloud.is_empty() || ["none", "dark", "horizon"].contains(&name))
                {
                    continue;
                }
                let title = format!("{name}, {words}, {options:?}");
                let error = ask(cloud, AHEAD, &options).expect_err(&title);
                // Some questions exclude what is wrong.
                let is_excluded = matches!(error, Error::Excludes { .. } | Error::MergeRadius);
                assert!(
                    error.to_string().contains(words) || is_excluded,
                    "{title}: {error}"
                );
                assert!(error.code() == code || is_excluded, "{title}: {error}");
            }
        }
        for axis in 0..3 {
            let mut nowhere = AHEAD;
            nowhere[axis] = [NAN, INF, -INF][axis];
            let found = ask(&cloud, nowhere, &Options::radius(9.0));
            if !["none", "dark"].contains(&name) {
                refused("viewpoint", "", found);
            }
        }
    }
}

#[test]
fn questions_refuse_what_they_have_no_answer_to() {
    let cloud = PointCloud::new(&POINTS).unwrap();
    let scores = Options::looks(3).with_scores(true);
    let opposite = Options::default().with_radius(Radius::Opposite);
    let power = Options::inversion(Inversion::Power(2.0));
    let near = Options::radius(9.0).with_within(Within {
        distance: Some(9.0),
        bounds: None,
    });
    for (names, words, options) in [
        (
            "several two coverage placement sees map panorama none",
            "scores",
            scores,
        ),
        ("mesh light dark horizon", "looks", Options::looks(3)),
        ("direction map", "radius \"opposite\"", opposite),
        ("direction", "inversion power", power),
        ("direction", "within distance", near),
        ("horizon", "within", near),
    ] {
        for name in names.split(' ') {
            let (_, ask) = QUESTIONS.iter().find(|(other, _)| *other == name).unwrap();
            let words = format!("{words} cannot be combined with");
            refused("option", &words, ask(&cloud, AHEAD, &options));
        }
    }
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
