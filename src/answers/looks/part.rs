//! The points that take part in a look.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, push};
use crate::cloud::blocks::Blocks;
use crate::cloud::points::Points;

/// Some of a cloud's points, in the cloud's order, or all of them.
pub(super) enum Part {
    All,
    Some {
        points: Points,
        blocks: Blocks,
        /// The place of each point in the cloud.
        places: Vec<u32>,
        /// The local spacing of each point that earlier looks have found; infinite for points
        /// that were no vertices.
        spacing: Vec<f64>,
    },
}

impl Part {
    /// The part of `points` at `places`.
    pub(super) fn of(
        points: &Points,
        places: Vec<u32>,
        spacing: Vec<f64>,
    ) -> Result<Self, OutOfMemory> {
        let some = points.gathered(&places)?;
        Ok(Self::Some {
            blocks: Blocks::around(&some)?,
            points: some,
            places,
            spacing,
        })
    }

    /// The number of its points, in a cloud of `all` points.
    pub(super) fn len(&self, all: usize) -> usize {
        match self {
            Self::All => all,
            Self::Some { places, .. } => places.len(),
        }
    }

    /// The place in the cloud of the part's point `own`.
    pub(super) fn place(&self, own: usize) -> usize {
        match self {
            Self::All => own,
            Self::Some { places, .. } => places[own] as usize,
        }
    }

    pub(super) fn spacing(&self, own: usize) -> f64 {
        match self {
            Self::All => f64::INFINITY,
            Self::Some { spacing, .. } => spacing[own],
        }
    }
}

/// The points of a look that take part in the next look, too.
pub(super) struct Left {
    pub takes_part: Vec<bool>,
    /// The local spacing of each point.
    pub spacing: Vec<f64>,
}

impl Left {
    /// The part for the next look.
    pub(super) fn part(self, points: &Points, before: &Part) -> Result<Part, OutOfMemory> {
        let mut places = Vec::new();
        let mut spacing = Vec::new();
        for (own, takes_part) in self.takes_part.into_iter().enumerate() {
            if takes_part {
                push(&mut places, before.place(own) as u32)?;
                push(&mut spacing, self.spacing[own])?;
            }
        }
        Part::of(points, places, spacing)
    }
}
