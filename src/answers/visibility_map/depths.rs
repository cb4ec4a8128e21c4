//! From reaches along corners to distances that bound those of all directions of a cell.
//!
//! Let h be the edge of a cell, ρᵢ the reaches along its corners cᵢ = (x, y, 1), and M and m the
//! largest and the least of them. In the cell w = |c|/ρ is at most the interpolation of its values
//! |cᵢ|/ρᵢ (`hull/depth`). So ρ is at least |c|/Σλᵢ|cᵢ| times the harmonic mean of the ρᵢ with the
//! weights μᵢ, which are λᵢ|cᵢ| divided by their sum.
//!
//! - |c| is convex with second derivatives up to 1, so Σλᵢ|cᵢ| ≤ |c|·(1 + h²/4).
//! - The harmonic mean is at most (√M − √m)² below the arithmetic one.
//! - |cᵢ| changes by at most h√2 in a cell, so to take λᵢ for μᵢ costs at most (M − m)·h/√2.
//!
//! Together ρ ≥ Σλᵢ(ρᵢ·(1 − h²/4) − S), where S is the sum of the last two. The distance is convex in
//! the reach. So its interpolation, made with the largest S around each corner, is a bound.

use super::hides::VisibilityMap;
use crate::base::allocation::{OutOfMemory, filled};
use crate::base::real::{larger, smaller, square_root};
use crate::flip::inversion::Flip;
use crate::hull::{Reaches, Window};

/// Stands for a direction in which nothing is hidden.
const NOWHERE: f32 = 1e30;
/// The least distance in a map. Single precision may flush a smaller one to 0.
const LEAST: f64 = 1e-30;
/// The rounding to single precision, upwards.
const UP: f64 = 1.0 + 2.4e-7;

impl VisibilityMap {
    /// Writes the distances of these reaches, each with the thickness behind it.
    pub(super) fn fill(
        &mut self,
        reaches: &Reaches,
        flip: &Flip,
        thickness: f64,
    ) -> Result<(), OutOfMemory> {
        let lengths = &reaches.lengths;
        let cell = 1.0 / reaches.cells_per_unit;
        let mut slack = filled(lengths.len(), 0.0)?;
        for window in &reaches.windows {
            raise(window, cell, lengths, &mut slack);
        }
        let shrink = 1.0 - 0.25 * cell * cell;
        let distance = |(&length, slack): (&f64, f64)| {
            if length > 0.0 {
                let distance = flip.distance_at(length * shrink - slack) + thickness;
                if distance < f64::from(NOWHERE) {
                    return (larger(distance, LEAST) * UP) as f32;
                }
            }
            NOWHERE
        };
        self.set(reaches, lengths.iter().zip(slack).map(distance))
    }
}

/// Raises the slack of all corners of a window to those of their cells.
fn raise(window: &Window, cell: f64, lengths: &[f64], slack: &mut [f64]) {
    let across = window.columns + 1;
    for row in 0..window.rows {
        for column in 0..window.columns {
            let low = window.first + row * across + column;
            let corners = [low, low + 1, low + across, low + across + 1];
            let [mut least, mut most] = [f64::INFINITY, 0.0];
            for corner in corners {
                least = smaller(least, lengths[corner]);
                most = larger(most, lengths[corner]);
            }
            // A cell with an unknown corner hides nothing.
            if least > 0.0 {
                let roots = square_root(most) - square_root(least);
                let lost = (roots * roots + 0.708 * cell * (most - least)) * (1.0 + 1e-12);
                for corner in corners {
                    slack[corner] = larger(slack[corner], lost);
                }
            }
        }
    }
}
