//! What a camera sees: the view from its place, cut to its image.

use hidden_point_removal::{
    Camera, CameraModel, Convention, Error, MapOptions, Options, PointCloud, Pose,
};

use crate::common::cameras::{LENSES, camera, matrix};
use crate::common::rng::Rng;
use crate::common::shapes;
use crate::test;

#[test]
fn borders_of_the_image_belong_to_it_above_and_on_the_left() {
    let camera = Camera::new(10.0, 10.0, 5.0, 5.0, 10.0, 10.0);
    let points = [
        [-0.5, 0.0, 1.0],
        [0.5, 0.0, 1.0],
        [0.0, -0.5, 1.0],
        [0.0, 0.5, 1.0],
        [0.25, 0.25, 1.0],
        [0.0, 0.0, 0.0],
        [0.0, 0.0, -1.0],
        // It would round to the width in single precision.
        [0.5 - 1e-12, 0.125, 1.0],
    ];
    let cloud = PointCloud::new(&points).unwrap();
    let options = Options::exponent(9.0);
    let seen = cloud.visible_from_camera(&camera, &options).unwrap();
    assert_eq!(seen.visibility.indices(), [0, 2, 4, 7]);
    assert_eq!(seen.pixels[..3], [[0.0, 5.0], [5.0, 0.0], [7.5, 7.5]]);
    assert!(seen.pixels[3][0] < 10.0);
    assert_eq!(seen.depths, [1.0; 4]);
    let far = Camera {
        far: 1.0,
        near: 1.0,
        ..camera
    };
    let seen = cloud.visible_from_camera(&far, &options).unwrap();
    assert_eq!(seen.visibility.count(), 4);
    let far = Camera { far: 0.5, ..camera };
    let seen = cloud.visible_from_camera(&far, &options).unwrap();
    assert_eq!(seen.visibility.count(), 0);
}

#[test]
fn cameras_that_are_none_are_refused() {
    let cloud = PointCloud::new(&[[0.0, 0.0, 1.0]]).unwrap();
    let good = Camera::new(10.0, 10.0, 5.0, 5.0, 10.0, 10.0);
    let refused = |change: &dyn Fn(&mut Camera)| {
        let mut camera = good;
        change(&mut camera);
        let refusal = cloud.visible_from_camera(&camera, &Options::default());
        let refusal = refusal.unwrap_err();
        assert_eq!(refusal.code(), "viewpoint");
        assert_eq!(camera.cone().unwrap_err().to_string(), refusal.to_string());
        let counted = cloud.coverage(&[camera], &Options::default());
        assert_eq!(counted.unwrap_err().to_string(), refusal.to_string());
        refusal.to_string()
    };
    let nan = f64::NAN;
    assert!(refused(&|camera| matrix(camera)[5] = nan).contains("pose must be finite, got NaN"));
    let rigid = "rotation and a translation";
    assert!(refused(&|camera| matrix(camera)[5] = -1.0).contains(rigid));
    assert!(refused(&|camera| matrix(camera)[0] = 1.001).contains(rigid));
    assert!(refused(&|camera| matrix(camera)[4] = 2e-3).contains(rigid));
    assert!(refused(&|camera| matrix(camera)[15] = 2.0).contains(rigid));
    assert!(refused(&|camera| *matrix(camera) = [0.0; 16]).contains(rigid));
    assert!(refused(&|camera| camera.fx = 0.0).contains("fx"));
    assert!(refused(&|camera| camera.fy = -3.0).contains("fy must be finite and positive, got -3"));
    assert!(refused(&|camera| camera.width = 0.0).contains("width"));
    assert!(refused(&|camera| camera.height = f64::INFINITY).contains("height"));
    assert!(refused(&|camera| camera.cx = nan).contains("cx"));
    assert!(refused(&|camera| camera.distortion[3] = nan).contains("distortion"));
    assert!(refused(&|camera| camera.near = -1.0).contains("near"));
    assert!(refused(&|camera| camera.far = nan).contains("far"));
    assert!(refused(&|camera| (camera.near, camera.far) = (2.0, 1.0)).contains("far"));
    assert!(refused(&|camera| camera.distortion[5] = 0.1).contains("more numbers than its model"));
    let fov = |omega: f64| {
        refused(&|camera| (camera.model, camera.distortion[0]) = (CameraModel::Fov, omega))
    };
    for omega in [-0.1, 3.2, nan] {
        assert!(fov(omega).contains("from 0 to pi for FOV"));
    }
    let small = cloud.visible_from_camera(&good, &Options::radius(0.5));
    let (radius, farthest) = (0.5, 1.0);
    assert_eq!(small.unwrap_err(), Error::Radius { radius, farthest });
}

#[test]
fn a_pose_is_the_same_both_ways_and_the_wrong_way_is_said() {
    let mut rng = Rng::new(4);
    let away = [10.0, 20.0, 30.0];
    let points = shapes::bumpy(&mut rng, 3000).into_iter();
    let points: Vec<[f64; 3]> = points
        .map(|p| core::array::from_fn(|i| p[i] + away[i]))
        .collect();
    let cloud = PointCloud::new(&points).unwrap();
    let right = camera(
        &mut rng,
        [10.3, 20.4, 34.0],
        [-0.3, -0.4, -4.0],
        Convention::OpenCv,
    );
    let Pose::CameraToWorld(m) = right.pose else {
        unreachable!()
    };
    let place = |c: usize| -(m[c] * m[12] + m[c + 1] * m[13] + m[c + 2] * m[14]);
    let inverse = [
        [m[0], m[4], m[8], 0.0],
        [m[1], m[5], m[9], 0.0],
        [m[2], m[6], m[10], 0.0],
        [place(0), place(4), place(8), 1.0],
    ];
    let inverse = inverse.as_flattened().try_into().unwrap();
    let ask = |pose| {
        let camera = Camera { pose, ..right };
        let options = Options::exponent(3.0);
        cloud.visible_from_camera(&camera, &options).unwrap()
    };
    let seen = ask(right.pose);
    let same = ask(Pose::WorldToCamera(inverse));
    assert_eq!(seen.visibility.indices(), same.visibility.indices());
    assert!(seen.visibility.count() > 300, "{}", seen.visibility.count());
    assert!(!seen.seems_inverted && !same.seems_inverted);
    let wrong = ask(Pose::CameraToWorld(inverse));
    assert_eq!(wrong.visibility.count(), 0);
    assert!(wrong.seems_inverted);
}

#[test]
fn a_rounded_pose_becomes_the_nearest_rotation() {
    let mut rng = Rng::new(8);
    let points = shapes::bumpy(&mut rng, 2000);
    let cloud = PointCloud::new(&points).unwrap();
    for convention in [Convention::OpenCv, Convention::OpenGl] {
        let right = camera(&mut rng, [0.3, 0.4, 40.0], [-0.3, -0.4, -40.0], convention);
        let Pose::CameraToWorld(exact) = right.pose else {
            unreachable!()
        };
        // Scaled and sheared, as far as is accepted.
        let mut rounded = exact;
        for (i, x) in rounded[..12].iter_mut().enumerate() {
            if i % 4 < 3 {
                *x += rng.between(-1.5e-6, 1.5e-6);
            }
        }
        let world_to_camera = |m: [f64; 16]| {
            let place =
                |c: usize| -(m[c] * exact[12] + m[c + 1] * exact[13] + m[c + 2] * exact[14]);
            let [x, y, z] = [place(0), place(4), place(8)];
            Pose::WorldToCamera([
                m[0], m[4], m[8], 0.0, m[1], m[5], m[9], 0.0, m[2], m[6], m[10], 0.0, x, y, z, 1.0,
            ])
        };
        let options = Options::exponent(3.0);
        let ask = |pose| {
            let camera = Camera { pose, ..right };
            let position = camera.position();
            (
                cloud.visible_from_camera(&camera, &options).unwrap(),
                position,
            )
        };
        let (own, _) = ask(right.pose);
        assert!(own.pixels.len() > 300, "{}", own.pixels.len());
        // The rotation is off by as much as its numbers; the place, by as much at the distance of 40.
        for (pose, off) in [
            (Pose::CameraToWorld(rounded), 0.0),
            (world_to_camera(rounded), 3e-4),
        ] {
            let (seen, position) = ask(pose);
            for axis in 0..3 {
                assert!(
                    (position[axis] - exact[12 + axis]).abs() <= off,
                    "{position:?}"
                );
            }
            // Depths hardly change with the direction. They would with the length of an axis.
            let near = |a: &f32, b: &f32| (a - b).abs() < 0.002 + off as f32;
            let both = own.visibility.indices().iter().zip(&own.depths);
            for (index, depth) in both {
                if let Ok(at) = seen.visibility.indices().binary_search(index) {
                    assert!(near(depth, &seen.depths[at]));
                }
            }
        }
        // A pose that only is too long is the exact one.
        let long = core::array::from_fn(|i| exact[i] * if i < 12 { 1.000003 } else { 1.0 });
        let (seen, _) = ask(Pose::CameraToWorld(long));
        for (a, b) in own
            .pixels
            .iter()
            .flatten()
            .zip(seen.pixels.iter().flatten())
        {
            assert!((a - b).abs() < 1e-3, "{a} {b}");
        }
        let (_, position) = ask(world_to_camera(long));
        for axis in 0..3 {
            // The translation is that of the longer axes.
            let off = position[axis] / exact[12 + axis] - 1.0;
            assert!((off - 3e-6).abs() < 1e-9, "{off}");
        }
    }
}

#[test]
fn the_cone_of_a_camera_holds_its_image() {
    let mut rng = Rng::new(8);
    let points: Vec<[f64; 3]> = (0..4000).map(|_| rng.direction()).collect();
    let cloud = PointCloud::new(&points).unwrap();
    for (model, distortion) in LENSES {
        for convention in [Convention::OpenCv, Convention::OpenGl] {
            // Of other lenses, the cone is a guess.
            if distortion != [0.0; 8] && !model.name().contains("FISHEYE") {
                continue;
            }
            let ahead = rng.direction();
            let camera = Camera {
                model,
                distortion,
                ..camera(&mut rng, [0.0; 3], ahead, convention)
            };
            let (axis, angle) = camera.cone().unwrap();
            let least = (0.5 * angle).to_radians().cos();
            let seen = cloud.visible_from_camera(&camera, &Options::default());
            for &index in seen.unwrap().visibility.indices() {
                let p = points[index as usize];
                let cosine: f64 = (0..3).map(|i| axis[i] * p[i]).sum();
                assert!(cosine >= least, "{model:?}, {distortion:?}: {p:?}");
            }
        }
    }
}

#[test]
fn the_narrowest_image_has_a_cone() {
    let (axis, angle) = Camera::new(1e170, 1e170, 5.0, 5.0, 10.0, 10.0)
        .cone()
        .unwrap();
    assert_eq!(axis, [0.0, 0.0, 1.0]);
    let choices = MapOptions {
        towards: Some((axis, angle)),
        ..MapOptions::default()
    };
    let cloud = PointCloud::new(&[[0.0, 0.0, 1.0]]).unwrap();
    assert!(
        cloud
            .visibility_map([0.0; 3], &Options::default(), &choices)
            .is_ok()
    );
}

#[test]
fn a_point_beside_the_camera_is_outside_of_every_image() {
    // The square of its radius in the image overflows.
    let cloud = PointCloud::new(&[[0.0, 1e100, 1e-100]]).unwrap();
    for (model, distortion) in LENSES {
        let camera = Camera {
            model,
            distortion,
            ..Camera::new(10.0, 10.0, 5.0, 5.0, 10.0, 10.0)
        };
        let seen = cloud
            .visible_from_camera(&camera, &Options::default())
            .unwrap();
        assert_eq!(seen.visibility.count(), 0, "{model:?}");
    }
}
