//! Views that start from the last view. After any earlier views, the answer equals the
//! answer of a cold view to the bit.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use hidden_point_removal::{Options, PointCloud, Radius};

use crate::common::rng::Rng;
use crate::common::scenes::{EXTREME, KINDS};
use crate::common::shapes::{self, Points};
use crate::common::walk::{Walk, difference};

/// Walks around in a cloud and compares every view. Returns how many views started from
/// the view before.
fn walk(
    points: &Points,
    viewpoint: [f64; 3],
    options: Options,
    steps: usize,
    seed: u64,
    title: &str,
) -> usize {
    let cloud = PointCloud::new(points).unwrap();
    let mut observer = cloud.observer();
    let mut rng = Rng::new(seed);
    let mut walk = Walk::new(points, viewpoint, options);
    let mut warm = 0;
    for step in 0..steps {
        if let Some(difference) = difference(&cloud, &mut observer, walk.viewpoint, &walk.options) {
            panic!(
                "{title}, {} points, seed {seed}, step {step} to {:?} with {:?}: {difference}",
                points.len(),
                walk.viewpoint,
                walk.options
            );
        }
        warm += usize::from(observer.moved());
        walk.step(&mut rng);
    }
    warm
}

/// Clouds large enough for a map of directions, with a viewpoint to start from.
fn large_clouds() -> Vec<(&'static str, Points, [f64; 3])> {
    let rng = &mut Rng::new(20);
    let far_away = |p: [f64; 3]| {
        let place = [523_000.0, 4_657_000.0, 120.0];
        core::array::from_fn(|i| place[i] + (p[i] * 20_000.0).round() / 1000.0)
    };
    let lattice = |n: i32, scale: [f64; 3]| {
        let points = (0..n * n * n).map(|i| [i % n, i / n % n, i / n / n].map(f64::from));
        points
            .map(|p| core::array::from_fn(|i| p[i] * scale[i]))
            .collect()
    };
    vec![
        ("bumpy", shapes::bumpy(rng, 20_000), [0.0, 0.5, 2.5]),
        (
            "bumpy from inside",
            shapes::bumpy(rng, 4000),
            [0.1, 0.2, 0.1],
        ),
        ("bumpy close by", shapes::bumpy(rng, 4000), [0.0, 0.0, 1.05]),
        ("room", shapes::room(rng, 8000), [-1.0, -1.5, 0.2]),
        ("ball", shapes::ball(rng, 3000), [0.0, 0.0, 1.1]),
        ("sphere", shapes::sphere(rng, 3000), [0.0; 3]),
        ("disc", shapes::disc(rng, 3000), [0.3, 0.2, 0.1]),
        ("disc edge-on", shapes::disc(rng, 2100), [3.0, 0.0, 0.0]),
        ("lattice", lattice(14, [1.0; 3]), [6.5, 6.5, 30.0]),
        (
            "lattice from a point",
            lattice(13, [1.0, 2.0, 4.0]),
            [6.0, 6.0, 20.0],
        ),
        ("duplicates", shapes::duplicates(rng, 7000), [0.0, 2.0, 0.0]),
        (
            "georeferenced",
            shapes::bumpy(rng, 5000).into_iter().map(far_away).collect(),
            far_away([0.0, 0.0, 2.5]),
        ),
    ]
}

#[test]
fn walks_around_every_kind_of_scene_are_answered_as_cold() {
    for kind in KINDS {
        for (seed, n) in [(1, 0), (2, 3), (3, 5), (4, 9), (5, 60), (6, 400), (7, 2300)] {
            let scene = kind.scene(seed, n);
            let steps = if n < 100 { 40 } else { 12 };
            walk(
                &scene.points,
                scene.viewpoint,
                scene.options,
                steps,
                seed,
                kind.name,
            );
        }
    }
}

#[test]
fn walks_among_extreme_numbers_are_answered_as_cold() {
    for kind in EXTREME {
        for seed in 1..12 {
            let scene = kind.scene(seed, 4 + 9 * seed as usize);
            walk(
                &scene.points,
                scene.viewpoint,
                scene.options,
                20,
                seed,
                kind.name,
            );
        }
    }
}

#[test]
fn walks_around_large_clouds_are_answered_as_cold() {
    for (seed, (title, points, viewpoint)) in (1..).zip(large_clouds()) {
        walk(&points, viewpoint, Options::default(), 40, seed, title);
    }
}

/// Otherwise the tests above would compare cold views with cold views.
#[test]
fn small_steps_start_from_the_last_view() {
    for (title, points, viewpoint) in large_clouds() {
        let cloud = PointCloud::new(&points).unwrap();
        let mut observer = cloud.observer();
        let mut rng = Rng::new(21);
        let mut walk = Walk::new(&points, viewpoint, Options::default());
        let mut warm = 0;
        for step in 0..=20 {
            let different = difference(&cloud, &mut observer, walk.viewpoint, &walk.options);
            assert_eq!(different, None, "{title}, step {step}");
            warm += usize::from(observer.moved());
            walk.viewpoint = walk.near(&mut rng, 1e-4);
        }
        // The faces of points in one plane or on one line may turn over by rounding alone.
        let ordinary = !title.contains("lattice") && !title.contains("edge-on");
        assert!(!ordinary || warm >= 18, "{title}: {warm} of 20");
    }
}

/// A surface that is much denser towards one pole: its hull has vertices with many neighbors.
fn uneven(n: usize) -> Points {
    let rng = &mut Rng::new(27);
    let place = |_| {
        let [x, y, _] = rng.direction();
        let z = 1.0 - 2.0 * rng.between(0.0, 1.0).powi(4);
        let away = ((1.0 - z * z) / (x * x + y * y)).sqrt();
        let r = 1.0 + 0.7 * x * y * z;
        [x * away * r, y * away * r, z * r]
    };
    (0..n).map(place).collect()
}

/// The first view after a view from elsewhere, and the second one, at steps from those that change
/// little to those that change too much.
#[test]
fn first_moves_are_answered_as_cold() {
    let (mut moves, mut warm) = (0, 0);
    let clouds = large_clouds()
        .into_iter()
        .chain([("uneven", uneven(6000), [0.9, 1.2, 2.0])]);
    for (title, points, viewpoint) in clouds {
        let cloud = PointCloud::new(&points).unwrap();
        let mut rng = Rng::new(28);
        for exponent in [2.7, 4.0] {
            let options = Options::with_exponent(exponent);
            let mut walk = Walk::new(&points, viewpoint, options);
            for part in [1e-3, 6e-3, 1.2e-2, 2.5e-2] {
                let mut observer = cloud.observer();
                walk.viewpoint = viewpoint;
                for view in 0..3 {
                    let different = difference(&cloud, &mut observer, walk.viewpoint, &options);
                    assert_eq!(different, None, "{title}, {exponent}, {part}, view {view}");
                    moves += usize::from(view > 0);
                    warm += usize::from(observer.moved());
                    walk.viewpoint = walk.near(&mut rng, part);
                }
            }
        }
    }
    assert!(warm >= 112, "{warm} of {moves}");
}

/// Large steps make vertices of fine bumps cross each other. No vertex of such a knot can be taken out alone.
#[test]
fn knots_of_turned_faces_are_cleared() {
    let points = shapes::bumpy(&mut Rng::new(26), 40_000);
    let cloud = PointCloud::new(&points).unwrap();
    let options = Options::with_exponent(3.3);
    let mut observer = cloud.observer();
    let mut warm = 0;
    for step in 0..=40 {
        let angle = 0.011 * f64::from(step);
        let viewpoint = [3.0 * libm::sin(angle), 0.5, 3.0 * libm::cos(angle)];
        let different = difference(&cloud, &mut observer, viewpoint, &options);
        assert_eq!(different, None, "step {step}");
        warm += usize::from(observer.moved());
    }
    // Three of these only because holes are made around knots.
    assert!(warm >= 39, "{warm} of 40");
}

#[test]
fn flat_views_and_refusals_in_between_change_nothing() {
    let mut rng = Rng::new(22);
    for (title, points, viewpoint) in [
        ("disc", shapes::disc(&mut rng, 3000), [0.4, 0.2, 0.7]),
        ("bumpy", shapes::bumpy(&mut rng, 3000), [0.4, 0.2, 2.0]),
    ] {
        let cloud = PointCloud::new(&points).unwrap();
        let mut observer = cloud.observer();
        let mut view = |viewpoint, radius, step| {
            let options = Options {
                radius,
                ..Options::default()
            };
            let different = difference(&cloud, &mut observer, viewpoint, &options);
            assert_eq!(different, None, "{title}, {step} from {viewpoint:?}");
            observer.moved()
        };
        for step in 0..10 {
            let [x, y, z] = viewpoint.map(|x| x + 1e-5 * f64::from(step));
            view([x, y, z], Radius::Auto, "at first");
            assert!(view([x + 1e-6, y, z], Radius::Auto, "moved"), "{title}");
            match step % 5 {
                0 => view([x, y, 0.0], Radius::Auto, "in the plane"),
                1 => view([x, y, z], Radius::Absolute(0.1), "too small a radius"),
                2 => view([f64::NAN, y, z], Radius::Auto, "nowhere"),
                3 => view([x, y, z], Radius::Exponent(-1.0), "no exponent"),
                _ => view([1e300, y, z], Radius::Auto, "too far away"),
            };
            view([x, y, z], Radius::Auto, "after it");
        }
    }
}
