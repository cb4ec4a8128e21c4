//! In which order points enter the hull. The order never changes the answer.

/// All indices below `count`, in rounds that sample the spatial order ever more
/// densely: every 4096th point first, then every 512th not yet given, and so on.
///
/// The early rounds give the hull its shape with few points; inside a round
/// neighbors in space follow each other, so each is found near the last one.
pub(crate) fn spatial_rounds(count: u32) -> impl Iterator<Item = u32> + Clone {
    const STRIDES: [u32; 5] = [4096, 512, 64, 8, 1];
    STRIDES
        .into_iter()
        .enumerate()
        .flat_map(move |(round, stride)| {
            let given = if round == 0 { 0 } else { STRIDES[round - 1] };
            (0..count)
                .step_by(stride as usize)
                .filter(move |i| given == 0 || i % given != 0)
        })
}

#[cfg(test)]
mod tests {
    use super::spatial_rounds;
    use alloc::vec::Vec;

    #[test]
    fn every_index_comes_once() {
        for count in [0, 1, 2, 7, 64, 4096, 10_001] {
            let mut seen: Vec<u32> = spatial_rounds(count).collect();
            seen.sort_unstable();
            assert!(seen.into_iter().eq(0..count));
        }
    }
}
