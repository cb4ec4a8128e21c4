//! Values of images on points, compared with the rule for each point alone.

use hidden_point_removal::{
    Camera, CameraModel, Convention, Image, Merge, Options, Pixels, PointCloud, Pose, Sampling,
    TransferOptions, Transferred, Values, Weights,
};

use crate::common::cameras::{LENSES, camera, matrix, shown};
use crate::common::flip::distance;
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

/// What a camera gives a point: one value, a label and a weight.
type Seen = (f64, f64, f64);

/// The values of images at the visible points, from the formulas alone. Also the points where rounding decides.
fn by_definition(
    cloud: &PointCloud,
    points: &[[f64; 3]],
    cameras: &[Camera],
    images: &[Vec<f32>],
    options: &Options,
    how: &TransferOptions,
) -> (Vec<Vec<Seen>>, Vec<bool>) {
    let mut seen = vec![Vec::new(); points.len()];
    let mut in_doubt = vec![false; points.len()];
    for (camera, image) in cameras.iter().zip(images) {
        let options = options.with_scores(how.weights == Weights::Score);
        let view = cloud.visible_from(camera.position(), &options).unwrap();
        for &index in view.indices() {
            let point = points[index as usize];
            let at = shown(camera, point);
            let [u, v] = at.pixel;
            let is_between = [u, v].iter().any(|x| (x - x.round()).abs() < 1e-4);
            in_doubt[index as usize] |= at.in_doubt || is_between;
            if !at.inside {
                continue;
            }
            let (width, height) = (camera.width as usize, camera.height as usize);
            let pixel = |x: f64, y: f64| {
                let inside = |x: f64, end: usize| x.clamp(0.0, end as f64 - 1.0) as usize;
                let at = 2 * (inside(y, height) * width + inside(x, width));
                (f64::from(image[at]), f64::from(image[at + 1]))
            };
            let (first, second) = match how.sampling {
                Sampling::Nearest => pixel(u.floor(), v.floor()),
                Sampling::Bilinear => {
                    let (left, up) = ((u - 0.5).floor(), (v - 0.5).floor());
                    let (x, y) = (u - 0.5 - left, v - 0.5 - up);
                    let row = |y: f64| (1.0 - x) * pixel(left, y).0 + x * pixel(left + 1.0, y).0;
                    ((1.0 - y) * row(up) + y * row(up + 1.0), 0.0)
                }
            };
            let weight = match how.weights {
                Weights::Equal => 1.0,
                Weights::Distance => 1.0 / (at.depth * at.depth),
                Weights::Angle => at.depth / distance(point, camera.position()),
                Weights::Score => view.scores()[index as usize].into(),
            };
            seen[index as usize].push((first, first + 5.0 * second, weight));
        }
    }
    (seen, in_doubt)
}

#[test]
fn each_point_has_the_merged_value_of_the_cameras_that_see_it() {
    let mut rng = Rng::new(5);
    let mut compared = 0;
    let usual = shapes::bumpy(&mut rng, 300);
    let merges = [Merge::Mean, Merge::Median, Merge::Vote, Merge::Best];
    let weights = [
        Weights::Equal,
        Weights::Distance,
        Weights::Angle,
        Weights::Score,
    ];
    let samplings = [Sampling::Nearest, Sampling::Bilinear];
    for (round, &(model, distortion)) in LENSES.iter().cycle().take(64).enumerate() {
        let how = TransferOptions {
            merge: merges[round % 4],
            weights: weights[round / 4 % 4],
            sampling: samplings[round / 16 % 2],
        };
        if how.merge == Merge::Vote && how.sampling == Sampling::Bilinear {
            continue;
        }
        let unit = 2f64.powi(rng.integer(-100, 100));
        let points: Vec<_> = usual.iter().map(|p| p.map(|x| x * unit)).collect();
        let cloud = PointCloud::new(&points).unwrap();
        // One camera is a pinhole: a false weight of the others shows.
        let cameras: Vec<Camera> = (0..5)
            .map(|number| {
                let place = rng.direction().map(|x| x * 2.0);
                let convention = rng.pick(&[Convention::OpenCv, Convention::OpenGl]);
                let mut own = camera(&mut rng, place, place.map(|x| -x), convention);
                matrix(&mut own)[12..15].iter_mut().for_each(|x| *x *= unit);
                [own.width, own.height] = [16.0, 12.0];
                [own.fx, own.fy, own.cx, own.cy] = [9.0, 8.0, 8.5, 6.0];
                if number > 0 {
                    (own.model, own.distortion) = (model, distortion);
                }
                own
            })
            .collect();
        let images: Vec<Vec<f32>> = (0..5)
            .map(|_| (0..2 * 16 * 12).map(|_| rng.below(5) as f32).collect())
            .collect();
        let given = images.iter().map(|image| Image {
            pixels: Pixels::Singles(image),
            channels: 2,
        });
        let options = Options::looks(3);
        let found = cloud.transfer(&cameras, given, &options, &how).unwrap();
        let (seen, in_doubt) = by_definition(&cloud, &points, &cameras, &images, &options, &how);
        let values = numbers(&found);
        for (index, seen) in seen
            .iter()
            .enumerate()
            .filter(|&(index, _)| !in_doubt[index])
        {
            assert_eq!(found.seen[index] as usize, seen.len());
            let own = [values[2 * index], values[2 * index + 1]];
            if seen.is_empty() {
                assert!(own.iter().all(|value| value.is_nan()));
                continue;
            }
            let is_label = how.merge == Merge::Vote;
            let of =
                |&(value, label, weight): &Seen| (if is_label { label } else { value }, weight);
            let expected = merged(how.merge, &seen.iter().map(of).collect::<Vec<_>>());
            let found = own[0] + if is_label { 5.0 * own[1] } else { 0.0 };
            let title = format!("{how:?} of {seen:?} by {model:?} in units of {unit}");
            assert!(
                (found - expected).abs() < 1e-5,
                "{found}, not {expected}: {title}"
            );
            compared += usize::from(seen.len() > 1);
        }
    }
    assert!(compared > 4000, "{compared} values of several cameras");
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
