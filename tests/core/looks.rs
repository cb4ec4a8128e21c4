//! Several looks: the promises of the rule, each degenerate case, and changes of the input that
//! must not change the answer.

use hidden_point_removal::{Inversion, Options, PointCloud, Visibility, Within};

use crate::common::ask;
use crate::common::rng::Rng;
use crate::test;

const FRONT: [f64; 3] = [0.0, 0.0, 5.0];

fn looks(count: usize) -> Options {
    Options::looks(count).with_scores(true)
}

#[test]
fn an_answer_tells_its_looks_and_no_radius() {
    let points: Vec<[f64; 3]> = (0..50)
        .map(|_| [0.0; 3])
        .enumerate()
        .map(on_a_grid)
        .collect();
    let cloud = PointCloud::new(&points).unwrap();
    let three = cloud.visible_from(FRONT, &looks(3)).unwrap();
    let scale = cloud.spacing().unwrap();
    assert_eq!(three.looks(), [0.28, 0.07, 0.02].map(|share| share * scale));
    assert_eq!(three.inversion(), Inversion::Looks(3));
    assert_eq!(
        (three.radius(), three.exponent(), three.evaluations()),
        (0.0, 0.0, 0)
    );
    assert_eq!(three.scores().len(), 50);
    let two = cloud.visible_from(FRONT, &looks(2)).unwrap();
    assert_eq!(two.looks(), [0.28, 0.02].map(|share| share * scale));
    let one = cloud.visible_from(FRONT, &Options::default()).unwrap();
    assert!(one.looks().is_empty() && one.scores().is_empty());
}

fn on_a_grid((i, _): (usize, [f64; 3])) -> [f64; 3] {
    [(i % 7) as f64 * 0.1, (i / 7) as f64 * 0.1, 0.0]
}

/// A small plate before a wall, both sampled evenly, seen from the front.
fn plate_before_wall() -> (Vec<[f64; 3]>, Vec<bool>) {
    let mut rng = Rng::new(8);
    let mut points = Vec::new();
    let mut truth = Vec::new();
    let mut jitter = || rng.between(-0.2, 0.2);
    for i in -40..=40_i32 {
        for j in -40..=40_i32 {
            let at = [
                0.05 * (f64::from(i) + jitter()),
                0.05 * (f64::from(j) + jitter()),
            ];
            // The plate is half way to the wall, so its shadow on the wall is twice as large.
            points.push([at[0], at[1], -5.0]);
            truth.push(at[0].abs().max(at[1].abs()) > 1.0);
            if i.abs() <= 10 && j.abs() <= 10 {
                points.push([0.05 * f64::from(i), 0.05 * f64::from(j), 0.0]);
                truth.push(true);
            }
        }
    }
    (points, truth)
}

#[test]
fn looks_take_the_halo_away_and_keep_hidden_what_is_behind() {
    let (points, truth) = plate_before_wall();
    let wrong = |answer: &Visibility| {
        let mask = answer.mask();
        let mistakes = |is: u8| {
            (0..points.len())
                .filter(|&i| truth[i] != (is == 1) && mask[i] == is)
                .count()
        };
        (mistakes(1), mistakes(0))
    };
    let (one_more, one_fewer) = wrong(&ask(&points, FRONT, &Options::default()));
    let (more, fewer) = wrong(&ask(&points, FRONT, &looks(3)));
    // The operator misses a band of the wall around the plate.
    assert!(one_fewer > 300, "{one_fewer}");
    assert!(3 * fewer < one_fewer, "{fewer} of {one_fewer}");
    assert!(more <= one_more + 40, "{more}, {one_more}");
}

#[test]
fn scores_rise_with_the_answer() {
    let (points, truth) = plate_before_wall();
    let answer = ask(&points, FRONT, &looks(3));
    assert!(
        answer
            .scores()
            .iter()
            .all(|score| (0.0..=1.0).contains(score))
    );
    let mean = |visible: bool| {
        let scores = answer.scores().iter().zip(&truth);
        let of: Vec<f64> = scores
            .filter(|(_, truth)| **truth == visible)
            .map(|(s, _)| f64::from(*s))
            .collect();
        of.iter().sum::<f64>() / of.len() as f64
    };
    assert!(
        mean(true) > 0.85 && mean(false) < 0.1,
        "{} {}",
        mean(true),
        mean(false)
    );
    // Scores are computed only on request, and they change no label.
    let without = Options::looks(3);
    let plain = ask(&points, FRONT, &without);
    assert!(plain.scores().is_empty());
    assert_eq!(plain.indices(), answer.indices());
}

#[test]
fn degenerate_clouds_answer_as_documented() {
    let seen = |points: &[[f64; 3]], viewpoint| {
        let answer = ask(points, viewpoint, &looks(3));
        (answer.indices().to_vec(), answer.scores().to_vec())
    };
    let origin = [0.0; 3];
    assert_eq!(seen(&[], FRONT), (vec![], vec![]));
    assert_eq!(seen(&[origin], FRONT), (vec![0], vec![1.0]));
    // A point at the viewpoint: certainly visible, and no part of the hull.
    assert_eq!(seen(&[FRONT], FRONT), (vec![0], vec![1.0]));
    assert_eq!(seen(&[FRONT, origin], FRONT), (vec![0, 1], vec![1.0, 1.0]));
    // Points on one ray, and so in one line with the viewpoint: only the nearest is visible.
    let ray = [[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], origin];
    assert_eq!(seen(&ray, FRONT), (vec![1], vec![0.2, 1.0, 0.2]));
    // Points on both sides of the viewpoint: both are visible.
    assert_eq!(seen(&[[0.0, 0.0, 6.0], origin], FRONT).0, [0, 1]);
    // Two and three separate points.
    let triangle = [origin, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(seen(&triangle[..2], FRONT), (vec![0, 1], vec![1.0; 2]));
    let (indices, scores) = seen(&triangle, FRONT);
    assert_eq!(indices, [0, 1, 2]);
    assert!(scores.iter().all(|score| (0.95..=1.0).contains(score)));
    // Equal points share one answer.
    let equal = [
        triangle[0],
        triangle[1],
        triangle[0],
        triangle[2],
        triangle[1],
    ];
    let of_equal = [0, 1, 0, 2, 1].map(|i: usize| scores[i]);
    assert_eq!(
        seen(&equal, FRONT),
        (vec![0, 1, 2, 3, 4], of_equal.to_vec())
    );
    assert_eq!(seen(&[origin; 4], FRONT), (vec![0, 1, 2, 3], vec![1.0; 4]));
    // A point behind a triangle, deeper than a spacing: hidden.
    let with = |p| [triangle[0], triangle[1], triangle[2], p];
    assert_eq!(seen(&with([0.2, 0.2, -3.0]), FRONT).0, [0, 1, 2]);
    // Within one spacing: visible, although the operator hides it.
    let near = with([0.3, 0.3, -0.01]);
    assert_eq!(seen(&near, FRONT).0, [0, 1, 2, 3]);
}

#[test]
fn in_one_plane_with_the_viewpoint_each_look_sees_what_its_flat_hull_does() {
    let mut rng = Rng::new(3);
    let points: Vec<[f64; 3]> = (0..200)
        .map(|_| [rng.between(-1.0, 1.0), rng.between(-1.0, 1.0), 0.0])
        .collect();
    let viewpoint = [3.0, 0.5, 0.0];
    let answer = ask(&points, viewpoint, &looks(3));
    let mut expected = vec![0; points.len()];
    for &scale in answer.looks() {
        let inversion = Inversion::Exponential(hidden_point_removal::Exponential::Scale(scale));
        let seen = ask(&points, viewpoint, &Options::inversion(inversion)).mask();
        for (expected, seen) in expected.iter_mut().zip(seen) {
            *expected |= seen;
        }
    }
    assert_eq!(answer.mask(), expected);
    for (i, &score) in answer.scores().iter().enumerate() {
        assert_eq!(score > 0.5, expected[i] == 1, "point {i}");
    }
}

#[test]
fn each_index_has_a_score_if_no_point_takes_part() {
    let points: Vec<[f64; 3]> = (0..49).map(|i| on_a_grid((i, [0.0; 3]))).collect();
    let mut cloud = PointCloud::new(&points).unwrap();
    let options = looks(3).with_within(Within {
        distance: Some(0.0),
        bounds: None,
    });
    let answer = cloud.visible_from(FRONT, &options).unwrap();
    assert_eq!(answer.scores(), [0.0; 49]);
    let indices: Vec<u32> = (0..49).collect();
    cloud.remove(&indices).unwrap();
    let direction = [0.0, 0.0, -1.0];
    for answer in [
        cloud.visible_from(FRONT, &looks(2)).unwrap(),
        cloud.visible_from_direction(direction, &looks(2)).unwrap(),
    ] {
        assert_eq!(answer.scores(), [0.0; 49]);
    }
}

#[test]
fn skipped_and_removed_points_have_no_score() {
    let mut points: Vec<[f64; 3]> = (0..49).map(|i| on_a_grid((i, [0.0; 3]))).collect();
    points.push([f64::NAN, 0.0, 0.0]);
    let skip = hidden_point_removal::NonFinite::Skip;
    let mut cloud = PointCloud::with_non_finite(&points, skip).unwrap();
    cloud.remove(&[24]).unwrap();
    let answer = cloud.visible_from(FRONT, &looks(3)).unwrap();
    assert_eq!((answer.scores()[24], answer.scores()[49]), (0.0, 0.0));
    let rest: Vec<_> = (0..49).filter(|&i| i != 24).map(|i| points[i]).collect();
    let alone = ask(&rest, FRONT, &looks(3));
    assert_eq!(answer.count(), alone.count());
}
