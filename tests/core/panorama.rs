//! Panoramas of shapes whose ranges and areas have a closed form.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use hidden_point_removal::{
    Exponential, Inversion, Options, Panorama, PanoramaOptions, PointCloud,
};

use crate::common::refused;
use crate::common::rng::Rng;
use crate::test;

const HALF: [f64; 3] = [2.0, 1.5, 1.25];
const INSIDE: [f64; 3] = [0.5, -0.3, 0.2];
const SIZE: PanoramaOptions = PanoramaOptions {
    width: 256,
    height: 128,
    up: [0.0, 0.0, 1.0],
};

/// Random points on the walls of a box, evenly; with a roof or without.
fn room(count: usize, has_roof: bool) -> Vec<[f64; 3]> {
    let mut rng = Rng::new(7);
    let mut points = Vec::new();
    let density = count as f64 / 59.0;
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for side in [-1.0, 1.0] {
            if !has_roof && axis == 2 && side > 0.0 {
                continue;
            }
            for _ in 0..(4.0 * HALF[u] * HALF[v] * density) as usize {
                let mut point = [0.0; 3];
                point[axis] = side * HALF[axis];
                point[u] = HALF[u] * (2.0 * rng.unit() - 1.0);
                point[v] = HALF[v] * (2.0 * rng.unit() - 1.0);
                points.push(point);
            }
        }
    }
    points
}

/// Points on the walls and the floor of the box, with its edges: so many steps along the longest.
fn lattice(steps: usize) -> Vec<[f64; 3]> {
    let count = HALF.map(|half| (half * steps as f64 / HALF[0]).round() as usize);
    let mut points = Vec::new();
    for (i, j, k) in (0..=count[0])
        .flat_map(|i| (0..=count[1]).flat_map(move |j| (0..=count[2]).map(move |k| (i, j, k))))
    {
        if i % count[0] == 0 || j % count[1] == 0 || k == 0 {
            let at = [i, j, k];
            points.push(
                [0, 1, 2]
                    .map(|axis| HALF[axis] * (2.0 * at[axis] as f64 / count[axis] as f64 - 1.0)),
            );
        }
    }
    points
}

fn ways() -> [Options; 3] {
    [
        Options::default(),
        Options::inversion(Inversion::Exponential(Exponential::Auto)),
        Options::looks(3),
    ]
}

fn seen(points: &[[f64; 3]], from: [f64; 3], options: &Options) -> Panorama {
    let cloud = PointCloud::new(points).unwrap();
    cloud.panorama(from, options, &SIZE).unwrap()
}

/// The direction of a pixel for the usual up.
fn direction(pixel: usize) -> [f64; 3] {
    let (row, column) = (pixel / SIZE.width, pixel % SIZE.width);
    let elevation = FRAC_PI_2 - PI * (row as f64 + 0.5) / SIZE.height as f64;
    let azimuth = TAU * column as f64 / SIZE.width as f64;
    let across = elevation.cos();
    [
        across * azimuth.cos(),
        across * azimuth.sin(),
        elevation.sin(),
    ]
}

/// The sum of the pixels' solid angles that are surface.
fn covered(panorama: &Panorama) -> f64 {
    let pixel = TAU / SIZE.width as f64;
    let cosine = |edge: usize| (PI * edge as f64 / SIZE.height as f64).cos();
    let rows = panorama.indices.chunks(SIZE.width).enumerate();
    rows.map(|(row, indices)| {
        let surface = indices.iter().filter(|&&index| index != Panorama::SKY);
        surface.count() as f64 * pixel * (cosine(row) - cosine(row + 1))
    })
    .sum()
}

#[track_caller]
fn close(found: f64, expected: f64, share: f64) {
    let error = (found - expected).abs();
    assert!(error <= share * expected, "{found}, not {expected}");
}

#[test]
fn in_a_box_every_direction_is_wall() {
    let points = room(20_000, true);
    for options in ways() {
        let panorama = seen(&points, INSIDE, &options);
        close(panorama.solid_angle, 4.0 * PI, 1e-9);
        assert!(panorama.sky_view_factor < 1e-9);
        let mut errors = Vec::new();
        for (pixel, &range) in panorama.ranges.iter().enumerate() {
            let d = direction(pixel);
            let wall = |axis: usize| {
                let wall = HALF[axis].copysign(d[axis]) - INSIDE[axis];
                if d[axis] == 0.0 {
                    f64::INFINITY
                } else {
                    wall / d[axis]
                }
            };
            let expected = wall(0).min(wall(1)).min(wall(2));
            errors.push((f64::from(range) / expected - 1.0).abs());

            // Its point is within some spacings of where the ray ends.
            let point = points[panorama.indices[pixel] as usize];
            let beside = (0..3).map(|axis| INSIDE[axis] + expected * d[axis] - point[axis]);
            assert!(beside.map(|x| x * x).sum::<f64>() < 0.4 * 0.4);
        }
        errors.sort_by(f64::total_cmp);
        // Only the triangles that cut an edge of the room are off.
        assert!(errors[errors.len() / 2] < 1e-6, "{errors:?}");
        assert!(errors[errors.len() * 99 / 100] < 0.01);
        assert!(errors[errors.len() - 1] < 0.1);
    }
}

#[test]
fn an_open_box_shows_the_sky() {
    // A rectangle of x by y seen from below its corner.
    let h = HALF[2] - INSIDE[2];
    let corners = [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|y| [x, y]));
    let (mut factor, mut solid_angle) = (0.0, 4.0 * PI);
    for [x, y] in corners.into_iter().flatten() {
        let (x, y) = ((HALF[0] - x * INSIDE[0]) / h, (HALF[1] - y * INSIDE[1]) / h);
        let (a, b) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
        factor += (x / a * (y / a).atan() + y / b * (x / b).atan()) / TAU;
        solid_angle -= (x * y / (1.0 + x * x + y * y).sqrt()).atan();
    }
    for options in ways() {
        let panorama = seen(&room(20_000, false), INSIDE, &options);
        close(panorama.sky_view_factor, factor, 0.01);
        close(panorama.solid_angle, solid_angle, 0.01);
        close(covered(&panorama), panorama.solid_angle, 0.005);
        assert_eq!(panorama.indices[0], Panorama::SKY);
        assert_eq!(panorama.ranges[0], f32::INFINITY);
        // A coarse lattice closes little of its corners: 1.2 % too much of the sphere was surface.
        let panorama = seen(&lattice(20), INSIDE, &options);
        close(panorama.sky_view_factor, factor, 0.01);
        close(panorama.solid_angle, solid_angle, 0.005);
    }
}

#[test]
fn a_point_alone_in_the_sky_does_not_close_it() {
    let mut points = room(20_000, false);
    let before = seen(&points, INSIDE, &Options::default());
    points.push([0.7, 0.1, 6.0]);
    let after = seen(&points, INSIDE, &Options::default());
    close(after.sky_view_factor, before.sky_view_factor, 0.005);
}

#[test]
fn the_axes_may_change_places() {
    let points = room(5000, false);
    let usual = seen(&points, INSIDE, &Options::default());
    // With +x up, column 0 looks along +y.
    let turned: Vec<_> = points.iter().map(|&[x, y, z]| [z, x, y]).collect();
    let [x, y, z] = INSIDE;
    let up = [7.0, 0.0, 0.0];
    let cloud = PointCloud::new(&turned).unwrap();
    let options = Options::default();
    let found = cloud
        .panorama([z, x, y], &options, &PanoramaOptions { up, ..SIZE })
        .unwrap();
    close(found.sky_view_factor, usual.sky_view_factor, 1e-9);
    close(found.solid_angle, usual.solid_angle, 1e-9);
    let same = |(a, b): (&u32, &u32)| a == b;
    let pixels = found.indices.iter().zip(&usual.indices);
    assert!(pixels.filter(|&pair| same(pair)).count() > SIZE.width * SIZE.height * 999 / 1000);

    // A tilt moves the horizon, but no area of the sphere.
    let up = [0.3, 0.2, 1.0];
    let tilted = PointCloud::new(&points).unwrap();
    let tilted = tilted
        .panorama(INSIDE, &options, &PanoramaOptions { up, ..SIZE })
        .unwrap();
    close(tilted.solid_angle, usual.solid_angle, 1e-12);
    close(covered(&tilted), usual.solid_angle, 0.005);
    assert!(tilted.sky_view_factor < usual.sky_view_factor - 0.01);
}

#[test]
fn neither_order_nor_duplicates_nor_units_change_it() {
    let points = room(3000, false);
    let usual = seen(&points, INSIDE, &Options::default());
    let count = points.len() as u32;
    let mut turned: Vec<_> = points.iter().rev().copied().collect();
    turned.extend_from_slice(&points[..500]);
    let found = seen(&turned, INSIDE, &Options::default());
    assert_eq!(found.ranges, usual.ranges);
    assert_eq!(found.solid_angle, usual.solid_angle);
    for (&index, &before) in found.indices.iter().zip(&usual.indices) {
        // The lowest of equal points.
        let expected = if before == Panorama::SKY {
            before
        } else {
            count - 1 - before
        };
        assert_eq!(index, expected);
    }
    for unit in [2f64.powi(-90), 2f64.powi(90)] {
        let scaled: Vec<_> = points.iter().map(|p| p.map(|x| x * unit)).collect();
        let found = seen(&scaled, INSIDE.map(|x| x * unit), &Options::default());
        assert_eq!(found.indices, usual.indices);
        assert_eq!(found.sky_view_factor, usual.sky_view_factor);
    }
}

/// Small clouds from places in their planes, between two points or beside them.
#[test]
fn the_areas_are_those_of_the_pixels() {
    let mut rng = Rng::new(11);
    // A viewpoint between two visible points and beside a third one: rounded directions lost .5 % of the area.
    let points = vec![
        [-1.2135254915624212, -0.25, -0.3454915028125263],
        [0.8090169943749475, 0.5, -1.3090169943749475],
        [0.0, 1.0, -1.618033988749895],
        [1.0786893258332633, 0.3333333333333333, 1.2060113295832984],
    ];
    let from = [
        0.9438531601041054,
        0.41666666666666663,
        -0.05150283239582454,
    ];
    areas_are_those_of_pixels(&points, from, &Options::exponent(2.0), 1024);
    // Half of the sphere, with a part of the horizon of 180 degrees.
    let points = [
        [2.0, -1.0, 0.0],
        [-1.0, 2.0, 3.0],
        [-2.0, -2.0, -6.0],
        [-1.0, 0.0, -1.0],
        [-3.0, -2.0, -7.0],
        [-2.0, 3.0, 4.0],
        [1.0, 0.0, 1.0],
        [3.0, 1.0, 5.0],
    ];
    areas_are_those_of_pixels(&points, points[1], &Options::default(), 128);
    for round in 0..300 {
        let whole = |rng: &mut Rng| [0; 3].map(|_| f64::from(rng.integer(-4, 4)));
        let mut points: Vec<_> = (0..4 + rng.below(8)).map(|_| whole(&mut rng)).collect();
        let from = match round % 3 {
            0 => whole(&mut rng),
            1 => {
                let [a, b] = [rng.pick(&points), rng.pick(&points)];
                core::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]))
            }
            _ => [0; 3].map(|_| rng.between(-4.0, 4.0)),
        };
        let unit = 2f64.powi(rng.integer(-100, 100));
        points.iter_mut().for_each(|p| *p = p.map(|x| x * unit));
        let options = match rng.below(3) {
            0 => Options::default(),
            1 => Options::exponent(2.0),
            _ => Options::inversion(Inversion::Exponential(Exponential::Auto)),
        };
        let from = from.map(|x| x * unit);
        areas_are_those_of_pixels(&points, from, &options, 128);
    }
}

#[track_caller]
fn areas_are_those_of_pixels(
    points: &[[f64; 3]],
    from: [f64; 3],
    options: &Options,
    height: usize,
) {
    let width = 2 * height;
    let size = PanoramaOptions {
        width,
        height,
        ..SIZE
    };
    let cloud = PointCloud::new(points).unwrap();
    let panorama = cloud.panorama(from, options, &size).unwrap();
    let title = format!("{from:?}, {points:?}, {options:?}");
    assert!(panorama.solid_angle <= 4.0 * PI, "{title}");
    let [mut solid_angle, mut sky] = [0.0; 2];
    for (row, indices) in panorama.indices.chunks(width).enumerate() {
        let angle = |edge: usize| PI * edge as f64 / height as f64;
        let is_sky = |&&index: &&u32| index == Panorama::SKY;
        let share = indices.iter().filter(is_sky).count() as f64 / width as f64;
        solid_angle += TAU * (1.0 - share) * (angle(row).cos() - angle(row + 1).cos());
        if row < height / 2 {
            sky += share * (angle(row + 1).sin().powi(2) - angle(row).sin().powi(2));
        }
    }
    let errors = [
        solid_angle - panorama.solid_angle,
        sky - panorama.sky_view_factor,
    ];
    // A border of half the sphere cuts so many pixels.
    let cut = 8.0 / height as f64;
    assert!(
        errors[0].abs() < cut && errors[1].abs() < 0.25 * cut,
        "{errors:?} at {title}"
    );
}

/// Each pixel against all triangles between visible points, in any unit.
#[test]
fn each_pixel_is_that_of_the_triangle_around_its_ray() {
    let mut rng = Rng::new(12);
    let [mut surfaces, mut skies] = [0; 2];
    for _ in 0..400 {
        let unit = 2f64.powi(rng.integer(-100, 100));
        let far = |rng: &mut Rng| [0; 3].map(|_| rng.between(-unit, unit));
        let mut points: Vec<_> = (0..5 + rng.below(7)).map(|_| far(&mut rng)).collect();
        if rng.chance(2) {
            // Patches with sky between them.
            for k in 2..points.len() {
                points[k] = points[k % 2].map(|x| x + 0.1 * rng.between(-unit, unit));
            }
        }
        let from = far(&mut rng);
        let cloud = PointCloud::new(&points).unwrap();
        let (options, size) = (
            Options::exponent(2.0),
            PanoramaOptions {
                width: 32,
                height: 16,
                ..SIZE
            },
        );
        let panorama = cloud.panorama(from, &options, &size).unwrap();
        let seen = cloud.visible_from(from, &options).unwrap();
        let places: Vec<_> = seen
            .indices()
            .iter()
            .map(|&index| {
                (DVec3::from_array(points[index as usize]) - DVec3::from_array(from)) / unit
            })
            .collect();
        let count = places.len();
        let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
        let triples = pairs.flat_map(|(a, b)| (b + 1..count).map(move |c| [a, b, c]));
        // Those with no other direction beyond their plane, which has the viewpoint behind it.
        let triangles: Vec<_> = triples
            .filter(|corners| {
                let [a, b, c] = corners.map(|k| places[k].normalize());
                let normal = (b - a).cross(c - a).normalize();
                let normal = normal * normal.dot(a).signum();
                let is_behind = |p: &DVec3| normal.dot(p.normalize() - a) < 1e-9;
                places.iter().all(is_behind)
            })
            .collect();
        let mut is_sky = vec![None; triangles.len()];
        for pixel in 0..32 * 16 {
            let elevation = FRAC_PI_2 - PI * ((pixel / 32) as f64 + 0.5) / 16.0;
            let (sin, cos) = (TAU * (pixel % 32) as f64 / 32.0).sin_cos();
            let ray = DVec3::new(
                elevation.cos() * cos,
                elevation.cos() * sin,
                elevation.sin(),
            );
            let shares = |corners: [usize; 3]| {
                let [a, b, c] = corners.map(|k| places[k].normalize());
                let all = a.dot(b.cross(c));
                [
                    ray.dot(b.cross(c)),
                    ray.dot(c.cross(a)),
                    ray.dot(a.cross(b)),
                ]
                .map(|x| x / all)
            };
            let least = |&k: &usize| {
                shares(triangles[k])
                    .into_iter()
                    .fold(f64::INFINITY, f64::min)
            };
            let inside = (0..triangles.len()).max_by(|a, b| least(a).total_cmp(&least(b)));
            let found = (
                panorama.indices[pixel],
                f64::from(panorama.ranges[pixel]) / unit,
            );
            let (title, nothing) = (
                format!("pixel {pixel} of {points:?} from {from:?}"),
                (Panorama::SKY, f64::INFINITY),
            );
            match inside {
                // A hull that does not go around the viewpoint.
                None => assert_eq!(found, nothing, "{title}"),
                Some(own) if least(&own) < -1e-3 => assert_eq!(found, nothing, "{title}"),
                Some(own) if least(&own) > 1e-3 => {
                    assert_eq!(
                        *is_sky[own].get_or_insert(found == nothing),
                        found == nothing,
                        "{title}"
                    );
                    if found == nothing {
                        skies += 1;
                        continue;
                    }
                    surfaces += 1;
                    let corners = triangles[own].map(|k| places[k]);
                    let along = |p: &DVec3| p.dot(ray);
                    let angle = |&k: &usize| places[k].normalize().dot(ray);
                    let nearest = triangles[own]
                        .into_iter()
                        .max_by(|a, b| angle(a).total_cmp(&angle(b)))
                        .unwrap();
                    assert_eq!(found.0, seen.indices()[nearest], "{title}");
                    let [a, b, c] = corners;
                    let normal = (b - a).cross(c - a);
                    let [low, high] = [f64::min, f64::max]
                        .map(|of| corners.iter().map(along).reduce(of).unwrap());
                    let crossing = (normal.dot(a) / normal.dot(ray)).clamp(low, high);
                    let is_near = |range: f64| (found.1 / range - 1.0).abs() < 1e-5;
                    assert!(
                        is_near(crossing) || is_near(places[nearest].length()),
                        "{}, not {crossing}: {title}",
                        found.1
                    );
                }
                Some(_) => {}
            }
        }
    }
    assert!(surfaces > 10_000 && skies > 100, "{surfaces}, {skies}");
}

#[test]
fn ranges_beyond_single_precision_are_no_sky() {
    let points: Vec<_> = room(2000, true)
        .iter()
        .map(|p| p.map(|x| x * 1e39))
        .collect();
    let panorama = seen(&points, INSIDE.map(|x| x * 1e39), &Options::default());
    assert!(panorama.indices.iter().all(|&index| index != Panorama::SKY));
    assert!(panorama.ranges.iter().all(|&range| range == f32::MAX));
}

#[test]
fn few_points_are_no_surface() {
    let flat: Vec<_> = (0..50).map(|i| [f64::from(i), 3.0, 0.0]).collect();
    let few: [&[[f64; 3]]; 5] = [
        &[],
        &[[0.0; 3]],
        &[[1.0, 0.0, 0.0]],
        &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]],
        &flat,
    ];
    for points in few {
        for options in ways() {
            let panorama = seen(points, [0.0; 3], &options);
            assert!(panorama.indices.iter().all(|&index| index == Panorama::SKY));
            assert_eq!((panorama.sky_view_factor, panorama.solid_angle), (1.0, 0.0));
        }
    }
}

#[test]
fn what_has_no_panorama_is_refused() {
    let cloud = PointCloud::new(&room(100, true)).unwrap();
    let usual = Options::default();
    let of_size = |change: &dyn Fn(&mut PanoramaOptions)| {
        let mut size = SIZE;
        change(&mut size);
        cloud.panorama(INSIDE, &usual, &size)
    };
    for size in [0, 16_385] {
        refused(
            "option",
            "width",
            of_size(&|panorama| panorama.width = size),
        );
        refused(
            "option",
            "height",
            of_size(&|panorama| panorama.height = size),
        );
    }
    for up in [[0.0; 3], [f64::NAN, 0.0, 1.0]] {
        refused(
            "viewpoint",
            "direction",
            of_size(&|panorama| panorama.up = up),
        );
    }
}
