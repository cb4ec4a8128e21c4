//! Four and more dimensions, compared with the exact answers in three, and on known shapes.

use hidden_point_removal::{
    Exponential, Inversion, NonFinite, Options, PointCloud, PointCloudNd, Radius, Visibility,
    Within,
};

use crate::common::rng::Rng;
use crate::common::scenes::KINDS;
use crate::common::{ask, refused};
use crate::test;

fn asked(dimension: usize, rows: &[Vec<f64>], viewpoint: &[f64], options: &Options) -> Visibility {
    let cloud = PointCloudNd::new(dimension, &rows.concat()).unwrap();
    cloud.visible_from(viewpoint, options).unwrap()
}

fn direction(rng: &mut Rng, dimension: usize) -> Vec<f64> {
    loop {
        let v: Vec<f64> = (0..dimension).map(|_| rng.between(-1.0, 1.0)).collect();
        let squared = v.iter().map(|x| x * x).sum::<f64>();
        if squared < 1.0 && squared > 1e-3 {
            return v.iter().map(|x| x / squared.sqrt()).collect();
        }
    }
}

#[test]
fn clouds_in_coordinates_of_a_subspace_have_the_bits_of_three_dimensions() {
    let kinds = KINDS
        .iter()
        .flat_map(|kind| (0..4).map(move |seed| (kind, seed)));
    for (k, (kind, seed)) in kinds.enumerate() {
        let scene = kind.scene(seed, 30);
        let dimension = 4 + k % 3;
        let place = |p: [f64; 3]| -> Vec<f64> {
            let mut row = vec![7.0; dimension];
            row[k % (dimension - 2)..][..3].copy_from_slice(&p);
            row
        };
        let rows: Vec<_> = scene.points.iter().map(|&p| place(p)).collect();
        let far = scene.viewpoint.map(|x| x * 1e7);
        let differs = |i: usize| scene.points.iter().any(|p| p[i] != scene.points[0][i]);
        if !(0..3).all(differs) {
            continue; // Other coordinates may stand for the one that is constant.
        }
        for (viewpoint, options) in [
            (scene.viewpoint, Options::default()),
            (far, Options::default()),
            (
                far,
                Options::inversion(Inversion::Exponential(Exponential::Auto)),
            ),
        ] {
            let flat = ask(&scene.points, viewpoint, &options);
            let answer = asked(dimension, &rows, &place(viewpoint), &options);
            assert_eq!(answer, flat, "{} with seed {seed}", kind.name);
        }
    }
}

#[test]
fn far_viewpoints_see_as_much_as_near_ones() {
    let mut rng = Rng::new(66);
    for exponent in 2..13 {
        let distance = (0..exponent).fold(1.0, |distance, _| 10.0 * distance);
        let mut seen = 0;
        for _ in 0..20 {
            let rows: Vec<_> = (0..60)
                .map(|_| {
                    direction(&mut rng, 4)
                        .iter()
                        .map(|x| x * rng.unit())
                        .collect::<Vec<_>>()
                })
                .collect();
            let viewpoint: Vec<_> = direction(&mut rng, 4)
                .iter()
                .map(|x| x * distance)
                .collect();
            let answer = asked(4, &rows, &viewpoint, &Options::default());
            assert!(answer.exact() && answer.count() > 5, "from 10^{exponent}");
            seen += answer.count();
        }
        // From 10⁷ on, the rounding of the flipped points hides and shows some.
        assert!(seen > 20 * 20, "{seen} from 10^{exponent}");
    }
}

#[test]
fn order_and_duplicates_change_nothing_and_changes_are_as_anew() {
    let mut rng = Rng::new(63);
    let rows: Vec<_> = (0..150).map(|_| direction(&mut rng, 4)).collect();
    let viewpoint = [1.5, 0.0, 0.5, 0.0];
    let options = Options::default();
    let before = asked(4, &rows, &viewpoint, &options);
    let mut order: Vec<usize> = (0..200)
        .map(|i| if i < 150 { i } else { rng.below(150) })
        .collect();
    rng.shuffle(&mut order);
    let shuffled: Vec<_> = order.iter().map(|&i| rows[i].clone()).collect();
    let after = asked(4, &shuffled, &viewpoint, &options);
    assert_eq!(after.radius().to_bits(), before.radius().to_bits());
    let (old, new) = (before.mask(), after.mask());
    assert!(order.iter().enumerate().all(|(k, &i)| new[k] == old[i]));

    let mut cloud = PointCloudNd::new(4, &rows[..100].concat()).unwrap();
    cloud.remove(&[3, 99, 3]).unwrap();
    cloud.append(&rows[100..].concat()).unwrap();
    let kept: Vec<u32> = (0..150).filter(|i| ![3, 99].contains(i)).collect();
    let rest: Vec<_> = kept.iter().map(|&i| rows[i as usize].clone()).collect();
    let expected = asked(4, &rest, &viewpoint, &options);
    let answer = cloud.visible_from(&viewpoint, &options).unwrap();
    let indices: Vec<u32> = expected
        .indices()
        .iter()
        .map(|&i| kept[i as usize])
        .collect();
    assert_eq!(answer.indices(), indices);
    assert_eq!(answer.radius().to_bits(), expected.radius().to_bits());
    assert_eq!(
        (cloud.len(), cloud.dimension(), cloud.is_empty()),
        (150, 4, false)
    );
    assert!(PointCloudNd::new(4, &[]).unwrap().is_empty());
}

#[test]
fn every_rule_inversion_and_union_is_there() {
    let mut rng = Rng::new(64);
    let rows: Vec<_> = (0..200).map(|_| direction(&mut rng, 4)).collect();
    let cloud = PointCloudNd::new(4, &rows.concat()).unwrap();
    let viewpoint = [0.0, 2.5, 0.0, 0.0];
    let auto = cloud.auto_radius(&viewpoint, Radius::Auto).unwrap();
    assert!(auto.radius >= 3.0 && auto.evaluations == 0);
    let opposite = cloud.auto_radius(&viewpoint, Radius::Opposite).unwrap();
    assert!(opposite.evaluations > 20 && opposite.radius >= 3.0);
    for inversion in [
        Inversion::Power(1.5),
        Inversion::Exponential(Exponential::Auto),
    ] {
        let answer = cloud
            .visible_from(&viewpoint, &Options::inversion(inversion))
            .unwrap();
        assert!(answer.count() > 20 && answer.count() < 200);
    }
    let back = [0.0, -2.5, 0.0, 0.0];
    let views = [&viewpoint[..], &back];
    let options = Options::default();
    let any = cloud.visible_from_any(&views, &options).unwrap();
    let both = cloud.visible_from_at_least(2, &views, &options).unwrap();
    let singly = views.map(|view| cloud.visible_from(view, &options).unwrap().count());
    assert_eq!(any.count() + both.count(), singly[0] + singly[1]);
    assert_eq!(cloud.visible_from_any(&[], &options).unwrap().count(), 0);
}

#[test]
fn what_does_not_fit_is_refused() {
    for dimension in [0, 1, 3, 65] {
        refused(
            "option",
            "dimension must be from",
            PointCloudNd::new(dimension, &[]),
        );
    }
    let uneven = "7 coordinates are not a multiple of the dimension, 4";
    refused("positions-length", uneven, PointCloudNd::new(4, &[0.0; 7]));
    let bad = [[0.0; 4], [0.0, 1.0, f64::NAN, 0.0], [1.0; 4]].concat();
    refused("non-finite", "1 point(s)", PointCloudNd::new(4, &bad));
    let mut cloud = PointCloudNd::with_non_finite(4, &bad, NonFinite::Skip).unwrap();
    assert_eq!((cloud.len(), cloud.skipped()), (3, 1));
    let options = Options::default();
    let seen = cloud.visible_from(&[5.0, 0.0, 0.0, 0.0], &options).unwrap();
    assert_eq!(seen.indices(), [0, 2]);
    for viewpoint in [&[0.0; 3][..], &[0.0, 0.0, 0.0, f64::INFINITY]] {
        let found = cloud.visible_from(viewpoint, &options);
        refused("viewpoint", "must be 4 finite numbers", found);
    }
    refused("option", "index 3", cloud.remove(&[3]));
    let within = options.with_within(Within {
        distance: Some(1.0),
        bounds: None,
    });
    for (code, words, options) in [
        ("option", "within needs a cloud of dimension 3", within),
        (
            "option",
            "looks needs a cloud of dimension 3",
            Options::looks(3),
        ),
        ("radius", "smaller", Options::radius(0.1)),
    ] {
        refused(code, words, cloud.visible_from(&[0.0; 4], &options));
    }
    let far = PointCloudNd::new(4, &[1e200; 4]).unwrap();
    refused("radius", "range", far.visible_from(&[0.0; 4], &options));
}

/// Three neighbors at the distances 3, 4 and 5.
#[test]
fn the_spacing_is_told_in_every_dimension() {
    let flat = PointCloud::new(&[[0.0; 3], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]]).unwrap();
    assert_eq!(flat.spacing(), Ok(4.0));
    let corners = [[0.0; 4], [3.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 4.0]].concat();
    assert_eq!(PointCloudNd::new(4, &corners).unwrap().spacing(), 4.0);
}
