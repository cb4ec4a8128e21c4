//! Many views of one cloud, which share memory.

use crate::answers::memory::ViewMemory;
use crate::answers::visibility::Visibility;
use crate::answers::visibility_map::{MapOptions, VisibilityMap};
use crate::base::error::Error;
use crate::cloud::point_cloud::PointCloud;
use crate::view::options::Options;

/// Looks at a cloud from one viewpoint after another.
///
/// The views share memory. The answers are those of [`PointCloud::visible_from`], to the bit. The observer keeps about 150 bytes for each visible
/// point.
///
/// ```
/// use hidden_point_removal::{Options, PointCloud};
///
/// let cloud = PointCloud::new(&[[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [1.0, 0.0, 0.0]])?;
/// let mut observer = cloud.observer();
/// for step in 0..10 {
///     let angle = f64::from(step).to_radians();
///     let viewpoint = [5.0 * angle.sin(), 0.0, 5.0 * angle.cos()];
///     let visible = observer.visible_from(viewpoint, &Options::default())?;
///     assert_eq!(visible, cloud.visible_from(viewpoint, &Options::default())?);
/// }
/// # Ok::<(), hidden_point_removal::Error>(())
/// ```
pub struct Observer<'a> {
    cloud: &'a PointCloud,
    memory: ViewMemory,
}

impl PointCloud {
    /// An observer of this cloud, without a last view.
    #[must_use]
    pub fn observer(&self) -> Observer<'_> {
        Observer {
            cloud: self,
            memory: ViewMemory::new(),
        }
    }
}

impl Observer<'_> {
    /// As [`PointCloud::visible_from`].
    ///
    /// # Errors
    /// As [`PointCloud::visible_from`].
    pub fn visible_from(
        &mut self,
        viewpoint: [f64; 3],
        options: &Options,
    ) -> Result<Visibility, Error> {
        self.cloud
            .visible_from_with(&mut self.memory, viewpoint, options)
    }

    /// Does a part of the work of a view, so that a viewer can give it up when its camera moves. The first call
    /// takes one point in eight, each further one about `budget` points. Several looks
    /// ([`Inversion::Looks`](crate::Inversion::Looks)) go on look by look. [`Observer::visible_from`] then goes on from there.
    /// Returns whether little more than the answer is left. The answer is the same, to the bit, with slices and
    /// without.
    ///
    /// # Errors
    /// As [`PointCloud::visible_from`].
    pub fn go_on(
        &mut self,
        viewpoint: [f64; 3],
        options: &Options,
        budget: usize,
    ) -> Result<bool, Error> {
        self.cloud
            .go_on_with(&mut self.memory, viewpoint, options, budget)
    }

    /// As [`PointCloud::visibility_map`]. The points to choose from are kept for the next map.
    ///
    /// # Errors
    /// As [`PointCloud::visibility_map`].
    pub fn visibility_map(
        &mut self,
        viewpoint: [f64; 3],
        options: &Options,
        map: &MapOptions,
    ) -> Result<VisibilityMap, Error> {
        self.cloud
            .visibility_map_with(&mut self.memory, viewpoint, options, map)
    }

    /// Forgets the last view. The memory stays reserved.
    pub fn forget(&mut self) {
        self.memory.forget();
    }
}
