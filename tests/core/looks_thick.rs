//! Looks at measured surfaces: noise, layers of registered scans, spacing that grows with range.

use hidden_point_removal::{Options, PointCloud, Radius, Visibility};

use crate::common::rng::Rng;
use crate::common::scanner::{Scanner, normal};
use crate::test;

type Place = [f64; 3];

fn looks() -> Options {
    Options::looks(3)
}

fn thick(thickness: f64) -> Options {
    looks().with_thickness(thickness)
}

/// A sphere of radius 1, evenly sampled, with noise along its normals.
fn sphere(count: usize, noise: f64) -> Vec<Place> {
    let mut rng = Rng::new(7);
    let place = |i: usize| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (2.399_963 * i as f64).sin_cos();
        let across = (1.0 - z * z).sqrt();
        let radius = 1.0 + noise * normal(&mut rng);
        [across * cos, across * sin, z].map(|x| radius * x)
    };
    (0..count).map(place).collect()
}

/// The share of wrong answers among points that are visible, and among hidden ones, in percent.
fn wrong(seen: &Visibility, is_visible: &dyn Fn(usize) -> bool) -> [f64; 2] {
    let mut counts = [[0.0; 2]; 2];
    for (i, &seen) in seen.mask().iter().enumerate() {
        let [wrong, all] = &mut counts[usize::from(!is_visible(i))];
        *all += 1.0;
        *wrong += f64::from(u8::from((seen == 1) != is_visible(i)));
    }
    counts.map(|[wrong, all]| 100.0 * wrong / f64::max(all, 1.0))
}

#[test]
fn a_sphere_with_noise_is_seen_like_a_clean_one() {
    let count = 8000;
    let clean = sphere(count, 0.0);
    let spacing = PointCloud::new(&clean).unwrap().spacing().unwrap();
    let viewpoint = [0.3, -0.4, 3.0];
    let dot = |p: Place| p[0] * viewpoint[0] + p[1] * viewpoint[1] + p[2] * viewpoint[2];
    for (noise, lost_before) in [
        (0.05, 2.0),
        (0.07, 3.0),
        (0.1, 5.0),
        (0.3, 20.0),
        (0.5, 35.0),
        (0.7, 45.0),
        (1.0, 55.0),
    ] {
        let cloud = PointCloud::new(&sphere(count, noise * spacing)).unwrap();
        let is_visible = |i: usize| dot(clean[i]) > 1.0;
        let seen = cloud.visible_from(viewpoint, &looks()).unwrap();
        let [lost, shown] = wrong(&seen, &is_visible);
        assert!(lost <= 3.0 && shown <= 3.0, "noise {noise}: {lost} {shown}");
        let plain = cloud.visible_from(viewpoint, &thick(0.0)).unwrap();
        let [lost, _] = wrong(&plain, &is_visible);
        assert!(lost > lost_before, "noise {noise}: {lost}");
        let share = cloud.noise().unwrap() / (noise * spacing);
        assert!((0.8..1.25).contains(&share), "noise {noise}: {share}");
    }
}

#[test]
fn strays_in_front_of_a_surface_hide_little() {
    let count = 8000;
    let clean = sphere(count, 0.0);
    let spacing = PointCloud::new(&clean).unwrap().spacing().unwrap();
    let mut points = sphere(count, 0.3 * spacing);
    let mut rng = Rng::new(8);
    points.extend((0..400).map(|_| {
        let away = 1.1 + 0.5 * rng.unit();
        rng.direction().map(|x| away * x)
    }));
    let viewpoint = [0.3, -0.4, 3.0];
    let seen = PointCloud::new(&points).unwrap();
    let seen = seen.visible_from(viewpoint, &looks()).unwrap().mask();
    let faces = |p: Place| p[0] * viewpoint[0] + p[1] * viewpoint[1] + p[2] * viewpoint[2] > 1.0;
    let front = (0..count).filter(|&i| faces(clean[i]));
    let [lost, all] = front.fold([0, 0], |[lost, all], i| {
        [lost + usize::from(seen[i] == 0), all + 1]
    });
    // 18.4 % where the triangles between strays are surfaces.
    assert!(100 * lost <= 16 * all, "{lost} of {all}");
}

/// Four scans of a room, each of its own part of the walls, shifted against each other.
fn room(seed: u64) -> (Vec<Place>, Vec<bool>) {
    let mut rng = Rng::new(seed);
    let shifts: Vec<Place> = (0..4)
        .map(|_| [0; 3].map(|_| 0.03 * normal(&mut rng)))
        .collect();
    let mut points = Vec::new();
    let mut is_visible = Vec::new();
    for (scan, shift) in shifts.iter().enumerate() {
        for _ in 0..3000 {
            // Each scan sees most of the wall, and a part of what a board before it hides.
            let [x, y] = [rng.between(-1.0, 1.0), rng.between(-1.0, 1.0)];
            if (x < -0.5 && scan == 0) || (y > 0.6 && scan > 1) {
                continue;
            }
            let is_board = rng.chance(3);
            let place = if is_board {
                [0.4 * x, 0.4 * y, 1.5]
            } else {
                [x, y, 2.5]
            };
            let scale = 1.5 / 2.5;
            let is_hidden = !is_board && (x * scale).abs() < 0.38 && (y * scale).abs() < 0.38;
            points.push([0, 1, 2].map(|k| place[k] + shift[k] + 0.008 * normal(&mut rng)));
            is_visible.push(!is_hidden);
        }
    }
    (points, is_visible)
}

#[test]
fn layers_of_registered_scans_are_one_surface() {
    let (points, is_visible) = room(3);
    let cloud = PointCloud::new(&points).unwrap();
    assert!(cloud.noise().unwrap() > 0.0);
    let of = |options: &Options| {
        let seen = cloud.visible_from([0.0; 3], options).unwrap();
        wrong(&seen, &|i| is_visible[i])
    };
    let [lost_before, _] = of(&thick(0.0));
    let [lost, shown] = of(&looks());
    assert!(lost_before > 20.0, "{lost_before}");
    assert!(lost < 0.3 * lost_before && shown < 3.0, "{lost} {shown}");
    // A given thickness takes the place of the measured one.
    let [lost, shown] = of(&thick(0.15));
    assert!(lost < 0.2 * lost_before && shown < 3.0, "{lost} {shown}");
}

/// One scan of a hall, without noise.
fn scan() -> Vec<Place> {
    let scanner = Scanner {
        rings: 90,
        columns: 360,
        range_noise: 0.0,
        angle_noise: 0.0,
        beam: 0.0,
        registration: [0.0; 2],
    };
    let points = scanner.scan([0.0; 3], &mut Rng::new(1));
    points.iter().map(|point| point.place).collect()
}

#[test]
fn a_scanner_sees_its_own_points() {
    let points = scan();
    let cloud = PointCloud::new(&points).unwrap();
    let lost = |options: &Options| {
        let seen = cloud.visible_from([0.0; 3], options).unwrap();
        wrong(&seen, &|_| true)[0]
    };
    let [before, now] = [lost(&thick(0.0)), lost(&looks())];
    assert!(now < 2.0 && before > 3.0 * now, "{before} {now}");
    // From far away the same cloud is a surface like others.
    let outside = [40.0, -30.0, 25.0];
    let [plain, thick] = [thick(0.0), looks()].map(|options| {
        let seen = cloud.visible_from(outside, &options).unwrap();
        seen.into_indices()
    });
    assert_eq!(plain, thick);
}

#[test]
fn nothing_changes_where_nothing_tells_of_noise() {
    let mut rng = Rng::new(5);
    let lattice = |n: usize| (0..n).map(|i| [i % 50, i / 50 % 50, 0].map(|x| x as f64));
    let mut with_outlier = sphere(3000, 0.0);
    with_outlier.push([1e7, 0.0, 0.0]);
    let clouds: [(&str, Vec<Place>); 9] = [
        ("sphere", sphere(5000, 0.0)),
        ("outlier", with_outlier),
        ("lattice", lattice(2500).collect()),
        (
            "line",
            (0..3000).map(|i| [f64::from(i), 0.0, 0.0]).collect(),
        ),
        (
            "plane",
            (0..3000).map(|_| [rng.unit(), rng.unit(), 2.0]).collect(),
        ),
        ("equal", vec![[1.0, 2.0, 3.0]; 5000]),
        ("few", (0..24).map(|_| rng.in_ball()).collect()),
        ("one", vec![[4.0; 3]]),
        ("none", Vec::new()),
    ];
    for (name, points) in clouds {
        let cloud = PointCloud::new(&points).unwrap();
        assert_eq!(cloud.noise(), Ok(0.0), "{name}");
        let viewpoint = [3.0, -7.0, 11.0];
        let seen = cloud.visible_from(viewpoint, &looks()).unwrap();
        assert_eq!(
            seen,
            cloud.visible_from(viewpoint, &thick(0.0)).unwrap(),
            "{name}"
        );
    }
}

#[test]
fn noise_is_finite_for_any_cloud() {
    let mut rng = Rng::new(6);
    let (layers, _) = room(4);
    let mixed = |i: usize| {
        let scale = if i % 101 == 0 { 1.0 } else { 0.01 };
        rng.in_ball().map(|x| x * scale)
    };
    let clouds: [Vec<Place>; 5] = [
        (0..6000).map(mixed).collect(),
        (0..8000)
            .map(|i| [i % 20, i / 20 % 20, i / 400].map(|x| x as f64))
            .collect(),
        layers.iter().map(|p| p.map(|x| x * 1e-170)).collect(),
        layers.iter().map(|p| p.map(|x| x * 1e150)).collect(),
        layers.iter().copied().chain([[1e7, 1e7, 1e7]]).collect(),
    ];
    for (number, points) in clouds.iter().enumerate() {
        let cloud = PointCloud::new(points).unwrap();
        let noise = cloud.noise().unwrap();
        assert!((0.0..f64::INFINITY).contains(&noise), "{number}: {noise}");
        let seen = cloud.visible_from([0.1, 0.2, 0.3], &looks()).unwrap();
        assert!(seen.looks().iter().all(|c| *c > 0.0 && c.is_finite()));
    }
}

#[test]
fn neither_order_nor_duplicates_nor_slices_nor_scale_change_a_bit() {
    let mut rng = Rng::new(9);
    let (layers, _) = room(5);
    for points in [layers, sphere(6000, 0.02), scan()] {
        let cloud = PointCloud::new(&points).unwrap();
        let options = looks().with_scores(true);
        let viewpoint = [0.0, 0.0, 0.1];
        let seen = cloud.visible_from(viewpoint, &options).unwrap();

        let mut order: Vec<usize> = (0..points.len()).chain(0..40).collect();
        rng.shuffle(&mut order);
        let shuffled: Vec<Place> = order.iter().map(|&i| points[i]).collect();
        let other = PointCloud::new(&shuffled).unwrap();
        assert_eq!(other.noise(), cloud.noise());
        let answer = other.visible_from(viewpoint, &options).unwrap();
        let [mask, other_mask] = [seen.mask(), answer.mask()];
        for (k, &i) in order.iter().enumerate() {
            assert_eq!(other_mask[k], mask[i]);
            assert_eq!(answer.scores()[k].to_bits(), seen.scores()[i].to_bits());
        }

        let larger: Vec<Place> = points.iter().map(|p| p.map(|x| x * 1024.0)).collect();
        let larger = PointCloud::new(&larger).unwrap();
        assert_eq!(larger.noise().unwrap(), 1024.0 * cloud.noise().unwrap());
        let answer = larger
            .visible_from(viewpoint.map(|x| x * 1024.0), &options)
            .unwrap();
        assert_eq!(answer.indices(), seen.indices());

        let mut prepared = PointCloud::new(&points).unwrap();
        prepared.prepare_for(&options).unwrap();
        let mut observer = prepared.observer();
        while !observer.go_on(viewpoint, &options, 900).unwrap() {}
        let sliced = observer.visible_from(viewpoint, &options).unwrap();
        assert_eq!(sliced, seen);
        // Another viewpoint, and the same again.
        observer.visible_from([0.2, 0.1, 0.1], &options).unwrap();
        assert_eq!(observer.visible_from(viewpoint, &options).unwrap(), seen);
        let any = cloud.visible_from_any(&[viewpoint], &looks()).unwrap();
        assert_eq!(any.indices(), seen.indices());
    }
}

#[test]
fn a_direction_sees_noise_as_far_viewpoints_do() {
    let (points, _) = room(6);
    let cloud = PointCloud::new(&points).unwrap();
    for points in [&cloud, &PointCloud::new(&sphere(6000, 0.01)).unwrap()] {
        let along = points
            .visible_from_direction([0.0, 0.0, 1.0], &looks())
            .unwrap();
        let far = points.visible_from([0.0, 0.0, -1e5], &looks()).unwrap();
        let [along, far] = [along.mask(), far.mask()];
        let differ = along.iter().zip(&far).filter(|(a, b)| a != b);
        assert!(differ.count() < points.len() / 200);
    }
}

#[test]
fn the_automatic_radius_is_larger_for_measured_surfaces() {
    let viewpoint = [0.3, -0.4, 3.0];
    let radius = |points: &[Place]| {
        let cloud = PointCloud::new(points).unwrap();
        cloud.auto_radius(viewpoint, Radius::Auto).unwrap().radius
    };
    let clean = radius(&sphere(8000, 0.0));
    let [few, many] = [0.01, 0.03].map(|noise| radius(&sphere(8000, noise)));
    assert!(
        few > 1.1 * clean && many > 1.15 * few,
        "{clean} {few} {many}"
    );
    // Outliers have no say.
    let mut points = sphere(8000, 0.03);
    let mut rng = Rng::new(8);
    points.extend((0..160).map(|_| rng.direction().map(|x| 1.5 * x)));
    let share = radius(&points) / many;
    assert!((0.8..1.25).contains(&share), "{share}");
    // The answer and a direction use it, too.
    let cloud = PointCloud::new(&sphere(8000, 0.03)).unwrap();
    let seen = cloud.visible_from(viewpoint, &Options::default()).unwrap();
    assert_eq!(seen.radius(), many);
    let [along, clean] = [cloud, PointCloud::new(&sphere(8000, 0.0)).unwrap()].map(|cloud| {
        let seen = cloud.visible_from_direction(viewpoint, &Options::default());
        seen.unwrap().radius()
    });
    assert!(along > 1.2 * clean, "{along} {clean}");
}
