//! Merging the visible points of parts, for any division of a cloud.

use hidden_point_removal::{
    Error, Options, PointCloud, Position, Radius, merge_visible, merge_visible_u64,
};

use crate::common::ask;
use crate::common::rng::Rng;
use crate::common::scenes::KINDS;
use crate::common::shapes;

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

/// Divides points among `count` parts; some points may get into several.
fn divide(rng: &mut Rng, points: &[[f64; 3]], count: usize) -> Vec<Part<[f64; 3]>> {
    let mut parts = vec![(Vec::new(), Vec::new()); count];
    for (id, &point) in (0..).zip(points) {
        loop {
            let (positions, ids) = &mut parts[rng.below(count)];
            positions.push(point);
            ids.push(id);
            if !rng.chance(8) {
                break;
            }
        }
    }
    parts
}

/// The points of a part that are visible in it, and sometimes a few other points.
fn seen_in(
    rng: &mut Rng,
    (positions, ids): &Part<[f64; 3]>,
    viewpoint: [f64; 3],
    options: &Options,
    extra: bool,
) -> Part<[f64; 3]> {
    let visible = ask(positions, viewpoint, options).mask();
    (0..positions.len())
        .filter(|&k| visible[k] == 1 || extra && rng.chance(3))
        .map(|k| (positions[k], ids[k]))
        .unzip()
}

#[test]
fn any_division_gives_the_answer_of_the_whole() {
    for kind in KINDS {
        for (seed, n) in [(1, 9), (2, 30), (3, 31), (4, 400), (5, 1500)] {
            let scene = kind.scene(seed, n);
            let (points, viewpoint) = (&scene.points, scene.viewpoint);
            let whole = ask(points, viewpoint, &scene.options);
            if whole.radius() == 0.0 {
                continue;
            }
            let options = Options::with_radius(whole.radius());
            let mut rng = Rng::new(seed);
            for count in [1, 2, 3, 7] {
                let divided = divide(&mut rng, points, count);
                let parts: Vec<_> = divided
                    .iter()
                    .map(|part| seen_in(&mut rng, part, viewpoint, &options, count == 3))
                    .collect();
                let title = format!("{} with seed {seed} in {count} parts", kind.name);
                let merged = merge(&parts, viewpoint, &options).unwrap();
                assert_eq!(merged, whole.indices(), "{title}");
                // A part that was not filtered is a superset, too.
                let merged = merge(&divided, viewpoint, &options).unwrap();
                assert_eq!(merged, whole.indices(), "{title}, unfiltered");
            }
        }
    }
}

#[test]
fn merges_can_be_merged_again() {
    let mut rng = Rng::new(6);
    let points = shapes::bumpy(&mut rng, 2000);
    let options = Options::with_exponent(3.0);
    let whole = ask(&points, FRONT, &options);
    let options = Options::with_radius(whole.radius());
    let parts = divide(&mut rng, &points, 8);
    let twice: Vec<_> = parts
        .chunks(2)
        .map(|pair| {
            let ids = merge(pair, FRONT, &options).unwrap();
            (ids.iter().map(|&id| points[id as usize]).collect(), ids)
        })
        .collect();
    assert_eq!(merge(&twice, FRONT, &options).unwrap(), whole.indices());
}

#[test]
fn equal_points_share_one_answer_and_equal_ids_come_once() {
    let options = Options::with_radius(100.0);
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
    let fits = Options::with_radius(100.0);

    for radius in [Radius::Auto, Radius::Exponent(3.0)] {
        let error = merge(&[part()], FRONT, &Options::default().radius(radius)).unwrap_err();
        assert_eq!((error, error.code()), (Error::MergeRadius, "option"));
        assert!(error.to_string().contains("radius"));
    }
    let farthest = PointCloud::new(&[[0.0, 0.0, -95.5]]).unwrap();
    let farthest = farthest.auto_radius(FRONT, Radius::Auto).unwrap().radius;
    let far = (vec![[0.0, 0.0, -95.5]], vec![77]);
    let error = merge(&[part(), far], FRONT, &fits).unwrap_err();
    let expected = Error::RadiusTooSmall {
        radius: 100.0,
        farthest,
    };
    assert_eq!((error, error.code()), (expected, "radius"));

    let short = (points.clone(), vec![1, 2, 3]);
    let error = merge(&[part(), short], FRONT, &fits).unwrap_err();
    let expected = Error::IdsLength {
        part: 1,
        positions: 20,
        ids: 3,
    };
    assert_eq!((error, error.code()), (expected, "positions-length"));
    assert!(error.to_string().contains("part 1"));

    let broken = (vec![[f64::NAN; 3]], vec![5]);
    let error = merge(&[part(), broken], FRONT, &fits).unwrap_err();
    let expected = Error::NonFinite {
        count: 1,
        first: 20,
    };
    assert_eq!(error, expected);

    let error = merge(&[part()], [f64::NAN; 3], &fits).unwrap_err();
    assert_eq!(error.code(), "viewpoint");
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        let error = merge::<[f64; 3]>(&[], FRONT, &Options::with_radius(bad)).unwrap_err();
        assert_eq!(error.code(), "radius");
    }
}

#[test]
fn ids_beyond_32_bits_come_back_ascending_and_once() {
    let mut rng = Rng::new(11);
    let points = shapes::bumpy(&mut rng, 600);
    let options = Options::with_radius(80.0);
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
