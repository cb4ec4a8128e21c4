//! Several looks along a direction: the limit of looks from farther and farther away.

use hidden_point_removal::{Options, PointCloud, Visibility};

use crate::common::rng::Rng;
use crate::common::{ask, shapes};
use crate::test;

fn looks(count: usize) -> Options {
    Options::looks(count).with_scores(true)
}

fn along(points: &[[f64; 3]], direction: [f64; 3], options: &Options) -> Visibility {
    let cloud = PointCloud::new(points).unwrap();
    cloud.visible_from_direction(direction, options).unwrap()
}

#[test]
fn it_is_the_limit_of_receding_viewpoints() {
    let mut rng = Rng::new(33);
    for (shape, count) in [
        (shapes::bumpy as fn(&mut Rng, usize) -> _, 3),
        (shapes::ball, 2),
        (shapes::room, 3),
    ] {
        let points: Vec<[f64; 3]> = shape(&mut rng, 1500);
        let direction = rng.direction();
        let limit = along(&points, direction, &looks(count));
        let apart = |times: f64| {
            let far = ask(&points, direction.map(|x| -x * times), &looks(count));
            assert_eq!(far.looks(), limit.looks());
            let masks = far.mask().into_iter().zip(limit.mask());
            let scores = far.scores().iter().zip(limit.scores());
            let differ = masks.filter(|(a, b)| a != b).count();
            let distance = scores.map(|(a, b)| f64::from((a - b).abs())).sum::<f64>();
            (differ as f64 / 1500.0, distance / 1500.0)
        };
        let [near, mid, far] = [20.0, 200.0, 20_000.0].map(apart);
        assert!(
            mid.0 <= 0.5 * near.0 + 0.001 && mid.1 < 0.5 * near.1,
            "{near:?} {mid:?}"
        );
        assert!(far.0 < 0.003 && far.1 < 0.003, "{far:?}");
    }
}

#[test]
fn degenerate_clouds_answer_as_documented() {
    let down = [0.0, 0.0, -1.0];
    let seen = |points: &[[f64; 3]]| {
        let answer = along(points, down, &looks(3));
        (answer.indices().to_vec(), answer.scores().to_vec())
    };
    let origin = [0.0; 3];
    assert_eq!(seen(&[]), (vec![], vec![]));
    assert_eq!(seen(&[origin]), (vec![0], vec![1.0]));
    assert_eq!(seen(&[origin; 3]), (vec![0, 1, 2], vec![1.0; 3]));
    // On one ray only the nearest is visible.
    let ray = [[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], origin];
    assert_eq!(seen(&ray), (vec![1], vec![0.2, 1.0, 0.2]));
    let triangle = [origin, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(seen(&triangle[..2]), (vec![0, 1], vec![1.0; 2]));
    assert_eq!(seen(&triangle).0, [0, 1, 2]);
    let with = |p| [triangle[0], triangle[1], triangle[2], p];
    assert_eq!(seen(&with([0.2, 0.2, -3.0])).0, [0, 1, 2]);
    assert_eq!(seen(&with([0.3, 0.3, -0.01])).0, [0, 1, 2, 3]);
    // A grid that the rays meet at right angles: four points of each cell are on one face.
    let grid: Vec<_> = (0..49)
        .map(|i| [f64::from(i % 7), f64::from(i / 7), 0.0])
        .collect();
    assert_eq!(seen(&grid).0.len(), 49);
    // A coordinate as large as those of maps does not change the answer.
    let mut rng = Rng::new(4);
    let points: Vec<[f64; 3]> = shapes::bumpy(&mut rng, 800)
        .into_iter()
        .map(|p: [f64; 3]| p.map(|x| (x * 1024.0).round() / 1024.0))
        .collect();
    let far: Vec<_> = points
        .iter()
        .map(|p| [p[0] + 524_288.0, p[1] + 5_242_880.0, p[2]])
        .collect();
    let (near, far) = (
        along(&points, down, &looks(3)),
        along(&far, down, &looks(3)),
    );
    let differ = near
        .mask()
        .iter()
        .zip(far.mask())
        .filter(|(a, b)| **a != *b)
        .count();
    assert!(differ < 8, "{differ}");
}
