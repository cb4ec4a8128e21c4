//! Scenes: a cloud, a viewpoint and a radius, drawn from a seed.

use hidden_point_removal::{Options, Radius};

use super::flip::farthest;
use super::rng::Rng;
use super::shapes::{self, AIMED_RADIUS, Points};

#[derive(Clone, Debug)]
pub struct Scene {
    pub points: Points,
    pub viewpoint: [f64; 3],
    pub options: Options,
}

pub struct Kind {
    pub name: &'static str,
    build: fn(&mut Rng, usize) -> Scene,
}

impl Kind {
    pub const fn new(name: &'static str, build: fn(&mut Rng, usize) -> Scene) -> Self {
        Self { name, build }
    }

    pub fn scene(&self, seed: u64, n: usize) -> Scene {
        (self.build)(&mut Rng::new(seed), n)
    }
}

macro_rules! kinds {
    ($($name:ident $build:expr;)*) => {
        pub const KINDS: &[Kind] = &[$(Kind {
            name: stringify!($name),
            build: $build,
        }),*];
    };
}

kinds! {
    sphere_from_outside |rng, n| view(rng, shapes::sphere, n, 3.0);
    ball_from_anywhere |rng, n| view(rng, shapes::ball, n, 1.5);
    bumpy_from_outside |rng, n| view(rng, shapes::bumpy, n, 2.5);
    bumpy_from_inside |rng, n| view(rng, shapes::bumpy, n, 0.25);
    room_from_inside |rng, n| view(rng, shapes::room, n, 1.0);
    grid |rng, n| on_grid(rng, shapes::grid, n);
    rays |rng, n| at_origin(rng, shapes::rays, n);
    duplicates |rng, n| view(rng, shapes::duplicates, n, 2.0);
    cube_around |rng, n| at_origin(rng, shapes::cube, n);
    pythagorean |rng, n| at_origin(rng, shapes::pythagorean, n);
    disc_from_aside |rng, n| view(rng, shapes::disc, n, 2.0);
    disc_edge_on |rng, n| {
        let points = shapes::disc(rng, n);
        let viewpoint = [rng.between(-3.0, 3.0), rng.between(-3.0, 3.0), 0.0];
        with_any_radius(rng, points, viewpoint)
    };
    grid_in_a_plane |rng, n| {
        let mut scene = on_grid(rng, shapes::grid, n);
        let z = scene.viewpoint[2];
        scene.points.iter_mut().for_each(|p| p[2] = z);
        with_any_radius(rng, scene.points, scene.viewpoint)
    };
    grid_on_a_line |rng, n| {
        let direction = core::array::from_fn(|_| f64::from(rng.integer(-1, 1)));
        let points = (0..n)
            .map(|_| f64::from(rng.integer(-5, 5)))
            .map(|times| direction.map(|x| x * times))
            .collect();
        let times = f64::from(rng.integer(-6, 6));
        with_any_radius(rng, points, direction.map(|x| x * times))
    };
    aimed_all_around |rng, n| aimed(rng, n, 0, |_| true);
    aimed_half_space |rng, n| aimed(rng, n, 0, |q| q[2] >= 0);
    aimed_from_outside |rng, n| aimed(rng, n, 0, |q| q[2] > 0);
    aimed_octant |rng, n| aimed(rng, n, 0, |q| q.iter().all(|&x| x >= 0));
    aimed_cube_faces |rng, n| aimed(rng, n, 0, |q| q.iter().any(|&x| x.abs() == 3));
    aimed_one_face |rng, n| aimed(rng, n, 0, |q| q[0] == 3);
    aimed_plane |rng, n| aimed(rng, n, 0, |q| q[2] == 0);
    aimed_half_plane |rng, n| aimed(rng, n, 0, |q| q[2] == 0 && q[1] >= 0);
    aimed_diagonal_plane |rng, n| aimed(rng, n, 0, |q| q[0] + q[1] + q[2] == 0);
    aimed_two_walls |rng, n| aimed(rng, n, 0, |q| q[0] >= 0 && q[1] >= 0 && (q[0] == 0 || q[1] == 0));
    almost_aimed |rng, n| aimed(rng, n, 3, |_| true);
    almost_aimed_half_space |rng, n| aimed(rng, n, 3, |q| q[2] >= 0);
    almost_aimed_plane |rng, n| aimed(rng, n, 3, |q| q[0] + q[1] + q[2] == 0);
    georeferenced |rng, n| {
        let millimeters = |x: f64| (x * 20_000.0).round() / 1000.0;
        let place = [523_000.0, 4_657_000.0, 120.0];
        let at = |p: [f64; 3]| core::array::from_fn(|i| place[i] + millimeters(p[i]));
        let points = shapes::bumpy(rng, n).into_iter().map(at).collect();
        let viewpoint = at(rng.direction().map(|x| 2.0 * x));
        with_any_radius(rng, points, viewpoint)
    };
    single_precision |rng, n| {
        let mut scene = view(rng, shapes::bumpy, n, 2.0);
        scene.points.iter_mut().for_each(|p| *p = p.map(|x| f64::from(x as f32)));
        with_any_radius(rng, scene.points, scene.viewpoint)
    };
    scaled |rng, n| {
        let scene = view(rng, shapes::ball, n, 1.5);
        let scale = power_of_two(rng.integer(-490, 490)) * rng.between(1.0, 2.0);
        let by = |p: [f64; 3]| p.map(|x| x * scale);
        let points = scene.points.into_iter().map(by).collect();
        with_any_radius(rng, points, by(scene.viewpoint))
    };
    aimed_scaled |rng, n| {
        let scale = power_of_two(rng.integer(-490, 490));
        let points = shapes::aimed(rng, n, 4, |q| q[2] >= 0);
        Scene {
            points: points.into_iter().map(|p| p.map(|x| x * scale)).collect(),
            viewpoint: [0.0; 3],
            options: Options::radius(AIMED_RADIUS * scale),
        }
    };
}

/// Kinds for small clouds only: numbers at the ends of the range of `f64`.
pub const EXTREME: &[Kind] = &[
    Kind {
        name: "denormal",
        build: |rng, n| {
            let unit = power_of_two(rng.integer(-1074, -1000));
            let grid = shapes::grid(rng, n).into_iter();
            let points = grid.map(|p| p.map(|x| x * unit)).collect();
            with_any_radius(rng, points, [0.0; 3])
        },
    },
    Kind {
        name: "distances that barely have a square",
        build: |rng, n| {
            let unit = power_of_two(rng.integer(-540, -510));
            let grid = shapes::grid(rng, n).into_iter();
            let points = grid.map(|p| p.map(|x| x * unit)).collect();
            with_any_radius(rng, points, [0.0; 3])
        },
    },
    Kind {
        name: "everything between 1e-300 and 1e150",
        build: |rng, n| {
            let points = (0..n)
                .map(|_| {
                    core::array::from_fn(|_| {
                        rng.between(-1.0, 1.0) * power_of_two(rng.integer(-990, 500))
                    })
                })
                .collect();
            with_any_radius(rng, points, [0.0; 3])
        },
    },
    Kind {
        name: "thin slivers",
        build: |rng, n| {
            let thin = power_of_two(rng.integer(-300, -20));
            let grid = shapes::ball(rng, n).into_iter();
            let points = grid
                .map(|p| [p[0], p[1] * thin, p[2] * thin * thin])
                .collect();
            with_any_radius(rng, points, [0.0; 3])
        },
    },
];

fn power_of_two(exponent: i32) -> f64 {
    if exponent < -1022 {
        return f64::from_bits(1 << (exponent + 1074));
    }
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// A shape around the origin, seen from inside or from about `distance`.
fn view(rng: &mut Rng, shape: fn(&mut Rng, usize) -> Points, n: usize, distance: f64) -> Scene {
    let points = shape(rng, n);
    let viewpoint = if !points.is_empty() && rng.chance(12) {
        rng.pick(&points)
    } else {
        rng.in_ball().map(|x| x * distance + 1e-3)
    };
    with_any_radius(rng, points, viewpoint)
}

fn at_origin(rng: &mut Rng, shape: fn(&mut Rng, usize) -> Points, n: usize) -> Scene {
    let points = shape(rng, n);
    with_any_radius(rng, points, [0.0; 3])
}

fn on_grid(rng: &mut Rng, shape: fn(&mut Rng, usize) -> Points, n: usize) -> Scene {
    let points = shape(rng, n);
    let viewpoint = core::array::from_fn(|_| f64::from(rng.integer(-3, 3)));
    with_any_radius(rng, points, viewpoint)
}

fn aimed(rng: &mut Rng, n: usize, slack: usize, part: fn([i32; 3]) -> bool) -> Scene {
    Scene {
        points: shapes::aimed(rng, n, slack, part),
        viewpoint: [0.0; 3],
        options: Options::radius(AIMED_RADIUS),
    }
}

fn with_any_radius(rng: &mut Rng, points: Points, viewpoint: [f64; 3]) -> Scene {
    let farthest = farthest(&points, viewpoint);
    let exponents = [0.0, 0.25, 0.5, 1.0, 2.0, 3.0, 4.0];
    let radius = match rng.below(5) {
        0 => Radius::Auto,
        1 if farthest > 0.0 => Radius::Absolute(farthest),
        2 if farthest > 0.0 => Radius::Absolute(farthest * rng.between(1.0, 4.0)),
        // The rounded 2R − d keeps few or no digits of d, so many flipped points lie on one sphere.
        3 if farthest > 0.0 && rng.chance(3) => Radius::Absolute(farthest * 1e15),
        _ => Radius::Exponent(rng.pick(&exponents)),
    };
    Scene {
        points,
        viewpoint,
        options: Options::default().with_radius(radius),
    }
}
