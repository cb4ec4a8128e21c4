//! Clouds of two dimensions, as in the paper's figures. They are answered as clouds in space
//! with z = 0, whose hull is a polygon (`hull::flat`). The operations are the same, so the
//! answers are exact.

use alloc::vec::Vec;

use crate::answers::visibility::Visibility;
use crate::base::allocation::with_capacity;
use crate::base::error::Error;
use crate::cloud::point_cloud::{NonFinite, PointCloud};
use crate::cloud::points::Position;
use crate::view::options::{Options, Radius};
use crate::view::radius::ChosenRadius;

/// A point cloud in the plane, with answers as exact as those of [`PointCloud`].
///
/// ```
/// use hidden_point_removal::{Options, PointCloud2d};
///
/// // Two points on one ray: the nearer hides the farther.
/// let cloud = PointCloud2d::new(&[[0.0, 1.0], [0.0, 2.0]])?;
/// let visible = cloud.visible_from([0.0, 5.0], &Options::default())?;
/// assert_eq!(visible.indices(), [1]);
/// # Ok::<(), hidden_point_removal::Error>(())
/// ```
#[derive(Debug)]
pub struct PointCloud2d {
    cloud: PointCloud,
}

impl PointCloud2d {
    /// Prepares `positions`, `[f32; 2]` or `[f64; 2]`.
    ///
    /// # Errors
    /// As [`PointCloud::new`].
    pub fn new<X: Copy + Default>(positions: &[[X; 2]]) -> Result<Self, Error>
    where
        [X; 3]: Position,
    {
        Self::with_non_finite(positions, NonFinite::Error)
    }

    /// Like [`PointCloud2d::new`], with a choice about points that are not finite.
    ///
    /// # Errors
    /// As [`PointCloud::new`].
    pub fn with_non_finite<X: Copy + Default>(
        positions: &[[X; 2]],
        non_finite: NonFinite,
    ) -> Result<Self, Error>
    where
        [X; 3]: Position,
    {
        let cloud = PointCloud::with_non_finite(&in_space(positions)?, non_finite)?;
        Ok(Self { cloud })
    }

    /// Adds points; see [`PointCloud::append`].
    ///
    /// # Errors
    /// As [`PointCloud::append`].
    pub fn append<X: Copy + Default>(&mut self, positions: &[[X; 2]]) -> Result<(), Error>
    where
        [X; 3]: Position,
    {
        self.cloud.append(&in_space(positions)?)
    }

    /// Removes points; see [`PointCloud::remove`].
    ///
    /// # Errors
    /// As [`PointCloud::remove`].
    pub fn remove(&mut self, indices: &[u32]) -> Result<(), Error> {
        self.cloud.remove(indices)
    }

    /// How many points were given, skipped and removed ones included.
    #[must_use]
    pub fn len(&self) -> usize {
        self.cloud.len()
    }

    /// Whether no points were given.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cloud.is_empty()
    }

    /// How many points were left out because they are not finite.
    #[must_use]
    pub fn skipped(&self) -> usize {
        self.cloud.skipped()
    }

    /// The mean distance of a point from its 6 nearest other points; see
    /// [`PointCloud::spacing`].
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.cloud.spacing()
    }

    /// Which points are visible from `viewpoint`? See [`PointCloud::visible_from`].
    ///
    /// # Errors
    /// [`Error::Dimension`] for [`Options::denoise`] and [`Options::vote`]; the others of
    /// [`PointCloud::visible_from`].
    pub fn visible_from(
        &self,
        viewpoint: [f64; 2],
        options: &Options,
    ) -> Result<Visibility, Error> {
        options.check_dimension(2)?;
        self.cloud.visible_from(lift(viewpoint), options)
    }

    /// Which points are visible from at least one of `viewpoints`? See
    /// [`PointCloud::visible_from_any`].
    ///
    /// # Errors
    /// As [`PointCloud2d::visible_from`].
    pub fn visible_from_any(
        &self,
        viewpoints: &[[f64; 2]],
        options: &Options,
    ) -> Result<Visibility, Error> {
        options.check_dimension(2)?;
        self.cloud.visible_from_any(&in_space(viewpoints)?, options)
    }

    /// Which points are visible from at least `k` of `viewpoints`? See
    /// [`PointCloud::visible_from_at_least`].
    ///
    /// # Errors
    /// As [`PointCloud2d::visible_from`]; [`Error::OutOfRange`] for `k`.
    pub fn visible_from_at_least(
        &self,
        k: usize,
        viewpoints: &[[f64; 2]],
        options: &Options,
    ) -> Result<Visibility, Error> {
        options.check_dimension(2)?;
        self.cloud
            .visible_from_at_least(k, &in_space(viewpoints)?, options)
    }

    /// The radius that `rule` chooses for `viewpoint` in spherical flipping.
    ///
    /// # Errors
    /// As [`PointCloud::auto_radius`].
    pub fn auto_radius(&self, viewpoint: [f64; 2], rule: Radius) -> Result<ChosenRadius, Error> {
        self.cloud.auto_radius(lift(viewpoint), rule)
    }
}

fn lift<X: Default>([x, y]: [X; 2]) -> [X; 3] {
    [x, y, X::default()]
}

fn in_space<X: Copy + Default>(positions: &[[X; 2]]) -> Result<Vec<[X; 3]>, Error> {
    let mut lifted = with_capacity(positions.len())?;
    lifted.extend(positions.iter().copied().map(lift));
    Ok(lifted)
}
