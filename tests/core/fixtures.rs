//! Scenes that once had wrong answers. Most are reduced to the fewest points and seen from
//! the origin. The expected answers come from the oracle and were confirmed by
//! exact enumeration of supporting planes in another language.

use hidden_point_removal::{Options, PointCloud};

use crate::checks::sectors;
use crate::common::shapes::Points;
use crate::common::{ask, indices_of, oracle};
use crate::test;

fn check(points: &[[f64; 3]], radius: f64, expected: &[u32]) {
    let answer = ask(points, [0.0; 3], &Options::radius(radius));
    assert_eq!(answer.indices(), expected);
    assert_eq!(
        indices_of(&oracle::visible(points, [0.0; 3], radius)),
        expected
    );
}

/// The last three points lie on one ray, except for rounding. They are next to a side of K
/// that contains the viewpoint.
#[test]
fn a_point_one_rounding_error_inside_a_side_through_the_viewpoint() {
    let points = [
        [-6.0, 0.0, 0.0],
        [2.0, 6.0, 4.0],
        [-4.0, 0.0, 0.0],
        [3.0, 6.0, -3.0],
        [-10.0, 0.0, 0.0],
        [6.0, -6.0, 0.0],
        [5.0, 15.0, 10.0],
        [4.0, 12.0, 8.0],
    ];
    check(&points, 18.708286933869708, &[1, 2, 3, 5]);
}

/// Points of a half-space. The viewpoint and several points are in its border plane.
#[test]
fn a_point_in_the_border_plane_of_half_a_space() {
    let points = [
        [-1.992301766027062, 1.3282011773513749, 0.0],
        [-0.8973665961010275, -2.6920997883030826, 0.0],
        [-0.9104275004359956, 0.9104275004359956, 1.3656412506539937],
        [-2.6920997883030826, 0.8973665961010275, 0.0],
        [-0.6035674514745465, -1.8107023544236394, 1.2071349029490925],
        [-2.427204202399745, -0.8090680674665818, 0.8090680674665818],
        [-0.6035674514745463, 1.2071349029490925, 1.8107023544236391],
        [-0.6035674514745464, 1.810702354423639, 1.2071349029490928],
        [-1.2426406871192854, 1.2426406871192854, 0.0],
        [
            -0.46410161513775455,
            0.4641016151377545,
            0.46410161513775455,
        ],
        [2.6920997883030826, 0.0, 0.8973665961010275],
        [-1.2426406871192857, 1.2426406871192859, 0.0],
        [-1.8107023544236394, 0.6035674514745465, 1.207134902949093],
        [0.8090680674665817, -0.8090680674665819, 2.427204202399746],
    ];
    check(&points, 3.0, &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13]);
}

/// After the flip the coordinates of the middle point are 450 decades apart.
#[test]
fn three_directions_over_the_whole_range_of_f64() {
    let points = [
        [
            7.469150638169259e92,
            -6.321854109954759e-297,
            3.136609422572803e49,
        ],
        [
            8.417719456790024e52,
            -3.8095468697910326e-243,
            2.0848532992187125e145,
        ],
        [
            -3.653167891463932e-83,
            -4.557550074485965e-83,
            7.504302126288441e-98,
        ],
    ];
    check(&points, 2.0848532992187124e160, &[0, 1, 2]);
}

/// The walls of a room of 8 by 6 by 3.
fn walls(n: usize) -> Points {
    let mut state = 1u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / 4_294_967_296.0
    };
    let size = [8.0, 6.0, 3.0];
    (0..n)
        .map(|_| {
            let mut p = size.map(|side| random() * side);
            let wall = (random() * 6.0) as usize;
            p[wall / 2] = if wall % 2 == 1 { size[wall / 2] } else { 0.0 };
            p
        })
        .collect()
}

/// The fault: each thread's sector kept the numbers of faces while points entered its hull. So a face
/// seen edge-on marked its corners as visible, and walks started at such a face. The viewpoint
/// is in a wall.
#[test]
fn divided_views_of_a_room_from_a_place_in_a_wall() {
    let cloud = PointCloud::new(&walls(3000)).unwrap();
    let (viewpoint, options) = ([2.0, 0.0, 1.5], Options::exponent(3.0));
    let whole = cloud.visible_from(viewpoint, &options).unwrap();
    assert_eq!(whole.count(), 2795);
    for count in [2, 3, 4, 8, 14] {
        let compared = sectors::compare(&cloud, viewpoint, &options, count);
        assert_eq!(compared, Ok(()));
    }
}
