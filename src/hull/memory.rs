//! The hull of one view: points are added to it, and the complete hull is read. An exact view may
//! go on from the hull of its draft.

use alloc::vec::Vec;

use super::around::Around;
use super::depth::DepthMap;
use super::flipped::Flipped;
use super::incremental::Hull;
use super::locate::Location;
use super::order::{self, LAST_ROUND, points_at};
use super::topology::FaceId;
use crate::base::allocation::{OutOfMemory, push};
use crate::base::beat;
use crate::base::bits::bits_of;
use crate::cloud::selection::Selection;
use crate::flip::inversion::Flip;

/// The last view's hull, whose room the next view uses. Its content never changes
/// an answer, as long as it is only used for one sequence of points.
#[derive(Default)]
pub(crate) struct Memory {
    pub(super) hull: Hull,
    pub(super) depth: DepthMap,
    pub(super) on_boundary: Vec<u32>,
    pub(super) visible: Vec<bool>,
    /// Whether `hull` is the complete hull of the last view.
    pub(super) holds_hull: bool,
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

    /// Forgets the last view, but keeps the room.
    pub(crate) fn forget(&mut self) {
        self.holds_hull = false;
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

    /// Adds every point but those of the last round to a hull that was just started.
    #[inline(never)]
    pub(super) fn add_coarse_rounds(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.start_rounds();
        let mut hint = 0;
        let count = flipped.len() as u32;
        for round in order::coarse_rounds() {
            for (at, index) in round.indices(count).enumerate() {
                beat::step_at(at);
                hint = self.add(index, flipped, hint)?;
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
            for index in points_at(run.start, added) {
                hint = self.add(index, flipped, hint)?;
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
        self.start_rounds();
        let mut hint = 0;
        for round in order::coarse_rounds().chain([order::last_round()]) {
            for (at, (_, index)) in plane.sorted(round, flipped)?.into_iter().enumerate() {
                beat::step_at(at);
                hint = self.add(index, flipped, hint)?;
            }
        }
        Ok(())
    }

    fn start_rounds(&mut self) {
        self.runs_added = 0;
        self.on_boundary.clear();
    }

    /// Locates a point from `hint`. Makes it a vertex if it is outside. Returns a face near it.
    #[inline(never)]
    fn add(&mut self, index: u32, flipped: &Flipped, hint: FaceId) -> Result<FaceId, OutOfMemory> {
        let Some(q) = flipped.get(index) else {
            push(&mut self.on_boundary, index)?;
            return Ok(hint);
        };
        Ok(match self.hull.locate(q, hint) {
            Location::Outside(face) => self.hull.insert(index, q, face)?,
            Location::Boundary(face) => {
                push(&mut self.on_boundary, index)?;
                face
            }
            Location::Inside(face) => face,
        })
    }

    /// Reads the complete hull.
    pub(super) fn finish(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        #[cfg(debug_assertions)]
        self.hull.assert_is_hull();
        self.holds_hull = true;
        self.mark_boundary(flipped)?;
        Ok(())
    }

    /// Marks the added points that are on the hull's boundary. A point that was found exactly on
    /// the boundary is visible only if it is still there at the end. A point at the viewpoint is
    /// always visible.
    #[inline(never)]
    pub(super) fn mark_boundary(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.hull.mark_outer_vertices(&mut self.visible);
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
