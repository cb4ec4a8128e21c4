//! The crate compared with the naive oracle, on thousands of small and mostly degenerate
//! scenes. Also, the oracle compared with answers that are obvious by eye.

use crate::common::oracle;
use crate::test;

/// Which of these flipped points are visible by the oracle's enumeration?
fn enumerate<const N: usize>(q: [[f64; 3]; N]) -> [bool; N] {
    let hidden = oracle::hidden(&oracle::integers(&q));
    core::array::from_fn(|i| !hidden[i])
}

#[test]
fn the_oracle_knows_points_on_one_ray() {
    assert_eq!(enumerate([[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]), [false, true]);
    assert_eq!(enumerate([[-1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]), [true, true]);
    assert_eq!(enumerate([[0.0; 3]]), [false]);
}

#[test]
fn the_oracle_knows_edges_in_a_plane_with_the_viewpoint() {
    // A point on the edge from (2,0) to (0,2), a point below it, and a point beyond it.
    let edge = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    let with = |x, y| enumerate([edge[0], edge[1], [x, y, 0.0]]);
    assert_eq!(with(1.0, 1.0), [true, true, true]);
    assert_eq!(with(1.0, 0.75), [true, true, false]);
    assert_eq!(with(1.0, 1.25), [true, true, true]);
    // The ray points away from the edge. It leaves K right at the point.
    assert_eq!(with(-0.25, -0.25), [true, true, true]);
    // The point is on the side of K that contains the viewpoint: the corner hides it.
    assert_eq!(with(1.5, 0.0), [true, true, false]);
}

#[test]
fn the_oracle_knows_facets() {
    let corners = [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
    let with = |q| enumerate([corners[0], corners[1], corners[2], q])[3];
    assert!(with([1.0, 1.0, 2.0]), "on the facet");
    assert!(with([2.0, 2.0, 0.0]), "on its edge");
    assert!(!with([1.0, 1.0, 1.875]), "below it");
    assert!(with([1.0, 1.0, 2.125]), "above it");
    assert!(!with([1.0, 1.0, 0.0]), "on a side through the viewpoint");
    assert!(with([-1.0, 0.0, 0.0]), "behind the viewpoint");
}
