//! Sectors of a cloud in parts: each holds its own points and boxes of the rest, and asks for what is
//! missing.

use hidden_point_removal::{Exponential, Inversion, Options, PointCloud, share_visible};

use crate::common::parts::{Asked, Place, box_of, compare, octant};
use crate::common::refused;
use crate::common::rng::Rng;
use crate::common::scenes::Scene;
use crate::common::shapes;

/// The sectors of a surface need few points of other sectors, in few rounds.
#[test]
fn sectors_hold_a_part_of_the_cloud_only() {
    let mut rng = Rng::new(4);
    let mut points = shapes::bumpy(&mut rng, 20_000);
    let cell = |p: &Place| p.map(|x| (10.0 * x).floor() as i64);
    points.sort_by_key(cell);
    for options in [
        Options::with_radius(300.0),
        Options::with_inversion(Inversion::Exponential(Exponential::Scale(0.001))),
    ] {
        let viewpoint = [0.1, 0.2, 0.05];
        let scene = Scene {
            points: points.clone(),
            viewpoint,
            options,
        };
        for Asked { rounds, held, .. } in
            compare(&mut rng, &scene, 8, &mut |_, k| octant(&scene, k), "bumpy")
        {
            assert!(rounds <= 4, "{rounds} rounds");
            assert!(held < points.len() / 2, "{held} points held");
        }
    }
}

#[test]
fn single_precision_answers_like_double() {
    let points = shapes::bumpy(&mut Rng::new(5), 600);
    let single: Vec<[f32; 3]> = points.iter().map(|p| p.map(|x| x as f32)).collect();
    let wide: Vec<Place> = single.iter().map(|p| p.map(f64::from)).collect();
    let (viewpoint, options) = ([0.0, 0.5, 3.0], Options::with_radius(100.0));
    let rest = [box_of(&wide, &(300..600).collect::<Vec<_>>())];
    let share = |end| {
        let single = share_visible(
            &single[..200],
            &single[200..end],
            &rest,
            viewpoint,
            &options,
        );
        let double = share_visible(&wide[..200], &wide[200..end], &rest, viewpoint, &options);
        assert_eq!(single, double);
        single.unwrap()
    };
    assert!(!share(300).missing().is_empty());
    let cloud = PointCloud::new(&wide).unwrap();
    let whole = cloud.visible_from(viewpoint, &options).unwrap();
    let own: Vec<u32> = whole
        .indices()
        .iter()
        .copied()
        .filter(|&k| k < 200)
        .collect();
    let complete = share_visible(&wide[..200], &wide[200..], &[], viewpoint, &options).unwrap();
    assert_eq!(complete.visible(), own);
    assert_eq!(complete.needed(), whole.indices());
}

#[test]
fn bad_input_is_refused() {
    let points = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]];
    let ask = |own: &[Place], boxes: &[[Place; 2]], options: &Options| {
        share_visible(own, &points, boxes, [0.0, 0.0, 5.0], options)
    };
    let options = Options::with_radius(100.0);
    let nan = [[f64::NAN, 0.0, 0.0]];
    for bad in [
        [[f64::NAN, 0.0, 0.0], [1.0; 3]],
        [[0.0; 3], [1.0, f64::INFINITY, 1.0]],
        [[0.0, 0.0, 2.0], [1.0; 3]],
    ] {
        refused("option", "a box must be", ask(&points, &[bad], &options));
    }
    refused("non-finite", "1 point(s)", ask(&nan, &[], &options));
    let merging = "vote cannot be combined with merging";
    for (code, words, options) in [
        ("option", "merging needs the radius", Options::default()),
        ("option", merging, options.vote(1)),
        ("radius", "smaller", Options::with_radius(1.0)),
    ] {
        refused(code, words, ask(&points, &[], &options));
    }
    // Without own points nothing is asked.
    let share = ask(&[], &[[[0.0; 3], [1.0; 3]]], &options).unwrap();
    assert_eq!((share.visible().len(), share.missing().len()), (0, 0));
}
