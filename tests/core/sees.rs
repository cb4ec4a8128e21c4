//! Points that are not in the cloud: the answer is, always, that of a cloud with the point added.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use hidden_point_removal::{
    Error, Exponential, Inversion, NonFinite, Options, PointCloud, Radius, Within,
};

use crate::common::rng::Rng;
use crate::common::scenes::{EXTREME, KINDS, Scene};
use crate::common::shapes;
use crate::common::structured;

/// The answer by definition: a cloud with the point more.
fn by_definition(
    points: &[[f64; 3]],
    place: [f64; 3],
    viewpoint: [f64; 3],
    options: &Options,
) -> Result<bool, Error> {
    let mut all = points.to_vec();
    all.push(place);
    let seen = PointCloud::new(&all)?.visible_from(viewpoint, options)?;
    Ok(seen.indices().last() == Some(&(points.len() as u32)))
}

/// Places that are hard to decide: points of the cloud, on their rays, between them, at the
/// viewpoint, beyond the cloud.
fn places(rng: &mut Rng, scene: &Scene, count: usize) -> Vec<[f64; 3]> {
    let (points, c) = (&scene.points, scene.viewpoint);
    let any = |rng: &mut Rng| {
        if points.is_empty() {
            rng.in_ball()
        } else {
            rng.pick(points)
        }
    };
    (0..count)
        .map(|_| {
            let [a, b] = [any(rng), any(rng)];
            let between = |t: f64, from: [f64; 3], to: [f64; 3]| {
                core::array::from_fn(|i| from[i] + (to[i] - from[i]) * t)
            };
            match rng.below(8) {
                0 => a,
                1 => c,
                2 => between(0.5, a, b),
                3 => between(rng.between(0.0, 1.0), a, b),
                4 => between(rng.between(0.5, 1.5), c, a),
                5 => between(2.0, c, a),
                6 => between(rng.between(-1.0, 3.0), a, b),
                _ => between(1.0 + 1e-9, c, a),
            }
        })
        .collect()
}

fn check(scene: &Scene, options: &Options, places: &[[f64; 3]], title: &str) {
    let cloud = PointCloud::new(&scene.points).unwrap();
    for &place in places {
        let found = cloud.sees(scene.viewpoint, &[place], options);
        let expected = by_definition(&scene.points, place, scene.viewpoint, options);
        // A cloud that cannot be viewed itself is refused before the point is looked at.
        if cloud.visible_from(scene.viewpoint, options).is_ok() || found.is_ok() {
            let found = found.map(|seen| seen[0]);
            assert_eq!(
                found,
                expected,
                "{title}: {place:?} from {:?} with {options:?} and {} points",
                scene.viewpoint,
                scene.points.len()
            );
        }
    }
    let answers = cloud.sees(scene.viewpoint, places, options);
    if let Ok(answers) = answers {
        for (&place, seen) in places.iter().zip(answers) {
            let alone = cloud.sees(scene.viewpoint, &[place], options);
            assert_eq!(alone, Ok(vec![seen]), "{title}: a row of places");
        }
    }
}

fn choices(scene: &Scene) -> [Options; 5] {
    [
        scene.options,
        Options::default(),
        Options::with_exponent(0.5),
        Options::with_inversion(Inversion::Exponential(Exponential::Auto)),
        Options::with_inversion(Inversion::Power(1.7)),
    ]
}

#[test]
fn scenes_of_every_kind_answer_as_with_the_point_added() {
    for (number, kind) in KINDS.iter().chain(EXTREME).enumerate() {
        for (seed, n) in [0, 1, 2, 3, 4, 7, 20, 60].into_iter().enumerate() {
            let seed = (10 * number + seed) as u64;
            let scene = kind.scene(seed, n);
            let mut rng = Rng::new(seed + 1000);
            for options in choices(&scene) {
                let places = places(&mut rng, &scene, 4);
                check(&scene, &options, &places, kind.name);
            }
        }
    }
}

#[test]
fn structured_clouds_answer_as_with_the_point_added() {
    for seed in 0..25 {
        for &kind in structured::SHAPES {
            let mut rng = Rng::new(seed);
            let scene = structured::scene(&mut rng, kind, 30);
            let options = rng.pick(&choices(&scene));
            let places = places(&mut rng, &scene, 6);
            check(&scene, &options, &places, "structured");
        }
    }
}

#[test]
fn surfaces_answer_as_with_the_point_added_when_the_radius_follows_it() {
    let mut rng = Rng::new(7);
    let kinds: [fn(&mut Rng, usize) -> shapes::Points; 4] =
        [shapes::bumpy, shapes::room, shapes::ball, shapes::sphere];
    for shape in kinds {
        for viewpoint in [[0.1, 0.2, 0.05], [2.5, 1.0, 3.0]] {
            let scene = Scene {
                points: shape(&mut rng, 2500),
                viewpoint,
                options: Options::default(),
            };
            for options in [
                Options::default(),
                Options::with_inversion(Inversion::Exponential(Exponential::Auto)),
                Options::with_exponent(2.0),
            ] {
                let places = places(&mut rng, &scene, 12);
                check(&scene, &options, &places, "a surface");
            }
        }
    }
}

#[test]
fn looks_neighbors_and_searches_count_the_point() {
    let mut rng = Rng::new(8);
    let scene = Scene {
        points: shapes::bumpy(&mut rng, 150),
        viewpoint: [0.2, 0.4, 2.0],
        options: Options::default(),
    };
    let noise = Options {
        denoise: Some(4),
        vote: Some(5),
        ..Options::default()
    };
    for options in [
        Options::with_inversion(Inversion::Looks(2)),
        Options::with_inversion(Inversion::Looks(3)),
        noise,
        Options {
            radius: Radius::Search,
            ..Options::default()
        },
        Options {
            radius: Radius::Opposite,
            ..Options::default()
        },
    ] {
        let places = places(&mut rng, &scene, 6);
        check(&scene, &options, &places, "needs others");
    }
}

#[test]
fn single_precision_and_changed_clouds_answer_as_with_the_point_added() {
    let mut rng = Rng::new(9);
    let points: Vec<[f32; 3]> = shapes::bumpy(&mut rng, 300)
        .into_iter()
        .map(|p| p.map(|x| x as f32))
        .collect();
    let mut cloud = PointCloud::new(&points).unwrap();
    cloud.remove(&(0..100).collect::<Vec<_>>()).unwrap();
    let rest: Vec<_> = points[100..].iter().map(|p| p.map(f64::from)).collect();
    let scene = Scene {
        points: rest,
        viewpoint: [0.2, 0.4, 2.0],
        options: Options::default(),
    };
    for place in places(&mut rng, &scene, 60) {
        let options = Options::default();
        let found = cloud.sees(scene.viewpoint, &[place], &options).unwrap();
        let expected = by_definition(&scene.points, place, scene.viewpoint, &options);
        assert_eq!(Ok(found[0]), expected, "{place:?}");
        let single = place.map(|x| x as f32);
        let found = cloud.sees(scene.viewpoint, &[single], &options).unwrap();
        let widened = single.map(f64::from);
        let expected = by_definition(&scene.points, widened, scene.viewpoint, &options);
        assert_eq!(Ok(found[0]), expected, "{single:?}");
    }
}

#[test]
fn positions_outside_of_a_choice_are_not_seen() {
    let mut rng = Rng::new(10);
    let points = shapes::bumpy(&mut rng, 300);
    let cloud = PointCloud::new(&points).unwrap();
    let viewpoint = [0.2, 0.4, 2.0];
    let within = Within {
        distance: Some(2.0),
        bounds: Some([[-1.0, -1.0, 0.0], [1.0, 0.6, 5.0]]),
    };
    for options in [Options::default(), Options::with_radius(2.0)] {
        let options = Options {
            within: Some(within),
            ..options
        };
        let scene = Scene {
            points: points.clone(),
            viewpoint,
            options,
        };
        let places = places(&mut rng, &scene, 80);
        let found = cloud.sees(viewpoint, &places, &options).unwrap();
        for (&place, found) in places.iter().zip(found) {
            let expected = by_definition(&points, place, viewpoint, &options);
            assert_eq!(Ok(found), expected, "{place:?}");
        }
    }
}

#[test]
fn questions_that_make_no_sense_are_refused() {
    let points = [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]];
    let cloud = PointCloud::new(&points).unwrap();
    let far = [0.0, 0.0, 5.0];
    let ask = |places: &[[f64; 3]], options: &Options| cloud.sees(far, places, options);
    let default = Options::default();
    assert_eq!(ask(&[], &default), Ok(vec![]));
    let nan = [0.0, f64::NAN, 0.0];
    let refusal = Error::NonFinite { count: 2, first: 1 };
    assert_eq!(ask(&[far, nan, nan], &default), Err(refusal));
    let refused = [
        Options {
            draft: true,
            ..default
        },
        Options {
            sample: Some(2),
            ..default
        },
        Options {
            scores: true,
            ..Options::with_inversion(Inversion::Looks(2))
        },
        Options {
            vote: Some(0),
            ..default
        },
        Options::with_exponent(-1.0),
    ];
    for options in refused {
        assert_eq!(ask(&[far], &options).unwrap_err().code(), "option");
        assert_eq!(ask(&[], &options).unwrap_err().code(), "option");
    }
    let refusal = ask(&[[0.0, 0.0, 50.0]], &Options::with_radius(9.0));
    let (radius, farthest) = (9.0, 45.0);
    assert_eq!(refusal, Err(Error::RadiusTooSmall { radius, farthest }));
    let refusal = cloud.sees(nan, &[far], &default).unwrap_err();
    assert_eq!(refusal.code(), "viewpoint");
    let refusal = ask(&[[f64::MAX, 0.0, 0.0]], &default).unwrap_err();
    assert_eq!(refusal.code(), "radius");
    // A cloud that skips such points does so here, too.
    let skipping = PointCloud::with_non_finite(&[nan, far], NonFinite::Skip).unwrap();
    let seen = skipping.sees([0.0; 3], &[nan, [0.0, 0.0, 1.0], [0.0, 0.0, 9.0]], &default);
    assert_eq!(seen, Ok(vec![false, true, false]));
    // Nothing was added.
    assert_eq!(cloud.len(), 3);
}
