//! Orthographic views. They are compared with the lower boundary of the lifted points, and
//! with views from viewpoints that move farther and farther away.

use hidden_point_removal::{Exponential, Inversion, Options, PointCloud, Radius, Visibility};

use crate::common::rng::Rng;
use crate::common::{ask, refused, shapes};
use crate::test;

fn along(points: &[[f64; 3]], direction: [f64; 3], options: &Options) -> Visibility {
    let cloud = PointCloud::new(points).unwrap();
    cloud.visible_from_direction(direction, options).unwrap()
}

fn exponential(scale: f64) -> Options {
    Options::inversion(Inversion::Exponential(Exponential::Scale(scale)))
}

fn looks(count: usize) -> Options {
    Options::looks(count).with_scores(true)
}

#[test]
fn it_is_the_limit_of_receding_viewpoints() {
    let mut rng = Rng::new(32);
    for shape in [shapes::bumpy, shapes::ball, shapes::room] {
        let points = shape(&mut rng, 1500);
        let direction = rng.direction();
        let apart = |times: f64, options: &Options, a: f64| {
            let viewpoint = direction.map(|x| -x * times);
            let by_radius = Options::radius(a * times * times);
            let far = if options.inversion == Inversion::Spherical {
                ask(&points, viewpoint, &by_radius)
            } else {
                ask(&points, viewpoint, options)
            };
            let limit = along(&points, direction, options).mask();
            let differ = far
                .mask()
                .iter()
                .zip(&limit)
                .filter(|(a, b)| a != b)
                .count();
            differ as f64 / far.count() as f64
        };
        let c = 0.01;
        for (options, a) in [
            (exponential(c), 0.5 / c),
            (Options::default(), automatic_bend(&points)),
        ] {
            let [near, mid, far] = [50.0, 500.0, 50_000.0].map(|times| apart(times, &options, a));
            assert!(
                mid <= 0.5 * near && far < mid.max(1e-9),
                "{near} {mid} {far}"
            );
            assert!(far < 0.002, "{far}");
        }
    }
}

/// 0.4·n^¼/g, from the closed form R = 0.4·n^¼·r²/g at three distances.
fn automatic_bend(points: &[[f64; 3]]) -> f64 {
    let cloud = PointCloud::new(points).unwrap();
    let radius = |z| {
        let viewpoint = [0.0, 0.0, z];
        cloud.auto_radius(viewpoint, Radius::Auto).unwrap().radius
    };
    // R is a·(z² + …). Its second difference over z, by the step, gives a.
    (radius(1e3) - 2.0 * radius(0.0) + radius(-1e3)) / 2e6
}

#[test]
fn a_number_fixes_the_bend_from_one_diagonal_away() {
    let points = shapes::bumpy(&mut Rng::new(33), 900);
    let direction = [1.0, -2.0, 0.5];
    let automatic = along(&points, direction, &Options::default());
    assert!(automatic.radius() > 0.0 && automatic.exponent() > 0.0);
    assert_eq!(automatic.evaluations(), 0);
    let again = along(&points, direction, &Options::radius(automatic.radius()));
    assert_eq!(again.indices(), automatic.indices());
    let again = along(&points, direction, &Options::exponent(automatic.exponent()));
    assert_eq!(again.indices(), automatic.indices());
    let more = along(
        &points,
        direction,
        &Options::exponent(automatic.exponent() + 1.0),
    );
    assert!(more.count() > automatic.count());
    let scale = 0.5 / automatic_bend(&points);
    let exponential = along(&points, direction, &exponential(scale));
    assert_eq!(exponential.indices(), automatic.indices());
    assert_eq!((exponential.radius(), exponential.exponent()), (0.0, 0.0));
}

#[test]
fn few_points_and_extreme_sizes_are_answered() {
    let down = [0.0, 0.0, -1.0];
    let o = &Options::default();
    assert_eq!(along(&[], down, o).count(), 0);
    assert_eq!(along(&[[1.0, 2.0, 3.0]], down, o).indices(), [0]);
    assert_eq!(
        along(&[[0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]], down, o).indices(),
        [1, 2]
    );
    for size in [1e-320, 1e-300, 1e-150, 1e100, 1e150] {
        let points = [
            [0.0; 3],
            [0.0, 0.0, size],
            [size, 0.0, 0.0],
            [size, size, size],
        ];
        assert_eq!(along(&points, down, o).indices(), [1, 2, 3], "{size}");
        let single = [[size; 3]];
        assert_eq!(along(&single, down, o).indices(), [0], "{size}");
    }
    for direction in [[5e-324, 0.0, 0.0], [f64::MAX, f64::MAX, -f64::MAX]] {
        assert_eq!(along(&[[0.0; 3]], direction, o).count(), 1);
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let cloud = PointCloud::new(&shapes::bumpy(&mut Rng::new(3), 20)).unwrap();
    let ask = |direction, options| cloud.visible_from_direction(direction, &options);
    for direction in [[0.0; 3], [f64::NAN, 1.0, 0.0], [f64::INFINITY, 0.0, 0.0]] {
        for options in [Options::default(), Options::looks(3)] {
            refused("viewpoint", "direction", ask(direction, options));
        }
    }
}

#[test]
fn looks_along_it_are_the_limit_of_looks_from_farther_and_farther_away() {
    let mut rng = Rng::new(33);
    for (shape, count) in [
        (shapes::bumpy as fn(&mut Rng, usize) -> _, 3),
        (shapes::ball, 2),
        (shapes::room, 3),
    ] {
        let points: Vec<[f64; 3]> = shape(&mut rng, 1500);
        let direction = rng.direction();
        let limit = along(&points, direction, &looks(count));
        let apart = |times: f64| {
            let far = ask(&points, direction.map(|x| -x * times), &looks(count));
            assert_eq!(far.looks(), limit.looks());
            let masks = far.mask().into_iter().zip(limit.mask());
            let scores = far.scores().iter().zip(limit.scores());
            let differ = masks.filter(|(a, b)| a != b).count();
            let distance = scores.map(|(a, b)| f64::from((a - b).abs())).sum::<f64>();
            (differ as f64 / 1500.0, distance / 1500.0)
        };
        let [near, mid, far] = [20.0, 200.0, 20_000.0].map(apart);
        assert!(
            mid.0 <= 0.5 * near.0 + 0.001 && mid.1 < 0.5 * near.1,
            "{near:?} {mid:?}"
        );
        assert!(far.0 < 0.003 && far.1 < 0.003, "{far:?}");
    }
}

#[test]
fn looks_at_degenerate_clouds_answer_as_documented() {
    let down = [0.0, 0.0, -1.0];
    let seen = |points: &[[f64; 3]]| {
        let answer = along(points, down, &looks(3));
        (answer.indices().to_vec(), answer.scores().to_vec())
    };
    let origin = [0.0; 3];
    assert_eq!(seen(&[]), (vec![], vec![]));
    assert_eq!(seen(&[origin]), (vec![0], vec![1.0]));
    assert_eq!(seen(&[origin; 3]), (vec![0, 1, 2], vec![1.0; 3]));
    // On one ray only the nearest is visible.
    let ray = [[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], origin];
    assert_eq!(seen(&ray), (vec![1], vec![0.2, 1.0, 0.2]));
    let triangle = [origin, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(seen(&triangle[..2]), (vec![0, 1], vec![1.0; 2]));
    assert_eq!(seen(&triangle).0, [0, 1, 2]);
    let with = |p| [triangle[0], triangle[1], triangle[2], p];
    assert_eq!(seen(&with([0.2, 0.2, -3.0])).0, [0, 1, 2]);
    assert_eq!(seen(&with([0.3, 0.3, -0.01])).0, [0, 1, 2, 3]);
    // A grid that the rays meet at right angles: four points of each cell are on one face.
    let grid: Vec<_> = (0..49)
        .map(|i| [f64::from(i % 7), f64::from(i / 7), 0.0])
        .collect();
    assert_eq!(seen(&grid).0.len(), 49);
    // A coordinate as large as those of maps does not change the answer.
    let mut rng = Rng::new(4);
    let points: Vec<[f64; 3]> = shapes::bumpy(&mut rng, 800)
        .into_iter()
        .map(|p: [f64; 3]| p.map(|x| (x * 1024.0).round() / 1024.0))
        .collect();
    let far: Vec<_> = points
        .iter()
        .map(|p| [p[0] + 524_288.0, p[1] + 5_242_880.0, p[2]])
        .collect();
    let (near, far) = (
        along(&points, down, &looks(3)),
        along(&far, down, &looks(3)),
    );
    let differ = near
        .mask()
        .iter()
        .zip(far.mask())
        .filter(|(a, b)| **a != *b)
        .count();
    assert!(differ < 8, "{differ}");
}
