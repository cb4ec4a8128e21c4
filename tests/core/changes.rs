//! Appending and removing. After any changes a cloud gives, to the bit, the answers of a
//! cloud built from its present points.

use hidden_point_removal::{ChosenRadius, NonFinite, Options, PointCloud, Position, Radius};

use crate::common::rng::Rng;
use crate::common::scenes::{EXTREME, KINDS};
use crate::common::{refused, shapes};
use crate::test;

const NAN: f64 = f64::NAN;
const FRONT: [f64; 3] = [0.0, 0.0, 5.0];

const FAR: [[f64; 3]; 3] = [[3.0, 0.0, 0.0], [-1e3, 1e9, 0.5], [1e150, -1e140, 1.0]];

/// A cloud, and the point that belongs to each index that the cloud ever gave out.
struct Changed {
    cloud: PointCloud,
    present: Vec<Option<[f64; 3]>>,
}

impl Changed {
    fn new<P: Position>(points: &[P]) -> Self {
        Self {
            cloud: PointCloud::new(points).unwrap(),
            present: points.iter().map(|p| Some(p.widen())).collect(),
        }
    }

    fn append<P: Position>(&mut self, points: &[P]) {
        self.cloud.append(points).unwrap();
        self.present.extend(points.iter().map(|p| Some(p.widen())));
    }

    fn remove(&mut self, indices: &[u32]) {
        self.cloud.remove(indices).unwrap();
        for &index in indices {
            self.present[index as usize] = None;
        }
    }

    fn check(&self, viewpoint: [f64; 3], options: &Options, title: &str) {
        let (indices, points): (Vec<u32>, Vec<[f64; 3]>) = (0..)
            .zip(&self.present)
            .filter_map(|(index, point)| point.map(|p| (index, p)))
            .unzip();
        let fresh = PointCloud::new(&points).unwrap();
        assert_eq!(self.cloud.len(), self.present.len(), "{title}");
        let bits = |chosen: ChosenRadius| (chosen.radius.to_bits(), chosen.exponent.to_bits());
        assert_eq!(
            self.cloud.auto_radius(viewpoint, Radius::Auto).map(bits),
            fresh.auto_radius(viewpoint, Radius::Auto).map(bits),
            "{title}"
        );
        let answer = self.cloud.visible_from(viewpoint, options);
        let expected = fresh.visible_from(viewpoint, options);
        let seen = answer.as_ref().map(|answer| answer.indices().to_vec());
        let expected = expected.as_ref().map(|answer| {
            let seen = answer.indices().iter();
            seen.map(|&k| indices[k as usize]).collect::<Vec<_>>()
        });
        assert_eq!(seen, expected, "{title}");
        if let Ok(answer) = answer {
            assert_eq!(answer.mask().len(), self.present.len(), "{title}");
        }
    }

    /// Some of the indices that the cloud ever gave out, sometimes with one of them twice.
    fn some_indices(&self, rng: &mut Rng) -> Vec<u32> {
        let count = rng.below(self.present.len() / 2 + 1);
        (0..count)
            .map(|_| rng.below(self.present.len()) as u32)
            .collect()
    }
}

#[test]
fn any_history_is_as_if_it_had_never_been() {
    for kind in KINDS.iter().chain(EXTREME) {
        for (seed, n) in [(1, 12), (2, 40), (3, 300)] {
            let scene = kind.scene(seed, n);
            let mut rng = Rng::new(seed);
            let mut rest = &scene.points[..];
            let mut take = |rng: &mut Rng| {
                let (taken, left) = rest.split_at(rng.below(rest.len() + 1));
                rest = left;
                taken
            };
            let mut changed = Changed::new(take(&mut rng));
            for step in 0..12 {
                match rng.below(7) {
                    0 | 1 => changed.append(take(&mut rng)),
                    2 => {
                        let narrow = take(&mut rng).iter().map(|p| p.map(|x| x as f32));
                        let narrow: Vec<_> =
                            narrow.filter(|p| p.iter().all(|x| x.is_finite())).collect();
                        changed.append(&narrow);
                    }
                    // One point comes from far away, or all go.
                    3 => changed.append(&[rng.pick(&FAR)]),
                    4 => changed.remove(&(0..changed.present.len() as u32).collect::<Vec<_>>()),
                    5 if !changed.present.is_empty() => {
                        let indices = changed.some_indices(&mut rng);
                        changed.remove(&indices);
                    }
                    _ => {
                        // Points that are in the cloud already, and points that were removed.
                        let again: Vec<_> = (0..n / 3).map(|_| rng.pick(&scene.points)).collect();
                        changed.append(&again);
                    }
                }
                let title = format!("{} with seed {seed}, step {step}", kind.name);
                changed.check(scene.viewpoint, &scene.options, &title);
            }
        }
    }
}

#[test]
fn what_is_not_finite_is_skipped_or_refused_as_the_cloud_was_told() {
    let mut skipping = PointCloud::with_non_finite(&[[NAN; 3], FRONT], NonFinite::Skip).unwrap();
    skipping
        .append(&[[1.0, 0.0, 0.0], [NAN, 0.0, 0.0]])
        .unwrap();
    skipping.append(&[[f64::INFINITY; 3]; 2]).unwrap();
    assert_eq!((skipping.len(), skipping.skipped()), (6, 4));
    skipping.remove(&[0, 3, 1]).unwrap();
    let answer = skipping.visible_from(FRONT, &Options::default()).unwrap();
    assert_eq!(answer.mask(), [0, 0, 1, 0, 0, 0]);
    assert_eq!((skipping.len(), skipping.skipped()), (6, 4));

    let mut strict = PointCloud::new(&[FRONT]).unwrap();
    let spoiled = strict.append(&[FRONT, [NAN; 3], [0.0, NAN, 0.0]]);
    refused("non-finite", "2 point(s)", spoiled);
    assert_eq!((strict.len(), strict.skipped()), (1, 0));
}

#[test]
fn a_refused_change_changes_nothing() {
    let points = shapes::bumpy(&mut Rng::new(10), 200);
    let mut changed = Changed::new(&points);
    for bad in [200, 201, u32::MAX] {
        let words = format!("index {bad} is out of range for a cloud of length 200");
        refused("option", &words, changed.cloud.remove(&[3, bad, 5]));
    }
    assert!(changed.cloud.append(&[[1e3; 3], [NAN; 3]]).is_err());
    changed.check(FRONT, &Options::default(), "refused");
    let options = Options::exponent(2.0);
    changed.check([0.1; 3], &options, "refused");
}

#[test]
fn positions_are_those_of_the_present_points() {
    let single = [
        [1.0f32, 2.0, 3.0],
        [f32::NAN, 0.0, 0.0],
        [1.0, 2.0, 3.0],
        [0.0; 3],
    ];
    let mut cloud = PointCloud::with_non_finite(&single, NonFinite::Skip).unwrap();
    cloud.remove(&[0]).unwrap();
    let expected = vec![None, None, Some([1.0, 2.0, 3.0]), Some([0.0; 3])];
    assert_eq!(cloud.positions(), Ok(expected.clone()));
    assert!(cloud.is_single());
    cloud.append(&[[0.1, 0.2, 0.3]]).unwrap();
    let expected = [expected, vec![Some([0.1, 0.2, 0.3])]].concat();
    assert_eq!(cloud.positions(), Ok(expected));
    assert!(!cloud.is_single());
}
