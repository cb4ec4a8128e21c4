//! A cloud that is asked with several threads. Each question that they can share is a method of both.

use core::ops::Deref;

#[cfg(feature = "std")]
use crate::base::error::{Error, in_range};
use crate::cloud::point_cloud::PointCloud;

/// More threads would only wait for memory.
#[cfg(feature = "std")]
const MOST: f64 = 256.0;

/// A cloud that is asked with several threads. The answers are those of one thread, to the bit.
///
/// Several viewpoints are shared among the threads. If there are fewer viewpoints than threads,
/// each view is divided by direction. This needs spherical flipping with an exponent below 8, and
/// no looks: otherwise one thread computes the view. All other questions to the
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
    pub(crate) count: usize,
}

impl PointCloud {
    /// This cloud, asked with `count` threads, of which the caller's is one. Clouds below 200,000
    /// points gain little from threads that share a view.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless `count` is from 1 to 256.
    #[cfg(feature = "std")]
    pub fn with_threads(&self, count: usize) -> Result<Threads<'_>, Error> {
        in_range("threads", count as f64, 1.0, MOST)?;
        Ok(Threads { cloud: self, count })
    }

    /// This cloud, asked with the caller's thread alone.
    pub(crate) fn alone(&self) -> Threads<'_> {
        Threads {
            cloud: self,
            count: 1,
        }
    }
}

impl Deref for Threads<'_> {
    type Target = PointCloud;

    fn deref(&self) -> &PointCloud {
        self.cloud
    }
}
