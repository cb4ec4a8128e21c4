//! Denoising before a view, and votes after it.

use hidden_point_removal::{Options, PointCloud, merge_visible};

use crate::common::rng::Rng;
use crate::common::{ask, refused, shapes};
use crate::test;

const FRONT: [f64; 3] = [0.0, 0.0, 3.0];

fn voting(k: usize) -> Options {
    Options::default().vote(k)
}

fn denoising(k: usize) -> Options {
    Options::default().denoise(k)
}

/// A sphere whose points are moved along their normals. The points that face the viewer
/// are truly visible.
fn noisy_sphere(n: usize, noise: f64) -> (Vec<[f64; 3]>, Vec<u8>) {
    let mut rng = Rng::new(77);
    let sphere = shapes::sphere(&mut rng, n);
    let truth = sphere
        .iter()
        .map(|p| u8::from(p[2] > 1.0 / FRONT[2]))
        .collect();
    let moved = |p: [f64; 3]| {
        let by = 1.0 + noise * (rng.unit() + rng.unit() + rng.unit() - 1.5);
        p.map(|x| x * by)
    };
    (sphere.into_iter().map(moved).collect(), truth)
}

#[test]
fn both_help_where_there_is_noise() {
    let (points, truth) = noisy_sphere(4000, 0.03);
    let wrong = |options: &Options| {
        let mask = ask(&points, FRONT, options).mask();
        mask.iter().zip(&truth).filter(|(a, b)| a != b).count()
    };
    let raw = wrong(&Options::default());
    let denoised = wrong(&denoising(16));
    let both = wrong(&denoising(32).vote(16));
    assert!(denoised * 10 < raw * 7, "{denoised} against {raw}");
    assert!(both * 10 < raw * 7, "{both} against {raw}");
}

#[test]
fn a_denoised_cloud_is_asked_like_any_other() {
    let (points, _) = noisy_sphere(900, 0.05);
    let cloud = PointCloud::new(&points).unwrap();
    let denoised = cloud.denoised(12).unwrap();
    assert_eq!((denoised.len(), denoised.skipped()), (900, 0));
    let once = cloud.visible_from(FRONT, &denoising(12)).unwrap();
    assert_eq!(
        denoised.visible_from(FRONT, &Options::default()).unwrap(),
        once
    );
    let direction = [0.1, 0.2, -1.0];
    let once = cloud
        .visible_from_direction(direction, &denoising(12))
        .unwrap();
    let same = denoised.visible_from_direction(direction, &Options::default());
    assert_eq!(same.unwrap(), once);
    let views = [FRONT, [0.5, 3.0, 0.0]];
    let once = cloud
        .visible_from_at_least(2, &views, &denoising(12))
        .unwrap();
    let same = denoised.visible_from_at_least(2, &views, &Options::default());
    assert_eq!(same.unwrap(), once);
    // The cloud itself stays as it is.
    let plain = cloud.visible_from(FRONT, &Options::default()).unwrap();
    assert_eq!(plain, ask(&points, FRONT, &Options::default()));
    assert_ne!(plain.radius(), once.radius());
}

#[test]
fn a_prepared_cloud_answers_like_one_made_anew() {
    let (points, _) = noisy_sphere(700, 0.05);
    let mut keeping = PointCloud::new(&points[..600]).unwrap();
    let mut plain = PointCloud::new(&points[..600]).unwrap();
    let views = [FRONT, [0.5, 3.0, 0.0]];
    for round in 0..4 {
        for k in [9, 14] {
            let [voting, both] = [None, Some(k)]
                .map(|denoise| Options::default().denoise(denoise).vote(5 + round % 2));
            keeping.prepare_for(&voting).unwrap();
            let other = denoising(9 + 2 * round);
            keeping
                .prepare_for(if k == 9 { &other } else { &both })
                .unwrap();
            let kept = keeping.visible_from(FRONT, &voting).unwrap();
            assert_eq!(kept, plain.visible_from(FRONT, &voting).unwrap());
            let options = both;
            let [kept, anew] = [&keeping, &plain].map(|cloud| {
                (
                    cloud.visible_from(FRONT, &options).unwrap(),
                    cloud.visible_from_at_least(2, &views, &options).unwrap(),
                    cloud.reconstruct(FRONT, &options, None).unwrap(),
                )
            });
            assert_eq!(kept, anew);
        }
        for cloud in [&mut keeping, &mut plain] {
            match round {
                0 => cloud.append(&points[600..]).unwrap(),
                1 => cloud.remove(&[3, 77, 650]).unwrap(),
                // Removes one of two equal points: all positions stay, but the indices change.
                _ => {
                    cloud.append(&points[5..6]).unwrap();
                    cloud.prepare_for(&denoising(9)).unwrap();
                    cloud.remove(&[5]).unwrap();
                }
            }
        }
    }
    // A refused call changes no later answer.
    assert!(keeping.prepare_for(&denoising(10_000)).is_err());
    let kept = keeping.visible_from(FRONT, &denoising(9)).unwrap();
    assert_eq!(kept, plain.visible_from(FRONT, &denoising(9)).unwrap());
}

#[test]
fn points_on_planes_and_lines_stay_where_they_are() {
    let mut rng = Rng::new(9);
    for flat in [1, 2] {
        let points: Vec<[f64; 3]> = (0..200)
            .map(|_| {
                let mut p: [f64; 3] = core::array::from_fn(|_| f64::from(rng.integer(-9, 9)));
                p[..flat].fill(2.0);
                p
            })
            .collect();
        let plain = ask(&points, [9.5, 0.5, 0.5], &Options::default());
        let same = ask(&points, [9.5, 0.5, 0.5], &denoising(8));
        assert_eq!(same.indices(), plain.indices());
        assert!((same.radius() / plain.radius() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn removed_and_skipped_points_are_no_neighbors() {
    let (points, _) = noisy_sphere(300, 0.05);
    let mut cloud = PointCloud::new(&points[..200]).unwrap();
    cloud.append(&points[200..]).unwrap();
    let removed: Vec<u32> = (0..300).step_by(3).collect();
    cloud.remove(&removed).unwrap();
    let kept: Vec<usize> = (0..300).filter(|i| i % 3 != 0).collect();
    let rest: Vec<_> = kept.iter().map(|&i| points[i]).collect();
    let options = denoising(9).vote(9);
    let expected: Vec<u32> = ask(&rest, FRONT, &options)
        .indices()
        .iter()
        .map(|&i| kept[i as usize] as u32)
        .collect();
    assert_eq!(
        cloud.visible_from(FRONT, &options).unwrap().indices(),
        expected
    );
}

#[test]
fn what_does_not_fit_is_refused() {
    let points = shapes::bumpy(&mut Rng::new(3), 20);
    let cloud = PointCloud::new(&points).unwrap();
    let ask = |options: Options| cloud.visible_from(FRONT, &options);
    for k in [0, 20, usize::MAX] {
        refused("option", "vote must be from 1 to 19", ask(voting(k)));
        refused("option", "denoise must be from 1 to 19", ask(denoising(k)));
        refused("option", "", cloud.denoised(k));
    }
    for options in [voting(19), denoising(19)] {
        assert!(ask(options).is_ok());
        let options = options.radius(Options::with_radius(9.0).radius);
        let merged = merge_visible(&[(&points[..], &[0; 20][..])], FRONT, &options);
        refused("option", "cannot be combined with merging", merged);
    }
    let alone = PointCloud::new(&[[0.0; 3]]).unwrap();
    refused("option", "vote", alone.visible_from(FRONT, &voting(1)));
}
