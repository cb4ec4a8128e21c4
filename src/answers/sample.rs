//! Even samples of a cloud: the answers of the sampled points alone.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::error::{Error, in_range};
use crate::base::limit::MAX_POINTS;
use crate::cloud::point_cloud::PointCloud;

impl PointCloud {
    /// The cloud of `count` of the distinct points; `None` if there are no more. Indices stay.
    pub(crate) fn sample(&self, count: usize) -> Result<Option<Self>, Error> {
        in_range("sample", count as f64, 1.0, MAX_POINTS as f64)?;
        let all = self.sequence.points.len();
        if all <= count {
            return Ok(None);
        }
        Ok(Some(self.of_places(&even_places(all, count)?)?))
    }
}

/// The first `count` places below `all` in bit-reversed order. They are returned ascending.
/// Every beginning of the bit-reversed order is spread evenly. So a smaller sample is part of
/// a larger one.
pub(crate) fn even_places(all: usize, count: usize) -> Result<Vec<u32>, OutOfMemory> {
    let unused = (all as u32).saturating_sub(1).leading_zeros();
    let mut is_chosen: Vec<bool> = Vec::new();
    is_chosen.try_reserve_exact(all)?;
    is_chosen.resize(all, false);
    let order = (0..u32::MAX).map(|number| number.reverse_bits().checked_shr(unused).unwrap_or(0));
    for place in order.filter(|&place| (place as usize) < all).take(count) {
        is_chosen[place as usize] = true;
    }
    let mut places = with_capacity(count)?;
    places.extend((0..all as u32).filter(|&place| is_chosen[place as usize]));
    Ok(places)
}

#[cfg(test)]
mod tests {
    use super::even_places;

    #[test]
    fn samples_are_even() {
        let places = even_places(100_000, 3000).unwrap();
        let gaps = places.windows(2).map(|pair| pair[1] - pair[0]);
        let (least, most) = (gaps.clone().min().unwrap(), gaps.max().unwrap());
        // The steps are 2^17 ÷ 2^12 and twice that.
        assert_eq!((least, most), (32, 64));
    }
}
