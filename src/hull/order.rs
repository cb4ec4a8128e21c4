//! In which order points enter the hull. The order never changes the answer.

use core::ops::Range;

use crate::cloud::blocks::BLOCK;

/// The stride of the last round but one.
const COARSE: u32 = 8;

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
        self.indices_in(0..count)
    }

    /// The round's indices in a run that starts at a multiple of every stride, or of the last two.
    pub(super) fn indices_in(self, run: Range<u32>) -> impl Iterator<Item = u32> + Clone {
        run.step_by(self.stride as usize)
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

/// The step of the sample in which a start is searched, before all points are searched.
pub(super) fn sample_step(count: u32) -> usize {
    const SAMPLE: u32 = 512;
    count.div_ceil(SAMPLE).max(1) as usize
}

#[cfg(test)]
mod tests {
    use super::{coarse_rounds, last_round};
    use alloc::vec::Vec;

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
