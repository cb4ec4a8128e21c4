//! Which flipped points lie on the outer boundary of K = conv({q} ∪ {0})?
//!
//! INPUT    the flipped points q, one for each distinct point of the cloud
//!          (none for points at the viewpoint); the viewpoint is the origin.
//! OUTPUT   for each point: visible (the ray from the origin through q leaves K
//!          at q) or hidden. Exact for the rounded q, in every dimension K has.
//! SUMMARY  Three points that span space with the origin start an incremental
//!          hull (`incremental`); where there are none, K is flat and its
//!          dimension decides (`flat`).

mod flat;
mod incremental;
mod lower;
mod order;
mod topology;

use alloc::vec::Vec;
use glam::DVec3;

pub(crate) use self::lower::mark_lower_boundary;

use crate::error::Error;
use crate::inversion::Flip;
use crate::points::Points;
use crate::predicates::{Sign, side_of_origin};

/// Points looked at for a first tetrahedron before all of them are.
const SEED_SAMPLE: usize = 512;

/// Marks the visible ones among `points`, flipped by `flip`.
pub(crate) fn mark_visible(points: &Points, flip: &Flip) -> Result<Vec<bool>, Error> {
    mark(points, flip, None)
}

/// The same, and the outer faces of the hull as triangles of points, counter-clockwise
/// seen from the viewpoint; none where all is in one plane with the viewpoint.
pub(crate) fn triangulate_visible(
    points: &Points,
    flip: &Flip,
) -> Result<(Vec<bool>, Vec<[u32; 3]>), Error> {
    let mut triangles = Vec::new();
    let visible = mark(points, flip, Some(&mut triangles))?;
    Ok((visible, triangles))
}

fn mark(
    points: &Points,
    flip: &Flip,
    triangles: Option<&mut Vec<[u32; 3]>>,
) -> Result<Vec<bool>, Error> {
    let flip = flip.rescaled_for(points);
    let flipped = |index: u32| flip.apply(points.get(index as usize));

    let mut visible = Vec::new();
    visible.try_reserve_exact(points.len())?;
    visible.resize(points.len(), false);

    let count = points.len() as u32;
    let sample = order::spatial_rounds(count).take(SEED_SAMPLE);
    let seed = if flip.keeps_in_plane(points) {
        None
    } else {
        first_tetrahedron(sample, &flipped).or_else(|| first_tetrahedron(0..count, &flipped))
    };
    match seed {
        Some(corners) => incremental::mark_visible(
            order::spatial_rounds(count),
            &flipped,
            flip.reach(),
            corners,
            &mut visible,
            triangles,
        )?,
        None => flat::mark_visible(count, &flipped, &mut visible)?,
    }
    Ok(visible)
}

/// Three points that span space with the origin, of a large determinant, in
/// the order that makes it positive; `None` if the candidates lie in one plane
/// with the origin.
fn first_tetrahedron(
    candidates: impl Iterator<Item = u32> + Clone,
    flipped: &impl Fn(u32) -> Option<DVec3>,
) -> Option<[u32; 3]> {
    let points = || {
        candidates
            .clone()
            .filter_map(|i| flipped(i).map(|q| (i, q)))
    };
    let first = points().next()?;
    let likely = || {
        let second = largest(points(), |q| first.1.cross(q).length_squared())?;
        let normal = first.1.cross(second.1);
        let third = largest(points(), |q| normal.dot(q).abs())?;
        counter_clockwise(first, second, third)
    };
    // In doubt (or where the products overflow): exactly, the first point off the
    // line through `first`, then the first off their plane.
    let certain = || {
        let second = points().find(|&(_, q)| !flat::collinear_with_origin(first.1, q))?;
        points().find_map(|third| counter_clockwise(first, second, third))
    };
    likely().or_else(certain)
}

/// The three in the order that is counter-clockwise seen from outside, unless
/// they lie in one plane with the origin.
fn counter_clockwise(
    (i, a): (u32, DVec3),
    (j, b): (u32, DVec3),
    (k, c): (u32, DVec3),
) -> Option<[u32; 3]> {
    match side_of_origin(a, b, c) {
        Sign::Positive => Some([i, j, k]),
        Sign::Negative => Some([i, k, j]),
        Sign::Zero => None,
    }
}

fn largest(
    points: impl Iterator<Item = (u32, DVec3)>,
    measure: impl Fn(DVec3) -> f64,
) -> Option<(u32, DVec3)> {
    let mut best = None;
    let mut best_measure = f64::NEG_INFINITY;
    for (index, q) in points {
        let m = measure(q);
        if m > best_measure {
            best = Some((index, q));
            best_measure = m;
        }
    }
    best
}
