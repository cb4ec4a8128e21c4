//! Clouds in a plane with the viewpoint.

use hidden_point_removal::{Options, PointCloud};

use crate::common::rng::Rng;
use crate::test;

#[test]
fn large_clouds_are_answered_soon_and_alike_however_they_are_ordered() {
    let mut rng = Rng::new(72);
    let points: Vec<[f32; 3]> = (0..100_000)
        .map(|_| {
            [
                rng.between(-1.0, 1.0) as f32,
                rng.between(-1.0, 1.0) as f32,
                0.0,
            ]
        })
        .collect();
    let cloud = PointCloud::new(&points).unwrap();
    let answer = cloud
        .visible_from([0.1, 0.2, 0.0], &Options::default())
        .unwrap();
    assert!(answer.count() > 50 && answer.count() < 20_000);
    let backwards: Vec<_> = points.iter().rev().copied().collect();
    let same = PointCloud::new(&backwards).unwrap();
    let same = same
        .visible_from([0.1, 0.2, 0.0], &Options::default())
        .unwrap();
    assert_eq!(same.radius().to_bits(), answer.radius().to_bits());
    let mirrored: Vec<u32> = same.indices().iter().rev().map(|i| 99_999 - i).collect();
    assert_eq!(answer.indices(), mirrored);
}
