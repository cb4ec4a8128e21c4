//! Test clouds, made with exactly rounded arithmetic only, so that every platform gets
//! the same bits. Each shape gives `n` points around the origin.

use super::flip::{distance, flip};
use super::rng::Rng;

pub type Points = Vec<[f64; 3]>;

fn many(n: usize, mut point: impl FnMut() -> [f64; 3]) -> Points {
    (0..n).map(|_| point()).collect()
}

pub fn sphere(rng: &mut Rng, n: usize) -> Points {
    many(n, || rng.direction())
}

pub fn ball(rng: &mut Rng, n: usize) -> Points {
    many(n, || rng.in_ball())
}

/// A closed surface with bumps and pits, sampled without noise.
pub fn bumpy(rng: &mut Rng, n: usize) -> Points {
    many(n, || {
        let [x, y, z] = rng.direction();
        let r = 1.0 + 0.3 * x * y * z * 5.0 + 0.2 * (4.0 * z * z - 1.0) * x * z;
        [x * r, y * r, z * r]
    })
}

/// The six walls of a box with a few things standing in it.
pub fn room(rng: &mut Rng, n: usize) -> Points {
    many(n, || {
        let mut p = [
            rng.between(-4.0, 4.0),
            rng.between(-3.0, 3.0),
            rng.between(-1.25, 1.25),
        ];
        if rng.chance(4) {
            return p.map(|x| x * 0.25 + 0.5);
        }
        let axis = rng.below(3);
        p[axis] = [4.0, 3.0, 1.25][axis] * if rng.chance(2) { 1.0 } else { -1.0 };
        p
    })
}

/// Small integers: equal points, rays, planes and lines everywhere.
pub fn grid(rng: &mut Rng, n: usize) -> Points {
    let half = rng.integer(1, 3);
    many(n, || {
        core::array::from_fn(|_| f64::from(rng.integer(-half, half)))
    })
}

/// A few directions, and many multiples of each.
pub fn rays(rng: &mut Rng, n: usize) -> Points {
    let directions = grid(rng, 4);
    many(n, || {
        let times = f64::from(rng.integer(1, 5));
        rng.pick(&directions).map(|x| x * times)
    })
}

/// Every point several times.
pub fn duplicates(rng: &mut Rng, n: usize) -> Points {
    let few = ball(rng, n / 3 + 1);
    many(n, || rng.pick(&few))
}

/// A thin disc in z = 0.
pub fn disc(rng: &mut Rng, n: usize) -> Points {
    many(n, || {
        let [x, y, _] = rng.in_ball();
        [x, y, 0.0]
    })
}

/// The corners and centers of a cube around the viewpoint.
pub fn cube(rng: &mut Rng, n: usize) -> Points {
    let signs = [-1.0, 1.0, 0.0, 1.0, -1.0];
    many(n, || core::array::from_fn(|_| rng.pick(&signs)))
}

/// Points at equal distances: signs and orders of Pythagorean quadruples. Their flipped
/// points share planes exactly.
pub fn pythagorean(rng: &mut Rng, n: usize) -> Points {
    let quadruples = [
        [0.0, 0.0, 9.0],
        [1.0, 4.0, 8.0],
        [4.0, 4.0, 7.0],
        [3.0, 6.0, 6.0],
    ];
    let times = f64::from(rng.integer(1, 2));
    many(n, || {
        let mut p = rng.pick(&quadruples);
        rng.shuffle(&mut p);
        let scale = if rng.chance(3) { times } else { 1.0 };
        p.map(|x| if rng.chance(2) { -x * scale } else { x * scale })
    })
}

/// A radius for [`aimed`].
pub const AIMED_RADIUS: f64 = 3.0;

/// Points whose flipped points are exactly small integers, seen from the origin with
/// `AIMED_RADIUS`. They lie on the surface of a cube, in it, on rays, planes and edges.
/// `part` restricts the integers. If `slack` > 0, one point in `slack`
/// may be one rounding error off.
pub fn aimed(rng: &mut Rng, n: usize, slack: usize, part: fn([i32; 3]) -> bool) -> Points {
    many(n, || {
        let q = loop {
            let q: [i32; 3] = core::array::from_fn(|_| rng.integer(-3, 3));
            let squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
            if part(q) && (9..36).contains(&squared) {
                break q.map(f64::from);
            }
        };
        if slack > 0 && rng.chance(slack) {
            let near = nudge(approach(q), core::array::from_fn(|_| rng.integer(-1, 1)));
            if reachable(near) {
                return near;
            }
        }
        aim(q)
    })
}

/// The inverse flip, rounded. The flip is its own inverse.
fn approach(q: [f64; 3]) -> [f64; 3] {
    flip(q, [0.0; 3], AIMED_RADIUS).expect("not the viewpoint")
}

/// A p whose flip with `AIMED_RADIUS` from the origin is q to the bit, if there is one
/// next to the rounded inverse.
pub fn aim(q: [f64; 3]) -> [f64; 3] {
    let near = approach(q);
    let steps = [0, 1, -1, 2, -2, 3, -3];
    for x in steps {
        for y in steps {
            for z in steps {
                let p = nudge(near, [x, y, z]);
                if reachable(p) && flip(p, [0.0; 3], AIMED_RADIUS) == Some(q) {
                    return p;
                }
            }
        }
    }
    assert!(reachable(near), "{near:?}");
    near
}

/// Whether p is within the sphere after rounding.
fn reachable(p: [f64; 3]) -> bool {
    distance(p, [0.0; 3]) <= AIMED_RADIUS
}

fn nudge(p: [f64; 3], steps: [i32; 3]) -> [f64; 3] {
    core::array::from_fn(|i| {
        if p[i] == 0.0 {
            return p[i];
        }
        f64::from_bits((p[i].to_bits() as i64 + i64::from(steps[i])) as u64)
    })
}
