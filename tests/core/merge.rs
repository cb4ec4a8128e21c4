//! Merging the visible points of parts, for any division of a cloud.

use hidden_point_removal::{
    Error, Exponential, Inversion, Options, Position, merge_visible, merge_visible_u64,
};

use crate::common::rng::Rng;
use crate::common::shapes;
use crate::common::{ask, refused};
use crate::test;

const FRONT: [f64; 3] = [0.0, 0.0, 5.0];

type Part<P> = (Vec<P>, Vec<u32>);

fn merge<P: Position>(
    parts: &[Part<P>],
    viewpoint: [f64; 3],
    options: &Options,
) -> Result<Vec<u32>, Error> {
    let parts: Vec<_> = parts
        .iter()
        .map(|(positions, ids)| (&positions[..], &ids[..]))
        .collect();
    merge_visible(&parts, viewpoint, options)
}

#[test]
fn equal_points_share_one_answer_and_equal_ids_come_once() {
    let options = Options::radius(100.0);
    let [near, far] = [[0.0f32, 0.0, 1.0], [0.0, 0.0, 0.0]];
    let parts = [
        (vec![near, far], vec![9, 8]),
        (vec![near, near, far], vec![u32::MAX, 9, 1]),
        (vec![], vec![]),
        (vec![[-0.0, 0.0, 1.0]], vec![0]),
    ];
    assert_eq!(merge(&parts, FRONT, &options), Ok(vec![0, 9, u32::MAX]));
    assert_eq!(merge::<[f32; 3]>(&[], FRONT, &options), Ok(vec![]));
}

#[test]
fn what_cannot_be_merged_is_refused() {
    let points = shapes::bumpy(&mut Rng::new(7), 20);
    let part = || (points.clone(), (0..20).collect::<Vec<u32>>());
    for options in [
        Options::default(),
        Options::exponent(3.0),
        Options::inversion(Inversion::Power(1.7)),
        Options::inversion(Inversion::Exponential(Exponential::Auto)),
    ] {
        refused(
            "option",
            "merging needs the radius",
            merge(&[part()], FRONT, &options),
        );
    }
    for (second, code, words) in [
        (
            (vec![[0.0, 0.0, -95.5]], vec![77]),
            "radius",
            "farthest point, 100.5",
        ),
        (
            (points.clone(), vec![1, 2, 3]),
            "positions-length",
            "part 1 has 20 positions, but 3",
        ),
        (
            (vec![[f64::NAN; 3]], vec![5]),
            "non-finite",
            "the first at index 20",
        ),
    ] {
        let found = merge(&[part(), second], FRONT, &Options::radius(100.0));
        refused(code, words, found);
    }
    let nowhere = merge(&[part()], [f64::NAN; 3], &Options::radius(100.0));
    refused("viewpoint", "", nowhere);
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        refused(
            "radius",
            "",
            merge::<[f64; 3]>(&[], FRONT, &Options::radius(bad)),
        );
    }
}

#[test]
fn ids_beyond_32_bits_come_back_ascending_and_once() {
    let mut rng = Rng::new(11);
    let points = shapes::bumpy(&mut rng, 600);
    let options = Options::radius(80.0);
    let whole = ask(&points, FRONT, &options);
    let id = |index: usize| (1u64 << 40) * (index as u64 % 5) + index as u64;
    let mut expected: Vec<u64> = whole.indices().iter().map(|&k| id(k as usize)).collect();
    expected.sort_unstable();
    let ids: Vec<u64> = (0..points.len()).map(id).collect();
    let (front, back) = (&points[..250], &points[200..]);
    // 50 points are in both parts. One part is empty.
    let parts = [(front, &ids[..250]), (&[], &[]), (back, &ids[200..])];
    let merged = merge_visible_u64(&parts, FRONT, &options).unwrap();
    assert_eq!(merged, expected);
    let missing = [(front, &ids[..249])];
    let refused = merge_visible_u64(&missing, FRONT, &options);
    assert!(matches!(refused, Err(Error::IdsLength { part: 0, .. })));
}
