//! From reaches along corners to distances that bound those of all directions of a cell.
//!
//! Let h be the edge of a cell, ρᵢ the reaches along its corners cᵢ = (x, y, 1), and M and m the
//! largest and the least of them. In the cell w = |c|/ρ is at most the interpolation of its values
//! |cᵢ|/ρᵢ (`hull/depth`). So ρ is at least |c|/Σλᵢ|cᵢ| times the harmonic mean of the ρᵢ with the
//! weights μᵢ, which are λᵢ|cᵢ| divided by their sum.
//!
//! - |c| is convex. An interpolation is above it by at most h²/8 times the sum of its second
//!   derivatives along x and y, which is (2 + x² + y²)/|c|³ ≤ 2. From a corner into the cells around
//!   it, this sum divided by |c| grows by at most e^5h. So Σλᵢ|cᵢ| ≤ |c|·(1 + `bulge`).
//! - The harmonic mean is at most (√M − √m)² ≤ (M − m)²/4m below the arithmetic one.
//! - |cᵢ| changes by at most h√2 in a cell, so to take λᵢ for μᵢ costs at most (M − m)·h/√2.
//!
//! Together ρ ≥ Σλᵢ(ρᵢ − S)·(1 − bulgeᵢ), where S is the sum of the last two. The distance is convex
//! in the reach. So its interpolation, made with the largest S around each corner, is a bound.
//!
//! Where M is much larger than m, S is larger than m, and nothing is left. But ρ ≥ m·(1 − bulge) as
//! well: there, all four corners take the distance of m.

use crate::answers::visibility_map::hides::{MOST, VisibilityMap};
use crate::answers::visibility_map::levels::{Champions, Levels, UNKNOWN};
use crate::base::allocation::{OutOfMemory, filled};
use crate::base::real::{larger, smaller, square_root};
use crate::flip::inversion::Flip;
use crate::hull::Window;

/// Stands for a direction in which nothing is hidden.
pub(super) const NOWHERE: f32 = f32::MAX;
/// The least distance in a map. Single precision may flush a smaller one to 0.
const LEAST: f64 = 1e-30;
/// The share of the least reach of a cell that its interpolation may lose.
const MOST_LOST: f64 = 0.5;
/// The rounding to single precision, upwards.
const UP: f64 = 1.0 + 2.4e-7;
/// A bound of the relative errors of a flipped point, a bound of w and a reach.
const ROUNDING: f64 = 1e-12;

impl VisibilityMap {
    /// Writes the distances of the bounds of w.
    #[inline(never)]
    pub(super) fn fill(
        &mut self,
        champions: &Champions,
        levels: &mut Levels,
        flip: &Flip,
    ) -> Result<(), OutOfMemory> {
        let grid = &champions.grid;
        let cell = 1.0 / grid.cells_per_unit;
        let mut lengths = filled(grid.corners(), 0.0)?;
        let mut least = filled(lengths.len(), 0)?;
        let mut distances = filled(lengths.len(), NOWHERE)?;
        for (side, window) in grid.used() {
            let bounds = levels.bounds(champions, side, flip)?;
            each_corner(window, cell, &mut |place, _, squared| {
                let bound = bounds[place - window.first];
                if bound < UNKNOWN {
                    lengths[place] = square_root(squared) / bound * (1.0 - ROUNDING);
                    least[place] = lengths[place].to_bits();
                }
            });
            lower(window, cell, &lengths, &mut least);
            each_corner(window, cell, &mut |place, _, squared| {
                if least[place] > 0 {
                    let reach = f64::from_bits(least[place]) * (1.0 - bulge(cell, squared));
                    distances[place] = stored(flip.distance_at(reach));
                }
            });
        }
        self.set(grid, &distances)
    }
}

/// A distance in single precision, at least as large.
pub(super) fn stored(distance: f64) -> f32 {
    if distance < MOST {
        (larger(distance, LEAST) * UP) as f32
    } else {
        NOWHERE
    }
}

/// Passes the index, the place and the squared length of each corner (x, y, 1) of a window.
#[inline(always)]
pub(super) fn each_corner(window: &Window, cell: f64, pass: &mut impl FnMut(usize, [f64; 2], f64)) {
    let mut place = window.first;
    for row in 0..window.corners() / (window.columns + 1) {
        let y = window.y + row as f64 * cell;
        for column in 0..=window.columns {
            let x = window.x + column as f64 * cell;
            pass(place, [x, y], 1.0 + x * x + y * y);
            place += 1;
        }
    }
}

/// By what share an interpolation of |c| is at most too large in the cells around the corner with this
/// |c|².
#[inline]
fn bulge(cell: f64, squared: f64) -> f64 {
    let sum = (1.0 + squared) / (squared * squared);
    // e^5h < 1 + 8h up to here.
    let grown = if cell < 0.15 { 1.0 + 8.0 * cell } else { 10.0 };
    0.125 * cell * cell * smaller(2.0, sum * grown)
}

/// For all corners of a window, lowers the reaches by what the cells around lose. Numbers that are not negative are in
/// the order of their bits: without a branch, which no processor could guess.
fn lower(window: &Window, cell: f64, lengths: &[f64], least: &mut [u64]) {
    let across = window.columns + 1;
    for row in 0..window.rows {
        let both = window.first + row * across..window.first + (row + 2) * across;
        let (low, high) = lengths[both.clone()].split_at(across);
        let (least_low, least_high) = least[both].split_at_mut(across);
        let [mut a, mut c] = [low[0], high[0]];
        let mut before = ends(a, c);
        for column in 0..window.columns {
            let [b, d] = [low[column + 1], high[column + 1]];
            let beyond = ends(b, d);
            let m = f64::from_bits(before[0].min(beyond[0]));
            // A cell with an unknown corner hides nothing.
            if m > 0.0 {
                let range = f64::from_bits(before[1].max(beyond[1])) - m;
                let lost = range * (0.25 * range / m + 0.708 * cell) * (1.0 + 1e-12);
                let is_much = lost >= MOST_LOST * m;
                let left = |length: f64| if is_much { m } else { length - lost }.to_bits();
                least_low[column] = least_low[column].min(left(a));
                least_high[column] = least_high[column].min(left(c));
                least_low[column + 1] = least_low[column + 1].min(left(b));
                least_high[column + 1] = least_high[column + 1].min(left(d));
            }
            (a, c, before) = (b, d, beyond);
        }
    }
}

/// The bits of the smaller and the larger one.
#[inline]
fn ends(a: f64, b: f64) -> [u64; 2] {
    let [a, b] = [a.to_bits(), b.to_bits()];
    [a.min(b), a.max(b)]
}
