//! Points that are not in the cloud. The check `sees` compares answers.

use hidden_point_removal::{NonFinite, Options, PointCloud, Within};

use crate::common::refused;
use crate::test;

#[test]
fn questions_that_make_no_sense_are_refused() {
    let points = [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]];
    let cloud = PointCloud::new(&points).unwrap();
    let far = [0.0, 0.0, 5.0];
    let ask = |places: &[[f64; 3]], options: &Options| cloud.sees(far, places, options);
    let default = Options::default();
    assert_eq!(ask(&[], &default), Ok(vec![]));
    let nan = [0.0, f64::NAN, 0.0];
    refused("non-finite", "2 point(s)", ask(&[far, nan, nan], &default));
    refused("option", "", ask(&[], &Options::exponent(-1.0)));
    let beyond = [[0.0, 0.0, 14.1], [0.0, 0.0, 13.9], [f64::MAX, 0.0, 0.0]];
    let seen = ask(&beyond, &Options::radius(9.0));
    assert_eq!(seen, Ok(vec![false, true, false]));
    // A cloud that skips such points does so here, too.
    let skipping = PointCloud::with_non_finite(&[nan, far], NonFinite::Skip).unwrap();
    let seen = skipping.sees([0.0; 3], &[nan, [0.0, 0.0, 1.0], [0.0, 0.0, 9.0]], &default);
    assert_eq!(seen, Ok(vec![false, true, false]));
    // Nothing was added.
    assert_eq!(cloud.len(), 3);
}

#[test]
fn a_view_that_is_refused_is_refused_for_positions_outside_of_a_choice_too() {
    let viewpoint = [0.0, 0.0, 5.0];
    let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 1.0, 4.0]]).unwrap();
    let options = Options::radius(3.9).with_within(Within {
        distance: None,
        bounds: Some([[-1.0; 3], [2.0; 3]]),
    });
    let refusal = cloud.visible_from(viewpoint, &options).unwrap_err();
    assert_eq!(refusal.code(), "radius");
    let outside = [[0.0, 0.0, 90.0]];
    assert_eq!(cloud.sees(viewpoint, &outside, &options), Err(refusal));
}
