//! Upper bounds of w, the gauge of K, along the corners of a grid of directions, from champions.
//!
//! On a side of the cube a flipped point is z·(x, y, 1), and w is convex and at most 1/z at (x, y). So in a triangle of
//! three champions w is at most the interpolation of their 1/z. At a corner, both triangles count that the champions
//! of the four cells around it make with a diagonal; the lower bound is the better one. The same is done with
//! cells that are joined two by two, again and again: their triangles reach over holes. Midway between two corners,
//! the mean of their bounds is a bound.
//!
//! Rounding. Let u be 2⁻⁵³, and let all lengths be in cells of the level.
//!
//! - A place x = qx·(1/qz) is rounded by 2u of at most 1.1; its difference from the window's place, and the product
//!   with the cells a unit, by 2u of at most 2.2·4096 cells. So the place of a champion, which is at most 2 away
//!   from the corner, is wrong by e = 2⁻³⁶ at most; on joined cells by less.
//! - A product of two edges, which is twice an area, is wrong by at most 2·(2·2e) and by rounding, less than
//!   E = 2⁻³²·⁸. A triangle is taken only if the three at the corner are at least 2⁻³²: so the corner is certainly
//!   inside the exact triangle.
//! - Let r be the range of the three 1/z, and S ≥ 2⁻⁶ the sum of the three products. Then the interpolation is wrong
//!   by at most 6E·r/S < 2⁻²³·r, which is added.
//! - The interpolation's own operations, 1/z and the means of all levels round by less than 10⁻¹³ of the bound,
//!   which `depths` allows for.

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::visibility_map::grid::{Grid, LEVELS};
use crate::base::allocation::{OutOfMemory, filled};
use crate::base::real::{larger, root_of_largest, square_root};
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::hull::turned;

/// Stands for an unknown bound; at least [`UNKNOWN`] also after all means.
const NONE: f64 = 1e300;
pub(super) const UNKNOWN: f64 = 1e200;
const INSIDE: f64 = 1.0 / (1u64 << 32) as f64;
const LEAST_AREA: f64 = 1.0 / 64.0;
/// How many longest edges behind its triangle a point is hidden, where a map stands in for looks.
const EDGES: f64 = 4.0;
const PER_RANGE: f64 = 1.0 / (1u64 << 23) as f64;

/// The room for the bounds of one window, kept from map to map.
#[derive(Default)]
pub(super) struct Levels([Level; LEVELS + 1]);

/// The champions of cells, and the bounds at their corners.
#[derive(Default)]
struct Level {
    columns: usize,
    /// 1/z of each cell's champion, and its place in the cell.
    w: Vec<f64>,
    x: Vec<f64>,
    y: Vec<f64>,
    bounds: Vec<f64>,
}

/// The champions of a map, and the room for what is made of them.
pub(super) struct Champions<'a> {
    pub grid: Grid,
    pub nearest: &'a [u64],
    pub points: &'a Points,
}

impl Levels {
    /// The bounds at the corners of a window. Each is a bound of w, or at least `UNKNOWN`.
    #[inline(never)]
    pub(super) fn bounds(
        &mut self,
        champions: &Champions,
        side: usize,
        flip: &Flip,
    ) -> Result<&[f64], OutOfMemory> {
        let place = |index| flip.apply(champions.points.get(index));
        self.take(champions, side, 1.0, &place)?;
        for number in (0..=LEVELS).rev() {
            let (finer, coarser) = self.0.split_at_mut(number + 1);
            let level = &mut finer[number];
            if let Some(coarser) = coarser.first() {
                level.inherit(coarser, |a, b| 0.5 * (a + b));
            }
            level.lower(|_, _, weights, champions| interpolated(weights, champions));
            level.even_out()?;
        }
        Ok(&self.0[0].bounds)
    }

    /// How far from the viewpoint the points along the corners of a window are hidden: `behind` and some longest edges
    /// behind the triangle of champions there, of all levels the nearest; at least `UNKNOWN` where there is none.
    #[inline(never)]
    pub(super) fn surface(
        &mut self,
        champions: &Champions,
        side: usize,
        viewpoint: DVec3,
        behind: f64,
    ) -> Result<&[f64], OutOfMemory> {
        let place = |index| Some(DVec3::from_array(champions.points.get(index)) - viewpoint);
        // The nearest champions have the lowest −1/z.
        self.take(champions, side, -1.0, &place)?;
        let window = &champions.grid.windows[side];
        for number in (0..=LEVELS).rev() {
            let (finer, coarser) = self.0.split_at_mut(number + 1);
            let level = &mut finer[number];
            if let Some(coarser) = coarser.first() {
                level.inherit(coarser, larger);
            }
            let cell = (1u32 << number) as f64 / champions.grid.cells_per_unit;
            level.lower(|column, row, weights, champions| {
                let [x, y] = [window.x + column * cell, window.y + row * cell];
                let places = champions
                    .map(|[right, up, w]| DVec3::new(x + right * cell, y + up * cell, 1.0) / -w);
                let [a, b, c] = places;
                let longest = root_of_largest([a - b, b - c, c - a].map(DVec3::length_squared));
                let depth = -1.0 / interpolated(weights, champions);
                if depth > 0.0 {
                    depth * square_root(1.0 + x * x + y * y) + EDGES * longest + behind
                } else {
                    NONE
                }
            });
        }
        Ok(&self.0[0].bounds)
    }

    /// Takes the champions of a window, on all levels.
    fn take(
        &mut self,
        champions: &Champions,
        side: usize,
        sign: f64,
        place: &dyn Fn(usize) -> Option<DVec3>,
    ) -> Result<(), OutOfMemory> {
        let window = &champions.grid.windows[side];
        for (number, level) in self.0.iter_mut().enumerate() {
            level.reserve(window.columns >> number, window.rows >> number)?;
        }
        self.0[0].take(champions, side, sign, place);
        for number in 1..=LEVELS {
            let (finer, coarser) = self.0.split_at_mut(number);
            coarser[0].join(&finer[number - 1]);
        }
        Ok(())
    }
}

impl Level {
    fn reserve(&mut self, columns: usize, rows: usize) -> Result<(), OutOfMemory> {
        self.columns = columns;
        for numbers in [&mut self.w, &mut self.x, &mut self.y] {
            numbers.clear();
            numbers.try_reserve(columns * rows)?;
            numbers.resize(columns * rows, 0.0);
        }
        let corners = (columns + 1) * (rows + 1);
        self.bounds.clear();
        self.bounds.try_reserve(corners)?;
        self.bounds.resize(corners, NONE);
        Ok(())
    }

    #[inline(never)]
    fn take(
        &mut self,
        champions: &Champions,
        side: usize,
        sign: f64,
        place: &dyn Fn(usize) -> Option<DVec3>,
    ) {
        let &Champions { grid, nearest, .. } = &champions;
        let (window, cells) = (&grid.windows[side], grid.cells_per_unit);
        let mut to = 0;
        for row in 0..window.rows {
            let from = window.first + row * (window.columns + 1);
            for (column, &champion) in nearest[from..from + window.columns].iter().enumerate() {
                (self.w[to], self.x[to], self.y[to]) = (NONE, 0.5, 0.5);
                if champion < u64::MAX
                    && let Some(q) = place(champion as u32 as usize)
                {
                    let (x, y, z) = turned(side, q);
                    let inverse = 1.0 / z;
                    let x = (x * inverse - window.x) * cells - column as f64;
                    let y = (y * inverse - window.y) * cells - row as f64;
                    let is_in = |x: f64| (x - 0.5).abs() <= 1.5;
                    // Extreme numbers are left out.
                    if is_in(x) && is_in(y) && z > 1e-150 && z < 1e150 {
                        (self.w[to], self.x[to], self.y[to]) = (sign * inverse, x, y);
                    }
                }
                to += 1;
            }
        }
    }

    /// Takes the champions of cells that are half as wide.
    #[inline(never)]
    fn join(&mut self, finer: &Self) {
        let across = finer.columns;
        let places = self
            .w
            .chunks_exact_mut(self.columns)
            .zip(self.x.chunks_exact_mut(self.columns));
        let places = places.zip(self.y.chunks_exact_mut(self.columns));
        for (row, ((w, x), y)) in places.enumerate() {
            let low = 2 * row * across..(2 * row + 1) * across;
            let high = low.end..low.end + across;
            for column in 0..w.len() {
                let at = 2 * column;
                let mut best = (NONE, 0.0, 0.0);
                for (run, up) in [(&low, 0.0), (&high, 1.0)] {
                    for right in 0..2 {
                        let at = run.start + at + right;
                        let other = (finer.w[at], finer.x[at] + right as f64, finer.y[at] + up);
                        let is_less = other.0 < best.0;
                        best = (
                            chosen(is_less, other.0, best.0),
                            chosen(is_less, other.1, best.1),
                            chosen(is_less, other.2, best.2),
                        );
                    }
                }
                (w[column], x[column], y[column]) = (best.0, 0.5 * best.1, 0.5 * best.2);
            }
        }
    }

    /// Takes the bounds at the corners of larger cells, and what is `between` two of them.
    #[inline(always)]
    fn inherit(&mut self, coarser: &Self, between: impl Fn(f64, f64) -> f64) {
        let from = coarser.columns + 1;
        for (row, to) in self.bounds.chunks_exact_mut(self.columns + 1).enumerate() {
            let low = &coarser.bounds[row / 2 * from..][..from];
            let high = &coarser.bounds[row.div_ceil(2) * from..][..from];
            for ((to, l), h) in to.iter_mut().step_by(2).zip(low).zip(high) {
                *to = between(*l, *h);
            }
            for (column, to) in to[1..].iter_mut().step_by(2).enumerate() {
                let rising = between(low[column], high[column + 1]);
                let falling = between(low[column + 1], high[column]);
                *to = least(rising, falling);
            }
        }
    }

    /// Lowers the bounds by the triangles of the champions. `bound`: from the column and the row of a corner, the weights
    /// of three champions there, and x, y and 1/z of each.
    #[inline(always)]
    fn lower(&mut self, bound: impl Fn(f64, f64, [f64; 3], [[f64; 3]; 3]) -> f64) {
        let across = self.columns;
        let count = across - 1;
        for row in 1..self.w.len() / across {
            let champions = |row: usize, right: usize| {
                [&self.x, &self.y, &self.w].map(|numbers| &numbers[row * across + right..][..count])
            };
            let low = [champions(row - 1, 0), champions(row - 1, 1)];
            let high = [champions(row, 0), champions(row, 1)];
            let to = &mut self.bounds[row * (across + 1) + 1..][..count];
            lower_row(low, high, to, |column, weights, champions| {
                bound(column as f64 + 1.0, row as f64, weights, champions)
            });
        }
    }

    /// Lowers each bound to the mean of two bounds on both sides of it. A bound that was lowered already is as good.
    #[inline(never)]
    fn even_out(&mut self) -> Result<(), OutOfMemory> {
        let across = self.columns + 1;
        let all = &mut self.bounds;
        let rows = all.len() / across;
        let mut before = filled(across, 0.0)?;
        for row in 0..rows {
            let here = row * across;
            if row >= 1 && row + 1 < rows {
                let (low, rest) = all.split_at_mut(here);
                let (middle, high) = rest.split_at_mut(across);
                let low = &low[here - across..];
                let high = &high[..across];
                lower_to_means(middle, low, high);
                let inner = &mut middle[1..across - 1];
                lower_to_means(inner, &low[..across - 2], &high[2..]);
                lower_to_means(inner, &low[2..], &high[..across - 2]);
            }
            let line = &mut all[here..here + across];
            before.copy_from_slice(line);
            lower_to_means(
                &mut line[1..across - 1],
                &before[..across - 2],
                &before[2..],
            );
        }
        Ok(())
    }
}

#[inline(always)]
fn lower_to_means(to: &mut [f64], a: &[f64], b: &[f64]) {
    for ((to, a), b) in to.iter_mut().zip(a).zip(b) {
        let mean = 0.5 * (a + b);
        *to = least(*to, mean);
    }
}

/// x, y and 1/z of the champions on the left and on the right of the corners of a row.
type Beside<'a> = [[&'a [f64]; 3]; 2];

/// Lowers the bounds at the corners of a row by the champions below and above.
#[inline(always)]
fn lower_row(
    low: Beside,
    high: Beside,
    to: &mut [f64],
    bound: impl Fn(usize, [f64; 3], [[f64; 3]; 3]) -> f64,
) {
    let count = to.len();
    let [[xa, ya, wa], [xb, yb, wb]] = cut(low, count);
    let [[xd, yd, wd], [xc, yc, wc]] = cut(high, count);
    for i in 0..count {
        let a = [xa[i] - 1.0, ya[i] - 1.0, wa[i]];
        let b = [xb[i], yb[i] - 1.0, wb[i]];
        let c = [xc[i], yc[i], wc[i]];
        let d = [xd[i] - 1.0, yd[i], wd[i]];
        let (ab, bc, cd, da) = (cross(a, b), cross(b, c), cross(c, d), cross(d, a));
        let (ac, bd) = (cross(a, c), cross(b, d));
        // At each diagonal, the triangle on the side of 0.
        let pick = |first: bool, p: [f64; 3], q: [f64; 3]| {
            core::array::from_fn(|k| chosen(first, p[k], q[k]))
        };
        let right = ac < 0.0;
        let weights = [chosen(right, bc, cd), ac.abs(), chosen(right, ab, da)];
        let one = bound(i, weights, [a, pick(right, b, d), c]);
        let above = bd < 0.0;
        let weights = [chosen(above, cd, da), bd.abs(), chosen(above, bc, ab)];
        let two = bound(i, weights, [b, pick(above, c, a), d]);
        to[i] = least(to[i], least(one, two));
    }
}

/// One of two numbers. WebAssembly engines make a branch of a choice between floats, which no processor could guess here.
#[inline(always)]
fn chosen(is_first: bool, first: f64, second: f64) -> f64 {
    let keep = u64::from(is_first).wrapping_neg();
    f64::from_bits(first.to_bits() & keep | second.to_bits() & !keep)
}

/// The smaller one of two numbers that are not negative: they are in the order of their bits.
#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    f64::from_bits(a.to_bits().min(b.to_bits()))
}

/// Of equal lengths, as the compiler must know to leave out checks.
#[inline(always)]
fn cut(sides: Beside, count: usize) -> Beside {
    let [[a, b, c], [d, e, f]] = sides;
    [
        [&a[..count], &b[..count], &c[..count]],
        [&d[..count], &e[..count], &f[..count]],
    ]
}

#[inline(always)]
fn cross(p: [f64; 3], q: [f64; 3]) -> f64 {
    p[0] * q[1] - p[1] * q[0]
}

/// The interpolation of three champions' 1/z with three weights, and what its error may be.
#[inline(always)]
fn interpolated([p, q, r]: [f64; 3], champions: [[f64; 3]; 3]) -> f64 {
    let [of_p, of_q, of_r] = champions.map(|champion| champion[2]);
    let sum = p + q + r;
    let (to_q, to_r) = (of_q - of_p, of_r - of_p);
    let bound = of_p + (q * to_q + r * to_r) / sum + PER_RANGE * (to_q.abs() + to_r.abs());
    let is_sure = (p >= INSIDE) & (q >= INSIDE) & (r >= INSIDE) & (sum >= LEAST_AREA);
    chosen(is_sure, bound, NONE)
}
