//! The definition in the lower dimension: all points in one plane or on one
//! line with the viewpoint.
//!
//! Leaving out a coordinate maps the plane one-to-one and keeps rays, lines and
//! convexity, so nothing is rounded.

use crate::base::allocation::{OutOfMemory, filled, with_capacity};
use crate::base::sort::sorted_places;
use crate::hull::predicates::{Sign, orient2d};
use alloc::vec::Vec;
use glam::DVec3;

const ORIGIN: [f64; 2] = [0.0; 2];

/// Marks the visible points among `count`, which lie in one plane with the origin.
pub(super) fn mark_visible(
    count: u32,
    flipped: &dyn Fn(u32) -> Option<DVec3>,
    visible: &mut [bool],
) -> Result<(), OutOfMemory> {
    let mut points: Vec<(DVec3, u32)> = with_capacity(count as usize)?;
    for index in 0..count {
        match flipped(index) {
            Some(q) => points.push((q, index)),
            None => visible[index as usize] = true,
        }
    }
    let Some(&(a, _)) = points.first() else {
        return Ok(());
    };
    let plane = points.iter().find_map(|&(b, _)| spanned_axes(a, b));
    match plane {
        Some(axes) => mark_in_plane(&points, axes, visible),
        None => {
            mark_on_line(&points, visible);
            Ok(())
        }
    }
}

/// Whether a, b and the origin are exactly in one line.
pub(super) fn collinear_with_origin(a: DVec3, b: DVec3) -> bool {
    spanned_axes(a, b).is_none()
}

/// Two coordinate axes in whose plane a and b are not in line with the origin.
fn spanned_axes(a: DVec3, b: DVec3) -> Option<[usize; 2]> {
    let pick = |p: DVec3, [i, j]: [usize; 2]| [p[i], p[j]];
    [[0, 1], [1, 2], [2, 0]]
        .into_iter()
        .find(|&axes| orient2d(ORIGIN, pick(a, axes), pick(b, axes)) != Sign::Zero)
}

/// Marks the visible points on a line: the farthest flipped point of each side.
fn mark_on_line(points: &[(DVec3, u32)], visible: &mut [bool]) {
    let Some(&(a, _)) = points.first() else {
        return;
    };
    let axis = a.abs().max_position();
    let (mut least, mut most) = (0.0f64, 0.0f64);
    for &(q, _) in points {
        least = least.min(q[axis]);
        most = most.max(q[axis]);
    }
    for &(q, index) in points {
        if q[axis] == least || q[axis] == most {
            visible[index as usize] = true;
        }
    }
}

/// Marks the visible points in a plane. K is the convex hull of all points and the origin.
/// A point is visible if it is on an edge of K whose line misses the origin.
fn mark_in_plane(
    points: &[(DVec3, u32)],
    [i, j]: [usize; 2],
    visible: &mut [bool],
) -> Result<(), OutOfMemory> {
    let mut places: Vec<[f64; 2]> = with_capacity(points.len() + 1)?;
    places.push(ORIGIN);
    // Adding 0 makes -0 the same as 0.
    places.extend(points.iter().map(|(q, _)| [q[i] + 0.0, q[j] + 0.0]));
    let sorted = sorted_places(&places)?;
    let at = |k: u32| places[sorted[k as usize] as usize];

    // Only one of several equal points takes part in the hull.
    let mut distinct: Vec<u32> = Vec::new();
    let mut chain: Vec<u32> = Vec::new();
    distinct.try_reserve_exact(sorted.len())?;
    chain.try_reserve_exact(sorted.len())?;
    for k in 0..sorted.len() as u32 {
        if distinct.last().is_none_or(|&last| at(last) != at(k)) {
            distinct.push(k);
        }
    }
    let mut on_boundary = filled(sorted.len(), false)?;
    let mut add_chain = |sorted: &mut dyn Iterator<Item = u32>| {
        convex_chain(sorted, &at, &mut chain);
        for edge in chain.windows(2) {
            if orient2d(ORIGIN, at(edge[0]), at(edge[1])) != Sign::Zero {
                on_boundary[edge[0] as usize] = true;
                on_boundary[edge[1] as usize] = true;
            }
        }
    };
    add_chain(&mut distinct.iter().copied());
    add_chain(&mut distinct.iter().rev().copied());

    let mut representative = 0;
    for k in 0..sorted.len() as u32 {
        if at(k) != at(representative) {
            representative = k;
        }
        let place = sorted[k as usize] as usize;
        if on_boundary[representative as usize] && place > 0 {
            visible[points[place - 1].1 as usize] = true;
        }
    }
    Ok(())
}

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
