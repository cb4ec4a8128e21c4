//! One answer for several viewpoints.

use hidden_point_removal::{
    Exponential, Inversion, Options, PointCloud, Radius, ring_of_viewpoints,
};

use crate::common::flip::distance;
use crate::common::rng::Rng;
use crate::common::{NOWHERE, refused, shapes};
use crate::test;

const FRONT: [f64; 3] = [0.0, 0.0, 3.0];

#[test]
fn no_viewpoint_sees_nothing() {
    let cloud = PointCloud::new(&shapes::bumpy(&mut Rng::new(1), 50)).unwrap();
    let options = Options::inversion(Inversion::Exponential(Exponential::Scale(0.5)));
    let answer = cloud.visible_from_any(&NOWHERE, &options).unwrap();
    assert_eq!(
        (answer.count(), answer.radius(), answer.exponent()),
        (0, 0.0, 0.0)
    );
    assert_eq!(answer.inversion(), options.inversion);
    assert_eq!(answer.mask(), [0; 50]);
}

#[test]
fn every_choice_of_a_radius_is_counted() {
    let cloud = PointCloud::new(&shapes::bumpy(&mut Rng::new(1), 200)).unwrap();
    let options = Options::default().with_radius(Radius::Opposite);
    let viewpoints = [FRONT, [0.0, 9.0, 0.0], [1.0, -1.0, 4.0]];
    let answer = cloud.visible_from_any(&viewpoints, &options).unwrap();
    let singly = viewpoints.map(|at| cloud.auto_radius(at, Radius::Opposite).unwrap().evaluations);
    assert_eq!(answer.evaluations(), singly.iter().sum::<u32>());
}

#[test]
fn what_does_not_fit_is_refused() {
    let cloud = PointCloud::new(&shapes::bumpy(&mut Rng::new(1), 50)).unwrap();
    let options = Options::default();
    for (k, views) in [(0, 2), (3, 2), (1, 0)] {
        let found = cloud.visible_from_at_least(k, &[FRONT; 2][..views], &options);
        refused("option", "k must be from", found);
    }
}

#[test]
fn rings_are_even_and_across_the_view() {
    let mut rng = Rng::new(2);
    for count in [1, 2, 3, 4, 9] {
        let viewpoint = rng.direction().map(|x| x * 10.0);
        let target = rng.direction();
        let ring = ring_of_viewpoints(viewpoint, target, count, 0.05).unwrap();
        assert_eq!(ring.len(), count);
        let reach = distance(viewpoint, target);
        let ahead: [f64; 3] = core::array::from_fn(|i| target[i] - viewpoint[i]);
        for (k, &place) in ring.iter().enumerate() {
            assert!((distance(place, viewpoint) - 0.05 * reach).abs() < 1e-12);
            let across: f64 = (0..3).map(|i| (place[i] - viewpoint[i]) * ahead[i]).sum();
            assert!(across.abs() < 1e-12 * reach * reach);
            let side = 0.1 * reach * (core::f64::consts::PI / count as f64).sin();
            let next = ring[(k + 1) % count];
            assert!((distance(place, next) - side.abs()).abs() < 1e-12 * reach);
        }
    }
    // Rings of any size.
    for size in [1e-160, 1e150, 1e300] {
        let ring = ring_of_viewpoints([0.0; 3], [size, size, 0.0], 4, 0.05).unwrap();
        let radius = distance(ring[0].map(|x| x / size), [0.0; 3]);
        assert!((radius - 0.05 * 2f64.sqrt()).abs() < 1e-12);
    }
}

#[test]
fn rings_have_their_limits() {
    assert_eq!(
        ring_of_viewpoints(FRONT, FRONT, 3, 0.05).unwrap(),
        [FRONT; 3]
    );
    assert_eq!(
        ring_of_viewpoints(FRONT, [0.0; 3], 0, 0.05).unwrap(),
        [[0.0; 3]; 0]
    );
    assert_eq!(
        ring_of_viewpoints(FRONT, [0.0; 3], 2, 0.0).unwrap(),
        [FRONT; 2]
    );
    for fraction in [-0.1, f64::NAN, f64::INFINITY] {
        let ring = ring_of_viewpoints(FRONT, [0.0; 3], 4, fraction);
        refused("option", "fraction must be from", ring);
    }
    let far = [f64::MAX; 3];
    for (viewpoint, target) in [
        ([f64::NAN; 3], FRONT),
        (FRONT, [f64::INFINITY; 3]),
        (far, far.map(|x| -x)),
    ] {
        let ring = ring_of_viewpoints(viewpoint, target, 4, 0.05);
        refused("viewpoint", "", ring);
    }
    let endless = ring_of_viewpoints(FRONT, [0.0; 3], usize::MAX, 0.05);
    refused("too-large", "", endless);
}
