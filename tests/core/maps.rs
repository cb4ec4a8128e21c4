//! Maps of directions never hide a visible point, whatever was asked before.

use hidden_point_removal::{
    Error, Exponential, Inversion, MapOptions, Options, PointCloud, Visibility, VisibilityMap,
};

use crate::common::rng::Rng;
use crate::common::scenes::KINDS;
use crate::common::shapes;
use crate::test;

fn small() -> MapOptions {
    MapOptions {
        points: 300,
        ..MapOptions::default()
    }
}

/// The share of the hidden points that a map hides. It must hide no visible one.
#[track_caller]
fn share(points: &[[f64; 3]], seen: &Visibility, map: &VisibilityMap, title: &str) -> f64 {
    let mask = seen.mask();
    let [mut hidden, mut found] = [0.0; 2];
    for (point, visible) in points.iter().zip(mask) {
        let hides = map.hides(*point);
        assert!(!(hides && visible == 1), "{title}: {point:?}");
        hidden += f64::from(1 - visible);
        found += f64::from(u8::from(hides));
    }
    found / f64::max(hidden, 1.0)
}

#[test]
fn a_map_hides_no_visible_point() {
    let kernels = [
        Inversion::Spherical,
        Inversion::Power(1.5),
        Inversion::Power(6.0),
        Inversion::Exponential(Exponential::Auto),
    ];
    let mut hidden = 0.0;
    for kind in KINDS {
        for (seed, n) in [(1, 9), (2, 60), (3, 700), (4, 3000)] {
            let scene = kind.scene(seed, n);
            let Ok(cloud) = PointCloud::new(&scene.points) else {
                continue;
            };
            let mut observer = cloud.observer();
            for inversion in kernels {
                let options = match inversion {
                    Inversion::Spherical => scene.options,
                    inversion => Options::inversion(inversion),
                };
                for map in [small(), MapOptions::default()] {
                    let Ok(seen) = cloud.visible_from(scene.viewpoint, &options) else {
                        continue;
                    };
                    let made = observer.visibility_map(scene.viewpoint, &options, &map);
                    let made = match made {
                        Err(Error::Excludes { .. }) => continue,
                        made => made.unwrap(),
                    };
                    let title = format!("{} with seed {seed}, {inversion:?}", kind.name);
                    hidden += share(&scene.points, &seen, &made, &title);
                }
            }
        }
    }
    assert!(hidden > 10.0, "the maps hide something: {hidden}");
}

#[test]
fn a_map_that_follows_a_viewpoint_hides_most() {
    let points = shapes::bumpy(&mut Rng::new(5), 40_000);
    let cloud = PointCloud::new(&points).unwrap();
    let options = Options::exponent(3.0);
    let map = MapOptions::default();
    let mut observer = cloud.observer();
    for step in 0..12 {
        let angle = f64::from(step) * 0.035;
        let viewpoint = [4.0 * angle.sin(), 0.7, 4.0 * angle.cos()];
        let seen = cloud.visible_from(viewpoint, &options).unwrap();
        let made = observer.visibility_map(viewpoint, &options, &map).unwrap();
        let share = share(&points, &seen, &made, "an orbit");
        assert!(step < 2 || share > 0.85, "step {step}: {share}");
    }
}

/// From a scanner's place, where c grows with the distance, and from elsewhere.
#[test]
fn a_map_of_looks_hides_hardly_a_point_that_they_show() {
    let mut rng = Rng::new(6);
    let points: Vec<[f64; 3]> = (0..40_000)
        .map(|_| {
            let ahead = rng.direction();
            let walls = [9.0, 6.0, 2.0].into_iter().zip(ahead);
            let wall = walls.fold(1e9, |least: f64, (x, d)| least.min(x / d.abs()));
            let is_box = ahead[0] > 0.9 && rng.chance(2);
            let range = if is_box { 3.0 / ahead[0] } else { wall };
            ahead.map(|x| x * range)
        })
        .collect();
    hides_hardly_wrong(
        &points,
        &Options::looks(3),
        &[[0.1, 0.0, 0.1], [-6.0, 1.0, 0.5]],
    );
}

#[test]
fn with_a_thickness_a_map_hides_a_far_side() {
    let points = shapes::bumpy(&mut Rng::new(8), 60_000);
    for thickness in [0.02, 0.1] {
        let options = Options::looks(3).with_thickness(thickness);
        hides_hardly_wrong(&points, &options, &[[0.0, 0.7, 4.0], [3.0, 0.5, 0.2]]);
    }
}

/// A map hides a tenth of what looks hide, and at most 1 % of what they show.
#[track_caller]
fn hides_hardly_wrong(points: &[[f64; 3]], options: &Options, viewpoints: &[[f64; 3]]) {
    let cloud = PointCloud::new(points).unwrap();
    let [mut hidden, mut found] = [0, 0];
    for &viewpoint in viewpoints {
        let seen = cloud.visible_from(viewpoint, options).unwrap();
        let map = cloud.visibility_map(viewpoint, options, &MapOptions::default());
        let map = map.unwrap();
        let mut wrong = 0;
        for (point, visible) in points.iter().zip(seen.mask()) {
            hidden += usize::from(visible == 0);
            found += usize::from(visible == 0 && map.hides(*point));
            wrong += usize::from(visible == 1 && map.hides(*point));
        }
        let shown = seen.indices().len();
        assert!(100 * wrong <= shown, "{wrong} of {shown}");
    }
    assert!(10 * found > hidden, "{found} of {hidden}");
}

#[test]
fn far_from_0_an_origin_keeps_a_map_sharp() {
    let place = [452_000.0, 5_411_000.0, 300.0];
    let points: Vec<[f64; 3]> = shapes::bumpy(&mut Rng::new(7), 20_000)
        .into_iter()
        .map(|p| core::array::from_fn(|axis| p[axis] + place[axis]))
        .collect();
    let cloud = PointCloud::new(&points).unwrap();
    let viewpoint = [place[0] + 4.0, place[1], place[2] + 1.0];
    let seen = cloud.visible_from(viewpoint, &Options::default()).unwrap();
    let at = |origin| {
        let map = MapOptions {
            origin,
            ..MapOptions::default()
        };
        let made = cloud.visibility_map(viewpoint, &Options::default(), &map);
        share(&points, &seen, &made.unwrap(), "map coordinates")
    };
    assert!(at(None) > 0.6, "{}", at(None));
    // In single precision, a place is known to half a unit there.
    assert!(at(Some([0.0; 3])) < 0.6);
}

#[test]
fn where_a_map_knows_nothing_no_distance_is_hidden() {
    let points: Vec<[f64; 3]> = (shapes::bumpy(&mut Rng::new(3), 20_000).into_iter())
        .filter(|p| p[2] > 0.5 || p[0] > 0.8)
        .collect();
    let cloud = PointCloud::new(&points).unwrap();
    let (from, options) = ([0.0, 0.0, 4.0], Options::exponent(3.0));
    let map = cloud.visibility_map(from, &options, &small()).unwrap();
    let mut rng = Rng::new(4);
    let mut open = 0;
    for _ in 0..20_000 {
        let ahead = rng.direction();
        let at = |distance: f64| core::array::from_fn(|axis| from[axis] + distance * ahead[axis]);
        if !map.hides(at(1e14)) {
            open += 1;
            for distance in [1e29, 1e31, 1e35, 1e38, 1e39] {
                assert!(!map.hides(at(distance)), "{ahead:?}, {distance}");
            }
        }
    }
    assert!(open > 1000 && open < 20_000, "{open}");
}

#[test]
fn a_map_towards_some_directions_is_of_these() {
    let points = shapes::room(&mut Rng::new(9), 30_000);
    let cloud = PointCloud::new(&points).unwrap();
    let viewpoint = [-2.0, -1.5, 0.1];
    let options = Options::exponent(2.5);
    let seen = cloud.visible_from(viewpoint, &options).unwrap();
    let ahead = |p: &[f64; 3]| {
        let v: Vec<f64> = (0..3).map(|axis| p[axis] - viewpoint[axis]).collect();
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        (v[0] + v[1]) / (length * 2.0f64.sqrt()) > 30.0f64.to_radians().cos()
    };
    let near: Vec<[f64; 3]> = points.iter().copied().filter(ahead).collect();
    let found = |towards| {
        let map = MapOptions {
            points: 4000,
            towards,
            ..MapOptions::default()
        };
        let made = cloud.visibility_map(viewpoint, &options, &map).unwrap();
        share(&points, &seen, &made, "towards");
        near.iter().filter(|&&p| made.hides(p)).count()
    };
    let (all, some) = (found(None), found(Some(([1.0, 1.0, 0.0], 60.0))));
    assert!(some > all, "{some} against {all}");
}

#[test]
fn wrong_maps_are_refused() {
    let cloud = PointCloud::new(&[[0.0, 0.0, 1.0]]).unwrap();
    let refused = |map: MapOptions| {
        let made = cloud.visibility_map([0.0; 3], &Options::default(), &map);
        made.map(|_| ()).unwrap_err().code()
    };
    let map = MapOptions::default();
    assert_eq!(refused(MapOptions { points: 1, ..map }), "option");
    for (direction, angle) in [([1.0, 0.0, 0.0], 0.0), ([1.0, 0.0, 0.0], f64::NAN)] {
        let towards = Some((direction, angle));
        assert_eq!(refused(MapOptions { towards, ..map }), "option");
    }
    let towards = Some(([0.0; 3], 60.0));
    assert_eq!(refused(MapOptions { towards, ..map }), "viewpoint");
    let origin = Some([f64::NAN; 3]);
    assert_eq!(refused(MapOptions { origin, ..map }), "viewpoint");
}
