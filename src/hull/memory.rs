//! The hull of one view, which the next view may start from: points are added to it, and
//! the complete hull is read.

use alloc::vec::Vec;

use super::around::Around;
use super::depth::DepthMap;
use super::flipped::Flipped;
use super::incremental::Hull;
use super::locate::Location;
use super::motion::Patience;
use super::order;
use super::repair::Repair;
use super::topology::FaceId;
use crate::base::allocation::{OutOfMemory, push};
use crate::flip::inversion::Flip;

/// The last view's hull, and room for the next one's. What it holds never changes
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
    /// Whether `hull` is that of the last view.
    pub(super) holds_hull: bool,
    /// Whether the last view started from the view before it.
    pub(super) moved: bool,
    /// How much of the last hull may change before it is made anew rather than mended.
    patience: Patience,
    /// The flip of the last draft, if `hull` is its hull and `depth` its map. The next view may go
    /// on from there.
    pub(super) drafted: Option<Flip>,
    /// The number of sampled points in the last view; `None` where all took part.
    sample: Option<usize>,
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

    /// The face near which each point was located last.
    pub(super) fn witnesses(&self) -> &[FaceId] {
        &self.witnesses
    }

    /// The next views, until this memory forgets, are from the same viewpoint at other scales.
    pub(crate) fn expect_other_scales(&mut self) {
        self.patience = Patience::GREAT;
    }

    /// The next view is of a sample of `count` points, or of all. Forgets the last view if it was
    /// of other points.
    pub(crate) fn see_sample(&mut self, sample: Option<usize>) {
        if self.sample != sample {
            self.forget();
            self.sample = sample;
        }
    }

    /// No later view starts by moving the last hull. A view may still go on from a draft.
    pub(crate) fn forget_moves(&mut self) {
        self.holds_hull = false;
    }

    /// Forgets the last view, but keeps the room.
    pub(crate) fn forget(&mut self) {
        self.holds_hull = false;
        self.patience = Patience::USUAL;
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

    /// The last view's hull becomes that of the same vertices in this one, which are
    /// then marked as visible, if that is faster than starting anew.
    pub(super) fn move_hull(&mut self, flipped: &Flipped) -> Result<bool, OutOfMemory> {
        let moved =
            self.hull
                .move_to(flipped, &mut self.repair, &mut self.visible, self.patience)?;
        if !moved {
            self.visible.fill(false);
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
            for index in round.indices(count) {
                hint = self.add(index, flipped, [hint, hint])?;
                self.witnesses[index as usize] = hint;
            }
        }
        Ok(())
    }

    /// Maps the hull of the coarse rounds, which has its shape.
    #[inline(never)]
    pub(super) fn make_map(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.depth
            .make(&self.hull, flipped, flipped.len(), &|_| true)
    }

    /// The points of the last round.
    #[inline(never)]
    pub(super) fn add_last_round(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        let Some(mut hint) = self.hull.outer_face() else {
            return Ok(());
        };
        for run in order::runs(flipped.len() as u32) {
            if self.depth.hides_run(flipped, &run) {
                self.witnesses[run.start as usize..run.end as usize].fill(hint);
                continue;
            }
            for index in order::last_round().indices_in(run) {
                if !self.depth.hides(flipped, index) {
                    hint = self.add(index, flipped, [hint, hint])?;
                }
                self.witnesses[index as usize] = hint;
            }
        }
        Ok(())
    }

    /// Every point, to a hull that was just started, of a cloud in one plane with the viewpoint
    /// but for rounding.
    #[inline(never)]
    pub(super) fn add_around(
        &mut self,
        plane: &Around,
        flipped: &Flipped,
    ) -> Result<(), OutOfMemory> {
        self.start_witnesses(flipped.len())?;
        let mut hint = 0;
        for round in order::coarse_rounds().chain([order::last_round()]) {
            for (_, index) in plane.sorted(round, flipped)? {
                hint = self.add(index, flipped, [hint, hint])?;
                self.witnesses[index as usize] = hint;
            }
        }
        Ok(())
    }

    fn start_witnesses(&mut self, count: usize) -> Result<(), OutOfMemory> {
        self.on_boundary.clear();
        self.witnesses.clear();
        self.witnesses.try_reserve_exact(count)?;
        self.witnesses.resize(count, 0);
        Ok(())
    }

    /// Every point that is no vertex, to a hull that has mostly the right ones.
    pub(super) fn add_to_moved_hull(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.on_boundary.clear();
        self.depth
            .make(&self.hull, flipped, flipped.len(), &|_| true)?;
        let Some(mut hint) = self.hull.outer_face() else {
            return Ok(());
        };
        for index in 0..flipped.len() as u32 {
            if self.visible[index as usize] || self.depth.hides(flipped, index) {
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

    /// Reads the complete hull, which the next view may start from.
    pub(super) fn finish(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        #[cfg(debug_assertions)]
        self.hull.assert_is_hull();
        self.holds_hull = true;
        self.mark_boundary(flipped)
    }

    /// Marks what is on the hull's boundary of the points that were added. A point that was
    /// found exactly on it is visible only if it still is; one at the viewpoint is in any case.
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
