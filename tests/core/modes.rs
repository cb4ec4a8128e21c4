//! What the survey takes a cloud for, and how well its views are then, in both shares: thin shapes are not noisy,
//! and scans are not clean. Everything is made of boxes, so the truth is a ray among boxes.

use hidden_point_removal::{Options, PointCloud, Radius, Surface};

use crate::common::rng::Rng;
use crate::test;

type Place = [f64; 3];
/// The lowest and the highest corner.
type Block = [Place; 2];

fn looks() -> Options {
    Options::looks(3)
}

/// Where a ray crosses the sides of a block, as shares of `v`.
fn crossings([low, high]: &Block, from: Place, v: Place) -> Option<[f64; 2]> {
    let mut range = [f64::NEG_INFINITY, f64::INFINITY];
    for axis in 0..3 {
        let ends = [low, high].map(|end| (end[axis] - from[axis]) / v[axis]);
        range[0] = range[0].max(ends[0].min(ends[1]));
        range[1] = range[1].min(ends[0].max(ends[1]));
    }
    (range[0] <= range[1]).then_some(range)
}

/// The first crossing before the viewer, as a share of `v`.
fn first(blocks: &[Block], from: Place, v: Place) -> Option<f64> {
    let all = blocks.iter().flat_map(|block| crossings(block, from, v));
    let all = all.flatten().filter(|share| *share > 1e-9);
    all.min_by(f64::total_cmp)
}

fn between(from: Place, to: Place) -> Place {
    core::array::from_fn(|axis| to[axis] - from[axis])
}

/// Points spread evenly over the sides of blocks, by chance.
fn sampled(rng: &mut Rng, blocks: &[Block], count: usize) -> Vec<Place> {
    let mut sides = Vec::new();
    for block in blocks {
        for axis in 0..3 {
            let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
            let area = (block[1][u] - block[0][u]) * (block[1][v] - block[0][v]);
            sides.extend([0, 1].map(|end| (block, axis, end, area)));
        }
    }
    let total: f64 = sides.iter().map(|side| side.3).sum();
    let place = |_| {
        let mut at = rng.between(0.0, total);
        let chosen = sides.iter().find(|side| {
            at -= side.3;
            at < 0.0
        });
        let &(block, axis, end, _) = chosen.unwrap_or(&sides[0]);
        let mut place: Place =
            core::array::from_fn(|axis| rng.between(block[0][axis], block[1][axis]));
        place[axis] = block[end][axis];
        place
    };
    (0..count).map(place).collect()
}

/// Of the hidden points, how many percent are shown, and of the visible ones, how many are lost: means over views.
/// `places` are where the points would be without noise.
fn shares(
    points: &[Place],
    places: &[Place],
    blocks: &[Block],
    viewpoints: &[Place],
    options: &Options,
) -> [f64; 2] {
    let cloud = PointCloud::new(points).unwrap();
    let mut sums = [0.0; 2];
    for &viewpoint in viewpoints {
        let seen = cloud.visible_from(viewpoint, options).unwrap().mask();
        let mut counts = [[0.0; 2]; 2];
        for (place, seen) in places.iter().zip(seen) {
            let before = first(blocks, viewpoint, between(viewpoint, *place));
            let is_visible = before.is_none_or(|share| share > 1.0 - 1e-6);
            let [wrong, all] = &mut counts[usize::from(is_visible)];
            *all += 1.0;
            *wrong += f64::from(u8::from((seen == 1) != is_visible));
        }
        for (sum, [wrong, all]) in sums.iter_mut().zip(counts) {
            *sum += 100.0 * wrong / f64::max(all, 1.0) / viewpoints.len() as f64;
        }
    }
    sums
}

fn around(distance: f64) -> Vec<Place> {
    let mut rng = Rng::new(11);
    let mut place = || rng.direction().map(|x| distance * x);
    (0..4).map(|_| place()).collect()
}

/// A block by its middle and its size.
fn block(middle: Place, size: Place) -> Block {
    [-0.5, 0.5].map(|half| core::array::from_fn(|axis| middle[axis] + half * size[axis]))
}

fn shelf() -> Vec<Block> {
    let boards = (0..4).map(|i| block([0.0, 0.0, 0.35 * f64::from(i) - 0.5], [0.8, 0.3, 0.02]));
    let sides = [-0.4, 0.4].map(|x| block([x, 0.0, 0.025], [0.02, 0.3, 1.05]));
    boards.chain(sides).collect()
}

fn table() -> Vec<Block> {
    let legs = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];
    let legs = legs.map(|[x, y]| block([0.55 * x, 0.3 * y, 0.0], [0.06, 0.06, 0.7]));
    legs.into_iter()
        .chain([block([0.0, 0.0, 0.37], [1.2, 0.7, 0.04])])
        .collect()
}

/// Two plates, so many spacings of 8,192 points apart.
fn plates(apart: f64) -> Vec<Block> {
    let gap = 0.0156 * apart;
    [0.0, -gap]
        .map(|z| block([0.0, 0.0, z], [1.0, 1.0, 1e-6]))
        .into()
}

#[test]
fn thin_shapes_are_clean_and_hide_what_is_behind_them() {
    for (name, blocks, worst, worst_of_looks) in [
        ("shelf", shelf(), [15.0, 30.0], [22.0, 8.0]),
        ("table", table(), [16.0, 16.0], [18.0, 5.0]),
        ("plates 1 apart", plates(1.0), [15.0, 5.0], [15.0, 5.0]),
        ("plates 2 apart", plates(2.0), [15.0, 5.0], [15.0, 5.0]),
    ] {
        for (count, seed) in [(8192, 1), (8192, 2), (32_768, 3), (2048, 4)] {
            let points = sampled(&mut Rng::new(seed), &blocks, count);
            let cloud = PointCloud::new(&points).unwrap();
            assert_eq!(cloud.surface().unwrap(), Surface::Clean, "{name}, {count}");
            assert_eq!(cloud.noise().unwrap(), 0.0, "{name}, {count}");
            if count != 8192 {
                continue;
            }
            for (options, worst) in [(Options::default(), worst), (looks(), worst_of_looks)] {
                let [shown, lost] = shares(&points, &points, &blocks, &around(2.5), &options);
                assert!(
                    shown <= worst[0] && lost <= worst[1],
                    "{name}: {shown} % shown, {lost} % lost"
                );
            }
        }
    }
}

/// A room with a cupboard, a table and shelves.
fn room() -> Vec<Block> {
    let mut blocks = vec![
        block([0.0, 0.0, 1.25], [5.0, 4.0, 2.5]),
        block([-2.0, 1.2, 0.9], [0.6, 1.0, 1.8]),
        block([1.8, -1.5, 0.6], [0.9, 0.5, 1.2]),
    ];
    blocks.extend(
        table()
            .iter()
            .map(|part| part.map(|[x, y, z]| [x, y, z + 0.36])),
    );
    blocks
}

/// What a scanner at a station sees, at even angles, with noise along the rays: places with and without it.
fn scan(
    rng: &mut Rng,
    blocks: &[Block],
    station: Place,
    rows: usize,
    noise: f64,
) -> Vec<[Place; 2]> {
    let angle = |i: usize| (i as f64 + 0.5) * core::f64::consts::PI / rows as f64;
    // The rays of a column lie in one half of a plane, which meets few blocks.
    let columns: Vec<_> = (0..2 * rows)
        .map(|column| near(blocks, station, angle(column).sin_cos()))
        .collect();
    let mut seen = Vec::new();
    for row in 0..rows {
        for (column, blocks) in columns.iter().enumerate() {
            let [up, turn] = [row, column].map(angle);
            let ray = [up.sin() * turn.cos(), up.sin() * turn.sin(), up.cos()];
            let Some(range) = first(blocks, station, ray) else {
                continue;
            };
            let normal = (0..12).fold(-6.0, |sum, _| sum + rng.unit());
            let at = |range: f64| core::array::from_fn(|axis| station[axis] + range * ray[axis]);
            seen.push([at(range + noise * normal), at(range)]);
        }
    }
    seen
}

/// The blocks whose upright cylinders meet the upright half plane from the station in a direction.
fn near(blocks: &[Block], station: Place, (sin, cos): (f64, f64)) -> Vec<Block> {
    let meets = |[low, high]: &&Block| {
        let [x, y] = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]) - station[axis]);
        let radius = 0.51 * (high[0] - low[0]).hypot(high[1] - low[1]);
        (x * sin - y * cos).abs() <= radius && x * cos + y * sin >= -radius
    };
    blocks.iter().filter(meets).copied().collect()
}

/// One point in each cube.
fn thinned(points: Vec<[Place; 2]>, side: f64) -> Vec<[Place; 2]> {
    let mut cubes = std::collections::BTreeMap::new();
    for point in points {
        let cube = point[0].map(|x| (x / side).floor() as i64);
        cubes.entry(cube).or_insert(point);
    }
    cubes.into_values().collect()
}

#[test]
fn registered_scans_are_layered_and_keep_what_is_visible() {
    let blocks = room();
    let mut rng = Rng::new(21);
    let mut all = Vec::new();
    for station in [
        [0.5, 0.6, 1.4],
        [-1.0, -1.2, 1.5],
        [1.9, 1.3, 1.3],
        [-0.6, 1.1, 1.6],
    ] {
        // Poses are off by some centimeters, more than the noise of the sensor.
        let off = [0.03, 0.03, 0.03].map(|most| rng.between(-most, most));
        for [measured, place] in scan(&mut rng, &blocks, station, 150, 0.004) {
            all.push([
                core::array::from_fn(|axis| measured[axis] + off[axis]),
                place,
            ]);
        }
    }
    let all = thinned(all, 0.04);
    let [points, places] = [0, 1].map(|k| all.iter().map(|pair| pair[k]).collect::<Vec<_>>());
    let cloud = PointCloud::new(&points).unwrap();
    assert_ne!(cloud.surface().unwrap(), Surface::Clean);
    assert!(cloud.noise().unwrap() > 0.002);
    let viewpoints = [[0.3, 0.2, 1.5], [-1.5, -1.0, 1.2], [1.5, 1.0, 1.7]];
    let [shown, lost] = shares(&points, &places, &blocks, &viewpoints, &looks());
    assert!(
        shown <= 30.0 && lost <= 10.0,
        "{shown} % shown, {lost} % lost"
    );
    let clean = looks().with_surface(Surface::Clean);
    let [_, lost_as_clean] = shares(&points, &places, &blocks, &viewpoints, &clean);
    assert!(
        lost_as_clean > 2.0 * lost,
        "{lost_as_clean} % lost if clean"
    );
}

/// Flat ground with bushes: leaves at all depths.
#[test]
fn a_rough_scan_in_voxels_is_seen_from_its_own_station() {
    let mut rng = Rng::new(31);
    let mut blocks = vec![block([0.0, 0.0, -2.0], [60.0, 60.0, 0.4])];
    for _ in 0..150 {
        let [x, y] = [0, 1].map(|_| rng.between(-16.0, 16.0));
        if x.hypot(y) > 4.0 {
            for _ in 0..60 {
                let leaf = [x, y, -0.8].map(|middle| middle + rng.between(-1.2, 1.2));
                blocks.push(block(leaf, [0, 1, 2].map(|_| rng.between(0.05, 0.3))));
            }
        }
    }
    let station = [0.0, 0.0, 0.0];
    let all = thinned(scan(&mut rng, &blocks, station, 160, 0.01), 0.25);
    let points: Vec<Place> = all.iter().map(|pair| pair[0]).collect();
    let cloud = PointCloud::new(&points).unwrap();
    assert_eq!(cloud.surface().unwrap(), Surface::Layered);
    let seen = cloud.visible_from(station, &looks()).unwrap();
    let lost = 100.0 * (1.0 - seen.indices().len() as f64 / points.len() as f64);
    assert!(lost <= 12.0, "{lost} % lost");
}

/// A turned part: rings with so many corners, at their places [beside, along] the axis. All points of a ring are alike, and
/// the nearest points of each lie in its ring, which is flat but for roundings.
fn turned(corners: usize, rings: &[[f64; 2]]) -> Vec<Place> {
    let corner = |[beside, along]: [f64; 2]| {
        (0..corners).map(move |k| {
            let (sin, cos) = (core::f64::consts::TAU * k as f64 / corners as f64).sin_cos();
            [beside * cos, along, beside * sin]
        })
    };
    rings.iter().flat_map(|ring| corner(*ring)).collect()
}

/// A vase, a capsule, a ring with waves, and parts by chance.
fn turned_parts(rng: &mut Rng) -> Vec<Vec<Place>> {
    let vase = |row: usize| {
        let thin = 0.15 + 0.01 * row as f64;
        [if row % 4 == 0 { 0.5 } else { thin }, 0.2 * row as f64]
    };
    let capsule = |row: usize| {
        let (sin, cos) = (core::f64::consts::PI * (row % 13) as f64 / 26.0).sin_cos();
        let end = if row < 13 { 1.0 } else { -1.0 };
        [0.5 * cos, end * (0.75 + 0.5 * sin)]
    };
    let waves = |row: usize| {
        let (sin, cos) = (core::f64::consts::TAU * row as f64 / 12.0).sin_cos();
        [0.7 + 0.2 * cos + 0.03 * (3.0 * cos).sin(), 0.2 * sin]
    };
    let mut parts = vec![
        turned(200, &(0..16).map(vase).collect::<Vec<_>>()),
        turned(100, &(0..26).map(capsule).collect::<Vec<_>>()),
        turned(300, &(0..12).map(waves).collect::<Vec<_>>()),
    ];
    for _ in 0..3 {
        let corners = 150 + rng.below(250);
        let ring = |row: usize| [rng.between(0.2, 0.7), 0.1 * row as f64];
        parts.push(turned(corners, &(0..16).map(ring).collect::<Vec<_>>()));
    }
    parts
}

/// A turn by chance: its axes.
fn turn(rng: &mut Rng) -> [Place; 3] {
    let [a, b, c] = [0; 3].map(|_| rng.between(0.0, core::f64::consts::TAU).sin_cos());
    let about = |axis: usize, (sin, cos): (f64, f64), mut p: Place| {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        (p[u], p[v]) = (cos * p[u] - sin * p[v], sin * p[u] + cos * p[v]);
        p
    };
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    axes.map(|axis| about(2, c, about(1, b, about(0, a, axis))))
}

#[test]
fn a_cloud_that_moves_or_turns_has_the_same_views() {
    let mut rng = Rng::new(41);
    let mut noisy = |p: Place| p.map(|x| x + rng.between(-0.004, 0.004));
    let shape = |seed, blocks: &[Block], count| sampled(&mut Rng::new(seed), blocks, count);
    let mut shapes = vec![
        shape(42, &shelf(), 5000),
        shape(43, &table(), 1018),
        shape(44, &plates(1.5), 4000),
        shape(45, &shelf(), 1500),
        shape(46, &table(), 3000),
        shape(49, &plates(3.0), 6000),
    ];
    let noisy_ones = [shape(47, &table(), 6000), shape(48, &shelf(), 4000)];
    shapes.extend(noisy_ones.map(|points| points.into_iter().map(&mut noisy).collect()));
    shapes.extend(turned_parts(&mut Rng::new(51)));
    let scanned = scan(&mut rng, &room(), [0.5, 0.6, 1.4], 60, 0.004);
    shapes.push(scanned.into_iter().map(|pair| pair[0]).collect());
    let viewpoint = [0.8, -1.9, 1.4];
    let still = |unit: f64, shift: Place| {
        (
            unit,
            [0, 1, 2].map(|axis| [0, 1, 2].map(|other| f64::from(axis == other))),
            shift,
        )
    };
    let mut motions = vec![
        still(1.0, [1.0; 3]),
        still(2.0, [0.0; 3]),
        still(3.0, [0.0; 3]),
    ];
    for _ in 0..3 {
        let shift = [0; 3].map(|_| rng.between(-3.0, 3.0));
        motions.push((1.0, turn(&mut rng), shift));
    }
    for (shape, points) in shapes.iter().enumerate() {
        let ask = |change: &dyn Fn(Place) -> Place, options: &Options| {
            let points: Vec<Place> = points.iter().map(|p| change(*p)).collect();
            let cloud = PointCloud::new(&points).unwrap();
            let seen = cloud.visible_from(change(viewpoint), options).unwrap();
            (seen.radius(), seen.mask())
        };
        for options in [Options::default(), looks()] {
            let (radius, mask) = ask(&|p| p, &options);
            for (number, (unit, axes, shift)) in motions.iter().enumerate() {
                let change = |p: Place| -> Place {
                    let along =
                        |k: usize| axes[0][k] * p[0] + axes[1][k] * p[1] + axes[2][k] * p[2];
                    core::array::from_fn(|k| unit * (along(k) + shift[k]))
                };
                let (other, seen) = ask(&change, &options);
                let differ = mask
                    .iter()
                    .zip(&seen)
                    .filter(|(one, other)| one != other)
                    .count();
                assert!(
                    (other / unit - radius).abs() <= 0.01 * radius && differ * 200 <= points.len(),
                    "shape {shape}, change {number}: R {radius} and {other}, {differ} points"
                );
            }
        }
    }
}

/// Points by chance on two squares, off them by chance: by up to `off` spacings, on one half by `share` of that only.
fn rough_squares([off, share]: [f64; 2]) -> Vec<Place> {
    let mut rng = Rng::new(5);
    let place = |k: usize| {
        let [x, y] = [(); 2].map(|()| rng.between(-1.0, 1.0));
        let most = off * 0.03 * if x > 0.0 { share } else { 1.0 };
        [x, y, rng.between(-most, most) - 0.2 * (k % 2) as f64]
    };
    (0..8192).map(place).collect()
}

#[test]
fn no_radius_switches_as_noise_grows_or_gathers() {
    for sweep in [
        |k: f64| [0.04 * k, 1.0],
        |k| [0.04 * k, 0.3],
        |k| [0.6, 0.4 - 0.025 * k],
    ] {
        let mut before = None;
        for k in 0..16 {
            let cloud = PointCloud::new(&rough_squares(sweep(f64::from(k)))).unwrap();
            let chosen = cloud.auto_radius([0.3, 0.2, 2.0], Radius::Auto).unwrap();
            let step = before.map_or(0.0, |before: f64| (chosen.radius / before).ln().abs());
            assert!(step < 0.25, "{k}: {before:?}, then {chosen:?}");
            before = Some(chosen.radius);
        }
    }
}
