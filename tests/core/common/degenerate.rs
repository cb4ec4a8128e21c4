//! Small scenes whose flipped points lie exactly in planes, on lines and on rays, or are
//! equal, under every inversion. Distances and radii are chosen so that no flip rounds.

use hidden_point_removal::{Exponential, Inversion, Options, Radius};

use super::rng::Rng;
use super::scenes::{Kind, Scene};
use super::shapes::{self, Points};
use super::structured;

/// Integer vectors of the lengths 3 and 9, up to signs and orders.
const THREE: [[f64; 3]; 2] = [[0.0, 0.0, 3.0], [1.0, 2.0, 2.0]];
const NINE: [[f64; 3]; 4] = [
    [0.0, 0.0, 9.0],
    [1.0, 4.0, 8.0],
    [4.0, 4.0, 7.0],
    [3.0, 6.0, 6.0],
];

pub const DEGENERATE: &[Kind] = &[
    Kind::new("whole multiples, exactly flipped on a sphere", |rng, n| {
        // |v| = 9t and R = 9m/2 make s = (m − t)/t, exact for these t.
        let points = vectors(rng, n, &NINE, &[1.0, 2.0, 4.0]);
        let radius = 4.5 * f64::from(rng.integer(8, 24));
        seen_from_origin(points, Options::radius(radius))
    }),
    Kind::new("powers of two, exactly flipped by a power", |rng, n| {
        // d/S is a power of two. If the exponent is an integer, s is a power of two, too.
        let points = vectors(rng, n, &THREE, &[1.0, 2.0, 4.0, 8.0]);
        let options = Options::inversion(Inversion::Power(f64::from(rng.integer(2, 6))))
            .with_radius(Radius::Absolute(rng.pick(&[24.0, 48.0, 3072.0])));
        seen_from_origin(points, options)
    }),
    Kind::new("all flipped to one sphere", |rng, n| {
        // exp(c/d) is 1: all points of a ray flip alike, except for rounding.
        let points = vectors(rng, n, &THREE, &[1.0, 2.0, 3.0, 4.0]);
        let scale = Exponential::Scale(1e-30);
        seen_from_origin(points, Options::inversion(Inversion::Exponential(scale)))
    }),
    Kind::new("circles in planes beside the viewpoint", |rng, n| {
        let circle = [[5.0, 0.0], [3.0, 4.0], [4.0, 3.0]];
        let heights = [0.0, 12.0, -12.0, 6.0];
        let flat = rng.chance(4);
        let points = many(n, || {
            let mut p = rng.pick(&circle);
            rng.shuffle(&mut p);
            let [x, y] = p.map(|x| if rng.chance(2) { -x } else { x });
            let times = rng.pick(&[1.0, 1.0, 2.0, 0.0]);
            let z = if flat { 0.0 } else { rng.pick(&heights) };
            [x * times, y * times, z]
        });
        let options = structured::options(rng, &points, [0.0; 3]);
        seen_from_origin(points, options)
    }),
    Kind::new("one ray and a few others", |rng, n| {
        let ray: [f64; 3] = core::array::from_fn(|_| f64::from(rng.integer(-2, 2)));
        let others = shapes::grid(rng, 3);
        let points = many(n, || {
            if rng.chance(5) {
                return rng.pick(&others);
            }
            let times = rng.pick(&[0.25, 0.5, 1.0, 2.0, 3.0, 4.0, -1.0]);
            ray.map(|x| x * times)
        });
        let options = structured::options(rng, &points, [0.0; 3]);
        seen_from_origin(points, options)
    }),
    Kind::new("many at the viewpoint", |rng, n| {
        let mut points = shapes::grid(rng, n);
        let viewpoint = if n > 0 { rng.pick(&points) } else { [0.0; 3] };
        for p in &mut points {
            if rng.chance(3) {
                *p = viewpoint;
            }
        }
        with_any_options(rng, points, viewpoint)
    }),
    Kind::new("next to the viewpoint", |rng, n| {
        let unit = rng.pick(&[1e-300, 1e-160, 1e-16, 1e-9]);
        let points = shapes::grid(rng, n).into_iter();
        let points: Points = points
            .map(|p| {
                if rng.chance(2) {
                    p.map(|x| x * unit)
                } else {
                    p
                }
            })
            .collect();
        with_any_options(rng, points, [0.0; 3])
    }),
    Kind::new("flipped to few places", |rng, n| {
        // The rounded 2R − d keeps few or no digits of d.
        let points = shapes::grid(rng, n);
        let radius = rng.pick(&[1e14, 1e15, 1e16, 1e17, 1e30]);
        seen_from_origin(points, Options::radius(radius))
    }),
    Kind::new("thin, except for rounding", |rng, n| {
        let [start, along, across] = [[0.3, -0.7, 1.1], [1.7, 0.9, -2.3], [0.4, 1.3, 0.2]];
        let place = |t: f64, s: f64| -> [f64; 3] {
            core::array::from_fn(|i| start[i] + t * along[i] + s * across[i])
        };
        let beside = [place(7.3, 1.1), place(0.3, 0.1)];
        let ends = [place(7.3, 0.0), place(0.3, 0.0)];
        let far = [[9.0, 8.0, 7.5], [0.0; 3], [1e6, 2e6, -1e6]];
        let viewpoint = rng.pick(&[&beside[..], &ends, &far].concat());
        let shape = rng.below(5);
        let strays = rng.chance(4);
        let points = many(n, || {
            let [t, s] = [0; 2].map(|_| rng.between(-5.0, 5.0));
            match shape {
                _ if strays && rng.chance(30) => place(t, s).map(|x| x + 1e-7),
                0 => place(t, 0.0),
                1 => place(t, s),
                2 => place(libm::cos(t), libm::sin(t)),
                3 => along.map(|x| (t + 6.0) * x),
                _ => [t, 0.1, 0.2],
            }
        });
        let options = Options::exponent(rng.pick(&[0.5, 2.0]));
        Scene {
            points,
            viewpoint,
            options,
        }
    }),
    Kind::new("two walls and their edge", |rng, n| {
        let points = many(n, || {
            let [x, y, z] = core::array::from_fn(|_| f64::from(rng.integer(0, 4)));
            match rng.below(3) {
                0 => [0.0, y, z],
                1 => [x, 0.0, z],
                _ => [0.0, 0.0, z],
            }
        });
        let viewpoint = core::array::from_fn(|_| f64::from(rng.integer(-1, 2)));
        with_any_options(rng, points, viewpoint)
    }),
    Kind::new(
        "a plane through the viewpoint, a few beside it",
        |rng, n| {
            let spare = 1 + rng.below(4);
            let mut points = shapes::grid(rng, n);
            let diagonal = rng.chance(2);
            for p in points.iter_mut().skip(spare) {
                p[2] = if diagonal { -p[1] } else { 0.0 };
            }
            let x = f64::from(rng.integer(-4, 4));
            let options = structured::options(rng, &points, [x, 0.0, 0.0]);
            Scene {
                points,
                viewpoint: [x, 0.0, 0.0],
                options,
            }
        },
    ),
    Kind::new("rooms, lattices, planes and lines", |rng, n| {
        let kind = rng.pick(structured::SHAPES);
        structured::scene(rng, kind, n)
    }),
];

fn many(n: usize, mut point: impl FnMut() -> [f64; 3]) -> Points {
    (0..n).map(|_| point()).collect()
}

/// Vectors of given lengths with any signs and orders, times a factor.
fn vectors(rng: &mut Rng, n: usize, of: &[[f64; 3]], times: &[f64]) -> Points {
    let part = rng.below(3);
    many(n, || {
        let mut p = rng.pick(of);
        rng.shuffle(&mut p);
        let times = rng.pick(times);
        let mut p = p.map(|x| if rng.chance(2) { -x * times } else { x * times });
        // All directions, a half-space, or an octant: the viewpoint is inside or on the border.
        match part {
            0 => {}
            1 => p[2] = p[2].abs(),
            _ => p = p.map(f64::abs),
        }
        p
    })
}

fn seen_from_origin(points: Points, options: Options) -> Scene {
    Scene {
        points,
        viewpoint: [0.0; 3],
        options,
    }
}

fn with_any_options(rng: &mut Rng, points: Points, viewpoint: [f64; 3]) -> Scene {
    let options = structured::options(rng, &points, viewpoint);
    Scene {
        points,
        viewpoint,
        options,
    }
}
