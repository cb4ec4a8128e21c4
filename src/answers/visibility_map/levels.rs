//! From champions to distances.
//!
//! On a side of the cube a flipped point is z·c, where c = (x, y, 1). The gauge w of K is convex and at most 1/z at c. Let S
//! be a length, and let g = S·w − |c|, which keeps its digits in single precision: 2R − d is not much less than 2R. |c| bends
//! by at most |δ|²/(2|c|) at a distance δ. So at a corner c, in a triangle of three champions beside it, g is at most the
//! interpolation of gᵢ + |cᵢ − c|²/(2|c|). Both triangles count that the champions of the four cells around a corner
//! make with a diagonal; the lower bound is the better one. The same is done with cells that are joined two by two,
//! again and again: their triangles reach over holes. In a cone,
//! those of the first join count at the corners of the finest cells as well, which are half a cell beside their corner. Midway between two corners, the mean of their bounds
//! with that bend is a bound.
//!
//! Rounding. Let u be 2⁻²⁴, let n be the cells a unit, at most 4096, and let all lengths be in cells of the level.
//!
//! - The coordinates of a champion are wrong by u of themselves; its place in a cell is wrong by at most
//!   4u·1.06n for the quotient and the product, by 1.1u·n for the window's start and by 2.2u·n for the difference: by less
//!   than b = 8u·n, also after all joins.
//! - A place is at most 1.5 from a corner or from what is half a cell beside it, on either axis.
//! - A product of two edges, which is twice an area, is wrong by at most 6b + 2b² + 10u < E = 7b. A triangle is taken only
//!   if the three at the corner are at least E: then the corner is inside the exact triangle. If their sum A is at least
//!   12E, the weights are wrong by at most 3E/(A − 3E) < 4E/A together, and this share of the range of the three is added.
//! - |cᵢ − c|² is wrong by less than 7b.
//! - The distance d is rounded up. |c| is wrong by less than 12u, and the operations of all levels round by less than 50u,
//!   relative to the bound, as no number is negative. `MARGIN` is 128u.
//! - The flip of a point rounds 1/z by less than `ROUNDING`.

use alloc::vec::Vec;
use glam::{BVec4A, Vec4};

use crate::answers::visibility_map::gauge::{Gauge, LEAST, NONE, UNIT, UNKNOWN};
use crate::answers::visibility_map::grid::{Cell, EMPTY, Grid, LEVELS, padded, refill};
use crate::base::allocation::OutOfMemory;
use crate::base::real::square_root;
use crate::hull::Window;

/// The room for one window, kept from map to map.
#[derive(Default)]
pub(super) struct Levels {
    levels: [Level; LEVELS + 1],
    rows: [Row; 2],
    losses: [[Vec<f32>; 2]; 2],
}

/// The champions of a map.
pub(super) struct Champions<'a> {
    pub grid: Grid,
    pub cells: &'a [Cell],
    /// Whether only a cone counts: there is time to look between the corners of joined cells.
    pub is_cone: bool,
}

/// Cells that are 2^k as wide, and the bounds at their corners.
#[derive(Default)]
pub(super) struct Level {
    pub columns: usize,
    pub rows: usize,
    /// Those of the finest level are the map's.
    cells: Vec<Cell>,
    pub bounds: Vec<f32>,
    /// For looks: how far points are hidden along each corner.
    pub surface: Vec<f32>,
}

/// The champions of a row: their places in the cells, and bounds of g.
#[derive(Default)]
pub(super) struct Row {
    x: Vec<f32>,
    y: Vec<f32>,
    g: Vec<f32>,
    pub d: Vec<f32>,
}

impl Levels {
    /// Writes the distances along the corners of a window, and up to three numbers more.
    #[inline(never)]
    pub(super) fn fill(
        &mut self,
        &Champions {
            grid,
            cells,
            is_cone,
        }: &Champions,
        side: usize,
        gauge: Gauge,
        to: &mut [f32],
    ) -> Result<(), OutOfMemory> {
        let window = &grid.windows[side];
        let cells = &cells[grid.start(side)..];
        for (number, level) in self.levels.iter_mut().enumerate() {
            let (columns, rows) = (window.columns >> number, window.rows >> number);
            level.reserve(columns, rows, number > 0, gauge.behind.is_some())?;
        }
        for rows in &mut self.rows {
            for numbers in [&mut rows.x, &mut rows.y, &mut rows.g, &mut rows.d] {
                refill(numbers, padded(window.columns), 0.5)?;
            }
        }
        for number in 1..=LEVELS {
            let (finer, coarser) = self.levels.split_at_mut(number);
            let joined = &finer[number - 1].cells;
            let finer = if number > 1 { joined } else { cells };
            coarser[0].join(finer, grid.bits());
        }
        for number in (0..=LEVELS).rev() {
            let (finer, coarser) = self.levels.split_at_mut(number + 1);
            let (finer, level) = finer.split_at_mut(number);
            let level = &mut level[0];
            let is_between = is_cone && number == 1 && gauge.behind.is_none();
            let between = if is_between { finer.last_mut() } else { None };
            let scale = Scale::of(&grid, window, number);
            if let Some(coarser) = coarser.first() {
                level.inherit(coarser, &scale);
            }
            let finest = (number == 0).then_some(cells);
            level.lower(finest, &scale, gauge, &mut self.rows, between);
            level.even_out(&scale);
        }
        let scale = Scale::of(&grid, window, 0);
        self.levels[0].distances(&scale, gauge, &mut self.losses, to)
    }
}

/// The places of the corners of a level, and what rounding does to them.
pub(super) struct Scale {
    x: f32,
    y: f32,
    pub cell: f32,
    /// The unit of a place in a cell.
    part: f32,
    /// E, and the least sum of three areas. |δ|² may be larger by as much.
    pub error: f32,
    pub area: f32,
}

impl Scale {
    fn of(grid: &Grid, window: &Window, number: usize) -> Self {
        let part = 1.0 / (1u32 << grid.bits()) as f32;
        let b = 8.0 * UNIT * grid.cells_per_unit as f32 + 3.0 * part;
        Self {
            x: window.x as f32,
            y: window.y as f32,
            cell: ((1u32 << number) as f64 / grid.cells_per_unit) as f32,
            part,
            error: 7.0 * b,
            area: (84.0 * b).max(1.0 / 64.0),
        }
    }

    /// How much |c| bends in a row of corners for each |δ|², rounded up.
    fn bend_of(&self, row: usize) -> f32 {
        self.bend_at(row as f64)
    }

    fn bend_at(&self, row: f64) -> f32 {
        let y = f64::from(self.y) + row * f64::from(self.cell);
        let c = square_root(1.0 + y * y);
        (0.5 * f64::from(self.cell) * f64::from(self.cell) / c) as f32 * (1.0 + 8.0 * UNIT)
    }

    /// |c|² at four corners of a row.
    #[inline(always)]
    pub(super) fn squared(&self, row: usize) -> impl Fn(usize) -> Vec4 {
        let y = self.y + row as f32 * self.cell;
        let &Self { x, cell, .. } = self;
        move |column| {
            let x = (STEPS + column as f32) * cell + x;
            x * x + (1.0 + y * y)
        }
    }
}

pub(super) const STEPS: Vec4 = Vec4::new(0.0, 1.0, 2.0, 3.0);

impl Level {
    fn reserve(
        &mut self,
        columns: usize,
        rows: usize,
        has_cells: bool,
        has_surface: bool,
    ) -> Result<(), OutOfMemory> {
        (self.columns, self.rows) = (columns, rows);
        let (cells, corners) = (rows * padded(columns), (rows + 1) * padded(columns));
        refill(&mut self.cells, usize::from(has_cells) * cells, EMPTY)?;
        refill(&mut self.bounds, corners, NONE)?;
        refill(&mut self.surface, usize::from(has_surface) * corners, NONE)
    }

    /// Takes the champions of cells that are half as wide. A place has `bits` bits.
    #[inline(never)]
    fn join(&mut self, finer: &[Cell], bits: u32) {
        let (across, from) = (padded(self.columns), padded(2 * self.columns));
        let half = |cell: Cell, right: u64, up: u64| {
            let place = (cell & 0xffff_ffff) + (right << (16 + bits)) + (up << bits);
            cell >> 32 << 32 | place >> 1 & 0x7fff_7fff
        };
        for (row, to) in self.cells.chunks_exact_mut(across).enumerate() {
            let low = &finer[2 * row * from..][..2 * self.columns];
            let high = &finer[(2 * row + 1) * from..][..2 * self.columns];
            let pairs = low.chunks_exact(2).zip(high.chunks_exact(2));
            for (to, (low, high)) in to.iter_mut().zip(pairs) {
                let one = half(low[0], 0, 0).min(half(low[1], 1, 0));
                *to = one.min(half(high[0], 0, 1).min(half(high[1], 1, 1)));
            }
        }
    }

    /// Takes the bounds at the corners of larger cells, and what is between two of them.
    #[inline(never)]
    fn inherit(&mut self, coarser: &Self, scale: &Scale) {
        let (across, from) = (padded(self.columns), padded(coarser.columns));
        let has_surface = !self.surface.is_empty();
        for row in 0..=self.rows {
            let bend = scale.bend_of(row);
            let (low, high) = (row / 2 * from, row.div_ceil(2) * from);
            let twice = bend * if row % 2 == 0 { 1.0 } else { 2.0 };
            let straight = bend * if row % 2 == 0 { 0.0 } else { 1.0 };
            let mean = |a: f32, b: f32| 0.5 * (a + b);
            inherit_row(
                &coarser.bounds[low..][..=coarser.columns],
                &coarser.bounds[high..][..=coarser.columns],
                &mut self.bounds[row * across..][..=self.columns],
                |a, b| mean(a, b) + straight,
                |a, b| mean(a, b) + twice,
            );
            if has_surface {
                inherit_row(
                    &coarser.surface[low..][..=coarser.columns],
                    &coarser.surface[high..][..=coarser.columns],
                    &mut self.surface[row * across..][..=self.columns],
                    most,
                    most,
                );
            }
        }
    }

    /// Lowers the bounds by the triangles of the champions.
    #[inline(never)]
    fn lower(
        &mut self,
        finest: Option<&[Cell]>,
        scale: &Scale,
        gauge: Gauge,
        rows: &mut [Row; 2],
        mut between: Option<&mut Self>,
    ) {
        let across = padded(self.columns);
        let [low, high] = rows;
        for row in 0..self.rows {
            core::mem::swap(low, high);
            let cells = &finest.unwrap_or(&self.cells)[row * across..][..across];
            high.take(cells, scale, row, gauge);
            if row == 0 {
                continue;
            }
            let bend = scale.bend_of(row);
            let line = row * across;
            for at in (1..self.columns).step_by(4) {
                if !(low.is_there(at) && high.is_there(at)) {
                    continue;
                }
                let bounds = &mut self.bounds[line + at..];
                if let Some(finer) = &mut between {
                    finer.lower_between([low, high], row, at, self.columns - at, scale);
                }
                let corner = Corner::of([low, high], at, [0.0, 0.0], bend, scale);
                let bound = corner.bound() + bend * scale.error;
                bound.min(Vec4::from_slice(bounds)).write_to_slice(bounds);
                if let Some(behind) = gauge.behind {
                    let far = corner.surface([low, high], at, bend, behind);
                    let surface = &mut self.surface[line + at..];
                    far.min(Vec4::from_slice(surface)).write_to_slice(surface);
                }
            }
        }
    }

    /// Lowers the bounds that are half a cell beside corners of cells that are twice as wide.
    #[inline(never)]
    fn lower_between(
        &mut self,
        rows: [&Row; 2],
        row: usize,
        at: usize,
        count: usize,
        scale: &Scale,
    ) {
        let across = padded(self.columns);
        for (y, up) in [-0.5, 0.0, 0.5].into_iter().enumerate() {
            let line = (2 * row + y - 1) * across;
            let bend = scale.bend_at(row as f64 + f64::from(up));
            for (x, right) in [-0.5, 0.0, 0.5].into_iter().enumerate() {
                let corner = Corner::of(rows, at, [right, up], bend, scale);
                let bounds = (corner.bound() + bend * scale.error).to_array();
                let to = self.bounds[line + 2 * at + x - 1..].iter_mut().step_by(2);
                for (to, bound) in to.zip(bounds).take(count) {
                    *to = least(*to, bound);
                }
            }
        }
    }

    /// Lowers each bound to the mean of two bounds on both sides of it. A bound that was lowered already is as good.
    #[inline(never)]
    fn even_out(&mut self, scale: &Scale) {
        let across = padded(self.columns);
        for row in 0..=self.rows {
            let bend = scale.bend_of(row);
            let is_inside = row > 0 && row < self.rows;
            for at in (1..self.columns).step_by(4) {
                let here = row * across + at;
                let number = |at: usize| Vec4::from_slice(&self.bounds[at..]);
                let mean = |a: usize, b: usize| (number(a) + number(b)) * 0.5;
                let mut bound = number(here).min(mean(here - 1, here + 1) + bend);
                if is_inside {
                    let (low, high) = (here - across, here + across);
                    bound = bound.min(mean(low, high) + bend);
                    let aslant = mean(low - 1, high + 1).min(mean(low + 1, high - 1));
                    bound = bound.min(aslant + 2.0 * bend);
                }
                bound.write_to_slice(&mut self.bounds[here..]);
            }
        }
    }
}

#[inline(always)]
fn inherit_row(
    low: &[f32],
    high: &[f32],
    to: &mut [f32],
    straight: impl Fn(f32, f32) -> f32,
    aslant: impl Fn(f32, f32) -> f32,
) {
    for ((to, l), h) in to.iter_mut().step_by(2).zip(low).zip(high) {
        *to = least(*to, straight(*l, *h));
    }
    let pairs = low.windows(2).zip(high.windows(2));
    for (to, (low, high)) in to[1..].iter_mut().step_by(2).zip(pairs) {
        let mean = least(aslant(low[0], high[1]), aslant(low[1], high[0]));
        *to = least(*to, mean);
    }
}

/// The smaller one of two numbers that are not negative: they are in the order of their bits. WebAssembly engines make a
/// branch of a choice between floats, which no processor could guess here.
#[inline(always)]
fn least(a: f32, b: f32) -> f32 {
    f32::from_bits(a.to_bits().min(b.to_bits()))
}

#[inline(always)]
fn most(a: f32, b: f32) -> f32 {
    f32::from_bits(a.to_bits().max(b.to_bits()))
}

impl Row {
    /// Takes the champions of a row of cells.
    #[inline(always)]
    fn take(&mut self, cells: &[Cell], scale: &Scale, row: usize, gauge: Gauge) {
        let start = scale.y + row as f32 * scale.cell;
        for at in (0..cells.len()).step_by(4) {
            let cells = [cells[at], cells[at + 1], cells[at + 2], cells[at + 3]];
            let z = Vec4::from_array(cells.map(|cell| f32::from_bits((cell >> 32) as u32)));
            let is_there = z.cmplt(Vec4::splat(1e16)) & z.cmpge(Vec4::splat(LEAST));
            if !is_there.any() {
                Vec4::splat(NONE).write_to_slice(&mut self.g[at..]);
                continue;
            }
            let part = |by: u32| cells.map(|cell| (cell >> by & 0xffff) as i32 as f32);
            let x = Vec4::from_array(part(16)) * scale.part;
            let y = Vec4::from_array(part(0)) * scale.part;
            let right = (x + (STEPS + at as f32)) * scale.cell + scale.x;
            let up = y * scale.cell + start;
            let c = (right * right + up * up + 1.0).sqrt();
            let d = z * c;
            let g = Vec4::select(is_there, gauge.bound(d) * c, Vec4::splat(NONE));
            x.write_to_slice(&mut self.x[at..]);
            y.write_to_slice(&mut self.y[at..]);
            g.write_to_slice(&mut self.g[at..]);
            d.write_to_slice(&mut self.d[at..]);
        }
    }

    /// Whether there is a champion beside four corners.
    #[inline(always)]
    fn is_there(&self, at: usize) -> bool {
        let g = |at: usize| Vec4::from_slice(&self.g[at..]);
        g(at - 1).min(g(at)).cmplt(Vec4::splat(UNKNOWN)).any()
    }

    /// Champions relative to corners: their places, and bounds of g with the bend of |c|.
    #[inline(always)]
    fn champion(&self, at: usize, right: f32, up: f32, bend: f32) -> [Vec4; 3] {
        let x = Vec4::from_slice(&self.x[at..]) - right;
        let y = Vec4::from_slice(&self.y[at..]) - up;
        let g = Vec4::from_slice(&self.g[at..]) + (x * x + y * y) * bend;
        [x, y, g]
    }
}

/// Four champions around each of four corners, against the clock from the one on the lower left.
pub(super) struct Corner<'a> {
    pub champions: [[Vec4; 3]; 4],
    pub scale: &'a Scale,
}

/// The areas of two triangles, one at each diagonal, and which one of two they are.
pub(super) struct Triangles {
    pub weights: [[Vec4; 3]; 2],
    pub picks: [BVec4A; 2],
}

impl<'a> Corner<'a> {
    /// Places `beside` four corners, in cells.
    #[inline(always)]
    fn of(
        [low, high]: [&Row; 2],
        at: usize,
        [right, up]: [f32; 2],
        bend: f32,
        scale: &'a Scale,
    ) -> Self {
        let champions = [
            low.champion(at - 1, right + 1.0, up + 1.0, bend),
            low.champion(at, right, up + 1.0, bend),
            high.champion(at, right, up, bend),
            high.champion(at - 1, right + 1.0, up, bend),
        ];
        Self { champions, scale }
    }

    #[inline(always)]
    pub(super) fn triangles(&self) -> Triangles {
        let [a, b, c, d] = self.champions;
        let (ab, bc, cd, da) = (cross(a, b), cross(b, c), cross(c, d), cross(d, a));
        let (ac, bd) = (cross(a, c), cross(b, d));
        // At each diagonal, the triangle on the side of the corner.
        let (right, above) = (ac.cmplt(Vec4::ZERO), bd.cmplt(Vec4::ZERO));
        let pick = Vec4::select;
        Triangles {
            weights: [
                [pick(right, bc, cd), ac.abs(), pick(right, ab, da)],
                [pick(above, cd, da), bd.abs(), pick(above, bc, ab)],
            ],
            picks: [right, above],
        }
    }

    /// The lower one of two interpolations of g, with what their errors may be.
    #[inline(always)]
    fn bound(&self) -> Vec4 {
        let [a, b, c, d] = self.champions.map(|champion| champion[2]);
        let Triangles { weights, picks } = self.triangles();
        let one = self.interpolated(weights[0], [a, Vec4::select(picks[0], b, d), c]);
        let two = self.interpolated(weights[1], [b, Vec4::select(picks[1], c, a), d]);
        one.min(two)
    }

    #[inline(always)]
    fn interpolated(&self, [p, q, r]: [Vec4; 3], [of_p, of_q, of_r]: [Vec4; 3]) -> Vec4 {
        let &Scale { error, area, .. } = self.scale;
        let sum = p + q + r;
        let range = (of_q - of_p).abs() + (of_r - of_p).abs();
        let bound = (p * of_p + q * of_q + r * of_r + range * (4.0 * error)) / sum;
        let is_sure = p.min(q).min(r).cmpge(Vec4::splat(error)) & sum.cmpge(Vec4::splat(area));
        Vec4::select(is_sure, bound, Vec4::splat(NONE))
    }
}

#[inline(always)]
fn cross(p: [Vec4; 3], q: [Vec4; 3]) -> Vec4 {
    p[0] * q[1] - p[1] * q[0]
}
