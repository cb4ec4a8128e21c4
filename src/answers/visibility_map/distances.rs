//! From bounds of g along corners to distances that bound those of all directions of a cell.
//!
//! Let h be the edge of a cell, ρᵢ = |cᵢ|/w the reaches of the bounds along its corners, and M and m the largest and the
//! least of them. In the cell w is at most the interpolation of its values at the corners. So ρ is at least |c|/Σλᵢ|cᵢ| times the
//! harmonic mean of the ρᵢ with the weights μᵢ, which are λᵢ|cᵢ| divided by their sum.
//!
//! - |c| is convex. An interpolation is above it by at most h²/8 times the sum of its second derivatives along x and y,
//!   which is (2 + x² + y²)/|c|³ ≤ 2. From a corner into the cells around it, this sum divided by |c| grows by at most
//!   e^5h. So Σλᵢ|cᵢ| ≤ |c|·(1 + `bulge`).
//! - The harmonic mean is at most (√M − √m)² ≤ (M − m)²/4m below the arithmetic one.
//! - |cᵢ| changes by at most h√2 in a cell, so to take λᵢ for μᵢ costs at most (M − m)·h/√2.
//!
//! With G = S/ρ − 1 and q = (M − m)/m, a reach that loses the share l = q·(q/4 + h/√2) + bulge of itself has (G + l)/(1 − l).
//! The distance is convex in the reach. So the interpolation of distances, made with the largest l around each corner,
//! is a bound. Where q is large nothing would be left, but ρ ≥ m·(1 − bulge) as well: there all four corners take m.

use alloc::vec::Vec;
use glam::Vec4;

use crate::answers::visibility_map::gauge::{Gauge, LEAST, MOST, NOWHERE, UNIT, UNKNOWN};
use crate::answers::visibility_map::grid::{padded, refill};
use crate::answers::visibility_map::levels::{Level, Scale};
use crate::base::allocation::OutOfMemory;

const MARGIN: f32 = 1.0 + 128.0 * UNIT;
/// A bound of the relative error of 1/z in the flip of a point.
const ROUNDING: f32 = 1e-12;
/// The share of a reach that its interpolation may lose.
const MOST_LOST: f32 = 0.5;

impl Level {
    /// From bounds to distances.
    #[inline(never)]
    pub(super) fn distances(
        &mut self,
        scale: &Scale,
        gauge: Gauge,
        losses: &mut [[Vec<f32>; 2]; 2],
        to: &mut [f32],
    ) -> Result<(), OutOfMemory> {
        let across = padded(self.columns);
        let h = scale.cell;
        // What a row of cells loses: shares, and the largest G.
        for numbers in losses.as_flattened_mut() {
            refill(numbers, across + 4, 0.0)?;
        }
        // e^5h < 1 + 8h up to here.
        let grown = if h < 0.15 { 1.0 + 8.0 * h } else { 1e3 };
        // The bounds become G.
        for row in 0..=self.rows {
            let squared = scale.squared(row);
            for at in (0..=self.columns).step_by(4) {
                let numbers = &mut self.bounds[row * across + at..];
                let bound = Vec4::from_slice(numbers);
                if bound.cmplt(Vec4::splat(UNKNOWN)).any() {
                    (bound * MARGIN / squared(at).sqrt() + ROUNDING).write_to_slice(numbers);
                }
            }
        }
        for row in 0..=self.rows {
            let line = row * across;
            let squared = scale.squared(row);
            let [below, above] = &mut *losses;
            if row < self.rows {
                for at in (0..self.columns).step_by(4) {
                    let number = |at: usize| Vec4::from_slice(&self.bounds[at..]);
                    let (a, b) = (number(line + at), number(line + at + 1));
                    let (c, d) = (number(line + across + at), number(line + across + at + 1));
                    let (most, least) = (a.max(b).max(c.max(d)), a.min(b).min(c.min(d)));
                    let q = (most - least) / (least + 1.0);
                    let share = q * (q * 0.25 + 0.708 * h);
                    let is_known = most.cmplt(Vec4::splat(UNKNOWN));
                    let is_much = share.cmpge(Vec4::splat(MOST_LOST));
                    let none = Vec4::ZERO;
                    // A cell with an unknown corner hides nothing.
                    let share = Vec4::select(is_known, Vec4::select(is_much, none, share), none);
                    let most = Vec4::select(is_known, Vec4::select(is_much, most, none), none);
                    share.write_to_slice(&mut above[0][at + 1..]);
                    most.write_to_slice(&mut above[1][at + 1..]);
                }
                // Beyond the last one is no cell.
                for beyond in &mut *above {
                    beyond[self.columns + 1..].fill(0.0);
                }
            } else {
                above[0].fill(0.0);
                above[1].fill(0.0);
            }
            for at in (0..=self.columns).step_by(4) {
                let largest = |a: &[f32], b: &[f32]| {
                    let number = |numbers: &[f32], at: usize| Vec4::from_slice(&numbers[at..]);
                    number(a, at)
                        .max(number(a, at + 1))
                        .max(number(b, at).max(number(b, at + 1)))
                };
                let share = largest(&below[0], &above[0]);
                let most = largest(&below[1], &above[1]);
                let inverse = squared(at).recip();
                let sum = (inverse + inverse * inverse) * grown;
                let lost = share + sum.min(Vec4::splat(2.0)) * (0.125 * h * h);
                let own = Vec4::from_slice(&self.bounds[line + at..]);
                let to = &mut to[row * (self.columns + 1) + at..];
                if !own.cmplt(Vec4::splat(UNKNOWN)).any() {
                    Vec4::splat(NOWHERE).write_to_slice(to);
                    continue;
                }
                let bound = (own.max(most) + lost) / (Vec4::ONE - lost) * MARGIN;
                let mut distance = gauge.distance(bound).max(Vec4::splat(LEAST));
                if gauge.behind.is_some() {
                    distance = distance.max(Vec4::from_slice(&self.surface[line + at..]));
                }
                let is_known =
                    own.cmplt(Vec4::splat(UNKNOWN)) & distance.cmplt(Vec4::splat(MOST as f32));
                let distance = Vec4::select(is_known, distance, Vec4::splat(NOWHERE));
                distance.write_to_slice(to);
            }
            losses.swap(0, 1);
        }
        Ok(())
    }
}
