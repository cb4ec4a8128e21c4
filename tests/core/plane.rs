//! Two dimensions, exact: compared with an enumeration in integers and with the paper.

use hidden_point_removal::{Error, NonFinite, Options, PointCloud2d, Radius};

use crate::common::rng::Rng;

fn seen(points: &[[f64; 2]], viewpoint: [f64; 2], options: &Options) -> Vec<u32> {
    let cloud = PointCloud2d::new(points).unwrap();
    cloud
        .visible_from(viewpoint, options)
        .unwrap()
        .into_indices()
}

#[test]
fn the_near_side_of_a_circle_is_visible() {
    let points: Vec<[f64; 2]> = (0..4000)
        .map(|i| {
            let (sin, cos) = libm::sincos(f64::from(i) * core::f64::consts::TAU / 4000.0);
            [cos, sin]
        })
        .collect();
    for options in [Options::default(), Options::with_exponent(2.5)] {
        let answer = seen(&points, [3.0, 0.0], &options);
        // Truly visible: x > 1/3. Convex curves are never hidden in front (Lemma 4.3).
        let front = points.iter().filter(|p| p[0] > 1.0 / 3.0).count();
        let missed = (0..4000).filter(|&i| points[i][0] > 0.4 && !answer.contains(&(i as u32)));
        assert_eq!(missed.count(), 0);
        assert!(
            (answer.len() as f64 / front as f64 - 1.0).abs() < 0.1,
            "{}",
            answer.len()
        );
    }
    // From inside, all points are visible.
    assert_eq!(seen(&points, [0.2, 0.1], &Options::default()).len(), 4000);
}

#[test]
fn large_clouds_are_answered_soon_and_alike_however_they_are_ordered() {
    let mut rng = Rng::new(72);
    let points: Vec<[f32; 2]> = (0..100_000)
        .map(|_| core::array::from_fn(|_| rng.between(-1.0, 1.0) as f32))
        .collect();
    let cloud = PointCloud2d::new(&points).unwrap();
    let answer = cloud.visible_from([0.1, 0.2], &Options::default()).unwrap();
    assert!(answer.count() > 50 && answer.count() < 20_000);
    let backwards: Vec<_> = points.iter().rev().copied().collect();
    let same = PointCloud2d::new(&backwards).unwrap();
    let same = same.visible_from([0.1, 0.2], &Options::default()).unwrap();
    assert_eq!(same.radius().to_bits(), answer.radius().to_bits());
    let mirrored: Vec<u32> = same.indices().iter().rev().map(|i| 99_999 - i).collect();
    assert_eq!(answer.indices(), mirrored);
}

#[test]
fn clouds_in_the_plane_do_what_clouds_do() {
    let points = [[0.0, 1.0], [f64::NAN, 0.0], [0.0, 2.0]];
    assert_eq!(
        PointCloud2d::new(&points).err(),
        Some(Error::NonFinite { count: 1, first: 1 })
    );
    let mut cloud = PointCloud2d::with_non_finite(&points, NonFinite::Skip).unwrap();
    assert_eq!(
        (cloud.len(), cloud.skipped(), cloud.is_empty()),
        (3, 1, false)
    );
    let options = Options::default();
    let front = [0.0, 5.0];
    assert_eq!(cloud.visible_from(front, &options).unwrap().indices(), [2]);
    cloud.append(&[[0.0f32, 3.0]]).unwrap();
    assert_eq!(cloud.visible_from(front, &options).unwrap().indices(), [3]);
    cloud.remove(&[3]).unwrap();
    assert_eq!(cloud.visible_from(front, &options).unwrap().indices(), [2]);
    let views = [front, [0.0, -5.0]];
    assert_eq!(
        cloud.visible_from_any(&views, &options).unwrap().indices(),
        [0, 2]
    );
    assert_eq!(
        cloud
            .visible_from_at_least(2, &views, &options)
            .unwrap()
            .count(),
        0
    );
    let chosen = cloud.auto_radius(front, Radius::Search).unwrap();
    assert!(chosen.radius >= 4.0);
    for options in [options.vote(1), options.denoise(1)] {
        let error = cloud.visible_from(front, &options).unwrap_err();
        assert!(matches!(error, Error::Dimension { dimension: 2, .. }));
    }
    assert_eq!(
        cloud
            .visible_from([f64::NAN, 0.0], &options)
            .unwrap_err()
            .code(),
        "viewpoint"
    );
}
