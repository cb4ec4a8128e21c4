//! Horizons: what a part of a cloud hides from other points and from boxes.

use hidden_point_removal::{Exponential, Horizon, Inversion, Options, PointCloud};

use crate::checks::boxes;
use crate::common::flip::farthest;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;
use crate::common::structured;
use crate::common::{refused, shapes};
use crate::test;

/// Options with numbers only, for points up to the distance of the farthest point.
fn numbered(rng: &mut Rng, scene: &Scene) -> Option<Options> {
    let farthest = farthest(&scene.points, scene.viewpoint);
    if farthest == 0.0 || farthest > 1e150 {
        return None;
    }
    Some(match rng.below(6) {
        0 => Options::radius(farthest),
        1 => Options::radius(2.0 * farthest),
        2 => Options::radius(1000.0 * farthest),
        3 => Options::radius(farthest).with_inversion(Inversion::Power(2.0)),
        4 => Options::inversion(Inversion::Exponential(Exponential::Scale(0.3 * farthest))),
        _ => Options::inversion(Inversion::Exponential(Exponential::Scale(1e-3 * farthest))),
    })
}

/// Whether the last point of `points` is visible among them.
fn sees_last(points: &[[f64; 3]], viewpoint: [f64; 3], options: &Options) -> bool {
    let cloud = PointCloud::new(points).unwrap();
    let visible = cloud.visible_from(viewpoint, options).unwrap();
    visible.indices().last() == Some(&(points.len() as u32 - 1))
}

#[test]
fn screens_exactly_as_if_each_point_was_added() {
    for seed in 0..40 {
        for &kind in structured::SHAPES {
            let mut rng = Rng::new(seed);
            let scene = structured::scene(&mut rng, kind, 24);
            let Some(options) = numbered(&mut rng, &scene) else {
                continue;
            };
            let (points, viewpoint) = (&scene.points, scene.viewpoint);
            let taken = rng.below(points.len() + 1);
            let (own, others) = points.split_at(taken);
            let mut horizon = Horizon::new(viewpoint, &options).unwrap();
            let cut = rng.below(own.len() + 1);
            horizon.add(&own[..cut]).unwrap();
            horizon.add(&own[cut..]).unwrap();
            let screened = horizon.screen(others).unwrap();
            // The visible points alone hide as much.
            let mut sent = Horizon::new(viewpoint, &options).unwrap();
            sent.add(&horizon.visible().unwrap()).unwrap();
            assert_eq!(sent.screen(others).unwrap(), screened);
            for (index, &point) in (0..).zip(others) {
                let mut all = own.to_vec();
                all.push(point);
                assert_eq!(
                    screened.contains(&index),
                    sees_last(&all, viewpoint, &options),
                    "{} with seed {seed}, {point:?} after {own:?} from {viewpoint:?}, {options:?}",
                    kind.0
                );
            }
        }
    }
}

#[test]
fn nine_in_ten_hidden_boxes_are_proved() {
    let mut rng = Rng::new(6);
    let [mut hidden, mut proved] = [0; 2];
    for _ in 0..60 {
        let (kind, scene) = boxes::subject(&mut rng);
        let shares =
            boxes::tally(&scene, &mut rng).unwrap_or_else(|wrong| panic!("{kind}, {wrong}"));
        (hidden, proved) = (hidden + shares[0], proved + shares[1]);
    }
    assert!(hidden > 500, "{hidden} boxes are hidden");
    assert!(10 * proved > 9 * hidden, "{proved} of {hidden} are proved");
}

#[test]
fn boxes_beside_the_viewpoint_are_never_hidden() {
    let mut rng = Rng::new(5);
    let points = shapes::sphere(&mut rng, 2000);
    let viewpoint = [0.1, 0.0, 0.0];
    let mut horizon = Horizon::new(viewpoint, &Options::radius(100.0)).unwrap();
    assert!(
        !horizon.hides_box([5.0; 3], [6.0; 3]).unwrap(),
        "nothing hides"
    );
    horizon.add(&points).unwrap();
    assert!(horizon.hides_box([5.0; 3], [6.0; 3]).unwrap());
    assert!(
        !horizon.hides_box([-9.0; 3], [9.0; 3]).unwrap(),
        "it holds the viewpoint"
    );
    assert!(!horizon.hides_box([0.1; 3], [0.1; 3]).unwrap());
    assert!(!horizon.hides_box(viewpoint, viewpoint).unwrap());
    assert!(
        !horizon.hides_box(viewpoint, [9.0; 3]).unwrap(),
        "the viewpoint is a corner"
    );
    assert!(
        !horizon.hides_box([5.0; 3], [99.0; 3]).unwrap(),
        "a corner is beyond the radius"
    );
}

#[test]
fn refusals_name_the_cause_and_change_nothing() {
    let options = Options::radius(3.0);
    let new = |viewpoint, options: &Options| Horizon::new(viewpoint, options).map(|_| ());
    let merging = "merging needs the radius";
    refused("option", merging, new([0.0; 3], &Options::default()));
    refused("viewpoint", "", new([f64::NAN; 3], &options));
    let mut horizon = Horizon::new([0.0; 3], &options).unwrap();
    horizon
        .add(&[[1.0, 0.2, 0.2], [0.2, 1.0, 0.2], [0.2, 0.2, 1.0]])
        .unwrap();
    let hidden = [[1.5, 1.5, 1.5]];
    assert_eq!(horizon.screen(&hidden), Ok(vec![]));
    let far = [[0.0, 0.0, 4.0]];
    let too_small = "radius 3 is smaller than the distance of the farthest point, 4";
    refused("radius", too_small, horizon.add(&far));
    refused("radius", too_small, horizon.screen(&far));
    let bad = [[0.0; 3], [f64::INFINITY; 3]];
    refused("non-finite", "index 1", horizon.add(&bad));
    refused("non-finite", "index 1", horizon.screen(&bad));
    for low in [1.0, f64::NAN] {
        let found = horizon.hides_box([low; 3], [0.0; 3]);
        refused("option", "a box must be", found);
    }
    assert_eq!(horizon.screen(&hidden), Ok(vec![]));
    assert_eq!(horizon.visible().unwrap().len(), 3);
}
