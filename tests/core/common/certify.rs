//! Proofs for clouds of any size: a supporting plane proves that a point is visible, an
//! enclosing triangle proves that it is hidden.
//!
//! For one q, look for the face through which its ray leaves K. Hold three points
//! A, B, C whose cone contains q. While some point x lies beyond their plane,
//! exchange one of the three for x so that the cone still contains q: the plane
//! moves outward along the ray. At the end either
//!   q lies strictly inside the plane: λq is in the triangle ABC for some λ > 1,
//!   so q is hidden, or
//!   q lies on the plane and no point lies beyond the plane: no λq with λ > 1 is in K,
//!   so q is visible.
//! (The exchange is the simplex method. It finds the least Σ cⱼ with Σ cⱼqⱼ = q and cⱼ ≥ 0.)
//! Every sign that counts is exact, so each verdict is a proof.
//!
//! q may lie on the border of a cone. So it is moved by ε·a + ε²·b with an
//! infinitesimal ε, where q, a, b is the first triple. The moved point is inside
//! the cone of this triple, every later step strictly gains, and nothing can cycle.
//! A statement for all small ε also holds for q in the closed cone.

use robust::{Coord3D, orient3d};

const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

pub struct Certifier {
    q: Vec<[f64; 3]>,
}

#[derive(Clone, Copy, Debug)]
pub struct Verdict {
    pub visible: bool,
    /// The triangle that proves the verdict, as indices into the points.
    pub face: [usize; 3],
}

impl Certifier {
    /// Takes flipped points, scales them by a power of two into the range where
    /// `robust` is exact, and fills up the dimensions that they do not span.
    ///
    /// If all points lie in one plane or line with the origin, no triangle of them
    /// proves anything. So independent vectors off that plane or line are added. They
    /// change no verdict: within the plane or line, K with them equals K without them.
    pub fn new(q: &[[f64; 3]]) -> Self {
        let largest = q.iter().flatten().fold(0.0f64, |max, x| max.max(x.abs()));
        assert!(largest > 0.0 && largest.is_finite(), "nothing to certify");
        let scale = f64::from_bits((2046 - (largest.to_bits() >> 52).clamp(1, 2045)) << 52);
        let q: Vec<[f64; 3]> = q.iter().map(|v| v.map(|x| x * scale)).collect();
        assert!(
            q.iter().flatten().all(|&x| x == 0.0 || x.abs() > 1e-60),
            "too wide a range for expansion arithmetic"
        );
        let [x, y, z] = AXES;
        let fillings: [&[[f64; 3]]; 7] = [&[], &[x], &[y], &[z], &[x, y], &[y, z], &[z, x]];
        fillings
            .into_iter()
            .map(|filling| Self {
                q: [&q, filling].concat(),
            })
            .find(|certifier| certifier.first_triple(0).is_some())
            .expect("a vector and two axes that span space")
    }

    /// Is point `p` visible, and why?
    pub fn verdict(&self, p: usize) -> Verdict {
        let start = self
            .first_triple(p)
            .expect("points that were made to span space");
        let mut face = start;
        // Each step gains strictly, so every face is new. Real clouds need about ten steps.
        for _ in 0..10_000 {
            if self.side(face, p) > 0.0 {
                return Verdict {
                    visible: false,
                    face,
                };
            }
            let Some(x) = self.beyond(face) else {
                return Verdict {
                    visible: true,
                    face,
                };
            };
            face = self.exchange(start, face, x);
        }
        panic!("no end in sight for point {p}");
    }

    /// The points that are on the plane of `face` up to rounding. An inexact hull would get
    /// these points wrong.
    pub fn near_ties(&self, face: [usize; 3]) -> Vec<usize> {
        let m = self.dual(face);
        (0..self.q.len())
            .filter(|&i| (dot(m, self.q[i]) - 1.0).abs() < 1e-12)
            .collect()
    }

    /// Negative when x is beyond the plane of the face, seen from the origin; 0 on it.
    fn side(&self, [a, b, c]: [usize; 3], x: usize) -> f64 {
        let [a, b, c, x] = [a, b, c, x].map(|i| coord(self.q[i]));
        orient3d(a, b, c, x)
    }

    /// Positive when a, b, c turn counterclockwise seen from outside K.
    fn det(&self, a: usize, b: usize, c: usize) -> f64 {
        let [a, b, c] = [a, b, c].map(|i| coord(self.q[i]));
        orient3d(a, b, c, coord([0.0; 3]))
    }

    /// p and two other points, counterclockwise seen from outside. `None` if and only
    /// if all points lie in one plane with the origin. The choice that looks best in `f64`
    /// is tried first; exact signs decide.
    fn first_triple(&self, p: usize) -> Option<[usize; 3]> {
        let q = &self.q;
        let origin = coord([0.0; 3]);
        let off_line = |a: usize| {
            let [p, a] = [p, a].map(|i| coord(q[i]));
            let off = |axis| orient3d(p, a, coord(axis), origin) != 0.0;
            AXES.into_iter().any(off)
        };
        let a = self.farthest(|i| {
            let c = cross(q[p], q[i]);
            dot(c, c)
        });
        let mut others = core::iter::once(a).chain(0..q.len());
        let a = others.find(|&a| off_line(a))?;
        let normal = cross(q[p], q[a]);
        let b = self.farthest(|i| dot(normal, q[i]).abs());
        let mut others = core::iter::once(b).chain(0..q.len());
        let b = others.find(|&b| self.det(p, a, b) != 0.0)?;
        if self.det(p, a, b) > 0.0 {
            Some([p, a, b])
        } else {
            Some([p, b, a])
        }
    }

    fn farthest(&self, key: impl Fn(usize) -> f64) -> usize {
        let mut best = (f64::NEG_INFINITY, 0);
        for i in 0..self.q.len() {
            let key = key(i);
            if key > best.0 {
                best = (key, i);
            }
        }
        best.1
    }

    /// A point beyond the plane of the face: the farthest by `f64`, or any point that
    /// the exact sign finds.
    fn beyond(&self, face: [usize; 3]) -> Option<usize> {
        let m = self.dual(face);
        let best = self.farthest(|i| dot(m, self.q[i]));
        if self.side(face, best) < 0.0 {
            return Some(best);
        }
        (0..self.q.len()).find(|&x| self.side(face, x) < 0.0)
    }

    /// The face with x in place of one corner whose cone contains the moved q.
    fn exchange(&self, start: [usize; 3], [a, b, c]: [usize; 3], x: usize) -> [usize; 3] {
        // The sign of det(q + ε·a + ε²·b, u, v) for infinitesimal ε.
        let turns = |u: usize, v: usize| {
            let signs = start.map(|s| self.det(s, u, v));
            signs.into_iter().find(|&s| s != 0.0).unwrap_or(0.0) > 0.0
        };
        [[x, b, c], [a, x, c], [a, b, x]]
            .into_iter()
            .find(|&[u, v, w]| self.det(u, v, w) > 0.0 && turns(u, v) && turns(v, w) && turns(w, u))
            .expect("the cone of four points that contains q has a part that does")
    }

    /// m with m·x = 1 on the face, within the precision of `f64`.
    fn dual(&self, [a, b, c]: [usize; 3]) -> [f64; 3] {
        let [a, b, c] = [a, b, c].map(|i| self.q[i]);
        let n = cross(sub(b, a), sub(c, a));
        let scale = dot(n, a);
        n.map(|x| x / scale)
    }
}

fn coord([x, y, z]: [f64; 3]) -> Coord3D<f64> {
    Coord3D { x, y, z }
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
