//! The one sort: by a number, in place, in time linear in the number of items.
//!
//! A radix sort from the most significant bits down ("American flag": McIlroy, Bostic
//! and McIlroy, "Engineering radix sort", 1993). Orders with ties are sorted by one
//! number after another.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, with_capacity};
use crate::base::beat;

/// A digit's bits, and how many different digits there are.
const BITS: u32 = 8;
const BUCKETS: usize = 1 << BITS;
/// Fewer items than this are sorted by insertion.
const FEW: usize = 32;
/// The most bits of a digit where there is room, and how many different ones there are.
const WIDEST: u32 = 11;
/// The most digits.
const DIGITS: u32 = 3;
const WIDE: usize = 1 << WIDEST;

/// A number, and the index that is sorted by it. One type for all uses, so that the sort
/// is compiled once.
pub(crate) type Keyed = (u64, u32);

/// The percentile of numbers that are not negative: of a hundred, the one with `percent` before it.
/// `None` where there are no numbers.
pub(crate) fn percentile(numbers: &[f64], percent: usize) -> Result<Option<f64>, OutOfMemory> {
    // The bits of such numbers are in their order.
    let mut sorted: Vec<Keyed> = with_capacity(numbers.len())?;
    sorted.extend(numbers.iter().map(|number| (number.to_bits(), 0)));
    sort_keyed(&mut sorted);
    let at = sorted.get(numbers.len() * percent / 100);
    Ok(at.map(|&(bits, _)| f64::from_bits(bits)))
}

/// Sorts by the number. The order of items with equal numbers is unspecified.
#[inline(never)]
pub(crate) fn sort_keyed(items: &mut [Keyed]) {
    if items.len() < FEW {
        return sort_few(items, |item| item.0);
    }
    beat::steps(items.len() / 64);
    // The highest bits in which the keys differ make the digit.
    let one = items[0].0;
    let different = items.iter().fold(0, |bits, (key, _)| bits | key ^ one);
    let shift = (u64::BITS - different.leading_zeros()).saturating_sub(BITS);
    let digit = |(key, _): &Keyed| (key >> shift) as usize % BUCKETS;
    if different == 0 {
        return;
    }

    let mut starts = [0u32; BUCKETS];
    for item in &*items {
        starts[digit(item)] += 1;
    }
    let mut ends = starts;
    let mut end = 0;
    for (start, bucket_end) in starts.iter_mut().zip(&mut ends) {
        *start = end;
        end += *bucket_end;
        *bucket_end = end;
    }
    // Every item moves once: to the first free place of its bucket.
    let mut next = starts;
    for bucket in 0..BUCKETS {
        while next[bucket] < ends[bucket] {
            let home = next[bucket] as usize;
            let mut item = items[home];
            loop {
                let place = &mut next[digit(&item)];
                let to = *place as usize;
                *place += 1;
                if to == home {
                    break;
                }
                core::mem::swap(&mut item, &mut items[to]);
            }
            items[home] = item;
        }
    }
    if shift > 0 {
        for (&start, &end) in starts.iter().zip(&ends) {
            sort_keyed(&mut items[start as usize..end as usize]);
        }
    }
}

fn sort_few<T: Copy>(items: &mut [T], number: impl Fn(&T) -> u64) {
    for sorted in 1..items.len() {
        let item = items[sorted];
        let mut place = sorted;
        while place > 0 && number(&items[place - 1]) > number(&item) {
            items[place] = items[place - 1];
            place -= 1;
        }
        items[place] = item;
    }
}

/// Sorts by the bits from `low` up: first by the highest ones that differ, one digit after another from the
/// lowest on, then runs of items with equal digits in the same way. The order of items with equal bits is
/// unspecified. `room` holds at least as many items.
pub(crate) fn sort_packed(items: &mut [u64], low: u32, room: &mut [u64]) {
    if items.len() < FEW {
        return sort_few(items, |&item| item);
    }
    beat::steps(items.len() / 16);
    let one = items[0];
    let different = items.iter().fold(0, |bits, item| bits | item ^ one) >> low;
    let bits = u64::BITS - different.leading_zeros();
    let width = items.len().ilog2().min(WIDEST).min(bits.div_ceil(DIGITS));
    let digits = bits.div_ceil(width.max(1)).min(DIGITS);
    let rest = low + bits.saturating_sub(digits * width);
    let room = &mut room[..items.len()];
    for place in 0..digits {
        let (from, to) = if place % 2 == 0 {
            (&mut *items, &mut *room)
        } else {
            (&mut *room, &mut *items)
        };
        let shift = rest + place * width;
        let digit = |item: u64| (item >> shift) as usize & ((1 << width) - 1) & (WIDE - 1);
        let mut next = [0u32; WIDE];
        for &item in &*from {
            next[digit(item)] += 1;
        }
        let mut end = 0;
        for start in &mut next[..1 << width] {
            (*start, end) = (end, end + *start);
        }
        for &item in &*from {
            let place = &mut next[digit(item)];
            to[*place as usize] = item;
            *place += 1;
        }
    }
    if digits % 2 == 1 {
        items.copy_from_slice(room);
    }
    if rest > low {
        for run in items.chunk_by_mut(|a, b| a >> rest == b >> rest) {
            if run.len() > 1 {
                sort_packed(run, low, room);
            }
        }
    }
}

/// A number for `x` that keeps the order. `x` is not -0.
pub(crate) fn ordered(x: f64) -> u64 {
    let bits = x.to_bits();
    let sign = 1 << 63;
    if bits & sign == 0 { bits | sign } else { !bits }
}

/// Sorts indices by `count` numbers each. Number 0 comes first; it is already their key. Items
/// with equal numbers are then sorted by number 1, and so on. `number(k, index)` is number k of
/// an index.
pub(crate) fn sort_by_numbers(
    keyed: &mut [Keyed],
    count: usize,
    number: &dyn Fn(usize, u32) -> u64,
) {
    sort_from(keyed, 1, count, number);
}

fn sort_from(keyed: &mut [Keyed], next: usize, count: usize, number: &dyn Fn(usize, u32) -> u64) {
    sort_keyed(keyed);
    if next == count {
        return;
    }
    for run in keyed.chunk_by_mut(|a, b| a.0 == b.0) {
        if run.len() > 1 {
            for (key, index) in &mut *run {
                *key = number(next, *index);
            }
            sort_from(run, next + 1, count, number);
        }
    }
}

/// The indices of places in a plane, sorted by coordinates. No coordinate is -0.
pub(crate) fn sorted_places(places: &[[f64; 2]]) -> Result<Vec<u32>, OutOfMemory> {
    let mut keyed: Vec<Keyed> = with_capacity(places.len())?;
    keyed.extend(
        (0..)
            .zip(places)
            .map(|(index, place)| (ordered(place[0]), index)),
    );
    sort_by_numbers(&mut keyed, 2, &|axis, index| {
        ordered(places[index as usize][axis])
    });
    let mut sorted: Vec<u32> = with_capacity(places.len())?;
    sorted.extend(keyed.iter().map(|&(_, index)| index));
    Ok(sorted)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(count: usize, mask: u64) -> Vec<(u64, u32)> {
        let mut seed = 3u64;
        let next = |index| {
            seed = seed.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
            ((seed ^ seed >> 29) & mask, index)
        };
        (0..count as u32).map(next).collect()
    }

    #[test]
    fn numbers_of_every_spread_are_sorted_with_what_they_carry() {
        for mask in [
            u64::MAX,
            0xff,
            0x1ff,
            0,
            1 << 63,
            1 << 63 | 1,
            0x00ff_f000_0000_fff0,
        ] {
            for count in [0, 1, 2, 31, 32, 33, 1000, 20_000] {
                let given = numbers(count, mask);
                let mut sorted = given.clone();
                sort_keyed(&mut sorted);
                assert!(
                    sorted.is_sorted_by_key(|&(number, _)| number),
                    "{mask:x} {count}"
                );
                sorted.sort_unstable_by_key(|&(_, index)| index);
                assert_eq!(sorted, given, "{mask:x} {count}");
            }
        }
    }

    #[test]
    fn packed_numbers_are_sorted_by_their_high_bits() {
        for (mask, low) in [
            (u64::MAX, 0),
            (u64::MAX, 20),
            (0xff, 3),
            (0, 0),
            (1 << 63 | 0xff, 8),
        ] {
            for count in [0, 1, 2, 31, 32, 33, 90, 3000, 20_000] {
                let given: Vec<u64> = numbers(count, mask).iter().map(|item| item.0).collect();
                let mut sorted = given.clone();
                sort_packed(&mut sorted, low, &mut given.clone());
                assert!(
                    sorted.is_sorted_by_key(|item| item >> low),
                    "{mask:x} {count}"
                );
                sorted.sort_unstable();
                let mut given = given;
                given.sort_unstable();
                assert_eq!(sorted, given, "{mask:x} {count}");
            }
        }
    }

    #[test]
    fn numbers_of_floats_have_their_order() {
        let ascending = [-f64::MAX, -1.5, -1.0, -5e-324, 0.0, 5e-324, 1.0, f64::MAX];
        assert!(ascending.map(ordered).is_sorted_by(|a, b| a < b));
    }
}
