//! Clouds that lie in one plane or line with the viewpoint, except for rounding. Every sign
//! is in doubt, and the hull is a sliver.

use hidden_point_removal::{Options, PointCloud};

use crate::common::rng::Rng;
use crate::common::{indices_of, proved, sectors};
use crate::test;

const START: [f64; 3] = [0.3, -0.7, 1.1];
const ALONG: [f64; 3] = [1.7, 0.9, -2.3];
const ACROSS: [f64; 3] = [0.4, 1.3, 0.2];

/// START + t·ALONG + s·ACROSS. Each coordinate is rounded.
fn place(t: f64, s: f64) -> [f64; 3] {
    core::array::from_fn(|i| START[i] + t * ALONG[i] + s * ACROSS[i])
}

type Shape = fn(&mut Rng) -> [f64; 3];

const SHAPES: [(&str, Shape); 5] = [
    ("line", |rng| place(rng.between(-5.0, 5.0), 0.0)),
    ("plane", |rng| {
        place(rng.between(-5.0, 5.0), rng.between(-5.0, 5.0))
    }),
    ("arc", |rng| {
        let angle = rng.between(0.0, 6.0);
        place(libm::cos(angle), libm::sin(angle))
    }),
    ("ray from the origin", |rng| {
        let t = rng.between(1.0, 11.0);
        ALONG.map(|x| t * x)
    }),
    ("line along an axis", |rng| {
        [rng.between(0.0, 10.0), 0.1, 0.2]
    }),
];

fn viewpoints() -> [[f64; 3]; 7] {
    [
        [9.0, 8.0, 7.5],
        place(7.3, 1.1),
        place(0.3, 0.1),
        place(7.3, 0.0),
        place(0.3, 0.0),
        [0.0; 3],
        [1e6, 2e6, -1e6],
    ]
}

fn cloud(shape: Shape, seed: u64, count: usize) -> Vec<[f64; 3]> {
    let mut rng = Rng::new(seed);
    (0..count).map(|_| shape(&mut rng)).collect()
}

#[test]
fn every_point_of_thin_clouds_is_certified() {
    for (name, shape) in SHAPES {
        for (seed, count) in [(1, 12), (2, 60)] {
            let points = cloud(shape, seed, count);
            let cloud = PointCloud::new(&points).unwrap();
            for viewpoint in viewpoints() {
                for exponent in [0.5, 2.0] {
                    let options = Options::exponent(exponent);
                    let answer = cloud.visible_from(viewpoint, &options).unwrap();
                    let expected = proved(&points, viewpoint, answer.radius());
                    let what = format!("{name}, seed {seed}, from {viewpoint:?}, {exponent}");
                    assert_eq!(answer.indices(), indices_of(&expected), "{what}");
                }
            }
        }
    }
}

#[test]
fn a_few_points_off_the_plane_are_no_exception() {
    let mut points = cloud(SHAPES[1].1, 3, 60);
    points.push(place(0.0, 0.0).map(|x| x + 1e-7));
    points.push([2.0, 2.0, 2.0]);
    let cloud = PointCloud::new(&points).unwrap();
    for viewpoint in viewpoints() {
        let answer = cloud
            .visible_from(viewpoint, &Options::exponent(2.0))
            .unwrap();
        let expected = proved(&points, viewpoint, answer.radius());
        assert_eq!(answer.indices(), indices_of(&expected), "{viewpoint:?}");
    }
}

#[test]
fn thin_clouds_shared_by_threads_are_the_whole() {
    for (name, shape) in SHAPES {
        let cloud = PointCloud::new(&cloud(shape, 4, 300)).unwrap();
        for viewpoint in viewpoints() {
            let options = Options::exponent(2.0);
            let compared = sectors::compare(&cloud, viewpoint, &options, 3);
            assert_eq!(compared, Ok(()), "{name} from {viewpoint:?}");
        }
    }
}
