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
//!
//! Where M is much larger than m, S is larger than m, and nothing is left. But ρ ≥ m·(1 − h²/4) as
//! well: there, all four corners take the distance of m.

use crate::answers::visibility_map::hides::VisibilityMap;
use crate::base::allocation::{OutOfMemory, filled};
use crate::base::real::{larger, smaller, square_root};
use crate::flip::inversion::Flip;
use crate::hull::{Reaches, Window};

/// Stands for a direction in which nothing is hidden.
const NOWHERE: f32 = 1e30;
/// The least distance in a map. Single precision may flush a smaller one to 0.
const LEAST: f64 = 1e-30;
/// The share of the least reach of a cell that its interpolation may lose.
const MOST_LOST: f64 = 0.5;
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
        let mut most = filled(lengths.len(), f64::INFINITY)?;
        for window in &reaches.windows {
            bound(window, cell, lengths, &mut slack, &mut most);
        }
        let shrink = 1.0 - 0.25 * cell * cell;
        let distance = |((&length, slack), most): ((&f64, f64), f64)| {
            if length > 0.0 {
                let reach = smaller(length * shrink - slack, most * shrink);
                let distance = flip.distance_at(reach) + thickness;
                if distance < f64::from(NOWHERE) {
                    return (larger(distance, LEAST) * UP) as f32;
                }
            }
            NOWHERE
        };
        let distances = lengths.iter().zip(slack).zip(most).map(distance);
        self.set(reaches, distances)
    }
}

/// For all corners of a window, raises what their reaches lose, or lowers what they may be at most.
fn bound(window: &Window, cell: f64, lengths: &[f64], slack: &mut [f64], most: &mut [f64]) {
    let across = window.columns + 1;
    for row in 0..window.rows {
        for column in 0..window.columns {
            let low = window.first + row * across + column;
            let corners = [low, low + 1, low + across, low + across + 1];
            let [mut m, mut above] = [f64::INFINITY, 0.0];
            for corner in corners {
                m = smaller(m, lengths[corner]);
                above = larger(above, lengths[corner]);
            }
            // A cell with an unknown corner hides nothing.
            if m > 0.0 {
                let roots = square_root(above) - square_root(m);
                let lost = (roots * roots + 0.708 * cell * (above - m)) * (1.0 + 1e-12);
                for corner in corners {
                    if lost < MOST_LOST * m {
                        slack[corner] = larger(slack[corner], lost);
                    } else {
                        most[corner] = smaller(most[corner], m);
                    }
                }
            }
        }
    }
}
