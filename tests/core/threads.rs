//! Threads change no answer: neither its bits nor a refusal.

use std::fmt::Debug;

use hidden_point_removal::{
    Convention, Error, Exponential, Inversion, Lighting, Options, Placing, PointCloud, Radius,
    Threads, Within, ring_of_viewpoints,
};

use crate::common::cameras::camera;
use crate::common::rng::Rng;
use crate::common::scenes::{EXTREME, KINDS};
use crate::common::{shapes, structured};

const COUNTS: [usize; 4] = [1, 2, 3, 8];

/// The answers to all questions that threads share, as text. Numbers that differ in a bit differ
/// in their text.
fn answers(cloud: &Threads, viewpoints: &[[f64; 3]], options: &Options) -> Vec<String> {
    fn text<T: Debug>(name: &str, answer: Result<T, Error>) -> String {
        format!("{name}: {answer:?}")
    }
    let weights: Vec<f64> = (0..cloud.len()).map(|i| 1.0 / (1.0 + i as f64)).collect();
    let placing = Placing {
        count: Some(3),
        share: Some(0.9),
        weights: Some(&weights),
    };
    let mut texts = vec![
        text("any", cloud.visible_from_any(viewpoints, options)),
        text("two", cloud.visible_from_at_least(2, viewpoints, options)),
        text("coverage", cloud.coverage(viewpoints, options)),
        text(
            "all",
            cloud.place_viewpoints(viewpoints, options, &Placing::default()),
        ),
        text(
            "some",
            cloud.place_viewpoints(viewpoints, options, &placing),
        ),
        text(
            "light",
            cloud.illuminate(viewpoints, options, &Lighting::default()),
        ),
    ];
    for &viewpoint in viewpoints.iter().take(2) {
        texts.push(text("view", cloud.visible_from(viewpoint, options)));
        let ahead = viewpoint.map(|x| -x);
        let camera = camera(&mut Rng::new(1), viewpoint, ahead, Convention::OpenCv);
        texts.push(text("camera", cloud.visible_from_camera(&camera, options)));
        texts.push(text("mesh", cloud.reconstruct(viewpoint, options, None)));
    }
    texts
}

/// Returns how many of the answers are refusals.
fn compare(points: &[[f64; 3]], viewpoints: &[[f64; 3]], options: &Options, title: &str) -> usize {
    let cloud = PointCloud::new(points).unwrap();
    let [one, several @ ..] = COUNTS.map(|count| {
        let cloud = cloud.with_threads(count).unwrap();
        answers(&cloud, viewpoints, options)
    });
    for (count, answers) in COUNTS[1..].iter().zip(several) {
        for (answer, expected) in answers.iter().zip(&one) {
            let shown = |text: &str| text.chars().take(300).collect::<String>();
            assert!(
                answer == expected,
                "{title}, {options:?}, {count} threads:\n{}\n{}",
                shown(answer),
                shown(expected)
            );
        }
    }
    one.iter().filter(|text| text.contains(": Err(")).count()
}

/// Options of every kind.
fn kinds_of_options(farthest: f64) -> Vec<Options> {
    let plain = Options::default();
    let [exponential, power, looks] = [
        Inversion::Exponential(Exponential::Auto),
        Inversion::Power(2.0),
        Inversion::Looks(3),
    ]
    .map(Options::with_inversion);
    let [search, opposite] = [Radius::Search, Radius::Opposite].map(|radius| plain.radius(radius));
    let within = Within {
        distance: Some(farthest),
        bounds: None,
    };
    let nearby = Some(within);
    vec![
        plain,
        Options::with_exponent(2.5),
        Options::with_exponent(9.0),
        // Too small for some viewpoints.
        Options::with_radius(1.01 * farthest),
        exponential,
        power,
        looks,
        looks.vote(3),
        looks.thickness(0.01),
        search,
        opposite,
        plain.vote(4),
        plain.denoise(5),
        plain.draft(true),
        plain.sample(200),
        plain.within(nearby),
        exponential.within(nearby),
    ]
}

fn scattered(rng: &mut Rng, count: usize, scale: f64) -> Vec<[f64; 3]> {
    (0..count)
        .map(|_| rng.direction().map(|x| scale * x))
        .collect()
}

#[test]
fn threads_change_no_answer() {
    for kind in KINDS {
        for (seed, n) in [(1, 0), (2, 1), (3, 7), (4, 65), (5, 2100)] {
            let scene = kind.scene(seed, n);
            let mut viewpoints = scattered(&mut Rng::new(seed), 4, 2.0);
            viewpoints.insert(1, scene.viewpoint);
            let title = format!("{} with seed {seed}", kind.name);
            compare(&scene.points, &viewpoints, &scene.options, &title);
            compare(&scene.points, &viewpoints[..1], &Options::default(), &title);
        }
    }
}

#[test]
fn nor_do_they_with_any_options() {
    let mut rng = Rng::new(31);
    let mut bumpy = shapes::bumpy(&mut rng, 600);
    // Equal points, and points in one plane.
    bumpy.extend_from_within(300..400);
    bumpy.extend(shapes::disc(&mut rng, 200));
    let mut answered = 0;
    for points in [&bumpy[..], &bumpy[..3], &shapes::grid(&mut rng, 400)] {
        let mut viewpoints = scattered(&mut rng, 3, 3.0);
        // At a point, and in a plane of points.
        viewpoints.extend([points[0], [0.1, 0.2, 0.0]]);
        for options in kinds_of_options(3.5) {
            for count in [0, 5] {
                let refused = compare(points, &viewpoints[..count], &options, "a cloud");
                answered += usize::from(refused == 0);
            }
        }
    }
    assert!(answered > 20, "{answered}");
}

/// Small clouds are shared among fewer threads.
#[test]
fn nor_do_they_where_each_has_a_sector() {
    let mut rng = Rng::new(32);
    for points in [shapes::bumpy(&mut rng, 8200), shapes::room(&mut rng, 8200)] {
        let viewpoints = scattered(&mut rng, 2, 2.0);
        let plain = Options::default();
        let vote = plain.vote(4);
        let draft = plain.draft(true);
        let distance = Some(2.5);
        let within = Some(Within {
            distance,
            bounds: None,
        });
        let nearby = plain.within(within);
        for options in [plain, Options::with_exponent(2.5), vote, draft, nearby] {
            compare(&points, &viewpoints[..1], &options, "a large cloud");
            compare(&points, &viewpoints, &options, "a large cloud");
        }
    }
}

#[test]
fn extreme_numbers_and_aligned_viewpoints_are_shared_too() {
    for kind in EXTREME {
        let scene = kind.scene(1, 150);
        compare(&scene.points, &[scene.viewpoint], &scene.options, kind.name);
    }
    let mut rng = Rng::new(8);
    for &(kind, shape) in structured::SHAPES {
        let scene = structured::scene(&mut rng, (kind, shape), 700);
        let other = structured::viewpoint(&mut rng, &scene.points);
        let viewpoints = [scene.viewpoint, other];
        compare(&scene.points, &viewpoints, &scene.options, kind);
    }
}

#[test]
fn of_several_refusals_the_first_one_is_reported() {
    let points = shapes::bumpy(&mut Rng::new(2), 800);
    let cloud = PointCloud::new(&points).unwrap();
    let mut viewpoints = ring_of_viewpoints([0.0, 0.0, 4.0], [0.0; 3], 40, 0.2).unwrap();
    for bad in 11..40 {
        viewpoints[bad] = [bad as f64, f64::NAN, 0.0];
    }
    for _ in 0..20 {
        let refused = cloud
            .with_threads(8)
            .unwrap()
            .coverage(&viewpoints, &Options::default());
        let Err(Error::Viewpoint { viewpoint }) = refused else {
            panic!("{refused:?}");
        };
        assert_eq!(viewpoint[0], 11.0);
    }
}

#[test]
fn a_number_of_threads_is_from_1_to_256() {
    let cloud = PointCloud::new(&[[0.0; 3]]).unwrap();
    for count in [0, 257, usize::MAX] {
        let refused = cloud.with_threads(count).unwrap_err();
        assert_eq!(refused.code(), "option");
        assert!(
            refused
                .to_string()
                .starts_with("threads must be from 1 to 256")
        );
    }
    assert!(cloud.with_threads(256).is_ok());
}
