//! Views in slices, so that a viewer can give them up: the answers must stay the same.

use hidden_point_removal::{Exponential, Inversion, Observer, Options, PointCloud, Visibility};

use crate::common::scenes::KINDS;
use crate::test;

fn looks(count: usize) -> Options {
    Options::looks(count).with_scores(true)
}

/// The answer after slices of about `budget` points, and the number of slices.
fn in_slices(
    observer: &mut Observer,
    viewpoint: [f64; 3],
    options: &Options,
    budget: usize,
) -> (Visibility, usize) {
    let mut slices = 1;
    while !observer.go_on(viewpoint, options, budget).unwrap() {
        slices += 1;
        assert!(slices < 1000, "the slices do not end");
    }
    (observer.visible_from(viewpoint, options).unwrap(), slices)
}

#[test]
fn slices_change_no_bit() {
    for kind in KINDS {
        for (seed, n, count) in [(1, 9, 3), (2, 300, 2), (3, 2500, 3)] {
            let scene = kind.scene(seed, n);
            let title = format!("{} with seed {seed}", kind.name);
            let cloud = PointCloud::new(&scene.points).unwrap();
            let options = looks(count);
            let whole = cloud.visible_from(scene.viewpoint, &options).unwrap();
            let mut observer = cloud.observer();
            for budget in [60, 700, 1_000_000] {
                let (sliced, _) = in_slices(&mut observer, scene.viewpoint, &options, budget);
                assert_eq!(sliced, whole, "{title}, slices of {budget}");
                assert_eq!(sliced.scores(), whole.scores(), "{title}");
            }
        }
    }
}

#[test]
fn slices_choose_the_same_triangle_where_a_ray_passes_through_an_edge() {
    // Two squares of rows, seen from a point of a row: the rays to all others pass through it.
    let square = |height: f64| {
        let side = |k: usize| (k % 125) as f64 / 125.0;
        (0..500).map(move |k| match k / 125 {
            0 => [side(k), 0.0, height + 0.3 * side(k)],
            1 => [1.0, side(k), height + 0.3],
            2 => [1.0 - side(k), 1.0, height + 0.3 * (1.0 - side(k))],
            _ => [0.0, 1.0 - side(k), height],
        })
    };
    let points: Vec<[f64; 3]> = square(0.0).chain(square(-0.5)).collect();
    let cloud = PointCloud::new(&points).unwrap();
    for (from, count) in [(140, 2), (148, 3), (188, 3), (204, 2)] {
        let viewpoint = points[from];
        let whole = cloud.visible_from(viewpoint, &looks(count)).unwrap();
        for budget in [1, 100] {
            let mut observer = cloud.observer();
            let (sliced, _) = in_slices(&mut observer, viewpoint, &looks(count), budget);
            assert_eq!(sliced, whole, "from {from}, slices of {budget}");
            assert_eq!(sliced.scores(), whole.scores(), "from {from}");
        }
    }
}

#[test]
fn other_questions_may_come_between_slices() {
    let scene = KINDS[0].scene(7, 2500);
    let cloud = PointCloud::new(&scene.points).unwrap();
    let viewpoint = scene.viewpoint;
    let elsewhere = viewpoint.map(|x| 1.1 * x + 0.3);
    let whole = |at, options: &Options| cloud.visible_from(at, options).unwrap();
    let between: [(&str, [f64; 3], Options); 5] = [
        ("one hull", viewpoint, Options::default()),
        ("a larger radius", viewpoint, Options::exponent(4.0)),
        ("two looks", viewpoint, looks(2)),
        ("no scores", viewpoint, Options::looks(3)),
        ("another place", elsewhere, looks(3)),
    ];
    let asked = [
        looks(3),
        Options::default(),
        Options::exponent(0.0),
        Options::inversion(Inversion::Power(1.5)),
        Options::inversion(Inversion::Exponential(Exponential::Auto)),
    ];
    for (options, (title, at, other)) in asked
        .iter()
        .flat_map(|asked| between.map(|other| (asked, other)))
    {
        let mut observer = cloud.observer();
        for begun in 1..12 {
            for _ in 0..begun {
                observer.go_on(viewpoint, options, 100).unwrap();
            }
            assert_eq!(
                observer.visible_from(at, &other).unwrap(),
                whole(at, &other),
                "{title}"
            );
            let (sliced, _) = in_slices(&mut observer, viewpoint, options, 100);
            assert_eq!(sliced, whole(viewpoint, options), "{title} after {begun}");
        }
    }
}

#[test]
fn each_slice_is_a_part_of_the_work() {
    let scene = KINDS[0].scene(8, 2500);
    let cloud = PointCloud::new(&scene.points).unwrap();
    let slices = |budget| in_slices(&mut cloud.observer(), scene.viewpoint, &looks(3), budget).1;
    // The begin of the hull, its rest, up to three looks and the points that follow neighbors.
    let coarse = slices(1_000_000);
    assert!((3..=5).contains(&coarse), "{coarse}");
    assert!(slices(200) > coarse + 3);
}

#[test]
fn a_view_of_some_points_does_not_go_on_from_slices_of_all() {
    let scene = KINDS[0].scene(9, 600);
    let cloud = PointCloud::new(&scene.points).unwrap();
    let viewpoint = scene.viewpoint;
    let distances = scene.points.iter().map(|p| {
        let squares = (0..3).map(|axis| (p[axis] - viewpoint[axis]).powi(2));
        squares.sum::<f64>().sqrt()
    });
    let mut sorted: Vec<f64> = distances.collect();
    sorted.sort_by(f64::total_cmp);
    let near = looks(3).with_within(hidden_point_removal::Within {
        distance: Some(sorted[300]),
        ..Default::default()
    });
    let mut observer = cloud.observer();
    for _ in 0..3 {
        observer.go_on(viewpoint, &looks(3), 100).unwrap();
    }
    let some = observer.visible_from(viewpoint, &near).unwrap();
    assert_eq!(some, cloud.visible_from(viewpoint, &near).unwrap());
}
