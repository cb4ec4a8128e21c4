//! Only the points within a distance, a box or a mask take part: the answers are, to the bit,
//! those of a cloud of these points alone.

use hidden_point_removal::{Options, PointCloud, PointCloudNd, Within};

use crate::common::chosen::{alone, chosen, facts, only};
use crate::common::refused;
use crate::common::rng::Rng;
use crate::common::shapes;
use crate::test;

#[test]
fn duplicates_may_be_masked_one_by_one() {
    let points = [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 2.0]];
    let cloud = PointCloud::new(&points).unwrap();
    let seen = |mask: [bool; 3]| {
        let part = cloud.masked(&mask).unwrap();
        assert_eq!(part.len(), 3);
        let seen = part.visible_from([0.0, 0.0, 5.0], &Options::default());
        seen.unwrap().into_indices()
    };
    assert_eq!(seen([true, true, false]), [0, 1]);
    assert_eq!(seen([false, true, false]), [1]);
    assert_eq!(seen([true, false, true]), [2]);
    assert!(seen([false; 3]).is_empty());
}

#[test]
fn a_kept_part_follows_changes_of_the_cloud() {
    let mut rng = Rng::new(4);
    let mut points = shapes::ball(&mut rng, 200);
    let mut cloud = PointCloud::new(&points).unwrap();
    let within = Within {
        distance: None,
        bounds: Some([[-0.5; 3], [0.5; 3]]),
    };
    let options = only(within, &Options::default());
    cloud.prepare_for(&options).unwrap();
    let more = shapes::ball(&mut rng, 50);
    cloud.append(&more).unwrap();
    points.extend(more);
    let indices = chosen(&points, &within, None);
    let viewpoint = [0.1, 0.2, 1.5];
    assert_eq!(
        facts(cloud.visible_from(viewpoint, &options), None),
        facts(
            alone(&points, &indices).visible_from(viewpoint, &Options::default()),
            Some(&indices)
        )
    );
}

#[test]
fn choices_that_make_no_sense_are_refused() {
    let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]]).unwrap();
    let distance = |distance| Within {
        distance: Some(distance),
        bounds: None,
    };
    let far = [0.0, 0.0, 5.0];
    refused("option", "each of 3 indices, got 1", cloud.masked(&[true]));
    // A radius need only reach the points that take part.
    let small = only(distance(4.5), &Options::radius(4.5));
    assert_eq!(
        cloud.visible_from(far, &small).unwrap().indices(),
        [0, 1, 2]
    );
    let empty = only(distance(0.5), &Options::default());
    let nothing = cloud.visible_from(far, &empty).unwrap();
    assert_eq!((nothing.count(), nothing.radius()), (0, 0.0));
    let four = PointCloudNd::new(4, &[0.0; 8]).unwrap();
    refused("option", "", four.visible_from(&[1.0; 4], &small));
}
