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
