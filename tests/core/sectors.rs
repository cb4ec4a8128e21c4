//! A view divided among sectors: each visible point is in the answer of exactly one sector.

use hidden_point_removal::{Options, PointCloud, Radius, Sector};

use crate::common::rng::Rng;
use crate::common::{sectors, shapes, structured};

/// Panics if the sectors and the whole view differ. Returns how many points each sector
/// answered for.
fn compare(
    cloud: &PointCloud,
    viewpoint: [f64; 3],
    options: &Options,
    count: u32,
    title: &str,
) -> Vec<usize> {
    sectors::compare(cloud, viewpoint, options, count)
        .unwrap_or_else(|difference| panic!("{title}: {difference}"))
}

/// The sector's own point flips exactly on to a face of the sector's hull. A far point hides it,
/// and only a question about far blocks shows that.
#[test]
fn own_points_on_a_face_below_a_far_point_are_hidden() {
    let scene = structured::scene(&mut Rng::new(319), structured::IN_SQUARE, 2000);
    let cloud = PointCloud::new(&scene.points).unwrap();
    for count in [4, 8, 16] {
        let title = "a point in a square";
        compare(&cloud, scene.viewpoint, &scene.options, count, title);
    }
}

/// If the flip loses too many digits, the first sector answers for all points.
#[test]
fn large_exponents_are_not_divided() {
    let points = shapes::bumpy(&mut Rng::new(13), 4000);
    let cloud = PointCloud::new(&points).unwrap();
    let counts = |exponent: f64| {
        let options = Options::with_exponent(exponent);
        compare(&cloud, [0.0, 0.5, 3.0], &options, 3, "a large exponent")
    };
    assert!(counts(7.9).iter().all(|&count| count > 0));
    for exponent in [8.0, 8.1, 12.0] {
        assert_eq!(counts(exponent)[1..], [0, 0], "exponent {exponent}");
    }
}

#[test]
fn sectors_of_a_large_cloud_share_the_work() {
    let mut rng = Rng::new(9);
    let points = shapes::bumpy(&mut rng, 60_000);
    let cloud = PointCloud::new(&points).unwrap();
    for viewpoint in [[0.0, 0.0, 3.0], [2.0, 1.5, -0.5], [0.1, 0.2, 0.1]] {
        for count in [2, 3, 4] {
            let options = Options::default();
            let counts = compare(&cloud, viewpoint, &options, count, "a large cloud");
            let fair = counts.iter().sum::<usize>() / count as usize;
            for own in counts {
                assert!(
                    own > fair / 3 && own < 2 * fair,
                    "{own} where {fair} is fair"
                );
            }
        }
    }
}

#[test]
fn refusals_are_those_of_the_whole() {
    let cloud = PointCloud::new(&shapes::bumpy(&mut Rng::new(11), 500)).unwrap();
    for radius in [f64::NAN, -1.0, 0.5, f64::MAX] {
        let options = Options::default().radius(Radius::Absolute(radius));
        compare(&cloud, [0.0, 0.0, 3.0], &options, 2, "a bad radius");
    }
    for viewpoint in [
        [f64::NAN, 0.0, 0.0],
        [0.0, f64::INFINITY, 0.0],
        [1e200, 0.0, 0.0],
    ] {
        compare(&cloud, viewpoint, &Options::default(), 2, "a bad viewpoint");
    }
    assert_eq!(Sector::new(2, 2), None);
    assert_eq!(Sector::new(0, 0), None);
}
