//! Sets of up to 64 places as the bits of a number.

/// The places of the marks, of which there are at most 64.
#[inline]
pub(crate) fn bits_of(marks: &[bool]) -> u64 {
    let later = marks.iter().rev();
    later.fold(0, |bits, &marked| bits << 1 | u64::from(marked))
}

/// The places of the bits that are set, ascending.
#[inline]
pub(crate) fn places(mut bits: u64) -> impl Iterator<Item = u32> {
    core::iter::from_fn(move || {
        let place = bits.trailing_zeros();
        bits &= bits.wrapping_sub(1);
        (place < u64::BITS).then_some(place)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_come_back_as_places() {
        let mut marks = [false; 64];
        assert_eq!(bits_of(&marks), 0);
        for place in [0, 5, 63] {
            marks[place] = true;
        }
        assert!(places(bits_of(&marks)).eq([0, 5, 63]));
        assert!(places(bits_of(&marks[..6])).eq([0, 5]));
        assert_eq!(bits_of(&[]), 0);
    }
}
