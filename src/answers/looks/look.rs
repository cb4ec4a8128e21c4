//! A look's settings, and the decisions of all looks.

use alloc::vec::Vec;
use glam::DVec3;

use crate::answers::looks::part::Part;
use crate::answers::looks::tuning::{Odds, Tuning};
use crate::base::allocation::{OutOfMemory, filled};
use crate::base::real::square_root;

/// The score of a hull vertex, by look.
pub(super) const SCORES: [f64; 3] = [1.0, 0.8, 0.55];

/// The settings of one look.
pub(super) struct Look {
    /// The viewpoint; for a direction, a place near the middle of the cloud.
    pub origin: DVec3,
    /// A power of two by which places relative to the origin are scaled. In units of the cloud's
    /// size, products of three lengths and their squares neither overflow nor underflow.
    pub unit: f64,
    /// The direction of all rays. `None` where they start at the viewpoint.
    pub ahead: Option<DVec3>,
    /// The scale c of its hull, not in these units; at the farthest distance if it grows.
    pub scale: f64,
    pub tuning: Tuning,
    /// The largest distance of a point from the viewpoint.
    pub farthest: f64,
    /// The score of its vertices.
    pub score: f64,
    pub is_last: bool,
}

impl Look {
    /// A place relative to the origin, scaled.
    #[inline]
    pub(super) fn place(&self, point: [f64; 3]) -> DVec3 {
        (DVec3::from_array(point) - self.origin) * self.unit
    }

    /// The scale c for a [place](Self::place), in its units.
    pub(super) fn scale_at(&self, place: DVec3) -> f64 {
        let scale = self.scale * self.unit;
        if self.tuning.growth == 0.0 {
            return scale;
        }
        let range = square_root(place.length_squared()) / (self.farthest * self.unit);
        scale * libm::pow(range, self.tuning.growth)
    }

    /// How far behind a surface a point may be besides what its triangles allow, in these units.
    pub(super) fn thickness(&self) -> f64 {
        self.tuning.thickness * self.unit
    }
}

/// The answer of several looks, for each distinct point.
pub(crate) struct Seen {
    pub visible: Vec<bool>,
    /// From 0 to 1; empty unless asked for.
    pub scores: Vec<f32>,
    /// The scale c of each look; 0 for looks that were not taken.
    pub scales: [f64; 3],
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    Undecided,
    Hidden,
    Visible,
}

/// The decisions of the looks so far.
pub(super) struct Verdicts {
    pub of: Vec<Verdict>,
    /// Empty unless scores are asked for.
    pub scores: Vec<f32>,
    /// How long the triangles of a surface are at most (`decide`). The first look that has
    /// triangles finds it.
    pub longest: Option<f64>,
}

impl Verdicts {
    pub(super) fn new(count: usize, with_scores: bool) -> Result<Self, OutOfMemory> {
        Ok(Self {
            of: filled(count, Verdict::Undecided)?,
            // Where nothing decides, hidden is as sure as a vertex of the usual hull is visible.
            scores: filled(
                if with_scores { count } else { 0 },
                (1.0 - SCORES[1]) as f32,
            )?,
            longest: None,
        })
    }

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
    /// one plane with the viewpoint, or at it.
    pub(super) fn take_flat(&mut self, look: &Look, part: &Part, visible: &[bool]) {
        for (own, _) in visible.iter().enumerate().filter(|(_, is)| **is) {
            let point = part.place(own);
            if self.is_open(point) {
                self.decide(point, true, look.score);
            }
        }
    }

    /// Turns the scores into probabilities.
    pub(super) fn calibrate(&mut self, odds: Odds) {
        for score in &mut self.scores {
            *score = odds.probability(*score);
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
            scales: [0.0; 3],
        })
    }
}
