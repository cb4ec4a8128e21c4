//! Many viewpoints: counts, and the greedy choice against every choice.

use hidden_point_removal::{Error, Options, Placing, PointCloud, ring_of_viewpoints};

use crate::common::refused;
use crate::common::rng::Rng;
use crate::common::shapes;
use crate::test;

fn scene(seed: u64) -> (PointCloud, Vec<[f64; 3]>, Vec<f64>) {
    let mut rng = Rng::new(seed);
    let shape: fn(&mut Rng, usize) -> shapes::Points =
        rng.pick(&[shapes::bumpy, shapes::room, shapes::ball]);
    let points = shape(&mut rng, 250);
    let candidates = (0..9).map(|_| rng.in_ball().map(|x| 2.0 * x)).collect();
    let weights = points.iter().map(|_| f64::from(rng.integer(0, 4)) * 0.1);
    let weights = weights.collect();
    (PointCloud::new(&points).unwrap(), candidates, weights)
}

#[test]
fn a_choice_ends_when_enough_is_seen() {
    let (cloud, candidates, weights) = scene(3);
    let options = Options::default();
    let place = |placing: Placing| {
        cloud
            .place_viewpoints(&candidates, &options, &placing)
            .unwrap()
    };
    let all = place(Placing::default());
    assert_eq!(all.seen.len() + all.unseen.len(), 250);
    let most = all.gains.iter().sum::<f64>();
    for share in [0.2, 0.5, 0.9, 0.99] {
        let some = place(Placing {
            share: Some(share),
            ..Placing::default()
        });
        assert_eq!(some.chosen, all.chosen[..some.chosen.len()]);
        assert_eq!(some.unseen, all.unseen);
        assert!(some.seen.len() as f64 >= share * most);
        let before: f64 = some.gains[..some.gains.len() - 1].iter().sum();
        assert!(before < share * most);
    }
    // Nothing is gained where nothing counts.
    let nothing = vec![0.0; weights.len()];
    let none = place(Placing {
        weights: Some(&nothing),
        ..Placing::default()
    });
    assert!(none.chosen.is_empty() && none.seen.is_empty());
}

#[test]
fn questions_that_make_no_sense_are_refused() {
    let (cloud, candidates, _) = scene(4);
    let usual = Options::default();
    let (short, negative, heavy) = ([1.0], [-1.0; 250], [f64::MAX; 250]);
    for (count, share, weights) in [
        (Some(0), None, None),
        (None, Some(0.0), None),
        (None, Some(f64::NAN), None),
        (None, None, Some(&short[..])),
        (None, None, Some(&negative[..])),
        (None, None, Some(&heavy[..])),
    ] {
        let mut placing = Placing::default();
        (placing.count, placing.share, placing.weights) = (count, share, weights);
        let found = cloud.place_viewpoints(&candidates, &usual, &placing);
        refused("option", "", found);
    }
}

#[test]
fn of_several_refusals_the_first_one_is_reported() {
    let points = shapes::bumpy(&mut Rng::new(2), 800);
    let cloud = PointCloud::new(&points).unwrap();
    let mut viewpoints = ring_of_viewpoints([0.0, 0.0, 4.0], [0.0; 3], 40, 0.2).unwrap();
    for bad in 11..40 {
        viewpoints[bad] = [bad as f64, f64::NAN, 0.0];
    }
    for _ in 0..20 {
        let refused = cloud.coverage(&viewpoints, &Options::default().with_threads(8));
        let Err(Error::Viewpoint { viewpoint }) = refused else {
            panic!("{refused:?}");
        };
        assert_eq!(viewpoint[0], 11.0);
    }
}
