//! The same questions, asked with several threads.

use alloc::vec::Vec;
use core::ops::Deref;

use crate::answers::camera::CameraView;
use crate::answers::coverage::{Placement, Placing};
use crate::answers::illumination::Lighting;
use crate::answers::visibility::Visibility;
use crate::base::error::{Error, in_range};
use crate::cloud::point_cloud::PointCloud;
use crate::view::camera::Camera;
use crate::view::options::Options;
use crate::view::seat::Seat;

/// More threads would only wait for memory.
const MOST: f64 = 256.0;

/// A cloud that is asked with several threads. The answers are those of one thread, to the bit.
///
/// Several viewpoints are shared among the threads. If there are fewer viewpoints than threads,
/// each view is divided by direction. This needs spherical flipping with an exponent below 8, and
/// neither looks nor a draft: then one thread computes the view. All other questions to the
/// [`PointCloud`] can be asked, too, with one thread. While a question is answered, each thread
/// takes about 150 bytes for each visible point of its share, and one byte for each point.
///
/// ```
/// use hidden_point_removal::{Options, PointCloud};
///
/// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]])?;
/// let cloud = cloud.with_threads(2)?;
/// let visible = cloud.visible_from([0.0, 0.0, 5.0], &Options::default())?;
/// assert_eq!(visible.indices(), [0, 2]);
/// # Ok::<(), hidden_point_removal::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Threads<'a> {
    cloud: &'a PointCloud,
    count: usize,
}

impl PointCloud {
    /// This cloud, asked with `count` threads, of which the caller's is one. Clouds below 200,000
    /// points gain little from threads that share a view.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless `count` is from 1 to 256.
    pub fn with_threads(&self, count: usize) -> Result<Threads<'_>, Error> {
        in_range("threads", count as f64, 1.0, MOST)?;
        Ok(Threads { cloud: self, count })
    }
}

impl Deref for Threads<'_> {
    type Target = PointCloud;

    fn deref(&self) -> &PointCloud {
        self.cloud
    }
}

impl Threads<'_> {
    /// As [`PointCloud::visible_from`].
    ///
    /// # Errors
    /// As [`PointCloud::visible_from`].
    pub fn visible_from(
        &self,
        viewpoint: [f64; 3],
        options: &Options,
    ) -> Result<Visibility, Error> {
        self.cloud.visible_from_by(self.count, viewpoint, options)
    }

    /// As [`PointCloud::visible_from_camera`].
    ///
    /// # Errors
    /// As [`PointCloud::visible_from_camera`].
    pub fn visible_from_camera(
        &self,
        camera: &Camera,
        options: &Options,
    ) -> Result<CameraView, Error> {
        self.cloud
            .visible_from_camera_by(self.count, camera, options)
    }

    /// As [`PointCloud::visible_from_any`].
    ///
    /// # Errors
    /// As [`PointCloud::visible_from_any`].
    pub fn visible_from_any<S: Copy + Into<Seat> + Sync>(
        &self,
        viewpoints: &[S],
        options: &Options,
    ) -> Result<Visibility, Error> {
        self.cloud
            .visible_from_several(self.count, 1, viewpoints, options)
    }

    /// As [`PointCloud::visible_from_at_least`].
    ///
    /// # Errors
    /// As [`PointCloud::visible_from_at_least`].
    pub fn visible_from_at_least<S: Copy + Into<Seat> + Sync>(
        &self,
        k: usize,
        viewpoints: &[S],
        options: &Options,
    ) -> Result<Visibility, Error> {
        self.cloud
            .visible_from_at_least_by(self.count, k, viewpoints, options)
    }

    /// As [`PointCloud::coverage`].
    ///
    /// # Errors
    /// As [`PointCloud::coverage`].
    pub fn coverage<S: Copy + Into<Seat> + Sync>(
        &self,
        viewpoints: &[S],
        options: &Options,
    ) -> Result<Vec<u32>, Error> {
        self.cloud.coverage_by(self.count, viewpoints, options)
    }

    /// As [`PointCloud::place_viewpoints`].
    ///
    /// # Errors
    /// As [`PointCloud::place_viewpoints`].
    pub fn place_viewpoints<S: Copy + Into<Seat> + Sync>(
        &self,
        candidates: &[S],
        options: &Options,
        placing: &Placing,
    ) -> Result<Placement, Error> {
        self.cloud
            .place_viewpoints_by(self.count, candidates, options, placing)
    }

    /// As [`PointCloud::illuminate`].
    ///
    /// # Errors
    /// As [`PointCloud::illuminate`].
    pub fn illuminate(
        &self,
        lights: &[[f64; 3]],
        options: &Options,
        lighting: &Lighting,
    ) -> Result<Vec<f32>, Error> {
        self.cloud
            .illuminate_by(self.count, lights, options, lighting)
    }
}
