//! Clouds in a plane with the viewpoint.

use hidden_point_removal::{Options, PointCloud};

use crate::common::rng::Rng;

fn seen(points: &[[f64; 3]], viewpoint: [f64; 3], options: &Options) -> Vec<u32> {
    let cloud = PointCloud::new(points).unwrap();
    cloud
        .visible_from(viewpoint, options)
        .unwrap()
        .into_indices()
}

#[test]
fn the_near_side_of_a_circle_is_visible() {
    let points: Vec<[f64; 3]> = (0..4000)
        .map(|i| {
            let (sin, cos) = libm::sincos(f64::from(i) * core::f64::consts::TAU / 4000.0);
            [cos, sin, 0.0]
        })
        .collect();
    for options in [Options::default(), Options::with_exponent(2.5)] {
        let answer = seen(&points, [3.0, 0.0, 0.0], &options);
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
    assert_eq!(
        seen(&points, [0.2, 0.1, 0.0], &Options::default()).len(),
        4000
    );
}

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
