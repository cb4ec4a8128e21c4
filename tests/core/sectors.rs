//! A view that threads share, one sector of the directions each.

use hidden_point_removal::{Options, PointCloud};

use crate::checks::sectors::compare;
use crate::common::rng::Rng;
use crate::common::{shapes, structured};
use crate::test;

/// The sector's own point flips exactly on to a face of the sector's hull. A far point hides it,
/// and only a question about far blocks shows that.
#[test]
fn own_points_on_a_face_below_a_far_point_are_hidden() {
    let scene = structured::scene(&mut Rng::new(319), structured::IN_SQUARE, 2000);
    let cloud = PointCloud::new(&scene.points).unwrap();
    for count in [4, 8, 16] {
        let compared = compare(&cloud, scene.viewpoint, &scene.options, count);
        assert_eq!(compared, Ok(()));
    }
}

/// If the flip loses too many digits, one thread answers for all points.
#[test]
fn large_exponents_are_not_divided() {
    let points = shapes::bumpy(&mut Rng::new(13), 4000);
    let cloud = PointCloud::new(&points).unwrap();
    for exponent in [7.9, 8.0, 8.1, 12.0] {
        let options = Options::exponent(exponent);
        let compared = compare(&cloud, [0.0, 0.5, 3.0], &options, 3);
        assert_eq!(compared, Ok(()));
    }
}

#[test]
fn threads_share_a_large_cloud() {
    let cloud = PointCloud::new(&shapes::bumpy(&mut Rng::new(9), 60_000)).unwrap();
    for viewpoint in [[0.0, 0.0, 3.0], [2.0, 1.5, -0.5], [0.1, 0.2, 0.1]] {
        for threads in [2, 3, 4] {
            let compared = compare(&cloud, viewpoint, &Options::default(), threads);
            assert_eq!(compared, Ok(()));
        }
    }
}
