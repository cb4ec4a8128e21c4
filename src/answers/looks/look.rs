//! A look's settings, and the decisions of all looks.

use alloc::vec::Vec;

use super::part::Part;
use crate::base::allocation::{OutOfMemory, filled};
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;

/// The score of a point that nothing decides.
const UNKNOWN: f64 = 0.2;

/// The settings of one look.
pub(super) struct Look {
    pub flip: Flip,
    /// The scale c of its hull.
    pub scale: f64,
    /// The score of its vertices.
    pub score: f64,
    pub is_last: bool,
}

/// The answer of several looks, for each distinct point.
pub(crate) struct Seen {
    pub visible: Vec<bool>,
    /// From 0 to 1; empty unless asked for.
    pub scores: Vec<f32>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    Undecided,
    Hidden,
    Visible,
}

/// The decisions of the looks so far.
pub(super) struct Verdicts<'a> {
    pub points: &'a Points,
    pub of: Vec<Verdict>,
    /// Empty unless scores are asked for.
    pub scores: Vec<f32>,
}

impl<'a> Verdicts<'a> {
    pub(super) fn new(points: &'a Points, with_scores: bool) -> Result<Self, OutOfMemory> {
        let count = points.len();
        Ok(Self {
            points,
            of: filled(count, Verdict::Undecided)?,
            scores: filled(if with_scores { count } else { 0 }, UNKNOWN as f32)?,
        })
    }

    #[inline]
    pub(super) fn decide(&mut self, point: usize, is_visible: bool, score: f64) {
        self.of[point] = if is_visible {
            Verdict::Visible
        } else {
            Verdict::Hidden
        };
        if let Some(kept) = self.scores.get_mut(point) {
            *kept = score as f32;
        }
    }

    pub(super) fn is_open(&self, point: usize) -> bool {
        self.of[point] == Verdict::Undecided
    }

    /// Whether any point is undecided.
    pub(super) fn are_open(&self) -> bool {
        self.of.contains(&Verdict::Undecided)
    }

    /// Decides for the points that are visible in a look without triangles: all its points are in
    /// one plane with the viewpoint.
    pub(super) fn take_flat(&mut self, look: &Look, part: &Part, visible: &[bool]) {
        for (own, _) in visible.iter().enumerate().filter(|(_, is)| **is) {
            let point = part.place(own);
            if self.is_open(point) {
                let is_at_viewpoint = look.flip.apply(self.points.get(point)).is_none();
                self.decide(point, true, if is_at_viewpoint { 1.0 } else { look.score });
            }
        }
    }

    /// The answer. A point that is still undecided is hidden.
    pub(super) fn finish(self) -> Result<Seen, OutOfMemory> {
        let mut visible = filled(self.of.len(), false)?;
        for (visible, verdict) in visible.iter_mut().zip(&self.of) {
            *visible = *verdict == Verdict::Visible;
        }
        Ok(Seen {
            visible,
            scores: self.scores,
        })
    }
}
