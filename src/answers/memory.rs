//! What one view leaves for the next one.

use crate::answers::looks::{Question, Seen, Series};
use crate::answers::visibility_map::pool::MapMemory;
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::selection::Region;
use crate::hull::Memory;

/// The hull of the last view, and looks that were begun. Its content never changes an answer, as long
/// as it is only used for one cloud.
#[derive(Default)]
pub(crate) struct ViewMemory {
    pub(crate) hull: Memory,
    pub(crate) maps: MapMemory,
    looks: Option<Series>,
    /// Where the points of the last view were.
    region: Option<Region>,
}

impl ViewMemory {
    /// Not inlined: all these fields would be written by each caller's own code.
    #[inline(never)]
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// Forgets the last view, but keeps the room for hulls.
    pub(crate) fn forget(&mut self) {
        self.hull.forget();
        self.maps = MapMemory::default();
        self.looks = None;
    }

    /// Prepares for a view of the points in a region. Forgets the last view if it was of other points.
    pub(crate) fn see(&mut self, region: Option<Region>) {
        if self.region != region {
            self.forget();
            self.region = region;
        }
    }

    /// Looks at `cloud` as the question says. Goes on from the same looks if they were begun.
    pub(crate) fn look(&mut self, cloud: &PointCloud, question: Question) -> Result<Seen, Error> {
        while !self.go_on_looking(cloud, question, usize::MAX)? {}
        match self.looks.take() {
            Some(series) => series.finish(cloud),
            None => Err(Error::OutOfMemory),
        }
    }

    /// Does a part of the work of [`ViewMemory::look`]. The hull of the first look takes about `budget`
    /// points at once. Returns whether little more than the answer is left.
    pub(crate) fn go_on_looking(
        &mut self,
        cloud: &PointCloud,
        question: Question,
        budget: usize,
    ) -> Result<bool, Error> {
        let begun = self.looks.take();
        let series = match begun.filter(|series| series.is_of(question)) {
            Some(series) => series,
            None => Series::new(cloud, question)?,
        };
        let series = self.looks.insert(series);
        let is_done = series.step(cloud, &mut self.hull, budget);
        if is_done.is_err() {
            self.looks = None;
        }
        is_done
    }
}
