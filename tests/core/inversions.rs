//! The other inversions: powers and exponentials, by the same definition.

use hidden_point_removal::{
    Error, Exponential, Inversion, Options, PointCloud, Radius, merge_visible,
};

use crate::common::flip::{farthest, flip_as};
use crate::common::rng::Rng;
use crate::common::scenes::{EXTREME, KINDS, Scene};
use crate::common::{ask, indices_of, oracle, proved_flipped, shapes};

const FRONT: [f64; 3] = [0.0, 0.0, 3.0];

fn power(gamma: f64) -> Options {
    Options::with_inversion(Inversion::Power(gamma))
}

fn exponential(scale: f64) -> Options {
    Options::with_inversion(Inversion::Exponential(Exponential::Scale(scale)))
}

const AUTOMATIC: Inversion = Inversion::Exponential(Exponential::Auto);

/// Every kind of inversion, mild and strong.
fn choices(farthest: f64) -> Vec<Options> {
    let mut choices: Vec<_> = [1.0000001, 1.2, 2.0, 3.5, 16.0].map(power).to_vec();
    choices.push(power(2.0).radius(Radius::Absolute(farthest.max(1e-300) * 3.0)));
    choices
        .extend([1e-9, 1e-3, 0.1, 3.0, 1e4].map(|times| exponential(times * farthest.max(1e-300))));
    choices.push(Options::with_inversion(AUTOMATIC));
    choices
}

fn flipped(scene: &Scene, options: &Options) -> (Vec<u32>, Vec<Option<[f64; 3]>>) {
    let answer = ask(&scene.points, scene.viewpoint, options);
    let flip = |&p: &[f64; 3]| flip_as(p, scene.viewpoint, &answer);
    let flipped = scene.points.iter().map(flip).collect();
    (answer.into_indices(), flipped)
}

#[test]
fn small_scenes_are_answered_by_the_definition() {
    for kind in KINDS.iter().chain(EXTREME) {
        for seed in 0..30 {
            let scene = kind.scene(seed, (seed % 11) as usize);
            for options in choices(farthest(&scene.points, scene.viewpoint)) {
                let (answer, flipped) = flipped(&scene, &options);
                let expected = indices_of(&oracle::visible_flipped(&flipped));
                let title = kind.name;
                assert_eq!(answer, expected, "{title} with seed {seed}, {options:?}");
            }
        }
    }
}

#[test]
fn larger_scenes_are_certified() {
    for kind in KINDS {
        let scene = kind.scene(2000, 80);
        for options in choices(farthest(&scene.points, scene.viewpoint)) {
            let (answer, flipped) = flipped(&scene, &options);
            let sizes = flipped.iter().flatten().flatten().map(|x| x.abs());
            let sizes: Vec<f64> = sizes.filter(|&x| x > 0.0).collect();
            let range = sizes.iter().copied().fold(0.0, f64::max)
                / sizes.iter().copied().fold(f64::MAX, f64::min);
            // Beyond this, the arithmetic of the certificates would not be exact.
            if range < 1e40 {
                let expected = indices_of(&proved_flipped(&flipped));
                assert_eq!(answer, expected, "{}, {options:?}", kind.name);
            }
        }
    }
}

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
    let unit = power(2.5).radius(Radius::Absolute(4.0 * far));
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
    let mut rng = Rng::new(4);
    let mut points = shapes::bumpy(&mut rng, 700);
    let options = Options::with_inversion(AUTOMATIC);
    let near = ask(&points, FRONT, &options);
    let far = ask(&points, [90.0, 20.0, 7.0], &options);
    assert_eq!(near.inversion(), far.inversion());
    // Neither the order of the input nor duplicates change a bit.
    let copies: Vec<_> = points[..200].to_vec();
    points.extend(copies);
    rng.shuffle(&mut points);
    assert_eq!(ask(&points, FRONT, &options).inversion(), near.inversion());
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

#[test]
fn stronger_inversions_see_less() {
    let points = shapes::bumpy(&mut Rng::new(8), 2000);
    let count = |options: &Options| ask(&points, FRONT, options).count();
    let powers = [1.001, 1.1, 1.5, 2.0, 3.0].map(|gamma| count(&power(gamma)));
    assert!(powers.is_sorted_by(|a, b| a > b), "{powers:?}");
    let scales = [1e-6, 1e-4, 1e-2, 0.1, 1.0].map(|scale| count(&exponential(scale)));
    assert!(scales.is_sorted_by(|a, b| a > b), "{scales:?}");
}

#[test]
fn points_on_a_plane_are_all_visible_whatever_the_inversion() {
    let mut points = Vec::new();
    for i in 0..900 {
        points.push([f64::from(i % 30) - 14.5, f64::from(i / 30) - 14.5, 0.0]);
    }
    for options in [power(1.1), power(4.0), exponential(0.01), exponential(2.0)] {
        assert_eq!(ask(&points, FRONT, &options).count(), 900, "{options:?}");
    }
}

#[test]
fn parts_flipped_alike_merge_exactly() {
    let mut rng = Rng::new(12);
    let points = shapes::bumpy(&mut rng, 900);
    let unit = Radius::Absolute(9.0);
    for options in [power(1.7).radius(unit), exponential(0.02)] {
        let whole = ask(&points, FRONT, &options);
        let ids: Vec<u32> = (0..900).collect();
        let parts: Vec<_> = points.chunks(300).zip(ids.chunks(300)).collect();
        assert_eq!(
            merge_visible(&parts, FRONT, &options).unwrap(),
            whole.indices()
        );
    }
    let parts = [(&points[..], &[0; 900][..])];
    for options in [power(1.7), Options::with_inversion(AUTOMATIC)] {
        let error = merge_visible(&parts, FRONT, &options).unwrap_err();
        assert_eq!(error, Error::MergeRadius);
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let cloud = PointCloud::new(&shapes::bumpy(&mut Rng::new(3), 20)).unwrap();
    let refused = |options: Options, name: &str| {
        let error = cloud.visible_from(FRONT, &options).unwrap_err();
        assert_eq!(error.code(), "option", "{options:?}");
        assert!(error.to_string().contains(name), "{error}");
    };
    for gamma in [1.0, 0.0, -2.0, 16.5, f64::NAN, f64::INFINITY] {
        refused(power(gamma), "power");
    }
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(exponential(scale), "exponential");
    }
    for inversion in [Inversion::Power(2.0), AUTOMATIC] {
        let with = |radius| Options::with_inversion(inversion).radius(radius);
        refused(with(Radius::Exponent(2.0)), "exponent");
        refused(with(Radius::Search), "search");
        refused(with(Radius::Opposite), "opposite");
    }
    let radius = Radius::Absolute(100.0);
    refused(Options::with_inversion(AUTOMATIC).radius(radius), "radius");
    let too_small = power(2.0).radius(Radius::Absolute(0.5));
    assert_eq!(
        cloud.visible_from(FRONT, &too_small).unwrap_err().code(),
        "radius"
    );
}
