//! Drafts. A draft is a certain superset of the visible points. It does not depend on earlier
//! questions. An exact answer can go on from it.

use hidden_point_removal::{
    Exponential, Inversion, Lighting, Observer, Options, PointCloud, Radius, Sector, Visibility,
    Within, merge_visible,
};

use crate::common::rng::Rng;
use crate::common::shapes::{self, Points};
use crate::common::{NOWHERE, refused};

/// Enough points for a map of directions.
const MANY: usize = 6000;

fn drafted(options: Options) -> Options {
    options.draft(true)
}

fn inversions() -> [Options; 6] {
    [
        Options::default(),
        Options::with_exponent(0.0),
        Options::with_exponent(4.0),
        Options::with_inversion(Inversion::Power(1.5)),
        Options::with_inversion(Inversion::Exponential(Exponential::Auto)),
        Options::with_exponent(2.0).vote(5),
    ]
}

#[test]
fn other_questions_may_come_between_a_draft_and_its_exact_view() {
    let points = shapes::bumpy(&mut Rng::new(10), MANY);
    let cloud = PointCloud::new(&points).expect("an acceptable cloud");
    let (here, elsewhere) = ([0.3, 1.2, 2.4], [-2.0, 1.0, 0.5]);
    let looks = Options::with_inversion(Inversion::Looks(3));
    let near = Options::default().within(Within {
        distance: Some(2.4),
        bounds: None,
    });
    type Between<'a> = &'a dyn Fn(&mut Observer, &Options);
    let other_view = |at, options: Options| {
        let cloud = &cloud;
        move |observer: &mut Observer, _: &Options| {
            let seen = observer.visible_from(at, &options).unwrap();
            assert_eq!(seen, cloud.visible_from(at, &options).unwrap());
        }
    };
    let between: [(&str, Between); 10] = [
        ("nothing", &|_, _| {}),
        ("its draft", &|observer, options| {
            let draft = observer.visible_from(here, &drafted(*options)).unwrap();
            assert_eq!(draft, cloud.visible_from(here, &drafted(*options)).unwrap());
        }),
        (
            "a draft from elsewhere",
            &other_view(elsewhere, drafted(Options::default())),
        ),
        (
            "an exact view from elsewhere",
            &other_view(elsewhere, Options::default()),
        ),
        (
            "a draft with another radius",
            &other_view(here, drafted(Options::with_exponent(1.0))),
        ),
        (
            "an exact view with another radius",
            &other_view(here, Options::with_exponent(1.0)),
        ),
        ("a draft of a part", &other_view(here, drafted(near))),
        ("slices from elsewhere", &|observer, options| {
            assert!(observer.go_on(elsewhere, options, 100).unwrap());
        }),
        ("a begun look", &|observer, _| {
            observer.go_on(here, &looks, 100).unwrap();
        }),
        ("a sector", &|observer, options| {
            let sector = Sector::new(1, 3).unwrap();
            let seen = observer.visible_in_sector(here, options, sector).unwrap();
            let alone = cloud.visible_in_sector(here, options, sector).unwrap();
            assert_eq!(seen, alone);
        }),
    ];
    for options in inversions() {
        let exact = cloud.visible_from(here, &options).unwrap();
        for (title, between) in between {
            for slices in [0, 3] {
                let mut observer = cloud.observer();
                observer.visible_from(here, &drafted(options)).unwrap();
                for _ in 0..slices {
                    observer.go_on(here, &options, MANY / 16).unwrap();
                }
                between(&mut observer, &options);
                observer.go_on(here, &options, MANY / 16).unwrap();
                let seen = observer.visible_from(here, &options).unwrap();
                let title = format!("{title} after {slices} slices, {options:?}");
                assert_eq!(seen, exact, "{title}");
            }
        }
    }
}

#[test]
fn drafts_hide_most_of_what_is_hidden() {
    let mut rng = Rng::new(5);
    let points = shapes::bumpy(&mut rng, 40_000);
    let cloud = PointCloud::new(&points).expect("an acceptable cloud");
    let viewpoint = [1.0, 2.0, 2.0];
    for (options, least) in [
        (Options::with_exponent(2.0), 0.8),
        (Options::with_exponent(3.0), 0.6),
        (Options::default(), 0.6),
    ] {
        let exact = cloud.visible_from(viewpoint, &options).unwrap();
        let draft = cloud.visible_from(viewpoint, &drafted(options)).unwrap();
        let hidden = |seen: &Visibility| (points.len() - seen.count()) as f64;
        let share = hidden(&draft) / hidden(&exact);
        assert!(share > least, "{share} with {options:?}");
    }
}

#[test]
fn drafts_from_several_viewpoints_and_along_a_direction_hold_all_that_is_visible() {
    let mut rng = Rng::new(6);
    let points = shapes::bumpy(&mut rng, MANY);
    let cloud = PointCloud::new(&points).expect("an acceptable cloud");
    let viewpoints = [[3.0, 0.0, 0.0], [2.9, 0.4, 0.0], [2.9, 0.0, 0.4]];
    type Ask = fn(&PointCloud, &[[f64; 3]], &Options) -> Visibility;
    let asks: [Ask; 3] = [
        |cloud, viewpoints, options| cloud.visible_from_any(viewpoints, options).unwrap(),
        |cloud, viewpoints, options| cloud.visible_from_at_least(2, viewpoints, options).unwrap(),
        |cloud, viewpoints, options| {
            cloud
                .visible_from_direction(viewpoints[0], options)
                .unwrap()
        },
    ];
    for ask in asks {
        for options in [Options::default(), Options::with_exponent(2.0)] {
            let exact = ask(&cloud, &viewpoints, &options);
            let draft = ask(&cloud, &viewpoints, &drafted(options));
            assert!(exact.exact() && !draft.exact());
            assert!(draft.count() < points.len());
            assert_eq!(draft.radius().to_bits(), exact.radius().to_bits());
            let mask = draft.mask();
            assert!(exact.indices().iter().all(|&i| mask[i as usize] == 1));
        }
    }
}

#[test]
fn there_is_no_draft_of_a_search_a_mesh_light_or_a_merged_answer() {
    let points = [[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [1.0, 0.0, 0.0]];
    let cloud = PointCloud::new(&points).expect("an acceptable cloud");
    let viewpoint = [0.0, 0.0, 5.0];
    let plain = drafted(Options::default());
    for radius in [Radius::Search, Radius::Opposite] {
        let options = plain.radius(radius);
        refused("option", "draft", cloud.visible_from(viewpoint, &options));
        refused(
            "option",
            "draft",
            cloud.visible_from_any(&NOWHERE, &options),
        );
    }
    refused(
        "option",
        "draft",
        cloud.reconstruct(viewpoint, &plain, None),
    );
    let lit = cloud.illuminate(&[viewpoint], &plain, &Lighting::default());
    refused("option", "draft", lit);
    let parts = [(&points[..], &[0, 1, 2][..])];
    for options in [plain, sampled(2)] {
        let options = options.radius(Radius::Absolute(9.0));
        refused(
            "option",
            "merging",
            merge_visible(&parts, viewpoint, &options),
        );
    }
}

fn sampled(count: usize) -> Options {
    Options::default().sample(count)
}

/// The indices that a sample of `count` points takes. The cloud must be a sphere: from a
/// viewpoint inside it, all sampled points are visible.
fn sample_of(cloud: &PointCloud, count: usize) -> Vec<u32> {
    let options = sampled(count).radius(Radius::Exponent(9.0));
    let seen = cloud.visible_from([0.0; 3], &options).unwrap();
    assert!(!seen.exact());
    seen.into_indices()
}

#[test]
fn smaller_samples_are_part_of_larger_ones_in_any_order_of_the_points() {
    let mut rng = Rng::new(7);
    let points = shapes::sphere(&mut rng, 3000);
    let cloud = PointCloud::new(&points).expect("an acceptable cloud");
    let mut order: Vec<u32> = (0..3000).collect();
    rng.shuffle(&mut order);
    let mut shuffled: Points = order.iter().map(|&i| points[i as usize]).collect();
    shuffled.extend_from_within(..500);
    let mut other = PointCloud::new(&shuffled[..1000]).expect("an acceptable cloud");
    other
        .append(&shuffled[1000..])
        .expect("an acceptable cloud");
    let mut smaller: Vec<u32> = Vec::new();
    for count in [1, 2, 50, 51, 777, 1500, 2999] {
        let sample = sample_of(&cloud, count);
        assert_eq!(sample.len(), count);
        assert!(smaller.iter().all(|i| sample.contains(i)), "{count}");
        let mut same: Vec<u32> = sample_of(&other, count)
            .iter()
            .filter(|&&i| i < 3000)
            .map(|&i| order[i as usize])
            .collect();
        same.sort_unstable();
        assert_eq!(same, sample);
        smaller = sample;
    }
    assert_eq!(sample_of(&cloud, 5000).len(), 3000);
}

#[test]
fn a_sample_answers_as_a_cloud_of_its_points() {
    let mut rng = Rng::new(8);
    // Seen from inside the sphere, every sampled point is visible. So the answer is the sample.
    let points = shapes::sphere(&mut rng, 5000);
    let mut cloud = PointCloud::new(&points).expect("an acceptable cloud");
    let taken = sample_of(&cloud, 700);
    let alone: Points = taken.iter().map(|&i| points[i as usize]).collect();
    let alone = PointCloud::new(&alone).expect("an acceptable cloud");
    let viewpoint = [0.2, 1.4, 1.9];
    for kept in [false, true] {
        for options in inversions() {
            let asked = options.sample(700);
            if kept {
                cloud.prepare_for(&asked).expect("enough memory");
            }
            let seen = cloud.visible_from(viewpoint, &asked).unwrap();
            let expected = alone.visible_from(viewpoint, &options).unwrap();
            let indices: Vec<u32> = expected
                .indices()
                .iter()
                .map(|&i| taken[i as usize])
                .collect();
            assert_eq!(seen.indices(), indices);
            assert_eq!(seen.radius().to_bits(), expected.radius().to_bits());
            assert_eq!(seen.exponent().to_bits(), expected.exponent().to_bits());
            assert_eq!(seen.inversion(), expected.inversion());
            assert_eq!(seen.mask().len(), points.len());
        }
    }
    let mesh = cloud.reconstruct(viewpoint, &sampled(700), None).unwrap();
    let expected = alone
        .reconstruct(viewpoint, &Options::default(), None)
        .unwrap();
    let triangles = expected
        .triangles
        .iter()
        .map(|t| t.map(|i| taken[i as usize]));
    assert!(mesh.triangles.into_iter().eq(triangles));
    let lighting = Lighting::default();
    let light = cloud
        .illuminate(&[viewpoint], &sampled(700), &lighting)
        .unwrap();
    let expected = alone
        .illuminate(&[viewpoint], &Options::default(), &lighting)
        .unwrap();
    assert!(taken.iter().map(|&i| light[i as usize]).eq(expected));
}

#[test]
fn an_observer_tells_samples_from_the_whole() {
    let mut rng = Rng::new(9);
    let points = shapes::bumpy(&mut rng, MANY);
    let cloud = PointCloud::new(&points).expect("an acceptable cloud");
    let mut observer = cloud.observer();
    for step in 0..12 {
        let viewpoint = [0.01 * f64::from(step), 0.0, 3.0];
        for options in [Options::default(), sampled(4000), drafted(sampled(4000))] {
            let seen = observer.visible_from(viewpoint, &options).unwrap();
            assert_eq!(seen, cloud.visible_from(viewpoint, &options).unwrap());
        }
    }
}

#[test]
fn samples_of_nothing_are_refused() {
    let cloud = PointCloud::new(&[[0.0, 0.0, 1.0]]).expect("an acceptable cloud");
    refused(
        "option",
        "sample",
        cloud.visible_from([0.0; 3], &sampled(0)),
    );
    let empty = PointCloud::new::<[f64; 3]>(&[]).expect("an acceptable cloud");
    let nothing = empty.visible_from([0.0; 3], &sampled(1)).unwrap();
    assert_eq!(nothing.count(), 0);
}

#[test]
fn looks_have_samples_with_scores_but_no_drafts() {
    let points = shapes::bumpy(&mut Rng::new(5), 3000);
    let cloud = PointCloud::new(&points).unwrap();
    let looks = Options::with_inversion(Inversion::Looks(3));
    let draft = cloud.visible_from([0.0, 0.0, 3.0], &drafted(looks));
    refused("option", "looks cannot be combined with draft", draft);

    let sampled = looks.sample(1000);
    let seen = cloud.visible_from([0.0, 0.0, 3.0], &sampled).unwrap();
    assert!(!seen.exact() && seen.count() > 0 && seen.count() < 1000);
    let scored = sampled.scores(true);
    let seen = cloud.visible_from([0.0, 0.0, 3.0], &scored).unwrap();
    let sample = cloud.sampled(1000).unwrap();
    let options = scored.sample(None);
    let alone = sample.visible_from([0.0, 0.0, 3.0], &options).unwrap();
    assert_eq!(
        (seen.indices(), seen.scores()),
        (alone.indices(), alone.scores())
    );
    assert_eq!((seen.exact(), alone.exact()), (false, true));
}
