//! Which flipped points lie on the outer boundary of K = conv({q} ∪ {0})?
//!
//! INPUT    the flipped points q, one for each distinct point of the cloud
//!          (none for points at the viewpoint); the viewpoint is the origin.
//! OUTPUT   for each point: visible (the ray from the origin through q leaves K
//!          at q) or hidden. Exact for the rounded q, in every dimension K has.
//! SUMMARY  Three points that span space with the origin start an incremental
//!          hull (`incremental`); where there are none, K is flat and its
//!          dimension decides (`flat`).

mod depth;
mod flat;
mod incremental;
mod locate;
mod lower;
mod motion;
mod order;
mod plane;
mod repair;
mod sector;
mod topology;
mod triangles;

use alloc::vec::Vec;
use glam::DVec3;

use crate::division::Division;
use crate::inversion::Flip;
use crate::points::Points;
use crate::predicates::{Sign, side_of_origin};
use crate::room::{OutOfMemory, push};
use depth::DepthMap;
use incremental::Hull;
use locate::Location;
use repair::Repair;
use topology::FaceId;

pub(crate) use lower::mark_lower_boundary;

/// The points of a cloud, as one view flips them.
struct Flipped<'a> {
    points: &'a Points,
    flip: Flip,
}

impl Flipped<'_> {
    fn len(&self) -> usize {
        self.points.len()
    }

    #[inline]
    fn position(&self, index: u32) -> [f64; 3] {
        self.points.get(index as usize)
    }

    /// The flipped point, or `None` for a point at the viewpoint.
    #[inline]
    fn get(&self, index: u32) -> Option<DVec3> {
        self.flip.apply(self.position(index))
    }

    /// The same, where it is called too rarely to be worth copies of it.
    #[inline(never)]
    fn get_out_of_line(&self, index: u32) -> Option<DVec3> {
        self.get(index)
    }

    fn reach(&self) -> f64 {
        self.flip.reach()
    }

    fn viewpoint(&self) -> DVec3 {
        self.flip.viewpoint()
    }

    /// The largest |q| there can be, in the cloud's units.
    fn largest_reach(&self) -> f64 {
        self.flip.reach_in_cloud()
    }

    fn hidden_from(&self, length: f64) -> f64 {
        self.flip.hidden_from(length)
    }

    /// Whether squares of distances neither over- nor underflow.
    fn keeps_depth(&self) -> bool {
        (1e-100..1e100).contains(&self.largest_reach())
    }
}

/// The last view's hull, and room for the next one's. What it holds never changes
/// an answer, as long as it is only used for one sequence of points.
#[derive(Default)]
pub(crate) struct Memory {
    hull: Hull,
    depth: DepthMap,
    repair: Repair,
    on_boundary: Vec<u32>,
    visible: Vec<bool>,
    /// Near which face each point was last seen: where to look for it next time.
    witnesses: Vec<FaceId>,
    /// Whether `hull` is that of the last view.
    holds_hull: bool,
    /// Whether the last view was found from the one before it.
    moved: bool,
}

impl Memory {
    /// Which of the points were visible.
    pub(crate) fn visible(&self) -> &[bool] {
        &self.visible
    }

    /// Whether the last view was found from the one before it.
    pub(crate) fn moved(&self) -> bool {
        self.moved
    }

    /// Forgets the last view, but keeps the room.
    pub(crate) fn forget(&mut self) {
        self.holds_hull = false;
    }
}

/// Finds out which of `points`, flipped by `flip`, are visible, all of them or of a
/// divided view only the sector's own: [`Memory::visible`].
pub(crate) fn mark_visible(
    points: &Points,
    flip: &Flip,
    division: Option<Division>,
    memory: &mut Memory,
) -> Result<(), OutOfMemory> {
    let flipped = Flipped {
        points,
        flip: flip.rescaled_for(points),
    };
    memory.visible.clear();
    memory.visible.try_reserve_exact(points.len())?;
    memory.visible.resize(points.len(), false);
    let held = core::mem::take(&mut memory.holds_hull);
    memory.moved = held && division.is_none() && memory.move_hull(&flipped)?;
    if memory.moved {
        memory.add_to_moved_hull(&flipped)?;
        return memory.finish(&flipped);
    }
    let count = points.len() as u32;
    let seed = if flipped.flip.keeps_in_plane(points) {
        None
    } else {
        first_tetrahedron(&flipped, order::sample_step(count))
            .or_else(|| first_tetrahedron(&flipped, 1))
    };
    let room = division
        .as_ref()
        .map_or(points.len(), Division::near_points);
    match (seed, division) {
        (Some(corners), None) => {
            memory.hull.start(corners, flipped.reach(), room)?;
            memory.add_in_rounds(&flipped)?;
            memory.finish(&flipped)
        }
        (Some(corners), Some(division)) => {
            memory.hull.start(corners, flipped.reach(), room)?;
            sector::mark_visible(memory, &flipped, division)
        }
        (None, division) => {
            let flipped = |index| flipped.get_out_of_line(index);
            flat::mark_visible(count, &flipped, &mut memory.visible)?;
            if let Some(division) = division {
                division.keep_own(&mut memory.visible);
            }
            Ok(())
        }
    }
}

/// Which of `points` are visible, for a single view.
pub(crate) fn visible_once(points: &Points, flip: &Flip) -> Result<Vec<bool>, OutOfMemory> {
    let mut memory = Memory::default();
    mark_visible(points, flip, None, &mut memory)?;
    Ok(memory.visible)
}

/// The same, and the outer faces of the hull as triangles of points, counter-clockwise
/// seen from the viewpoint; none where all is in one plane with the viewpoint.
pub(crate) fn triangulate_visible(
    points: &Points,
    flip: &Flip,
) -> Result<(Vec<bool>, Vec<[u32; 3]>), OutOfMemory> {
    let mut memory = Memory::default();
    mark_visible(points, flip, None, &mut memory)?;
    let mut triangles = Vec::new();
    if memory.holds_hull {
        let flip = flip.rescaled_for(points);
        let flipped = Flipped { points, flip };
        triangles = memory.hull.outer_triangles(&memory.on_boundary, &flipped)?;
    }
    Ok((memory.visible, triangles))
}

impl Memory {
    /// The last view's hull becomes that of the same vertices in this one, which are
    /// then marked as visible, if that is worth the while.
    fn move_hull(&mut self, flipped: &Flipped) -> Result<bool, OutOfMemory> {
        let moved = self
            .hull
            .move_to(flipped, &mut self.repair, &mut self.visible)?;
        if !moved {
            self.visible.fill(false);
        }
        Ok(moved)
    }

    /// Every point, to a hull that was just started.
    fn add_in_rounds(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.on_boundary.clear();
        self.witnesses.clear();
        self.witnesses.try_reserve_exact(flipped.len())?;
        self.witnesses.resize(flipped.len(), 0);
        let mut hint = 0;
        let count = flipped.len() as u32;
        for round in order::spatial_rounds() {
            if !round.is_last() {
                for index in round.indices(count) {
                    hint = self.add(index, flipped, [hint, hint])?;
                    self.witnesses[index as usize] = hint;
                }
                continue;
            }
            // By now the hull has its shape.
            self.depth
                .make(&self.hull, flipped, flipped.len(), &|_| true)?;
            for index in round.indices(count) {
                if !self.depth.hides(flipped.position(index)) {
                    hint = self.add(index, flipped, [hint, hint])?;
                }
                self.witnesses[index as usize] = hint;
            }
        }
        Ok(())
    }

    /// Every point that is no vertex, to a hull that has mostly the right ones.
    fn add_to_moved_hull(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.on_boundary.clear();
        self.depth
            .make(&self.hull, flipped, flipped.len(), &|_| true)?;
        let Some(mut hint) = self.hull.outer_face() else {
            return Ok(());
        };
        for index in 0..flipped.len() as u32 {
            if self.visible[index as usize] || self.depth.hides(flipped.position(index)) {
                continue;
            }
            let witness = self.witnesses[index as usize];
            hint = self.add(index, flipped, [hint, witness])?;
            self.witnesses[index as usize] = hint;
        }
        self.visible.fill(false);
        Ok(())
    }

    /// Locates a point, from the better of two hints, and makes it a vertex if it is
    /// outside; returns a face near it.
    #[inline(never)]
    fn add(
        &mut self,
        index: u32,
        flipped: &Flipped,
        [hint, other]: [FaceId; 2],
    ) -> Result<FaceId, OutOfMemory> {
        let Some(q) = flipped.get(index) else {
            push(&mut self.on_boundary, index)?;
            return Ok(hint);
        };
        let hint = self.hull.nearer_hint(q, hint, other);
        Ok(match self.hull.locate(q, hint) {
            Location::Outside(face) => self.hull.insert(index, q, face)?,
            Location::Boundary(face) => {
                push(&mut self.on_boundary, index)?;
                face
            }
            Location::Inside(face) => face,
        })
    }

    /// Reads the complete hull. A point found exactly on the boundary is visible only if
    /// it still is; one at the viewpoint is in any case.
    fn finish(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.hull.mark_outer_vertices(&mut self.visible);
        self.holds_hull = true;
        let Some(mut hint) = self.hull.outer_face() else {
            return Ok(());
        };
        for &index in &self.on_boundary {
            self.visible[index as usize] = match flipped.get_out_of_line(index) {
                None => true,
                Some(q) => match self.hull.locate(q, hint) {
                    Location::Boundary(face) => {
                        hint = face;
                        true
                    }
                    Location::Outside(_) | Location::Inside(_) => false,
                },
            };
        }
        Ok(())
    }
}

/// Three among every `step`th point that span space with the origin, of a large
/// determinant, in the order that makes it positive; `None` if those lie in one plane
/// with the origin.
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
