//! The meaning of "visible", case by case.

use hidden_point_removal::{Options, PointCloud};

use crate::common::ask;
use crate::common::flip::flip;
use crate::test;

const FRONT: [f64; 3] = [0.0, 0.0, 5.0];

fn seen(points: &[[f64; 3]], viewpoint: [f64; 3], options: &Options) -> Vec<u32> {
    let answer = ask(points, viewpoint, options);
    assert_eq!(answer.count(), answer.indices().len());
    assert!(answer.indices().is_sorted_by(|a, b| a < b));
    let mut mask = vec![0; points.len()];
    answer.indices().iter().for_each(|&i| mask[i as usize] = 1);
    assert_eq!(answer.mask(), mask);
    let indices = answer.indices().to_vec();
    assert_eq!(answer.into_indices(), indices);
    indices
}

#[test]
fn an_empty_cloud_gives_an_empty_answer() {
    let answer = ask::<[f64; 3]>(&[], FRONT, &Options::default());
    assert_eq!(answer.indices(), [0u32; 0]);
    assert_eq!((answer.radius(), answer.exponent()), (0.0, 0.0));
    assert!(PointCloud::new::<[f32; 3]>(&[]).unwrap().is_empty());
}

#[test]
fn one_two_and_three_points_follow_the_same_definition() {
    let o = &Options::default();
    assert_eq!(seen(&[[1.0, 2.0, 3.0]], FRONT, o), [0]);
    assert_eq!(seen(&[[1.0, 2.0, 3.0], [3.0, 2.0, 1.0]], FRONT, o), [0, 1]);
    assert_eq!(seen(&[[0.0; 3], [0.0, 0.0, 1.0]], FRONT, o), [1]);
    let three = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]];
    assert_eq!(seen(&three, FRONT, o), [0, 1, 2]);
    assert_eq!(
        seen(&[[0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, 7.0]], FRONT, o),
        [1, 2]
    );
    // In one plane with the viewpoint. The middle point lies behind the line of the others.
    let bent = [[-1.0, 0.0, 0.0], [0.0, 0.0, -9.0], [1.0, 0.0, 0.0]];
    assert_eq!(seen(&bent, FRONT, &Options::exponent(0.0)), [0, 2]);
}

#[test]
fn points_whose_flips_round_together_share_one_answer() {
    // The rounded 2R − d is the same for the first two points.
    let points = [
        [0.0, 0.0, 1.0],
        [0.0, 0.0, 2.0],
        [1.0, 0.0, 0.0],
        [-1.0, -1.0, -1.0],
    ];
    let options = Options::radius(1e17);
    assert_eq!(
        flip(points[0], [0.0; 3], 1e17),
        flip(points[1], [0.0; 3], 1e17)
    );
    assert_eq!(seen(&points, [0.0; 3], &options)[..2], [0, 1]);
}

#[test]
fn a_point_at_the_viewpoint_is_visible_and_hides_nothing() {
    let points = [
        FRONT,
        [0.0, 0.0, 1.0],
        [0.0, 0.0, 0.0],
        FRONT,
        [1.0, 1.0, 0.0],
    ];
    assert_eq!(seen(&points, FRONT, &Options::default()), [0, 1, 3, 4]);
    let alone = ask(&[FRONT, FRONT], FRONT, &Options::default());
    assert_eq!(alone.indices(), [0, 1]);
    assert_eq!((alone.radius(), alone.exponent()), (0.0, 0.0));
}

#[test]
fn a_distance_that_vanishes_in_f64_counts_as_at_the_viewpoint() {
    // 1e-170 squared is 0 in f64: the computed distance decides.
    let points = [[1e-170, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    assert_eq!(seen(&points, [0.0; 3], &Options::exponent(1.0)), [0, 1]);
    // d > 0, but (2R − d)/d overflows. The point counts as at the viewpoint, too.
    let points = [[1e-150, 0.0, 0.0], [1e150, 0.0, 0.0], [1e149, 0.0, 0.0]];
    assert!(flip(points[0], [0.0; 3], 1e160).is_none());
    assert_eq!(seen(&points, [0.0; 3], &Options::radius(1e160)), [0, 2]);
}
