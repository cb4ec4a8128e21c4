//! The other inversions: powers and exponentials, by the same definition.

use hidden_point_removal::{Exponential, Inversion, Options, Radius};

use crate::common::flip::farthest;
use crate::common::rng::Rng;
use crate::common::{ask, shapes};
use crate::test;

const FRONT: [f64; 3] = [0.0, 0.0, 3.0];

fn power(gamma: f64) -> Options {
    Options::inversion(Inversion::Power(gamma))
}

fn exponential(scale: f64) -> Options {
    Options::inversion(Inversion::Exponential(Exponential::Scale(scale)))
}

const AUTOMATIC: Inversion = Inversion::Exponential(Exponential::Auto);

#[test]
fn answers_say_which_inversion_they_used() {
    let points = shapes::bumpy(&mut Rng::new(1), 300);
    let far = farthest(&points, FRONT);
    let answer = ask(&points, FRONT, &power(2.5));
    assert_eq!(answer.inversion(), Inversion::Power(2.5));
    assert_eq!(
        (answer.radius(), answer.exponent(), answer.evaluations()),
        (far, 0.0, 0)
    );
    let unit = power(2.5).with_radius(Radius::Absolute(4.0 * far));
    let scaled = ask(&points, FRONT, &unit);
    assert_eq!(scaled.radius(), 4.0 * far);
    assert_eq!(scaled.indices(), answer.indices());

    let answer = ask(&points, FRONT, &exponential(0.5));
    assert_eq!(answer.inversion(), exponential(0.5).inversion);
    assert_eq!((answer.radius(), answer.exponent()), (0.0, 0.0));
    let plain = ask(&points, FRONT, &Options::default());
    assert_eq!(plain.inversion(), Inversion::Spherical);
}

#[test]
fn the_automatic_scale_belongs_to_the_cloud() {
    let points = shapes::bumpy(&mut Rng::new(4), 700);
    let options = Options::inversion(AUTOMATIC);
    let near = ask(&points, FRONT, &options);
    let far = ask(&points, [90.0, 20.0, 7.0], &options);
    assert_eq!(near.inversion(), far.inversion());
    // In a cloud without a spacing every point is visible.
    for few in [&[][..], &[FRONT], &[[0.0; 3]], &[[0.0; 3], [0.0; 3]]] {
        let answer = ask(few, FRONT, &options);
        assert_eq!(answer.count(), few.len());
        let Inversion::Exponential(Exponential::Scale(scale)) = answer.inversion() else {
            panic!("an unresolved inversion");
        };
        assert!(scale > 0.0 && scale.is_finite());
    }
}
