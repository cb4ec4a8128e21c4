//! In which order points enter the hull. The order never changes the answer.

use alloc::vec::Vec;
use core::ops::Range;

use glam::DVec3;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::bits;
use crate::base::sort::{ordered, sort_keyed};
use crate::cloud::blocks::BLOCK;
use crate::hull::flipped::Flipped;

/// The stride of the last round but one.
const COARSE: u32 = 8;

/// The points of a block that are not in the last round: every eighth one.
pub(super) const EIGHTH: u64 = 0x0101_0101_0101_0101;
/// The points of a block that are in the last round.
pub(super) const LAST_ROUND: u64 = !EIGHTH;

/// One round: the multiples of `stride` that are no multiples of `given`, the
/// stride of the round before.
#[derive(Clone, Copy)]
pub(super) struct Round {
    stride: u32,
    given: u32,
}

impl Round {
    /// The round's indices below `count`, ascending.
    pub(super) fn indices(self, count: u32) -> impl Iterator<Item = u32> + Clone {
        (0..count)
            .step_by(self.stride as usize)
            .filter(move |i| self.given == 0 || i % self.given != 0)
    }
}

/// All rounds except the last. Rounds sample the spatial order more and more densely: every
/// 4096th point first, then every 512th point that is not yet given, and so on, until each
/// point came once. Without the last round, one point in eight is given.
///
/// The early rounds give the hull its shape with few points. Inside a round, neighbors in
/// space follow each other. So each point is found near the one before.
pub(super) fn coarse_rounds() -> impl Iterator<Item = Round> + Clone {
    const STRIDES: [u32; 4] = [4096, 512, 64, COARSE];
    (0..STRIDES.len()).map(|round| Round {
        stride: STRIDES[round],
        given: if round == 0 { 0 } else { STRIDES[round - 1] },
    })
}

pub(super) fn last_round() -> Round {
    Round {
        stride: 1,
        given: COARSE,
    }
}

/// All indices below `count` in runs of a block each.
pub(super) fn runs(count: u32) -> impl Iterator<Item = Range<u32>> {
    let starts = (0..count).step_by(BLOCK);
    starts.map(move |start| start..count.min(start + BLOCK as u32))
}

/// The points at these `places` of the block that begins with point `start`.
pub(super) fn points_at(start: u32, places: u64) -> impl Iterator<Item = u32> {
    bits::places(places).map(move |place| start + place)
}

/// The step of the sample in which a start is searched, before all points are searched.
pub(super) fn sample_step(count: u32) -> usize {
    const SAMPLE: u32 = 512;
    count.div_ceil(SAMPLE).max(1) as usize
}

// Clouds that lie in one plane with the viewpoint, except for rounding: scans of a single
// line, straight wires, walls seen edge-on.
//
// Their hull is too thin for rounded planes, so every sign is computed exactly. A few
// vertices have a large part of all faces. In the spatial order the walks around such a
// vertex are long. In the order of the directions in the plane, each point is close to the
// one before.

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

#[cfg(test)]
mod tests {
    use super::{BLOCK, LAST_ROUND, coarse_rounds, last_round, points_at};
    use alloc::vec::Vec;

    #[test]
    fn the_last_round_of_a_block_has_the_points_at_its_places() {
        let places = points_at(0, LAST_ROUND);
        assert!(places.eq(last_round().indices(BLOCK as u32)));
    }

    #[test]
    fn every_index_comes_once() {
        for count in [0, 1, 2, 7, 64, 4096, 10_001] {
            let mut seen: Vec<u32> = coarse_rounds()
                .chain([last_round()])
                .flat_map(|round| round.indices(count))
                .collect();
            seen.sort_unstable();
            assert!(seen.into_iter().eq(0..count));
        }
    }
}
