//! Views in slices, so that a viewer can give them up. The check `slices` compares answers.

use hidden_point_removal::{Observer, Options, PointCloud, Visibility};

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
fn each_slice_is_a_part_of_the_work() {
    let scene = KINDS[0].scene(8, 2500);
    let cloud = PointCloud::new(&scene.points).unwrap();
    let slices = |budget| in_slices(&mut cloud.observer(), scene.viewpoint, &looks(3), budget).1;
    // The begin of the hull, its rest, up to three looks and the points that follow neighbors.
    let coarse = slices(1_000_000);
    assert!((3..=5).contains(&coarse), "{coarse}");
    assert!(slices(200) > coarse + 3);
}
