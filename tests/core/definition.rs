//! The meaning of "visible", case by case.

use hidden_point_removal::{Options, PointCloud};

use crate::common::ask;
use crate::common::flip::flip;
use crate::common::shapes::aim;

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
    assert_eq!(seen(&bent, FRONT, &Options::with_exponent(0.0)), [0, 2]);
}

#[test]
fn four_points_make_the_first_solid() {
    let corners = [[1.0, 0.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0]];
    let with = |p| {
        seen(
            &[corners[0], corners[1], corners[2], p],
            FRONT,
            &Options::with_exponent(0.5),
        )
    };
    assert_eq!(
        with([-0.25, 0.0, 1.0]),
        [0, 1, 2, 3],
        "in front of the triangle"
    );
    assert_eq!(with([-0.25, 0.0, -3.0]), [0, 1, 2], "behind it");
}

#[test]
fn equal_points_are_visible_or_hidden_together() {
    let pair = [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0]];
    let twice = [pair[0], pair[1], pair[0], pair[1], pair[1]];
    assert_eq!(seen(&twice, FRONT, &Options::default()), [0, 2]);
    // −0 equals 0.
    assert_eq!(
        seen(&[[0.0; 3], [-0.0; 3]], FRONT, &Options::default()),
        [0, 1]
    );
}

#[test]
fn the_farther_of_two_points_on_one_ray_is_hidden() {
    for exponent in [0.0, 1.0, 3.0, 8.0] {
        // Equal coordinates stay equal, so these flips stay on their ray.
        let points = [[2.0; 3], [1.0; 3], [-4.0, 1.0, 0.0], [3.0; 3]];
        let options = Options::with_exponent(exponent);
        assert_eq!(
            seen(&points, [0.0; 3], &options),
            [1, 2],
            "exponent {exponent}"
        );
    }
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
    let options = Options::with_radius(1e17);
    assert_eq!(
        flip(points[0], [0.0; 3], 1e17),
        flip(points[1], [0.0; 3], 1e17)
    );
    assert_eq!(seen(&points, [0.0; 3], &options)[..2], [0, 1]);
}

#[test]
fn points_on_a_facet_or_an_edge_are_visible() {
    // All points have the distance 3. With R = 3, q = v, so the flipped points stay on the
    // lattice. Points with x = 2 make one facet; the others close the solid around the viewpoint.
    let mut points = Vec::new();
    for [a, b, c] in [[1.0, 2.0, 2.0], [2.0, 1.0, 2.0], [2.0, 2.0, 1.0]] {
        for signs in 0..8 {
            let s = |bit: u32, x: f64| if signs >> bit & 1 == 1 { -x } else { x };
            points.push([s(0, a), s(1, b), s(2, c)]);
        }
    }
    let options = Options::with_radius(3.0);
    assert_eq!(seen(&points, [0.0; 3], &options).len(), 24);
}

#[test]
fn points_in_the_middle_of_an_edge_and_a_facet_are_visible() {
    // Flipped with R = 3: (3,±3,±3) are the corners of a facet, (3,0,3) is the middle of an
    // edge, and (3,0,0) is the middle of the facet.
    let targets: [[f64; 3]; 7] = [
        [3.0, 3.0, 3.0],
        [3.0, 3.0, -3.0],
        [3.0, -3.0, 3.0],
        [3.0, -3.0, -3.0],
        [3.0, 0.0, 3.0],
        [3.0, 0.0, 0.0],
        [2.0, 2.0, 2.0],
    ];
    let points = targets.map(aim);
    for (p, q) in points.into_iter().zip(targets) {
        assert_eq!(flip(p, [0.0; 3], 3.0), Some(q));
    }
    let options = Options::with_radius(3.0);
    assert_eq!(seen(&points, [0.0; 3], &options), [0, 1, 2, 3, 4, 5]);
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
    assert_eq!(
        seen(&points, [0.0; 3], &Options::with_exponent(1.0)),
        [0, 1]
    );
    // d > 0, but (2R − d)/d overflows. The point counts as at the viewpoint, too.
    let points = [[1e-150, 0.0, 0.0], [1e150, 0.0, 0.0], [1e149, 0.0, 0.0]];
    assert!(flip(points[0], [0.0; 3], 1e160).is_none());
    assert_eq!(
        seen(&points, [0.0; 3], &Options::with_radius(1e160)),
        [0, 2]
    );
}

#[test]
fn a_line_through_the_viewpoint_shows_its_nearest_point_to_either_side() {
    let points: Vec<[f64; 3]> = (1..8)
        .map(|i| [f64::from(i), f64::from(2 * i), 0.0])
        .collect();
    let options = Options::with_exponent(1.0);
    assert_eq!(seen(&points, [0.0; 3], &options), [0]);
    assert_eq!(seen(&points, [3.5, 7.0, 0.0], &options), [2, 3]);
    assert_eq!(seen(&points, [3.0, 6.0, 0.0], &options), [1, 2, 3]);
    assert_eq!(seen(&points, [9.0, 18.0, 0.0], &options), [6]);
}
