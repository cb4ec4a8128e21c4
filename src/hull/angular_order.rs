//! Clouds that lie in one plane with the viewpoint, except for rounding: scans of a single
//! line, straight wires, walls seen edge-on.
//!
//! Their hull is too thin for rounded planes, so every sign is computed exactly. A few
//! vertices have a large part of all faces. In the spatial order the walks around such a
//! vertex are long. In the order of the directions in the plane, each point is close to the
//! one before.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::sort::{ordered, sort_keyed};
use crate::hull::flipped::Flipped;
use crate::hull::order::Round;

/// A point counts as in the plane up to this distance from it, as a share of the largest
/// distance. Rounding errors are 1e-16 of the coordinates, and the coordinates of a cloud in a
/// large frame of reference may be 1e6 times its size.
const THICKNESS: f64 = 1e-9;

/// Fewer points than this take no time in any order.
const MIN_POINTS: usize = 128;

/// The plane that holds all points except for rounding, given by two axes of unit length.
pub(super) struct AngularOrder {
    axes: [DVec3; 2],
}

impl AngularOrder {
    /// The plane of the first tetrahedron. `None` unless its corners are within [`THICKNESS`] of
    /// one plane with the viewpoint. The last corner is the point farthest from the plane of the
    /// others.
    pub(super) fn of(corners: &[(u32, DVec3); 3], flipped: &Flipped) -> Option<Self> {
        if flipped.len() < MIN_POINTS {
            return None;
        }
        let [a, b, c] = corners.map(|(_, q)| q);
        let normal = [a.cross(b), b.cross(c), c.cross(a)]
            .into_iter()
            .max_by(|m, n| m.length_squared().total_cmp(&n.length_squared()))?
            .try_normalize()?;
        let is_thin = [a, b, c]
            .iter()
            .all(|q| normal.dot(*q).abs() <= THICKNESS * flipped.reach());
        let x = a.try_normalize()?;
        is_thin.then(|| Self {
            axes: [x, normal.cross(x)],
        })
    }

    /// The indices of a round in the order of their directions in the plane.
    pub(super) fn sorted(
        &self,
        round: Round,
        flipped: &Flipped,
    ) -> Result<Vec<(u64, u32)>, OutOfMemory> {
        let count = flipped.len() as u32;
        let mut keyed = with_capacity(round.indices(count).count())?;
        keyed.extend(round.indices(count).map(|index| {
            let q = flipped.get_out_of_line(index).unwrap_or(DVec3::ZERO);
            (ordered(self.turn(q)), index)
        }));
        sort_keyed(&mut keyed);
        Ok(keyed)
    }

    /// A number that grows with the angle from the first axis, from -2 to 2.
    fn turn(&self, q: DVec3) -> f64 {
        let [x, y] = self.axes.map(|axis| axis.dot(q));
        let share = y / (x.abs() + y.abs());
        let turn = if x >= 0.0 {
            share
        } else if y >= 0.0 {
            2.0 - share
        } else {
            -2.0 - share
        };
        // The origin has no direction. Any place in the order is right for it.
        if turn.is_nan() { 0.0 } else { turn + 0.0 }
    }
}
