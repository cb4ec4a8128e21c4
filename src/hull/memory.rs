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

/// The last view's hull, and room for the next one's. What it holds never changes
/// an answer, as long as it is only used for one sequence of points.
#[derive(Default)]
pub(crate) struct Memory {
    pub(super) hull: Hull,
    pub(super) depth: DepthMap,
    pub(super) repair: Repair,
    pub(super) on_boundary: Vec<u32>,
    pub(super) visible: Vec<bool>,
    /// Near which face each point was last seen: where to look for it next time.
    witnesses: Vec<FaceId>,
    /// Whether `hull` is that of the last view.
    pub(super) holds_hull: bool,
    /// Whether the last view was found from the one before it.
    pub(super) moved: bool,
    /// How much of the last view's hull may have changed for it to be mended.
    patience: Patience,
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

    /// Near which face each point was last seen.
    pub(super) fn witnesses(&self) -> &[FaceId] {
        &self.witnesses
    }

    /// The next views, until this memory forgets, are from the same viewpoint at other scales.
    pub(crate) fn expect_other_scales(&mut self) {
        self.patience = Patience::GREAT;
    }

    /// Forgets the last view, but keeps the room.
    pub(crate) fn forget(&mut self) {
        self.holds_hull = false;
        self.patience = Patience::USUAL;
    }
}

impl Memory {
    /// The last view's hull becomes that of the same vertices in this one, which are
    /// then marked as visible, if that is worth the while.
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

    /// Every point, to a hull that was just started.
    pub(super) fn add_in_rounds(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.start_witnesses(flipped.len())?;
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
        for round in order::spatial_rounds() {
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
    pub(super) fn finish(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        #[cfg(debug_assertions)]
        self.hull.assert_is_hull();
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
