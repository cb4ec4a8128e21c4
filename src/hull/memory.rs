//! The hull of one view, which the next view may start from: points are added to it, and
//! the complete hull is read.

use alloc::vec::Vec;

use super::around::Around;
use super::depth::DepthMap;
use super::flipped::Flipped;
use super::incremental::Hull;
use super::locate::Location;
use super::order::{self, LAST_ROUND, points_at};
use super::repair::Repair;
use super::topology::FaceId;
use crate::base::allocation::{OutOfMemory, push};
use crate::base::beat;
use crate::base::bits::bits_of;
use crate::cloud::selection::Selection;
use crate::flip::inversion::Flip;

/// A moved hull gets no map of directions if at most one point in this many is hidden. Few points
/// are located faster than a map is made.
const FEW_HIDDEN: usize = 2;

/// After so many repairs that failed in a row, the pause before the next one grows no more.
const MOST_FAILURES: u32 = 5;

/// A motion is slower, and moves again, where this many times fewer edges are reflex than where a repair
/// failed.
const MUCH_SLOWER: f64 = 3.0;

/// The last view's hull, and room for the hull of the next view. Its content never changes
/// an answer, as long as it is only used for one sequence of points.
#[derive(Default)]
pub(crate) struct Memory {
    pub(super) hull: Hull,
    pub(super) depth: DepthMap,
    pub(super) repair: Repair,
    pub(super) on_boundary: Vec<u32>,
    pub(super) visible: Vec<bool>,
    /// The face near which each point was located last: the start of its next walk.
    witnesses: Vec<FaceId>,
    /// Whether `hull` is the hull of the last view.
    pub(super) holds_hull: bool,
    /// Whether the last view started from the view before it.
    pub(super) moved: bool,
    /// How many repairs failed in a row, up to a limit.
    failures: u32,
    /// How many views that could be moved start with a new hull instead.
    pause: u32,
    /// The share of reflex edges where a repair failed last.
    failed_share: f64,
    /// The flip of the last draft, if `visible` holds its points and `hull` its hull, to which points
    /// of the last round may have been added. The next view may go on from there.
    pub(super) drafted: Option<Flip>,
    /// How many runs of the last round are in `hull` already.
    pub(super) runs_added: usize,
    /// The face near the last point of these runs.
    reached: FaceId,
    /// The choice of points in the last view.
    selection: Selection,
}

impl Memory {
    /// Which of the points were visible.
    pub(crate) fn visible(&self) -> &[bool] {
        &self.visible
    }

    /// Whether the last view started from the view before it.
    pub(crate) fn moved(&self) -> bool {
        self.moved
    }

    /// Prepares for a view of these points. Forgets the last view if it was of other points.
    /// Returns whether it was.
    pub(crate) fn see(&mut self, selection: Selection) -> bool {
        let is_other = self.selection != selection;
        if is_other {
            self.forget();
            self.selection = selection;
        }
        is_other
    }

    /// Ensures that no later view starts by moving the last hull. A view may still go on from a
    /// draft.
    pub(crate) fn forget_moves(&mut self) {
        self.holds_hull = false;
    }

    /// Forgets the last view, but keeps the room.
    pub(crate) fn forget(&mut self) {
        self.holds_hull = false;
        self.failures = 0;
        self.pause = 0;
        self.drafted = None;
    }
}

impl Memory {
    /// Marks none of `count` points.
    #[inline(never)]
    pub(super) fn clear_marks(&mut self, count: usize) -> Result<(), OutOfMemory> {
        self.visible.clear();
        self.visible.try_reserve_exact(count)?;
        self.visible.resize(count, false);
        Ok(())
    }

    /// Moves the last view's hull to this view, if that is faster than a new hull. The vertices
    /// of the moved hull are marked as visible. Returns whether the hull was moved.
    pub(super) fn move_hull(&mut self, flipped: &Flipped) -> Result<bool, OutOfMemory> {
        let Some(share) = self.hull.reflex_share(flipped) else {
            return Ok(false);
        };
        // A repair that fails costs much, and the next one is likely to fail, too. A slower motion
        // is not: far fewer edges are reflex.
        if self.pause > 0 && share * MUCH_SLOWER > self.failed_share {
            self.pause -= 1;
            return Ok(false);
        }
        let moved = self.hull.move_to(
            flipped,
            &mut self.repair,
            &mut self.visible,
            &mut self.witnesses,
        )?;
        if moved {
            self.failures = 0;
            self.pause = 0;
        } else {
            self.visible.fill(false);
            self.failures = MOST_FAILURES.min(self.failures + 1);
            self.pause = (1 << self.failures) - 1;
            self.failed_share = share;
        }
        #[cfg(debug_assertions)]
        if moved {
            self.hull.assert_is_hull();
        }
        Ok(moved)
    }

    /// Adds every point but those of the last round to a hull that was just started.
    #[inline(never)]
    pub(super) fn add_coarse_rounds(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.start_witnesses(flipped.len())?;
        let mut hint = 0;
        let count = flipped.len() as u32;
        for round in order::coarse_rounds() {
            for (at, index) in round.indices(count).enumerate() {
                beat::step_at(at);
                hint = self.add(index, flipped, hint, None)?;
                self.witnesses[index as usize] = hint;
            }
        }
        Ok(())
    }

    /// Makes the depth map of the hull of the coarse rounds. It has about its final shape.
    #[inline(never)]
    pub(super) fn make_map(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.depth
            .make(&self.hull, flipped, flipped.len(), &|_| true)
    }

    /// Adds the points of the last round that the map does not hide. After a draft, these are the
    /// points that it shows, and no point is tested again. Stops after about `budget` points.
    /// Returns whether all are added. To stop and to go on changes nothing, not even how faces are
    /// numbered: where a ray passes exactly through an edge, the first outer face chooses the
    /// triangle.
    #[inline(never)]
    pub(super) fn add_last_round(
        &mut self,
        flipped: &Flipped,
        is_drafted: bool,
        mut budget: usize,
    ) -> Result<bool, OutOfMemory> {
        let Some(mut hint) = self.hull.outer_face() else {
            return Ok(true);
        };
        if self.runs_added > 0 {
            hint = self.reached;
        }
        for run in order::runs(flipped.len() as u32).skip(self.runs_added) {
            if budget == 0 {
                self.reached = hint;
                return Ok(false);
            }
            beat::step();
            self.runs_added += 1;
            let added = if is_drafted {
                bits_of(&self.visible[run.start as usize..run.end as usize]) & LAST_ROUND
            } else {
                self.depth.not_hidden(flipped, run.start, LAST_ROUND)
            };
            // To test a block takes about as long as to add a few points.
            budget = budget.saturating_sub(8 + added.count_ones() as usize);
            self.witnesses[run.start as usize..run.end as usize].fill(hint);
            for index in points_at(run.start, added) {
                hint = self.add(index, flipped, hint, None)?;
                self.witnesses[index as usize] = hint;
            }
        }
        Ok(true)
    }

    /// Adds every point to a hull that was just started. Except for roundings, the cloud lies in
    /// one plane with the viewpoint.
    #[inline(never)]
    pub(super) fn add_around(
        &mut self,
        plane: &Around,
        flipped: &Flipped,
    ) -> Result<(), OutOfMemory> {
        self.start_witnesses(flipped.len())?;
        let mut hint = 0;
        for round in order::coarse_rounds().chain([order::last_round()]) {
            for (at, (_, index)) in plane.sorted(round, flipped)?.into_iter().enumerate() {
                beat::step_at(at);
                hint = self.add(index, flipped, hint, None)?;
                self.witnesses[index as usize] = hint;
            }
        }
        Ok(())
    }

    fn start_witnesses(&mut self, count: usize) -> Result<(), OutOfMemory> {
        self.runs_added = 0;
        self.on_boundary.clear();
        self.witnesses.clear();
        self.witnesses.try_reserve_exact(count)?;
        self.witnesses.resize(count, 0);
        Ok(())
    }

    /// Adds every point that is no vertex to a moved hull. Most of its vertices are right
    /// already.
    pub(super) fn add_to_moved_hull(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.on_boundary.clear();
        let count = flipped.len();
        let hidden = (count + 1).saturating_sub(self.hull.vertex_count());
        if hidden * FEW_HIDDEN > count {
            self.depth.make(&self.hull, flipped, hidden, &|_| true)?;
        } else {
            self.depth.clear();
        }
        let Some(mut hint) = self.hull.outer_face() else {
            return Ok(());
        };
        for run in order::runs(count as u32) {
            let marks = &self.visible[run.start as usize..run.end as usize];
            let open = !bits_of(marks);
            let added = self.depth.not_hidden(flipped, run.start, open);
            for index in points_at(run.start, added) {
                let witness = self.witnesses[index as usize];
                hint = self.add(index, flipped, hint, Some(witness))?;
                self.witnesses[index as usize] = hint;
            }
        }
        self.visible.fill(false);
        Ok(())
    }

    /// Locates a point from `hint`. Makes it a vertex if it is outside. Returns a face near it. In a
    /// moved hull `witness` is the face near which the point was located last.
    #[inline(never)]
    fn add(
        &mut self,
        index: u32,
        flipped: &Flipped,
        hint: FaceId,
        witness: Option<FaceId>,
    ) -> Result<FaceId, OutOfMemory> {
        let Some(q) = flipped.get(index) else {
            push(&mut self.on_boundary, index)?;
            return Ok(hint);
        };
        let location = match witness {
            None => self.hull.locate(q, hint),
            Some(witness) => self.hull.locate_again(q, hint, witness),
        };
        Ok(match location {
            Location::Outside(face) => self.hull.insert(index, q, face)?,
            Location::Boundary(face) => {
                push(&mut self.on_boundary, index)?;
                face
            }
            Location::Inside(face) => face,
        })
    }

    /// Reads the complete hull. The next view may start from it.
    pub(super) fn finish(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        #[cfg(debug_assertions)]
        self.hull.assert_is_hull();
        self.holds_hull = true;
        self.mark_boundary(flipped)?;
        #[cfg(debug_assertions)]
        self.hull.assert_is_listed();
        Ok(())
    }

    /// Marks the added points that are on the hull's boundary. A point that was found exactly on
    /// the boundary is visible only if it is still there at the end. A point at the viewpoint is
    /// always visible.
    #[inline(never)]
    pub(super) fn mark_boundary(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.hull.list_new()?;
        self.hull.mark_outer_vertices(&mut self.visible);
        let Some(mut hint) = self.hull.outer_face() else {
            return Ok(());
        };
        for &index in &self.on_boundary {
            self.visible[index as usize] = match flipped.get_out_of_line(index) {
                None => true,
                Some(q) => match self.hull.locate_again(q, hint, hint) {
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
