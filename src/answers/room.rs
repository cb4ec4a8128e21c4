//! What one view leaves for the next one.

use core::ops::{Deref, DerefMut};

use super::looks::{Gaze, Seen, Series};
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::selection::Selection;
use crate::hull::Memory;

/// The hull of the last view, and looks that were begun. Its content never changes an answer, as
/// long as it is only used for one sequence of points.
#[derive(Default)]
pub(crate) struct Room {
    hull: Memory,
    looks: Option<Series>,
}

impl Room {
    /// Forgets the last view, but keeps the room for hulls.
    pub(crate) fn forget(&mut self) {
        self.hull.forget();
        self.looks = None;
    }

    /// Prepares for a view of these points. Forgets the last view if it was of other points.
    pub(crate) fn see(&mut self, selection: Selection) {
        if self.hull.see(selection) {
            self.looks = None;
        }
    }

    /// Looks `count` times at `cloud`. Goes on from the same looks if they were begun.
    pub(crate) fn look(
        &mut self,
        cloud: &PointCloud,
        gaze: Gaze,
        count: usize,
        with_scores: bool,
    ) -> Result<Seen, Error> {
        while !self.go_on_looking(cloud, gaze, count, with_scores, usize::MAX)? {}
        match self.looks.take() {
            Some(series) => Ok(series.finish()?),
            None => Err(Error::OutOfMemory),
        }
    }

    /// Does a part of the work of [`Room::look`]. The hull of the first look takes about `budget`
    /// points at once. Returns whether little more than the answer is left.
    pub(crate) fn go_on_looking(
        &mut self,
        cloud: &PointCloud,
        gaze: Gaze,
        count: usize,
        with_scores: bool,
        budget: usize,
    ) -> Result<bool, Error> {
        let begun = self.looks.take();
        let series = match begun.filter(|series| series.is_of(gaze, count, with_scores)) {
            Some(series) => series,
            None => Series::new(cloud, gaze, count, with_scores)?,
        };
        let series = self.looks.insert(series);
        let is_done = series.step(cloud, &mut self.hull, budget);
        if is_done.is_err() {
            self.looks = None;
        }
        is_done
    }
}

impl Deref for Room {
    type Target = Memory;

    fn deref(&self) -> &Memory {
        &self.hull
    }
}

impl DerefMut for Room {
    fn deref_mut(&mut self) -> &mut Memory {
        &mut self.hull
    }
}
