//! A camera's answer: the view from its place, cut to its image.

use hidden_point_removal::{Camera, Convention};

use super::{options, same};
use crate::common::cameras::{LENSES, along_axes, camera, in_camera, shown};
use crate::common::cloud_of;
use crate::common::flip::distance;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;

pub fn check(scene: &Scene, rng: &mut Rng) -> Result<(), String> {
    let cloud = cloud_of(&scene.points, rng.chance(2));
    let options = options(scene, rng);
    for _ in 0..4 {
        let camera = any_camera(scene, rng);
        let whole = cloud.visible_from(scene.viewpoint, &options);
        let seen = cloud.visible_from_camera(&camera, &options);
        let (whole, seen) = match (whole, seen) {
            (Ok(whole), Ok(seen)) => (whole, seen),
            (whole, seen) => {
                same("refusal", seen.err(), whole.err())?;
                continue;
            }
        };
        let title = |what: &str| format!("{what} of {camera:?} with {options:?}");
        let view = &seen.visibility;
        same(&title("radius"), view.radius(), whole.radius())?;
        same(&title("looks"), view.looks(), whole.looks())?;
        same(&title("pixels"), seen.pixels.len(), view.count())?;
        same(&title("depths"), seen.depths.len(), view.count())?;
        let mut found = view
            .indices()
            .iter()
            .zip(&seen.pixels)
            .zip(&seen.depths)
            .peekable();
        let mut towards = seen.towards.iter();
        for &index in whole.indices() {
            let at = shown(&camera, scene.points[index as usize]);
            let Some((([u, v], depth), is_shown)) = found
                .next_if(|((i, _), _)| **i == index)
                .map(|((_, pixel), depth)| ((*pixel, *depth), true))
                .or((!at.inside).then_some((([0.0; 2], 0.0), false)))
            else {
                if at.in_doubt {
                    continue;
                }
                return Err(title(&format!("point {index} is missing, {at:?}:")));
            };
            if !is_shown {
                continue;
            }
            if !at.inside && !at.in_doubt {
                return Err(title(&format!("point {index} is shown, {at:?}:")));
            }
            let is_inside = (0.0..camera.width).contains(&f64::from(u))
                && (0.0..camera.height).contains(&f64::from(v));
            let off = (f64::from(u) - at.pixel[0]).abs() / camera.width
                + (f64::from(v) - at.pixel[1]).abs() / camera.height;
            if !is_inside || off.is_nan() || off > 1e-6 {
                return Err(title(&format!("pixel {u}, {v} of point {index}, {at:?}:")));
            }
            let nearest = (at.depth as f32).max(f32::MIN_POSITIVE);
            same(&title("depth"), depth, nearest)?;
            let away = distance(camera.position(), scene.points[index as usize]);
            let towards = towards.next().ok_or_else(|| title("a direction too few"))?;
            let off = (0..3).map(|axis| {
                let expected = camera.position()[axis] - scene.points[index as usize][axis];
                (f64::from(towards[axis]) - expected / away).abs()
            });
            if away > 0.0 && off.fold(0.0, f64::max) > 1e-7 {
                return Err(title(&format!("direction {towards:?} of point {index}")));
            }
        }
        if let Some(((index, _), _)) = found.next() {
            return Err(title(&format!("point {index} is shown, but not visible:")));
        }
    }
    Ok(())
}

/// A camera at the viewpoint. Its axes, the borders of its image and its depths go through points often.
fn any_camera(scene: &Scene, rng: &mut Rng) -> Camera {
    let from = scene.viewpoint;
    let convention = rng.pick(&[Convention::OpenCv, Convention::OpenGl]);
    let point = |rng: &mut Rng| match scene.points.len() {
        0 => rng.direction(),
        _ => rng.pick(&scene.points),
    };
    let target = point(rng);
    let ahead: [f64; 3] = core::array::from_fn(|i| target[i] - from[i]);
    let length = ahead.iter().map(|x| x * x).sum::<f64>();
    let mut camera = if rng.chance(2) || !(1e-200..1e200).contains(&length) {
        along_axes(rng, from, convention)
    } else {
        camera(rng, from, ahead, convention)
    };
    let [width, height] = rng.pick(&[[640.0, 480.0], [64.0, 64.0], [1.0, 1.0], [3.5, 4000.0]]);
    (camera.width, camera.height) = (width, height);
    (camera.cx, camera.cy) = match rng.below(3) {
        0 => (0.5 * width, 0.5 * height),
        1 => (0.0, height),
        _ => (
            rng.between(-1.0, 2.0) * width,
            rng.between(-1.0, 2.0) * height,
        ),
    };
    (camera.fx, camera.fy) = match rng.below(3) {
        0 => (width, width),
        1 => (0.5 * width, 0.25 * height),
        _ => (
            width * rng.between(0.05, 30.0),
            height * rng.between(0.05, 30.0),
        ),
    };
    if rng.chance(4) {
        (camera.model, camera.distortion) = rng.pick(&LENSES);
    }
    if rng.chance(3) {
        let [near, far] = [0; 2].map(|_| in_camera(&camera, point(rng))[2].abs());
        (camera.near, camera.far) = (near.min(far), near.max(far));
        // In single precision, a cloud holds the same points. Other roundings would be another depth.
        if !camera.far.is_finite() {
            (camera.near, camera.far) = (0.0, f64::INFINITY);
        }
    }
    camera
}
