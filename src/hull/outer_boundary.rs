//! Finds the points on the outer boundary. There are four ways: a hull that was begun is completed, a
//! new hull is started, the view is divided, or all points are in one plane with the viewpoint.

use alloc::vec::Vec;
use glam::DVec3;

use crate::base::allocation::OutOfMemory;
use crate::cloud::blocks::Sphere;
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::hull::division::Division;
use crate::hull::flipped::Flipped;
use crate::hull::memory::Memory;
use crate::hull::order::AngularOrder;
use crate::hull::predicates::{Sign, side_of_origin};
use crate::hull::{flat, order, share};

/// Finds the visible points among `points`, flipped by `flip`. [`Memory::visible`] then holds
/// them.
pub(crate) fn mark_visible(
    points: &Points,
    blocks: &[Sphere],
    flip: &Flip,
    memory: &mut Memory,
) -> Result<(), OutOfMemory> {
    let flipped = Flipped::of(points, blocks, flip);
    if let Some(mut round) = memory.begun(flip) {
        memory.forget();
        memory.add_last_round(&flipped, &mut round, usize::MAX)?;
        return memory.finish(&flipped);
    }
    // Where the flip is slow, the map would flip most points of the last round once more, which
    // takes longer than to locate them.
    if start(&flipped, points.len() / 16, memory)? {
        memory.add_all(&flipped, flip.is_fast())?;
        memory.finish(&flipped)?;
    }
    Ok(())
}

/// Makes the complete hull, and marks no points. They mostly are visible, so a map would save no time.
pub(crate) fn complete(
    points: &Points,
    flip: &Flip,
    memory: &mut Memory,
) -> Result<(), OutOfMemory> {
    let flipped = Flipped::of(points, &[], flip);
    if start(&flipped, points.len() / 16, memory)? {
        memory.add_all(&flipped, false)?;
        memory.complete();
    }
    Ok(())
}

/// [`mark_visible`] for one sector of the view: only its own points are marked.
#[inline(never)]
pub(crate) fn mark_sector(
    points: &Points,
    blocks: &[Sphere],
    flip: &Flip,
    division: Division,
    memory: &mut Memory,
) -> Result<(), OutOfMemory> {
    let flipped = Flipped::of(points, blocks, flip);
    if start(&flipped, division.near_points() / 2, memory)? {
        return share::mark_visible(memory, &flipped, division);
    }
    division.keep_own(&mut memory.visible);
    Ok(())
}

/// Does a part of the work of [`mark_visible`], which goes on from there if its flip is the same. First it
/// makes the hull of one point in eight, then each call adds about `budget` points. Returns whether no
/// point is left to add.
#[inline(never)]
pub(crate) fn go_on(
    points: &Points,
    blocks: &[Sphere],
    flip: &Flip,
    memory: &mut Memory,
    budget: usize,
) -> Result<bool, OutOfMemory> {
    let flipped = Flipped::of(points, blocks, flip);
    let Some(mut round) = memory.begun(flip) else {
        if !start(&flipped, points.len() / 16, memory)? {
            return Ok(true);
        }
        memory.add_coarse_rounds(&flipped)?;
        memory.make_map(&flipped)?;
        memory.begin(*flip, memory.last_round());
        return Ok(false);
    };
    memory.forget();
    let is_done = memory.add_last_round(&flipped, &mut round, budget)?;
    memory.begin(*flip, round);
    Ok(is_done)
}

/// Starts a hull in space, with room for `count` vertices. Returns false if all points are in one
/// plane with the viewpoint, except for roundings; then the visible ones are marked.
#[inline(never)]
fn start(flipped: &Flipped, count: usize, memory: &mut Memory) -> Result<bool, OutOfMemory> {
    memory.forget();
    memory.on_boundary.clear();
    memory.clear_marks(flipped.len())?;
    let Some(corners) = seed(flipped) else {
        let at = |index| flipped.get_out_of_line(index);
        flat::mark_visible(flipped.len() as u32, &at, &mut memory.visible)?;
        return Ok(false);
    };
    memory.hull.start(corners, flipped.reach())?;
    memory.hull.reserve(count, 2 * count);
    if let Some(order) = AngularOrder::of(&corners, flipped) {
        memory.add_by_angle(&order, flipped)?;
        memory.finish(flipped)?;
        return Ok(false);
    }
    Ok(true)
}

/// Three points that start a hull in space. `None` if all points are in one plane with the
/// viewpoint.
#[inline(never)]
pub(super) fn seed(flipped: &Flipped) -> Option<[(u32, DVec3); 3]> {
    if flipped.flip.keeps_in_plane(flipped.points) {
        return None;
    }
    first_tetrahedron(flipped, order::sample_step(flipped.len() as u32))
        .or_else(|| first_tetrahedron(flipped, 1))
}

/// Whether each of `points` is visible, for a single view.
pub(crate) fn visible_once(points: &Points, flip: &Flip) -> Result<Vec<bool>, OutOfMemory> {
    let mut memory = Memory::new();
    mark_visible(points, &[], flip, &mut memory)?;
    Ok(memory.visible)
}

/// The same as [`visible_once`], and the outer faces of the hull as triangles of points,
/// counter-clockwise seen from the viewpoint. There are no triangles where all points are in
/// one plane with the viewpoint.
pub(crate) fn triangulate_visible(
    points: &Points,
    flip: &Flip,
) -> Result<(Vec<bool>, Vec<[u32; 3]>), OutOfMemory> {
    let mut memory = Memory::new();
    mark_visible(points, &[], flip, &mut memory)?;
    let mut triangles = Vec::new();
    if memory.holds_hull() {
        let flipped = Flipped::of(points, &[], flip);
        triangles = memory.hull.outer_triangles(&memory.on_boundary, &flipped)?;
    }
    Ok((memory.visible, triangles))
}

/// Three points that span space with the origin, from the sample of every `step`th point.
/// Their determinant is large, and their order makes it positive. `None` if the sample lies
/// in one plane with the origin.
#[inline(never)]
fn first_tetrahedron(flipped: &Flipped, step: usize) -> Option<[(u32, DVec3); 3]> {
    let points = || {
        (0..flipped.len() as u32)
            .step_by(step)
            .filter_map(|i| flipped.get_out_of_line(i).map(|q| (i, q)))
    };
    let first = points().next()?;
    let likely = || {
        let second = largest(points(), |q| first.1.cross(q).length_squared())?;
        let normal = first.1.cross(second.1);
        let third = largest(points(), |q| normal.dot(q).abs())?;
        counter_clockwise(first, second, third)
    };
    // In doubt, or where the products overflow, the search is exact. It takes the first point
    // that is not on the line through `first`, then the first point that is not in their plane.
    let certain = || {
        let second = points().find(|&(_, q)| !flat::collinear_with_origin(first.1, q))?;
        points().find_map(|third| counter_clockwise(first, second, third))
    };
    likely().or_else(certain)
}

/// The three points in the order that is counter-clockwise seen from outside. `None` if
/// they lie in one plane with the origin.
fn counter_clockwise(
    a: (u32, DVec3),
    b: (u32, DVec3),
    c: (u32, DVec3),
) -> Option<[(u32, DVec3); 3]> {
    match side_of_origin(a.1, b.1, c.1) {
        Sign::Positive => Some([a, b, c]),
        Sign::Negative => Some([a, c, b]),
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
