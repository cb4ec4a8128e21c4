//! Values of images on points, compared with the rule for each point alone.

use hidden_point_removal::{
    Camera, CameraModel, Convention, Image, Merge, Options, Pixels, PointCloud, Pose, Sampling,
    TransferOptions, Transferred, Values, Weights,
};

use crate::common::cameras::camera;
use crate::common::refused;
use crate::common::rng::Rng;
use crate::common::shapes;
use crate::test;

fn numbers(Transferred { values, .. }: &Transferred) -> Vec<f64> {
    match values {
        Values::Singles(values) => values.iter().map(|&value| value.into()).collect(),
        Values::Doubles(values) => values.clone(),
    }
}

/// The merged value of one channel, straight from its definition.
fn merged(merge: Merge, seen: &[(f64, f64)]) -> f64 {
    let total: f64 = seen.iter().map(|(_, weight)| weight).sum();
    match merge {
        Merge::Mean if total > 0.0 => {
            seen.iter()
                .map(|(value, weight)| value * weight)
                .sum::<f64>()
                / total
        }
        Merge::Mean => seen[0].0,
        Merge::Best => {
            let best = seen
                .iter()
                .map(|(_, weight)| *weight)
                .fold(f64::MIN, f64::max);
            seen.iter().find(|(_, weight)| *weight == best).unwrap().0
        }
        Merge::Vote => {
            let votes = |value: f64| -> f64 {
                let same = seen.iter().filter(|(other, _)| *other == value);
                same.map(|(_, weight)| weight).sum()
            };
            let most = seen
                .iter()
                .map(|(value, _)| votes(*value))
                .fold(f64::MIN, f64::max);
            seen.iter()
                .find(|(value, _)| votes(*value) == most)
                .unwrap()
                .0
        }
        Merge::Median => {
            let mut sorted = seen.to_vec();
            sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut sum = 0.0;
            for (k, (value, weight)) in sorted.iter().enumerate() {
                sum += weight;
                if sum == total / 2.0 && k + 1 < sorted.len() {
                    return (value + sorted[k + 1].0) / 2.0;
                }
                if sum >= total / 2.0 {
                    return *value;
                }
            }
            f64::NAN
        }
    }
}

#[test]
fn each_point_has_the_merged_value_of_the_cameras_that_see_it() {
    let mut rng = Rng::new(5);
    let points = shapes::bumpy(&mut rng, 700);
    let cloud = PointCloud::new(&points).unwrap();
    let options = Options::looks(3);
    let cameras: Vec<Camera> = (0..6)
        .map(|_| {
            let place = rng.direction().map(|x| x * 3.0);
            let mut own = camera(&mut rng, place, place.map(|x| -x), Convention::OpenCv);
            [own.width, own.height] = [16.0, 12.0];
            [own.fx, own.fy, own.cx, own.cy] = [14.0, 14.0, 8.0, 6.0];
            own
        })
        .collect();
    let images: Vec<Vec<f32>> = (0..6)
        .map(|_| (0..2 * 16 * 12).map(|_| rng.below(5) as f32).collect())
        .collect();
    for merge in [Merge::Mean, Merge::Median, Merge::Vote, Merge::Best] {
        for weights in [
            Weights::Equal,
            Weights::Distance,
            Weights::Angle,
            Weights::Score,
        ] {
            let how = TransferOptions {
                merge,
                weights,
                sampling: Sampling::Nearest,
            };
            let given = images.iter().map(|image| Image {
                pixels: Pixels::Singles(image),
                channels: 2,
            });
            let found = cloud.transfer(&cameras, given, &options, &how).unwrap();
            let mut seen = vec![Vec::new(); points.len()];
            let scored = options.with_scores(weights == Weights::Score);
            for (camera, image) in cameras.iter().zip(&images) {
                let view = cloud.visible_from_camera(camera, &scored).unwrap();
                let place = camera.position();
                for (k, &index) in view.visibility.indices().iter().enumerate() {
                    let [u, v] = view.pixels[k].map(|x| x.floor() as usize);
                    let distance = crate::common::flip::distance(points[index as usize], place);
                    let depth = f64::from(view.depths[k]);
                    let weight = match weights {
                        Weights::Equal => 1.0,
                        Weights::Distance => 1.0 / (depth * depth),
                        Weights::Angle => depth / distance,
                        Weights::Score => view.visibility.scores()[index as usize].into(),
                    };
                    // Channel 0 of the pixel, and all of it as one label.
                    let at = 2 * (v * 16 + u);
                    let label = f64::from(image[at]) + 5.0 * f64::from(image[at + 1]);
                    seen[index as usize].push((f64::from(image[at]), label, weight));
                }
            }
            let values = numbers(&found);
            for (index, seen) in seen.iter().enumerate() {
                assert_eq!(found.seen[index] as usize, seen.len());
                let own = [values[2 * index], values[2 * index + 1]];
                if seen.is_empty() {
                    assert!(own.iter().all(|value| value.is_nan()));
                    continue;
                }
                let (found, expected) = match merge {
                    Merge::Vote => {
                        let labels: Vec<_> =
                            seen.iter().map(|(_, label, w)| (*label, *w)).collect();
                        (own[0] + 5.0 * own[1], merged(merge, &labels))
                    }
                    _ => {
                        let first: Vec<_> = seen.iter().map(|(value, _, w)| (*value, *w)).collect();
                        (own[0], merged(merge, &first))
                    }
                };
                let title = format!("{merge:?} by {weights:?} of {seen:?}");
                assert!(
                    (found - expected).abs() < 1e-5,
                    "{found}, not {expected}: {title}"
                );
            }
        }
    }
}

/// A camera at the origin that looks along +z.
fn ahead(size: f64) -> Camera {
    Camera::new(100.0, 100.0, size / 2.0, size / 2.0, size, size)
}

fn one(
    points: &[[f64; 3]],
    cameras: &[Camera],
    images: &[Image],
    how: TransferOptions,
) -> Transferred {
    let cloud = PointCloud::new(points).unwrap();
    let options = Options::looks(3);
    let images = images.iter().copied();
    cloud.transfer(cameras, images, &options, &how).unwrap()
}

#[test]
fn an_angle_is_that_of_the_ray_whatever_the_lens() {
    // 80° off the axis of a fisheye, and 60° off that of a pinhole.
    let angle = 80f64.to_radians();
    let mut fisheye = ahead(400.0);
    fisheye.model = CameraModel::OpenCvFisheye;
    let mut pinhole = ahead(400.0);
    let (sin, cos) = 20f64.to_radians().sin_cos();
    let mut pose = [0.0; 16];
    (pose[0], pose[2], pose[8], pose[10]) = (cos, -sin, sin, cos);
    (pose[5], pose[15]) = (1.0, 1.0);
    pinhole.pose = Pose::CameraToWorld(pose);
    let [low, high] = [vec![0.0; 160_000], vec![1.0; 160_000]];
    let images = [&low, &high].map(|numbers| Image {
        pixels: Pixels::Doubles(numbers),
        channels: 1,
    });
    let how = TransferOptions {
        weights: Weights::Angle,
        ..TransferOptions::default()
    };
    let point = [angle.sin(), 0.0, angle.cos()];
    let found = numbers(&one(&[point], &[fisheye, pinhole], &images, how))[0];
    let [a, b] = [80f64, 60.0].map(|degrees| degrees.to_radians().cos());
    assert!((found - b / (a + b)).abs() < 1e-6, "{found}");
}

#[test]
fn labels_and_tiny_distances_stay_what_they_are() {
    let label = 16_777_217.0;
    for unit in [2f64.powi(-100), 1.0, 2f64.powi(100)] {
        for merge in [Merge::Mean, Merge::Median, Merge::Vote, Merge::Best] {
            let how = TransferOptions {
                merge,
                weights: Weights::Distance,
                sampling: Sampling::Nearest,
            };
            let image = Image {
                pixels: Pixels::Doubles(&[label]),
                channels: 1,
            };
            let mut camera = ahead(1.0);
            [camera.cx, camera.cy] = [0.5, 0.5];
            let found = one(&[[0.0, 0.0, unit]], &[camera; 3], &[image; 3], how);
            assert_eq!(numbers(&found), [label], "{merge:?} at {unit}");
            assert_eq!(found.seen, [3]);
        }
    }
}

#[test]
fn pixels_without_a_value_give_none() {
    let mut camera = ahead(2.0);
    [camera.fx, camera.fy] = [1.0, 1.0];
    let point = [[-0.5, -0.5, 1.0]];
    let clear = [9, 9, 9, 0, 1, 2, 3, 255, 4, 5, 6, 255, 7, 8, 9, 255];
    let image = Image {
        pixels: Pixels::Bytes(&clear),
        channels: 4,
    };
    let nearest = TransferOptions::default();
    assert_eq!(one(&point, &[camera], &[image], nearest).seen, [0]);
    let gap = [f32::NAN, 1.0, 2.0, 3.0];
    let image = Image {
        pixels: Pixels::Singles(&gap),
        channels: 1,
    };
    assert_eq!(one(&point, &[camera], &[image], nearest).seen, [0]);
    // Between the four centers, the other three count.
    let bilinear = TransferOptions {
        sampling: Sampling::Bilinear,
        ..nearest
    };
    let found = one(&[[0.0, 0.0, 1.0]], &[camera], &[image], bilinear);
    assert_eq!((numbers(&found), found.seen), (vec![2.0], vec![1]));
}

#[test]
fn what_does_not_fit_is_refused() {
    let cloud = PointCloud::new(&[[0.0, 0.0, 1.0]]).unwrap();
    let camera = ahead(2.0);
    let ask = |images: &[Image], how: &TransferOptions| {
        let images = images.iter().copied();
        cloud.transfer(&[camera; 2], images, &Options::default(), how)
    };
    let image = |numbers, channels| Image {
        pixels: Pixels::Bytes(numbers),
        channels,
    };
    let usual = TransferOptions::default();
    let fit = image(&[0; 4], 1);
    for images in [&[fit][..], &[fit; 3]] {
        refused("option", "the number of images", ask(images, &usual));
    }
    refused("option", "size", ask(&[image(&[0; 3], 1); 2], &usual));
    let uneven = [fit, image(&[0; 8], 2)];
    refused("option", "channels must be", ask(&uneven, &usual));
    refused("option", "channels", ask(&[image(&[], 0); 2], &usual));
    let how = TransferOptions {
        merge: Merge::Vote,
        sampling: Sampling::Bilinear,
        ..usual
    };
    refused("option", "bilinear", ask(&[fit; 2], &how));
}
