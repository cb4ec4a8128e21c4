//! In which order points enter the hull. The order never changes the answer.

use core::ops::Range;

use crate::base::bits;
use crate::cloud::blocks::BLOCK;

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
