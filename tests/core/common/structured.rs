//! Clouds of planes, lines and lattices, and viewpoints that lie in them. Such viewpoints
//! occur in scanned rooms, and they reach the rare branches of the code.

use core::f64::consts::TAU;

use hidden_point_removal::{Exponential, Inversion, Options, Radius};

use super::flip::farthest;
use super::rng::Rng;
use super::scenes::Scene;
use super::shapes::{self, AIMED_RADIUS, Points};

/// Kinds of clouds of any size.
pub const SHAPES: &[(&str, Shape)] = &[
    ("walls", walls),
    ("walls on a lattice", walls_on_a_lattice),
    ("furnished walls", furnished),
    ("planes through the viewpoint", planes_through_a_point),
    ("solid lattice", solid_lattice),
    ("steps", steps),
    ("terrain on a lattice", terrain),
    ("sphere around lattice walls", sphere_and_walls),
    ("lines through a point", lines),
    ("few places, many times", repeated),
    ("lattice, after the flip", |rng, n| {
        shapes::aimed(rng, n, 4, |_| true)
    }),
    ("spheres of a lattice", shapes::pythagorean),
    ("cube with bumps, after the flip", flipped_cube),
    ("clusters on a cube, after the flip", flipped_clusters),
    ("bumpy", shapes::bumpy),
    IN_SQUARE,
];

/// The kind of [`flipped_square`].
pub const IN_SQUARE: (&str, Shape) = ("point in a square, after the flip", flipped_square);

/// `n` points in and around a box of about [0, 8] × [0, 6] × [0, 3].
type Shape = fn(&mut Rng, usize) -> Points;

const BOX: [f64; 3] = [8.0, 6.0, 3.0];

fn many(n: usize, mut point: impl FnMut() -> [f64; 3]) -> Points {
    (0..n).map(|_| point()).collect()
}

fn in_box(rng: &mut Rng) -> [f64; 3] {
    BOX.map(|side| side * rng.unit())
}

/// Rounds to the nearest multiple of `unit`, a power of two.
fn rounded(p: [f64; 3], unit: f64) -> [f64; 3] {
    p.map(|x| (x / unit).round() * unit)
}

fn on_a_wall(rng: &mut Rng) -> [f64; 3] {
    let mut p = in_box(rng);
    let wall = rng.below(6);
    p[wall / 2] = if wall % 2 == 0 { 0.0 } else { BOX[wall / 2] };
    p
}

fn walls(rng: &mut Rng, n: usize) -> Points {
    many(n, || on_a_wall(rng))
}

fn walls_on_a_lattice(rng: &mut Rng, n: usize) -> Points {
    let unit = rng.pick(&[0.125, 0.25, 0.5]);
    many(n, || rounded(on_a_wall(rng), unit))
}

/// Walls, and boxes on the floor whose sides are at whole numbers.
fn furnished(rng: &mut Rng, n: usize) -> Points {
    let boxes: Vec<[[f64; 3]; 2]> = (0..1 + rng.below(4))
        .map(|_| {
            let low = rounded(in_box(rng), 1.0);
            [[low[0], low[1], 0.0], [1.0, 2.0, 1.0]]
        })
        .collect();
    many(n, || {
        if rng.chance(2) {
            return on_a_wall(rng);
        }
        let [low, size] = rng.pick(&boxes);
        let mut p: [f64; 3] = core::array::from_fn(|axis| low[axis] + size[axis] * rng.unit());
        let side = rng.below(6);
        p[side / 2] = low[side / 2] + if side % 2 == 0 { 0.0 } else { size[side / 2] };
        p
    })
}

/// Planes that meet in one point: planes of the axes and diagonal planes. All are exact.
fn planes_through_a_point(rng: &mut Rng, n: usize) -> Points {
    let center = rounded(in_box(rng), 1.0);
    let scattered = rng.chance(2);
    many(n, || {
        let unit = if scattered { 1.0 } else { 0.25 };
        let [x, y, z]: [f64; 3] = core::array::from_fn(|_| {
            let x = rng.between(-3.0, 3.0);
            if scattered {
                x
            } else {
                (x / unit).round() * unit
            }
        });
        let offset = match rng.below(7) {
            0 => [0.0, y, z],
            1 => [x, 0.0, z],
            2 => [x, y, 0.0],
            3 => [x, x, z],
            4 => [x, y, -y],
            5 => [x, 0.0, 0.0],
            _ => [x, y, z],
        };
        core::array::from_fn(|axis| center[axis] + offset[axis])
    })
}

fn solid_lattice(rng: &mut Rng, n: usize) -> Points {
    let side = ((n as f64).cbrt().ceil() as usize).max(1);
    let scale: [f64; 3] = core::array::from_fn(|_| rng.pick(&[0.25, 0.5, 1.0]));
    (0..n)
        .map(|i| [i % side, i / side % side, i / side / side])
        .map(|p| core::array::from_fn(|axis| p[axis] as f64 * scale[axis]))
        .collect()
}

/// Treads and risers.
fn steps(rng: &mut Rng, n: usize) -> Points {
    many(n, || {
        let [x, y, _] = in_box(rng);
        let step = x.floor();
        if rng.chance(2) {
            [x, y, 0.375 * step]
        } else {
            [step, y, 0.375 * (step - rng.unit())]
        }
    })
}

/// Heights in whole numbers over a regular grid: flat parts, steps, lines.
fn terrain(rng: &mut Rng, n: usize) -> Points {
    let side = n.isqrt().max(1);
    let fold = 2 + rng.below(5);
    (0..n)
        .map(|i| [i % side, i / side])
        .map(|[i, j]| {
            let height = (i / fold + j / (fold + 1)) % 3;
            [i as f64 * 0.25, j as f64 * 0.25, height as f64 * 0.5]
        })
        .collect()
}

fn sphere_and_walls(rng: &mut Rng, n: usize) -> Points {
    many(n, || {
        if rng.chance(2) {
            return rounded(on_a_wall(rng), 0.5);
        }
        let [x, y, z] = rng.direction();
        [4.0 + x, 3.0 + y, 1.5 + z]
    })
}

/// Lines through one place, some along the axes.
fn lines(rng: &mut Rng, n: usize) -> Points {
    let center = rounded(in_box(rng), 1.0);
    let directions: Points = many(2 + rng.below(9), || {
        core::array::from_fn(|_| f64::from(rng.integer(-2, 2)))
    });
    many(n, || {
        let (direction, times) = (
            rng.pick(&directions),
            0.125 * f64::from(rng.integer(-20, 20)),
        );
        core::array::from_fn(|axis| center[axis] + times * direction[axis])
    })
}

/// Corners, and points of the walls, each several times.
fn repeated(rng: &mut Rng, n: usize) -> Points {
    let few = walls_on_a_lattice(rng, n / 4 + 1);
    many(n, || match rng.chance(6) {
        true => BOX.map(|side| if rng.chance(2) { side } else { 0.0 }),
        false => rng.pick(&few),
    })
}

/// Points that flip exactly on to the sides of a cube, like `shapes::aimed`. Some sides have
/// bumps, which hide points that lie exactly on the side.
fn flipped_cube(rng: &mut Rng, n: usize) -> Points {
    const SIDE: f64 = 3.0;
    let unit = rng.pick(&[0.125, 0.25]);
    let bumps: Points = many(1 + rng.below(3), || {
        let height = SIDE + unit * f64::from(rng.integer(1, 3));
        let [x, y] = [0; 2].map(|_| (rng.between(-2.5, 2.5) / unit).round() * unit);
        [x, y, if rng.chance(2) { height } else { -height }]
    });
    let axes: Vec<usize> = bumps.iter().map(|_| rng.below(3)).collect();
    many(n, || {
        let mut q: [f64; 3] =
            core::array::from_fn(|_| (rng.between(-SIDE, SIDE) / unit).round() * unit);
        q[rng.below(3)] = if rng.chance(2) { SIDE } else { -SIDE };
        if rng.chance(6) {
            let bump = rng.below(bumps.len());
            let [x, y, height] = bumps[bump];
            let [dx, dy] = [0; 2].map(|_| unit * f64::from(rng.integer(-2, 2)));
            let axis = axes[bump];
            q[axis] = height;
            q[(axis + 1) % 3] = x + dx;
            q[(axis + 2) % 3] = y + dy;
        }
        shapes::aim(q)
    })
}

/// Clusters of points that flip exactly on to the sides of a cube, and the cube's corners. A
/// few points lie above a side.
fn flipped_clusters(rng: &mut Rng, n: usize) -> Points {
    const SIDE: f64 = 3.0;
    const UNIT: f64 = 1.0 / 64.0;
    const CLUSTER: usize = 64;
    let mut flipped: Points = (0..8)
        .map(|corner| [1, 2, 4].map(|bit| if corner & bit == 0 { SIDE } else { -SIDE }))
        .collect();
    let sides: Vec<usize> = (0..2).map(|_| rng.below(6)).collect();
    for cluster in 0..n.div_ceil(CLUSTER) {
        let side = rng.pick(&sides);
        let place = [0; 2].map(|_| (rng.between(-2.75, 2.75) / UNIT).round() * UNIT);
        let height = if cluster % 5 == 4 {
            SIDE + UNIT * f64::from(rng.integer(1, 12))
        } else {
            SIDE
        };
        for _ in 0..CLUSTER {
            let [x, y] = place.map(|x| x + UNIT * f64::from(rng.integer(-8, 8)));
            let z = if side % 2 == 0 { height } else { -height };
            let mut q = [x, y, z];
            q.rotate_right(side / 2);
            flipped.push(q);
        }
    }
    flipped.into_iter().map(shapes::aim).collect()
}

/// A point that flips exactly into the middle of a square, with many hidden points behind each of
/// them, so that the middle and the corners are in blocks of their own. Points far aside rise above
/// the square, and mostly hide its middle.
fn flipped_square(rng: &mut Rng, n: usize) -> Points {
    const HEIGHT: f64 = 4.0;
    let corners = [[3.0, 0.0], [-3.0, 0.0], [0.0, 3.0], [0.0, -3.0]];
    let mut centers = vec![[0.0, 0.0, HEIGHT]];
    centers.extend(corners.map(|[x, y]| [x, y, HEIGHT]));
    for _ in 0..1 + rng.below(2) {
        let (around, aside) = (rng.between(0.0, TAU), rng.between(0.65, 0.84));
        let [x, y] = [around.cos(), around.sin()].map(|x| x * aside.sin());
        let length = rng.between(5.2, 5.95);
        centers.push([x, y, aside.cos()].map(|x| x * length));
    }
    for _ in 0..rng.below(5) {
        let [x, y, z] = rng.direction();
        let length = rng.pick(&[3.05, 4.5, 5.5]);
        centers.push([x, y, -z.abs()].map(|x| x * length));
    }
    let spread = rng.pick(&[0.006, 0.03, 0.09, 0.18]);
    let turn = rng.below(3);
    let mut points = Points::new();
    for center in &centers {
        let first = shapes::aim(*center);
        points.push(first);
        let most = 0.99 * AIMED_RADIUS / norm(first);
        for _ in 0..rng.below(2 * n / centers.len() + 1) {
            let times = rng.between(0.7 + 0.3 * most, most);
            let p = first.map(|x| x * times + spread * rng.between(-0.5, 0.5));
            let nearer = (0.995 * AIMED_RADIUS / norm(p)).min(1.0);
            points.push(p.map(|x| x * nearer));
        }
    }
    points.iter_mut().for_each(|p| p.rotate_right(turn));
    points
}

fn norm([x, y, z]: [f64; 3]) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

/// A viewpoint in a special place relative to the planes, lines and points of a cloud.
pub fn viewpoint(rng: &mut Rng, points: &[[f64; 3]]) -> [f64; 3] {
    if points.is_empty() {
        return rounded(in_box(rng), 1.0);
    }
    let [a, b, c] = [0; 3].map(|_| rng.pick(points));
    match rng.below(14) {
        // On a point, between two points, or beyond them on their line.
        0 | 1 => a,
        2 => core::array::from_fn(|i| 2.0 * b[i] - a[i]),
        3 => core::array::from_fn(|i| 0.5 * (a[i] + b[i])),
        // In one, two or three axis planes through points.
        4 => [a[0], b[1], c[2]],
        5 | 6 => {
            let mut p = in_box(rng);
            let axis = rng.below(3);
            p[axis] = a[axis];
            p
        }
        7 => {
            let mut p = in_box(rng).map(|x| 3.0 * x - 8.0);
            let axis = rng.below(3);
            p[axis] = a[axis];
            p
        }
        8 => {
            let axis = rng.below(3);
            let mut p = a;
            p[axis] += rng.between(-8.0, 8.0);
            p
        }
        // In the walls of the box, on its edges and corners, and beyond them.
        9 | 10 => {
            let mut p = in_box(rng);
            for axis in 0..3 {
                if rng.chance(2) {
                    p[axis] = rng.pick(&[0.0, BOX[axis], -2.0, 2.0 * BOX[axis]]);
                }
            }
            p
        }
        // In no plane, or next to one.
        11 => {
            let mut p = in_box(rng);
            let axis = rng.below(3);
            p[axis] = a[axis] + rng.pick(&[1e-14, -1e-9, 1e-5]);
            p
        }
        12 => rounded(in_box(rng), 0.5),
        _ => in_box(rng),
    }
}

/// Options that a divided view takes, and sometimes options that it refuses.
pub fn options(rng: &mut Rng, points: &[[f64; 3]], viewpoint: [f64; 3]) -> Options {
    let farthest = farthest(points, viewpoint);
    let radius = match rng.below(12) {
        0..4 => Radius::Auto,
        4 if farthest > 0.0 => Radius::Absolute(farthest),
        5 if farthest > 0.0 => Radius::Absolute(farthest * rng.pick(&[1.5, 2.0, 7.0, 1e3, 1e7])),
        6 if points.len() < 600 => Radius::Opposite,
        7 => Radius::Exponent(rng.pick(&[0.0, 0.01, 0.3, 7.9, 8.0, 11.0])),
        8 => {
            return Options::inversion(rng.pick(&[
                Inversion::Power(1.5),
                Inversion::Power(2.0),
                Inversion::Exponential(Exponential::Auto),
                Inversion::Exponential(Exponential::Scale(0.05)),
            ]));
        }
        _ => Radius::Exponent(rng.pick(&[0.5, 1.0, 2.0, 3.0, 4.0, 6.0])),
    };
    Options::default().with_radius(radius)
}

/// A cloud of about `n` points of a kind, with a viewpoint and options.
pub fn scene(rng: &mut Rng, (name, shape): (&str, Shape), n: usize) -> Scene {
    let mut points = shape(rng, n);
    if is_aimed(name) {
        return Scene {
            points,
            viewpoint: [0.0; 3],
            options: Options::radius(AIMED_RADIUS),
        };
    }
    if rng.chance(4) {
        points
            .iter_mut()
            .for_each(|p| *p = p.map(|x| f64::from(x as f32)));
    }
    let viewpoint = viewpoint(rng, &points);
    let options = options(rng, &points, viewpoint);
    Scene {
        points,
        viewpoint,
        options,
    }
}

fn is_aimed(name: &str) -> bool {
    name.ends_with("after the flip")
}
