//! Shadows: the lights that see each point, smoothed over its neighbors.

use std::collections::BTreeSet;

use hidden_point_removal::{Lighting, NonFinite, Options, PointCloud};

use crate::common::flip::distance;
use crate::common::rng::Rng;
use crate::common::{ask, refused, shapes};
use crate::test;

const LIGHTS: [[f64; 3]; 3] = [[0.0, 0.0, 4.0], [3.0, -2.0, 1.0], [0.0, -5.0, 0.5]];

fn lit(points: &[[f64; 3]], lights: &[[f64; 3]], lighting: &Lighting) -> Vec<f32> {
    let cloud = PointCloud::new(points).unwrap();
    cloud
        .illuminate(lights, &Options::default(), lighting)
        .unwrap()
}

fn hard(ambient: f64) -> Lighting<'static> {
    Lighting {
        smoothing: 0,
        ambient,
        ..Lighting::default()
    }
}

/// The expected brightness without smoothing.
fn expected(points: &[[f64; 3]], ambient: f64) -> Vec<f64> {
    let masks = LIGHTS.map(|light| ask(points, light, &Options::default()).mask());
    let share = |i: usize| masks.iter().map(|mask| f64::from(mask[i])).sum::<f64>() / 3.0;
    (0..points.len())
        .map(|i| ambient + (1.0 - ambient) * share(i))
        .collect()
}

fn close(a: &[f32], b: &[f64]) -> bool {
    a.len() == b.len()
        && a.iter()
            .zip(b)
            .all(|(a, b)| (f64::from(*a) - b).abs() < 1e-6)
}

#[test]
fn brightness_is_the_share_of_lights_that_see_a_point() {
    let points = shapes::bumpy(&mut Rng::new(51), 1200);
    for ambient in [0.0, 0.3, 1.0] {
        assert!(close(
            &lit(&points, &LIGHTS, &hard(ambient)),
            &expected(&points, ambient)
        ));
        assert_eq!(
            lit(&points, &[], &hard(ambient)),
            vec![ambient as f32; 1200]
        );
    }
    let one = lit(&points, &LIGHTS[..1], &hard(0.0));
    let mask = ask(&points, LIGHTS[0], &Options::default()).mask();
    assert!(one.iter().zip(mask).all(|(a, b)| *a == f32::from(b)));
}

#[test]
fn without_a_mesh_light_is_averaged_with_the_six_nearest() {
    let mut points = shapes::bumpy(&mut Rng::new(52), 300);
    let distinct = points.clone();
    points.extend_from_slice(&distinct[..50]);
    let mut values = expected(&distinct, 0.1);
    for rounds in 0..4 {
        let lighting = Lighting {
            smoothing: rounds,
            ..hard(0.1)
        };
        let both = [&values[..], &values[..50]].concat();
        assert!(
            close(&lit(&points, &LIGHTS, &lighting), &both),
            "{rounds} rounds"
        );
        values = (0..300)
            .map(|i| {
                let mut near: Vec<usize> = (0..300).collect();
                near.sort_by(|&a, &b| {
                    let to = |j: usize| distance(distinct[i], distinct[j]);
                    to(a).total_cmp(&to(b))
                });
                near[..7].iter().map(|&j| values[j]).sum::<f64>() / 7.0
            })
            .collect();
    }
    // By default, one round of smoothing.
    let usual = lit(&points, &LIGHTS, &Lighting::default());
    let once = lit(
        &points,
        &LIGHTS,
        &Lighting {
            smoothing: 1,
            ..hard(0.0)
        },
    );
    assert_eq!(usual, once);
}

#[test]
fn with_a_mesh_light_is_averaged_along_its_edges() {
    let points = shapes::bumpy(&mut Rng::new(53), 400);
    let cloud = PointCloud::new(&points).unwrap();
    let mesh = cloud
        .reconstruct(LIGHTS[0], &Options::default(), None)
        .unwrap();
    let mut triangles = mesh.triangles;
    // A triangle given again with the other orientation, and a degenerate triangle, add no edge.
    let [a, b, c] = triangles[0];
    triangles.extend([[b, a, c], [a, a, b]]);
    let mut beside = vec![BTreeSet::new(); 400];
    for t in &triangles {
        for i in 0..3 {
            let (a, b) = (t[i] as usize, t[(i + 1) % 3] as usize);
            if a != b {
                beside[a].insert(b);
                beside[b].insert(a);
            }
        }
    }
    let mut values = expected(&points, 0.0);
    for rounds in 0..4 {
        let lighting = Lighting {
            triangles: Some(&triangles),
            smoothing: rounds,
            ambient: 0.0,
        };
        assert!(
            close(&lit(&points, &LIGHTS, &lighting), &values),
            "{rounds} rounds"
        );
        values = (0..400)
            .map(|i| {
                let sum: f64 = beside[i].iter().map(|&j| values[j]).sum();
                (values[i] + sum) / (beside[i].len() + 1) as f64
            })
            .collect();
    }
}

#[test]
fn skipped_and_removed_points_are_not_lit() {
    let points = [
        [0.0, 0.0, 1.0],
        [f64::NAN; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let mut cloud = PointCloud::with_non_finite(&points, NonFinite::Skip).unwrap();
    cloud.remove(&[2]).unwrap();
    for smoothing in [0, 2] {
        let lighting = Lighting {
            smoothing,
            ..hard(0.25)
        };
        let brightness = cloud
            .illuminate(&LIGHTS, &Options::default(), &lighting)
            .unwrap();
        assert_eq!(brightness, [1.0, 0.25, 0.25, 1.0]);
    }
    let empty = PointCloud::new::<[f64; 3]>(&[]).unwrap();
    let lighting = Lighting::default();
    assert_eq!(
        empty.illuminate(&LIGHTS, &Options::default(), &lighting),
        Ok(vec![])
    );
}

#[test]
fn what_does_not_fit_is_refused() {
    let cloud = PointCloud::new(&shapes::bumpy(&mut Rng::new(3), 20)).unwrap();
    let ask = |lights: &[[f64; 3]], lighting: &Lighting| {
        cloud.illuminate(lights, &Options::default(), lighting)
    };
    for ambient in [-0.1, 1.1, f64::NAN] {
        refused(
            "option",
            "ambient must be from 0 to 1",
            ask(&LIGHTS, &hard(ambient)),
        );
    }
    let (mut smooth, mut mesh) = (hard(0.0), hard(0.0));
    smooth.smoothing = 1001;
    refused("option", "smoothing must be from", ask(&LIGHTS, &smooth));
    mesh.triangles = Some(&[[0, 1, 2], [3, 20, 4]]);
    refused("option", "index 20 is out of range", ask(&LIGHTS, &mesh));
    refused("viewpoint", "", ask(&[[f64::NAN; 3]], &hard(0.0)));
}
