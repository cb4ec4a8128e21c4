//! The automatic radius: R = 0.4·n^¼·r²/g, never below the farthest distance. g is wider where the
//! surface has wide places without points.

use hidden_point_removal::{Options, PointCloud, Radius};

use crate::common::ask;
use crate::common::flip::{distance, farthest};
use crate::common::rng::Rng;
use crate::common::scenes::KINDS;
use crate::common::shapes;
use crate::test;

fn automatic(points: &[[f64; 3]], viewpoint: [f64; 3]) -> (f64, f64) {
    let cloud = PointCloud::new(points).unwrap();
    let chosen = cloud.auto_radius(viewpoint, Radius::Auto).unwrap();
    assert_eq!(chosen.evaluations, 0);
    (chosen.radius, chosen.exponent)
}

fn distinct(points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut points = points.to_vec();
    points.sort_by(|a, b| a.partial_cmp(b).unwrap());
    points.dedup();
    points
}

/// Of each point: the mean distance to the 6 nearest other points, by comparing all pairs.
fn spacings(points: &[[f64; 3]]) -> Vec<f64> {
    let of = |(i, &p): (usize, &[f64; 3])| {
        let others = points.iter().enumerate().filter(|&(j, _)| j != i);
        let mut distances: Vec<f64> = others.map(|(_, &q)| distance(p, q)).collect();
        if distances.len() > 6 {
            distances.select_nth_unstable_by(5, f64::total_cmp);
            distances.truncate(6);
        }
        distances.sort_by(f64::total_cmp);
        distances.iter().sum::<f64>() / distances.len() as f64
    };
    points.iter().enumerate().map(of).collect()
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// 0.4·n^¼·r²/g from scratch. The longest spacings count as the one at 99 %.
fn expected(points: &[[f64; 3]], viewpoint: [f64; 3]) -> f64 {
    let points = distinct(points);
    let farthest = farthest(&points, viewpoint);
    if points.len() < 2 {
        return farthest;
    }
    let mut spacings = spacings(&points);
    let mut sorted = spacings.clone();
    sorted.sort_by(f64::total_cmp);
    let longest = sorted[99 * sorted.len() / 100];
    spacings.iter_mut().for_each(|s| *s = s.min(longest));
    let power = |k: i32| mean(spacings.iter().map(|s| s.powi(k)));
    let gap = power(3) / power(1).powi(2);
    let weighted = points.iter().zip(&spacings);
    let squares = weighted.map(|(&p, s)| s * s * distance(p, viewpoint).powi(2));
    (0.4 * (points.len() as f64).powf(0.25) * mean(squares) / power(2) / gap).max(farthest)
}

#[test]
fn the_cloud_gives_its_spacing() {
    for kind in KINDS {
        for (seed, n) in [(1, 2), (2, 7), (3, 60), (4, 500)] {
            let points = kind.scene(seed, n).points;
            let cloud = PointCloud::new(&points).unwrap();
            let points = distinct(&points);
            let expected = if points.len() < 2 {
                0.0
            } else {
                mean(spacings(&points).into_iter())
            };
            let off = (cloud.spacing().unwrap() - expected).abs();
            assert!(off <= 1e-9 * expected, "{}: {off}", kind.name);
        }
    }
}

#[test]
fn it_is_the_closed_form_of_distances_and_spacings() {
    for kind in KINDS.iter().filter(|kind| !kind.name.contains("scaled")) {
        for (seed, n) in [(1, 2), (2, 3), (3, 7), (4, 8), (5, 60), (6, 500)] {
            let scene = kind.scene(seed, n);
            let (radius, _) = automatic(&scene.points, scene.viewpoint);
            let expected = expected(&scene.points, scene.viewpoint);
            assert!(
                (radius - expected).abs() <= 1e-9 * expected,
                "{radius} instead of {expected}: {} with seed {seed}, {n} points",
                kind.name
            );
        }
    }
}

#[test]
fn a_flat_cloud_has_the_same_radius_in_every_coordinate_plane() {
    // Rings far apart: in space, they would leave much of what they span empty.
    let ring = |i: usize| {
        let (away, turn) = ((i / 1000 + 1) as f64, (i % 1000) as f64 * 0.00628);
        [away * libm::cos(turn), away * libm::sin(turn), 2.0]
    };
    let points: Vec<[f64; 3]> = (0..8000).map(ring).collect();
    let turned = |by: usize, [x, y, z]: [f64; 3]| {
        let mut place = [x, y, z];
        place.rotate_right(by);
        place
    };
    let radii = [0, 1, 2].map(|by| {
        let points: Vec<_> = points.iter().map(|&p| turned(by, p)).collect();
        automatic(&points, turned(by, [1.0, 2.0, 30.0])).0
    });
    for radius in radii {
        // Sums in another order round otherwise.
        assert!((radius / radii[0] - 1.0).abs() < 0.05, "{radii:?}");
    }
}

#[test]
fn samples_of_larger_clouds_are_accurate_in_every_order_of_the_points() {
    let mut rng = Rng::new(12);
    let mut points = shapes::bumpy(&mut rng, 6000);
    let viewpoint = [0.0, 2.0, 1.0];
    let before = automatic(&points, viewpoint);
    assert!(
        (before.0 / expected(&points, viewpoint) - 1.0).abs() < 0.03,
        "{before:?}"
    );
    let copies: Vec<_> = (0..5000).map(|_| rng.pick(&points)).collect();
    points.extend(copies);
    rng.shuffle(&mut points);
    let after = automatic(&points, viewpoint);
    assert_eq!(before.0.to_bits(), after.0.to_bits());
    assert_eq!(before.1.to_bits(), after.1.to_bits());
}

#[test]
fn a_few_stray_points_do_not_matter() {
    let mut points = shapes::bumpy(&mut Rng::new(13), 1900);
    let viewpoint = [0.0, 2.0, 1.0];
    let (before, _) = automatic(&points, viewpoint);
    for i in 0..19 {
        let turn = f64::from(i);
        points.push([turn.cos(), turn.sin(), turn / 10.0].map(|x| 3.0 * x));
    }
    let (after, _) = automatic(&points, viewpoint);
    // Their spacings are about thirty times as long as the others. The cubes would decide.
    let off = after / before;
    assert!((0.75..1.25).contains(&off), "{off}");
}

#[test]
fn the_sparse_part_of_a_surface_decides() {
    // Two squares side by side: the left one has 15 by 15 points, the right one 40 by 40.
    let square = |count: usize, left: f64| {
        let along = move |i: usize| (i as f64 + 0.5) / count as f64;
        let place = move |i| [left + along(i % count), along(i / count), 0.0];
        (0..count * count).map(place)
    };
    let sparse: Vec<_> = square(15, 0.0).collect();
    let both: Vec<_> = square(15, 0.0).chain(square(40, 1.0)).collect();
    let viewpoint = [1.0, 0.5, 50.0];
    let (alone, _) = automatic(&sparse, viewpoint);
    let (together, _) = automatic(&both, viewpoint);
    // R also grows with the root of the root of the number of points.
    let more = (both.len() as f64 / sparse.len() as f64).powf(0.25);
    assert!(
        (0.8..1.3).contains(&(together / alone / more)),
        "{together}, alone {alone}"
    );
    // With the mean spacing of all points it is twice as large.
    let squares = mean(both.iter().map(|&p| distance(p, viewpoint).powi(2)));
    let factor = 0.4 * (both.len() as f64).powf(0.25);
    let by_mean = factor * squares / mean(spacings(&both).into_iter());
    assert!(by_mean > 1.8 * together, "{by_mean}, {together}");
}

#[test]
fn it_is_the_default_and_the_answer_reports_the_chosen_radius() {
    for kind in KINDS {
        let scene = kind.scene(21, 50);
        let (radius, exponent) = automatic(&scene.points, scene.viewpoint);
        let answer = ask(&scene.points, scene.viewpoint, &Options::default());
        assert_eq!(answer.radius().to_bits(), radius.to_bits(), "{}", kind.name);
        assert_eq!(
            answer.exponent().to_bits(),
            exponent.to_bits(),
            "{}",
            kind.name
        );
        let farthest = farthest(&scene.points, scene.viewpoint);
        assert!(radius >= farthest, "{}", kind.name);
        if farthest > 0.0 {
            assert!(
                (exponent - (radius / farthest).log10()).abs() < 1e-12,
                "{}",
                kind.name
            );
        }
        assert_eq!(answer.evaluations(), 0);
    }
}

#[test]
fn it_is_the_farthest_distance_where_there_is_no_spacing() {
    let viewpoint = [1.0, 2.0, 2.0];
    assert_eq!(automatic(&[], viewpoint), (0.0, 0.0));
    assert_eq!(automatic(&[viewpoint; 3], viewpoint), (0.0, 0.0));
    assert_eq!(automatic(&[[0.0; 3]], viewpoint), (3.0, 0.0));
    assert_eq!(
        automatic(&[[0.0; 3], [-0.0; 3], [0.0; 3]], viewpoint),
        (3.0, 0.0)
    );
    // One point at the viewpoint and one far from it: two distinct points.
    assert_eq!(automatic(&[[0.0; 3], viewpoint], viewpoint), (3.0, 0.0));
}

#[test]
fn an_overflow_is_clamped() {
    // The distances fit into an `f64`; their squares divided by the spacing do not.
    let mut points = vec![[1e150, 0.0, 0.0], [0.0, 1e150, 0.0], [0.0, 0.0, 1e150]];
    points.extend([[1e-200, 0.0, 0.0], [0.0, 1e-200, 0.0]]);
    let (radius, exponent) = automatic(&points, [-1e153, 0.0, 0.0]);
    assert!(radius >= 1e153 && (2.0 * radius).is_finite() && exponent.is_finite());
    let far = [1e-150, 2e-150, 3e-150].map(|x| [x, 0.0, 0.0]);
    let (radius, exponent) = automatic(&far, [1e153, 0.0, 0.0]);
    assert!((2.0 * radius).is_finite() && radius >= 1e153 && exponent.is_finite());
    assert_eq!(ask(&far, [1e153, 0.0, 0.0], &Options::default()).count(), 3);
}

/// `count` points along a tube around a circle, in rounds of `around` points.
fn tube(count: usize, around: usize, thickness: f64) -> impl Iterator<Item = [f64; 3]> {
    (0..count * around).map(move |i| {
        let along = (i / around) as f64 / count as f64 * std::f64::consts::TAU;
        let angle = (i % around) as f64 / around as f64 * std::f64::consts::TAU;
        let away = 1.0 + thickness * angle.cos();
        [
            away * along.cos(),
            away * along.sin(),
            thickness * angle.sin(),
        ]
    })
}

#[test]
fn flat_sides_without_points_make_the_sphere_smaller() {
    // A tin whose lids have points at their rims only: two thin rings, one above the other.
    let ring = |height: f64| tube(900, 2, 0.002).map(move |[x, y, z]| [x, y, z + height]);
    let tin: Vec<_> = ring(0.0).chain(ring(0.25)).collect();
    let viewpoint = [0.5, 1.0, 4.0];
    let (radius, _) = automatic(&tin, viewpoint);
    let expected = expected(&tin, viewpoint);
    assert!(radius < 0.2 * expected, "{radius}, {expected}");
    assert!(radius > 0.9 / 32.0 * expected, "{radius}, {expected}");
    // Neither the order nor a power of two changes it, and a shift hardly does.
    let mut shuffled = tin.clone();
    Rng::new(3).shuffle(&mut shuffled);
    assert_eq!(
        automatic(&shuffled, viewpoint).0.to_bits(),
        radius.to_bits()
    );
    for scale in [2f64.powi(-300), 2f64.powi(200)] {
        let scaled: Vec<_> = tin.iter().map(|p| p.map(|x| x * scale)).collect();
        let (scaled, _) = automatic(&scaled, viewpoint.map(|x| x * scale));
        assert_eq!((scaled / scale).to_bits(), radius.to_bits());
    }
    // Curves in a plane fill nothing.
    let flat: Vec<_> = tin.iter().map(|&[x, y, _]| [x, y, 0.0]).collect();
    let seen = PointCloud::new(&flat).unwrap();
    let chosen = seen.auto_radius([0.5, 4.0, 0.0], Radius::Auto).unwrap();
    let expected = self::expected(&flat, [0.5, 4.0, 0.0]);
    assert!((chosen.radius / expected - 1.0).abs() < 1e-9);
}

#[test]
fn surfaces_with_points_everywhere_are_taken_as_they_are() {
    let viewpoint = [1.0, 2.0, 30.0];
    // Balls with much nothing between them. So many points are all measured.
    let row = |count: usize, size: usize, apart: f64| -> Vec<[f64; 3]> {
        let ball = |seed| shapes::sphere(&mut Rng::new(seed), size).into_iter();
        let at = |k: usize| ball(k as u64).map(move |[x, y, z]| [x + apart * k as f64, y, z]);
        (0..count).flat_map(at).collect()
    };
    for points in [
        row(1, 700, 0.0),
        row(2, 700, 20.0),
        row(2, 700, 500.0),
        row(40, 50, 30.0),
    ] {
        let (radius, _) = automatic(&points, viewpoint);
        let expected = expected(&points, viewpoint);
        assert!(
            (radius / expected - 1.0).abs() < 1e-9,
            "{radius}, {expected}"
        );
    }
    // More than are measured.
    let points = row(10, 700, 30.0);
    let off = automatic(&points, viewpoint).0 / expected(&points, viewpoint);
    assert!((off - 1.0).abs() < 0.05, "{off}");
}
