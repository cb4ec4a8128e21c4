//! The hull of one view: points are added to it, and the complete hull is read. A view may be computed
//! in slices.

use alloc::vec::Vec;

use crate::base::FULL;
use crate::base::allocation::{OutOfMemory, push};
use crate::base::beat;
use crate::base::real::one_by_one;
use crate::flip::inversion::Flip;
use crate::hull::depth::DepthMap;
use crate::hull::flipped::Flipped;
use crate::hull::incremental::Hull;
use crate::hull::locate::Location;
use crate::hull::order::{self, AngularOrder, LAST_ROUND, points_at};
use crate::hull::topology::FaceId;

/// The last view's hull, whose room the next view uses. Its content never changes an answer, as
/// long as it is only used for one sequence of points.
#[derive(Default)]
pub(crate) struct Memory {
    pub(super) hull: Hull,
    pub(super) depth: DepthMap,
    pub(super) on_boundary: Vec<u32>,
    pub(super) visible: Vec<bool>,
    pub(super) state: State,
}

/// What a memory holds of the last view, besides the visible points.
#[derive(Default)]
pub(super) enum State {
    /// No hull that has a use.
    #[default]
    Empty,
    /// The hull of one point in eight, to which points of the last round may have been added. The next
    /// view with this flip goes on from there.
    Begun(Flip, LastRound),
    /// The complete hull.
    Complete,
}

/// How far the last round has come.
#[derive(Clone, Copy)]
pub(super) struct LastRound {
    /// How many runs of points are in the hull already.
    runs: usize,
    /// The face near the last point of these runs, or any outer face.
    reached: FaceId,
}

impl Memory {
    /// Not inlined: all these fields would be written by each caller's own code.
    #[inline(never)]
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// Which of the points were visible.
    pub(crate) fn visible(&self) -> &[bool] {
        &self.visible
    }

    /// The same, which are no longer kept.
    pub(crate) fn take_visible(&mut self) -> Vec<bool> {
        self.forget();
        core::mem::take(&mut self.visible)
    }

    /// Forgets the last view, but keeps the room.
    pub(crate) fn forget(&mut self) {
        self.state = State::Empty;
    }

    /// Whether the last view has left a complete hull in space.
    pub(super) fn holds_hull(&self) -> bool {
        matches!(self.state, State::Complete)
    }

    /// How far the last round of a view with this flip has come; `None` if no such view was begun.
    pub(super) fn begun(&self, flip: &Flip) -> Option<LastRound> {
        match self.state {
            State::Begun(begun, round) if FULL && begun == *flip => Some(round),
            _ => None,
        }
    }

    /// Keeps a hull, of which the last round has come so far.
    pub(super) fn begin(&mut self, flip: Flip, round: LastRound) {
        self.state = State::Begun(flip, round);
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
        let mut hint = 0;
        let count = flipped.len() as u32;
        for round in order::coarse_rounds() {
            for (at, index) in round.indices(count).enumerate() {
                beat::step_at(at);
                hint = self.add(index, flipped, hint)?;
            }
        }
        // Eight times as many points have 4 to 8 times as many vertices and faces.
        let hull = &mut self.hull;
        let [vertices, faces] = [hull.vertex_count(), hull.surface.slots()].map(|many| 8 * many);
        hull.reserve(
            vertices.min(1 + flipped.len()),
            faces.min(2 * flipped.len()),
        );
        Ok(())
    }

    /// Makes the depth map of the hull of the coarse rounds. It has about its final shape.
    #[inline(never)]
    pub(super) fn make_map(&mut self, flipped: &Flipped) -> Result<(), OutOfMemory> {
        self.depth
            .make(&self.hull, flipped, flipped.len(), &|_| true)
    }

    /// Adds every point to a hull that was just started.
    #[inline(never)]
    pub(super) fn add_all(&mut self, flipped: &Flipped, with_map: bool) -> Result<(), OutOfMemory> {
        self.add_coarse_rounds(flipped)?;
        if with_map {
            self.make_map(flipped)?;
        } else {
            self.depth.clear();
        }
        let mut round = self.last_round();
        self.add_last_round(flipped, &mut round, usize::MAX)?;
        Ok(())
    }

    /// The last round, before any of its points are added.
    pub(super) fn last_round(&self) -> LastRound {
        // There is an outer face while there is a hull.
        let reached = self.hull.outer_face().unwrap_or(0);
        LastRound { runs: 0, reached }
    }

    /// Adds the points of the last round that the map does not hide. Stops after about `budget` points.
    /// Returns whether all are added. To stop and to go on changes nothing, not even how faces are
    /// numbered: where a ray passes exactly through an edge, the first outer face chooses the
    /// triangle.
    #[inline(never)]
    pub(super) fn add_last_round(
        &mut self,
        flipped: &Flipped,
        round: &mut LastRound,
        mut budget: usize,
    ) -> Result<bool, OutOfMemory> {
        let mut hint = round.reached;
        for run in order::runs(flipped.len() as u32).skip(round.runs) {
            if budget == 0 {
                round.reached = hint;
                return Ok(false);
            }
            beat::step();
            round.runs += 1;
            let added = self.depth.not_hidden(flipped, run.start, LAST_ROUND);
            // To test a block takes about as long as to add a few points.
            budget = budget.saturating_sub(8 + added.count_ones() as usize);
            for index in points_at(run.start, added) {
                hint = self.add(index, flipped, hint)?;
            }
        }
        round.reached = hint;
        Ok(true)
    }

    /// Adds every point to a hull that was just started. Except for roundings, the cloud lies in
    /// one plane with the viewpoint.
    #[inline(never)]
    pub(super) fn add_by_angle(
        &mut self,
        order: &AngularOrder,
        flipped: &Flipped,
    ) -> Result<(), OutOfMemory> {
        let mut hint = 0;
        for round in order::coarse_rounds().chain([order::last_round()]) {
            for (at, (_, index)) in order.sorted(round, flipped)?.into_iter().enumerate() {
                beat::step_at(at);
                hint = self.add(index, flipped, hint)?;
            }
        }
        Ok(())
    }

    /// Locates a point from `hint`. Makes it a vertex if it is outside. Returns a face near it.
    #[inline(never)]
    fn add(&mut self, index: u32, flipped: &Flipped, hint: FaceId) -> Result<FaceId, OutOfMemory> {
        let Some(q) = flipped.get(index) else {
            push(&mut self.on_boundary, index)?;
            return Ok(hint);
        };
        let q = one_by_one(q);
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
        self.mark_boundary(flipped)?;
        self.complete();
        Ok(())
    }

    /// The hull has all points.
    pub(super) fn complete(&mut self) {
        #[cfg(debug_assertions)]
        self.hull.assert_is_hull();
        self.state = State::Complete;
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
