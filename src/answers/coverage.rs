//! Many viewpoints of one cloud: how many of them see each point.

use alloc::vec::Vec;

use crate::answers::threads::Threads;
use crate::base::allocation::filled;
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;
use crate::view::options::Options;
use crate::view::refusals::QuestionKind;
use crate::view::seat::Seat;

impl PointCloud {
    /// How many of `viewpoints`, or of cameras, see each index? The memory does not grow with their number.
    ///
    /// ```
    /// use hidden_point_removal::{Options, PointCloud};
    ///
    /// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [1.0, 0.0, 0.0]])?;
    /// let viewpoints = [[0.0, 0.0, 5.0], [0.0, 0.0, -5.0]];
    /// assert_eq!(cloud.coverage(&viewpoints, &Options::default())?, [1, 1, 2]);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Excludes`] for scores; [`Error::Camera`]; otherwise as [`PointCloud::visible_from`].
    pub fn coverage<S: Copy + Into<Seat> + Sync>(
        &self,
        viewpoints: &[S],
        options: &Options,
    ) -> Result<Vec<u32>, Error> {
        self.alone().coverage(viewpoints, options)
    }
}

impl Threads<'_> {
    /// As [`PointCloud::coverage`].
    ///
    /// # Errors
    /// As [`PointCloud::coverage`].
    pub fn coverage<S: Copy + Into<Seat> + Sync>(
        &self,
        viewpoints: &[S],
        options: &Options,
    ) -> Result<Vec<u32>, Error> {
        let mut counts: Vec<u32> = filled(self.len(), 0)?;
        options.check(QuestionKind::Coverage)?;
        self.each_view(self.count, viewpoints, options, &mut |_, seen| {
            let indices = seen.indices().iter();
            indices.for_each(|&index| counts[index as usize] += 1);
        })?;
        Ok(counts)
    }
}
