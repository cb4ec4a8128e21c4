//! The radius as a number and as an exponent.

use hidden_point_removal::{Options, PointCloud};

use crate::common::ask;
use crate::common::flip::farthest;
use crate::common::rng::Rng;
use crate::common::shapes;
use crate::test;

const VIEWPOINT: [f64; 3] = [0.25, -0.5, 3.0];

fn cloud() -> Vec<[f64; 3]> {
    shapes::bumpy(&mut Rng::new(5), 900)
}

#[test]
fn an_exponent_is_the_farthest_distance_times_a_power_of_ten() {
    let points = cloud();
    let farthest = farthest(&points, VIEWPOINT);
    for (exponent, times) in [
        (0.0, 1.0),
        (1.0, 10.0),
        (2.0, 100.0),
        (3.0, 1e3),
        (4.0, 1e4),
    ] {
        let answer = ask(&points, VIEWPOINT, &Options::exponent(exponent));
        assert_eq!(answer.radius(), farthest * times);
        assert_eq!(answer.exponent(), exponent);
        assert_eq!(answer.evaluations(), 0);
        let same = ask(&points, VIEWPOINT, &Options::radius(farthest * times));
        assert_eq!(same.indices(), answer.indices());
        assert!((same.exponent() - exponent).abs() < 1e-12);
    }
    let half = ask(&points, VIEWPOINT, &Options::exponent(0.5));
    assert!((half.radius() / farthest - 10f64.sqrt()).abs() < 1e-14);
}

#[test]
fn the_farthest_distance_itself_is_a_radius() {
    let points = cloud();
    let farthest = farthest(&points, VIEWPOINT);
    let exact = ask(&points, VIEWPOINT, &Options::radius(farthest));
    assert_eq!((exact.radius(), exact.exponent()), (farthest, 0.0));
    let zero = ask(&points, VIEWPOINT, &Options::exponent(0.0));
    assert_eq!(exact.indices(), zero.indices());
    let below = f64::from_bits(farthest.to_bits() - 1);
    let refused = PointCloud::new(&points)
        .unwrap()
        .visible_from(VIEWPOINT, &Options::radius(below));
    assert_eq!(refused.unwrap_err().code(), "radius");
}

#[test]
fn a_radius_is_taken_as_given_where_every_point_is_at_the_viewpoint() {
    let answer = ask(&[VIEWPOINT], VIEWPOINT, &Options::radius(7.0));
    assert_eq!(
        (answer.count(), answer.radius(), answer.exponent()),
        (1, 7.0, 0.0)
    );
    let answer = ask::<[f32; 3]>(&[], VIEWPOINT, &Options::exponent(2.0));
    assert_eq!((answer.count(), answer.radius()), (0, 0.0));
}
