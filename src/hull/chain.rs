//! The convex chain of points in a plane, from one end to the other.

use alloc::vec::Vec;

use crate::hull::predicates::{Sign, orient2d};

/// Andrew's monotone chain: the hull's lower side for points sorted from left to right,
/// its upper side from right to left. Points in line with their neighbors are kept.
/// `chain` has room for all.
pub(super) fn convex_chain(
    sorted: &mut dyn Iterator<Item = u32>,
    at: &dyn Fn(u32) -> [f64; 2],
    chain: &mut Vec<u32>,
) {
    chain.clear();
    for next in sorted {
        while let [.., before, last] = chain[..] {
            if orient2d(at(before), at(last), at(next)) != Sign::Negative {
                break;
            }
            chain.pop();
        }
        chain.push(next);
    }
}
