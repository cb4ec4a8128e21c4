//! The thickness at which scanners see the points that they measured.

use hidden_point_removal::{NonFinite, Options, PointCloud, Station, Within};

use crate::common::refused;
use crate::common::rng::Rng;
use crate::common::shapes;
use crate::test;

const CENTER: [f64; 3] = [0.0; 3];

fn looks() -> Options {
    Options::looks(3)
}

/// All points of a sphere, seen from its center.
fn all(points: &[[f64; 3]]) -> Vec<u32> {
    (0..points.len() as u32).collect()
}

#[test]
fn points_that_cannot_be_seen_do_not_count() {
    let points = shapes::sphere(&mut Rng::new(1), 3000);
    let own = all(&points);
    let station = [Station {
        viewpoint: CENTER,
        indices: &own,
    }];
    let whole = PointCloud::new(&points).unwrap();
    let expected = whole.calibrate(&station, &looks()).unwrap();
    assert_eq!((expected.thickness, expected.shown), (0.0, 0.0));
    assert_eq!(expected.recall, [1.0]);
    assert!(!expected.is_low());

    let mut removed = PointCloud::new(&points).unwrap();
    let some: Vec<u32> = own.iter().copied().step_by(20).collect();
    removed.remove(&some).unwrap();
    assert_eq!(removed.calibrate(&station, &looks()), Ok(expected.clone()));

    let gaps = points.iter().enumerate();
    let gaps: Vec<_> = gaps
        .map(|(i, &p)| if i % 20 == 0 { [f64::NAN; 3] } else { p })
        .collect();
    let skipped = PointCloud::with_non_finite(&gaps, NonFinite::Skip).unwrap();
    assert_eq!(skipped.calibrate(&station, &looks()), Ok(expected.clone()));

    let part = looks().with_within(Within {
        distance: None,
        bounds: Some([[-1.0; 3], [1.0, 1.0, 0.9]]),
    });
    assert_eq!(whole.calibrate(&station, &part), Ok(expected));
}

/// Two scans of a ball before a wall: each has the sides that face its station, and noise.
#[test]
fn a_thickness_that_shows_what_is_behind_is_too_large() {
    let mut rng = Rng::new(2);
    let stations = [[0.0, 0.0, 6.0], [6.0, 0.0, 0.0]];
    let mut points: Vec<[f64; 3]> = Vec::new();
    let mut own = [Vec::new(), Vec::new()];
    for (station, own) in stations.iter().zip(&mut own) {
        let mut add = |p: [f64; 3]| {
            own.push(points.len() as u32);
            points.push(p.map(|x| x + 0.02 * (rng.unit() + rng.unit() + rng.unit() - 1.5)));
        };
        for p in shapes::sphere(&mut Rng::new(3), 12_000) {
            let faces: f64 = (0..3).map(|i| p[i] * (station[i] - p[i])).sum();
            if faces > 0.0 {
                add(p);
            }
        }
    }
    let cloud = PointCloud::new(&points).unwrap();
    let spacing = cloud.spacing().unwrap();
    let asked: Vec<Station> = stations
        .iter()
        .zip(&own)
        .map(|(&viewpoint, indices)| Station { viewpoint, indices })
        .collect();
    let found = cloud.calibrate(&asked, &looks()).unwrap();
    assert!(found.thickness < 16.0 * spacing, "{found:?}");
    assert!(found.recall.iter().all(|&share| share > 0.9), "{found:?}");
    assert!(!found.is_low());
    // Half of the other scan is behind the ball.
    assert!(found.shown < 0.5, "{found:?}");
    // The thickness is that of a view.
    for (station, share) in asked.iter().zip(&found.recall) {
        let options = looks().with_thickness(found.thickness);
        let mask = cloud
            .visible_from(station.viewpoint, &options)
            .unwrap()
            .mask();
        let seen = station.indices.iter().filter(|&&i| mask[i as usize] == 1);
        assert_eq!(seen.count() as f64 / station.indices.len() as f64, *share);
    }
    // A given thickness is only measured, and a huge one shows all.
    let huge = cloud
        .calibrate(&asked, &looks().with_thickness(1e3))
        .unwrap();
    assert_eq!((huge.thickness, huge.shown), (1e3, 1.0));
}

/// A scanner that sees through a net measures the wall behind it. No thickness helps until it reaches from the net to
/// the wall.
#[test]
fn the_search_goes_on_where_some_doublings_bring_nothing() {
    let mut rng = Rng::new(4);
    let mut sheet = |z: f64| -> Vec<[f64; 3]> {
        let place = |_| [rng.between(-20.0, 20.0), rng.between(-20.0, 20.0), z];
        (0..1600).map(place).collect()
    };
    let points = [sheet(20.0), sheet(60.0)].concat();
    let own = all(&points);
    let station = [Station {
        viewpoint: CENTER,
        indices: &own,
    }];
    let cloud = PointCloud::new(&points).unwrap();
    let found = cloud.calibrate(&station, &looks()).unwrap();
    assert!((20.0..200.0).contains(&found.thickness), "{found:?}");
    assert!(found.recall[0] > 0.9, "{found:?}");
}

#[test]
fn what_does_not_fit_is_refused() {
    let cloud = PointCloud::new(&[[0.0, 0.0, 1.0]; 3]).unwrap();
    let ask = |indices, options: &Options| {
        let viewpoint = CENTER;
        cloud.calibrate(&[Station { viewpoint, indices }], options)
    };
    refused("option", "index 3", ask(&[3], &looks()));
    refused("option", "without looks", ask(&[0], &Options::default()));
    refused(
        "option",
        "thickness",
        ask(&[0], &looks().with_thickness(-1.0)),
    );
    assert_eq!(ask(&[], &looks()).unwrap().recall, [1.0]);
    assert!(cloud.calibrate(&[], &looks()).unwrap().recall.is_empty());
}
