//! In which order points enter the hull. The order never changes the answer.

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

    pub(super) fn is_last(self) -> bool {
        self.stride == 1
    }
}

/// Rounds that sample the spatial order ever more densely: every 4096th point
/// first, then every 512th not yet given, and so on, until each came once.
///
/// The early rounds give the hull its shape with few points; inside a round
/// neighbors in space follow each other, so each is found near the last one.
pub(super) fn spatial_rounds() -> impl Iterator<Item = Round> + Clone {
    const STRIDES: [u32; 5] = [4096, 512, 64, 8, 1];
    (0..STRIDES.len()).map(|round| Round {
        stride: STRIDES[round],
        given: if round == 0 { 0 } else { STRIDES[round - 1] },
    })
}

/// The step from one to the next of the few points that are looked at for a start, before
/// all are.
pub(super) fn sample_step(count: u32) -> usize {
    const SAMPLE: u32 = 512;
    count.div_ceil(SAMPLE).max(1) as usize
}

#[cfg(test)]
mod tests {
    use super::spatial_rounds;
    use alloc::vec::Vec;

    #[test]
    fn every_index_comes_once() {
        for count in [0, 1, 2, 7, 64, 4096, 10_001] {
            let mut seen: Vec<u32> = spatial_rounds()
                .flat_map(|round| round.indices(count))
                .collect();
            seen.sort_unstable();
            assert!(seen.into_iter().eq(0..count));
        }
    }
}
